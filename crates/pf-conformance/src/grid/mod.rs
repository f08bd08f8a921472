//! Grids.
mod drawings;
mod generate;
mod oracle;
mod strategies;
pub use drawings::{draw, drawing};
pub use generate::{Kind, Recipe, random_batch, random_problem};
pub use oracle::oracle;
pub use strategies::{changes_for, grids, problems, stories};
