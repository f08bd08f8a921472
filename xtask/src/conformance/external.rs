//! The laws and a planner in another program.

use super::Tally;
use anyhow::{Result, bail};
use pf_conformance::{Options, Suite, examine, grid::Grids, world::Worlds};
use pf_core::{Claims, Context, Planner, Report, Unsupported};
use pf_external::{External, ExternalParams, FAULT, Fault, Introduction, Wire};
use pf_geom::WorldProblem;
use pf_grid::GridProblem;

/// What a program does wrong is a panic here: the kit reports it, with the case, and goes on.
struct Strict<P> {
    /// The program, or why it did not start this time.
    planner: Result<External<P>, Fault>,
    of: Introduction,
}

impl<P: Wire> Planner<P> for Strict<P> {
    fn name(&self) -> &str {
        &self.of.name
    }

    fn claims(&self) -> Claims {
        self.of.claims
    }

    fn plan(&mut self, problem: &P, cx: &mut Context<'_, P>) -> Result<Report<P>, Unsupported> {
        let planner = match &mut self.planner {
            Ok(planner) => planner,
            Err(fault) => panic!("{} {fault}", self.of.name),
        };
        let report = planner.plan(problem, cx)?;
        if let Some(fault) = report.note(FAULT) {
            panic!("{fault}");
        }
        Ok(report)
    }
}

/// Holds a program to every law that binds it.
pub(super) fn hold(command: &str, options: &Options, tally: &mut Tally) -> Result<()> {
    let of = Introduction::of(command)?;
    // Starting a program takes longer than most planners take to answer.
    let options = &Options {
        cases: options.cases.div_ceil(10),
        largest: 225,
        ..options.clone()
    };
    match of.problem.as_str() {
        GridProblem::KIND => examined(&Grids, command, &of, options, tally),
        WorldProblem::KIND => examined(&Worlds, command, &of, options, tally),
        other => bail!("{command} solves `{other}`, expected grid or world"),
    }
    Ok(())
}

fn examined<S: Suite>(
    suite: &S,
    command: &str,
    of: &Introduction,
    options: &Options,
    tally: &mut Tally,
) where
    S::Problem: Wire,
{
    let params = ExternalParams::default();
    let make = || -> Box<dyn Planner<S::Problem>> {
        Box::new(Strict {
            planner: External::start(command, &params),
            of: of.clone(),
        })
    };
    let hook = std::panic::take_hook();
    std::panic::set_hook(Box::new(|_| ()));
    let verdicts = examine(suite, options, &make);
    std::panic::set_hook(hook);
    for verdict in verdicts {
        println!("{:<16} {verdict}", "external");
        tally.add(verdict.passed());
    }
}
