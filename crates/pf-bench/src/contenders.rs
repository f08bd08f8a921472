//! Our planners on grids, by their names in the list of all planners.

use anyhow::{Context as _, Result, anyhow};
use pf_core::{Outcome, Report};
use pf_grid::{GridCost, GridProblem};
use pf_planners::{AnyEntry, Entry, grid_planners};

/// The baseline: every answer is compared with its, and every time.
pub(crate) const FRESH: &str = "astar";

/// Which planners answer beside the fresh A*.
#[derive(clap::Args)]
pub(crate) struct Repairers {
    /// Which planners answer beside the fresh A*; without a word all that repair and prove
    #[arg(long, value_name = "NAME")]
    planner: Vec<String>,
    /// Set a parameter of these planners
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = setting)]
    settings: Vec<(String, String)>,
}

/// A planner of ours.
pub(crate) struct Ours {
    pub(crate) name: &'static str,
    pub(crate) planner: Box<dyn pf_core::Replanner<GridProblem>>,
}

fn setting(text: &str) -> Result<(String, String), &'static str> {
    let pair = text.split_once('=').filter(|(key, _)| !key.is_empty());
    pair.map(|(key, value)| (key.to_owned(), value.to_owned()))
        .ok_or("a setting is written key=value")
}

impl Repairers {
    /// The fresh A*, then the others.
    pub(crate) fn make(&self) -> Result<Vec<Ours>> {
        let fresh = entry(FRESH)?;
        let mut ours = vec![Ours {
            name: FRESH,
            planner: fresh.make(&[])?,
        }];
        let mut asked = Vec::new();
        if self.planner.is_empty() {
            asked.extend(grid_planners().filter(|entry| entry.replans() && entry.claims().optimal));
        }
        for name in &self.planner {
            asked.push(entry(name)?);
        }
        for entry in asked.into_iter().filter(|entry| entry.key() != FRESH) {
            ours.push(Ours {
                name: entry.key(),
                planner: entry.make(&self.settings)?,
            });
        }
        Ok(ours)
    }
}

/// The planner on grids of this name.
pub(crate) fn entry(name: &str) -> Result<&'static Entry<GridProblem>> {
    let found = grid_planners().find(|entry| entry.key() == name);
    found.with_context(|| {
        let names: Vec<_> = grid_planners().map(Entry::key).collect();
        let known = names.join(", ");
        anyhow!("--planner: no planner on grids is called {name}; known: {known}")
    })
}

/// The cost of a path that is proved to be the best, or `Some(None)` for the proof that there is
/// none.
#[expect(
    clippy::option_option,
    reason = "nothing proved, or proved that nothing"
)]
pub(crate) fn proved(report: &Report<GridProblem>) -> Option<Option<GridCost>> {
    match &report.outcome {
        Outcome::Optimal(best) => Some(Some(best.cost)),
        Outcome::Infeasible => Some(None),
        _ => None,
    }
}
