use std::{fmt, io, path::Path};

/// What is wrong with a file: which one, where in it, what was found and what was expected.
///
/// ```
/// let error = pf_io::parse_movingai("maps/x.map", b"type octile\nheigth 20\n").unwrap_err();
/// assert_eq!(
///     error.to_string(),
///     r#"maps/x.map:2:1: found "heigth 20", expected "height" and a number"#,
/// );
/// ```
#[derive(Debug, thiserror::Error)]
#[error("{file}{place}: {fault}")]
pub struct FileError {
    file: String,
    place: Place,
    fault: Fault,
}

/// Where in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Place {
    /// Nowhere in particular.
    Whole,
    /// A byte of a binary file, from 0.
    Byte(u64),
    /// A line of a text file, from 1.
    Line(u32),
    /// A line and a column of a text file, from 1; the column counts characters.
    Column(u32, u32),
}

#[derive(Debug, thiserror::Error)]
enum Fault {
    #[error("found {found}, expected {expected}")]
    Content { found: String, expected: String },
    #[error("cannot be {verb}: {source}")]
    Io {
        verb: &'static str,
        source: io::Error,
    },
}

impl FileError {
    /// About the content of a file.
    pub fn new(
        file: &str,
        place: Place,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        Self {
            file: file.to_owned(),
            place,
            fault: Fault::Content {
                found: found.into(),
                expected: expected.into(),
            },
        }
    }

    /// About a file that the system would not have read, written or made: `verb` says which.
    #[must_use]
    pub fn io(file: &Path, verb: &'static str, source: io::Error) -> Self {
        Self {
            file: file.display().to_string(),
            place: Place::Whole,
            fault: Fault::Io { verb, source },
        }
    }

    /// The file's name, as it was given.
    #[must_use]
    pub fn file(&self) -> &str {
        &self.file
    }

    /// Where in the file.
    #[must_use]
    pub fn place(&self) -> Place {
        self.place
    }

    /// What was found and what was expected; `None` if the system would not read or write the file.
    #[must_use]
    pub fn found_and_expected(&self) -> Option<(&str, &str)> {
        match &self.fault {
            Fault::Content { found, expected } => Some((found, expected)),
            Fault::Io { .. } => None,
        }
    }
}

/// As compilers write it after the file's name: nothing, `, byte 16`, `:3` or `:3:1`.
impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Whole => Ok(()),
            Self::Byte(at) => write!(f, ", byte {at}"),
            Self::Line(line) => write!(f, ":{line}"),
            Self::Column(line, column) => write!(f, ":{line}:{column}"),
        }
    }
}

/// Quotes what a file holds, on one line and not too long.
pub(crate) fn quoted(text: &str) -> String {
    const MOST: usize = 48;
    let mut shown = String::from("\"");
    for c in text.chars().take(MOST) {
        match c {
            '\'' => shown.push(c),
            _ => shown.extend(c.escape_debug()),
        }
    }
    if text.chars().nth(MOST).is_some() {
        shown.push('…');
    }
    shown.push('"');
    shown
}
