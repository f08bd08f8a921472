//! Wang et al.: *A Novel Multi-objective Artificial Bee Colony Algorithm for Multi-robot Path
//! Planning*.

mod problems;

pub use problems::{Trial, concave, four_discs, further, three_discs};
