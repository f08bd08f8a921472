//! Which of a cell's successors a search on a grid without terrain need generate.
//!
//! Of the many optimal paths between two cells a search need only find one. Fix it: of all optimal
//! paths the one that goes diagonal as early as possible. Coming into a cell `x` from its neighbour
//! `p`, a successor `n` is *pruned* if within the 3 x 3 cells around `x` there is a way from `p` to
//! `n` that avoids `x` and is shorter, or equally long while the step into `x` was straight (then
//! the other way goes diagonal earlier). The fixed path never contains `p, x, n`, so nothing is
//! lost; what is left is one to three successors in the open instead of eight. Without diagonal
//! moves the same holds with *vertical* for *diagonal*.
//!
//! Equally short ways into a cell come from several directions, and then the successors of all of
//! them are due: a search keeps the *set* of directions it was reached in at its best cost.
//!
//! Sources: Harabor and Grastien, *Online Graph Pruning for Pathfinding on Grid Maps*, 2011;
//! Sturtevant and Rabin, *Canonical Orderings on Grids*, 2016.

use crate::{DIRECTIONS, Moves};
use std::{array, sync::OnceLock};

/// For each arrival direction and set of free neighbours: the directions to go on in.
pub type Successors = [[u8; 256]; 8];

/// The successors under `moves`; worked out at the first use.
#[must_use]
pub fn successors(moves: Moves) -> &'static Successors {
    static TABLES: [OnceLock<Box<Successors>>; 4] = [const { OnceLock::new() }; 4];
    TABLES[moves as usize].get_or_init(|| table(moves))
}

// Weights that order all ways within nine cells as 1 and sqrt 2 do.
const STRAIGHT: u32 = 169;
const DIAGONAL: u32 = 239;
const FAR: u32 = 1 << 20;
/// The cell itself among the nine.
const MIDDLE: usize = 4;

fn table(moves: Moves) -> Box<Successors> {
    let mut table = Box::new([[0; 256]; 8]);
    for (arrival, row) in table.iter_mut().enumerate() {
        let arrived = if arrival < 4 { STRAIGHT } else { DIAGONAL };
        let late = match moves {
            Moves::Orthogonal => DIRECTIONS[arrival].0 != 0,
            _ => arrival < 4,
        };
        let parent = place(MIDDLE, arrival & 4 | (arrival + 2) & 3);
        for (around, kept) in (0..=u8::MAX).zip(row) {
            let ways = ways_from(moves, around, parent);
            let legal = moves.legal(around);
            for k in (0..8).filter(|k| legal >> k & 1 == 1) {
                let through = arrived + if k < 4 { STRAIGHT } else { DIAGONAL };
                let past = place(MIDDLE, k).map_or(FAR, |at| ways[at]);
                if past > through || past == through && !late {
                    *kept |= 1 << k;
                }
            }
        }
    }
    table
}

/// The least weights from `parent` within the nine cells, never through the middle one. The middle
/// is free, though: as a corner it does not stand in the way of a diagonal.
fn ways_from(moves: Moves, around: u8, parent: Option<usize>) -> [u32; 9] {
    let mut ways = [FAR; 9];
    let free = |at: Option<usize>| {
        at.is_some_and(|at| {
            at == MIDDLE || (0..8).any(|k| around >> k & 1 == 1 && place(MIDDLE, k) == Some(at))
        })
    };
    let legal: [u8; 9] = array::from_fn(|from| {
        let around = (0..8).fold(0, |set, k| set | u8::from(free(place(from, k))) << k);
        moves.legal(around)
    });
    if let Some(parent) = parent.filter(|&at| free(Some(at))) {
        ways[parent] = 0;
    }
    let mut settled = false;
    while !settled {
        settled = true;
        for from in (0..9).filter(|&from| from != MIDDLE) {
            for k in (0..8).filter(|k| legal[from] >> k & 1 == 1) {
                let way = ways[from] + if k < 4 { STRAIGHT } else { DIAGONAL };
                if let Some(to) = place(from, k)
                    && to != MIDDLE
                    && way < ways[to]
                {
                    ways[to] = way;
                    settled = false;
                }
            }
        }
    }
    ways
}

/// Which of the nine cells, row by row, lies in direction `k` of another.
fn place(from: usize, k: usize) -> Option<usize> {
    let (dx, dy) = DIRECTIONS[k];
    let x = (from % 3).checked_add_signed(dx as isize)?;
    let y = (from / 3).checked_add_signed(dy as isize)?;
    (x < 3 && y < 3).then_some(x + 3 * y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn in_the_open_a_straight_step_goes_straight_on_and_a_diagonal_one_fans_out() {
        for moves in [
            Moves::Always,
            Moves::IfAtMostOneObstacle,
            Moves::OnlyWhenNoObstacles,
        ] {
            for k in 0..4 {
                assert_eq!(successors(moves)[k][255], 1 << k);
                let fan = 1 << k | 1 << ((k + 1) % 4) | 1 << (4 + k);
                assert_eq!(successors(moves)[4 + k][255], fan);
            }
        }
        // East only goes on east; south goes on, and to both sides.
        assert_eq!(successors(Moves::Orthogonal)[0][255], 0b0001);
        assert_eq!(successors(Moves::Orthogonal)[1][255], 0b0111);
    }

    #[test]
    fn a_wall_beside_a_straight_step_forces_a_turn() {
        // Going east with the cell to the north blocked.
        let around = 0xff ^ 1 << 3;
        assert_eq!(successors(Moves::Always)[0][around], 0b1000_0001);
        // Without corner cutting the turn comes one cell later: north-west is blocked, north free.
        let around = 0xff ^ 1 << 6;
        assert_eq!(
            successors(Moves::OnlyWhenNoObstacles)[0][around],
            0b1000_1001
        );
    }
}
