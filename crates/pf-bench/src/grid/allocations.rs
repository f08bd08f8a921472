//! Allocations and bytes, counted by a program of its own.
//!
//! `pf-bench-allocations` is this program under an allocator that counts. Run with the same arguments
//! it asks the same queries, but instead of timing it counts: first all queries once, for the peak of
//! what a contender takes, its answers included and its own map or graph not; then all once more, for
//! the allocations per query when it has the memory it wants.

use super::{Args, contender::RULES};
use crate::{
    Counter, beside,
    cases::Case,
    protocol::{Row, json},
};
use anyhow::Result;
use pf_grid::GridProblem;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// How many queries are asked at most.
const QUERIES: usize = 20;

/// What was counted of a contender on a map.
#[derive(Debug, Deserialize, Serialize)]
struct Count {
    case: String,
    planner: String,
    allocations: f64,
    bytes_per_cell: f64,
}

/// All that was counted.
pub(super) struct Counted(Vec<Count>);

impl Counted {
    pub(super) fn fill_in(&self, row: &mut Row) {
        let same = |count: &&Count| count.case == row.case && count.planner == row.planner;
        if let Some(count) = self.0.iter().find(same) {
            row.allocations = Some(count.allocations);
            row.bytes_per_cell = Some(count.bytes_per_cell);
        }
    }
}

/// Lets the other program count; without it nothing is known.
pub(super) fn ask() -> Counted {
    let text = beside::said().unwrap_or_default();
    let counts = text.lines().map(|line| serde_json::from_str(line).ok());
    Counted(counts.flatten().collect())
}

/// What the other program does: a line per map and contender.
#[expect(
    clippy::cast_precision_loss,
    reason = "numbers of allocations and bytes"
)]
pub(super) fn count(args: &Args, counter: Counter) -> Result<()> {
    for map in args.maps.files()? {
        let case = Case::load(&map)?;
        let cells = f64::from(case.grid.width()) * f64::from(case.grid.height());
        let queries = case.spread(args.limit.min(QUERIES));
        for moves in RULES {
            let problem = |row: &&pf_io::ScenRow| {
                let problem = GridProblem::new(Arc::clone(&case.grid), row.start, row.goal);
                Ok(problem?.with_moves(moves))
            };
            let problems: Vec<GridProblem> = queries.iter().map(problem).collect::<Result<_>>()?;
            for mut one in args.asked.group(&case.grid, moves)?.contenders {
                let first = counter(&mut || {
                    for problem in &problems {
                        one.prepare();
                        one.search(problem);
                        one.answer(problem);
                    }
                });
                let mut allocations = 0;
                for problem in &problems {
                    one.prepare();
                    allocations += counter(&mut || one.search(problem)).allocations;
                    one.answer(problem);
                }
                json(&Count {
                    case: case.under(moves),
                    planner: one.name().to_owned(),
                    allocations: allocations as f64 / problems.len() as f64,
                    bytes_per_cell: first.peak as f64 / cells,
                })?;
            }
        }
    }
    Ok(())
}
