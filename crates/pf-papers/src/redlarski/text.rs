//! The rows as tables to read.

use super::measure::Row;
use comfy_table::{CellAlignment, Table, presets};
use std::fmt::Write;

const TITLES: [&str; 5] = [
    "Table 1: planning",
    "Table 2: the goal moved, replanning",
    "Table 3: obstacles added, replanning",
    "Table 4: obstacles removed, replanning",
    "Table 5: a major change, replanning",
];

/// The tables, one after the other.
#[must_use]
pub fn tables(rows: &[Row]) -> String {
    let mut text = String::new();
    for (n, title) in (1..).zip(TITLES) {
        let rows: Vec<_> = rows.iter().filter(|row| row.table == n).collect();
        if !rows.is_empty() {
            let _ = write!(text, "{title}\n{}\n\n", table(&rows));
        }
    }
    text
}

fn table(rows: &[&Row]) -> Table {
    let mut table = Table::new();
    table.load_style(presets::UTF8_FULL_CONDENSED).set_header([
        "map",
        "planner",
        "variant",
        "found",
        "optimal (95 %)",
        "length",
        "median [quartiles]",
        "paper",
        "time",
        "median [quartiles]",
        "x A*",
        "paper",
        "upkeep",
        "reproduced",
    ]);
    for column in table.column_iter_mut().skip(3) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    let mut before = "";
    for row in rows {
        let m = &row.measured;
        let spread = |values: Option<crate::statistics::Spread>, show: &dyn Fn(f64) -> String| {
            values.map_or("-".to_owned(), |s| {
                format!("{} [{}, {}]", show(s.median), show(s.q1), show(s.q3))
            })
        };
        let [low, high] = m.optimal_interval;
        table.add_row([
            if row.case == before { "" } else { row.case }.to_owned(),
            row.planner.to_owned(),
            row.variant.to_owned(),
            format!("{}/{}", m.found, m.runs),
            format!("{}/{} ({low:.2}-{high:.2})", m.optimal, m.runs),
            m.length.map_or("-".to_owned(), number),
            spread(m.lengths, &number),
            match (row.published.length, row.published.says) {
                (Some(length), _) => number(length),
                (None, "nothing") => String::new(),
                (None, says) => says.to_owned(),
            },
            micros(m.time_us),
            spread(m.times_us, &micros),
            m.ratio.map_or("-".to_owned(), significant),
            row.published.ratio.map_or(String::new(), significant),
            m.upkeep_us
                .map_or("-".to_owned(), |upkeep| micros(upkeep.median)),
            verdict(row.reproduced).to_owned(),
        ]);
        before = row.case;
    }
    table
}

pub(super) fn verdict(reproduced: Option<bool>) -> &'static str {
    match reproduced {
        Some(true) => "yes",
        Some(false) => "NO",
        None => "",
    }
}

/// What of the paper was reproduced, planner by planner.
#[must_use]
pub fn summary(rows: &[Row]) -> String {
    let mut table = Table::new();
    table.load_style(presets::UTF8_FULL_CONDENSED).set_header([
        "planner",
        "variant",
        "runs",
        "found",
        "optimal (95 %)",
        "printed lengths reproduced",
    ]);
    let mut seen: Vec<(&str, &str)> = Vec::new();
    for row in rows {
        let who = (row.planner, row.variant);
        if seen.contains(&who) {
            continue;
        }
        seen.push(who);
        let of = || rows.iter().filter(|row| (row.planner, row.variant) == who);
        let sum = |count: fn(&Row) -> u32| of().map(count).sum::<u32>();
        let runs = sum(|row| row.measured.runs);
        let optimal = sum(|row| row.measured.optimal);
        let [low, high] = crate::statistics::wilson(optimal, runs);
        let judged = of().filter(|row| row.reproduced.is_some()).count();
        let yes = of().filter(|row| row.reproduced == Some(true)).count();
        table.add_row([
            row.planner.to_owned(),
            row.variant.to_owned(),
            runs.to_string(),
            sum(|row| row.measured.found).to_string(),
            format!("{optimal} ({low:.3}-{high:.3})"),
            if judged > 0 {
                format!("{yes} of {judged}")
            } else {
                "-".to_owned()
            },
        ]);
    }
    table.to_string()
}

pub(super) fn number(x: f64) -> String {
    format!("{x:.2}")
}

pub(super) fn significant(x: f64) -> String {
    match x {
        x if x < 10.0 => format!("{x:.2}"),
        x if x < 100.0 => format!("{x:.1}"),
        x => format!("{x:.0}"),
    }
}

pub(super) fn micros(us: f64) -> String {
    match us {
        us if us < 1e3 => significant(us) + " us",
        us if us < 1e6 => significant(us / 1e3) + " ms",
        us => significant(us / 1e6) + " s",
    }
}
