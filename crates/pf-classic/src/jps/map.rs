//! Where straight scans stop, a bit per cell and direction.

use super::patch::{Column, Patch, SIDE, put};
use pf_core::Stamp;
use pf_grid::{Cell, DIRECTIONS, Grid, Layout, Moves, Successors, bits_from, successors};

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
    /// By straight direction.
    stops: [Vec<u64>; 4],
    /// By set of free neighbours: the straight directions in which a scan stops at such a cell.
    forced: Vec<u8>,
    /// From one column to the next in the columns' bits.
    pitch: u32,
    /// The last goal.
    marked: Option<Marked>,
    /// Empty between uses.
    patch: Patch,
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
        self.forced.clear();
        self.forced
            .extend((0..256).map(|around| Self::stops_of(successors(moves), around)));
        self.pitch = layout.height() + 1;
        let turned = (layout.width() as usize + 2) * self.pitch as usize + 1;
        // Where all is free around a cell, scans in some directions stop at each, in others at none.
        let open = self.forced[0xff];
        for (k, ids) in [layout.len(), turned].into_iter().enumerate() {
            let stops = &mut self.stops[k];
            stops.clear();
            stops.resize(ids / 64 + 1, u64::MAX);
            if open >> k & 1 == 1 {
                // It is so in both directions.
            } else if k == 0 {
                for (first, word) in (0..).step_by(64).zip(stops) {
                    *word = !grid.free_bits(first);
                }
            } else {
                clear_columns(stops, grid, self.pitch);
            }
        }
        let [east, south, west, north] = &mut self.stops;
        west.clone_from(east);
        north.clone_from(south);
        // Cells that are free, as are both beside them in their row.
        #[expect(clippy::cast_possible_truncation, reason = "ids")]
        let firsts = (0..layout.len() as u32).step_by(64);
        let beside = |first: u32| grid.free_bits(first.wrapping_sub(1)) & grid.free_bits(first + 1);
        let wide = |first| grid.free_bits(first) & beside(first);
        let wide: Vec<u64> = firsts.clone().map(wide).collect();
        let pitch = layout.pitch();
        for first in firsts {
            let free = grid.free_bits(first);
            if free == 0 {
                continue;
            }
            // Where there is no row above, cells are looked at one by one.
            let rows = [first.wrapping_sub(pitch), first, first + pitch];
            let rows = rows.map(|first| bits_from(&wide, first));
            // Those that have something blocked beside them.
            let mut turns = free & !(rows[0] & rows[1] & rows[2]);
            while turns != 0 {
                let id = first + turns.trailing_zeros();
                turns &= turns - 1;
                let stops = self.forced[usize::from(grid.around_id(id))];
                // Elsewhere it is so already.
                if stops != open {
                    self.set(self.place(&layout, id), stops);
                }
            }
        }
        self.marked = None;
        self.made = Some((grid.stamp(), moves, layout));
    }

    /// Follows changes of cells on the grid it was made of.
    pub(super) fn follow(&mut self, grid: &Grid, changed: impl Iterator<Item = Cell>) {
        let Some((_, moves, layout)) = self.made else {
            return;
        };
        let mut patch = std::mem::take(&mut self.patch);
        for cell in changed {
            let place = layout.position(layout.id(cell));
            if !patch.add(place) {
                self.redo(grid, &layout, &mut patch);
                patch.add(place);
            }
        }
        self.redo(grid, &layout, &mut patch);
        self.patch = patch;
        self.made = Some((grid.stamp(), moves, layout));
    }

    /// Makes the bits of a patch again, and empties it.
    fn redo(&mut self, grid: &Grid, layout: &Layout, patch: &mut Patch) {
        if patch.height == 0 {
            return;
        }
        let is_there = |marked: Marked| {
            let (x, y) = layout.position(layout.id(marked.cell));
            x.wrapping_sub(patch.left) < SIDE && y.wrapping_sub(patch.top) < SIDE
        };
        if self.marked.is_some_and(is_there) {
            self.unmark(layout);
        }
        let first = layout.id_at((patch.left, patch.top));
        let mut columns = [Column::default(); SIDE as usize];
        let mut all = 0;
        let mut id = first;
        for (y, row) in patch.rows[..patch.height].iter_mut().enumerate() {
            let dirty = std::mem::take(row);
            all |= dirty;
            let (mut rest, mut east, mut west) = (dirty, 0, 0);
            while rest != 0 {
                let x = rest.trailing_zeros();
                rest &= rest - 1;
                let id = id + x;
                let stops = if grid.is_free_id(id) {
                    self.forced[usize::from(grid.around_id(id))]
                } else {
                    0b1111
                };
                let stops = u32::from(stops);
                east |= (stops & 1) << x;
                west |= (stops >> 2 & 1) << x;
                let column = &mut columns[x as usize];
                column.dirty |= 1 << y;
                column.south |= (stops >> 1 & 1) << y;
                column.north |= (stops >> 3 & 1) << y;
            }
            if dirty != 0 {
                put(&mut self.stops[0], id, dirty, east);
                put(&mut self.stops[2], id, dirty, west);
            }
            id += layout.pitch();
        }
        patch.height = 0;
        let turned = self.place(layout, first).turned;
        while all != 0 {
            let x = all.trailing_zeros();
            all &= all - 1;
            let (column, at) = (columns[x as usize], turned + x * self.pitch);
            put(&mut self.stops[1], at, column.dirty, column.south);
            put(&mut self.stops[3], at, column.dirty, column.north);
        }
    }

    /// In which straight directions a scan stops at a free cell with these free neighbours.
    fn stops_of(successors: &Successors, around: usize) -> u8 {
        (0..4).fold(0, |stops, k| {
            let elsewhere = successors[k][around] & !(1 << k) != 0;
            stops | u8::from(elsewhere) << k
        })
    }

    #[inline]
    fn set(&mut self, place: Place, stops: u8) {
        for (k, bits) in self.stops.iter_mut().enumerate() {
            let at = place.of(k);
            // No branch: whether a scan stops is hard to guess.
            let word = &mut bits[at / 64];
            *word = *word & !(1 << (at % 64)) | u64::from(stops >> k & 1) << (at % 64);
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
        let stops = self.stops.iter().enumerate().fold(0, |stops, (k, bits)| {
            let at = place.of(k);
            stops | u8::from(bits[at / 64] >> (at % 64) & 1 == 1) << k
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
            2 => behind(&self.stops[2], place.id),
            _ => behind(&self.stops[3], place.turned),
        }
    }

    /// At how many free cells scans stop, counted once for each straight direction.
    pub(super) fn turns(&mut self, grid: &Grid) -> u64 {
        self.unmark(grid.layout());
        let stops = self.stops.iter().map(|bits| {
            let set: u64 = bits.iter().map(|word| u64::from(word.count_ones())).sum();
            // All that is not free is set, and what follows the last place.
            set + u64::from(grid.free_cells()) - bits.len() as u64 * 64
        });
        stops.sum()
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        let words: usize = self.stops.iter().map(Vec::capacity).sum();
        words * size_of::<u64>() + self.forced.capacity()
    }
}

impl Place {
    /// For who needs no turned bits.
    pub(super) fn only(id: u32) -> Self {
        Self { id, turned: 0 }
    }

    /// Where it is in the bits of a straight direction.
    fn of(self, k: usize) -> usize {
        (if k.is_multiple_of(2) {
            self.id
        } else {
            self.turned
        }) as usize
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

/// Clears the bits of free cells in an order by columns.
fn clear_columns(bits: &mut [u64], grid: &Grid, pitch: u32) {
    let layout = grid.layout();
    let (width, height) = (layout.width(), layout.height());
    for y in (0..height).step_by(64) {
        for x in (0..width).step_by(64) {
            let mut block = [0; 64];
            for (row, y) in block.iter_mut().zip(y..height) {
                let free = grid.free_bits(layout.id(Cell { x, y }));
                // What lies beyond the row is the next one.
                *row = free & u64::MAX >> 64u32.saturating_sub(width - x);
            }
            if block.iter().any(|&row| row != u64::MAX) {
                transpose(&mut block);
            }
            for (column, x) in block.into_iter().zip(x..width) {
                let at = (x + 1) * pitch + y + 1;
                let (word, shift) = (at as usize / 64, at % 64);
                bits[word] &= !(column << shift);
                if let Some(next) = bits.get_mut(word + 1) {
                    *next &= !(column >> 1 >> (63 - shift));
                }
            }
        }
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
fn ahead(bits: &[u64], at: u32) -> u32 {
    let from = at + 1;
    let mut words = bits[from as usize / 64..].iter();
    let first = words
        .next()
        .map_or(u64::MAX, |word| word & u64::MAX << (from % 64));
    if first != 0 {
        return first.trailing_zeros() - from % 64 + 1;
    }
    let mut steps = 64 - from % 64 + 1;
    for word in words {
        if *word != 0 {
            return steps + word.trailing_zeros();
        }
        steps += 64;
    }
    steps
}

/// How far the last bit before one is.
#[inline]
fn behind(bits: &[u64], at: u32) -> u32 {
    let from = at - 1;
    let mut words = bits[..=from as usize / 64].iter().rev();
    let first = words
        .next()
        .map_or(u64::MAX, |word| word << (63 - from % 64));
    if first != 0 {
        return first.leading_zeros() + 1;
    }
    let mut steps = from % 64 + 2;
    for word in words {
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
    use pf_grid::{GridChange, GridProblem};
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
                for k in 0..4 {
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
