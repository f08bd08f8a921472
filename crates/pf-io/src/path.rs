//! Paths, to be written.

use crate::{FileError, GridMap, world::number, write};
use pf_geom::Point;
use pf_grid::Cell;
use std::path::Path;

/// Writes a path as CSV: `x,y` per cell, and the cell's centre in metres (`x_m,y_m`) where the map
/// has a frame.
///
/// # Errors
/// [`FileError`] if the file cannot be written.
pub fn write_path_csv(path: &Path, cells: &[Cell], map: &GridMap) -> Result<(), FileError> {
    write::whole(path, |out| {
        let metres = map.frame.is_some();
        writeln!(out, "{}", if metres { "x,y,x_m,y_m" } else { "x,y" })?;
        for &cell in cells {
            match map.metres(cell) {
                Some([x, y]) => writeln!(out, "{cell},{x:.6},{y:.6}")?,
                None => writeln!(out, "{cell}")?,
            }
        }
        Ok(())
    })
}

/// Writes a path as JSON: an object whose `path` is an array of cells `[x, y]`, and whose `metres`,
/// where the map has a frame, is one of their centres.
///
/// # Errors
/// [`FileError`] if the file cannot be written.
pub fn write_path_json(path: &Path, cells: &[Cell], map: &GridMap) -> Result<(), FileError> {
    let pairs = |pairs: Vec<String>| format!("[{}]", pairs.join(","));
    write::whole(path, |out| {
        let path = cells.iter().map(|cell| format!("[{cell}]")).collect();
        write!(out, "{{\"path\":{}", pairs(path))?;
        if map.frame.is_some() {
            let metres = cells.iter().filter_map(|&cell| map.metres(cell));
            let metres = metres.map(|[x, y]| format!("[{x:.6},{y:.6}]")).collect();
            write!(out, ",\"metres\":{}", pairs(metres))?;
        }
        writeln!(out, "}}")
    })
}

/// Writes a path in a world as CSV: `x,y` per point, in the world's unit.
///
/// # Errors
/// [`FileError`] if the file cannot be written.
pub fn write_polyline_csv(path: &Path, points: &[Point]) -> Result<(), FileError> {
    write::whole(path, |out| {
        writeln!(out, "x,y")?;
        for p in points {
            writeln!(out, "{},{}", number(p.x), number(p.y))?;
        }
        Ok(())
    })
}

/// Writes a path in a world as JSON: an object whose `path` is an array of points `[x, y]` in the
/// world's unit, with all digits.
///
/// # Errors
/// [`FileError`] if the file cannot be written.
pub fn write_polyline_json(path: &Path, points: &[Point]) -> Result<(), FileError> {
    write::whole(path, |out| {
        let points = points.iter().map(|&point| <[f64; 2]>::from(point));
        let path: Vec<[f64; 2]> = points.collect();
        let object = serde_json::json!({ "path": path });
        writeln!(out, "{object}")
    })
}
