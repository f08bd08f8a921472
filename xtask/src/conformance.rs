//! `cargo xtask conformance`: every planner, every law that binds it; and every rogue, to see that
//! each law bites.

use crate::steps::Verdict;
use anyhow::{Result, ensure};
use pf_conformance::{Options, examine_replanner, grid::Grids, rogues::rogues};
use std::panic;

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
    let mut tally = Tally::default();
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
            tally.add(verdict.passed());
        }
    }
    ensure!(tally != Tally::default(), "no law was checked");
    if args.planner.is_none() {
        examine_rogues(&mut tally);
    }
    println!("{} passed, {} failed", tally.passed, tally.failed);
    Ok(Verdict::passed_if(tally.failed == 0))
}

#[derive(Default, PartialEq)]
struct Tally {
    passed: u32,
    failed: u32,
}

impl Tally {
    fn add(&mut self, passed: bool) {
        self.passed += u32::from(passed);
        self.failed += u32::from(!passed);
    }
}

/// Each rogue must break its law and no other.
fn examine_rogues(tally: &mut Tally) {
    // One of them panics for a living; the kit reports it, and nobody else need.
    let hook = panic::take_hook();
    panic::set_hook(Box::new(|_| ()));
    let examined: Vec<_> = rogues()
        .into_iter()
        .map(|rogue| (rogue.law, rogue.sin, rogue.examine()))
        .collect();
    panic::set_hook(hook);
    for (law, sin, verdicts) in examined {
        let broken = verdicts.iter().filter(|verdict| !verdict.passed());
        let broken: Vec<_> = broken.map(|verdict| verdict.law.name).collect();
        let bites = broken == [law];
        let result = if bites {
            "ok".to_owned()
        } else {
            format!("BROKEN: it breaks {broken:?}")
        };
        println!("rogue          breaks only `{law}`: {sin}  {result}");
        tally.add(bites);
    }
}
