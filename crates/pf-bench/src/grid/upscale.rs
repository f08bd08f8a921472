//! Maps cut finer: the same queries with every cell cut into several, where memory is what a search
//! waits for.

use super::{Args, Round};
use crate::{cases::Case, protocol::Row};
use anyhow::Result;

/// The side of the maps that are cut finer.
const SIDE: u32 = 512;
/// How many queries are asked at most: they take long.
const QUERIES: usize = 10;

/// Our contenders on a map cut finer, with what they take per expansion for the same queries on the
/// map as it is. Each query is asked on both in turn: what the machine does beside it slows down both.
pub(super) fn bench(args: &Args, case: &Case) -> Result<Option<Vec<Row>>> {
    let (times, grid) = (args.upscale, &case.grid);
    if times <= 1 || (grid.width(), grid.height()) != (SIDE, SIDE) {
        return Ok(None);
    }
    let fine = case.upscaled(times)?;
    let limit = args.limit.min(QUERIES);
    let group = || Ok::<_, anyhow::Error>(Round::of(args.asked.group_of_ours()?));
    let (mut original, mut scaled) = (group()?, group()?);
    for (row, cut) in case.spread(limit).into_iter().zip(fine.spread(limit)) {
        original.ask(grid, Some(&case.scen), row)?;
        scaled.ask(&fine.grid, None, cut)?;
    }
    let mut rows = scaled.rows(&fine.name);
    for (row, original) in rows.iter_mut().zip(original.rows(&case.name)) {
        row.kind = "upscaled";
        row.original_ns_per_expansion = original.ns_per_expansion;
        row.mismatches += original.mismatches;
    }
    Ok(Some(rows))
}
