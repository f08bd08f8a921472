//! Where jumps end: found by scans, or looked up.

use super::map::{JumpMap, Place};
use pf_grid::{Grid, GridProblem, Layout, Moves};

/// The directions in which a search looks to both sides of every cell: diagonals, or up and down
/// where there are none. In the others it runs straight on.
pub(super) const fn fans(moves: Moves) -> u8 {
    match moves {
        Moves::Orthogonal => 0b1010,
        _ => 0xf0,
    }
}

/// Where jumps end on a grid, for one goal.
pub(super) trait Jumps {
    /// A cell by its id.
    fn place(&self, id: u32) -> Place;

    /// The free cell at which a straight run from a place stops, if there is one, and how far it is.
    fn run(&self, from: Place, k: usize) -> Option<(u32, u32)>;

    /// The next place from which runs to the sides may stop somewhere, or where a turn is due, on the
    /// way from a place in a direction in which a step is legal, and how far it is.
    fn stride(&self, from: Place, k: usize) -> Option<(Place, u32)>;
}

/// By scans; the goal is marked in the map.
#[derive(Debug)]
pub(super) struct Scans<'p> {
    grid: &'p Grid,
    layout: Layout,
    map: &'p JumpMap,
    steps: [(i32, i32); 8],
}

impl<'p> Scans<'p> {
    pub(super) fn of(problem: &'p GridProblem, map: &'p JumpMap) -> Self {
        let layout = *problem.grid().layout();
        Self {
            grid: problem.grid(),
            layout,
            map,
            steps: map.steps(&layout),
        }
    }
}

impl Jumps for Scans<'_> {
    #[inline]
    fn place(&self, id: u32) -> Place {
        self.map.place(&self.layout, id)
    }

    #[inline]
    fn run(&self, from: Place, k: usize) -> Option<(u32, u32)> {
        let steps = self.map.scan(from, k);
        let offset = self.steps[k].0.wrapping_mul(steps.cast_signed());
        let at = from.id.wrapping_add_signed(offset);
        self.grid.is_free_id(at).then_some((at, steps))
    }

    #[inline]
    fn stride(&self, from: Place, k: usize) -> Option<(Place, u32)> {
        Some((from.step(self.steps[k]), 1))
    }
}
