//! What changes do to what is known of the distances.

use super::Guided;
use pf_grid::{Cell, Damage, GridCost, GridProblem, Weights, Word};

/// So many freed cells are looked at one by one.
const FEW: usize = 64;

/// Cells that were freed since the distances were made.
#[derive(Clone, Debug, Default)]
pub(super) struct Freed {
    /// Ids of those over which something may be shorter, as [`Damage`] knows; if they are more than a [`FEW`], of
    /// some of them.
    openers: Vec<u32>,
    /// Those among the last changes.
    fresh: Vec<u32>,
    scratch: Vec<u32>,
}

impl Freed {
    /// None.
    pub(super) fn clear(&mut self) {
        self.openers.clear();
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        let all = [&self.openers, &self.fresh, &self.scratch];
        all.map(Vec::capacity).iter().sum::<usize>() * size_of::<u32>()
    }
}

impl<W: Word> Guided<W> {
    /// Takes note of further changed cells.
    pub(super) fn note(&mut self, problem: &GridProblem, changed: &[u32]) {
        let Some((_, weights)) = self.basis else {
            return;
        };
        self.route.check(problem, changed, weights);
        let are_few = self.take_up(problem, changed);
        let grid = problem.grid();
        let Freed { fresh, openers, .. } = &mut self.freed;
        let room = (FEW + 1).saturating_sub(openers.len());
        openers.extend(fresh.iter().take(room));
        let mut rest = std::mem::take(&mut self.freed.scratch);
        rest.clear();
        if are_few {
            let counts = |id: &u32| !grid.is_free_id(*id) || self.freed.fresh.contains(id);
            rest.extend(changed.iter().copied().filter(counts));
        }
        let counted = if are_few { &rest } else { changed };
        let mut damage = std::mem::take(&mut self.damage);
        {
            let before = self.before(problem, weights);
            let before = |at, id| {
                let (heuristic, (left, _)) = before(at, id);
                (heuristic, left)
            };
            damage.add(problem, problem.goal(), counted, weights, before);
        }
        (self.damage, self.freed.scratch) = (damage, rest);
    }

    /// Of a place, its column, row and id, what the heuristic says; and what was left when the distances were made, and
    /// `true`, or a bound of it from below, and `false`.
    pub(super) fn before<'s>(
        &'s self,
        problem: &GridProblem,
        weights: Weights,
    ) -> impl Fn((u32, u32), u32) -> (W, (W, bool)) + use<'s, W> {
        let layout = *problem.grid().layout();
        let apart = weights.apart::<W>(problem.moves());
        let to = |cell: Cell| {
            let (x, y) = layout.position(layout.id(cell));
            move |(a, b): (u32, u32)| apart.by(a.abs_diff(x), b.abs_diff(y))
        };
        let (to_goal, to_start) = (to(problem.goal()), to(self.anchor(problem)));
        move |at, id| {
            let heuristic = to_goal(at);
            let left = self.distances.estimate(id, heuristic, to_start(at));
            (heuristic, left)
        }
    }

    /// Whether, after these further changes, no way from the start is shorter than one that costs so much, as far as
    /// that is seen at a glance. They need not have been noted, nor are they then.
    pub(in super::super) fn leave_none_shorter(
        &mut self,
        problem: &GridProblem,
        changed: &[u32],
        cost: GridCost,
    ) -> bool {
        let Some((_, weights)) = self.basis.filter(|_| self.knows(problem)) else {
            return false;
        };
        let Some(whole) = weights.of_cost::<W>(cost) else {
            return false;
        };
        self.learn();
        if !self.take_up(problem, changed) {
            return false;
        }
        let layout = problem.grid().layout();
        let start = layout.id(problem.start());
        // Over what was noted, or was free before; then over the rest.
        if self.bound(problem)(start, false).0 < whole {
            return false;
        }
        let before = self.before(problem, weights);
        let left = |at, id| before(at, id).1.0;
        let way = (layout.position(start), whole);
        Damage::spares(problem, way, &self.freed.fresh, weights, left)
    }

    /// Takes those of further changed cells that were freed up among the distances, where nothing becomes shorter over
    /// them; the others are `fresh` then. Not if they or the openers are many, and says so by `false`.
    fn take_up(&mut self, problem: &GridProblem, changed: &[u32]) -> bool {
        let (grid, damage) = (problem.grid(), &self.damage);
        let layout = grid.layout();
        let Freed {
            openers,
            fresh,
            scratch: freed,
        } = &mut self.freed;
        freed.clear();
        freed.extend(changed.iter().copied().filter(|&id| grid.is_free_id(id)));
        if !freed.is_empty() {
            self.learned.forget();
        }
        fresh.clear();
        if freed.len().max(openers.len()) > FEW {
            fresh.extend_from_slice(freed);
            return false;
        }
        for (at, &id) in freed.iter().enumerate() {
            let is_opener = |near: &u32| openers.contains(near);
            let around = layout
                .offsets()
                .map(|offset| id.wrapping_add_signed(offset));
            let is_bound = is_opener(&id)
                || around.iter().any(is_opener)
                || damage.rests_on(layout.position(id));
            // What comes later looks at the steps between the two.
            let apart = |near| fresh.contains(&near) || freed[at + 1..].contains(&near);
            if is_bound || !self.distances.take_up(problem, id, apart) {
                fresh.push(id);
            }
        }
        true
    }
}
