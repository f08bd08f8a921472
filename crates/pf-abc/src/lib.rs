#![doc = include_str!("../README.md")]

mod colony;
mod guide;
mod memory;
mod params;
mod walker;

pub use colony::Colony;
pub use params::{AbcParams, Check, Distance, F2, Scouts};
pub use walker::Abc;
