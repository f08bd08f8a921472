//! Teams of robots: cases, changes, and what is known of them without a planner.

mod generate;
mod suite;

pub use generate::{TeamRecipe, crossing};
pub(crate) use suite::one_by_one;
pub use suite::{Teams, team_batch};

use crate::{Options, examine, examine_replanner, verdict::expect_all};
use pf_core::{Planner, Replanner};
use pf_geom::TeamProblem;

/// How thorough [`check`] is: planners for teams take seconds where others take milliseconds.
fn options() -> Options {
    Options {
        cases: 6,
        ..Options::default()
    }
}

/// Holds a planner for teams to every law that binds it.
///
/// # Panics
/// If it breaks one: with the planner, the law, the first case on which it did, and how.
#[track_caller]
pub fn check<T: Planner<TeamProblem> + 'static>(make: impl Fn() -> T) {
    expect_all(&examine(&Teams, &options(), &|| Box::new(make())));
}

/// Holds a planner for teams that replans to every law that binds it.
///
/// # Panics
/// As [`check`].
#[track_caller]
pub fn check_replanner<T: Replanner<TeamProblem> + 'static>(make: impl Fn() -> T) {
    let make = || Box::new(make()) as Box<dyn Replanner<TeamProblem>>;
    expect_all(&examine_replanner(&Teams, &options(), &make));
}
