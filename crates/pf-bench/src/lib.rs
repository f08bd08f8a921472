//! Benchmarks beside other crates, by one protocol.

pub mod grid;
