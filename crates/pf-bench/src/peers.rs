//! Published crates on our problems, under the same moves and weights, each as its own
//! documentation shows.

use pf_grid::{Cell, DIRECTIONS, GridCost, GridProblem, Word};

/// The legal steps from a cell in the weights all contenders count in.
fn successors(problem: &GridProblem, at: Cell) -> impl Iterator<Item = (Cell, u32)> + use<> {
    let grid = problem.grid();
    let legal = problem.moves().legal(grid.around_id(grid.layout().id(at)));
    (0..8).filter(move |k| legal >> k & 1 == 1).map(move |k| {
        let (dx, dy) = DIRECTIONS[k];
        let next = Cell {
            x: at.x.wrapping_add_signed(dx),
            y: at.y.wrapping_add_signed(dy),
        };
        let weight = if k < 4 { u32::STRAIGHT } else { u32::DIAGONAL };
        (next, weight)
    })
}

fn octile(a: Cell, b: Cell) -> u32 {
    let (dx, dy) = (a.x.abs_diff(b.x), a.y.abs_diff(b.y));
    u32::STRAIGHT * dx.abs_diff(dy) + u32::DIAGONAL * dx.min(dy)
}

/// `pathfinding::prelude::astar`.
pub(crate) fn pathfinding_astar(problem: &GridProblem) -> Option<Vec<Cell>> {
    let goal = problem.goal();
    let found = pathfinding::prelude::astar(
        &problem.start(),
        |&at| successors(problem, at),
        |&at| octile(at, goal),
        |&at| at == goal,
    );
    found.map(|(path, _)| path)
}

/// `pathfinding::prelude::dijkstra`.
pub(crate) fn pathfinding_dijkstra(problem: &GridProblem) -> Option<Vec<Cell>> {
    let goal = problem.goal();
    let found = pathfinding::prelude::dijkstra(
        &problem.start(),
        |&at| successors(problem, at),
        |&at| at == goal,
    );
    found.map(|(path, _)| path)
}

/// What a peer's path costs; `None` if it is none.
pub(crate) fn cost(problem: &GridProblem, path: Option<Vec<Cell>>) -> Option<GridCost> {
    pf_core::Problem::judge(problem, &path?).ok()
}
