//! `cargo xtask bench`: runs pf-bench, which alone knows its suites and options.

use crate::steps::{Verdict, cargo, passes};
use anyhow::Result;

#[derive(clap::Args)]
pub(crate) struct Args {
    /// Passed on to pf-bench as they are
    #[arg(
        value_name = "SUITE] [OPTION",
        trailing_var_arg = true,
        allow_hyphen_values = true
    )]
    args: Vec<String>,
}

pub(crate) fn run(args: &Args) -> Result<Verdict> {
    let mut command = cargo(["run", "--release", "--quiet", "--package", "pf-bench", "--"]);
    passes(command.args(&args.args))
}
