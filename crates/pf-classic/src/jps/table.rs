//! How far jumps go, from every cell in every direction.

use super::{
    jumps::{Jumps, fans},
    map::Place,
};
use pf_core::Stamp;
use pf_grid::{Grid, GridProblem, Layout, Moves, successors};

/// For each cell and direction: how many steps on a jump ends, above 0; or, 0 or below, how many
/// steps lead nowhere.
///
/// A straight run ends where a turn is due. A diagonal one (up and down, where there are none) goes
/// on to the next cell from which a straight run ends somewhere, or where a turn is due.
///
/// Source: Harabor and Grastien, *Improving Jump Point Search*, 2014 (JPS+).
#[derive(Clone, Debug, Default)]
pub(super) struct JumpTable {
    made: Option<(Stamp, Moves, Layout)>,
    /// By id.
    far: Vec<[i16; 8]>,
}

/// The longest run that a table holds.
const MOST: u32 = i16::MAX as u32;

impl JumpTable {
    /// Whether it is that of this grid as it is.
    pub(super) fn is_of(&self, grid: &Grid, moves: Moves) -> bool {
        self.made == Some((grid.stamp(), moves, *grid.layout()))
    }

    /// Whether runs on this grid are short enough.
    pub(super) fn fits(grid: &Grid) -> bool {
        grid.width().max(grid.height()) <= MOST
    }

    /// Makes it for a grid that fits.
    pub(super) fn make(&mut self, grid: &Grid, moves: Moves) {
        let layout = *grid.layout();
        self.made = Some((grid.stamp(), moves, layout));
        self.far.clear();
        self.far.resize(layout.len(), [0; 8]);
        let fans = fans(moves);
        // Runs first: what diagonals look for.
        for k in (0..8).filter(|k| fans >> k & 1 == 0 && *k < 4) {
            self.sweep(grid, moves, k);
        }
        for k in (0..8).filter(|k| fans >> k & 1 == 1) {
            self.sweep(grid, moves, k);
        }
    }

    /// Fills in one direction, the cells that lie furthest that way first.
    fn sweep(&mut self, grid: &Grid, moves: Moves, k: usize) {
        let layout = *grid.layout();
        let offset = layout.offsets()[k];
        let onward = &successors(moves)[k];
        let (open, sides) = (onward[0xff], !fans(moves));
        let mut cell = |id: u32| {
            if !grid.is_free_id(id) || moves.legal(grid.around_id(id)) >> k & 1 == 0 {
                return;
            }
            let next = id.wrapping_add_signed(offset);
            let ways = onward[usize::from(grid.around_id(next))];
            let there = self.far[next as usize];
            let turns = ways & !open != 0
                || (0..4).any(|side| {
                    side != k && ways & sides & open & 1 << side != 0 && there[side] > 0
                });
            self.far[id as usize][k] = if turns {
                1
            } else if ways >> k & 1 == 0 {
                -1
            } else if there[k] > 0 {
                there[k] + 1
            } else {
                there[k] - 1
            };
        };
        // Ids grow to the east and to the south.
        let ids = 0..u32::try_from(layout.len()).unwrap_or(u32::MAX);
        if offset > 0 {
            ids.rev().for_each(&mut cell);
        } else {
            ids.for_each(&mut cell);
        }
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        self.far.capacity() * size_of::<[i16; 8]>()
    }
}

/// By a table; the goal is looked for along the way.
#[derive(Debug)]
pub(super) struct Lookups<'p> {
    table: &'p JumpTable,
    layout: Layout,
    offsets: [i32; 8],
    goal: (u32, u32),
    goal_id: u32,
    orthogonal: bool,
}

impl<'p> Lookups<'p> {
    pub(super) fn of(problem: &GridProblem, table: &'p JumpTable) -> Self {
        let layout = *problem.grid().layout();
        let goal_id = layout.id(problem.goal());
        Self {
            table,
            layout,
            offsets: layout.offsets(),
            goal: layout.position(goal_id),
            goal_id,
            orthogonal: problem.moves() == Moves::Orthogonal,
        }
    }

    /// How many steps in a direction a place is from the goal's row or column, whichever comes first;
    /// from the goal itself in a straight run. `None` if it is not that way.
    #[inline]
    fn crossing(&self, id: u32, k: usize) -> Option<u32> {
        let (x, y) = self.layout.position(id);
        let (dx, dy) = (
            self.goal.0.wrapping_sub(x).cast_signed(),
            self.goal.1.wrapping_sub(y).cast_signed(),
        );
        let (east, south) = pf_grid::DIRECTIONS[k];
        let steps = match (east, south) {
            (0, _) if self.orthogonal => dy * south,
            (_, 0) if dy == 0 => dx * east,
            (0, _) if dx == 0 => dy * south,
            (0, _) | (_, 0) => return None,
            _ => (dx * east).min(dy * south),
        };
        u32::try_from(steps).ok().filter(|&steps| steps > 0)
    }
}

impl Jumps for Lookups<'_> {
    #[inline]
    fn place(&self, id: u32) -> Place {
        Place::only(id)
    }

    #[inline]
    fn run(&self, from: Place, k: usize) -> Option<(u32, u32)> {
        let far = self.table.far[from.id as usize][k];
        let most = u32::from(far.unsigned_abs());
        if let Some(steps) = self.crossing(from.id, k).filter(|&steps| steps <= most) {
            return Some((self.goal_id, steps));
        }
        let on = self.offsets[k].wrapping_mul(i32::from(far));
        (far > 0).then(|| (from.id.wrapping_add_signed(on), most))
    }

    #[inline]
    fn stride(&self, from: Place, k: usize) -> Option<(Place, u32)> {
        let far = self.table.far[from.id as usize][k];
        let most = u32::from(far.unsigned_abs());
        let crossing = self.crossing(from.id, k).filter(|&steps| steps <= most);
        let steps = crossing.or_else(|| (far > 0).then_some(most))?;
        let on = self.offsets[k].wrapping_mul(steps.cast_signed());
        Some((Place::only(from.id.wrapping_add_signed(on)), steps))
    }
}
