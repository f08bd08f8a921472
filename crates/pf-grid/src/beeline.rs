//! Ways of two straight pieces.

use crate::{Cell, DIRECTIONS, GridCost, GridProblem, Moves, problem::Steps};

/// Ways from one cell to another as short as if nothing stood between them, of two straight pieces: diagonal and
/// straight, in one order or the other; along the row and the column where there are no diagonals.
///
/// On a map without terrain no way is shorter. To look whether one of the two is open takes a step for each cell until
/// something is in the way.
#[derive(Clone, Copy, Debug)]
pub struct Beeline<'p> {
    problem: &'p GridProblem,
}

/// A piece of a way: its direction and how many steps it has.
type Piece = (u32, u32);

impl<'p> Beeline<'p> {
    /// On a problem's grid, by its move rule.
    #[must_use]
    pub fn of(problem: &'p GridProblem) -> Self {
        Self { problem }
    }

    /// What such a way costs where there is no terrain; no way costs less anywhere.
    #[must_use]
    pub fn cost(self, from: Cell, to: Cell) -> GridCost {
        let (dx, dy) = (from.x.abs_diff(to.x), from.y.abs_diff(to.y));
        let diagonal = match self.problem.moves() {
            Moves::Orthogonal => 0,
            _ => dx.min(dy),
        };
        GridCost::of_steps(u64::from(dx + dy - 2 * diagonal), u64::from(diagonal))
    }

    /// Whether such a way between two cells is open. If so, `way` becomes that way, both ends included; `from` must be free.
    pub fn way(self, from: Cell, to: Cell, way: &mut Vec<Cell>) -> bool {
        self.look(from, to, way).0
    }

    /// The same, and how many steps were looked at.
    pub fn look(self, from: Cell, to: Cell, way: &mut Vec<Cell>) -> (bool, u32) {
        let (pieces, steps) = self.pieces(from, to);
        let Some(pieces) = pieces else {
            return (false, steps);
        };
        way.clear();
        way.push(from);
        let mut cell = from;
        for (k, count) in pieces {
            way.extend((0..count).map(|_| {
                cell = cell.towards(k as usize);
                cell
            }));
        }
        (true, steps)
    }

    fn pieces(self, from: Cell, to: Cell) -> (Option<[Piece; 2]>, u32) {
        let (dx, dy) = (from.x.abs_diff(to.x), from.y.abs_diff(to.y));
        let row = (if to.x > from.x { 0 } else { 2 }, dx);
        let column = (if to.y > from.y { 1 } else { 3 }, dy);
        let pieces = if self.problem.moves() == Moves::Orthogonal {
            [row, column]
        } else {
            let (longer, shorter) = if dx > dy {
                (row, column)
            } else {
                (column, row)
            };
            // Direction `4 + i` lies between `i` and the next one.
            let between = if (row.0 + 1) % 4 == column.0 {
                row.0
            } else {
                column.0
            };
            [(4 + between, shorter.1), (longer.0, longer.1 - shorter.1)]
        };
        let [first, second] = pieces;
        let mut steps = 0;
        let orders = [pieces, [second, first]];
        let open = orders
            .into_iter()
            .find(|pieces| self.are_legal(from, pieces, &mut steps));
        (open, steps)
    }

    fn are_legal(self, from: Cell, pieces: &[Piece; 2], steps: &mut u32) -> bool {
        let legal = Steps::of(self.problem);
        let mut cell = from;
        pieces.iter().all(|&(k, count)| {
            let (taken, end) = legal.run(cell, DIRECTIONS[k as usize], count);
            cell = end;
            *steps += taken;
            taken == count
        })
    }
}
