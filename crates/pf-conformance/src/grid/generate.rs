//! Grid problems and changes made up by seed, for tests in their thousands.

use crate::PlanRng;
use pf_grid::{Cell, Grid, GridChange, GridProblem, Layout, Moves};
use rand::{
    RngExt,
    seq::{IndexedRandom, SliceRandom},
};
use std::ops::RangeInclusive;

/// What a made-up map looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Cells blocked at random.
    Noise,
    /// Corridors one cell wide; the density opens that share of the walls.
    Maze,
    /// Rooms with doors; the density leaves out that share of the doors.
    Rooms,
    /// Long parallel corridors with few passages between them.
    Corridors,
}

impl Kind {
    /// Every kind.
    pub const ALL: [Self; 4] = [Self::Noise, Self::Maze, Self::Rooms, Self::Corridors];
}

/// What to make up.
#[derive(Clone, Debug)]
pub struct Recipe {
    /// What the map looks like.
    pub kind: Kind,
    /// Columns and rows, each chosen from here, from 1.
    pub size: RangeInclusive<u32>,
    /// How full it is, from 0 to 1; see [`Kind`].
    pub density: f64,
    /// Whether it has terrain.
    pub terrain: bool,
    /// Which steps are allowed.
    pub moves: Moves,
}

impl Recipe {
    /// Everything at random but the size.
    pub fn any(rng: &mut PlanRng, size: RangeInclusive<u32>) -> Self {
        Self {
            kind: *pick(rng, &Kind::ALL),
            size,
            density: rng.random_range(0.0..0.45),
            terrain: rng.random_bool(0.3),
            moves: *pick(rng, &Moves::ALL),
        }
    }
}

/// A problem by `recipe`. Start and goal are free where there are free cells.
///
/// The same generator state gives the same problem, in this and every release until the changelog
/// says otherwise.
///
/// # Panics
/// If the recipe asks for what cannot be: no size, a size that no grid may have, a density beyond 1.
///
/// ```
/// # use pf_conformance::{grid::{Kind, Recipe, random_problem}, seeded};
/// # use pf_grid::Moves;
/// let recipe = Recipe {
///     kind: Kind::Rooms,
///     size: 20..=40,
///     density: 0.2,
///     terrain: false,
///     moves: Moves::OnlyWhenNoObstacles,
/// };
/// let problem = random_problem(&mut seeded(7), &recipe);
/// assert!(problem.grid().width() >= 20 && problem.grid().is_free(problem.start()));
/// ```
pub fn random_problem(rng: &mut PlanRng, recipe: &Recipe) -> GridProblem {
    let width = rng.random_range(recipe.size.clone());
    let height = rng.random_range(recipe.size.clone());
    let walls = match recipe.kind {
        Kind::Noise => noise(rng, width, height, recipe.density),
        Kind::Maze => maze(rng, width, height, recipe.density),
        Kind::Rooms => rooms(rng, width, height, recipe.density),
        Kind::Corridors => corridors(rng, width, height, recipe.density),
    };
    let dearest = *pick(rng, &[3, 9, 9, 254]);
    let grid = Grid::new(width, height, |cell| {
        if walls.at(cell) {
            0
        } else if recipe.terrain {
            rng.random_range(1..=dearest)
        } else {
            1
        }
    })
    .expect("a size and costs that grids may have");
    let (start, goal) = (free_cell(rng, &grid), free_cell(rng, &grid));
    GridProblem::new(grid, start, goal)
        .expect("cells of the grid")
        .with_moves(recipe.moves)
}

/// A batch of everything that may happen to `problem`: up to three changes of up to `max_cells`
/// cells each, blocked, freed or dearer, somewhere or in one place, start and goal included; start
/// and goal moved, a step or far away, onto free cells or blocked ones; changes that change
/// nothing; and sometimes no change at all.
///
/// ```
/// # use pf_conformance::{grid::{Recipe, random_batch, random_problem}, seeded};
/// use pf_core::Problem;
/// let mut rng = seeded(7);
/// let recipe = Recipe::any(&mut rng, 5..=80);
/// let mut problem = random_problem(&mut rng, &recipe);
/// for _ in 0..10 {
///     let batch = random_batch(&mut rng, &problem, 200);
///     let revision = problem.revise(&batch).unwrap();
///     // … a replanner's answer to `revision`, beside `oracle(revision.problem())`
/// }
/// ```
pub fn random_batch(rng: &mut PlanRng, problem: &GridProblem, max_cells: u32) -> Vec<GridChange> {
    if rng.random_bool(0.1) {
        return ends_batch(rng, problem);
    }
    let number = *pick(rng, &[0, 1, 1, 1, 1, 1, 2, 2, 3]);
    let mut batch = vec![];
    for _ in 0..number {
        batch.push(match rng.random_range(0..10) {
            0..4 => GridChange::Blocked(some_cells(rng, problem, max_cells)),
            4..7 => GridChange::Freed(some_cells(rng, problem, max_cells)),
            7 => GridChange::StartMoved(elsewhere(rng, problem, problem.start())),
            8 => GridChange::GoalMoved(elsewhere(rng, problem, problem.goal())),
            _ => {
                let cost = *pick(rng, &[1, 2, 3, 9, 254]);
                GridChange::CostChanged(some_cells(rng, problem, max_cells), cost)
            }
        });
    }
    batch
}

/// Like [`random_batch`], but start and goal are never blocked or moved onto blocked cells.
pub(super) fn calm_batch(
    rng: &mut PlanRng,
    problem: &GridProblem,
    max_cells: u32,
) -> Vec<GridChange> {
    use GridChange::{Blocked, CostChanged, Freed, GoalMoved, StartMoved};
    let mut batch: Vec<_> = random_batch(rng, problem, max_cells);
    // Cells that are ends at some moment of the batch, and those already refused as such.
    let mut ends = vec![problem.start(), problem.goal()];
    batch.retain(|change| match change {
        StartMoved(cell) | GoalMoved(cell) => {
            ends.push(*cell);
            problem.grid().is_free(*cell)
        }
        Blocked(_) | Freed(_) | CostChanged(..) => true,
    });
    for change in &mut batch {
        if let Blocked(cells) = change {
            cells.retain(|cell| !ends.contains(cell));
        }
    }
    batch
}

/// A few cells blocked, freed or dearer, start and goal spared: what an incremental planner is for.
pub(super) fn small_batch(rng: &mut PlanRng, problem: &GridProblem) -> Vec<GridChange> {
    let mut cells = some_cells(rng, problem, 10);
    cells.retain(|cell| ![problem.start(), problem.goal()].contains(cell));
    vec![match rng.random_range(0..5) {
        0..2 => GridChange::Blocked(cells),
        2..4 => GridChange::Freed(cells),
        _ => GridChange::CostChanged(cells, rng.random_range(1..10)),
    }]
}

/// What was closed opens again, and the other way round, start and goal spared: what a planner knew before
/// the last batch holds again, and what it learnt by that batch does not.
pub(super) fn undoing_batch(problem: &GridProblem, last: &[GridChange]) -> Vec<GridChange> {
    use GridChange::{Blocked, Freed};
    let ends = [problem.start(), problem.goal()];
    let undo = |change: &GridChange| match change {
        Blocked(cells) => Some(Freed(cells.clone())),
        Freed(cells) => {
            let mut cells = cells.clone();
            cells.retain(|cell| !ends.contains(cell));
            Some(Blocked(cells))
        }
        _ => None,
    };
    last.iter().rev().filter_map(undo).collect()
}

/// Start or goal blocked, freed, moved onto a blocked cell or onto each other; and often something
/// else besides, which must not be forgotten while there is no way anyhow.
pub(super) fn ends_batch(rng: &mut PlanRng, problem: &GridProblem) -> Vec<GridChange> {
    use GridChange::{Blocked, Freed, GoalMoved, StartMoved};
    let (start, goal) = (problem.start(), problem.goal());
    let end = *pick(rng, &[start, goal]);
    let anywhere = any_cell(rng, problem.grid().layout());
    let moved = *pick(rng, &[StartMoved as fn(Cell) -> _, GoalMoved]);
    let mut batch = match rng.random_range(0..8) {
        0..2 => vec![Blocked(vec![end])],
        2..4 => vec![Freed(vec![start, goal])],
        4 => vec![Blocked(vec![end]), Freed(vec![end])],
        5 => vec![Blocked(vec![anywhere]), moved(anywhere)],
        6 => vec![moved(end)],
        _ => vec![Freed(vec![anywhere]), moved(anywhere)],
    };
    match rng.random_range(0..4) {
        0 => batch.push(Blocked(some_cells(rng, problem, 5))),
        1 => batch.push(Freed(some_cells(rng, problem, 5))),
        _ => {}
    }
    batch
}

fn elsewhere(rng: &mut PlanRng, problem: &GridProblem, from: Cell) -> Cell {
    let grid = problem.grid();
    let steps: Vec<_> = grid.neighbours(from, problem.moves()).collect();
    match rng.random_range(0..10) {
        0 => any_cell(rng, grid.layout()),
        1..4 => free_cell(rng, grid),
        _ => steps
            .choose(rng)
            .map_or_else(|| free_cell(rng, grid), |&(cell, _)| cell),
    }
}

/// One to `most` cells: close together, scattered, or in a line.
fn some_cells(rng: &mut PlanRng, problem: &GridProblem, most: u32) -> Vec<Cell> {
    let layout = *problem.grid().layout();
    let (width, height) = (layout.width(), layout.height());
    let few = if rng.random_bool(0.5) {
        most.min(5)
    } else {
        most
    };
    let number = rng.random_range(1..=few.max(1));
    let near = if rng.random_bool(0.3) {
        *pick(rng, &[problem.start(), problem.goal()])
    } else {
        any_cell(rng, &layout)
    };
    let spread = number.isqrt() + 1;
    match rng.random_range(0..3) {
        0 => (0..number).map(|_| any_cell(rng, &layout)).collect(),
        1 => (0..number)
            .map(|_| {
                let mut around = |at: u32, size: u32| {
                    rng.random_range(at.saturating_sub(spread)..=(at + spread).min(size - 1))
                };
                Cell::new(around(near.x, width), around(near.y, height))
            })
            .collect(),
        _ if rng.random_bool(0.5) => (near.x..width.min(near.x + number))
            .map(|x| Cell::new(x, near.y))
            .collect(),
        _ => (near.y..height.min(near.y + number))
            .map(|y| Cell::new(near.x, y))
            .collect(),
    }
}

fn any_cell(rng: &mut PlanRng, layout: &Layout) -> Cell {
    Cell::new(
        rng.random_range(0..layout.width()),
        rng.random_range(0..layout.height()),
    )
}

/// A free cell, or any if none is found.
fn free_cell(rng: &mut PlanRng, grid: &Grid) -> Cell {
    let mut cell = any_cell(rng, grid.layout());
    for _ in 0..200 {
        if grid.is_free(cell) {
            break;
        }
        cell = any_cell(rng, grid.layout());
    }
    cell
}

fn pick<'a, T>(rng: &mut PlanRng, from: &'a [T]) -> &'a T {
    &from[rng.random_range(0..from.len())]
}

/// The walls of a map in the making.
struct Walls {
    width: u32,
    height: u32,
    blocked: Vec<bool>,
}

impl Walls {
    fn new(width: u32, height: u32, blocked: bool) -> Self {
        let blocked = vec![blocked; (width * height) as usize];
        Self {
            width,
            height,
            blocked,
        }
    }

    fn at(&self, cell: Cell) -> bool {
        self.blocked[(cell.y * self.width + cell.x) as usize]
    }

    fn set(&mut self, x: u32, y: u32, blocked: bool) {
        if x < self.width && y < self.height {
            self.blocked[(y * self.width + x) as usize] = blocked;
        }
    }
}

fn noise(rng: &mut PlanRng, width: u32, height: u32, density: f64) -> Walls {
    let mut walls = Walls::new(width, height, false);
    for blocked in &mut walls.blocked {
        *blocked = rng.random_bool(density);
    }
    walls
}

/// A spanning tree over the cells with even coordinates, grown from the newest end.
fn maze(rng: &mut PlanRng, width: u32, height: u32, density: f64) -> Walls {
    let mut walls = Walls::new(width, height, true);
    let mut trail = vec![Cell::new(0, 0)];
    walls.set(0, 0, false);
    while let Some(&Cell { x, y }) = trail.last() {
        let mut ways = [
            (x.wrapping_sub(2), y),
            (x + 2, y),
            (x, y.wrapping_sub(2)),
            (x, y + 2),
        ];
        ways.shuffle(rng);
        let fresh = ways
            .into_iter()
            .find(|&(a, b)| a < width && b < height && walls.at(Cell::new(a, b)));
        let Some((a, b)) = fresh else {
            trail.pop();
            continue;
        };
        walls.set(a, b, false);
        walls.set(u32::midpoint(a, x), u32::midpoint(b, y), false);
        trail.push(Cell::new(a, b));
    }
    for blocked in &mut walls.blocked {
        *blocked = *blocked && !rng.random_bool(density);
    }
    walls
}

/// Walls every few cells, each piece between two crossings with a door in it or not.
fn rooms(rng: &mut PlanRng, width: u32, height: u32, density: f64) -> Walls {
    let room = rng.random_range(3..=8);
    let mut walls = Walls::new(width, height, false);
    for x in 0..width {
        for y in 0..height {
            walls.set(x, y, x % room == room - 1 || y % room == room - 1);
        }
    }
    for x in (0..width).step_by(room as usize) {
        for y in (0..height).step_by(room as usize) {
            if !rng.random_bool(density) {
                walls.set(x + room - 1, y + rng.random_range(0..room - 1), false);
            }
            if !rng.random_bool(density) {
                walls.set(x + rng.random_range(0..room - 1), y + room - 1, false);
            }
        }
    }
    walls
}

/// A wall in every other row, with one passage and sometimes a second.
fn corridors(rng: &mut PlanRng, width: u32, height: u32, density: f64) -> Walls {
    let mut walls = Walls::new(width, height, false);
    for y in (1..height).step_by(2) {
        for x in 0..width {
            walls.set(x, y, true);
        }
        walls.set(rng.random_range(0..width), y, false);
        if rng.random_bool(density) {
            walls.set(rng.random_range(0..width), y, false);
        }
    }
    walls
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{grid::oracle, seeded};
    use pf_core::Problem;

    #[test]
    fn most_problems_have_a_solution() {
        let mut rng = seeded(1);
        for kind in Kind::ALL {
            let solvable = (0..200)
                .filter(|_| {
                    let recipe = Recipe {
                        kind,
                        ..Recipe::any(&mut rng, 1..=30)
                    };
                    oracle(&random_problem(&mut rng, &recipe)).is_some()
                })
                .count();
            assert!(solvable >= 100, "{kind:?}: {solvable}");
        }
    }

    #[test]
    fn every_change_happens_and_changes_what_is_best() {
        let mut rng = seeded(2);
        let (mut seen, mut differ, mut blocked) = ([0; 6], 0, 0);
        for _ in 0..100 {
            let recipe = Recipe::any(&mut rng, 1..=30);
            let mut problem = random_problem(&mut rng, &recipe);
            let mut last = oracle(&problem);
            for _ in 0..10 {
                let batch = random_batch(&mut rng, &problem, 200);
                problem.apply(&batch).unwrap();
                for change in &batch {
                    seen[match change {
                        GridChange::StartMoved(_) => 0,
                        GridChange::GoalMoved(_) => 1,
                        GridChange::Blocked(_) => 2,
                        GridChange::Freed(_) => 3,
                        GridChange::CostChanged(..) => 4,
                    }] += 1;
                }
                seen[5] += usize::from(batch.is_empty());
                blocked += usize::from(!problem.grid().is_free(problem.goal()));
                let best = oracle(&problem);
                differ += usize::from(best != last);
                last = best;
            }
        }
        assert!(seen.iter().all(|&n| n > 50), "{seen:?}");
        assert!(differ > 300 && blocked > 50, "{differ} {blocked}");
    }

    #[test]
    fn calm_batches_spare_both_ends() {
        let mut rng = seeded(3);
        for _ in 0..100 {
            let recipe = Recipe {
                density: 0.1,
                ..Recipe::any(&mut rng, 2..=20)
            };
            let mut problem = random_problem(&mut rng, &recipe);
            for _ in 0..20 {
                let batch = calm_batch(&mut rng, &problem, 50);
                problem.apply(&batch).unwrap();
                assert!(problem.grid().is_free(problem.start()), "{batch:?}");
                assert!(problem.grid().is_free(problem.goal()), "{batch:?}");
            }
        }
    }
}
