//! Published crates on our problems, each as its own documentation shows, under the same moves and
//! weights where they can.
//!
//! `pathfinding` is asked by functions that say the legal steps and the octile distance, on our grid.
//! `petgraph` searches its compressed sparse rows, made of the legal steps before the clock runs.
//! `grid_pathfinding` jumps over a grid of its own, made with its components before the clock runs; it
//! cuts corners and passes between two blocked cells that touch at a corner (our `always`), and weighs
//! steps 70 and 99, so what is asked of its paths is to be shortest in these weights. Version 0.3.0 takes
//! the first step of a jump for as long as the step by which it came (`pruned_neighborhood`), so some
//! are not, by up to 1 %: its mismatches count them.

use super::contender::{Answer, Contender};
use grid_pathfinding::PathingGrid;
use grid_util::{grid::ValueGrid as _, point::Point};
use petgraph::csr::Csr;
use pf_core::Problem as _;
use pf_grid::{Cell, Grid, GridProblem, Moves, Word};

/// The legal steps from a cell in the weights all contenders count in.
fn successors(problem: &GridProblem, at: Cell) -> impl Iterator<Item = (Cell, u32)> + use<> {
    steps(problem.grid(), problem.moves(), at)
}

fn steps(grid: &Grid, moves: Moves, at: Cell) -> impl Iterator<Item = (Cell, u32)> + use<> {
    let legal = moves.legal(grid.around_id(grid.layout().id(at)));
    (0..8).filter(move |k| legal >> k & 1 == 1).map(move |k| {
        let next = at.towards(k);
        let weight = if k < 4 { u32::STRAIGHT } else { u32::DIAGONAL };
        (next, weight)
    })
}

fn octile(a: Cell, b: Cell) -> u32 {
    let (dx, dy) = (a.x.abs_diff(b.x), a.y.abs_diff(b.y));
    u32::STRAIGHT * dx.abs_diff(dy) + u32::DIAGONAL * dx.min(dy)
}

/// `pathfinding::prelude::astar` or `dijkstra`.
pub(super) struct Pathfinding {
    pub(super) guided: bool,
    pub(super) path: Option<Vec<Cell>>,
}

impl Contender for Pathfinding {
    fn name(&self) -> &'static str {
        if self.guided {
            "pathfinding::astar"
        } else {
            "pathfinding::dijkstra"
        }
    }

    fn search(&mut self, problem: &GridProblem) {
        let (start, goal) = (problem.start(), problem.goal());
        let onward = |&at: &Cell| successors(problem, at);
        let found = if self.guided {
            let left = |&at: &Cell| octile(at, goal);
            pathfinding::prelude::astar(&start, onward, left, |&at| at == goal)
        } else {
            pathfinding::prelude::dijkstra(&start, onward, |&at| at == goal)
        };
        self.path = found.map(|(path, _)| path);
    }

    fn answer(&mut self, problem: &GridProblem) -> Answer {
        Answer::of_path(problem, self.path.take())
    }
}

/// `petgraph::algo::astar`.
pub(super) struct Petgraph {
    graph: Csr<(), u32>,
    width: u32,
    path: Option<Vec<u32>>,
}

impl Petgraph {
    pub(super) fn of(grid: &Grid, moves: Moves) -> Self {
        let width = grid.width();
        let node = |cell: Cell| cell.y * width + cell.x;
        let mut edges = Vec::new();
        for cell in grid.layout().cells().filter(|&cell| grid.is_free(cell)) {
            let first = edges.len();
            let onward = steps(grid, moves, cell);
            edges.extend(onward.map(|(next, weight)| (node(cell), node(next), weight)));
            edges[first..].sort_unstable();
        }
        let mut graph = Csr::from_sorted_edges(&edges).unwrap_or_else(|_| Csr::new());
        // Blocked cells after the last edge are nodes, too.
        while graph.node_count() < (width * grid.height()) as usize {
            graph.add_node(());
        }
        Self {
            graph,
            width,
            path: None,
        }
    }

    fn cell(&self, node: u32) -> Cell {
        Cell::new(node % self.width, node / self.width)
    }
}

impl Contender for Petgraph {
    fn name(&self) -> &'static str {
        "petgraph::astar"
    }

    fn search(&mut self, problem: &GridProblem) {
        let goal = problem.goal();
        let node = |cell: Cell| cell.y * self.width + cell.x;
        let (from, to) = (node(problem.start()), node(goal));
        let found = petgraph::algo::astar(
            &self.graph,
            from,
            |at| at == to,
            |edge| *edge.weight(),
            |at| octile(self.cell(at), goal),
        );
        self.path = found.map(|(_, path)| path);
    }

    fn answer(&mut self, problem: &GridProblem) -> Answer {
        let path = self.path.take();
        let path = path.map(|path| path.into_iter().map(|node| self.cell(node)).collect());
        Answer::of_path(problem, path)
    }
}

/// `grid_pathfinding::PathingGrid::get_path_single_goal`.
pub(super) struct Jumping {
    grid: PathingGrid,
    path: Option<Vec<Point>>,
}

impl Jumping {
    /// What it weighs a straight and a diagonal step.
    pub(super) const WEIGHTS: [u64; 2] = [70, 99];

    pub(super) fn of(grid: &Grid) -> Self {
        let size = [grid.width() as usize, grid.height() as usize];
        let mut copy = PathingGrid::new(size[0], size[1], false);
        for cell in grid.layout().cells().filter(|&cell| !grid.is_free(cell)) {
            let Point { x, y } = point(cell);
            copy.set(x, y, true);
        }
        copy.generate_components();
        Self {
            grid: copy,
            path: None,
        }
    }
}

impl Contender for Jumping {
    fn name(&self) -> &'static str {
        "grid_pathfinding::jps"
    }

    fn search(&mut self, problem: &GridProblem) {
        let (start, goal) = (point(problem.start()), point(problem.goal()));
        self.path = self.grid.get_path_single_goal(start, goal, false);
    }

    fn answer(&mut self, problem: &GridProblem) -> Answer {
        let cell = |p: Point| Cell::new(p.x.cast_unsigned(), p.y.cast_unsigned());
        let path = self.path.take();
        let path = path.map(|path| path.into_iter().map(cell).collect());
        Answer::of_path(problem, path)
    }
}

fn point(cell: Cell) -> Point {
    Point::new(cell.x.cast_signed(), cell.y.cast_signed())
}

impl Answer {
    /// What a peer's path costs, marked by our judge.
    fn of_path(problem: &GridProblem, path: Option<Vec<Cell>>) -> Self {
        let (mut cost, mut proof) = (None, true);
        if let Some(path) = path {
            cost = problem.judge(&path).ok();
            // A path that breaks a rule answers nothing.
            proof = cost.is_some();
        }
        Self {
            cost,
            proof,
            expanded: 0,
        }
    }
}
