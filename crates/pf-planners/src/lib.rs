//! The list of all planners, one line each, for tools that choose a planner by its name.
//!
//! There is no enum of planners and none of problems. A planner is an [`Entry`] in the list of its
//! problem; a problem joins by [`FromScene`], which says how it is read out of a [`Scene`] and how
//! its answers are drawn. Whoever knows the problem takes the typed entries ([`grid_planners`],
//! [`world_planners`],
//! [`team_planners`]); the program takes [`all`], whose [`Runner`]s hide it.
//!
//! Any planner answers any scene. For a planner on grids a world is cut into cells, on the safe
//! side ([`WorldScene::cell`] says how large); for a planner in worlds the blocked cells of a grid
//! become rectangles, with the robot's size in cells. Its path is joined to the exact start and goal
//! and marked in the scene that was asked about; what was proved of the converted one is not claimed
//! of that. For a planner for teams the robot is a team of one, and the shortest plan of its front is
//! the answer.
//!
//! ```
//! use pf_grid::{Cell, Grid};
//! use pf_planners::{GridScene, Order, find};
//!
//! let grid = Grid::parse("... .#. ...").unwrap();
//! let scene = GridScene::new(grid, Cell::new(0, 0), Cell::new(2, 2)).unwrap().into();
//! let mut runner = find("astar").unwrap().runner(&[]).unwrap();
//! let answer = runner.plan(&scene, Order::seeded(7)).unwrap();
//! assert_eq!((answer.outcome, answer.costs), ("optimal", vec![4.0]));
//!
//! // Around the corner of the blocked cell, and so shorter than any path from cell to cell.
//! let mut runner = find("visibility-graph").unwrap().runner(&[]).unwrap();
//! let answer = runner.plan(&scene, Order::seeded(7)).unwrap();
//! assert_eq!(answer.outcome, "feasible");
//! assert!((answer.costs[0] - 10f64.sqrt()).abs() < 1e-3);
//!
//! let Err(error) = find("atsar") else { panic!() };
//! assert!(error.to_string().starts_with("there is no planner `atsar`; did you mean `astar`?"));
//! ```

mod entry;
mod external;
mod grid;
mod grid_scene;
mod list;
mod posed;
mod ruler;
mod runner;
mod scene;
mod team;
mod world;
mod world_scene;

pub use entry::{AnyEntry, Entry, Settings, UnknownPlanner};
pub use grid_scene::GridScene;
pub use list::{all, find, grid_planners, team_planners, world_planners};
pub use pf_external::FAULT;
pub use posed::{Conversion, Found, FromScene, Line, Posed};
pub use ruler::{Ruler, length};
pub use runner::{Answer, Order, Refusal, Runner};
pub use scene::{Changes, Robot, Scene};
pub use world_scene::WorldScene;
