//! Ways down a field, and the steps they are made of.

use crate::{Grid, GridProblem, Layout, Moves, Weights, Word};

/// See [`Distances::downhill`](crate::Distances::downhill).
#[derive(Debug)]
pub struct Downhill<'d, W: Word> {
    values: &'d [W::Kept],
    steps: Steps<'d>,
}

impl<'d, W: Word> Downhill<'d, W> {
    /// Ahead of a way that begins: no direction.
    pub const NOWHERE: u32 = 8;

    pub(crate) fn of(values: &'d [W::Kept], steps: Steps<'d>) -> Self {
        Self { values, steps }
    }

    /// The next id on the way down from one, and the direction of the step: `ahead` if that leads
    /// there, so that ways are straight, else the last in the order of
    /// [`DIRECTIONS`](crate::DIRECTIONS), so diagonal ones first. [`NOWHERE`](Self::NOWHERE) is ahead of
    /// nothing.
    #[inline]
    #[must_use]
    pub fn next(&self, id: u32, ahead: u32) -> Option<(u32, u32)> {
        self.next_over(id, ahead, |_| true)
    }

    /// The same, where the next id is to be one of some.
    #[inline]
    pub fn next_over(
        &self,
        id: u32,
        ahead: u32,
        is_one: impl Fn(u32) -> bool,
    ) -> Option<(u32, u32)> {
        let left = W::of(self.values[id as usize]);
        let legal = self.steps.legal(id);
        let leads = |k: u32| {
            let next = id.wrapping_add_signed(self.steps.offsets[k as usize & 7]);
            let rest = W::of(self.values[next as usize]);
            let weight: W = self.steps.weights.step(self.steps.grid, id, next, k);
            (rest < left && rest + weight == left && is_one(next)).then_some((next, k))
        };
        if u32::from(legal) >> ahead & 1 == 1
            && let Some(on) = leads(ahead)
        {
            return Some(on);
        }
        let mut ways = legal;
        while ways != 0 {
            let k = ways.ilog2();
            ways &= !(1 << k);
            if let Some(on) = leads(k) {
                return Some(on);
            }
        }
        None
    }

    /// The id one step away in a direction.
    #[inline]
    #[must_use]
    pub fn along(&self, id: u32, k: u32) -> u32 {
        id.wrapping_add_signed(self.steps.offsets[k as usize & 7])
    }

    /// Goes down from an id and shows the direction of every step. Returns the last id: the root,
    /// or where there is no way on.
    #[inline]
    pub fn go(&self, from: u32, mut show: impl FnMut(u32)) -> u32 {
        let Some((mut id, mut k)) = self.next(from, Self::NOWHERE) else {
            return from;
        };
        let steps = &self.steps;
        let around = |id| steps.moves.legal(steps.grid.around_id(id));
        loop {
            show(k);
            // Ways are straight for the most part: on as long as that leads down.
            let offset = steps.offsets[k as usize & 7];
            let mut left = W::of(self.values[id as usize]);
            loop {
                let next = id.wrapping_add_signed(offset);
                if u32::from(around(id)) >> k & 1 == 0 {
                    break;
                }
                let rest = W::of(self.values[next as usize]);
                let weight: W = steps.weights.step(steps.grid, id, next, k);
                if rest >= left || rest + weight != left {
                    break;
                }
                (id, left) = (next, rest);
                show(k);
            }
            match self.next(id, k) {
                Some(on) => (id, k) = on,
                None => return id,
            }
        }
    }
}

/// Steps on a map by the weights of distances made before.
#[derive(Debug)]
pub(crate) struct Steps<'p> {
    grid: &'p Grid,
    moves: Moves,
    pub(crate) layout: Layout,
    pub(crate) offsets: [i32; 8],
    weights: Weights,
}

impl<'p> Steps<'p> {
    pub(crate) fn of(problem: &'p GridProblem, weights: Weights) -> Self {
        let grid = problem.grid();
        let layout = *grid.layout();
        Self {
            grid,
            moves: problem.moves(),
            layout,
            offsets: layout.offsets(),
            weights,
        }
    }

    /// The directions of the steps from an id: none if it is blocked.
    #[inline]
    fn legal(&self, id: u32) -> u8 {
        if self.grid.is_free_id(id) {
            self.moves.legal(self.grid.around_id(id))
        } else {
            0
        }
    }

    /// The ids one step away, and what the step weighs.
    #[inline]
    pub(crate) fn from<W: Word>(&self, id: u32) -> impl Iterator<Item = (u32, W)> + '_ {
        let legal = self.legal(id);
        let steps = (0..8).filter(move |k| legal >> k & 1 == 1);
        steps.map(move |k: u32| {
            let next = id.wrapping_add_signed(self.offsets[k as usize]);
            (next, self.weights.step(self.grid, id, next, k))
        })
    }
}
