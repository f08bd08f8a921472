//! Worlds: the cases, the truth about them, and problems and changes made up by the thousand.

mod arc;
mod batches;
mod cases;
mod generate;
mod oracle;
mod roadmap;
pub(crate) mod shapes;
mod strategies;
mod suite;
mod tight;
mod traps;
mod waypoints;

pub use batches::random_batch;
pub use cases::cases;
pub use generate::{Kind, Recipe, random_world};
pub(crate) use oracle::{Found, search};
pub use oracle::{SLACK, Shortest, oracle};
pub use roadmap::roadmap;
pub use strategies::{changes_for, problems, shapes, stories, worlds};
pub use suite::{Worlds, listing};
pub use traps::{dead_end, nested_traps, spiral, trap_world};
pub use waypoints::{Obstacles, quadrant_scene, waypoint_world};

use crate::{Options, examine, examine_replanner, verdict::expect_all};
use pf_core::{Planner, Replanner};
use pf_geom::WorldProblem;

/// Holds a planner for worlds to every law that binds it.
///
/// # Panics
/// If it breaks one: with the planner, the law, the first case on which it did, and how.
#[track_caller]
pub fn check<T: Planner<WorldProblem> + 'static>(make: impl Fn() -> T) {
    expect_all(&examine(&Worlds, &Options::default(), &|| Box::new(make())));
}

/// Holds a planner for worlds that replans to every law that binds it.
///
/// # Panics
/// As [`check`].
#[track_caller]
pub fn check_replanner<T: Replanner<WorldProblem> + 'static>(make: impl Fn() -> T) {
    let make = || Box::new(make()) as Box<dyn Replanner<WorldProblem>>;
    expect_all(&examine_replanner(&Worlds, &Options::default(), &make));
}
