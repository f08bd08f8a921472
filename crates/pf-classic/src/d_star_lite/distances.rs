//! Distances to the goal: of the last plan, until a field that can be repaired takes its place.

use pf_core::Context;
use pf_grid::{Cell, DistanceField, End, GridProblem, Layout, Search, Upkeep, Weights, Word};

/// What is known of the distances to one goal.
///
/// A plan is a search from the goal, as fast as any, that leaves distances behind but cannot be
/// repaired. A [`DistanceField`] can, and takes twice as long to make: it is made where repairs
/// are due.
#[derive(Clone, Debug)]
pub(super) struct Distances<W: Word> {
    layout: Option<Layout>,
    /// Rooted at the goal.
    search: Search<W>,
    /// The start that the search was for and its distance, [`Word::MAX`] if the goal is out of
    /// reach from there; while the search is what is known.
    planned: Option<(Cell, W)>,
    field: DistanceField<W>,
}

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

    /// Makes them anew, to answer from.
    pub(super) fn plan(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> End<W> {
        self.layout = Some(*problem.grid().layout());
        self.field.forget();
        self.planned = None;
        let (grid, start) = (problem.grid(), problem.start());
        // Steps weigh the same both ways.
        let octile = Weights::of(grid).octile::<W>(grid, problem.moves(), start);
        let id = grid.layout().id(start);
        // As if the last step weighed a little more: so that it goes on to every cell on any of the
        // shortest paths. Whoever leaves one of them soon finds the others.
        let arrive = |at, _| (at == id).then_some(W::ONE);
        let end = self
            .search
            .run_until(problem, problem.goal(), |at| Some(octile(at)), arrive, cx);
        self.planned = match end {
            End::Goal(whole) => Some((start, whole - W::ONE)),
            End::Exhausted => Some((start, W::MAX)),
            End::Cut | End::TooFar => None,
        };
        end
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
        self.planned.or_else(|| self.field.settled())
    }

    /// See [`DistanceField::estimate`].
    #[inline]
    pub(super) fn estimate(&self, id: u32, to_goal: W, to_start: W) -> (W, bool) {
        match self.planned {
            Some((_, whole)) => self.search.estimate(id, whole, to_goal, to_start),
            None => self.field.estimate(id, to_goal, to_start),
        }
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
