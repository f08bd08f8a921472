//! The laws and a planner in another program.

use super::Tally;
use anyhow::{Result, bail};
use pf_conformance::{Options, Suite, examine, grid::Grids, world::Worlds};
use pf_core::{Claims, Context, Planner, Report, Unsupported};
use pf_external::{External, ExternalParams, FAULT, Introduction, Wire};
use pf_geom::WorldProblem;
use pf_grid::GridProblem;

/// What a program does wrong is a panic here: the kit reports it, with the case, and goes on.
struct Strict<P>(External<P>);

impl<P: Wire> Planner<P> for Strict<P> {
    fn name(&self) -> &str {
        self.0.name()
    }

    fn claims(&self) -> Claims {
        self.0.claims()
    }

    fn plan(&mut self, problem: &P, cx: &mut Context<'_, P>) -> Result<Report<P>, Unsupported> {
        let report = self.0.plan(problem, cx)?;
        if let Some(fault) = report.note(FAULT) {
            panic!("{fault}");
        }
        Ok(report)
    }
}

/// Holds a program to every law that binds it.
pub(super) fn hold(command: &str, options: &Options, tally: &mut Tally) -> Result<()> {
    let problem = Introduction::of(command)?.problem;
    // Starting a program takes longer than most planners take to answer.
    let options = &Options {
        cases: options.cases.div_ceil(10),
        largest: 225,
        ..options.clone()
    };
    match problem.as_str() {
        GridProblem::KIND => examined(&Grids, command, options, tally),
        WorldProblem::KIND => examined(&Worlds, command, options, tally),
        other => bail!("{command} solves `{other}`, expected grid or world"),
    }
}

fn examined<S: Suite>(suite: &S, command: &str, options: &Options, tally: &mut Tally) -> Result<()>
where
    S::Problem: Wire,
{
    let params = ExternalParams::default();
    External::<S::Problem>::start(command, &params)?;
    let make = || -> Box<dyn Planner<S::Problem>> {
        let planner = External::start(command, &params);
        Box::new(Strict(planner.unwrap_or_else(|fault| panic!("{fault}"))))
    };
    let hook = std::panic::take_hook();
    std::panic::set_hook(Box::new(|_| ()));
    let verdicts = examine(suite, options, &make);
    std::panic::set_hook(hook);
    for verdict in verdicts {
        println!("{:<16} {verdict}", "external");
        tally.add(verdict.passed());
    }
    Ok(())
}
