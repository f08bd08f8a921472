//! Whether walls have closed around the robot.

use crate::{DIRECTIONS, GridProblem, Moves};
use pf_core::Context;

/// So far around the start is looked: two such and the start fit a row of bits.
const REACH: u32 = 63;
/// The last column or row there is, of a square around the start.
const LAST: u32 = 2 * REACH;

/// Proves that there is no way out, where that takes few steps: a search that only asks what can be reached takes
/// a third of the time of one that asks how far it is.
///
/// ```
/// use pf_core::Context;
/// use pf_grid::{Cell, Confines, Grid, GridProblem};
///
/// let grid = Grid::parse("
///     ..#..
///     .#...
///     #....
/// ").unwrap();
/// let mut problem = GridProblem::new(grid, Cell::new(0, 0), Cell::new(4, 2)).unwrap();
/// let mut cx = Context::seeded(0);
/// assert!(Confines::default().hold(&problem, &mut cx));
/// assert_eq!(cx.stats().expanded, 3);
///
/// problem = problem.with_moves(pf_grid::Moves::Always);
/// assert!(!Confines::default().hold(&problem, &mut Context::seeded(0)));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Confines {
    /// By row of the square a bit for each column: what was reached.
    reached: Vec<u128>,
    /// Of these the ids that were not yet left.
    open: Vec<u32>,
}

impl Confines {
    /// Whether nothing but a few cells can be reached from a free start, and the goal is none of them. `false` where
    /// a way leads far, and where the budget ends before that is known. One iteration is one cell.
    pub fn hold(&mut self, problem: &GridProblem, cx: &mut Context<'_, GridProblem>) -> bool {
        let (grid, moves) = (problem.grid(), problem.moves());
        let layout = grid.layout();
        let (offsets, goal) = (layout.offsets(), layout.id(problem.goal()));
        let start = layout.id(problem.start());
        let (x0, y0) = layout.position(start);
        // Where one of the two cells beside a diagonal step has to be free, the way over that one is as good.
        let asked = if moves == Moves::Always { 0xff } else { 0x0f };
        self.reached.clear();
        self.reached.resize(LAST as usize + 1, 0);
        self.reached[REACH as usize] = 1 << REACH;
        self.open.clear();
        self.open.push(start);
        // The last one first: that leads far soon, if anything does.
        while let Some(id) = self.open.pop() {
            let (x, y) = layout.position(id);
            let (column, row) = (x + REACH - x0, y + REACH - y0);
            let is_far = [column, row].iter().any(|at| matches!(*at, 0 | LAST));
            if id == goal || is_far || !cx.proceed() {
                return false;
            }
            cx.expanded(|| layout.cell(id));
            let mut ways = moves.legal(grid.around_id(id)) & asked;
            while ways != 0 {
                let k = ways.trailing_zeros() as usize;
                ways &= ways - 1;
                let (dx, dy) = DIRECTIONS[k];
                let row = &mut self.reached[row.wrapping_add_signed(dy) as usize];
                let bit = 1 << column.wrapping_add_signed(dx);
                if *row & bit == 0 {
                    *row |= bit;
                    self.open.push(id.wrapping_add_signed(offsets[k]));
                }
            }
        }
        true
    }

    /// Bytes held.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.reached.capacity() * size_of::<u128>() + self.open.capacity() * size_of::<u32>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Cell, Grid, Moves};
    use pf_core::Budget;

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
                for _ in 0..2 {
                    let mut cx = Context::seeded(0);
                    assert_eq!(confines.hold(&problem, &mut cx), closed, "{away} {moves:?}");
                }
                let budget = Budget::unlimited().iterations(0);
                let mut cx = Context::seeded(0).within(budget);
                assert!(!confines.hold(&problem, &mut cx));
            }
        }
    }
}
