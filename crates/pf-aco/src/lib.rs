#![doc = include_str!("../README.md")]

mod params;
mod planner;
mod trails;

pub use params::{AcoParams, AcoStarParams};
pub use planner::{Aco, AcoStar};
