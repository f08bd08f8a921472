//! The report: a page with the tables and the figures, and each figure as SVG and PNG.

use super::{
    cases::Story,
    figures::figures,
    measure::Row,
    text::{micros, number, significant, verdict},
};
use crate::{PaperError, statistics::Spread};
use pf_io::{make_folder, write_whole};
use pf_render::png_of;
use std::{fmt::Write, io, path::Path};

/// Writes `report.html` and the figures into a folder, which is made if need be.
///
/// # Errors
/// [`PaperError`] if a picture cannot be drawn or a file cannot be written; each file is written
/// whole or not at all.
pub fn write_report(folder: &Path, stories: &[Story], rows: &[Row]) -> Result<(), PaperError> {
    let put = |name: &str, bytes: &[u8]| {
        write_whole(&folder.join(name), |out| io::Write::write_all(out, bytes))
    };
    make_folder(folder)?;
    let mut page = String::from(HEAD);
    for table in 1..=5 {
        write_table(&mut page, rows, table);
    }
    page.push_str("<h2>Figures</h2>\n");
    for figure in figures(stories)? {
        put(&format!("{}.svg", figure.name), figure.svg.as_bytes())?;
        put(&format!("{}.png", figure.name), &png_of(&figure.svg)?)?;
        let _ = writeln!(
            page,
            "<details><summary>{}</summary>{}</details>",
            figure.title, figure.svg
        );
    }
    page.push_str("</body></html>\n");
    put("report.html", page.as_bytes())?;
    Ok(())
}

const HEAD: &str = r#"<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Rivers and ants on nine maps</title>
<style>
body { font: 14px/1.45 "DejaVu Sans", Verdana, sans-serif; margin: 2em; color: #222; }
table { border-collapse: collapse; margin: 1em 0; }
td, th { padding: .15em .6em; text-align: right; border-bottom: 1px solid #ddd; white-space: nowrap; }
td:nth-child(-n+3), th:nth-child(-n+3) { text-align: left; }
tr.map td { border-top: 2px solid #888; }
.no { color: #b03000; font-weight: bold; } .yes { color: #00694c; }
</style></head><body>
<h1>Rivers and ants on nine maps</h1>
<p>Redlarski, Dabkowski, Palkowski: <em>Generating optimal paths in dynamic environments using River
Formation Dynamics algorithm</em>, run again. Lengths in cells; times to the answer, of planning in
Table 1, of replanning from the state after Table 1 in the others; "x A*" is the median of the time by
that of A* in the same run, beside the paper's ratio to its own A*. The maps are reconstructions.</p>
"#;

const TITLES: [&str; 5] = [
    "Table 1: planning",
    "Table 2: the goal moved",
    "Table 3: obstacles added",
    "Table 4: obstacles removed",
    "Table 5: a major change",
];

fn write_table(page: &mut String, rows: &[Row], table: usize) {
    let mut rows = rows.iter().filter(|row| row.table == table).peekable();
    if rows.peek().is_none() {
        return;
    }
    let _ = writeln!(
        page,
        "<h2>{}</h2>\n<table><tr><th>map</th><th>planner</th><th>variant</th><th>found</th>\
         <th>optimal</th><th>95 %</th><th>length, mean</th><th>median [quartiles]</th><th>paper</th>\
         <th>time, mean</th><th>median [quartiles]</th><th>x A*</th><th>paper</th><th>upkeep</th>\
         <th>reproduced</th></tr>",
        TITLES[table - 1]
    );
    let mut before = "";
    for row in rows {
        let (m, said) = (&row.measured, &row.published);
        let new = row.case != before;
        before = row.case;
        let spread = |values: Option<Spread>, show: fn(f64) -> String| {
            values.map_or("-".to_owned(), |s| {
                format!("{} [{}, {}]", show(s.median), show(s.q1), show(s.q3))
            })
        };
        let paper = match (said.length, said.says) {
            (Some(length), _) => number(length),
            (None, "nothing") => String::new(),
            (None, says) => says.to_owned(),
        };
        let class = match row.reproduced {
            Some(true) => "yes",
            Some(false) => "no",
            None => "",
        };
        let [low, high] = m.optimal_interval;
        let _ = writeln!(
            page,
            "<tr{}><td>{}</td><td>{}</td><td>{}</td><td>{}/{}</td><td>{}/{}</td><td>{low:.2}-{high:.2}</td>\
             <td>{}</td><td>{}</td><td>{paper}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>\
             <td class=\"{class}\">{}</td></tr>",
            if new { " class=\"map\"" } else { "" },
            if new { row.case } else { "" },
            row.planner,
            row.variant,
            m.found,
            m.runs,
            m.optimal,
            m.runs,
            m.length.map_or("-".to_owned(), number),
            spread(m.lengths, number),
            micros(m.time_us),
            spread(m.times_us, micros),
            m.ratio.map_or("-".to_owned(), significant),
            said.ratio.map_or(String::new(), significant),
            m.upkeep_us
                .map_or("-".to_owned(), |upkeep| micros(upkeep.median)),
            verdict(row.reproduced),
        );
    }
    page.push_str("</table>\n");
}
