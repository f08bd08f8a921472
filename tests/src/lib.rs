//! Tests that see the whole workspace, and what they share.

pub mod golden;

/// The README's example is a test.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
