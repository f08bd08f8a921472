//! `bench memory`: what planners keep, open list included, on the largest maps and worst mazes.

use crate::protocol::{json, say, timed};
use anyhow::Result;
use pf_classic::{AStar, DStarLite, Dijkstra};
use pf_core::{Context, Planner, Replanner};
use pf_grid::{Cell, Grid, GridProblem};
use pf_rfd::RfdField;
use serde::Serialize;
use std::sync::Arc;

#[derive(clap::Args)]
pub(crate) struct Args {
    /// Columns and rows
    #[arg(long, default_value_t = 4096)]
    side: u32,
    /// One JSON object a line
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Row {
    suite: &'static str,
    case: &'static str,
    planner: &'static str,
    bytes_per_cell: f64,
    length: Option<f64>,
    mean_us: f64,
}

pub(crate) fn run(args: &Args) -> Result<()> {
    let side = args.side;
    let open = Grid::open(side, side)?;
    // Every other row is a wall with a gap at alternating ends.
    let serpentine = Grid::new(side, side, |cell| {
        let gap = if cell.y % 4 == 1 { side - 1 } else { 0 };
        u8::from(cell.y % 2 == 0 || cell.x == gap)
    })?;
    for (case, grid) in [("open", open), ("serpentine", serpentine)] {
        let last = Cell::new(side - 1, side - 1);
        let grid = Arc::new(grid);
        let goal = if grid.is_free(last) {
            last
        } else {
            Cell::new(side - 1, side - 2)
        };
        let problem = GridProblem::new(grid, Cell::new(0, 0), goal)?;
        let mut astar = AStar::default();
        measure(args, case, "astar", &problem, &mut astar, |it, _| {
            it.bytes()
        })?;
        let mut dijkstra = Dijkstra::default();
        measure(args, case, "dijkstra", &problem, &mut dijkstra, |it, _| {
            it.bytes()
        })?;
        let mut dstar = DStarLite::default();
        measure(args, case, "d-star-lite", &problem, &mut dstar, |it, _| {
            it.bytes()
        })?;
        let mut field = RfdField::default();
        // It has the most once its upkeep is done.
        let settled = |it: &mut RfdField, problem: &_| {
            it.settle(problem, &mut Context::seeded(0));
            it.bytes()
        };
        measure(args, case, "rfd-field", &problem, &mut field, settled)?;
    }
    Ok(())
}

fn measure<T: Planner<GridProblem>>(
    args: &Args,
    case: &'static str,
    planner: &'static str,
    problem: &GridProblem,
    it: &mut T,
    bytes: impl FnOnce(&mut T, &GridProblem) -> usize,
) -> Result<()> {
    let (time, report) = timed(|| it.plan(problem, &mut Context::seeded(0)));
    let cells = f64::from(args.side).powi(2);
    let row = Row {
        suite: "memory",
        case,
        planner,
        #[expect(clippy::cast_precision_loss, reason = "far below 2^53")]
        bytes_per_cell: bytes(it, problem) as f64 / cells,
        length: report?.outcome.solved().map(|best| best.cost.value()),
        mean_us: time.as_secs_f64() * 1e6,
    };
    if args.json {
        return json(&row);
    }
    say(format_args!(
        "{case:<12} {planner:<12} {:>6.2} bytes a cell, length {:>12.1}, {:>8.0} ms",
        row.bytes_per_cell,
        row.length.unwrap_or(f64::NAN),
        row.mean_us / 1e3
    ))
}
