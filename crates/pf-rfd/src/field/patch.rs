//! Ways over freed cells: what one would cost at the least, and the best there is.

use super::{
    basin::{Side, clamped},
    marks::Marks,
};
use pf_core::Context;
use pf_grid::{Distances, End, GridProblem, Search, Weights, Word};

/// The places where old ways end and begin that a new one may join.
///
/// A way that uses what was freed has a first such step and a last one. Before the first it goes as
/// ways went, at no less than the start's field says; after the last at no less than the goal's
/// does; between the two at no less than as if nothing stood in it. That is the certificate: where
/// no such sum is less than what the old way costs, that is still best. Where one is, a search goes
/// on from the first places, directed by the last ones, so that it ends at once where the way
/// between them is as short as it looks.
///
/// Source: ours; the field between is that of Borgefors' transforms, place by place.
#[derive(Clone, Debug, Default)]
pub(super) struct Patch<W> {
    /// Where an old way may be left: an id, and the way there from the start.
    seeds: Vec<(u32, W)>,
    /// Where one may be joined: column and row, and the way from there to the goal.
    exits: Vec<((u32, u32), W)>,
}

/// With more freed cells, or more places to join an old way, than that the certificate costs more
/// than a window around them.
const MOST_CELLS: usize = 256;
const MOST_EXITS: usize = 48;

impl<W: Word> Patch<W> {
    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        self.seeds.capacity() * size_of::<(u32, W)>()
            + self.exits.capacity() * size_of::<((u32, u32), W)>()
    }

    /// Looks around the changed cells for what may lead to less than `best`; `fields` and `ends` are
    /// the start's and the goal's. Says whether there was little enough to look at.
    pub(super) fn look(
        &mut self,
        problem: &GridProblem,
        changed: &[u32],
        weights: Weights,
        fields: [&Distances<W>; 2],
        best: W,
        ends: [u32; 2],
    ) -> bool {
        self.seeds.clear();
        self.exits.clear();
        if changed.len() > MOST_CELLS {
            return false;
        }
        let grid = problem.grid();
        let layout = grid.layout();
        let apart = weights.apart::<W>(problem.moves());
        let by =
            |(ax, ay): (u32, u32), (bx, by): (u32, u32)| apart.by(ax.abs_diff(bx), ay.abs_diff(by));
        let ends = ends.map(|id| layout.position(id));
        let [from_start, to_goal] = fields;
        let offsets = layout.offsets();
        let near = |&id: &u32| {
            let around = offsets.map(|offset| id.wrapping_add_signed(offset));
            std::iter::once(id).chain(around)
        };
        let freed = || changed.iter().filter(|&&id| grid.is_free_id(id));
        for id in freed().flat_map(near) {
            let left = to_goal.at(id);
            if left == W::MAX || !grid.is_free_id(id) {
                continue;
            }
            let at = layout.position(id);
            let beaten = |&(other, rest): &((u32, u32), W)| rest + by(at, other) <= left;
            if by(ends[0], at) + left >= best || self.exits.iter().any(beaten) {
                continue;
            }
            self.exits
                .retain(|&(other, rest)| left + by(at, other) > rest);
            self.exits.push((at, left));
            if self.exits.len() > MOST_EXITS {
                return false;
            }
        }
        if self.exits.is_empty() {
            return true;
        }
        for id in freed().flat_map(near) {
            let g = from_start.at(id);
            if g == W::MAX || !grid.is_free_id(id) {
                continue;
            }
            let at = layout.position(id);
            if g + by(at, ends[1]) < best && g + self.least(at, by) < best {
                self.seeds.push((id, g));
            }
        }
        true
    }

    /// The least way on from a place over a freed cell, as if nothing stood in it.
    #[inline]
    fn least(&self, at: (u32, u32), by: impl Fn((u32, u32), (u32, u32)) -> W) -> W {
        let over = self.exits.iter().map(|&(other, rest)| by(at, other) + rest);
        over.min().unwrap_or(W::LIMIT)
    }

    /// Searches from the seeds for a way that weighs less than `best`, to where an old way to the
    /// goal holds. `goals` is the side of the goal, whose root the marks' id is.
    pub(super) fn search(
        &self,
        problem: &GridProblem,
        goals: &Side<W>,
        best: W,
        search: &mut Search<W>,
        (marks, root): (&mut Marks, u32),
        cx: &mut Context<'_, GridProblem>,
    ) -> End<W> {
        if self.seeds.is_empty() {
            return End::Exhausted;
        }
        let layout = *problem.grid().layout();
        let weights = goals
            .field
            .basis()
            .map_or_else(|| Weights::of(problem.grid()), |(_, weights)| weights);
        let apart = weights.apart::<W>(problem.moves());
        let by =
            |(ax, ay): (u32, u32), (bx, by): (u32, u32)| apart.by(ax.abs_diff(bx), ay.abs_diff(by));
        let heuristic = |id: u32| {
            let over = self.least(layout.position(id), by);
            clamped(goals.field.at(id).min(over))
        };
        let downhill = goals.field.downhill(problem);
        if goals.closed {
            marks.clear(layout.len());
        }
        let mut least = best;
        let arrive = |id: u32, g: W| {
            let left = goals.field.at(id);
            if left < W::MAX
                && g + left < least
                && (!goals.closed || marks.is_intact(&downhill, id, root))
            {
                least = g + left;
                return Some(left);
            }
            heuristic(id).filter(|&rest| g + rest >= least)
        };
        search.run_from(problem, &self.seeds, best, heuristic, arrive, cx)
    }
}
