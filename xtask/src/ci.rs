//! `cargo xtask ci`: what continuous integration runs.

use crate::{
    conformance, new_planner,
    steps::{Step, Verdict, cargo, passes, run_all},
    test,
};
use anyhow::{Result, bail};

#[derive(clap::Args)]
pub(crate) struct Args {
    /// Leave out a step, by its name; may be repeated
    #[arg(long, value_name = "STEP")]
    skip: Vec<String>,
}

const STEPS: [Step; 6] = [
    Step {
        name: "fmt",
        run: || passes(&mut cargo(["fmt", "--all", "--check"])),
    },
    Step {
        name: "clippy",
        run: || {
            let mut clippy = cargo(["clippy", "--workspace", "--all-targets"]);
            passes(clippy.args(["--", "-D", "warnings"]))
        },
    },
    Step {
        name: "doc",
        run: || {
            let mut doc = cargo(["doc", "--workspace", "--no-deps", "--quiet"]);
            passes(doc.env("RUSTDOCFLAGS", "-D warnings"))
        },
    },
    Step {
        name: "test",
        run: test::run,
    },
    Step {
        name: "conformance",
        run: || conformance::run(&conformance::Args::default()),
    },
    Step {
        name: "new-planner",
        run: new_planner::rehearse,
    },
];

pub(crate) fn run(args: &Args) -> Result<Verdict> {
    let names = STEPS.map(|step| step.name);
    if let Some(unknown) = args
        .skip
        .iter()
        .find(|skip| !names.contains(&skip.as_str()))
    {
        bail!("there is no step `{unknown}`; known: {}", names.join(", "));
    }
    let steps = STEPS.into_iter();
    let wanted = steps.filter(|step| !args.skip.iter().any(|skip| skip == step.name));
    run_all("ci", &wanted.collect::<Vec<_>>())
}
