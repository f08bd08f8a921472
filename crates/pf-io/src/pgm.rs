//! Netpbm's portable graymap, plain (`P2`) and raw (`P5`).
//!
//! Read here and not by the `image` crate because that neither scales samples by the file's
//! maximum nor says where an error lies.

use crate::{
    FileError, Place,
    error::quoted,
    raster::{Costs, Pixel, check_size},
    source::{Source, place_of},
    write,
};
use pf_grid::{Cell, Grid};
use std::{fmt, path::Path};

pub(crate) fn is_pgm(bytes: &[u8]) -> bool {
    bytes.starts_with(b"P2") || bytes.starts_with(b"P5")
}

/// Reads a PGM file of any maximum up to 65535; samples are scaled to 0..=255.
pub(crate) fn costs(source: Source<'_>, cost: &dyn Fn(Pixel) -> u8) -> Result<Costs, FileError> {
    let mut words = Words { source, at: 2 };
    let (width, height, most) = words.header()?;
    // What follows must be able to hold the samples: then nothing is larger than the file.
    let count = width as usize * height as usize;
    let raw = source.bytes.starts_with(b"P5");
    let bytes_each = if most > 255 { 2 } else { 1 };
    let begin = words.at + 1;
    let (least, sort) = if raw {
        (count * bytes_each, "bytes")
    } else {
        (2 * count - 1, "characters")
    };
    let held = source.bytes.len().saturating_sub(begin);
    if held < least {
        let found = format!("{held} {sort} of samples");
        let expected = format!("at least {least} for {width} x {height} pixels");
        return Err(source.error(Place::Byte(source.bytes.len() as u64), found, expected));
    }

    let scaled = |sample: u64| {
        let [.., gray] = ((sample * 255 + most / 2) / most).to_be_bytes();
        cost([gray, gray, gray, 255])
    };
    let too_large = |place, sample| {
        let (found, expected) = (format!("sample {sample}"), format!("at most {most}"));
        source.error(place, found, expected)
    };
    let mut cells = Vec::with_capacity(count);
    if raw {
        let samples = source.bytes[begin..].chunks_exact(bytes_each).take(count);
        for (k, sample) in samples.enumerate() {
            let sample = sample.iter().fold(0, |n, &byte| n << 8 | u64::from(byte));
            if sample > most {
                return Err(too_large(
                    Place::Byte((begin + k * bytes_each) as u64),
                    sample,
                ));
            }
            cells.push(scaled(sample));
        }
    } else {
        for k in 1..=count {
            let sample = words.number(format_args!("sample {k} of {count}"))?;
            if sample > most {
                return Err(too_large(words.place(), sample));
            }
            cells.push(scaled(sample));
        }
    }
    Ok(Costs {
        width,
        height,
        cells,
    })
}

/// The numbers of a PGM file, with comments between them.
struct Words<'a> {
    source: Source<'a>,
    at: usize,
}

impl Words<'_> {
    /// Width, height and the largest gray value.
    fn header(&mut self) -> Result<(u32, u32, u64), FileError> {
        let width = self.number(format_args!("the width"))?;
        let height = self.number(format_args!("the height"))?;
        let (width, height) = check_size(self.source, self.place(), width, height)?;
        let most = self.number(format_args!("the largest gray value"))?;
        if !(1..=65535).contains(&most) {
            let found = format!("the largest gray value {most}");
            return Err(self.source.error(self.place(), found, "1 to 65535"));
        }
        Ok((width, height, most))
    }

    fn number(&mut self, what: fmt::Arguments<'_>) -> Result<u64, FileError> {
        let bytes = self.source.bytes;
        let mut comment = false;
        while let Some(&byte) = bytes.get(self.at)
            && (comment || byte == b'#' || byte.is_ascii_whitespace())
        {
            comment = (comment || byte == b'#') && byte != b'\n';
            self.at += 1;
        }
        let begin = self.at;
        let digits = bytes[begin..].iter().take_while(|b| b.is_ascii_digit());
        self.at += digits.count();
        let word = str::from_utf8(&bytes[begin..self.at]).unwrap_or("");
        let ends = bytes.get(self.at).is_none_or(u8::is_ascii_whitespace);
        match word.parse() {
            Ok(number) if ends => Ok(number),
            _ => {
                let rest = &bytes[begin..];
                let blank = rest.iter().position(u8::is_ascii_whitespace);
                let end = blank.unwrap_or(rest.len()).min(32);
                let found = match &rest[..end] {
                    [] => "the end of the file".to_owned(),
                    odd => quoted(&String::from_utf8_lossy(odd)),
                };
                self.at = begin;
                let expected = format!("{what}: a whole number");
                Err(self.source.error(self.place(), found, expected))
            }
        }
    }

    /// Where the reader stands: among numbers, which are text, with comments, which may not be.
    fn place(&self) -> Place {
        let before = String::from_utf8_lossy(&self.source.bytes[..self.at]);
        place_of(&before, before.len())
    }
}

/// Writes a grid as a raw PGM picture: free cells are white (254, as ROS does), blocked ones
/// black. Terrain is lost.
///
/// # Errors
/// [`FileError`] if the file cannot be written.
pub fn write_pgm(path: &Path, grid: &Grid) -> Result<(), FileError> {
    write_gray(path, grid.width(), grid.height(), |cell| {
        if grid.is_free(cell) { 254 } else { 0 }
    })
}

/// Writes a raw PGM picture of `width` x `height` pixels, whose grays are what `gray` says.
///
/// # Errors
/// [`FileError`] if the file cannot be written.
pub fn write_gray(
    path: &Path,
    width: u32,
    height: u32,
    gray: impl Fn(Cell) -> u8,
) -> Result<(), FileError> {
    write::whole(path, |out| {
        write!(out, "P5\n{width} {height}\n255\n")?;
        for y in 0..height {
            let row: Vec<u8> = (0..width).map(|x| gray(Cell { x, y })).collect();
            out.write_all(&row)?;
        }
        Ok(())
    })
}
