//! Freed cells over which nothing becomes shorter.

use super::Distances;
use pf_grid::{GridProblem, Moves, Weights, Word};

impl<W: Word> Distances<W> {
    /// Takes a cell that was freed up among the distances of a plan, if none of them is shorter over it: what was known
    /// holds then as if the cell had been free. Steps from and to cells that are `apart` do not count.
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
        // Diagonal steps that pass a cell that is apart stand and fall with it.
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

        // What is left from there, if it was free before; or else over which step how much is.
        let mut least = self.search.weight(id).unwrap_or(W::MAX);
        let (was_free, mut over) = (least < W::MAX, None);
        for (k, next) in steps().filter(|_| !was_free) {
            let (rest, is_exact) = left(next);
            if rest < W::MAX && rest + weight(k) <= least {
                let is_less = rest + weight(k) < least;
                least = rest + weight(k);
                over = is_exact.then_some(k).or(over.filter(|_| !is_less));
            }
        }
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
        if let Some(k) = over
            && (planned.whole == W::MAX || least + to_start(id) <= planned.known)
        {
            self.search.insert(id, least, k & 4 | (k + 2) & 3);
        }
        true
    }
}
