//! Suites of problems and planners: many runs on a few threads, resumable and in shards, and what
//! can be said of them.
//!
//! A [`Suite`] is read from TOML; [`run`] makes its runs, adds each to a [`Folder`](folder::Folder)
//! once it is done, and makes none twice. All that a run depends on is its problem, its planner with
//! parameters, its seed and its budget: planners are made anew for each, so that results are the same
//! on any number of threads, in any order, in one go or in shards. Every answer is marked by the judge.
//!
//! # The format of suites
//!
#![doc = include_str!("suite.md")]

pub mod comparisons;
mod digest;
pub mod folder;
pub mod parallel;
mod problem;
mod record;
pub mod report;
mod solve;
pub mod statistics;
mod suite;
mod work;

pub use problem::{Ask, SuiteProblem};
pub use record::{Line, Record, Times};
pub use solve::solve;
pub use suite::{Contender, Job, Limits, Suite};
pub use work::{Done, Plan, Shard, run};

use std::path::PathBuf;

/// Why runs could not be made, merged or reported.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SuiteError {
    /// A file could not be read or written, or is not what it should be.
    #[error(transparent)]
    File(#[from] pf_io::FileError),
    /// A picture could not be drawn.
    #[error(transparent)]
    Picture(#[from] pf_render::NoPicture),
    /// Somebody else adds runs to the folder.
    #[error("{0} is in use: another program adds runs to it")]
    InUse(PathBuf),
    /// The folder holds results that the suite does not ask for.
    #[error(
        "{runs} of the {of} runs in the folder are of another suite, or of another version of it"
    )]
    Strange {
        /// How many.
        runs: usize,
        /// Of how many.
        of: usize,
    },
    /// The same run is there twice, with different results.
    #[error("results that do not go together: {what} ({run})")]
    Differ {
        /// The run.
        run: String,
        /// How.
        what: &'static str,
    },
    /// A fault of its own.
    #[error("{0}")]
    Internal(String),
}
