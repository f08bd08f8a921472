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
    let of_a = path[begin..=end].windows(2);
    let of_a = of_a.filter(|pair| way(pair[0], pair[1]) == ways[0]).count();
    let of_b = end - begin - of_a;
    // Depth first, the first kind first. By steps of the first kind, a bit for each number of steps of the
    // second from where nothing leads to the end.
    let mut dead = [0u64; 3 * REACH + 1];
    // The steps taken, a bit each: whether it is of the second kind.
    let places = ways.map(Steps::place);
    let (mut done, mut taken) = ([0, 0], 0u64);
    let mut here = from;
    while done != [of_a, of_b] {
        let legal = steps.from(here);
        let leads = |kind: usize| {
            let mut next = done;
            next[kind] += 1;
            let is_open = next[0] <= of_a && next[1] <= of_b && dead[next[0]] >> next[1] & 1 == 0;
            is_open && legal >> places[kind] & 1 == 1
        };
        if let Some(kind) = [0, 1].into_iter().find(|&kind| leads(kind)) {
            taken = taken << 1 | kind as u64;
            done[kind] += 1;
            here = after(here, ways, [1 - kind, kind]);
            continue;
        }
        if done == [0, 0] {
            return false;
        }
        dead[done[0]] |= 1 << done[1];
        done[(taken & 1) as usize] -= 1;
        taken >>= 1;
        here = after(from, ways, done);
    }
    let mut here = from;
    for (at, cell) in path[begin + 1..end].iter_mut().enumerate() {
        let kind = (taken >> (end - begin - 1 - at) & 1) as usize;
        here = after(here, ways, [1 - kind, kind]);
        *cell = here;
    }
    true
}
