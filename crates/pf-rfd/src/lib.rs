#![doc = include_str!("../README.md")]

mod bed;
mod exact;
mod exp2;
mod field;
mod params;
mod river;
mod stochastic;

pub use exact::{RfdExact, RfdExactParams};
pub use field::{RfdField, RfdFieldParams};
pub use params::{Pull, RfdParams, RfdStarParams, Slope, Toll};
pub use stochastic::{Rfd, RfdStar};
