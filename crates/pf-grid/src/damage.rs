//! What changed since a distance field was made, and what that does to its distances.

use crate::{Apart, GridProblem, Moves, Weights, Word};
use std::cell::Cell as Memo;

/// The changes since distances to a goal were known, boiled down to what bounds the distances now.
///
/// A path that uses nothing that became cheaper or free is no shorter than it was. One that does
/// comes, after the last such step, to a place near a changed cell from which it goes on as before:
/// [`bound`](Self::bound) is the least that can cost, as if nothing stood in the way there. And
/// where less was left than at every changed cell, nothing changed: [`is_below`](Self::is_below).
///
/// Source: ours. Heuristics that stay admissible as a map changes are those of Koenig and Likhachev,
/// *Adaptive A\**, 2005.
#[derive(Clone, Debug)]
pub struct Damage<W: Copy> {
    /// Less was left nowhere among the changed cells.
    below: W,
    openings: Option<Openings<W>>,
    /// Scratch: places and what was left there.
    seeds: Vec<(u32, u32, W)>,
}

/// The places near what became free or cheaper, from which old ways go on.
#[derive(Clone, Debug)]
struct Openings<W: Copy> {
    /// The least that was left at any of them.
    least: W,
    /// The least of what was left above the heuristic.
    excess: W,
    window: Window,
    /// By place in the window the least of what was left at a place and the way there; empty if
    /// the window is too large.
    left: Vec<W>,
    /// By place the lesser of that and what was left there, once it was asked for.
    both: Vec<Memo<W>>,
}

/// Columns and rows, first and last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Window {
    columns: [u32; 2],
    rows: [u32; 2],
}

/// A window of that many places is looked at place by place however few changed cells there are,
const FEW_PLACES: usize = 1 << 12;
/// and one of that many for each of them.
const PLACES_EACH: usize = 16;
/// That many changed cells spread over a larger window are taken to change everything.
const MOST_SPREAD: usize = 256;

impl<W: Word> Default for Damage<W> {
    fn default() -> Self {
        Self {
            below: W::MAX,
            openings: None,
            seeds: Vec::new(),
        }
    }
}

impl<W: Word> Damage<W> {
    /// No damage.
    pub fn clear(&mut self) {
        self.below = W::MAX;
        self.openings = None;
    }

    /// Takes note of changed cells. `before` says of an id what the heuristic says and what was
    /// left before anything changed, or a bound of it from below. Says whether any of them may have
    /// made something shorter.
    pub fn add(
        &mut self,
        problem: &GridProblem,
        changed: &[u32],
        weights: Weights,
        before: impl Fn(u32) -> (W, W),
    ) -> bool {
        let grid = problem.grid();
        let layout = grid.layout();
        let free = changed.iter().filter(|&&id| grid.is_free_id(id));
        let mut window = None;
        for &id in free {
            let (x, y) = layout.position(id);
            // Its neighbours, too, within the border.
            Window::hold(&mut window, (x - 1, y - 1));
            Window::hold(&mut window, (x + 1, y + 1));
        }
        let most = FEW_PLACES + PLACES_EACH * changed.len();
        if window.is_some_and(|all| all.places() > most) && changed.len() > MOST_SPREAD {
            self.below = W::default();
            self.openings = window.map(|window| Openings {
                least: W::default(),
                excess: W::default(),
                window,
                left: Vec::new(),
                both: Vec::new(),
            });
            return true;
        }
        let offsets = layout.offsets();
        let mut seeds = std::mem::take(&mut self.seeds);
        seeds.clear();
        for &id in changed {
            let (_, left) = before(id);
            self.below = self.below.min(left);
            let around = offsets.map(|offset| id.wrapping_add_signed(offset));
            if !weights.is_uniform() {
                // A blocked cell also hinders diagonal steps that pass it. Without terrain less was
                // left at such a cell than where the step begins, with terrain it may be dear.
                for near in around {
                    self.below = self.below.min(before(near).1);
                }
            }
            if !grid.is_free_id(id) {
                continue;
            }
            // A freed cell also allows diagonal steps that pass it, between its neighbours.
            let free = around.into_iter().filter(|&near| grid.is_free_id(near));
            for near in free.chain([id]) {
                let (heuristic, left) = before(near);
                if left != W::MAX {
                    let (x, y) = layout.position(near);
                    seeds.push((x, y, left));
                    let excess = left.max(heuristic) - heuristic;
                    let all = self.openings.get_or_insert_with(|| Openings::at((x, y), left));
                    all.least = all.least.min(left);
                    all.excess = all.excess.min(excess);
                }
            }
        }
        if let (Some(all), Some(window)) = (&mut self.openings, window) {
            all.widen(window, most, &seeds, weights.apart(problem.moves()));
        }
        self.seeds = seeds;
        window.is_some()
    }

    /// Whether nothing changed for a cell from which `left` was left.
    #[inline]
    #[must_use]
    pub fn is_below(&self, left: W) -> bool {
        left < self.below
    }

    /// Bounds from below on what is left now.
    #[must_use]
    pub fn bound(&self, weights: Weights, moves: Moves) -> Bound<'_, W> {
        Bound {
            openings: self.openings.as_ref(),
            apart: weights.apart(moves),
        }
    }

    /// Whether at least half of what was known above the heuristic still holds near what became
    /// free or cheaper: there the heuristic said `heuristic`, and `known` was known.
    #[must_use]
    pub fn leaves(&self, heuristic: W, known: W) -> bool {
        self.openings.as_ref().is_none_or(|all| {
            !all.left.is_empty() || all.excess + all.excess >= known.max(heuristic) - heuristic
        })
    }

    /// Bytes held.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let window = self.openings.as_ref().map_or(0, |all| all.left.capacity());
        window * size_of::<W>() + self.seeds.capacity() * size_of::<(u32, u32, W)>()
    }
}

/// See [`Damage::bound`].
#[derive(Clone, Copy, Debug)]
pub struct Bound<'d, W: Copy> {
    openings: Option<&'d Openings<W>>,
    apart: Apart<W>,
}

impl<W: Word> Bound<'_, W> {
    /// A bound from below on every path from a place, given its column and its row, and what the
    /// heuristic says there and what was left before, as in [`Damage::add`].
    #[inline]
    pub fn at(&self, (x, y): (u32, u32), before: impl FnOnce() -> (W, W)) -> W {
        let Some(all) = self.openings else {
            return before().1;
        };
        let out = |at: u32, [from, to]: [u32; 2]| from.max(at) - at + (at.max(to) - to);
        let (dx, dy) = (out(x, all.window.columns), out(y, all.window.rows));
        if dx > 0 || dy > 0 || all.left.is_empty() {
            let (heuristic, left) = before();
            return left.min((self.apart.by(dx, dy) + all.least).max(heuristic + all.excess));
        }
        let place = all.window.place((x, y));
        let known = all.both[place].get();
        if known < W::MAX {
            return known;
        }
        let both = all.left[place].min(before().1);
        all.both[place].set(both);
        both
    }
}

impl<W: Word> Openings<W> {
    fn at((x, y): (u32, u32), left: W) -> Self {
        Self {
            least: left,
            excess: left,
            window: Window {
                columns: [x, x],
                rows: [y, y],
            },
            left: vec![left],
            both: vec![Memo::new(W::MAX)],
        }
    }

    /// Takes in a window and what was left at places in it.
    fn widen(
        &mut self,
        more: Window,
        most: usize,
        seeds: &[(u32, u32, W)],
        apart: Apart<W>,
    ) {
        let old = self.window;
        let mut all = Some(old);
        Window::hold(&mut all, (more.columns[0], more.rows[0]));
        Window::hold(&mut all, (more.columns[1], more.rows[1]));
        self.window = all.unwrap_or(old);
        if self.left.is_empty() || self.window.places() > most {
            self.left.clear();
            self.both.clear();
            return;
        }
        let known = std::mem::take(&mut self.left);
        self.left.resize(self.window.places(), Self::far());
        for y in old.rows[0]..=old.rows[1] {
            let (from, to) = (old.place((old.columns[0], y)), old.place((old.columns[1], y)));
            let at = self.window.place((old.columns[0], y));
            self.left[at..=at + to - from].copy_from_slice(&known[from..=to]);
        }
        for &(x, y, left) in seeds {
            let place = &mut self.left[self.window.place((x, y))];
            *place = left.min(*place);
        }
        self.spread(apart.by(1, 0), apart.by(1, 1));
        self.both.clear();
        self.both.resize(self.left.len(), Memo::new(W::MAX));
    }

    /// More than any path weighs, and yet far enough from overflow.
    fn far() -> W {
        W::LIMIT + W::LIMIT
    }

    /// To every place the least of every other and the way from there, in two passes.
    ///
    /// Source: Borgefors, *Distance transformations in digital images*, 1986.
    fn spread(&mut self, straight: W, diagonal: W) {
        let width = self.window.width();
        let far = Self::far();
        for pass in 0..2 {
            // The second pass is the first one in a window turned half round.
            let mut above: Vec<W> = vec![far; width + 2];
            let rows = self.left.chunks_exact_mut(width);
            let mut lower = |row: &mut [W]| {
                let mut last = far;
                for k in 0..width {
                    let value = row[k]
                        .min(last + straight)
                        .min(above[k + 1] + straight)
                        .min(above[k].min(above[k + 2]) + diagonal);
                    row[k] = value;
                    last = value;
                }
                above[1..=width].copy_from_slice(row);
            };
            if pass == 0 {
                rows.for_each(lower);
            } else {
                rows.rev().for_each(|row| {
                    row.reverse();
                    lower(row);
                    row.reverse();
                });
            }
        }
    }
}

impl Window {
    fn hold(window: &mut Option<Self>, (x, y): (u32, u32)) {
        let all = window.get_or_insert(Self {
            columns: [x, x],
            rows: [y, y],
        });
        all.columns = [all.columns[0].min(x), all.columns[1].max(x)];
        all.rows = [all.rows[0].min(y), all.rows[1].max(y)];
    }

    fn width(self) -> usize {
        (self.columns[1] - self.columns[0]) as usize + 1
    }

    fn places(self) -> usize {
        self.width() * ((self.rows[1] - self.rows[0]) as usize + 1)
    }

    fn place(self, (x, y): (u32, u32)) -> usize {
        (y - self.rows[0]) as usize * self.width() + (x - self.columns[0]) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_passes_reach_every_place_by_the_shortest_way() {
        let apart = Weights::of(&crate::Grid::open(2, 2).unwrap()).apart::<u32>(Moves::Always);
        let seeds = [(3, 4, 50_000), (9, 2, 0), (12, 11, 90_000), (5, 5, 10_000)];
        let mut all = Openings::at((3, 4), 50_000);
        let more = Window {
            columns: [2, 14],
            rows: [1, 12],
        };
        // In two steps, as it grows.
        all.widen(more, 1000, &seeds[..2], apart);
        all.widen(Window { columns: [0, 3], ..more }, 1000, &seeds[2..], apart);
        for x in 0..=14u32 {
            for y in 1..=12u32 {
                let least = seeds.iter().map(|&(a, b, left)| left + apart.by(x.abs_diff(a), y.abs_diff(b)));
                assert_eq!(all.left[all.window.place((x, y))], least.min().unwrap(), "{x}, {y}");
            }
        }
    }
}
