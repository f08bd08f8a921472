//! The bytes of a file and its name, and errors that point into them.

use crate::{FileError, Place};
use std::{fs, io::Read, path::Path};

/// The longest file that is read: 2^30 bytes, as the largest grid in plain PGM may take.
const LONGEST_FILE: u64 = 1 << 30;
/// What is not a regular file (a pipe, a device) has no length to check, and may never end.
const LONGEST_STREAM: u64 = 1 << 24;

/// A file's content under its name.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Source<'a> {
    pub(crate) name: &'a str,
    pub(crate) bytes: &'a [u8],
}

/// Reads a whole file, unless it is absurdly long.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>, FileError> {
    let io = |error| FileError::io(path, "read", error);
    let file = fs::File::open(path).map_err(io)?;
    let facts = file.metadata().map_err(io)?;
    let longest = if facts.is_file() {
        LONGEST_FILE
    } else {
        LONGEST_STREAM
    };
    let mut bytes = Vec::new();
    if facts.len() <= longest {
        file.take(longest + 1).read_to_end(&mut bytes).map_err(io)?;
    }
    if facts.len().max(bytes.len() as u64) > longest {
        return Err(FileError::new(
            &path.display().to_string(),
            Place::Whole,
            format!("more than {longest} bytes"),
            format!("at most {longest}"),
        ));
    }
    Ok(bytes)
}

impl<'a> Source<'a> {
    pub(crate) fn error(
        &self,
        place: Place,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> FileError {
        FileError::new(self.name, place, found, expected)
    }

    /// The content as text, without a byte order mark.
    pub(crate) fn text(&self) -> Result<&'a str, FileError> {
        match str::from_utf8(self.bytes) {
            Ok(text) => Ok(text.strip_prefix('\u{feff}').unwrap_or(text)),
            Err(error) => {
                let at = error.valid_up_to();
                let before = String::from_utf8_lossy(&self.bytes[..at]);
                let found = format!("byte {:#04x} at offset {at}", self.bytes[at]);
                let place = place_of(before.trim_start_matches('\u{feff}'), usize::MAX);
                Err(self.error(place, found, "text in UTF-8"))
            }
        }
    }
}

/// Line and column of a byte offset in `text`; of its end if the offset lies beyond.
pub(crate) fn place_of(text: &str, offset: usize) -> Place {
    let before = text.get(..offset.min(text.len())).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |at| at + 1);
    let line = before.bytes().filter(|&b| b == b'\n').count() + 1;
    let column = before[line_start..].chars().count() + 1;
    Place::Column(saturate(line), saturate(column))
}

/// For places: files are shorter than 2^32 bytes.
pub(crate) fn saturate(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}
