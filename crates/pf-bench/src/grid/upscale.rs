//! Maps cut finer: the same queries with every cell cut into several, where memory is what a search
//! waits for.

use super::{Args, Posed, Round};
use crate::{
    cases::Case,
    protocol::{REPETITIONS, Row},
};
use anyhow::Result;
use pf_io::ScenRow;

/// The side of the maps that are cut finer.
const SIDE: u32 = 512;
/// How many queries are asked at most: they take long.
const QUERIES: usize = 10;

/// Our contenders on a map cut finer, with what they take per expansion for the same queries on the
/// map as it is. All queries are asked once on the one, then on the other, and so on, and the least time of each counts.
/// Asked the same five times in a row, the machine has learned a short query's branches by heart, but not a long one's;
/// and minutes apart it may do something else beside one of the two.
pub(super) fn bench(args: &Args, case: &Case) -> Result<Option<Vec<Row>>> {
    let (times, grid) = (args.upscale, &case.grid);
    if times <= 1 || (grid.width(), grid.height()) != (SIDE, SIDE) {
        return Ok(None);
    }
    let fine = case.upscaled(times)?;
    let limit = args.limit.min(QUERIES);
    let group = || Ok::<_, anyhow::Error>(Round::of(args.asked.group_of_ours()?));
    let (mut original, mut scaled) = (group()?, group()?);
    let (rows, cuts) = (case.spread(limit), fine.spread(limit));
    let pose = |round: &Round, grid, rows: &[&ScenRow]| -> Result<Vec<Posed>> {
        rows.iter().map(|row| round.pose(grid, row)).collect()
    };
    let mut posed = pose(&original, grid, &rows)?;
    let mut posed_cut = pose(&scaled, &fine.grid, &cuts)?;
    for _ in 0..REPETITIONS {
        original.go_round(&mut posed);
        scaled.go_round(&mut posed_cut);
    }
    for (row, posed) in rows.iter().zip(&posed) {
        original.note(Some(&case.scen), row, posed);
    }
    for (cut, posed) in cuts.iter().zip(&posed_cut) {
        scaled.note(None, cut, posed);
    }
    let mut rows = scaled.rows(&fine.name);
    for (row, original) in rows.iter_mut().zip(original.rows(&case.name)) {
        row.kind = "upscaled";
        row.original_ns_per_expansion = original.ns_per_expansion;
        row.mismatches += original.mismatches;
    }
    Ok(Some(rows))
}
