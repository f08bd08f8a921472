//! `cargo xtask bench`: runs pf-bench, which alone knows its suites and options.

use crate::steps::{Verdict, cargo, passes};
use anyhow::Result;

#[derive(clap::Args)]
pub(crate) struct Args {
    /// Passed on to pf-bench as they are; the suite is `grid` unless named.
    /// `cargo xtask bench help` lists suites, `cargo xtask bench grid --help` options
    #[arg(
        value_name = "SUITE] [OPTION",
        trailing_var_arg = true,
        allow_hyphen_values = true
    )]
    args: Vec<String>,
}

impl Args {
    /// The suite in whose stead there is an option, or nothing.
    fn suite(&self) -> Option<&'static str> {
        let named = self.args.first().is_some_and(|arg| !arg.starts_with('-'));
        (!named).then_some("grid")
    }
}

pub(crate) fn run(args: &Args) -> Result<Verdict> {
    let package = ["--release", "--quiet", "--package", "pf-bench"];
    // The program beside it, which counts allocations, too.
    let built = passes(cargo(["build", "--bins"]).args(package))?;
    if built == Verdict::Failed {
        return Ok(built);
    }
    let mut command = cargo(["run"]);
    command.args(package).arg("--");
    passes(command.args(args.suite()).args(&args.args))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_suite_may_be_left_out() {
        let suite = |args: &[&str]| {
            let args = args.iter().map(|&arg| arg.to_owned()).collect();
            Args { args }.suite()
        };
        assert_eq!(suite(&[]), Some("grid"));
        assert_eq!(suite(&["--json"]), Some("grid"));
        assert_eq!(suite(&["memory", "--json"]), None);
    }
}
