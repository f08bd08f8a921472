//! Tables: as text, as HTML and as comma-separated values.

use super::escaped;
use crate::folder::cells;
use comfy_table::{CellAlignment, presets};
use std::fmt::Write;

/// A table with what it shows.
#[derive(Clone, Debug)]
pub struct Table {
    /// The name of its file, without an ending.
    pub name: &'static str,
    /// What it shows.
    pub title: String,
    /// How to read it.
    pub words: String,
    /// Heads of columns.
    pub heads: Vec<&'static str>,
    /// How many columns hold names; numbers stand right.
    pub names: usize,
    /// Whether rows with the same first cell belong together: there it is shown once.
    pub grouped: bool,
    /// Cells, row by row.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// For a terminal.
    #[must_use]
    pub fn text(&self) -> String {
        let mut table = comfy_table::Table::new();
        table
            .load_style(presets::UTF8_FULL_CONDENSED)
            .set_header(self.heads.clone());
        for row in self.shown() {
            table.add_row(row);
        }
        for column in table.column_iter_mut().skip(self.names) {
            column.set_cell_alignment(CellAlignment::Right);
        }
        format!("{}\n{table}\n{}\n", self.title, self.words)
    }

    pub(crate) fn html(&self) -> String {
        let mut page = format!(
            "<h2>{}</h2>\n<div class=\"wide\"><table>",
            escaped(&self.title)
        );
        let row = |tag: &str, cells: &mut dyn Iterator<Item = &str>| {
            let cells = cells.enumerate().map(|(k, cell)| {
                let class = if k < self.names {
                    " class=\"name\""
                } else {
                    ""
                };
                format!("<{tag}{class}>{}</{tag}>", escaped(cell))
            });
            format!("<tr>{}</tr>\n", cells.collect::<String>())
        };
        page += &row("th", &mut self.heads.iter().copied());
        for cells in self.shown() {
            page += &row("td", &mut cells.into_iter());
        }
        // Writing to a string does not fail.
        let _ = writeln!(page, "</table></div>\n<p>{}</p>", escaped(&self.words));
        page
    }

    /// The cells as people see them.
    fn shown(&self) -> impl Iterator<Item = Vec<&str>> {
        self.rows.iter().enumerate().map(|(k, row)| {
            let mut cells: Vec<&str> = row.iter().map(String::as_str).collect();
            let again = k > 0 && self.rows[k - 1].first() == row.first();
            if let (Some(first), true) = (cells.first_mut(), again && self.grouped) {
                *first = "";
            }
            cells
        })
    }

    pub(crate) fn csv(&self) -> String {
        let heads = self.heads.iter().map(|head| (*head).to_owned());
        let mut text = cells(heads) + "\n";
        for row in &self.rows {
            text += &cells(row.iter().cloned());
            text.push('\n');
        }
        text
    }
}

/// At most five digits.
pub(crate) fn short(value: f64) -> String {
    if !value.is_finite() {
        return "-".to_owned();
    }
    let decimals = match value.abs() {
        x if x >= 1000.0 => 0,
        x if x >= 100.0 => 1,
        x if x >= 10.0 => 2,
        _ => 3,
    };
    let text = format!("{value:.decimals$}");
    if decimals == 0 {
        return text;
    }
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A value and an interval.
pub(crate) fn within(
    value: f64,
    interval: Option<[f64; 2]>,
    show: impl Fn(f64) -> String,
) -> String {
    match interval {
        Some([low, high]) if high > low => {
            format!("{} [{}, {}]", show(value), show(low), show(high))
        }
        _ => show(value),
    }
}

/// Microseconds, as people read them.
pub(crate) fn time(micros: f64) -> String {
    match micros {
        us if !us.is_finite() => "-".to_owned(),
        us if us < 1000.0 => format!("{} us", three(us)),
        us if us < 1e6 => format!("{} ms", three(us / 1e3)),
        us => format!("{} s", three(us / 1e6)),
    }
}

fn three(x: f64) -> String {
    let decimals = match x {
        x if x >= 100.0 => 0,
        x if x >= 10.0 => 1,
        _ => 2,
    };
    format!("{x:.decimals$}")
}

pub(crate) fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

pub(crate) fn p_value(p: f64) -> String {
    if p < 0.0001 {
        "< 0.0001".to_owned()
    } else {
        format!("{p:.4}")
    }
}
