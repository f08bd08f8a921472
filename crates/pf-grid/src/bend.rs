//! The steps of a path in another order, around what blocks it.

use crate::{Cell, problem::Steps};

/// So many steps before a break and after it are put in another order. In drives through a maze 12, 24 and
/// 40 keep 8,779, 8,799 and 8,871 of some 16,600 paths; the work grows with the square.
const REACH: usize = 16;
/// The places from which the rest leads on fit a word a row.
const _: () = assert!(3 * REACH < 64);

/// A step: how many columns and rows on.
type Way = (u32, u32);

fn way(from: Cell, to: Cell) -> Way {
    (to.x.wrapping_sub(from.x), to.y.wrapping_sub(from.y))
}

/// The cell so many steps of two kinds from another. It may be none.
fn after(from: Cell, [a, b]: [Way; 2], [of_a, of_b]: [usize; 2]) -> Cell {
    #[expect(clippy::cast_possible_truncation, reason = "a few steps")]
    let along = |from: u32, a: u32, b: u32| {
        let on = a
            .wrapping_mul(of_a as u32)
            .wrapping_add(b.wrapping_mul(of_b as u32));
        from.wrapping_add(on)
    };
    Cell {
        x: along(from.x, a.0, b.0),
        y: along(from.y, a.1, b.1),
    }
}

/// Makes a path legal whose illegal steps lie between two places, the first and the last of them: by
/// another order of the steps around them, as long as these are of two kinds. On a map without terrain
/// it then costs what it did. Says whether that was possible; if not, the path is as it was.
///
/// Of the orders the one is taken that goes diagonal first.
pub(crate) fn bend(steps: &Steps<'_>, path: &mut [Cell], [first, last]: [usize; 2]) -> bool {
    let mut ways = [way(path[first], path[first + 1]); 2];
    // Whether a step is of the two kinds, the second of which may be free yet.
    let mut fits = |at: usize| {
        let step = way(path[at], path[at + 1]);
        if ways[0] == ways[1] {
            ways[1] = step;
        }
        ways.contains(&step)
    };
    if last - first >= REACH || !(first..=last).all(&mut fits) {
        return false;
    }
    let before = (first.saturating_sub(REACH)..first).rev();
    let begin = first - before.take_while(|&at| fits(at)).count();
    let behind = last + 1..(path.len() - 1).min(last + 1 + REACH);
    let end = last + 1 + behind.take_while(|&at| fits(at)).count();
    if ways[0] == ways[1] {
        return false;
    }
    if ways[0].0 == 0 || ways[0].1 == 0 {
        ways.swap(0, 1);
    }
    let from = path[begin];
    let of_a = (begin..end).filter(|&at| way(path[at], path[at + 1]) == ways[0]);
    let of_a = of_a.count();
    let of_b = end - begin - of_a;
    // By steps of the first kind, a bit for each number of steps of the second from where the rest leads to
    // the end.
    let mut leads = [0u64; 3 * REACH + 1];
    for a in (0..=of_a).rev() {
        for b in (0..=of_b).rev() {
            let here = after(from, ways, [a, b]);
            let goes = |way: usize, next: [usize; 2]| {
                next[0] <= of_a
                    && leads[next[0]] >> next[1] & 1 == 1
                    && steps.are_legal(&[here, after(here, ways, [1 - way, way])])
            };
            let is_end = a == of_a && b == of_b;
            if is_end || goes(0, [a + 1, b]) || goes(1, [a, b + 1]) {
                leads[a] |= 1 << b;
            }
        }
    }
    if leads[0] & 1 == 0 {
        return false;
    }
    let mut done = [0, 0];
    for cell in &mut path[begin + 1..end] {
        let here = after(from, ways, done);
        let ahead = after(here, ways, [1, 0]);
        let is_first_kind = done[0] < of_a
            && leads[done[0] + 1] >> done[1] & 1 == 1
            && steps.are_legal(&[here, ahead]);
        done[usize::from(!is_first_kind)] += 1;
        *cell = after(from, ways, done);
    }
    true
}
