//! What is left of a broken path behind the break, and how to join it.

use crate::{Apart, Cell, DIRECTIONS, GridCost, GridProblem, Moves, Weights, Word};

/// So many places of it can be joined at the most,
const PLACES: usize = 6;
/// and none further behind the break than this.
const FAR: usize = 128;

/// What is left of a path behind a break, on a map without terrain.
///
/// A search around the break need not go on to the goal, nor the way it finds be walked down to there: it
/// ends where a way of two straight pieces leads to a place where the path turns, and is no longer than
/// any way there could be. See [`LastPath`](crate::LastPath).
#[derive(Debug)]
pub struct Tail<'p, W> {
    problem: &'p GridProblem,
    apart: Apart<W>,
    cells: &'p [Cell],
    /// Its begin and where it turns, and what is left from there.
    places: [(usize, W); PLACES],
    count: usize,
}

/// A piece of a way: its direction and how many steps it has.
type Piece = (u32, u32);

impl<'p, W: Word> Tail<'p, W> {
    /// Of the last cells of a path, which cost so much. `None` beyond [`Word::LIMIT`].
    pub(crate) fn of(problem: &'p GridProblem, cells: &'p [Cell], cost: GridCost) -> Option<Self> {
        let weights = Weights::of(problem.grid());
        let mut left = weights.of_cost(cost)?;
        let mut tail = Self {
            problem,
            apart: weights.apart(problem.moves()),
            cells,
            places: [(0, left); PLACES],
            count: 1,
        };
        let near = &cells[..cells.len().min(FAR)];
        let mut before = None;
        for (at, pair) in near.windows(2).enumerate() {
            let step = [
                pair[1].x.wrapping_sub(pair[0].x),
                pair[1].y.wrapping_sub(pair[0].y),
            ];
            if before.is_some_and(|before| before != step) {
                tail.add(at, left);
                if tail.count == PLACES {
                    return Some(tail);
                }
            }
            before = Some(step);
            let is_straight = step.contains(&0);
            left = left
                - if is_straight {
                    W::STRAIGHT
                } else {
                    W::DIAGONAL
                };
        }
        tail.add(near.len().saturating_sub(1), left);
        Some(tail)
    }

    fn add(&mut self, at: usize, left: W) {
        self.places[self.count] = (at, left);
        self.count += 1;
    }

    /// Where a way from a cell joins it that costs, with what is left there, no more than what is `left` from
    /// the cell at the least. `way` is then that way, both ends included.
    pub fn join(&self, from: Cell, left: W, way: &mut Vec<Cell>) -> Option<usize> {
        self.places[..self.count].iter().find_map(|&(at, rest)| {
            let to = self.cells[at];
            let apart = self.apart.by(from.x.abs_diff(to.x), from.y.abs_diff(to.y));
            let pieces = (apart + rest == left).then(|| self.pieces(from, to))??;
            way.clear();
            way.push(from);
            let mut cell = from;
            for (k, count) in pieces {
                let (dx, dy) = DIRECTIONS[k as usize];
                way.extend((0..count).map(|_| {
                    cell.x = cell.x.wrapping_add_signed(dx);
                    cell.y = cell.y.wrapping_add_signed(dy);
                    cell
                }));
            }
            Some(at)
        })
    }

    /// The pieces of a way from one cell to another, if one of the two that there are is legal.
    fn pieces(&self, from: Cell, to: Cell) -> Option<[Piece; 2]> {
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
        let orders = [pieces, [second, first]];
        orders
            .into_iter()
            .find(|pieces| self.are_legal(from, pieces))
    }

    fn are_legal(&self, from: Cell, pieces: &[Piece; 2]) -> bool {
        let (grid, moves) = (self.problem.grid(), self.problem.moves());
        let layout = grid.layout();
        let offsets = layout.offsets();
        let mut id = layout.id(from);
        pieces.iter().all(|&(k, count)| {
            (0..count).all(|_| {
                let legal = moves.legal(grid.around_id(id));
                id = id.wrapping_add_signed(offsets[k as usize]);
                legal >> k & 1 == 1
            })
        })
    }
}
