//! Maps cut finer: the same queries with every cell cut into several, where memory is what a search
//! waits for.

use super::Args;
use crate::{cases::Case, protocol::Row};
use anyhow::Result;
use pf_grid::{Cell, Grid};
use pf_io::ScenRow;
use std::sync::Arc;

/// The side of the maps that are cut finer.
const SIDE: u32 = 512;
/// How many queries are asked at most: they take long.
const QUERIES: usize = 10;

/// Our contenders on a map cut finer, with what they take per expansion for the same queries on the
/// map as it is.
pub(super) fn bench(args: &Args, case: &Case) -> Result<Option<Vec<Row>>> {
    let (times, grid) = (args.upscale, &case.grid);
    if times <= 1 || (grid.width(), grid.height()) != (SIDE, SIDE) {
        return Ok(None);
    }
    let fine = Grid::new(SIDE * times, SIDE * times, |cell| {
        let cell = coarse(cell, times);
        if grid.is_free(cell) {
            grid.cost(cell)
        } else {
            0
        }
    })?;
    let queries = case.spread(args.limit.min(QUERIES));
    let scaled: Vec<ScenRow> = queries
        .iter()
        .map(|row| ScenRow {
            start: middle(row.start, times),
            goal: middle(row.goal, times),
            ..(*row).clone()
        })
        .collect();
    let name = format!("{} x{times}", case.name);
    let originals = super::bench(
        &name,
        grid,
        Some(&case.scen),
        &queries,
        args.asked.group_of_ours()?,
    )?;
    let scaled: Vec<&ScenRow> = scaled.iter().collect();
    let mut rows = super::bench(
        &name,
        &Arc::new(fine),
        None,
        &scaled,
        args.asked.group_of_ours()?,
    )?;
    for (row, original) in rows.iter_mut().zip(originals) {
        row.kind = "upscaled";
        row.original_ns_per_expansion = original.ns_per_expansion;
        row.mismatches += original.mismatches;
    }
    Ok(Some(rows))
}

fn coarse(cell: Cell, times: u32) -> Cell {
    Cell::new(cell.x / times, cell.y / times)
}

fn middle(cell: Cell, times: u32) -> Cell {
    Cell::new(cell.x * times + times / 2, cell.y * times + times / 2)
}
