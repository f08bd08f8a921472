//! What changed since a distance field was made, and what that does to its distances.

use crate::{Apart, Cell, Grid, GridProblem, Moves, Weights, Word, window::Window};

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
pub struct Damage<W> {
    /// Less was left nowhere among the changed cells.
    below: W,
    openings: Openings<W>,
}

/// The places near what became free or cheaper, from which old ways go on.
#[derive(Clone, Debug)]
struct Openings<W> {
    /// The least that was left at any of them.
    least: W,
    /// The least of what was left above the heuristic.
    excess: W,
    window: Window,
    /// Whether the window is small enough to be looked at place by place.
    has_places: bool,
    /// By place in the window what was left there before.
    was: Vec<W>,
    /// The least of what was left at an opening and the way there, as if nothing stood in it.
    over: Vec<W>,
    /// The lesser of the two.
    both: Vec<W>,
    /// Scratch: a row, a window, and by rows of whole words which places were changed and are free.
    above: Vec<W>,
    spare: Vec<W>,
    freed: Vec<u64>,
}

/// A window of that many places is looked at place by place however few changed cells there are,
const FEW_PLACES: usize = 1 << 10;
/// and one of that many for each of them.
const PLACES_EACH: usize = 16;
/// Where one place in so many was changed, what was known between them is of little use.
const DENSE: usize = 8;
/// That many changed cells spread over a larger window are taken to change everything.
const MOST_SPREAD: usize = 256;

impl<W: Word> Default for Damage<W> {
    fn default() -> Self {
        Self {
            below: W::MAX,
            openings: Openings::default(),
        }
    }
}

impl<W: Word> Default for Openings<W> {
    fn default() -> Self {
        Self {
            least: W::MAX,
            excess: W::MAX,
            window: Window::default(),
            has_places: false,
            was: Vec::new(),
            over: Vec::new(),
            both: Vec::new(),
            above: Vec::new(),
            spare: Vec::new(),
            freed: Vec::new(),
        }
    }
}

impl<W: Word> Damage<W> {
    /// No damage.
    pub fn clear(&mut self) {
        self.below = W::MAX;
        self.openings.clear();
    }

    /// Takes note of changed cells, of distances to `goal`. `before` says of a place, its column, row and id, what the
    /// heuristic says and what was left before anything changed, or a bound of it from below. Says
    /// whether any of them may have made something shorter.
    pub fn add(
        &mut self,
        problem: &GridProblem,
        goal: Cell,
        changed: &[u32],
        weights: Weights,
        before: impl Fn((u32, u32), u32) -> (W, W),
    ) -> bool {
        let grid = problem.grid();
        let layout = grid.layout();
        let mut window = None;
        let mut opened = false;
        for &id in changed {
            Window::hold(&mut window, layout.position(id));
            opened |= grid.is_free_id(id);
        }
        // Their neighbours, too, within the border.
        let Some(window) = window.filter(|_| opened).map(Window::grown) else {
            for &id in changed {
                self.hold_below(problem, id, weights, &before);
            }
            return false;
        };
        let most = FEW_PLACES + PLACES_EACH * changed.len();
        let all = &mut self.openings;
        let room = if all.is_empty() {
            window.places()
        } else {
            all.window.with(window).places()
        };
        let roomy = (all.is_empty() || all.has_places) && room <= most;
        if roomy && changed.len() * DENSE >= room {
            let apart = weights.apart(problem.moves());
            all.enclose(problem.grid(), goal, window, apart, before);
            self.below = self.below.min(all.least);
        } else if roomy {
            all.look(
                problem,
                changed,
                window,
                weights.apart(problem.moves()),
                before,
            );
            let (opening, below) = (all.window, &mut self.below);
            for &id in changed {
                for place in hindered(layout.position(id), weights) {
                    *below = all.was[opening.place(place)].min(*below);
                }
            }
        } else if changed.len() > MOST_SPREAD {
            all.give_up(window);
            self.below = W::default();
        } else {
            all.forget_places(window);
            for &id in changed.iter().filter(|&&id| grid.is_free_id(id)) {
                for (x, y) in square(layout.position(id), 1) {
                    let id = layout.id_at((x, y));
                    if grid.is_free_id(id) {
                        let (heuristic, left) = before((x, y), id);
                        all.open(heuristic, left);
                    }
                }
            }
            for &id in changed {
                self.hold_below(problem, id, weights, &before);
            }
        }
        true
    }

    fn hold_below(
        &mut self,
        problem: &GridProblem,
        id: u32,
        weights: Weights,
        before: &impl Fn((u32, u32), u32) -> (W, W),
    ) {
        let layout = problem.grid().layout();
        for place in hindered(layout.position(id), weights) {
            let (_, left) = before(place, layout.id_at(place));
            self.below = self.below.min(left);
        }
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
            openings: &self.openings,
            apart: weights.apart(moves),
        }
    }

    /// Whether at least half of what was known above the heuristic still holds near what became
    /// free or cheaper: there the heuristic said `heuristic`, and `known` was known.
    #[must_use]
    pub fn leaves(&self, heuristic: W, known: W) -> bool {
        let all = &self.openings;
        all.is_empty()
            || all.has_places
            || all.excess + all.excess >= known.max(heuristic) - heuristic
    }

    /// Bytes held.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let all = &self.openings;
        let places = [&all.was, &all.over, &all.both, &all.above, &all.spare];
        let places: usize = places.into_iter().map(Vec::capacity).sum();
        places * size_of::<W>() + all.freed.capacity() * size_of::<u64>()
    }
}

/// See [`Damage::bound`].
#[derive(Clone, Copy, Debug)]
pub struct Bound<'d, W> {
    openings: &'d Openings<W>,
    apart: Apart<W>,
}

impl<W: Word> Bound<'_, W> {
    /// A bound from below on every path from a place, given its column and its row, and what the
    /// heuristic says there and what was left before, as in [`Damage::add`].
    #[inline]
    pub fn at(&self, (x, y): (u32, u32), before: impl FnOnce() -> (W, W)) -> W {
        let all = self.openings;
        if all.is_empty() {
            return before().1;
        }
        let out = |at: u32, [from, to]: [u32; 2]| from.max(at) - at + (at.max(to) - to);
        let (dx, dy) = (out(x, all.window.columns), out(y, all.window.rows));
        if dx == 0 && dy == 0 && all.has_places {
            return all.both[all.window.place((x, y))];
        }
        let (heuristic, left) = before();
        left.min((self.apart.by(dx, dy) + all.least).max(heuristic + all.excess))
    }
}

impl<W: Word> Openings<W> {
    fn clear(&mut self) {
        self.least = W::MAX;
        self.excess = W::MAX;
        self.has_places = false;
        self.over.clear();
    }

    /// Whether there are none.
    #[inline]
    fn is_empty(&self) -> bool {
        self.least == W::MAX
    }

    fn open(&mut self, heuristic: W, left: W) {
        if left < W::MAX {
            self.least = self.least.min(left);
            self.excess = self.excess.min(left.max(heuristic) - heuristic);
        }
    }

    /// Everything may have changed.
    fn give_up(&mut self, window: Window) {
        self.forget_places(window);
        self.least = W::default();
        self.excess = W::default();
    }

    fn forget_places(&mut self, window: Window) {
        // Where the old window was no longer matters if there was none.
        self.window = if self.has_places || !self.is_empty() {
            self.window.with(window)
        } else {
            window
        };
        self.has_places = false;
    }

    /// Looks at a window with these changes in it, place by place, row by row as it lies in memory.
    fn look(
        &mut self,
        problem: &GridProblem,
        changed: &[u32],
        window: Window,
        apart: Apart<W>,
        before: impl Fn((u32, u32), u32) -> (W, W),
    ) {
        let grid = problem.grid();
        let layout = grid.layout();
        let old = self.has_places.then_some(self.window);
        let all = old.map_or(window, |old| old.with(window));
        std::mem::swap(&mut self.over, &mut self.spare);
        self.over.clear();
        self.over.resize(all.places(), Self::far());
        if let Some(old) = old {
            for (y, row) in (old.rows[0]..).zip(self.spare.chunks_exact(old.width())) {
                let at = all.place((old.columns[0], y));
                self.over[at..at + old.width()].copy_from_slice(row);
            }
        }
        self.window = all;
        self.has_places = true;
        let mut heuristics = std::mem::take(&mut self.both);
        for places in [&mut self.was, &mut heuristics] {
            places.clear();
            places.resize(all.places(), W::default());
        }
        let width = all.width();
        let rows = self.was.chunks_exact_mut(width);
        for (y, (was, heuristics)) in
            (all.rows[0]..).zip(rows.zip(heuristics.chunks_exact_mut(width)))
        {
            let first = layout.id_at((all.columns[0], y));
            let places = (first..)
                .zip(all.columns[0]..)
                .zip(was.iter_mut().zip(heuristics));
            for ((id, x), (left, heuristic)) in places {
                (*heuristic, *left) = before((x, y), id);
            }
        }
        self.open_beside(grid, changed, &heuristics);
        self.spread(apart.by(1, 0), apart.by(1, 1));
        heuristics.clear();
        heuristics.extend(
            self.was
                .iter()
                .zip(&self.over)
                .map(|(&was, &over)| was.min(over)),
        );
        self.both = heuristics;
    }

    /// The same, from the edge of the window alone, as if nothing stood within: a way comes out of it for the last
    /// time at a place from which it goes on as before. That takes a fraction of the time.
    fn enclose(
        &mut self,
        grid: &Grid,
        goal: Cell,
        window: Window,
        apart: Apart<W>,
        before: impl Fn((u32, u32), u32) -> (W, W),
    ) {
        let layout = grid.layout();
        let all = if self.has_places {
            self.window.with(window)
        } else {
            window
        };
        (self.window, self.has_places) = (all, true);
        self.over.clear();
        self.over.resize(all.places(), Self::far());
        let goal = layout.position(layout.id(goal));
        if all.has(goal) {
            self.over[all.place(goal)] = W::default();
            self.open(W::default(), W::default());
        }
        for place in all.edge() {
            let id = layout.id_at(place);
            if grid.is_free_id(id) {
                let (heuristic, left) = before(place, id);
                let over = &mut self.over[all.place(place)];
                *over = left.min(*over);
                self.open(heuristic, left);
            }
        }
        self.spread(apart.by(1, 0), apart.by(1, 1));
        self.both.clear();
        self.both.extend_from_slice(&self.over);
    }

    /// Opens what is free among the changed cells, and beside them: a freed cell also allows diagonal steps that
    /// pass it, between its neighbours.
    fn open_beside(&mut self, grid: &Grid, changed: &[u32], heuristics: &[W]) {
        let (layout, all) = (grid.layout(), self.window);
        let (width, words) = (all.width(), all.width().div_ceil(64));
        let mut freed = std::mem::take(&mut self.freed);
        freed.clear();
        // A row above and a row below, too.
        freed.resize((all.places() / width + 2) * words, 0);
        for &id in changed.iter().filter(|&&id| grid.is_free_id(id)) {
            let place = all.place(layout.position(id));
            let (row, column) = (place / width + 1, place % width);
            freed[row * words + column / 64] |= 1 << (column % 64);
        }
        for (row, y) in (all.rows[0]..=all.rows[1]).enumerate() {
            let rows =
                |word: usize| (row..row + 3).fold(0, |bits, row| bits | freed[row * words + word]);
            let mut before = 0;
            let mut here = rows(0);
            for (word, x) in (0..words).zip((all.columns[0]..).step_by(64)) {
                let after = if word + 1 < words { rows(word + 1) } else { 0 };
                let beside = here | here << 1 | before >> 63 | here >> 1 | after << 63;
                let mut near = beside & grid.free_bits(layout.id_at((x, y)));
                while near != 0 {
                    let place = row * width + word * 64 + near.trailing_zeros() as usize;
                    near &= near - 1;
                    let left = self.was[place];
                    if left < self.over[place] {
                        self.over[place] = left;
                        self.open(heuristics[place], left);
                    }
                }
                (before, here) = (here, after);
            }
        }
        self.freed = freed;
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
            let above = &mut self.above;
            above.clear();
            above.resize(width + 2, far);
            let rows = self.over.chunks_exact_mut(width);
            let mut lower = |row: &mut [W]| {
                for (value, near) in row.iter_mut().zip(above.windows(3)) {
                    let over = (near[1] + straight).min(near[0].min(near[2]) + diagonal);
                    *value = over.min(*value);
                }
                let mut last = far;
                for value in row.iter_mut() {
                    last = (*value).min(last + straight);
                    *value = last;
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

/// The places that are no further than so many steps from one.
fn square((x, y): (u32, u32), reach: u32) -> impl Iterator<Item = (u32, u32)> {
    (y - reach..=y + reach).flat_map(move |y| (x - reach..=x + reach).map(move |x| (x, y)))
}

/// From where a step may be hindered by a changed cell. A blocked one also hinders diagonal steps that pass it:
/// without terrain less was left at such a cell than where the step begins, with terrain it may be dear.
fn hindered(at: (u32, u32), weights: Weights) -> impl Iterator<Item = (u32, u32)> {
    square(at, u32::from(!weights.is_uniform()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::GridChange;
    use pf_core::Problem;

    /// A window that grows holds at every place the least over all openings, as a plain reading of
    /// the definition has it.
    #[test]
    fn two_passes_reach_every_place_by_the_shortest_way() {
        let grid = Grid::new(20, 20, |cell| u8::from((cell.x * 7 + cell.y * 11) % 5 > 1)).unwrap();
        let (start, goal) = (Cell::new(0, 0), Cell::new(19, 19));
        let mut problem = GridProblem::new(grid, start, goal).unwrap();
        let weights = Weights::of(problem.grid());
        let apart = weights.apart::<u32>(problem.moves());
        let was = |(x, y): (u32, u32), _: u32| (0, 10_000 * ((x * 13 + y * 29) % 31));
        let mut damage = Damage::default();
        let mut seeds = Vec::new();
        for freed in [
            vec![Cell::new(4, 5), Cell::new(11, 7)],
            vec![Cell::new(2, 12)],
        ] {
            problem.apply(&[GridChange::Freed(freed.clone())]).unwrap();
            let layout = *problem.grid().layout();
            let ids: Vec<u32> = freed.iter().map(|&cell| layout.id(cell)).collect();
            assert!(damage.add(&problem, goal, &ids, weights, was));
            let near = ids.iter().flat_map(|&id| square(layout.position(id), 1));
            seeds.extend(near.filter(|&at| problem.grid().is_free_id(layout.id_at(at))));
        }
        let bound = damage.bound(weights, problem.moves());
        let mut inside = 0;
        for at @ (x, y) in (1..=20).flat_map(|x| (1..=20u32).map(move |y| (x, y))) {
            let (x, y): (u32, u32) = (x, y);
            let over =
                |&(a, b): &(u32, u32)| was((a, b), 0).1 + apart.by(x.abs_diff(a), y.abs_diff(b));
            let least = seeds.iter().map(over).min().unwrap();
            let found = bound.at(at, || (0, u32::MAX));
            if damage.openings.window.has(at) {
                inside += 1;
                assert_eq!(found, least.min(was(at, 0).1), "{at:?}");
            } else {
                assert!(found <= least, "{at:?}");
            }
        }
        assert!(inside > 100 && inside < 400);
    }
}
