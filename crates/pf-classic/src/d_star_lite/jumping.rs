//! When D* Lite jumps, and what it tells who does.

use super::{DStarLite, guided::Found};
use pf_core::{Context, Outcome, Problem, Proof, Report, Unsupported};
use pf_grid::{Beeline, GridProblem};

/// Where jump points are at hand, a search is given up that has expanded one of so many cells that a plan does:
/// they expand fewer yet.
const PATIENT: u64 = 16;
/// How much jumps expand is found out once answers have expanded one of so many of a plan's.
const CURIOUS: u64 = 4;
/// With less patience than that it is not begun.
const CURT: u64 = 8;
/// Their bits are made once answers have expanded one cell in so many of the map's, as more are to come,
const BITS: u64 = 512;
/// or a plan one in so many: they take about as long, and a goal that moves takes no other plan.
const PLAN: u64 = 32;
/// Little stands about where no more than one cell of so many is blocked.
const OPEN: u64 = 64;
/// Jumps take little that expand so many cells.
const LITTLE: u64 = 1 << 9;
/// They are made anew where more cells than that change at once.
const MANY: usize = 256 + SOON;
/// And followed where so many have gathered, or by the next jump.
const SOON: usize = 64;

impl DStarLite {
    /// How many cells a search may expand: where jump points are at hand, half as many after each that did not find
    /// its way with those, and none to a goal to which no distances are known.
    pub(super) fn forbearance(&self, problem: &GridProblem) -> u64 {
        let is_ready = news(&self.pending, self.behind).is_some() && self.auto.has_jumps();
        if !is_ready || !problem.grid().is_uniform() {
            return u64::MAX;
        }
        if !self.knows(problem) {
            return 0;
        }
        let most = match self.jump_effort {
            0 if self.debt > self.effort / CURIOUS => 0,
            0 => self.effort / PATIENT,
            known => known,
        };
        most.checked_shr(self.given_up).unwrap_or(0)
    }

    /// Whether no search is begun.
    pub(super) fn jumps_at_once(&self, problem: &GridProblem) -> bool {
        self.forbearance(problem) < CURT
    }

    /// Tells who jumps what is new.
    fn catch_up(&mut self, problem: &GridProblem) {
        // Who does not jump counts them only.
        let all = self.behind.and_then(|behind| self.pending.get(behind..));
        let all = all.filter(|_| !self.auto.has_jumps());
        if let Some(news) = all.or(news(&self.pending, self.behind)) {
            let layout = problem.grid().layout();
            let cells = news.iter().map(|&id| layout.cell(id));
            self.auto.catch_up(problem, cells, self.opened);
            self.is_caught_up();
        }
    }

    /// Who jumps was told all that is new, or has looked at the grid.
    fn is_caught_up(&mut self) {
        (self.behind, self.opened) = (Some(self.pending.len()), false);
    }

    /// Answers by jump points. A search that gave up learns what it was to find.
    pub(super) fn jump(
        &mut self,
        problem: &GridProblem,
        gave_up: bool,
        cx: &mut Context<'_, GridProblem>,
    ) -> Result<Report<GridProblem>, Unsupported> {
        cx.note("replanned", "jumped");
        self.catch_up(problem);
        let before = cx.stats().expanded;
        let report = self.auto.jump(problem, true, &mut self.last_path, cx)?;
        let expanded = cx.stats().expanded - before;
        self.is_caught_up();
        self.jump_effort = match self.jump_effort {
            0 => expanded,
            mean if cx.stopped() => mean.max(expanded),
            mean => (3 * mean + expanded) / 4,
        };
        let is_proof = matches!(report.outcome, Outcome::Infeasible);
        self.last = is_proof.then_some((problem.stamp(), Found::Nothing));
        if gave_up {
            self.be_told(problem, &report.outcome);
        }
        Ok(report)
    }

    /// Answers a plan without distances where they would tell hardly more than how far it is: by a way of two straight
    /// pieces, if one is open; by jump points, where little stands about.
    pub(super) fn go_without_distances(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Result<Option<Report<GridProblem>>, Unsupported> {
        let grid = problem.grid();
        if self.params.eager || !grid.is_uniform() {
            return Ok(None);
        }
        let mut way = Vec::new();
        let is_straight = Beeline::of(problem).way(problem.start(), problem.goal(), &mut way);
        let cells = u64::from(grid.width()) * u64::from(grid.height());
        let blocked = cells - u64::from(grid.free_cells());
        if !is_straight && blocked * OPEN > cells || !cx.proceed() {
            return Ok(None);
        }
        self.forget_changes();
        self.give_up(problem);
        (self.known, self.effort) = (Some(problem.stamp()), 0);
        if !is_straight {
            let report = self.auto.jump(problem, false, &mut self.last_path, cx)?;
            return Ok(Some(report));
        }
        let report = cx.answer(problem, way, Proof::Optimal);
        self.last_path.remember(problem, &report);
        Ok(Some(report))
    }

    /// Whether answers do well without distances: after a plan that took none, while jumps take little.
    pub(super) fn rests_on_jumps(&self) -> bool {
        self.is_idle() && self.jump_effort <= LITTLE && self.auto.has_jumps()
    }

    /// Makes the bits of jump points or follows what has changed with them, if there is reason to.
    pub(super) fn prepare_jumps(&mut self, problem: &GridProblem) {
        let cells = problem.grid().layout().len() as u64;
        if !self.is_idle()
            && !self.auto.is_in_use()
            && self.debt <= cells / BITS
            && self.effort <= cells / PLAN
        {
            return;
        }
        // A few changes are followed faster with those to come.
        if self.auto.has_jumps()
            && news(&self.pending, self.behind).is_some_and(|news| news.len() < SOON)
        {
            return;
        }
        self.catch_up(problem);
        // Looks at the grid anew if that did not do; there is nothing to be seen on terrain.
        self.auto.jumps(problem);
        if problem.grid().is_uniform() {
            self.is_caught_up();
        }
    }
}

/// Of the cells that changed those that who jumps does not know of yet, if the rest is known, and they are few.
fn news(pending: &[u32], known: Option<usize>) -> Option<&[u32]> {
    let news = pending.get(known?..)?;
    (news.len() <= MANY).then_some(news)
}
