//! `cargo xtask conformance`: every planner, every law that binds it.

use crate::steps::Verdict;
use anyhow::{Result, ensure};
use pf_conformance::{Options, examine_replanner, grid::Grids};

#[derive(clap::Args, Default)]
pub(crate) struct Args {
    /// Only this planner, by its `--planner` name
    #[arg(long, value_name = "NAME")]
    planner: Option<String>,
    /// How many problems to make up beside the drawn ones
    #[arg(long, value_name = "N")]
    cases: Option<u32>,
    /// From which seed to make them up
    #[arg(long, value_name = "S")]
    seed: Option<u64>,
}

pub(crate) fn run(args: &Args) -> Result<Verdict> {
    if let Some(name) = &args.planner {
        pf_planners::find(name)?;
    }
    let ordinary = Options::default();
    let options = Options {
        cases: args.cases.unwrap_or(ordinary.cases),
        seed: args.seed.unwrap_or(ordinary.seed),
        ..ordinary
    };
    let (mut passed, mut failed) = (0, 0);
    for planner in pf_planners::grid_planners() {
        if args
            .planner
            .as_ref()
            .is_some_and(|name| name != planner.key())
        {
            continue;
        }
        planner.make(&[])?;
        let make = || {
            planner
                .make(&[])
                .expect("it was made with its defaults just now")
        };
        for verdict in examine_replanner(&Grids, &options, &make) {
            println!("{:<14} {verdict}", planner.key());
            if verdict.passed() {
                passed += 1;
            } else {
                failed += 1;
            }
        }
    }
    ensure!(passed + failed > 0, "no law was checked");
    println!("{passed} passed, {failed} failed");
    Ok(Verdict::passed_if(failed == 0))
}
