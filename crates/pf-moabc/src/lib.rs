#![doc = include_str!("../README.md")]

mod archive;
mod baseline;
mod bees;
mod choice;
mod dice;
mod encoding;
mod evolution;
mod genetic;
mod hive;
pub mod indicators;
mod moead;
mod nsga2;
mod params;
mod random;
mod sort;
mod workers;

pub use baseline::Prioritised;
pub use bees::Moabc;
pub use choice::Preference;
pub use moead::Moead;
pub use nsga2::Nsga2;
pub use params::{
    MoabcParams, MoeadParams, Nsga2Params, PrioritisedParams, RandomSearchParams, Rules,
};
pub use random::RandomSearch;
