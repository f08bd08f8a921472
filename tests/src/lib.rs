//! Tests that see the whole workspace, and what they share.

pub mod golden;
