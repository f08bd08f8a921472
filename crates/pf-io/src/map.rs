//! A grid map of any format.

use crate::{
    FileError, Place, error::quoted, movingai, pgm, png, raster, ros, source, source::Source,
};
use pf_grid::{Cell, Grid};
use std::{
    ffi::OsStr,
    path::{Path, PathBuf},
    sync::Arc,
};

/// A grid and where it came from.
#[derive(Clone, Debug)]
pub struct GridMap {
    /// The grid; cell 0,0 is the picture's upper left.
    pub grid: Arc<Grid>,
    /// How it lies in the world, if the file says so.
    pub frame: Option<Frame>,
    /// The file it was read from.
    pub source: PathBuf,
}

/// How a grid lies in the world, as in ROS: metres, x and y in a right-handed frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The length of a cell's side in metres.
    pub resolution: f64,
    /// The lower left corner of the lower left cell: x and y in metres, and the angle in radians by
    /// which the map is turned counterclockwise about that corner.
    pub origin: [f64; 3],
}

/// What unknown cells of a ROS map count as.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Unknown {
    /// They are obstacles.
    #[default]
    Blocked,
    /// They are free.
    Free,
}

/// How maps are read.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LoadOptions {
    /// What unknown cells of a ROS map count as.
    pub unknown: Unknown,
    /// How far the bounds of a `GeoJSON` world without a `bbox` lie from its shapes, in its unit;
    /// without a word, a tenth of the longer side of the shapes' box.
    pub margin: Option<f64>,
}

/// Reads a grid map: Moving AI `.map`, ROS `map_server` `.yaml` or `.yml`, `.png` or `.pgm`. A file
/// of another name is read as what its first bytes say it is.
///
/// # Errors
/// [`FileError`] if the file cannot be read or is not a map of its kind.
pub fn load_grid(path: &Path, options: &LoadOptions) -> Result<GridMap, FileError> {
    grid(path, &source::read(path)?, options)
}

/// The grid in a file of this content.
pub(crate) fn grid(path: &Path, bytes: &[u8], options: &LoadOptions) -> Result<GridMap, FileError> {
    let name = path.display().to_string();
    let extension = path.extension().map(OsStr::to_ascii_lowercase);
    let source = Source { name: &name, bytes };
    let by_name = extension.as_deref().and_then(|e| Kind::named(e.to_str()?));
    let Some(kind) = by_name.or_else(|| Kind::of(&source)) else {
        let head = String::from_utf8_lossy(&bytes[..bytes.len().min(64)]);
        let first = quoted(head.lines().next().unwrap_or(""));
        let expected = "a map: Moving AI .map, ROS .yaml, .png or .pgm";
        return Err(source.error(Place::Whole, first, expected));
    };
    let (grid, frame) = match kind {
        Kind::MovingAi => (movingai::parse_movingai(&name, bytes)?, None),
        Kind::Picture => (raster::parse_image(&name, bytes)?, None),
        Kind::Ros => {
            let (grid, ros) = ros::with_picture(path, bytes, options.unknown)?;
            (grid, Some(ros.frame))
        }
    };
    Ok(GridMap {
        grid: Arc::new(grid),
        frame,
        source: path.to_owned(),
    })
}

/// Whether files of this extension, in small letters, are grids.
pub(crate) fn is_grid_extension(extension: &str) -> bool {
    Kind::named(extension).is_some()
}

/// Whether a file's first bytes are those of a grid.
pub(crate) fn is_grid(source: &Source<'_>) -> bool {
    Kind::of(source).is_some()
}

enum Kind {
    MovingAi,
    Ros,
    Picture,
}

impl Kind {
    fn named(extension: &str) -> Option<Self> {
        match extension {
            "map" => Some(Self::MovingAi),
            "yaml" | "yml" => Some(Self::Ros),
            "png" | "pgm" => Some(Self::Picture),
            _ => None,
        }
    }

    /// What a file's first bytes say it is.
    fn of(source: &Source<'_>) -> Option<Self> {
        let bytes = source.bytes;
        let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        if png::is_png(bytes) || pgm::is_pgm(bytes) {
            Some(Self::Picture)
        } else if text.starts_with(b"type ") {
            Some(Self::MovingAi)
        } else if text.starts_with(b"image:") {
            Some(Self::Ros)
        } else {
            None
        }
    }
}

impl GridMap {
    /// The centre of a cell in metres; `None` if the map has no frame.
    ///
    /// ```
    /// # use {pf_io::{Frame, GridMap}, pf_grid::{Cell, Grid}};
    /// let map = GridMap {
    ///     grid: Grid::open(4, 3).unwrap().into(),
    ///     frame: Some(Frame { resolution: 0.5, origin: [10.0, 20.0, 0.0] }),
    ///     source: "hall.yaml".into(),
    /// };
    /// // The lower left cell is in the last row: files run down, metres run up.
    /// assert_eq!(map.metres(Cell::new(0, 2)), Some([10.25, 20.25]));
    /// assert_eq!(map.cell_at([11.9, 21.4]), Some(Cell::new(3, 0)));
    /// assert_eq!(map.cell_at([12.1, 21.4]), None);
    /// ```
    #[must_use]
    pub fn metres(&self, cell: Cell) -> Option<[f64; 2]> {
        let Frame { resolution, origin } = self.frame?;
        let right = (f64::from(cell.x) + 0.5) * resolution;
        let up = (f64::from(self.grid.height()) - f64::from(cell.y) - 0.5) * resolution;
        let (sin, cos) = origin[2].sin_cos();
        Some([
            origin[0] + right * cos - up * sin,
            origin[1] + right * sin + up * cos,
        ])
    }

    /// The cell at a point in metres; `None` if the map has no frame or no cell there.
    #[must_use]
    pub fn cell_at(&self, [x, y]: [f64; 2]) -> Option<Cell> {
        let Frame { resolution, origin } = self.frame?;
        let (dx, dy) = (x - origin[0], y - origin[1]);
        let (sin, cos) = origin[2].sin_cos();
        let column = ((dx * cos + dy * sin) / resolution).floor();
        let row_from_below = ((dy * cos - dx * sin) / resolution).floor();
        let row = f64::from(self.grid.height()) - 1.0 - row_from_below;
        let inside = |n: f64, size: u32| (0.0..f64::from(size)).contains(&n);
        if !inside(column, self.grid.width()) || !inside(row, self.grid.height()) {
            return None;
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "whole and inside the grid"
        )]
        Some(Cell::new(column as u32, row as u32))
    }
}
