//! Grids, their moves and exact costs, and the search kernels that grid planners share.
//!
//! A [`Grid`] says which cells are free and what they cost, a [`GridProblem`] asks for a path
//! between two of them under one of the [`Moves`], and its judge states a [`GridCost`] that is
//! exact: two integers, compared by integers.
//!
//! ```
//! use pf_core::Problem;
//! use pf_grid::{Cell, Grid, GridChange, GridCost, GridProblem, Moves};
//!
//! let grid = Grid::parse("
//!     ....
//!     .##.
//!     ....
//! ").unwrap();
//! let mut problem = GridProblem::new(grid, Cell::new(0, 0), Cell::new(3, 1))
//!     .unwrap()
//!     .with_moves(Moves::Always);
//! let path = vec![Cell::new(0, 0), Cell::new(1, 0), Cell::new(2, 0), Cell::new(3, 1)];
//! assert_eq!(problem.judge(&path), Ok(GridCost::of_steps(2, 1)));
//!
//! problem.apply(&[GridChange::Blocked(vec![Cell::new(2, 0)])]).unwrap();
//! assert!(problem.judge(&path).is_err());
//! ```

mod buckets;
mod canonical;
mod cell;
mod clearance;
mod cost;
mod damage;
mod distances;
mod downhill;
mod drive;
mod exact;
mod field;
mod grid;
mod inflated;
mod layout;
mod moves;
mod problem;
mod route;
mod search;
mod swarm;
mod weights;
mod word;

pub use buckets::Buckets;
pub use canonical::{Successors, successors};
pub use cell::Cell;
pub use clearance::Clearance;
pub use cost::GridCost;
pub use damage::{Bound, Damage};
pub use distances::{Distances, Sweeper, Swept};
pub use downhill::Downhill;
pub use drive::{Advance, Arrival, Drive, Travel};
pub use exact::{ExactSearch, Found};
pub use field::{DistanceField, Upkeep};
pub use grid::Grid;
pub use inflated::Inflated;
pub use layout::Layout;
pub use moves::{DIRECTIONS, Moves};
pub use problem::{GridChange, GridProblem};
pub use route::Route;
pub use search::{End, Search};
pub use swarm::{Chances, Draw, Ended, Medium, Swarm, SwarmRules, Visited, Walk};
pub use weights::{Apart, Weights};
pub use word::Word;
