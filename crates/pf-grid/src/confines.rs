//! Whether walls have closed around the robot.

use crate::{Cell, Grid, GridProblem, Moves};

/// So far around the start is looked: two such and the start fit a row of bits.
const REACH: u32 = 63;
/// The last row or column there is, of a square around the start.
const LAST: u32 = 2 * REACH;
/// Bits of the first and the last column.
const SIDES: u128 = 1 | 1 << LAST;

/// Proves that there is no way out, where that takes little: row by row it asks only what can be reached, which
/// takes a fraction of the time of a search that asks how far it is.
///
/// ```
/// use pf_grid::{Cell, Confines, Grid, GridProblem, Moves};
///
/// let grid = Grid::parse("
///     ..#..
///     .#...
///     #....
/// ").unwrap();
/// let problem = GridProblem::new(grid, Cell::new(0, 0), Cell::new(4, 2)).unwrap();
/// assert_eq!(Confines::default().measure(&problem, 100), Some(3));
///
/// let problem = problem.with_moves(Moves::Always);
/// assert_eq!(Confines::default().measure(&problem, 100), None);
/// ```
#[derive(Clone, Debug, Default)]
pub struct Confines {
    /// The rows of the square.
    rows: Vec<Row>,
}

/// A bit for each cell of a row.
#[derive(Clone, Copy, Debug)]
struct Row {
    free: u128,
    /// The same, the last bit first.
    turned: u128,
    /// What can be reached: whole runs of free cells.
    reached: u128,
}

impl Row {
    fn of(free: u128) -> Self {
        Self {
            free,
            turned: free.reverse_bits(),
            reached: 0,
        }
    }

    /// Reaches free cells, and all that is free beside them. A sum carries from each to the end of its run.
    fn reach(&mut self, cells: u128) {
        let after = |free: u128, cells: u128| (free ^ free.wrapping_add(cells)) & free | cells;
        let before = after(self.turned, cells.reverse_bits()).reverse_bits();
        self.reached |= before | after(self.free, cells);
    }
}

impl Confines {
    /// Whether a cell lies so near a start that it is looked at, if it can be reached.
    #[must_use]
    pub fn are_around(start: Cell, cell: Cell) -> bool {
        cell.x.abs_diff(start.x).max(cell.y.abs_diff(start.y)) <= REACH
    }

    /// How many cells can be reached from a free start, if they are few and the goal is none of them. `None` where a
    /// way leads far, and where that is not known after so many looks at a row.
    pub fn measure(&mut self, problem: &GridProblem, mut looks: u32) -> Option<u32> {
        let layout = problem.grid().layout();
        let place = |cell| layout.position(layout.id(cell));
        let (x0, y0) = place(problem.start());
        self.read(problem.grid(), (x0, y0));
        let goal = problem.goal();
        let goal = Self::are_around(problem.start(), goal).then(|| {
            let (x, y) = place(goal);
            (y + REACH - y0, 1 << (x + REACH - x0))
        });
        let leads_out = |at: u32, reached: u128| {
            let is_goal = |(row, bit)| at == row && reached & bit != 0;
            matches!(at, 0 | LAST) || reached & SIDES != 0 || goal.is_some_and(is_goal)
        };
        // Where one of the two cells beside a diagonal step has to be free, the way over that one is as good.
        let is_aslant = problem.moves() == Moves::Always;
        let middle = &mut self.rows[REACH as usize];
        middle.reach(1 << REACH);
        if leads_out(REACH, middle.reached) {
            return None;
        }
        loop {
            let mut is_new = false;
            let down = (0..LAST).map(|at| (at, at + 1));
            let up = (1..=LAST).rev().map(|at| (at, at - 1));
            for (from, to) in down.chain(up) {
                let reached = self.rows[from as usize].reached;
                if reached == 0 {
                    continue;
                }
                looks = looks.checked_sub(1)?;
                let aslant = [reached << 1, reached >> 1];
                let beside = if is_aslant { aslant } else { [0; 2] };
                let row = &mut self.rows[to as usize];
                let cells = (reached | beside[0] | beside[1]) & row.free & !row.reached;
                if cells == 0 {
                    continue;
                }
                is_new = true;
                row.reach(cells);
                if leads_out(to, row.reached) {
                    return None;
                }
            }
            if !is_new {
                let counts = self.rows.iter().map(|row| row.reached.count_ones());
                return Some(counts.sum());
            }
        }
    }

    /// Reads the rows around a place.
    fn read(&mut self, grid: &Grid, (x0, y0): (u32, u32)) {
        let layout = grid.layout();
        // Where the map begins within the square, what lies before is blocked.
        let (first, shift) = (x0.saturating_sub(REACH), REACH.saturating_sub(x0));
        // What follows a row of the map is the next one.
        let width = layout.pitch() - first;
        let within = u128::MAX >> 128u32.saturating_sub(width) << shift & u128::MAX >> 1;
        let row = |at: u32| {
            let y = (y0 + at).checked_sub(REACH)?;
            let id = (y <= layout.height()).then(|| layout.id_at((first, y)))?;
            let bits = [id, id + 64].map(|id| u128::from(grid.free_bits(id)));
            Some((bits[0] | bits[1] << 64) << shift & within)
        };
        self.rows.clear();
        let rows = (0..=LAST).map(|at| Row::of(row(at).unwrap_or(0)));
        self.rows.extend(rows);
    }

    /// Bytes held.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.rows.capacity() * size_of::<Row>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Grid;

    /// A square room with its walls so far from the robot, in the middle of a large map and in its corner.
    #[test]
    fn walls_count_as_far_as_a_row_of_bits_reaches() {
        for (middle, away) in [100, 20]
            .into_iter()
            .flat_map(|at| [1, 63, 64, 70].map(|away| (at, away)))
        {
            let robot = Cell::new(middle, middle);
            let off = |cell: Cell| cell.x.abs_diff(middle).max(cell.y.abs_diff(middle));
            let grid = Grid::new(300, 300, |cell| u8::from(off(cell) != away)).unwrap();
            for (goal, moves) in [299, middle].into_iter().flat_map(|at| {
                let goal = Cell::new(at, at);
                Moves::ALL.map(|moves| (goal, moves))
            }) {
                let problem = GridProblem::new(grid.clone(), robot, goal).unwrap();
                let problem = problem.with_moves(moves);
                let mut confines = Confines::default();
                let closed = away < 64 && goal != robot;
                // As far as the map goes.
                let side = away + middle.min(away - 1);
                for _ in 0..2 {
                    let found = confines.measure(&problem, 1 << 10);
                    assert_eq!(found, closed.then_some(side * side), "{away} {moves:?}");
                }
                assert_eq!(confines.measure(&problem, 1), None);
            }
        }
    }
}
