//! The last answer, for as long as nothing that happens can make another one better.

use pf_core::{Context, Outcome, Problem, Report, Revision, Solved, Stamp};
use pf_grid::{Cell, GridChange, GridProblem};

/// The last shortest path. Its end is a shortest path, too; and where cells are blocked, whatever is left
/// is no shorter than before.
#[derive(Clone, Debug, Default)]
pub(crate) struct LastPath {
    /// Of the problem whose answer it was.
    known: Option<Stamp>,
    path: Vec<Cell>,
}

impl LastPath {
    /// Remembers what was answered, if it was proved.
    pub(crate) fn remember(&mut self, problem: &GridProblem, report: &Report<GridProblem>) {
        self.known = None;
        if let Outcome::Optimal(best) = &report.outcome {
            self.known = Some(problem.stamp());
            self.path.clone_from(&best.solution);
        }
    }

    /// Answers with what is left of it, if nothing but the start and blocked cells changed, the start is
    /// on it, and the judge lets it pass; else it is forgotten.
    pub(crate) fn answer(
        &mut self,
        revision: &Revision<'_, GridProblem>,
        cx: &mut Context<'_, GridProblem>,
    ) -> Option<Report<GridProblem>> {
        let problem = revision.problem();
        let harmless = |change: &GridChange| {
            matches!(change, GridChange::StartMoved(_) | GridChange::Blocked(_))
        };
        if !revision.since(self.known.take())?.iter().all(harmless) {
            return None;
        }
        let gone = self.path.iter().position(|&cell| cell == problem.start())?;
        self.path.drain(..gone);
        // Judged here, so that a path that is blocked by now is no attempt.
        let cost = problem.judge(&self.path).ok()?;
        if !cx.proceed() {
            return None;
        }
        self.known = Some(problem.stamp());
        let best = Solved {
            solution: self.path.clone(),
            cost,
        };
        cx.note("replanned", "kept");
        cx.improved(|| best.clone());
        Some(cx.report(Outcome::Optimal(best)))
    }
}
