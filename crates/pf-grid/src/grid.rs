use crate::{Cell, DIRECTIONS, GridChange, GridCost, Layout, Moves, bits_from};
use pf_core::{InvalidProblem, Stamp};
use std::fmt;

/// Which cells are free, and what it costs to be there.
///
/// Beside a bit per cell it keeps a byte per cell that says which of the eight neighbours are
/// free, so that a search reads the legal moves of a cell with one load. Terrain takes a further
/// byte per cell, only where there is any. A change of a cell costs a handful of writes.
#[derive(Clone)]
pub struct Grid {
    layout: Layout,
    /// A bit per id: free.
    free: Vec<u64>,
    /// A byte per id: the directions in which the neighbour is free.
    around: Vec<u8>,
    /// A byte per id: the cost of the cell, kept while it is blocked. Empty if all cost 1.
    terrain: Vec<u8>,
    /// How many free cells there are of each cost.
    census: Box<[u32; 256]>,
    stamp: Stamp,
}

impl Grid {
    /// The most cells a grid may have.
    pub const MAX_CELLS: u64 = 1 << 28;

    /// A grid whose every cell costs what `cost` says: 0 is blocked, 1 to 254 is terrain, 1 is
    /// plain.
    ///
    /// # Errors
    /// [`InvalidProblem::BadValue`] if there are no cells, more than [`MAX_CELLS`](Self::MAX_CELLS),
    /// or a cost is 255.
    pub fn new(
        width: u32,
        height: u32,
        mut cost: impl FnMut(Cell) -> u8,
    ) -> Result<Self, InvalidProblem> {
        Self::check_size(u64::from(width), u64::from(height))?;
        let layout = Layout::new(width, height);
        let mut grid = Self {
            layout,
            free: vec![0; layout.len().div_ceil(64)],
            around: vec![0; layout.len()],
            terrain: Vec::new(),
            census: Box::new([0; 256]),
            stamp: Stamp::fresh(),
        };
        for cell in layout.cells() {
            let cost = cost(cell);
            let id = layout.id(cell) as usize;
            if cost == 0 {
                continue;
            }
            check_cost(cost)?;
            grid.free[id / 64] |= 1 << (id % 64);
            grid.census[usize::from(cost)] += 1;
            if cost != 1 {
                grid.terrain_mut()[id] = cost;
            }
        }
        grid.look_around();
        Ok(grid)
    }

    /// A grid without obstacles.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn open(width: u32, height: u32) -> Result<Self, InvalidProblem> {
        Self::new(width, height, |_| 1)
    }

    /// Reads the drawing that tests use, one row a line: `#` and `@` are blocked, a digit is
    /// terrain of that cost, everything else is free. Blank lines and indentation do not count.
    ///
    /// # Errors
    /// [`InvalidProblem::BadValue`] if there are no rows or they differ in length.
    ///
    /// ```
    /// # use pf_grid::*;
    /// let grid = Grid::parse("
    ///     ..#
    ///     .5.
    /// ").unwrap();
    /// assert!(!grid.is_free(Cell::new(2, 0)));
    /// assert_eq!(grid.cost(Cell::new(1, 1)), 5);
    /// ```
    pub fn parse(drawing: &str) -> Result<Self, InvalidProblem> {
        let rows: Vec<&[u8]> = drawing.split_whitespace().map(str::as_bytes).collect();
        let width = rows.first().map_or(0, |row| row.len());
        if let Some(y) = rows.iter().position(|row| row.len() != width) {
            return Err(InvalidProblem::BadValue {
                what: format!("row {y} of the drawing").into(),
                found: format!("{} cells wide", rows[y].len()),
                expected: format!("{width} cells, as the first row").into(),
            });
        }
        let (width, height) = Self::check_size(width as u64, rows.len() as u64)?;
        Self::new(width, height, |cell| {
            match rows[cell.y as usize][cell.x as usize] {
                b'#' | b'@' => 0,
                digit @ b'1'..=b'9' => digit - b'0',
                _ => 1,
            }
        })
    }

    /// Whether a grid may have this size: worth asking before reading or allocating anything.
    ///
    /// # Errors
    /// [`InvalidProblem::BadValue`] if it may not.
    pub fn check_size(width: u64, height: u64) -> Result<(u32, u32), InvalidProblem> {
        let cells = u128::from(width) * u128::from(height);
        match (u32::try_from(width), u32::try_from(height)) {
            (Ok(w), Ok(h)) if (1..=u128::from(Self::MAX_CELLS)).contains(&cells) => Ok((w, h)),
            _ => Err(InvalidProblem::BadValue {
                what: "grid size".into(),
                found: format!("{width} x {height}"),
                expected: "1 to 268435456 (2^28) cells".into(),
            }),
        }
    }

    /// Columns.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.layout.width()
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.layout.height()
    }

    /// How ids are given to cells.
    #[inline]
    #[must_use]
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Names the present content; see [`Stamp`].
    #[must_use]
    pub fn stamp(&self) -> Stamp {
        self.stamp
    }

    /// Whether the cell exists and is free.
    #[must_use]
    pub fn is_free(&self, cell: Cell) -> bool {
        self.layout.contains(cell) && self.is_free_id(self.layout.id(cell))
    }

    /// What it costs to be in `cell`, blocked or not: 1 to 254.
    ///
    /// # Panics
    /// If there is no such cell.
    #[must_use]
    pub fn cost(&self, cell: Cell) -> u8 {
        assert!(self.layout.contains(cell), "{cell} is not a cell");
        self.cost_id(self.layout.id(cell))
    }

    /// How many cells are free.
    #[must_use]
    pub fn free_cells(&self) -> u32 {
        self.census.iter().sum()
    }

    /// Whether every free cell costs 1.
    #[must_use]
    pub fn is_uniform(&self) -> bool {
        self.terrain.is_empty() || self.census[2..].iter().all(|&n| n == 0)
    }

    /// The least and the most that a free cell costs; 1 and 1 if there is none.
    #[must_use]
    pub fn cost_range(&self) -> (u8, u8) {
        let mut costs = (1..=254u8).filter(|&cost| self.census[usize::from(cost)] > 0);
        let least = costs.next().unwrap_or(1);
        (least, costs.next_back().unwrap_or(least))
    }

    /// Whether the cell with this id is free; the border is not.
    #[inline]
    #[must_use]
    pub fn is_free_id(&self, id: u32) -> bool {
        self.free[id as usize / 64] >> (id % 64) & 1 == 1
    }

    /// Which of 64 ids from this one on are free cells, a bit each; none beyond the last.
    #[inline]
    #[must_use]
    pub fn free_bits(&self, first: u32) -> u64 {
        bits_from(&self.free, first)
    }

    /// The directions in which the neighbour of the cell with this id is free.
    #[inline]
    #[must_use]
    pub fn around_id(&self, id: u32) -> u8 {
        self.around[id as usize]
    }

    /// The same of all ids.
    #[inline]
    pub(crate) fn around(&self) -> &[u8] {
        &self.around
    }

    /// The cost of the cell with this id.
    #[inline]
    #[must_use]
    pub fn cost_id(&self, id: u32) -> u8 {
        self.terrain.get(id as usize).copied().unwrap_or(1)
    }

    /// The sum of the costs of two cells: what a step between them costs, in half units of its length.
    #[inline]
    pub(crate) fn sum_of_costs(&self, from: u32, to: u32) -> u64 {
        u64::from(self.cost_id(from)) + u64::from(self.cost_id(to))
    }

    /// What a step costs between neighbouring cells.
    #[must_use]
    pub fn step_cost(&self, from: Cell, to: Cell) -> GridCost {
        let sum = u64::from(self.cost(from)) + u64::from(self.cost(to));
        if from.x == to.x || from.y == to.y {
            GridCost {
                straight: sum,
                diagonal: 0,
            }
        } else {
            GridCost {
                straight: 0,
                diagonal: sum,
            }
        }
    }

    /// The cells one legal step away, and what the step costs. None if `cell` is blocked.
    pub fn neighbours(
        &self,
        cell: Cell,
        moves: Moves,
    ) -> impl Iterator<Item = (Cell, GridCost)> + '_ {
        let legal = if self.is_free(cell) {
            moves.legal(self.around_id(self.layout.id(cell)))
        } else {
            0
        };
        let legal_steps = (0..8).filter(move |k| legal >> k & 1 == 1);
        legal_steps.map(move |k| {
            let next = cell.towards(k);
            (next, self.step_cost(cell, next))
        })
    }

    /// Refuses a cell that is not there.
    pub(crate) fn check_cell(&self, what: &'static str, cell: Cell) -> Result<(), InvalidProblem> {
        if self.layout.contains(cell) {
            return Ok(());
        }
        Err(InvalidProblem::OutOfBounds {
            what: what.into(),
            place: cell.to_string(),
            world: format!("{} x {}", self.width(), self.height()),
        })
    }

    /// Refuses a change that makes no sense here.
    pub(crate) fn check_change(&self, change: &GridChange) -> Result<(), InvalidProblem> {
        match change {
            GridChange::StartMoved(cell) => self.check_cell("the new start", *cell),
            GridChange::GoalMoved(cell) => self.check_cell("the new goal", *cell),
            GridChange::Blocked(cells) | GridChange::Freed(cells) => cells
                .iter()
                .try_for_each(|&cell| self.check_cell("the changed cell", cell)),
            GridChange::CostChanged(cells, cost) => {
                check_cost(*cost)?;
                cells
                    .iter()
                    .try_for_each(|&cell| self.check_cell("the changed cell", cell))
            }
        }
    }

    /// Blocks or frees cells; says whether that changed anything.
    pub(crate) fn set_free(&mut self, cells: &[Cell], free: bool) -> bool {
        let offsets = self.layout.offsets();
        let mut anything = false;
        for &cell in cells {
            let id = self.layout.id(cell);
            if self.is_free_id(id) == free {
                continue;
            }
            anything = true;
            self.free[id as usize / 64] ^= 1 << (id % 64);
            let count = &mut self.census[usize::from(self.cost_id(id))];
            *count = if free { *count + 1 } else { *count - 1 };
            for (k, offset) in offsets.into_iter().enumerate() {
                // Seen from the neighbour, this cell lies in the opposite direction.
                let neighbour = id.wrapping_add_signed(offset) as usize;
                self.around[neighbour] ^= 1 << (k & 4 | (k + 2) & 3);
            }
        }
        if anything {
            self.stamp = Stamp::fresh();
        }
        anything
    }

    /// Sets what a cell costs; says whether that changed anything.
    pub(crate) fn set_cost(&mut self, cell: Cell, cost: u8) -> bool {
        let id = self.layout.id(cell);
        let old = self.cost_id(id);
        if old == cost {
            return false;
        }
        if self.is_free_id(id) {
            self.census[usize::from(old)] -= 1;
            self.census[usize::from(cost)] += 1;
        }
        self.terrain_mut()[id as usize] = cost;
        self.stamp = Stamp::fresh();
        true
    }

    fn terrain_mut(&mut self) -> &mut [u8] {
        if self.terrain.is_empty() {
            self.terrain = vec![1; self.layout.len()];
        }
        &mut self.terrain
    }

    /// Fills `around` from the free bits.
    fn look_around(&mut self) {
        /// Of the 64 cells that a word of bits shows, all but the first and the last have both sides.
        const INNER: u32 = 62;
        let (width, pitch) = (self.width(), self.layout.pitch());
        for y in 0..self.height() {
            for x in (0..width).step_by(INNER as usize) {
                let id = self.layout.id(Cell { x, y });
                let mut rows = [id - pitch, id, id + pitch].map(|id| self.free_bits(id - 1));
                let end = id + INNER.min(width - x);
                for around in &mut self.around[id as usize..end as usize] {
                    let [above, beside, below] = rows.map(|row| (row & 7) as usize);
                    *around = AROUND[above | beside << 3 | below << 6];
                    rows = rows.map(|row| row >> 1);
                }
            }
        }
    }
}

/// The free neighbours by nine bits: of the cells above, three from west to east, of those beside, and of
/// those below.
const AROUND: [u8; 512] = {
    let mut table = [0; 512];
    let mut at = 0;
    while at < 512 * 8 {
        let (bits, k) = (at / 8, at % 8);
        let (dx, dy) = DIRECTIONS[k];
        if bits >> (3 * (dy + 1) + dx + 1) & 1 == 1 {
            table[bits] |= 1 << k;
        }
        at += 1;
    }
    table
};

fn check_cost(cost: u8) -> Result<(), InvalidProblem> {
    if (1..=254).contains(&cost) {
        return Ok(());
    }
    Err(InvalidProblem::BadValue {
        what: "terrain cost".into(),
        found: cost.to_string(),
        expected: "1 to 254".into(),
    })
}

/// Equal content, whatever its history.
impl PartialEq for Grid {
    fn eq(&self, other: &Self) -> bool {
        self.layout == other.layout
            && self.free == other.free
            && self.layout.cells().all(|c| self.cost(c) == other.cost(c))
    }
}

impl Eq for Grid {}

/// The drawing [`Grid::parse`] reads; terrain above 9 is drawn as 9.
impl fmt::Display for Grid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for y in 0..self.height() {
            for x in 0..self.width() {
                let cell = Cell { x, y };
                let drawn = match (self.is_free(cell), self.cost(cell)) {
                    (false, _) => '#',
                    (true, 1) => '.',
                    (true, cost) => char::from(b'0' + cost.min(9)),
                };
                write!(f, "{drawn}")?;
            }
            writeln!(f)?;
        }
        Ok(())
    }
}

impl fmt::Debug for Grid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Grid({} x {})", self.width(), self.height())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_changed_grid_equals_a_new_one() {
        let mut grid = Grid::parse("...# .#.. ....").unwrap();
        let stamp = grid.stamp();
        assert!(!grid.set_free(&[Cell::new(3, 0)], false));
        assert_eq!(grid.stamp(), stamp);
        for (x, y, free) in [(3, 0, true), (0, 0, false), (3, 2, false), (1, 1, true)] {
            assert!(grid.set_free(&[Cell::new(x, y)], free));
        }
        grid.set_cost(Cell::new(2, 1), 7);
        let fresh = Grid::parse("#... ..7. ...#").unwrap();
        for id in grid.layout.cells().map(|c| grid.layout.id(c)) {
            assert_eq!(grid.around_id(id), fresh.around_id(id));
        }
        assert_eq!(grid.census, fresh.census);
        assert_eq!(grid, fresh);
        assert_eq!(grid.to_string(), "#...\n..7.\n...#\n");
    }

    #[test]
    fn every_cell_knows_its_neighbours_wherever_words_begin() {
        for (width, height) in [
            (1, 200),
            (200, 1),
            (61, 9),
            (62, 9),
            (63, 9),
            (64, 9),
            (190, 7),
        ] {
            let grid = Grid::new(width, height, |cell| {
                u8::from((cell.x * 7 + cell.y * 13 + cell.x * cell.y) % 5 > 1)
            })
            .unwrap();
            for cell in grid.layout.cells() {
                let around = DIRECTIONS.iter().enumerate().map(|(k, &(dx, dy))| {
                    let near = Cell {
                        x: cell.x.wrapping_add_signed(dx),
                        y: cell.y.wrapping_add_signed(dy),
                    };
                    u8::from(grid.is_free(near)) << k
                });
                assert_eq!(
                    grid.around_id(grid.layout.id(cell)),
                    around.sum::<u8>(),
                    "{cell}"
                );
            }
        }
    }

    #[test]
    fn a_blocked_cell_remembers_its_terrain() {
        let mut grid = Grid::parse("7.").unwrap();
        let cell = Cell::new(0, 0);
        grid.set_free(&[cell], false);
        assert!(grid.is_uniform());
        grid.set_free(&[cell], true);
        assert_eq!((grid.cost(cell), grid.cost_range()), (7, (1, 7)));
    }

    #[test]
    fn sizes_are_refused_before_anything_is_allocated() {
        for (width, height) in [(0, 4), (4, 0), (1 << 28, 2), (u32::MAX, u32::MAX)] {
            assert!(Grid::new(width, height, |_| 1).is_err());
        }
        assert!(Grid::parse("").is_err() && Grid::parse("... ..").is_err());
    }
}
