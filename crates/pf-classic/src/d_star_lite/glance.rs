//! What D\* Lite sees without a search.

use super::DStarLite;
use pf_core::{Context, Revision};
use pf_grid::{Beeline, Bend, Confines, GridProblem, Hold};

/// More changed cells than that are noted, so that they need not be looked through again and again.
const LONG: usize = 1 << 10;
/// From so many changed cells on, what they did to the distances takes longer to say than whether there is a way out
/// at all,
const MUCH: usize = 256;
/// where most of so many of them lie around the robot,
const SAMPLE: usize = 16;
/// and no more than so many looks at a row are taken: some 10 us.
const LOOKS: u32 = 1 << 10;

impl DStarLite {
    /// Whether what is left of the last path is best: nothing was freed, or no way over what was can be shorter. That
    /// need not be noted then.
    pub(super) fn still_best(&mut self, revision: &Revision<'_, GridProblem>) -> bool {
        // Else a search may come first, and distances after it.
        let jump = self.rests_on_jumps().then_some(self.jump_effort);
        let how = jump.map_or(Bend::Far, Bend::to_spare);
        match self.last_path.follow(revision, how) {
            Hold::Best => true,
            Hold::Legal if self.is_straight(revision.problem()) => true,
            Hold::Legal if self.pending.len() - self.told <= LONG => {
                self.leave_none_shorter(revision.problem())
            }
            Hold::Legal | Hold::Broken | Hold::Gone => false,
        }
    }

    /// Whether what is left of the last path is as short as if nothing stood about.
    fn is_straight(&self, problem: &GridProblem) -> bool {
        let least = Beeline::of(problem).cost(problem.start(), problem.goal());
        self.last_path.cost() == least
    }

    /// Whether much has just changed around the robot, in so many of the pending cells, and is seen to leave no way out.
    pub(super) fn is_shut_in(
        &mut self,
        problem: &GridProblem,
        news: usize,
        cx: &mut Context<'_, GridProblem>,
    ) -> bool {
        let news = &self.pending[self.pending.len() - news..];
        if news.len() < MUCH {
            return false;
        }
        let (layout, robot) = (problem.grid().layout(), problem.start());
        let sample = news.iter().step_by(news.len() / SAMPLE).take(SAMPLE);
        let is_near = |&&id: &&u32| Confines::are_around(robot, layout.cell(id));
        let near = sample.filter(is_near).count();
        if near <= SAMPLE / 2 || !cx.proceed() {
            return false;
        }
        let cells = self.confines.measure(problem, LOOKS);
        cells.inspect(|&cells| cx.visited(cells.into())).is_some()
    }
}
