//! Where a search goes on from a cell.

use crate::{
    Grid, Moves, Weights, Word,
    canonical::{Successors, successors},
};

/// Where the search goes on from a cell, and at what weight.
pub(crate) trait Onward<W> {
    /// Whether the successors depend on the arrivals.
    const CANONICAL: bool;
    /// The set of directions in which it does, having been reached in these.
    fn onward(&self, id: u32, arrivals: u8) -> u8;
    /// What the step from one id to the next in direction `k` weighs.
    fn weight(&self, from: u32, to: u32, k: u32) -> W;
}

/// On a grid without terrain: canonical successors, two weights.
pub(crate) struct Pruned<'g> {
    grid: &'g Grid,
    moves: Moves,
    successors: &'static Successors,
}

impl<'g> Pruned<'g> {
    pub(crate) fn new(grid: &'g Grid, moves: Moves) -> Self {
        let successors = successors(moves);
        Self {
            grid,
            moves,
            successors,
        }
    }
}

impl<W: Word> Onward<W> for Pruned<'_> {
    const CANONICAL: bool = true;

    #[inline]
    fn onward(&self, id: u32, mut arrivals: u8) -> u8 {
        let around = self.grid.around_id(id);
        if arrivals == 0 {
            return self.moves.legal(around);
        }
        let mut onward = 0;
        while arrivals != 0 {
            onward |= self.successors[arrivals.trailing_zeros() as usize][usize::from(around)];
            arrivals &= arrivals - 1;
        }
        onward
    }

    #[inline]
    fn weight(&self, _: u32, _: u32, k: u32) -> W {
        if k < 4 { W::STRAIGHT } else { W::DIAGONAL }
    }
}

/// On a grid with terrain: all legal moves, each at the sum of the two cells' costs.
pub(crate) struct Weighed<'g> {
    grid: &'g Grid,
    moves: Moves,
    weights: Weights,
}

impl<'g> Weighed<'g> {
    pub(crate) fn new(grid: &'g Grid, moves: Moves) -> Self {
        let weights = Weights::of(grid);
        Self {
            grid,
            moves,
            weights,
        }
    }
}

impl<W: Word> Onward<W> for Weighed<'_> {
    const CANONICAL: bool = false;

    #[inline]
    fn onward(&self, id: u32, _: u8) -> u8 {
        self.moves.legal(self.grid.around_id(id))
    }

    #[inline]
    fn weight(&self, from: u32, to: u32, k: u32) -> W {
        self.weights.step(self.grid, from, to, k)
    }
}
