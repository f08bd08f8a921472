//! Pictures as maps: what is dark is blocked.

use crate::{FileError, Place, error::quoted, pgm, png, source, source::Source};
use pf_grid::Grid;
use std::path::Path;

/// Red, green, blue and alpha; alpha 255 is opaque.
pub(crate) type Pixel = [u8; 4];

/// A cost per cell, row by row; 0 is blocked.
#[derive(Debug)]
pub(crate) struct Costs {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) cells: Vec<u8>,
}

/// Reads a PNG or PGM picture as a map, a pixel a cell: a pixel is blocked if its luminance (ITU-R
/// BT.601), laid over white where it is transparent, is below 128 of 255.
///
/// The file's first bytes say which format it is.
///
/// # Errors
/// [`FileError`] if the file cannot be read or is not such a picture.
pub fn read_image(path: &Path) -> Result<Grid, FileError> {
    parse_image(&path.display().to_string(), &source::read(path)?)
}

/// Reads the content of a PNG or PGM file; `name` is for errors.
///
/// # Errors
/// [`FileError`] if it is not such a picture.
///
/// ```
/// let grid = pf_io::parse_image("dots.pgm", b"P2 3 1 255\n0 127 128\n").unwrap();
/// assert_eq!(grid.to_string(), "##.\n");
/// ```
pub fn parse_image(name: &str, bytes: &[u8]) -> Result<Grid, FileError> {
    let source = Source { name, bytes };
    costs(source, &|pixel| u8::from(luminance(pixel) >= 128))?.into_grid(source)
}

/// Reads a picture, turning each pixel into a cost at once: one byte per cell is all it takes.
pub(crate) fn costs(source: Source<'_>, cost: &dyn Fn(Pixel) -> u8) -> Result<Costs, FileError> {
    if png::is_png(source.bytes) {
        png::costs(source, cost)
    } else if pgm::is_pgm(source.bytes) {
        pgm::costs(source, cost)
    } else {
        let head = String::from_utf8_lossy(&source.bytes[..source.bytes.len().min(8)]);
        let expected = "a picture: PNG, or PGM beginning with P5 or P2";
        Err(source.error(Place::Byte(0), quoted(&head), expected))
    }
}

/// Checks the size that a picture's header states.
pub(crate) fn check_size(
    source: Source<'_>,
    place: Place,
    width: u64,
    height: u64,
) -> Result<(u32, u32), FileError> {
    Grid::check_size(width, height).map_err(|_| {
        let found = format!("a picture of {width} x {height} pixels");
        source.error(place, found, "1 to 268435456 (2^28) pixels")
    })
}

/// Luminance by the weights of BT.601, over white.
fn luminance([red, green, blue, alpha]: Pixel) -> u32 {
    let colour = 299 * u32::from(red) + 587 * u32::from(green) + 114 * u32::from(blue);
    let alpha = u32::from(alpha);
    (colour * alpha + 255_000 * (255 - alpha)) / 255_000
}

impl Costs {
    pub(crate) fn into_grid(self, source: Source<'_>) -> Result<Grid, FileError> {
        let width = self.width as usize;
        let cost = |cell: pf_grid::Cell| self.cells[cell.y as usize * width + cell.x as usize];
        Grid::new(self.width, self.height, cost)
            .map_err(|error| source.error(Place::Whole, error.to_string(), "a grid"))
    }
}
