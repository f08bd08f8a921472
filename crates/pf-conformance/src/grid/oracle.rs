//! The truth about grid problems: a plain Dijkstra of the kit's own, slow and easy to believe.

use pf_core::Problem;
use pf_grid::{Cell, GridCost, GridProblem};
use std::{cmp::Reverse, collections::BinaryHeap};

/// The cost of the best path, or `None` if there is no path.
///
/// ```
/// # use pf_conformance::grid::{draw, oracle};
/// # use pf_grid::GridCost;
/// let problem = draw("
///     S#G
///     ...
/// ").unwrap();
/// assert_eq!(oracle(&problem), Some(GridCost::of_steps(4, 0)));
/// ```
#[must_use]
pub fn oracle(problem: &GridProblem) -> Option<GridCost> {
    match search(problem, |_| true) {
        Found::Path(path) => problem.judge(&path).ok(),
        Found::Nothing | Found::Stopped => None,
    }
}

/// How a [`search`] ended.
pub(crate) enum Found {
    /// With a best path.
    Path(Vec<Cell>),
    /// Knowing that there is none.
    Nothing,
    /// When it was told to.
    Stopped,
}

/// Settles cells in the order of their distance from the start, until the goal is. Each is shown
/// to `visit` before it is settled, which may say `false` to stop the search.
///
/// E. W. Dijkstra: A note on two problems in connexion with graphs. Numerische Mathematik 1, 1959.
pub(crate) fn search(problem: &GridProblem, mut visit: impl FnMut(Cell) -> bool) -> Found {
    let (grid, start, goal) = (problem.grid(), problem.start(), problem.goal());
    let layout = grid.layout();
    let mut reached: Vec<Option<(GridCost, Cell)>> = vec![None; layout.len()];
    let mut open = BinaryHeap::new();
    if grid.is_free(start) {
        reached[layout.id(start) as usize] = Some((GridCost::ZERO, start));
        open.push(Reverse((GridCost::ZERO, start)));
    }
    while let Some(Reverse((cost, cell))) = open.pop() {
        if reached[layout.id(cell) as usize].is_some_and(|(best, _)| best < cost) {
            continue;
        }
        if !visit(cell) {
            return Found::Stopped;
        }
        if cell == goal {
            let parent = |c: &Cell| reached[layout.id(*c) as usize].map(|(_, parent)| parent);
            let back = |c: &Cell| parent(c).filter(|parent| parent != c);
            let mut path: Vec<_> = std::iter::successors(Some(goal), back).collect();
            path.reverse();
            return Found::Path(path);
        }
        for (next, step) in grid.neighbours(cell, problem.moves()) {
            let (best, through) = (&mut reached[layout.id(next) as usize], cost + step);
            if best.is_none_or(|(best, _)| through < best) {
                *best = Some((through, cell));
                open.push(Reverse((through, next)));
            }
        }
    }
    Found::Nothing
}
