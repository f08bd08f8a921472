#![doc = include_str!("../README.md")]

mod fault;
mod planner;
mod program;
mod wire;

pub use fault::Fault;
pub use planner::{External, ExternalParams, FAULT, Introduction};
pub use wire::Wire;
