//! Where ways over changed cells come out, and what that bounds.

use crate::{Apart, Cell, Grid, Word, window::Window};

/// The places near what became free or cheaper, from which old ways go on.
#[derive(Clone, Debug)]
pub(crate) struct Openings<W> {
    /// The least that was left at any of them, or at the edge of a window of dense changes.
    pub(crate) least: W,
    /// The least of what was left above the heuristic.
    pub(crate) excess: W,
    pub(crate) window: Window,
    /// Whether the window is small enough to be looked at place by place.
    pub(crate) has_places: bool,
    /// By place in the window what was left there before.
    pub(crate) was: Vec<W>,
    /// The least of what was left at an opening and the way there, as if nothing stood in it.
    over: Vec<W>,
    /// The lesser of the two; of a window of dense changes what lies `over` alone.
    pub(crate) both: Vec<W>,
    /// Scratch: a row, a window, and by rows of whole words which places were changed and are free.
    above: Vec<W>,
    spare: Vec<W>,
    freed: Vec<u64>,
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

impl<W: Word> Openings<W> {
    pub(crate) fn clear(&mut self) {
        self.least = W::MAX;
        self.excess = W::MAX;
        self.has_places = false;
        self.over.clear();
    }

    /// Whether there are none.
    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        self.least == W::MAX
    }

    pub(crate) fn open(&mut self, heuristic: W, left: W) {
        if left < W::MAX {
            self.least = self.least.min(left);
            self.excess = self.excess.min(left.max(heuristic) - heuristic);
        }
    }

    /// Everything may have changed.
    pub(crate) fn give_up(&mut self, window: Window) {
        self.forget_places(window);
        self.least = W::default();
        self.excess = W::default();
    }

    pub(crate) fn forget_places(&mut self, window: Window) {
        // Where the old window was no longer matters if there was none.
        self.window = if self.has_places || !self.is_empty() {
            self.window.with(window)
        } else {
            window
        };
        self.has_places = false;
    }

    /// Bytes held.
    pub(crate) fn bytes(&self) -> usize {
        let places = [&self.was, &self.over, &self.both, &self.above, &self.spare];
        let places: usize = places.into_iter().map(Vec::capacity).sum();
        places * size_of::<W>() + self.freed.capacity() * size_of::<u64>()
    }

    /// Looks at a window with these changes in it, place by place, row by row as it lies in memory.
    pub(crate) fn look(
        &mut self,
        grid: &Grid,
        changed: &[u32],
        window: Window,
        apart: Apart<W>,
        before: impl Fn((u32, u32), u32) -> (W, W),
    ) {
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
    pub(crate) fn enclose(
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
