//! What came of a search, to read.

use super::{Chosen, Found};
use comfy_table::{CellAlignment, Table, presets};

/// A table of both winners.
#[must_use]
pub fn text(found: &Found, of: u32) -> String {
    let mut table = Table::new();
    table.load_style(presets::NOTHING).set_header([
        "search",
        "runs",
        "w1, w2, w3",
        "arrived",
        "avgP",
        "score",
        "by fresh seeds: arrived",
        "avgP",
        "score",
    ]);
    for Chosen {
        method,
        runs,
        weights: [w1, w2, w3],
        chosen_by,
        in_sample,
        fresh,
        out_of_sample,
        arrives: [low, high],
    } in [&found.grid, &found.race]
    {
        let mean = |score: &super::Score| {
            let mean = score.length / f64::from(score.target.max(1));
            format!("{mean:.1}")
        };
        table.add_row([
            (*method).to_owned(),
            runs.to_string(),
            format!("{w1}, {w2}, {w3}"),
            format!("{}/{}", chosen_by.target, chosen_by.runs),
            mean(chosen_by),
            format!("{in_sample:.2}"),
            format!("{}/{} ({low:.2}-{high:.2})", fresh.target, fresh.runs),
            mean(fresh),
            format!("{out_of_sample:.2}"),
        ]);
    }
    for (k, column) in table.column_iter_mut().enumerate() {
        if k > 0 {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    format!(
        "{} points; the score is avgP / (arrivals of {of} + 1), the less the better\n{}\n",
        found.points,
        table.trim_fmt()
    )
}
