//! `cargo xtask conformance`: every planner, every law that binds it; and every rogue, to see that
//! each law bites.

mod external;

use crate::steps::Verdict;
use anyhow::{Result, ensure};
use pf_conformance::{
    Options, Suite, examine_replanner,
    grid::Grids,
    rogues::{rogues, team_rogues, world_rogues},
    team::Teams,
    world::Worlds,
};
use pf_core::Key;
use pf_planners::Entry;
use std::panic;

/// Enough evaluations for every population there is by default, and a few cycles more.
const FEW: &str = "300";

#[derive(clap::Args, Default)]
pub(crate) struct Args {
    /// Only this planner, by its `--planner` name
    #[arg(long, value_name = "NAME")]
    planner: Option<String>,
    /// Only the planner in this program (docs/external.md)
    #[arg(long, value_name = "COMMAND", conflicts_with = "planner")]
    external: Option<String>,
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
    if let Some(command) = &args.external {
        external::hold(command, &options, &mut tally)?;
        return Ok(tally.told());
    }
    let wanted = |key: &str| args.planner.as_ref().is_none_or(|name| name == key);
    for planner in pf_planners::grid_planners().filter(|planner| wanted(planner.key())) {
        hold(&Grids, &options, planner, &mut tally)?;
    }
    for planner in pf_planners::world_planners().filter(|planner| wanted(planner.key())) {
        hold(&Worlds, &options, planner, &mut tally)?;
    }
    for planner in pf_planners::team_planners().filter(|planner| wanted(planner.key())) {
        hold(&Teams, &options, planner, &mut tally)?;
    }
    ensure!(tally != Tally::default(), "no law was checked");
    if args.planner.is_none() {
        examine_rogues(&mut tally);
    }
    Ok(tally.told())
}

/// Holds a planner to every law that binds it.
fn hold<S: Suite>(
    suite: &S,
    options: &Options,
    planner: &Entry<S::Problem>,
    tally: &mut Tally,
) -> Result<()> {
    let claims = planner.make(&[])?.claims();
    // What never proves that it is done takes its time: smaller problems, and fewer.
    let options = &if claims.complete || claims.optimal {
        options.clone()
    } else {
        Options {
            cases: options.cases.div_ceil(20),
            largest: 225,
            ..options.clone()
        }
    };
    // The laws are not about how good plans are: who counts evaluations makes do with a few.
    let few =
        |key: &Key| (key.name == "evaluations").then(|| (key.name.to_owned(), FEW.to_owned()));
    let settings: Vec<_> = planner.parameters().iter().filter_map(few).collect();
    planner.make(&settings)?;
    let make = || {
        planner
            .make(&settings)
            .expect("it was made with these settings just now")
    };
    for verdict in examine_replanner(suite, options, &make) {
        println!("{:<16} {verdict}", planner.key());
        tally.add(verdict.passed());
    }
    Ok(())
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

    /// Says how many passed and failed.
    fn told(&self) -> Verdict {
        println!("{} passed, {} failed", self.passed, self.failed);
        Verdict::passed_if(self.failed == 0)
    }
}

/// Each rogue must break its law and no other.
fn examine_rogues(tally: &mut Tally) {
    // One of them panics for a living; the kit reports it, and nobody else need.
    let hook = panic::take_hook();
    panic::set_hook(Box::new(|_| ()));
    let on_grids = rogues()
        .into_iter()
        .map(|rogue| (rogue.law, rogue.sin, rogue.examine()));
    let in_worlds = world_rogues()
        .into_iter()
        .map(|rogue| (rogue.law, rogue.sin, rogue.examine()));
    let for_teams = team_rogues()
        .into_iter()
        .map(|rogue| (rogue.law, rogue.sin, rogue.examine()));
    let examined: Vec<_> = on_grids.chain(in_worlds).chain(for_teams).collect();
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
        println!("rogue            breaks only `{law}`: {sin}  {result}");
        tally.add(bites);
    }
}
