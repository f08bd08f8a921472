//! Freed cells over which nothing becomes shorter.

use super::Distances;
use pf_grid::{GridProblem, Moves, Weights, Word};

impl<W: Word> Distances<W> {
    /// Takes a cell that was freed up among the distances of a plan, if none of them is shorter over it: what was known
    /// holds then as if the cell had been free. Steps from and to cells that are `apart` do not count, nor do its own that pass one.
    ///
    /// Whatever is a bound from below on what is left, says 0 at the goal and falls by no more than any step weighs, stays
    /// one while that is true of new steps, too: those from and to the cell, and the diagonal ones that pass it.
    pub(in super::super) fn take_up(
        &mut self,
        problem: &GridProblem,
        id: u32,
        apart: impl Fn(u32) -> bool,
    ) -> bool {
        let grid = problem.grid();
        let Some(planned) = self.planned.filter(|_| grid.is_uniform()) else {
            return false;
        };
        let (layout, moves) = (grid.layout(), problem.moves());
        let (offsets, weights) = (layout.offsets(), Weights::of(grid));
        let octile = |cell| weights.octile::<W>(grid, moves, cell);
        let (to_goal, to_start) = (octile(problem.goal()), octile(planned.start));
        let left = |at: u32| self.estimate(at, to_goal(at), to_start(at));
        let beside = |k: usize| id.wrapping_add_signed(offsets[k]);
        // Diagonal steps that pass a cell that is apart are that one's: both ends lie beside it.
        let counts = |&(k, next): &(usize, u32)| {
            let passes = || apart(beside(k - 4)) || apart(beside((k - 3) % 4));
            !apart(next) && (k < 4 || !passes())
        };
        let legal = moves.legal(grid.around_id(id));
        let steps = || {
            let legal = (0..8).filter(|k| legal >> k & 1 == 1);
            legal.map(|k| (k, beside(k))).filter(counts)
        };
        let weight = |k: usize| if k < 4 { W::STRAIGHT } else { W::DIAGONAL };
        let falls = |from: W, to: W, by: W| to < W::MAX && from > to + by;

        // What is left from there.
        let reached = self.search.weight(id);
        let over = steps().map(|(k, next)| (left(next).0, weight(k)));
        let over = over.filter(|&(rest, _)| rest < W::MAX);
        let new = || over.map(|(rest, by)| rest + by).min();
        let least = reached.or_else(new).unwrap_or(W::MAX);
        let is_shorter = |(k, next)| {
            let (rest, _) = left(next);
            falls(rest, least, weight(k)) || falls(least, rest, weight(k))
        };
        if steps().any(is_shorter) {
            return false;
        }
        for side in 0..if moves == Moves::Orthogonal { 0 } else { 4 } {
            // From the neighbour on one side to that on the next.
            let [from, to] = [side, (side + 1) % 4].map(beside);
            let k = 4 + (side + 1) % 4;
            let is_legal = grid.is_free_id(from) && moves.legal(grid.around_id(from)) >> k & 1 == 1;
            if is_legal && !apart(from) && !apart(to) {
                let [from, to] = [left(from).0, left(to).0];
                if falls(from, to, W::DIAGONAL) || falls(to, from, W::DIAGONAL) {
                    return false;
                }
            }
        }
        // Otherwise no more is known of it than of cells that the plan did not expand.
        let is_known = || planned.whole == W::MAX || least + to_start(id) < planned.known;
        if reached.is_none() && least < W::MAX && is_known() {
            self.search.insert(id, least);
        }
        true
    }
}
