//! Scenario files of the Moving AI benchmark: a query and its optimum per line.

use crate::{
    FileError, Place,
    error::quoted,
    movingai::Lines,
    source::{self, Source},
    write,
};
use pf_grid::{Cell, Grid};
use std::path::Path;

/// A Moving AI `.scen` file.
#[derive(Clone, Debug, PartialEq)]
pub struct Scen {
    /// The file's name, for errors.
    pub name: String,
    /// Its queries, in the file's order.
    pub rows: Vec<ScenRow>,
    precision: Precision,
}

/// One query of a `.scen` file.
#[derive(Clone, Debug, PartialEq)]
pub struct ScenRow {
    /// The line it stands on, from 1.
    pub line: u32,
    /// Its bucket: the optimum divided by 4, rounded down.
    pub bucket: u32,
    /// The map's name, as the benchmark calls it.
    pub map: String,
    /// Columns of the map.
    pub width: u32,
    /// Rows of the map.
    pub height: u32,
    /// Where from.
    pub start: Cell,
    /// Where to.
    pub goal: Cell,
    /// The stated length of a shortest path in cells, no corner cut.
    pub optimum: f64,
}

/// How a file rounds its optima: C's `%.2f` keeps its decimals, `%g` its significant digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Precision {
    Decimals(i32),
    Significant(i32),
}

/// Reads a `.scen` file.
///
/// # Errors
/// [`FileError`] if the file cannot be read or is not such a file.
pub fn read_scen(path: &Path) -> Result<Scen, FileError> {
    parse_scen(&path.display().to_string(), &source::read(path)?)
}

/// Reads the content of a `.scen` file; `name` is for errors.
///
/// Columns are separated by tabs, or by spaces if a line has no tab.
///
/// # Errors
/// [`FileError`] if it is not such a file, or a query lies outside the size its line states.
///
/// ```
/// let text = b"version 1\n0\ta.map\t4\t3\t0\t0\t3\t1\t3.41421\n";
/// let scen = pf_io::parse_scen("a.map.scen", text).unwrap();
/// let row = &scen.rows[0];
/// assert_eq!((row.line, row.goal.to_string()), (2, "3,1".to_owned()));
/// assert!(scen.agrees(row, 2.0 + 2f64.sqrt()) && !scen.agrees(row, 3.4143));
/// ```
pub fn parse_scen(name: &str, bytes: &[u8]) -> Result<Scen, FileError> {
    let source = Source { name, bytes };
    let mut lines = Lines {
        text: source.text()?,
        at: 0,
        line: 0,
    };
    let version = lines.next();
    let words: Vec<_> = version.unwrap_or("").split_whitespace().collect();
    if !matches!(words[..], ["version", "1" | "1.0"]) {
        let found = version.map_or_else(|| "the end of the file".to_owned(), quoted);
        return Err(source.error(Place::Column(1, 1), found, "\"version 1\""));
    }
    let mut rows = Vec::new();
    let mut digits = Vec::new();
    while let Some(text) = lines.next() {
        if text.trim().is_empty() {
            continue;
        }
        let (row, printed) = row(source, lines.line, text)?;
        digits.push(digits_of(printed));
        rows.push(row);
    }
    Ok(Scen {
        name: name.to_owned(),
        rows,
        precision: precision(&digits),
    })
}

/// A row, and its optimum as it is written.
fn row<'a>(source: Source<'_>, line: u32, text: &'a str) -> Result<(ScenRow, &'a str), FileError> {
    let columns: Vec<&str> = if text.contains('\t') {
        text.split('\t').map(str::trim).collect()
    } else {
        text.split_whitespace().collect()
    };
    let &[bucket, map, width, height, sx, sy, gx, gy, optimum] = &columns[..] else {
        let found = format!("{} columns", columns.len());
        let expected = "9: bucket, map, width, height, start x and y, goal x and y, optimum";
        return Err(source.error(Place::Line(line), found, expected));
    };
    let wrong = |column: &str, expected: &str| {
        // A column is a slice of the line: where it begins is its distance from the line's start.
        let offset = column.as_ptr() as usize - text.as_ptr() as usize;
        let at = text[..offset].chars().count() + 1;
        let place = Place::Column(line, source::saturate(at));
        source.error(place, quoted(column), expected)
    };
    let number = |column: &str, what: &str| {
        let expected = || wrong(column, &format!("the {what}: a whole number from 0"));
        column.parse::<u32>().map_err(|_| expected())
    };
    let (width, height) = (
        number(width, "map's width")?,
        number(height, "map's height")?,
    );
    let inside = |column: &str, what: &str, size: u32| match number(column, what)? {
        n if n < size => Ok(n),
        _ => Err(wrong(
            column,
            &format!("the {what}: below {size}, the map's size"),
        )),
    };
    let row = ScenRow {
        line,
        bucket: number(bucket, "bucket")?,
        map: map.to_owned(),
        width,
        height,
        start: Cell::new(
            inside(sx, "start's x", width)?,
            inside(sy, "start's y", height)?,
        ),
        goal: Cell::new(
            inside(gx, "goal's x", width)?,
            inside(gy, "goal's y", height)?,
        ),
        optimum: match optimum.parse::<f64>() {
            Ok(length) if length.is_finite() && length >= 0.0 => length,
            _ => return Err(wrong(optimum, "the optimum: a length from 0")),
        },
    };
    Ok((row, optimum))
}

/// Decimals and significant digits of a number as it is written.
fn digits_of(printed: &str) -> (i32, i32) {
    let mantissa = printed.split(['e', 'E']).next().unwrap_or("");
    let decimals = mantissa.split_once('.').map_or(0, |(_, after)| after.len());
    let all: String = mantissa.chars().filter(char::is_ascii_digit).collect();
    let significant = all.trim_start_matches('0').len();
    let cap = |n: usize| i32::try_from(n).unwrap_or(i32::MAX);
    (cap(decimals), cap(significant))
}

/// Equal decimals throughout mean fixed decimals; otherwise the longest number shows how many
/// significant digits there are, for `%g` drops trailing zeros. Six is its default.
fn precision(digits: &[(i32, i32)]) -> Precision {
    match digits {
        [(first, _), ..] if *first > 0 && digits.iter().all(|(d, _)| d == first) => {
            Precision::Decimals(*first)
        }
        _ => Precision::Significant(digits.iter().map(|d| d.1).max().unwrap_or(0).max(6)),
    }
}

impl Scen {
    /// A file of these rows, to be written.
    #[must_use]
    pub fn new(rows: Vec<ScenRow>) -> Self {
        Self {
            name: String::new(),
            rows,
            precision: Precision::Decimals(8),
        }
    }

    /// Whether a length equals a row's optimum at the precision in which the file states it.
    #[must_use]
    pub fn agrees(&self, row: &ScenRow, length: f64) -> bool {
        let unit = match self.precision {
            Precision::Decimals(decimals) => 10f64.powi(-decimals),
            Precision::Significant(_) if row.optimum < 1.0 => 1e-6,
            #[expect(clippy::cast_possible_truncation, reason = "at most 308")]
            Precision::Significant(digits) => {
                10f64.powi(row.optimum.log10().floor() as i32 + 1 - digits)
            }
        };
        // The benchmark's generators knew the square root of 2 in single precision or to eight
        // decimals: their sums are off by up to 2e-8 of themselves before they are rounded.
        (length - row.optimum).abs() <= 0.5 * unit + 2e-8 * row.optimum
    }

    /// Checks that the rows are about a map of this size.
    ///
    /// # Errors
    /// [`FileError`] naming the first row that states another size.
    pub fn check_size(&self, grid: &Grid) -> Result<(), FileError> {
        let size = (grid.width(), grid.height());
        let Some(row) = self.rows.iter().find(|row| (row.width, row.height) != size) else {
            return Ok(());
        };
        let found = format!("a map of {} x {} cells", row.width, row.height);
        let expected = format!("{} x {}, as the map has", size.0, size.1);
        Err(FileError::new(
            &self.name,
            Place::Line(row.line),
            found,
            expected,
        ))
    }
}

/// Writes a `.scen` file; optima with eight decimals.
///
/// # Errors
/// [`FileError`] if the file cannot be written.
pub fn write_scen(path: &Path, scen: &Scen) -> Result<(), FileError> {
    write::whole(path, |out| {
        writeln!(out, "version 1")?;
        for row in &scen.rows {
            let ScenRow {
                bucket,
                map,
                width,
                height,
                start,
                goal,
                optimum,
                ..
            } = row;
            let (Cell { x: sx, y: sy }, Cell { x: gx, y: gy }) = (start, goal);
            writeln!(
                out,
                "{bucket}\t{map}\t{width}\t{height}\t{sx}\t{sy}\t{gx}\t{gy}\t{optimum:.8}"
            )?;
        }
        Ok(())
    })
}
