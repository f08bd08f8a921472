//! Grids: the cases, the truth about them, and problems and changes made up by the thousand.

mod drawings;
mod generate;
mod oracle;
mod strategies;
mod suite;

pub use drawings::{draw, drawing};
pub use generate::{Kind, Recipe, random_batch, random_problem};
pub use oracle::oracle;
pub(crate) use oracle::{Found, search};
pub use strategies::{changes_for, grids, problems, stories};
pub use suite::Grids;

use crate::{Options, examine, examine_replanner, verdict::expect_all};
use pf_core::{Planner, Replanner};
use pf_grid::GridProblem;

/// Holds a grid planner to every law that binds it.
///
/// # Panics
/// If it breaks one: with the planner, the law, the first case on which it did, and how.
#[track_caller]
pub fn check<T: Planner<GridProblem> + 'static>(make: impl Fn() -> T) {
    expect_all(&examine(&Grids, &Options::default(), &|| Box::new(make())));
}

/// Holds a grid planner that replans to every law that binds it.
///
/// # Panics
/// As [`check`].
#[track_caller]
pub fn check_replanner<T: Replanner<GridProblem> + 'static>(make: impl Fn() -> T) {
    let make = || Box::new(make()) as Box<dyn Replanner<GridProblem>>;
    expect_all(&examine_replanner(&Grids, &Options::default(), &make));
}
