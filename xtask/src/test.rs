//! `cargo xtask test`: everything to run before a commit.

use crate::{
    steps::{Step, Verdict, cargo, passes, run_all},
    tidy,
    workspace::root,
};
use anyhow::Result;
use std::fs;

pub(crate) fn run() -> Result<Verdict> {
    let steps = [
        Step {
            name: "tests",
            run: || passes(&mut cargo(["test"])),
        },
        Step {
            name: "third party",
            run: third_party,
        },
        Step {
            name: "tidy",
            run: tidy::run,
        },
    ];
    run_all("test", &steps)
}

/// The example crate outside the workspace: what a user of pf-conformance sees.
fn third_party() -> Result<Verdict> {
    let folder = root().join("examples/third-party");
    // The same versions and the same target folder: nothing is resolved or built a second time.
    fs::copy(root().join("Cargo.lock"), folder.join("Cargo.lock"))?;
    let mut command = cargo(["test"]);
    command
        .current_dir(&folder)
        .env("CARGO_TARGET_DIR", root().join("target"));
    passes(&mut command)
}
