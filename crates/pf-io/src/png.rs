//! PNG pictures, read row by row.

use crate::{
    FileError, Place,
    raster::{Costs, Pixel, check_size},
    source::Source,
    write,
};
use ::png::{ColorType, Decoder, DecodingError, Limits, Reader, Transformations};
use pf_grid::{Cell, Grid};
use std::{
    io::{self, Cursor},
    path::Path,
};

/// The most memory a decoder may take beside the cells: rows, palette, metadata.
const DECODER_BYTES: usize = 1 << 24;
/// A larger picture is read once to see that it is whole before memory for its cells is taken:
/// a few kilobytes can promise a gigabyte.
const UNCHECKED_CELLS: usize = 1 << 24;

/// The seven passes of Adam7 interlacing: first column and row, then the steps.
const ADAM7: [[u32; 4]; 7] = [
    [0, 0, 8, 8],
    [4, 0, 8, 8],
    [0, 4, 4, 8],
    [2, 0, 4, 4],
    [0, 2, 2, 4],
    [1, 0, 2, 2],
    [0, 1, 1, 2],
];

pub(crate) fn is_png(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\x89PNG\r\n\x1a\n")
}

pub(crate) fn costs(source: Source<'_>, cost: &dyn Fn(Pixel) -> u8) -> Result<Costs, FileError> {
    let mut reader = open(source, Transformations::normalize_to_color8())?;
    let info = reader.info();
    let (width, height, interlaced) = (info.width, info.height, info.interlaced);
    let pass_table = if interlaced {
        &ADAM7[..]
    } else {
        &[[0, 0, 1, 1]]
    };
    let passes = || {
        pass_table
            .iter()
            .filter(|[x, y, ..]| *x < width && *y < height)
    };

    let cells = width as usize * height as usize;
    if cells > UNCHECKED_CELLS {
        let mut trial = open(source, Transformations::IDENTITY)?;
        for &[_, y0, _, dy] in passes() {
            for _ in (y0..height).step_by(dy as usize) {
                next_row(source, &mut trial)?;
            }
        }
    }
    let (color, _) = reader.output_color_type();
    let mut costs = vec![0; cells];
    for &[x0, y0, dx, dy] in passes() {
        for y in (y0..height).step_by(dy as usize) {
            let row = next_row(source, &mut reader)?;
            let begin = y as usize * width as usize;
            let places = costs[begin..begin + width as usize].iter_mut();
            let places = places.skip(x0 as usize).step_by(dx as usize);
            let samples = row.chunks_exact(color.samples());
            for (place, sample) in places.zip(samples) {
                *place = cost(pixel(sample));
            }
        }
    }
    reader.finish().map_err(|e| wrong(source, &e))?;
    Ok(Costs {
        width,
        height,
        cells: costs,
    })
}

fn open(
    source: Source<'_>,
    transformations: Transformations,
) -> Result<Reader<Cursor<&[u8]>>, FileError> {
    let limits = Limits {
        bytes: DECODER_BYTES,
    };
    let mut decoder = Decoder::new_with_limits(Cursor::new(source.bytes), limits);
    decoder.set_transformations(transformations);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    let info = decoder.read_header_info().map_err(|e| wrong(source, &e))?;
    // The header chunk follows the signature of 8 bytes; its size stands at byte 16.
    let place = Place::Byte(16);
    let (width, height) = check_size(source, place, info.width.into(), info.height.into())?;
    // No pixel takes more than 8 bytes; a row is held twice.
    if width as usize > DECODER_BYTES / 32 {
        let found = format!("a picture of {width} x {height} pixels");
        let expected = format!("at most {} columns in a PNG", DECODER_BYTES / 32);
        return Err(source.error(place, found, expected));
    }
    decoder.read_info().map_err(|e| wrong(source, &e))
}

fn next_row<'r>(
    source: Source<'_>,
    reader: &'r mut Reader<Cursor<&[u8]>>,
) -> Result<&'r [u8], FileError> {
    match reader.next_row() {
        Ok(Some(row)) => Ok(row.data()),
        Ok(None) => {
            let place = Place::Byte(source.bytes.len() as u64);
            Err(source.error(
                place,
                "fewer rows of pixels",
                "as many as the header states",
            ))
        }
        Err(error) => Err(wrong(source, &error)),
    }
}

fn wrong(source: Source<'_>, error: &DecodingError) -> FileError {
    let end = Place::Byte(source.bytes.len() as u64);
    let (place, found) = match error {
        DecodingError::IoError(e) if e.kind() == io::ErrorKind::UnexpectedEof => {
            (end, "the end of the file".to_owned())
        }
        DecodingError::LimitsExceeded => (Place::Whole, "metadata beyond all measure".to_owned()),
        other => (Place::Whole, format!("a broken PNG ({other})")),
    };
    source.error(place, found, "a whole and sound PNG picture")
}

fn pixel(sample: &[u8]) -> Pixel {
    match *sample {
        [gray] => [gray, gray, gray, 255],
        [gray, alpha] => [gray, gray, gray, alpha],
        [red, green, blue] => [red, green, blue, 255],
        [red, green, blue, alpha] => [red, green, blue, alpha],
        _ => [0, 0, 0, 255],
    }
}

/// Writes a grid as a gray PNG picture: free cells are white, blocked ones black. Terrain is
/// lost.
///
/// # Errors
/// [`FileError`] if the file cannot be written.
pub fn write_png(path: &Path, grid: &Grid) -> Result<(), FileError> {
    write::whole(path, |out| {
        let mut encoder = ::png::Encoder::new(out, grid.width(), grid.height());
        encoder.set_color(ColorType::Grayscale);
        let mut writer = encoder.write_header().map_err(io::Error::other)?;
        let mut stream = writer.stream_writer().map_err(io::Error::other)?;
        for y in 0..grid.height() {
            let shade = |x| if grid.is_free(Cell { x, y }) { 255 } else { 0 };
            let row: Vec<u8> = (0..grid.width()).map(shade).collect();
            io::Write::write_all(&mut stream, &row)?;
        }
        stream.finish().map_err(io::Error::other)
    })
}
