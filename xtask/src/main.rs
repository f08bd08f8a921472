//! The workspace's own commands: `cargo xtask --help` lists them.
#![expect(clippy::print_stdout, reason = "a program talks")]

mod bench;
mod bless;
mod browser;
mod ci;
mod conformance;
mod gallery;
mod laws;
mod maps;
mod new_planner;
mod office;
mod planners;
mod steps;
mod test;
mod tidy;
mod workspace;
mod yard;

use clap::{Parser, Subcommand};
use std::process::ExitCode;
use steps::Verdict;

/// The workspace's own commands.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Cli {
    #[command(subcommand)]
    verb: Verb,
}

/// Every verb, declared here alone; each has a file of its own.
#[derive(Subcommand)]
enum Verb {
    /// Everything to run before a commit: tests, doctests, the third-party example, tidy
    Test,
    /// What continuous integration runs: fmt, clippy, doc, test, conformance, new-planner
    Ci(ci::Args),
    /// Holds every planner to every law that binds it
    Conformance(conformance::Args),
    /// Prints the law table
    Laws(Page),
    /// Prints the planner table
    Planners(Page),
    /// Checks what the compiler does not: who may depend on whom, documents, file sizes
    Tidy,
    /// Re-writes the golden files of the tests from what the code does now
    Bless,
    /// Runs a benchmark suite of pf-bench, optimised: `cargo xtask bench grid --json`
    Bench(bench::Args),
    /// Looks at the demo's report and at animations in Chromium; skipped where there is none
    Browser,
    /// Draws the maps that are made here: maps/grids/office.yaml and its picture
    Maps,
    /// Draws the pictures of docs/gallery.md again
    Gallery,
    /// Makes a crate for a new planner, with a conformance test that fails until it is written
    NewPlanner(new_planner::Args),
}

/// A table that also stands in docs/.
#[derive(clap::Args)]
struct Page {
    /// Write it to docs/ instead
    #[arg(long)]
    write: bool,
}

/// 0 passed, 1 could not be run, 2 usage, 6 a check failed.
fn main() -> ExitCode {
    let verdict = match Cli::parse().verb {
        Verb::Test => test::run(),
        Verb::Ci(args) => ci::run(&args),
        Verb::Conformance(args) => conformance::run(&args),
        Verb::Laws(page) => laws::run(page.write),
        Verb::Planners(page) => planners::run(page.write),
        Verb::Tidy => tidy::run(),
        Verb::Bless => bless::run(),
        Verb::Bench(args) => bench::run(&args),
        Verb::Browser => browser::run(),
        Verb::Maps => maps::run(),
        Verb::Gallery => gallery::run(),
        Verb::NewPlanner(args) => new_planner::run(&args),
    };
    match verdict {
        Ok(Verdict::Passed) => ExitCode::SUCCESS,
        Ok(Verdict::Failed) => ExitCode::from(6),
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}
