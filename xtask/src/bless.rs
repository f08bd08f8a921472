//! `cargo xtask bless`: makes what the code does now the expectation of the golden tests.

use crate::steps::{Verdict, cargo, passes};
use anyhow::Result;
use std::process::Command;

pub(crate) fn run() -> Result<Verdict> {
    let mut test = cargo(["test", "-p", "pf-tests", "--test", "golden"]);
    let verdict = passes(test.env("PF_BLESS", "1"))?;
    if verdict == Verdict::Passed {
        println!("\nGolden files that differ from the last commit (read them before you commit):");
        let mut status = Command::new("git");
        status.args(["status", "--short", "--", "tests/golden"]);
        return passes(status.current_dir(crate::workspace::root()));
    }
    Ok(verdict)
}
