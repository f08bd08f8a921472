//! The laws every planner keeps, as tests for planners of your own.

pub mod grid;

pub use pf_core::PlanRng;

/// The generator for `seed`.
#[must_use]
pub fn seeded(seed: u64) -> PlanRng {
    rand::SeedableRng::seed_from_u64(seed)
}
