//! The list of all planners, one line each, for tools that choose a planner by its name.
//!
//! There is no enum of planners and none of problems. A planner is an [`Entry`] in the list of its
//! problem; a problem joins by [`FromScene`], which says how it is read out of a [`Scene`] and how
//! its answers are drawn. Whoever knows the problem takes the typed entries ([`grid_planners`]);
//! the program takes [`all`], whose [`Runner`]s hide it.
//!
//! ```
//! use pf_grid::{Cell, Grid};
//! use pf_planners::{Order, Scene, find};
//!
//! let grid = Grid::parse("... .#. ...").unwrap();
//! let scene = Scene::new(grid, Cell::new(0, 0), Cell::new(2, 2)).unwrap();
//! let mut runner = find("astar").unwrap().runner(&[]).unwrap();
//! let answer = runner.plan(&scene, Order::seeded(7)).unwrap();
//! assert_eq!((answer.outcome, answer.costs), ("optimal", vec![4.0]));
//!
//! let Err(error) = find("atsar") else { panic!() };
//! assert!(error.to_string().starts_with("there is no planner `atsar`; did you mean `astar`?"));
//! ```

mod entry;
mod grid;
mod list;
mod runner;
mod scene;

pub use entry::{AnyEntry, Entry, Settings, UnknownPlanner};
pub use list::{all, find, grid_planners};
pub use runner::{Answer, Order, Refusal, Runner};
pub use scene::{Faith, FromScene, Line, Scene};
