//! Where a straight run may have to turn, for a word of cells at once.

use pf_grid::Moves;

/// So many cells lie between the first and the last of a word.
pub(super) const RUN: u32 = 62;

/// Where scans stop among the [`RUN`] cells of a line from a place on, ahead and back: at blocked cells, and where
/// [`successors`](pf_grid::successors) have ways on from a straight step that do not lead straight on. `free` says which
/// of 64 cells from a place on are free, and a line lies `pitch` places behind the one before it. Lines are rows, or, as
/// far as there are diagonals, columns. Nothing is said of turns right behind a blocked cell, as no scan comes from there.
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

#[cfg(test)]
mod tests {
    use super::*;
    use pf_grid::{DIRECTIONS, successors};

    /// Whatever is free around a cell, under all rules.
    #[test]
    fn scans_stop_where_successors_lead_aside() {
        for moves in Moves::ALL {
            for (k, around) in (0..4).flat_map(|k| (0..=255u8).map(move |around| (k, around))) {
                let (dx, dy) = DIRECTIONS[k];
                // Without diagonals no scan goes up or down, and none comes from a blocked cell.
                let is_level = dy == 0;
                if moves == Moves::Orthogonal && !is_level || around >> ((k + 2) % 4) & 1 == 0 {
                    continue;
                }
                // The cell itself is in the second place of the second line; columns are lines of their own.
                let mut lines = [0, 0b10, 0];
                for (k, (x, y)) in DIRECTIONS.into_iter().enumerate() {
                    let (along, line) = if is_level { (x, y) } else { (y, x) };
                    let is_free = u64::from(around >> k & 1);
                    lines[(line + 1).cast_unsigned() as usize] |= is_free << (along + 1);
                }
                let free = |at: u32| lines[(at / 100) as usize];
                let [ahead, back] = stops(moves, free, 100, 101);
                let stops = if dx + dy > 0 { ahead } else { back };
                let elsewhere = successors(moves)[k][usize::from(around)] & !(1 << k) != 0;
                assert_eq!(stops & 1 == 1, elsewhere, "{moves}, {k}, {around:08b}");
            }
        }
    }
}
