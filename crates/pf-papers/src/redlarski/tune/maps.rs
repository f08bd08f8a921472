//! Maps to tune on, of the kinds the paper has and none of its nine.

use pf_core::{Context, PlanRng, Planner};
use pf_grid::{Cell, Grid, GridCost, GridProblem, Moves};
use pf_rfd::RfdExact;
use rand::{RngExt, SeedableRng};

/// The kinds, taken in turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Square blocks, strewn.
    Mosaic,
    /// Walls from side to side with a gap at alternate ends, and hooks on them.
    Alley,
    /// As an alley, walls close together, with stubs in the corridors.
    Maze,
}

/// A question, and what a shortest path costs.
#[derive(Clone, Debug)]
pub struct Sample {
    /// The question; diagonal steps are always allowed, as in the paper.
    pub problem: GridProblem,
    /// What a shortest path costs.
    pub shortest: GridCost,
}

/// The `n`-th sample with sides of `size` cells. The same three numbers give the same sample.
#[must_use]
pub fn sample(seed: u64, n: u64, size: u32) -> Sample {
    let mut attempt = 0;
    loop {
        let mut rng = PlanRng::seed_from_u64(seed ^ n << 20 ^ attempt << 50);
        let kind = [Kind::Mosaic, Kind::Alley, Kind::Maze][(n % 3) as usize];
        if let Some(sample) = draw(&mut rng, kind, size.max(8)) {
            return sample;
        }
        attempt += 1;
    }
}

fn draw(rng: &mut PlanRng, kind: Kind, size: u32) -> Option<Sample> {
    let mut blocked = vec![false; (size * size) as usize];
    let mut block = |x: u32, y: u32| {
        if x < size && y < size {
            blocked[(y * size + x) as usize] = true;
        }
    };
    match kind {
        Kind::Mosaic => {
            let tile = (size / 8).max(2);
            for _ in 0..size * size / (4 * tile * tile) {
                let (x, y) = (rng.random_range(0..size), rng.random_range(0..size));
                (0..tile * tile).for_each(|i| block(x + i % tile, y + i / tile));
            }
        }
        Kind::Alley => {
            let walls = rng.random_range(2..=3);
            for wall in 1..=walls {
                let x = wall * size / (walls + 1);
                let gap = rng.random_range(2..=size / 3);
                let hook = rng.random_range(1..=size / (walls + 2));
                let at_top = wall % 2 == 0;
                let y_of = |i: u32| if at_top { size - 1 - i } else { i };
                (0..size - gap).for_each(|i| block(x, y_of(i)));
                (0..hook).for_each(|i| block((x + 1).saturating_sub(i + 1), y_of(size - gap - 1)));
            }
        }
        Kind::Maze => {
            let apart = rng.random_range(3..=5);
            for (wall, y) in (0u32..).zip((apart..size - 1).step_by(apart as usize)) {
                let gap = rng.random_range(1..=3);
                let x_of = |i: u32| if wall % 2 == 0 { i } else { size - 1 - i };
                (0..size - gap).for_each(|i| block(x_of(i), y));
                for _ in 0..size / 8 {
                    block(rng.random_range(0..size), y + 1);
                }
            }
        }
    }
    let grid = Grid::new(size, size, |cell| {
        u8::from(!blocked[(cell.y * size + cell.x) as usize])
    });
    let (start, goal) = match kind {
        Kind::Maze => (Cell::new(0, 0), Cell::new(size - 1, size - 1)),
        _ => (Cell::new(1, size / 2), Cell::new(size - 2, size / 2)),
    };
    let problem = GridProblem::new(grid.ok()?, start, goal).ok()?;
    let problem = problem.with_moves(Moves::Always);
    let report = RfdExact::default().plan(&problem, &mut Context::seeded(0));
    let shortest = report.ok()?.outcome.solved()?.cost;
    Some(Sample { problem, shortest })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_the_same_again_and_differ_from_each_other() {
        let grid = |seed, n| sample(seed, n, 20).problem.grid().to_string();
        assert_eq!(grid(1, 4), grid(1, 4));
        assert_ne!(grid(1, 4), grid(2, 4));
        assert_ne!(grid(1, 4), grid(1, 7));
    }
}
