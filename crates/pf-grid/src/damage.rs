//! What changed since a distance field was made, and what that does to its distances.

use crate::{GridProblem, Moves, Weights, Word};

/// The changes since distances to a goal were known, boiled down to what bounds the distances now.
///
/// A path that uses nothing that became cheaper or free is no shorter than it was. One that does
/// ends, after the last such step, near a changed cell and goes on at no less than was left there
/// before: [`bound`](Self::bound) is the least of that. And where less was left than at every
/// changed cell, nothing changed: [`is_below`](Self::is_below).
///
/// Source: the bounds are ours; the idea of heuristics that stay admissible is that of Koenig and
/// Likhachev, *Adaptive A\**, 2005, and Hernandez, Asin, Baier, *MPAA\**, 2014.
#[derive(Clone, Debug)]
pub struct Damage<W> {
    /// Less was left nowhere among the changed cells.
    below: W,
    openings: Option<Openings<W>>,
}

/// The cells near what became free or cheaper, from which old ways go on.
#[derive(Clone, Debug)]
struct Openings<W> {
    /// The least that was left at any of them.
    least: W,
    /// The least of what was left above the heuristic.
    excess: W,
    /// The columns and rows between which they lie.
    columns: [u32; 2],
    rows: [u32; 2],
}

impl<W: Word> Default for Damage<W> {
    fn default() -> Self {
        Self {
            below: W::MAX,
            openings: None,
        }
    }
}

impl<W: Word> Damage<W> {
    /// Takes note of changed cells. `before` says of an id what the heuristic says and what was
    /// left before anything changed, or a bound of it from below. Says whether any of them may have
    /// made something shorter.
    pub fn add(
        &mut self,
        problem: &GridProblem,
        changed: &[u32],
        before: impl Fn(u32) -> (W, W),
    ) -> bool {
        let grid = problem.grid();
        let offsets = grid.layout().offsets();
        let uniform = Weights::of(grid).is_uniform();
        let mut opened = false;
        for &id in changed {
            let (_, left) = before(id);
            self.below = self.below.min(left);
            let around = offsets.map(|offset| id.wrapping_add_signed(offset));
            if !uniform {
                // A blocked cell also hinders diagonal steps that pass it. Without terrain less was
                // left at such a cell than where the step begins, with terrain it may be dear.
                for near in around {
                    self.below = self.below.min(before(near).1);
                }
            }
            if !grid.is_free_id(id) {
                continue;
            }
            opened = true;
            // A freed cell also allows diagonal steps that pass it, between its neighbours.
            for near in around.into_iter().filter(|&near| grid.is_free_id(near)).chain([id]) {
                let (heuristic, left) = before(near);
                if left != W::MAX {
                    self.open(grid.layout().position(near), left, left.max(heuristic) - heuristic);
                }
            }
        }
        opened
    }

    fn open(&mut self, (x, y): (u32, u32), left: W, excess: W) {
        let all = self.openings.get_or_insert(Openings {
            least: left,
            excess,
            columns: [x, x],
            rows: [y, y],
        });
        all.least = all.least.min(left);
        all.excess = all.excess.min(excess);
        all.columns = [all.columns[0].min(x), all.columns[1].max(x)];
        all.rows = [all.rows[0].min(y), all.rows[1].max(y)];
    }

    /// Whether nothing changed for a cell from which `left` was left.
    #[inline]
    #[must_use]
    pub fn is_below(&self, left: W) -> bool {
        left < self.below
    }

    /// A bound from below on every path from a place that uses what became free or cheaper, as a
    /// function of the place's column, its row and the heuristic there. It is consistent if the
    /// heuristic is.
    pub fn bound(&self, weights: Weights, moves: Moves) -> impl Fn((u32, u32), W) -> W + use<W> {
        let apart = weights.apart::<W>(moves);
        let openings = self.openings.clone();
        move |(x, y), heuristic| {
            let Some(all) = &openings else {
                return W::MAX;
            };
            let out = |at: u32, [from, to]: [u32; 2]| from.max(at) - at + (at.max(to) - to);
            let there = apart(out(x, all.columns), out(y, all.rows)) + all.least;
            there.max(heuristic + all.excess)
        }
    }

    /// Whether at least half of what was known above the heuristic still holds near what became
    /// free or cheaper; `known` is the heuristic's value somewhere and what was known there.
    pub fn leaves(&self, known: impl FnOnce() -> (W, W)) -> bool {
        self.openings.as_ref().is_none_or(|all| {
            let (heuristic, known) = known();
            all.excess + all.excess >= known.max(heuristic) - heuristic
        })
    }
}

