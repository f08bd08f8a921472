//! Benchmarks, beside other crates where there are some, by one protocol.
//!
//! All contenders answer the same queries in one process, one after the other, so that a machine
//! that is busy is busy for all of them. A query is asked several times and its least time counts;
//! over queries there are medians and geometric means. Every answer is checked.

mod beside;
mod cases;
mod contenders;
mod drive;
mod fronts;
mod grid;
mod memory;
mod protocol;
mod replan;
mod walk;
mod waypoints;
mod worlds;

use anyhow::Result;
use clap::Parser;
use std::io;

/// Benchmarks of pf's planners
#[derive(Parser)]
#[command(name = "cargo xtask bench")]
struct Cli {
    #[command(subcommand)]
    suite: Suite,
}

#[derive(clap::Subcommand)]
enum Suite {
    /// A robot with a sensor in an unknown map: all planning of a drive, beside a fresh A*
    Drive(drive::Args),
    /// What planners for teams take for an evaluation, for sorting, and over threads
    Fronts(fronts::Args),
    /// A*, Dijkstra and their peers on the queries of Moving AI scenario files
    Grid(grid::Args),
    /// Bytes a cell that planners take on grids of 4096 x 4096
    Memory(memory::Args),
    /// Latency and upkeep after changes of map or query, beside a fresh A*
    Replan(replan::Args),
    /// A step of the bees, by the length of the walk and the size of the world
    Walk(walk::Args),
    /// Waypoints by L-BFGS and by swarms, beside argmin's L-BFGS on the same loss
    Waypoints(waypoints::Args),
    /// Kernels, shortest paths and changes among shapes, and their peers
    Worlds(worlds::Args),
}

/// What a piece of work took of the allocator.
#[derive(Clone, Copy, Debug)]
pub struct Counted {
    /// Calls of the allocator for memory.
    pub allocations: u64,
    /// The most bytes held at a time.
    pub peak: u64,
}

/// Does a piece of work and counts what it takes.
pub type Counter = fn(&mut dyn FnMut()) -> Counted;

/// Runs what the command line asks for. A program whose allocator counts gives a counter.
///
/// # Errors
/// If a file cannot be read, an option makes no sense, or answers do not agree.
pub fn run(counter: Option<Counter>) -> Result<()> {
    let told = match Cli::parse().suite {
        Suite::Drive(args) => drive::run(&args),
        Suite::Fronts(args) => fronts::run(&args),
        Suite::Grid(args) => grid::run(&args, counter),
        Suite::Memory(args) => memory::run(&args),
        Suite::Replan(args) => replan::run(&args),
        Suite::Walk(args) => walk::run(&args, counter),
        Suite::Waypoints(args) => waypoints::run(&args),
        Suite::Worlds(args) => worlds::run(&args),
    };
    // Whoever reads no further has seen enough.
    told.or_else(|error| match error.downcast_ref::<io::Error>() {
        Some(broken) if broken.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        _ => Err(error),
    })
}
