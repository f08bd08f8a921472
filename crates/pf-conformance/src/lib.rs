#![doc = include_str!("../README.md")]

pub mod grid;
pub mod rogues;
pub mod team;
pub mod world;

mod answer;
mod exam;
mod law;
mod log;
mod run;
mod stage;
mod suite;
mod trial;
mod verdict;

pub use exam::{examine, examine_replanner};
pub use law::{Binds, Law, laws};
pub use pf_core::PlanRng;
pub use suite::{Case, Options, Plot, Story, Suite, Truth};
pub use verdict::{Breach, Verdict};

/// The generator for `seed`.
#[must_use]
pub fn seeded(seed: u64) -> PlanRng {
    rand::SeedableRng::seed_from_u64(seed)
}
