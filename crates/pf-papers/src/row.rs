//! A table's row, whatever the paper: what it prints beside what is measured.

use comfy_table::{CellAlignment, Table, presets};
use serde::Serialize;
use serde_json::{Map, Value};
use std::fmt::Write;

/// Numbers by name, in the order of their names.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Numbers(Map<String, Value>);

impl Numbers {
    /// One more.
    #[must_use]
    pub fn with(mut self, name: &str, value: impl Into<Value>) -> Self {
        self.0.insert(name.to_owned(), value.into());
        self
    }

    /// A number among them.
    #[must_use]
    pub fn number(&self, name: &str) -> Option<f64> {
        self.0.get(name)?.as_f64()
    }

    fn text(&self, name: &str) -> String {
        match self.0.get(name) {
            None | Some(Value::Null) => String::new(),
            Some(Value::Number(n)) if n.is_f64() => {
                let value = n.as_f64().unwrap_or(f64::NAN);
                let digits = if value.abs() >= 1000.0 { 0 } else { 3 };
                format!("{value:.digits$}")
            }
            Some(Value::String(text)) => text.clone(),
            Some(other) => other.to_string(),
        }
    }
}

/// One row.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The paper's key.
    pub paper: &'static str,
    /// The table's name.
    pub table: &'static str,
    /// What is planned.
    pub case: String,
    /// Who plans, by the name in the list of planners.
    pub planner: &'static str,
    /// The set of parameters.
    pub variant: String,
    /// What was printed.
    pub published: Numbers,
    /// What is measured here.
    pub measured: Numbers,
    /// Whether they agree; nothing where nothing was printed.
    pub reproduced: Option<bool>,
}

/// The rows as tables, one under the other.
#[must_use]
pub fn tables(rows: &[Row]) -> String {
    let mut text = String::new();
    for (name, rows) in by_table(rows) {
        let _ = write!(text, "{name}\n{}\n\n", table(&rows));
    }
    text
}

/// The rows as tables of a page.
pub(crate) fn html(rows: &[Row]) -> String {
    let mut page = String::new();
    for (name, rows) in by_table(rows) {
        let _ = write!(page, "<h2>{name}</h2>\n<table>");
        let (heads, cells) = grid(&rows);
        let cell = |tag: &str, text: &String| format!("<{tag}>{text}</{tag}>");
        let line = |tag: &'static str, row: &[String]| {
            let cells: String = row.iter().map(|text| cell(tag, text)).collect();
            format!("<tr>{cells}</tr>\n")
        };
        page.push_str(&line("th", &heads));
        page.extend(cells.iter().map(|row| line("td", row)));
        page.push_str("</table>\n");
    }
    page
}

fn by_table(rows: &[Row]) -> Vec<(&'static str, Vec<&Row>)> {
    let mut tables: Vec<(&'static str, Vec<&Row>)> = Vec::new();
    for row in rows {
        match tables.iter_mut().find(|(name, _)| *name == row.table) {
            Some((_, rows)) => rows.push(row),
            None => tables.push((row.table, vec![row])),
        }
    }
    tables
}

/// The heads, and a line of texts for each row: measured, and printed where something was.
fn grid(rows: &[&Row]) -> (Vec<String>, Vec<Vec<String>>) {
    let mut names: Vec<(bool, &String)> = Vec::new();
    for row in rows {
        for (said, numbers) in [(false, &row.measured), (true, &row.published)] {
            for name in numbers.0.keys() {
                if !names.contains(&(said, name)) {
                    names.push((said, name));
                }
            }
        }
    }
    // What was printed stands right of what was measured.
    let mut order: Vec<(bool, &String)> = Vec::new();
    for &(said, name) in names.iter().filter(|(said, _)| !said) {
        order.push((said, name));
        order.extend(names.iter().filter(|other| other.0 && other.1 == name));
    }
    order.extend(
        names
            .iter()
            .filter(|n| n.0 && !order.contains(n))
            .copied()
            .collect::<Vec<_>>(),
    );
    let mut heads: Vec<String> = ["case", "planner", "variant"].map(str::to_owned).to_vec();
    heads.extend(order.iter().map(|(said, name)| {
        let prefix = if *said { "printed: " } else { "" };
        format!("{prefix}{name}")
    }));
    heads.push("reproduced".to_owned());
    let line = |row: &&Row| {
        let mut cells = vec![
            row.case.clone(),
            row.planner.to_owned(),
            row.variant.clone(),
        ];
        cells.extend(order.iter().map(|(said, name)| {
            let numbers = if *said { &row.published } else { &row.measured };
            numbers.text(name)
        }));
        let verdict = match row.reproduced {
            Some(true) => "yes",
            Some(false) => "NOT REPRODUCED",
            None => "",
        };
        cells.push(verdict.to_owned());
        cells
    };
    (heads, rows.iter().map(line).collect())
}

fn table(rows: &[&Row]) -> String {
    let (heads, cells) = grid(rows);
    let mut table = Table::new();
    table.load_style(presets::NOTHING).set_header(heads);
    for row in cells {
        table.add_row(row);
    }
    for (k, column) in table.column_iter_mut().enumerate() {
        if k >= 3 {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    table.trim_fmt()
}
