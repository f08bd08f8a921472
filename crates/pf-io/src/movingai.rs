//! Maps of the Moving AI benchmark: a header of four lines, then a character per cell.
//!
//! N. R. Sturtevant, Benchmarks for Grid-Based Pathfinding, IEEE Transactions on Computational
//! Intelligence and AI in Games 4(2), 2012.

use crate::{
    FileError, Place,
    error::quoted,
    source::{self, Source, saturate},
    write,
};
use pf_grid::{Cell, Grid};
use std::path::Path;

/// Reads a Moving AI `.map` file: `.`, `G` and `S` are passable, `@`, `O`, `T` and `W` are not, as
/// in the benchmark's octile maps.
///
/// # Errors
/// [`FileError`] if the file cannot be read or is not such a map.
pub fn read_movingai(path: &Path) -> Result<Grid, FileError> {
    parse_movingai(&path.display().to_string(), &source::read(path)?)
}

/// Reads the content of a `.map` file; `name` is for errors.
///
/// # Errors
/// [`FileError`] if it is not such a map.
///
/// ```
/// let map = b"type octile\nheight 2\nwidth 3\nmap\n..@\nG.T\n";
/// let grid = pf_io::parse_movingai("small.map", map).unwrap();
/// assert_eq!((grid.width(), grid.height(), grid.free_cells()), (3, 2, 4));
/// ```
pub fn parse_movingai(name: &str, bytes: &[u8]) -> Result<Grid, FileError> {
    let source = Source { name, bytes };
    let text = source.text()?;
    let mut lines = Lines {
        text,
        at: 0,
        line: 0,
    };
    let (width, height) = header(source, &mut lines)?;

    // Every row is looked at before memory for the grid is taken: a header alone costs nothing.
    let mut rows: Vec<u32> = Vec::new();
    for y in 0..height {
        rows.push(saturate(lines.at));
        let row = lines.next();
        check_row(row, width).map_err(|(column, found, expected)| {
            let expected = format!("{expected} (row {} of {height})", y + 1);
            let line = if row.is_some() {
                lines.line
            } else {
                lines.line + 1
            };
            source.error(Place::Column(line, column), found, expected)
        })?;
    }
    while let Some(more) = lines.next() {
        if !more.trim().is_empty() {
            let place = Place::Column(lines.line, 1);
            let expected = format!("the end of the file after {height} rows");
            return Err(source.error(place, quoted(more), expected));
        }
    }

    let text = text.as_bytes();
    let grid = Grid::new(width, height, |cell| {
        let at = rows[cell.y as usize] as usize + cell.x as usize;
        u8::from(matches!(text[at], b'.' | b'G' | b'S'))
    });
    grid.map_err(|error| source.error(Place::Line(2), error.to_string(), "a grid"))
}

/// Writes a grid as a Moving AI `.map` file: `.` is passable, `@` is not. Terrain is lost.
///
/// # Errors
/// [`FileError`] if the file cannot be written.
pub fn write_movingai(path: &Path, grid: &Grid) -> Result<(), FileError> {
    write::whole(path, |out| {
        let (width, height) = (grid.width(), grid.height());
        write!(out, "type octile\nheight {height}\nwidth {width}\nmap\n")?;
        let mut row = Vec::new();
        for y in 0..height {
            row.clear();
            row.extend((0..width).map(|x| {
                if grid.is_free(Cell { x, y }) {
                    b'.'
                } else {
                    b'@'
                }
            }));
            row.push(b'\n');
            out.write_all(&row)?;
        }
        Ok(())
    })
}

/// Reads the header's four lines: width and height.
fn header(source: Source<'_>, lines: &mut Lines<'_>) -> Result<(u32, u32), FileError> {
    let wrong = |found: Option<&str>, line, expected: &str| {
        source.error(Place::Column(line, 1), shown(found), expected)
    };

    let kind = lines.next();
    if !matches!(kind.map(words), Some(["type", "octile" | "tile"])) {
        return Err(wrong(kind, 1, "\"type octile\""));
    }
    let mut size = [0; 2];
    for (k, key) in ["height", "width"].into_iter().enumerate() {
        let found = lines.next();
        size[k] = match found.map(words) {
            Some([word, number]) if word == key => number.parse::<u64>().ok(),
            _ => None,
        }
        .ok_or_else(|| wrong(found, [2, 3][k], &format!("\"{key}\" and a number")))?;
    }
    let [height, width] = size;
    let (width, height) = Grid::check_size(width, height).map_err(|_| {
        let found = format!("a map of {width} x {height} cells");
        source.error(Place::Line(2), found, "1 to 268435456 (2^28) cells")
    })?;
    let found = lines.next();
    if found.map(words) != Some(["map", ""]) {
        return Err(wrong(found, 4, "\"map\""));
    }
    Ok((width, height))
}

/// What is wrong with a row, if anything: column, what was found, what was expected.
fn check_row(row: Option<&str>, width: u32) -> Result<(), (u32, String, String)> {
    let row = row.ok_or_else(|| (1, shown(None), format!("{width} cells")))?;
    if let Some((at, odd)) = row
        .char_indices()
        .find(|(_, c)| !matches!(c, '.' | 'G' | 'S' | '@' | 'O' | 'T' | 'W'))
    {
        // All before it is ASCII, so bytes are columns.
        let found = quoted(odd.encode_utf8(&mut [0; 4]));
        return Err((saturate(at + 1), found, "one of . G S @ O T W".to_owned()));
    }
    if row.len() != width as usize {
        let column = row.len().min(width as usize) + 1;
        let found = format!("{} cells", row.len());
        return Err((saturate(column), found, format!("{width} cells")));
    }
    Ok(())
}

fn shown(found: Option<&str>) -> String {
    found.map_or_else(|| "the end of the file".to_owned(), quoted)
}

/// The two words of a header line, the second possibly empty; a line of more words is none.
fn words(line: &str) -> [&str; 2] {
    let mut words = line.split_whitespace();
    match (words.next(), words.next(), words.next()) {
        (Some(first), second, None) => [first, second.unwrap_or("")],
        _ => [line, ""],
    }
}

/// Lines without their ends, counted from 1; `at` is the offset of the next.
pub(crate) struct Lines<'a> {
    pub(crate) text: &'a str,
    pub(crate) at: usize,
    pub(crate) line: u32,
}

impl<'a> Iterator for Lines<'a> {
    type Item = &'a str;

    fn next(&mut self) -> Option<&'a str> {
        let rest = &self.text[self.at..];
        if rest.is_empty() {
            return None;
        }
        let end = rest.find('\n').unwrap_or(rest.len());
        self.at += (end + 1).min(rest.len());
        self.line += 1;
        let line = &rest[..end];
        Some(line.strip_suffix('\r').unwrap_or(line))
    }
}
