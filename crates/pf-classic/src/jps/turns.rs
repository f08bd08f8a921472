//! Where a straight run may have to turn, for a word of cells at once.

use pf_grid::Moves;

/// So many cells lie between the first and the last of a word.
pub(super) const RUN: u32 = 62;

/// Where scans stop among the [`RUN`] cells of a line from a place on, ahead and back: at blocked cells, and where
/// [`successors`](pf_grid::successors) have ways on from a straight step that do not lead straight on. `free` says which
/// of 64 cells from a place on are free, and a line lies `pitch` places behind the one before it. Lines are rows, or, as
/// far as there are diagonals, columns.
/// No scan comes to a cell from a blocked one.
#[inline]
pub(super) fn stops(moves: Moves, free: impl Fn(u32) -> u64, pitch: u32, first: u32) -> [u64; 2] {
    let first = first.wrapping_sub(1);
    let lines = [first.wrapping_sub(pitch), first, first.wrapping_add(pitch)].map(free);
    // Of each line what lies before the cells, beside them, and behind.
    let lines = lines.map(|line| [line, line >> 1, line >> 2]);
    let blocked = !lines[1][1];
    let back = lines.map(|[before, at, behind]| [behind, at, before]);
    [lines, back].map(|lines| turns(moves, lines) | blocked)
}

/// Where ways lead aside from a straight step along the line in the middle.
#[inline]
fn turns(moves: Moves, [left, [from, _, to], right]: [[u64; 3]; 3]) -> u64 {
    let aside = |[before, at, behind]: [u64; 3]| match moves {
        Moves::Orthogonal | Moves::OnlyWhenNoObstacles => at & !before,
        Moves::Always => behind & !at,
        Moves::IfAtMostOneObstacle => behind & to & !at,
    };
    (aside(left) | aside(right)) & from
}
