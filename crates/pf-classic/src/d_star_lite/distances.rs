//! Distances to the goal: of the last plan, until a field that can be repaired takes its place.

mod harmless;

use pf_core::{Context, Stamp};
use pf_grid::{Cell, DistanceField, End, GridProblem, Layout, Search, Upkeep, Weights, Word};

/// What is known of the distances to one goal.
///
/// A plan is a search from the goal, as fast as any, that leaves distances behind but cannot be
/// repaired. A [`DistanceField`] can, and takes twice as long to make: it is made where repairs
/// are due.
#[derive(Clone, Debug)]
pub(super) struct Distances<W: Word> {
    layout: Option<Layout>,
    /// A plan's, rooted at the goal; or, while nothing is known, one from the start.
    search: Search<W>,
    /// While it is a plan's.
    planned: Option<Planned<W>>,
    field: DistanceField<W>,
}

/// What a search was for, and what it found.
#[derive(Clone, Copy, Debug)]
struct Planned<W> {
    grid: Stamp,
    start: Cell,
    /// The start's distance, [`Word::MAX`] if the goal is out of reach from there.
    whole: W,
    /// Every cell was expanded over which a path from the start is shorter than that.
    known: W,
    /// So many expansions may be spent on others.
    spare: u64,
}

/// How far beyond the shortest paths from the start what lies near them is looked at, in straight steps: a
/// detour of half as many there and back.
const AROUND: u32 = 64;
/// So many expansions are always worth it.
const LEAST: u64 = 1 << 10;

impl<W: Word> Default for Distances<W> {
    fn default() -> Self {
        Self {
            layout: None,
            search: Search::default(),
            planned: None,
            field: DistanceField::default(),
        }
    }
}

impl<W: Word> Distances<W> {
    /// Whether they lie over a grid of the problem's shape.
    pub(super) fn cover(&self, problem: &GridProblem) -> bool {
        self.layout == Some(*problem.grid().layout())
    }

    /// Whether they can be repaired into those of `problem`.
    pub(super) fn serve(&self, problem: &GridProblem) -> bool {
        self.field.serves(problem)
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        self.search.bytes() + self.field.bytes()
    }

    /// Gives them up, and makes none of a problem.
    pub(super) fn give_up(&mut self, problem: &GridProblem) {
        self.layout = Some(*problem.grid().layout());
        self.forget();
    }

    fn forget(&mut self) {
        self.field.forget();
        self.planned = None;
    }

    /// Gives them up for a search from the start, in the memory of the plan: what it touches is at hand.
    pub(super) fn start_over(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> End<W> {
        self.layout = Some(*problem.grid().layout());
        self.forget();
        self.search.find(problem, cx)
    }

    /// The steps on which that search reached an id, see [`Search::back`].
    pub(super) fn way_back(&self, id: u32) -> impl Iterator<Item = (u32, W, u32)> + '_ {
        self.search.back(id)
    }

    /// Makes them anew, to answer from.
    pub(super) fn plan(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> End<W> {
        self.layout = Some(*problem.grid().layout());
        self.forget();
        let (grid, start) = (problem.grid(), problem.start());
        // Steps weigh the same both ways.
        let octile = Weights::of(grid).octile::<W>(grid, problem.moves(), start);
        let id = grid.layout().id(start);
        let arrive = |at, _| (at == id).then(W::default);
        let before = cx.stats().expanded;
        let end =
            self.search
                .run_keeping(problem, problem.goal(), |at| Some(octile(at)), arrive, cx);
        let whole = match end {
            End::Goal(whole) => whole,
            End::Exhausted => W::MAX,
            End::Cut | End::TooFar => return end,
        };
        self.planned = Some(Planned {
            grid: grid.stamp(),
            start,
            whole,
            known: whole,
            spare: (cx.stats().expanded - before).max(LEAST),
        });
        end
    }

    /// Lets a plan go on, if nothing has changed since, to cells near the shortest paths: for no more than it has
    /// taken. Whoever leaves a path, or finds it blocked, is soon among cells whose distances are known.
    pub(super) fn look_around(&mut self, problem: &GridProblem, cx: &mut Context<'_, GridProblem>) {
        let grid = problem.grid();
        let Some(planned) = &mut self.planned else {
            return;
        };
        if planned.grid != grid.stamp() || planned.spare == 0 || planned.whole == W::MAX {
            return;
        }
        let weights = Weights::of(grid);
        let octile = weights.octile::<W>(grid, problem.moves(), planned.start);
        let around = weights.apart::<W>(problem.moves()).by(AROUND, 0);
        let until = (planned.whole + around).min(W::LIMIT);
        let search = &mut self.search;
        let reach = (planned.known, until);
        let before = cx.stats().expanded;
        planned.known = cx.at_most(planned.spare, |cx| {
            search.go_on(problem, reach, |at| Some(octile(at)), cx)
        });
        planned.spare -= cx.stats().expanded - before;
    }

    /// Makes them anew, to repair.
    pub(super) fn found(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Upkeep {
        self.layout = Some(*problem.grid().layout());
        self.planned = None;
        self.field.plan(problem, cx)
    }

    /// See [`DistanceField::repair`].
    pub(super) fn repair(
        &mut self,
        problem: &GridProblem,
        changed: &[u32],
        most: u64,
        cx: &mut Context<'_, GridProblem>,
    ) -> Upkeep {
        self.planned = None;
        self.field.repair(problem, changed, most, cx)
    }

    /// See [`DistanceField::prepare`].
    pub(super) fn prepare(&mut self, problem: &GridProblem) {
        self.field.prepare(problem);
    }

    /// See [`DistanceField::is_too_narrow`].
    pub(super) fn are_too_narrow(&self, start: Cell) -> bool {
        self.planned.is_none() && self.field.is_too_narrow(start)
    }

    /// See [`DistanceField::settled`].
    #[inline]
    pub(super) fn settled(&self) -> Option<(Cell, W)> {
        match self.planned {
            Some(planned) => Some((planned.start, planned.whole)),
            None => self.field.settled(),
        }
    }

    /// See [`DistanceField::estimate`].
    #[inline]
    pub(super) fn estimate(&self, id: u32, to_goal: W, to_start: W) -> (W, bool) {
        match self.planned {
            Some(planned) => self.search.estimate(id, planned.known, to_goal, to_start),
            None => self.field.estimate(id, to_goal, to_start),
        }
    }

    /// Appends the ids of a plan's path from one on to the goal, if they are of a plan.
    pub(super) fn trace(&self, id: u32, ids: &mut Vec<u32>) -> bool {
        if self.planned.is_some() {
            ids.push(id);
            ids.extend(self.search.back(id).map(|(from, ..)| from));
        }
        self.planned.is_some()
    }

    /// See [`DistanceField::next`].
    pub(super) fn next(&self, problem: &GridProblem, id: u32, left: W) -> Option<(u32, W)> {
        if self.planned.is_some() {
            self.search.next(problem, id, left)
        } else {
            self.field.next(problem, id, left)
        }
    }
}
