//! What can be said of many runs: tables, figures, a page.

mod chart;
mod convergence;
mod data;
mod diagram;
mod ecdf;
mod forest;
mod page;
mod table;
mod tables;

pub use table::Table;

use crate::{SuiteError, record::Line};
use data::Data;
use pf_io::{make_folder, write_whole};
use pf_render::png_of;
use std::path::Path;

const UNRANKED: &str = " There are no mean ranks, as there are not two problems in which all \
                        contenders, and at least two, take part.";

/// A picture with a file's name, as SVG.
#[derive(Clone, Debug)]
pub struct Figure {
    /// The name, without an ending.
    pub name: String,
    /// What it shows.
    pub title: String,
    /// How to read it.
    pub words: String,
    /// The picture.
    pub svg: String,
}

/// Tables and figures.
#[derive(Clone, Debug)]
pub struct Report {
    /// What it is about.
    pub title: String,
    /// How many runs, of what.
    pub words: String,
    /// In the order in which they are read; the last are for the page, too long for a terminal.
    pub tables: Vec<Table>,
    /// In the order in which they are looked at.
    pub figures: Vec<Figure>,
}

impl Report {
    /// Of runs that [`merged`](crate::folder::merged) has sorted. `target` says how much more than the
    /// best known a path may cost to count as found in the figures of effort: 0.05 is 5 %.
    ///
    /// # Errors
    /// [`SuiteError`] if a figure cannot be drawn.
    pub fn of(lines: &[Line], target: f64) -> Result<Self, SuiteError> {
        let data = Data::of(lines);
        let ranking = tables::ranking(&data);
        let mut tables = vec![
            tables::contenders(&data),
            tables::problems(&data),
            tables::pairs(&data),
            tables::pairs_in_time(&data),
        ];
        if let Some(ranking) = &ranking {
            tables.push(tables::ranks(&data, ranking));
        }
        tables.push(tables::pairs_by_problem(&data));
        let mut figures = forest::figures(&data)?;
        figures.extend(ecdf::figures(&data, target)?);
        if let Some(ranking) = &ranking {
            figures.push(diagram::figure(&data, ranking)?);
        }
        figures.extend(convergence::figures(&data)?);
        let count = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
        Ok(Self {
            title: format!("Report on {}", data.suites.join(", ")),
            words: format!(
                "{}: {}, {}.{}",
                count(lines.len(), "run"),
                count(data.problems.len(), "problem"),
                count(data.contenders.len(), "contender"),
                if ranking.is_some() { "" } else { UNRANKED }
            ),
            tables,
            figures,
        })
    }

    /// The tables for a terminal; those of pairs by problem are for the page.
    #[must_use]
    pub fn text(&self) -> String {
        let shown = self.tables.iter().filter(|t| t.name != "pairs-by-problem");
        let tables: Vec<String> = shown.map(Table::text).collect();
        format!("{}\n{}\n\n{}", self.title, self.words, tables.join("\n"))
    }

    /// Writes `report.html`, every table as CSV, every figure as SVG and PNG, into a folder, which is
    /// made if need be.
    ///
    /// # Errors
    /// [`SuiteError`] if a file cannot be written; each is written whole or not at all.
    pub fn write(&self, folder: &Path) -> Result<(), SuiteError> {
        make_folder(folder)?;
        let put = |name: String, bytes: &[u8]| {
            write_whole(&folder.join(name), |out| out.write_all(bytes))
        };
        for table in &self.tables {
            put(format!("{}.csv", table.name), table.csv().as_bytes())?;
        }
        for figure in &self.figures {
            put(format!("{}.svg", figure.name), figure.svg.as_bytes())?;
            put(format!("{}.png", figure.name), &png_of(&figure.svg)?)?;
        }
        put("report.html".to_owned(), page::page(self).as_bytes())?;
        Ok(())
    }
}

/// Text that stands in HTML or SVG.
pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}
