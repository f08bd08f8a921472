//! The experiments of papers, run again: what was published beside what is measured here.
//!
//! A module per paper. It runs the paper's cases with every planner, says for each printed number
//! whether it was reproduced, and draws the paper's figures. What it finds, and what the paper leaves
//! open, stands in `docs/papers/`.

pub mod cabc;
pub mod faustino;
pub mod kim;
pub mod page;
mod plot;
pub mod redlarski;
pub mod row;
pub mod wang;

use pf_suite::{parallel, statistics};

/// Why an experiment could not be run or reported.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PaperError {
    /// What the program carries is broken.
    #[error("the paper's data: {0}")]
    Data(String),
    /// A picture could not be drawn.
    #[error(transparent)]
    Picture(#[from] pf_render::NoPicture),
    /// A file could not be written, or a folder not be made.
    #[error(transparent)]
    File(#[from] pf_io::FileError),
    /// Somebody asked to stop.
    #[error("interrupted")]
    Interrupted,
}
