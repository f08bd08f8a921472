//! The suite of grids.

use super::{
    drawings::{DRAWN, drawing},
    generate::{
        Kind, Recipe, calm_batch, ends_batch, random_batch, random_problem, small_batch,
        undoing_batch,
    },
    oracle,
};
use crate::{Case, Options, Plot, Story, Suite, Truth};
use pf_core::{PlanRng, Problem};
use pf_grid::{Cell, Grid, GridCost, GridProblem, Moves};
use rand::RngExt;
use std::ops::RangeInclusive;

/// Problems larger than this are not drawn.
const DRAWABLE: u32 = 60;

/// [`Suite`] of [`GridProblem`]s: drawn ones under every rule of moving, with optima counted by
/// hand, a few large ones, and made-up ones with the [`oracle`]'s truth.
#[derive(Clone, Copy, Debug, Default)]
pub struct Grids;

impl Suite for Grids {
    type Problem = GridProblem;

    fn cases(&self, options: &Options) -> Vec<Case<GridProblem>> {
        let mut cases = vec![];
        for drawn in DRAWN {
            for (moves, optimum) in drawn.optima() {
                cases.push(Case {
                    name: format!("{}, {moves}", drawn.name),
                    problem: drawn.problem(moves),
                    truth: optimum.map_or(Truth::Infeasible, Truth::Optimum),
                });
            }
        }
        cases.extend(large_cases(options.largest));
        cases
    }

    fn random(&self, rng: &mut PlanRng, options: &Options) -> GridProblem {
        let size = sizes(1..=40, options);
        let recipe = Recipe::any(rng, size);
        random_problem(rng, &recipe)
    }

    fn lookalike(&self, rng: &mut PlanRng, problem: &GridProblem) -> GridProblem {
        let mut other = problem.clone();
        for _ in 0..3 {
            let batch = random_batch(rng, &other, 50);
            // Batches are made for the problem, so this does not fail.
            let _ = other.apply(&batch);
        }
        other
    }

    fn story(&self, rng: &mut PlanRng, plot: Plot, options: &Options) -> Story<GridProblem> {
        let (size, batches) = match plot {
            Plot::Mixed => (5..=40, 20),
            Plot::Small => (48..=64, 5),
            Plot::Ends => (2..=20, 20),
            Plot::Long => (10..=20, 400),
        };
        let mut recipe = Recipe::any(rng, sizes(size, options));
        if plot == Plot::Small {
            // A problem without a solution is no repair's business.
            recipe.kind = Kind::Noise;
            recipe.density = rng.random_range(0.1..0.3);
        }
        let problem = random_problem(rng, &recipe);
        let name = format!("{:?} changes, {:?}, {}", plot, recipe.kind, recipe.moves);
        let mut last = vec![];
        Story::new(name, problem, batches, |now| {
            let is_calm = matches!(plot, Plot::Mixed | Plot::Long);
            last = match plot {
                _ if is_calm && rng.random_bool(0.2) => undoing_batch(now, &last),
                Plot::Mixed => {
                    let most = if rng.random_bool(0.1) { 200 } else { 20 };
                    calm_batch(rng, now, most)
                }
                Plot::Small => small_batch(rng, now),
                Plot::Ends => ends_batch(rng, now),
                Plot::Long => calm_batch(rng, now, 5),
            };
            last.clone()
        })
    }

    fn truth(&self, problem: &GridProblem) -> Truth<GridCost> {
        oracle(problem).map_or(Truth::Infeasible, Truth::Optimum)
    }

    fn draw(&self, problem: &GridProblem) -> Option<String> {
        let size = problem.grid().width().max(problem.grid().height());
        (size <= DRAWABLE).then(|| drawing(problem))
    }
}

/// `wished` sizes of one side, as far as the options allow.
fn sizes(wished: RangeInclusive<u32>, options: &Options) -> RangeInclusive<u32> {
    let most = u32::try_from(options.largest.isqrt())
        .unwrap_or(u32::MAX)
        .max(1);
    *wished.start().min(&most)..=*wished.end().min(&most)
}

/// Large maps whose optimum a formula tells.
fn large_cases(largest: u64) -> Vec<Case<GridProblem>> {
    let mut cases = vec![];
    let mut case = |name: &str,
                    width: u32,
                    height: u32,
                    goal: Cell,
                    moves,
                    blocked: &dyn Fn(Cell) -> bool,
                    optimum: Option<GridCost>| {
        if u64::from(width) * u64::from(height) > largest {
            return;
        }
        let grid = Grid::new(width, height, |cell| u8::from(!blocked(cell)));
        let problem = grid.and_then(|grid| GridProblem::new(grid, Cell::new(0, 0), goal));
        cases.push(Case {
            name: format!("{name}, {moves}"),
            problem: problem.expect("a grid with both cells").with_moves(moves),
            truth: optimum.map_or(Truth::Infeasible, Truth::Optimum),
        });
    };
    let steps = |s, d| Some(GridCost::of_steps(s, d));
    let corner = Cell::new(299, 299);
    let open = |_: Cell| false;
    case(
        "a huge open field",
        300,
        300,
        corner,
        Moves::Orthogonal,
        &open,
        steps(598, 0),
    );
    case(
        "a huge open field",
        300,
        300,
        corner,
        Moves::OnlyWhenNoObstacles,
        &open,
        steps(0, 299),
    );
    // Free rows joined at alternating ends: 60 rows of 60 steps, 59 passages of 2.
    let serpentine = |c: Cell| c.y % 2 == 1 && c.x != if c.y % 4 == 1 { 60 } else { 0 };
    let end = Cell::new(0, 118);
    case(
        "a serpentine",
        61,
        119,
        end,
        Moves::Orthogonal,
        &serpentine,
        steps(60 * 60 + 59 * 2, 0),
    );
    case(
        "a serpentine",
        61,
        119,
        end,
        Moves::OnlyWhenNoObstacles,
        &serpentine,
        steps(60 * 60 + 59 * 2, 0),
    );
    // Each passage saves two pairs of straight steps.
    case(
        "a serpentine",
        61,
        119,
        end,
        Moves::Always,
        &serpentine,
        steps(60 * 60 + 59 * 2 - 4 * 59, 2 * 59),
    );
    cases
}
