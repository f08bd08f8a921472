//! The planner every rogue is but for its one sin.

use crate::grid::{Found, search};
use pf_core::{
    Claims, Context, Outcome, Planner, Problem, Proof, Replanner, Report, Revision, Stamp,
    Unsupported,
};
use pf_grid::{Cell, GridChange, GridCost, GridProblem};

/// A plain Dijkstra search that keeps its last answer while the changes leave it the best.
///
/// It claims everything there is to claim, and breaks no law. One iteration settles one cell.
#[derive(Clone, Debug, Default)]
pub struct Honest {
    /// Which problem `last` answers.
    pub(super) known: Option<Stamp>,
    pub(super) last: Option<Last>,
}

/// What was proven last.
#[derive(Clone, Debug)]
pub(super) enum Last {
    Path(Vec<Cell>),
    Nothing,
}

impl Honest {
    /// Everything there is to claim.
    pub(super) const CLAIMS: Claims = Claims::NONE
        .complete()
        .optimal()
        .anytime()
        .deterministic()
        .incremental();

    /// The answer kept, stated anew.
    pub(super) fn repeat(
        &self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Report<GridProblem> {
        match &self.last {
            Some(Last::Path(path)) => cx.answer(problem, path.clone(), Proof::Optimal),
            Some(Last::Nothing) => cx.report(Outcome::Infeasible),
            None => cx.report(Outcome::Unknown { attempt: None }),
        }
    }

    /// Whether the last answer is still the best there is.
    fn still_best(&self, problem: &GridProblem, changes: &[GridChange]) -> bool {
        use GridChange::{Blocked, CostChanged, Freed, GoalMoved, StartMoved};
        match &self.last {
            None => false,
            Some(Last::Nothing) => changes
                .iter()
                .all(|change| matches!(change, Blocked(_) | CostChanged(..))),
            Some(Last::Path(path)) => {
                let Ok(cost) = problem.judge(path) else {
                    return false;
                };
                // A path that is better now leads through a cell that became free or cheaper, or
                // diagonally past one.
                let too_far = |cell: &Cell| {
                    let around = |at: u32| at.saturating_sub(1)..=at + 1;
                    around(cell.x)
                        .flat_map(|x| around(cell.y).map(move |y| Cell::new(x, y)))
                        .all(|via| cost <= least(problem.start(), via) + least(via, problem.goal()))
                };
                changes.iter().all(|change| match change {
                    Blocked(_) => true,
                    Freed(cells) | CostChanged(cells, _) => cells.iter().all(too_far),
                    StartMoved(_) | GoalMoved(_) => false,
                })
            }
        }
    }
}

/// No path between these cells costs less, whatever the moves.
fn least(from: Cell, to: Cell) -> GridCost {
    let (dx, dy) = (from.x.abs_diff(to.x), from.y.abs_diff(to.y));
    GridCost::of_steps(dx.abs_diff(dy).into(), dx.min(dy).into())
}

impl Planner<GridProblem> for Honest {
    fn name(&self) -> &'static str {
        "honest"
    }

    fn claims(&self) -> Claims {
        Self::CLAIMS
    }

    fn plan(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Result<Report<GridProblem>, Unsupported> {
        let found = search(problem, |cell| {
            let goes_on = cx.proceed();
            if goes_on {
                cx.expanded(|| cell);
            }
            goes_on
        });
        (self.last, self.known) = match found {
            Found::Path(path) => (Some(Last::Path(path)), Some(problem.stamp())),
            Found::Nothing => (Some(Last::Nothing), Some(problem.stamp())),
            Found::Stopped => (None, None),
        };
        Ok(self.repeat(problem, cx))
    }
}

impl Replanner<GridProblem> for Honest {
    fn replan(
        &mut self,
        revision: &Revision<'_, GridProblem>,
        cx: &mut Context<'_, GridProblem>,
    ) -> Result<Report<GridProblem>, Unsupported> {
        let problem = revision.problem();
        match revision.since(self.known) {
            Some(changes) if self.still_best(problem, changes) => {
                self.known = Some(problem.stamp());
                Ok(self.repeat(problem, cx))
            }
            _ => self.plan(problem, cx),
        }
    }
}
