//! Where straight scans stop, a bit per cell and direction.

use super::{
    patch::{INNER, Patch, ones, put},
    turns::stops,
};
use pf_core::Stamp;
use pf_grid::{Cell, DIRECTIONS, Grid, Layout, Moves, bits_from};

/// For each straight direction a bit per cell, set where a scan in that direction stops: at blocked
/// cells and at *turns*, cells from which the search may go on elsewhere than straight on.
///
/// East and west lie in rows; south and north in columns, so that every scan runs along words of 64
/// cells. A changed cell changes the bits of the nine cells around it.
///
/// Source: Harabor and Grastien, *Improving Jump Point Search*, 2014 (scans by words, a transposed
/// copy); one word of bits made beforehand in the place of three rows looked at each time is ours.
#[derive(Clone, Debug, Default)]
pub(super) struct JumpMap {
    made: Option<(Stamp, Moves, Layout)>,
    /// In rows, for scans to the east and to the west; and in columns, to the south and to the north.
    stops: [Vec<[u64; 2]>; 2],
    /// The free cells, in columns.
    free: Vec<u64>,
    /// From one column to the next.
    pitch: u32,
    /// The last goal.
    marked: Option<Marked>,
}

/// A cell in both orders.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) id: u32,
    /// Its place in the columns' bits.
    turned: u32,
}

/// A cell at which every scan stops, and the straight directions in which it would else.
#[derive(Clone, Copy, Debug)]
struct Marked {
    cell: Cell,
    stops: u8,
}

impl JumpMap {
    /// Whether it is that of this grid as it is.
    pub(super) fn is_of(&self, grid: &Grid, moves: Moves) -> bool {
        self.made == Some((grid.stamp(), moves, *grid.layout()))
    }

    /// Makes it for a grid.
    pub(super) fn make(&mut self, grid: &Grid, moves: Moves) {
        let layout = *grid.layout();
        let (width, height) = (layout.width(), layout.height());
        (self.made, self.marked) = (Some((grid.stamp(), moves, layout)), None);
        self.pitch = height + 1;
        lay(&mut self.stops[0], [height, width]);
        lay(&mut self.stops[1], [width, height]);
        self.free.clear();
        self.free
            .extend(self.stops[1].iter().map(|[stops, _]| !stops));
        if moves == Moves::Orthogonal {
            self.stops[1].fill([u64::MAX; 2]);
        }
        for top in (0..height).step_by(INNER as usize) {
            for left in (0..width).step_by(INNER as usize) {
                self.look_at(grid, moves, (left, top));
            }
        }
    }

    /// Looks for blocked cells in the inner rows and columns of a patch, to an open map.
    fn look_at(&mut self, grid: &Grid, moves: Moves, (left, top): (u32, u32)) {
        let layout = grid.layout();
        let columns = INNER.min(layout.width() - left);
        let within = u64::MAX >> (64 - columns);
        let mut patch = Patch {
            left,
            top,
            ..Patch::default()
        };
        let mut blocked = [0; 64];
        let rows = INNER.min(layout.height() - top);
        for (y, row) in (0..rows).zip(&mut blocked) {
            *row = !grid.free_bits(layout.id_at((left + 1, top + 1 + y))) & within;
            if *row != 0 {
                patch.rows |= 0b111 << y;
                patch.columns |= *row | *row << 1 | *row << 2;
            }
        }
        if patch.rows == 0 {
            return;
        }
        transpose(&mut blocked);
        for (x, column) in (0..).zip(blocked).take(columns as usize) {
            let at = (left + 1 + x) * self.pitch + top + 1;
            let (word, shift) = (at as usize / 64, at % 64);
            if column != 0 {
                self.free[word] &= !(column << shift);
                let beyond = column >> 1 >> (63 - shift);
                if beyond != 0 {
                    self.free[word + 1] &= !beyond;
                }
            }
        }
        self.redo(grid, moves, &patch);
    }

    /// Follows changes of cells on the grid it was made of.
    pub(super) fn follow(&mut self, grid: &Grid, changed: impl Iterator<Item = Cell>) {
        let Some((_, moves, layout)) = self.made else {
            return;
        };
        let mut patch = Patch::default();
        for cell in changed {
            let place = (cell.x + 1, cell.y + 1);
            let at = place.0 * self.pitch + place.1;
            let word = &mut self.free[at as usize / 64];
            *word = *word & !(1 << (at % 64)) | u64::from(grid.is_free(cell)) << (at % 64);
            if !patch.add(place) {
                self.redo(grid, moves, &patch);
                patch = Patch::default();
                patch.add(place);
            }
        }
        self.redo(grid, moves, &patch);
        self.made = Some((grid.stamp(), moves, layout));
    }

    /// Makes the bits of a patch again.
    fn redo(&mut self, grid: &Grid, moves: Moves, patch: &Patch) {
        if patch.rows == 0 {
            return;
        }
        let layout = grid.layout();
        let is_there = |marked: Marked| patch.holds((marked.cell.x + 1, marked.cell.y + 1));
        if self.marked.is_some_and(is_there) {
            self.unmark(layout);
        }
        for y in ones(patch.rows) {
            let first = layout.id_at((patch.left, patch.top + y));
            let stops = stops(moves, |at| grid.free_bits(at), layout.pitch(), first);
            put(&mut self.stops[0], first, patch.columns, stops);
        }
        if moves == Moves::Orthogonal {
            // No scan goes up or down.
            return;
        }
        for x in ones(patch.columns) {
            let first = (patch.left + x) * self.pitch + patch.top;
            let stops = stops(moves, |at| bits_from(&self.free, at), self.pitch, first);
            put(&mut self.stops[1], first, patch.rows, stops);
        }
    }

    /// The word in which the bit of a place for a straight direction is, and which it is.
    fn word(&mut self, place: Place, k: usize) -> (&mut u64, u32) {
        let at = if k.is_multiple_of(2) {
            place.id
        } else {
            place.turned
        };
        (&mut self.stops[k % 2][at as usize / 64][k / 2], at % 64)
    }

    /// Lets scans stop at a place in these straight directions.
    fn set(&mut self, place: Place, stops: u8) {
        for k in 0..4 {
            let (word, bit) = self.word(place, k);
            *word = *word & !(1 << bit) | u64::from(stops >> k & 1) << bit;
        }
    }

    /// Lets every scan stop at a cell, as at a goal, and at no other that was marked. It stays: the next search is to
    /// the same goal, more often than not.
    pub(super) fn mark(&mut self, cell: Cell) {
        let Some((_, _, layout)) = self.made else {
            return;
        };
        if self.marked.is_some_and(|marked| marked.cell == cell) {
            return;
        }
        self.unmark(&layout);
        let place = self.place(&layout, layout.id(cell));
        let stops = (0..4).fold(0, |stops, k| {
            let (word, bit) = self.word(place, k);
            stops | u8::from(*word >> bit & 1 == 1) << k
        });
        self.set(place, 0b1111);
        self.marked = Some(Marked { cell, stops });
    }

    fn unmark(&mut self, layout: &Layout) {
        if let Some(marked) = self.marked.take() {
            self.set(self.place(layout, layout.id(marked.cell)), marked.stops);
        }
    }

    /// A cell by its id.
    #[inline]
    pub(super) fn place(&self, layout: &Layout, id: u32) -> Place {
        let (x, y) = layout.position(id);
        let turned = x * self.pitch + y;
        Place { id, turned }
    }

    /// What a step in each direction adds to a [`Place`].
    pub(super) fn steps(&self, layout: &Layout) -> [(i32, i32); 8] {
        let offsets = layout.offsets();
        std::array::from_fn(|k| {
            let (dx, dy) = DIRECTIONS[k];
            (offsets[k], dx * self.pitch.cast_signed() + dy)
        })
    }

    /// How many steps a scan takes from a place in a straight direction until it stops: at least one.
    #[inline]
    pub(super) fn scan(&self, place: Place, k: usize) -> u32 {
        match k {
            0 => ahead(&self.stops[0], place.id),
            1 => ahead(&self.stops[1], place.turned),
            2 => behind(&self.stops[0], place.id),
            _ => behind(&self.stops[1], place.turned),
        }
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        let words: usize = self.stops.iter().map(|lines| 2 * lines.capacity()).sum();
        (words + self.free.capacity()) * size_of::<u64>()
    }
}

impl Place {
    /// For who needs no turned bits.
    pub(super) fn only(id: u32) -> Self {
        Self { id, turned: 0 }
    }

    /// The place one step on.
    #[inline]
    pub(super) fn step(self, (id, turned): (i32, i32)) -> Self {
        Self {
            id: self.id.wrapping_add_signed(id),
            turned: self.turned.wrapping_add_signed(turned),
        }
    }
}

/// Lays so many lines of so many cells each, at which no scan stops but at the border.
fn lay(stops: &mut Vec<[u64; 2]>, [lines, cells]: [u32; 2]) {
    let pitch = cells as usize + 1;
    let last = (lines as usize + 1) * pitch;
    let words = (last + pitch) / 64 + 1;
    stops.clear();
    stops.resize(words, [0; 2]);
    let before = (pitch..last).step_by(pitch);
    for at in (0..pitch).chain(before).chain(last..words * 64) {
        stops[at / 64] = stops[at / 64].map(|word| word | 1 << (at % 64));
    }
}

/// Turns 64 rows of 64 bits into columns: halves change places, then the halves of halves.
///
/// Source: Warren, *Hacker's Delight*, 2002, section 7-3.
fn transpose(block: &mut [u64; 64]) {
    let (mut half, mut low) = (32, u64::MAX >> 32);
    while half > 0 {
        for row in (0..64).filter(|row| row & half == 0) {
            let swapped = (block[row] >> half ^ block[row + half]) & low;
            block[row] ^= swapped << half;
            block[row + half] ^= swapped;
        }
        half /= 2;
        low ^= low << half;
    }
}

/// How far the first bit after one is. The border stops every scan.
#[inline]
fn ahead(bits: &[[u64; 2]], at: u32) -> u32 {
    let from = at + 1;
    let mut words = bits[from as usize / 64..].iter();
    let first = words
        .next()
        .map_or(u64::MAX, |[word, _]| word & u64::MAX << (from % 64));
    if first != 0 {
        return first.trailing_zeros() - from % 64 + 1;
    }
    let mut steps = 64 - from % 64 + 1;
    for [word, _] in words {
        if *word != 0 {
            return steps + word.trailing_zeros();
        }
        steps += 64;
    }
    steps
}

/// How far the last bit before one is.
#[inline]
fn behind(bits: &[[u64; 2]], at: u32) -> u32 {
    let from = at - 1;
    let mut words = bits[..=from as usize / 64].iter().rev();
    let first = words
        .next()
        .map_or(u64::MAX, |[_, word]| word << (63 - from % 64));
    if first != 0 {
        return first.leading_zeros() + 1;
    }
    let mut steps = from % 64 + 2;
    for [_, word] in words {
        if *word != 0 {
            return steps + word.leading_zeros();
        }
        steps += 64;
    }
    steps
}

#[cfg(test)]
mod tests {
    use super::*;
    use pf_core::{PlanRng, Problem};
    use pf_grid::{GridChange, GridProblem, successors};
    use rand::{RngExt, SeedableRng};

    /// A scan stops where the rule says, wherever words begin.
    #[test]
    fn scans_stop_at_walls_and_where_a_turn_is_due() {
        let grid = Grid::new(200, 150, |cell| {
            u8::from((cell.x * 7 + cell.y * 13) % 31 > 1)
        })
        .unwrap();
        for moves in Moves::ALL {
            let mut map = JumpMap::default();
            map.make(&grid, moves);
            let layout = *grid.layout();
            for cell in layout.cells().filter(|&cell| grid.is_free(cell)) {
                let id = layout.id(cell);
                // Without diagonals no scan goes up or down.
                let scanned = if moves == Moves::Orthogonal { 2 } else { 1 };
                for k in (0..4).step_by(scanned) {
                    let mut at = id;
                    let mut walked = 0;
                    let stops = |at| {
                        let around = usize::from(grid.around_id(at));
                        !grid.is_free_id(at) || successors(moves)[k][around] & !(1 << k) != 0
                    };
                    while walked == 0 || !stops(at) {
                        at = at.wrapping_add_signed(layout.offsets()[k]);
                        walked += 1;
                    }
                    assert_eq!(map.scan(map.place(&layout, id), k), walked, "{cell} {k}");
                }
            }
        }
    }

    /// All scans stop where those of a map made for the grid do, whatever came and went, and with whichever goal.
    #[test]
    fn changes_are_followed_everywhere() {
        let mut rng = PlanRng::seed_from_u64(41);
        for story in 0..400 {
            let sides = [1, 2, 31, 64, 90];
            let [width, height] = [0, 1].map(|_| sides[rng.random_range(0..sides.len())]);
            let moves = Moves::ALL[story % Moves::ALL.len()];
            let grid = Grid::new(width, height, |_| u8::from(rng.random_range(0..4) > 0)).unwrap();
            let draw = |rng: &mut PlanRng| {
                Cell::new(rng.random_range(0..width), rng.random_range(0..height))
            };
            let goal = draw(&mut rng);
            let mut problem = GridProblem::new(grid, goal, goal).unwrap();
            let mut map = JumpMap::default();
            map.make(problem.grid(), moves);
            for _ in 0..4 {
                map.mark(draw(&mut rng));
                let [near, count] = [draw(&mut rng), Cell::new(rng.random_range(0..40), 0)];
                let mut cells: Vec<Cell> = (0..count.x).map(|_| draw(&mut rng)).collect();
                if rng.random_bool(0.5) {
                    let is_near =
                        |cell: &Cell| cell.x.abs_diff(near.x).max(cell.y.abs_diff(near.y)) < 9;
                    cells = problem.grid().layout().cells().filter(is_near).collect();
                }
                let (free, blocked) = cells
                    .iter()
                    .partition(|&&cell| problem.grid().is_free(cell));
                let changes = [GridChange::Blocked(free), GridChange::Freed(blocked)];
                problem.apply(&changes).unwrap();
                map.follow(problem.grid(), cells.into_iter());
                let goal = draw(&mut rng);
                map.mark(goal);
                let mut fresh = JumpMap::default();
                fresh.make(problem.grid(), moves);
                fresh.mark(goal);
                assert_eq!(
                    map.stops, fresh.stops,
                    "{width} x {height}, {moves}, {story}"
                );
            }
        }
    }

    #[test]
    fn nothing_is_followed_where_nothing_changed() {
        let mut map = JumpMap::default();
        let tall = Grid::open(1, 70_000).unwrap();
        map.make(&tall, Moves::Always);
        map.follow(&tall, std::iter::once(Cell::new(0, 69_990)));
        let wide = Grid::open(70_000, 1).unwrap();
        map.make(&wide, Moves::Always);
        map.follow(&wide, std::iter::empty());
        let mut fresh = JumpMap::default();
        fresh.make(&wide, Moves::Always);
        assert_eq!(map.stops, fresh.stops);
    }
}
