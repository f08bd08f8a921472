//! What is left of a path at one end, and how to join it.

use crate::{Apart, Beeline, Cell, GridCost, GridProblem, Weights, Word};

/// So many places of it can be joined at the most,
const PLACES: usize = 6;
/// and none further along than this.
pub(crate) const FAR: usize = 128;

/// What is left of a shortest path at one of its ends, on a map without terrain: see
/// [`LastPath::remnant`](crate::LastPath::remnant).
///
/// A search towards that end need not go on to it, nor the way it finds be followed to there: it ends where a
/// way of two straight pieces leads to where the remnant begins or turns, if that is no longer in all than any
/// way there could be.
#[derive(Debug)]
pub struct Remnant<'p, W> {
    line: Beeline<'p>,
    apart: Apart<W>,
    /// Where it can be joined, the place that is furthest from the end first: how far along, the cell, and
    /// what is left from there.
    places: [(usize, Cell, W); PLACES],
    count: usize,
}

impl<'p, W: Word> Remnant<'p, W> {
    /// Of cells, [`FAR`] and one at the most, from the first of which to the end it costs so much. `None` beyond
    /// [`Word::LIMIT`].
    pub(crate) fn of(
        problem: &'p GridProblem,
        mut cells: impl Iterator<Item = Cell>,
        cost: GridCost,
    ) -> Option<Self> {
        let weights = Weights::of(problem.grid());
        let mut left = weights.of_cost(cost)?;
        let mut cell = cells.next()?;
        let mut remnant = Self {
            line: Beeline::of(problem),
            apart: weights.apart(problem.moves()),
            places: [(0, cell, left); PLACES],
            count: 1,
        };
        let weigh = |[from, to]: [Cell; 2]| {
            if from.x == to.x || from.y == to.y {
                W::STRAIGHT
            } else {
                W::DIAGONAL
            }
        };
        // In one number, as this looks at each cell.
        let packed = |cell: Cell| u64::from(cell.y) << 32 | u64::from(cell.x);
        // The last step, its cells, and so many of its kind, the first of them from here.
        let (mut last, mut ends, mut run, mut along) = (0, [cell; 2], 0, 0);
        for next in cells {
            let step = packed(next).wrapping_sub(packed(cell));
            if step != last {
                if run > 0 {
                    left = left - weigh(ends).times(run);
                    along += run as usize;
                    remnant.add(along, cell, left);
                    if remnant.count == PLACES {
                        return Some(remnant);
                    }
                }
                (last, ends, run) = (step, [cell, next], 0);
            }
            (run, cell) = (run + 1, next);
        }
        if run > 0 {
            remnant.add(along + run as usize, cell, left - weigh(ends).times(run));
        }
        Some(remnant)
    }

    fn add(&mut self, at: usize, cell: Cell, left: W) {
        self.places[self.count] = (at, cell, left);
        self.count += 1;
    }

    /// How far along a way from a cell joins it that costs, with what is left there, no more than what is
    /// `left` from the cell at the least. `way` is then that way, both ends included.
    pub fn join(&self, from: Cell, left: W, way: &mut Vec<Cell>) -> Option<usize> {
        self.places[..self.count]
            .iter()
            .find_map(|&(at, to, rest)| {
                let apart = self.apart.by(from.x.abs_diff(to.x), from.y.abs_diff(to.y));
                (apart + rest == left && self.line.way(from, to, way)).then_some(at)
            })
    }
}
