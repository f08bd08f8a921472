//! TOML values that know their place, and errors that name it: for formats that are read elsewhere.
//!
//! ```
//! use pf_io::toml_tree::TomlText;
//!
//! let text = TomlText::new("tea.toml", b"cups = 3\nsuger = 1\n")?;
//! let error = text.read_with("a recipe", |root| root.with_keys(&["cups", "sugar"])?.needed("cups", "how many")?.count("cups"));
//! assert_eq!(error.unwrap_err().to_string(), r#"tea.toml:2:1: found the key "suger", expected "sugar""#);
//! # Ok::<(), pf_io::FileError>(())
//! ```

use crate::{
    FileError, Place,
    error::quoted,
    source::{self, Source, place_of},
};
use pf_geom::Point;
use pf_grid::Cell;
use std::{ops::Range, path::Path};
use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

/// The largest coordinate of a world; squares and products of such are far from overflowing.
pub(crate) const LARGEST: f64 = 1e12;
/// What is said of a number that is larger, infinite or none at all.
pub(crate) const A_NUMBER: &str = "a number between -1e12 and 1e12";

/// A file and its text.
#[derive(Clone, Copy, Debug)]
pub(crate) struct File<'a> {
    pub(crate) source: Source<'a>,
    pub(crate) text: &'a str,
}

/// A table whose keys are known.
#[derive(Clone, Copy, Debug)]
pub struct Table<'a> {
    file: File<'a>,
    span: (usize, usize),
    entries: &'a DeTable<'a>,
}

/// A value and its place.
#[derive(Clone, Copy, Debug)]
pub struct Value<'a> {
    file: File<'a>,
    span: (usize, usize),
    content: &'a DeValue<'a>,
}

/// A TOML file in memory.
#[derive(Clone, Debug)]
pub struct TomlText {
    name: String,
    bytes: Vec<u8>,
}

impl TomlText {
    /// Of a file.
    ///
    /// # Errors
    /// [`FileError`] if it cannot be read.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        Ok(Self {
            name: path.display().to_string(),
            bytes: source::read(path)?,
        })
    }

    /// Of bytes; `name` is for errors.
    ///
    /// # Errors
    /// [`FileError`] if they are no text.
    pub fn new(name: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Result<Self, FileError> {
        let (name, bytes) = (name.into(), bytes.into());
        let source = Source {
            name: &name,
            bytes: &bytes,
        };
        source.text()?;
        Ok(Self { name, bytes })
    }

    /// Hands the whole to a reader; `expected` says what the file should be.
    ///
    /// # Errors
    /// [`FileError`] if it is no TOML, or the reader's own.
    pub fn read_with<R>(
        &self,
        expected: &str,
        read: impl FnOnce(Table<'_>) -> Result<R, FileError>,
    ) -> Result<R, FileError> {
        let source = Source {
            name: &self.name,
            bytes: &self.bytes,
        };
        let file = File {
            source,
            text: source.text()?,
        };
        let root = file.parse(expected)?;
        read(Table::root(file, &root))
    }
}

impl<'a> File<'a> {
    /// The content; `expected` says what the file should be.
    pub(crate) fn parse(&self, expected: &str) -> Result<Spanned<DeTable<'a>>, FileError> {
        DeTable::parse(self.text).map_err(|error| {
            let place = error
                .span()
                .map_or(Place::Whole, |span| self.place(span.start));
            let message = error.message().lines().next().unwrap_or("");
            let found = format!("broken TOML ({message})");
            self.source.error(place, found, expected)
        })
    }

    fn place(&self, offset: usize) -> Place {
        place_of(self.text, offset)
    }
}

impl<'a> Table<'a> {
    pub(crate) fn root(file: File<'a>, root: &'a Spanned<DeTable<'a>>) -> Self {
        Self {
            file,
            span: (0, 0),
            entries: root.get_ref(),
        }
    }

    /// Where it begins, to tell which of two tables comes first.
    pub(crate) fn offset(&self) -> usize {
        self.span.0
    }

    /// Refuses every key that is not among `keys`.
    ///
    /// # Errors
    /// [`FileError`] if it is something else.
    pub fn with_keys(self, keys: &[&str]) -> Result<Self, FileError> {
        // Tables are sorted by key: the first unknown one by place is the one to name.
        let unknown = self
            .entries
            .keys()
            .filter(|key| !keys.contains(&key.get_ref().as_ref()));
        let Some(key) = unknown.min_by_key(|key| key.span().start) else {
            return Ok(self);
        };
        let expected = match nearest(key.get_ref(), keys.iter().copied()) {
            Some(known) => format!("\"{known}\""),
            None => format!("one of {}", keys.join(", ")),
        };
        let place = self.file.place(key.span().start);
        let found = format!("the key {}", quoted(key.get_ref()));
        Err(self.file.source.error(place, found, expected))
    }

    /// The value of a key, if it is there.
    #[must_use]
    pub fn get(&self, key: &str) -> Option<Value<'a>> {
        let value = self.entries.get(key)?;
        Some(Value::new(self.file, value))
    }

    /// The value of a key; `expected` says what it is for.
    ///
    /// # Errors
    /// [`FileError`] if it is not there.
    pub fn needed(&self, key: &str, expected: &str) -> Result<Value<'a>, FileError> {
        let missing = || self.error(format!("no \"{key}\""), format!("\"{key}\": {expected}"));
        self.get(key).ok_or_else(missing)
    }

    /// What a word under a key stands for, if the key is there.
    ///
    /// # Errors
    /// [`FileError`] if it is none of these words.
    pub fn one_of<T: Copy>(&self, key: &str, words: &[(&str, T)]) -> Result<Option<T>, FileError> {
        let Some(value) = self.get(key) else {
            return Ok(None);
        };
        let word = value.string()?;
        let known = words.iter().find(|(known, _)| *known == word);
        known.map(|(_, meaning)| Some(*meaning)).ok_or_else(|| {
            let words: Vec<_> = words.iter().map(|(word, _)| *word).collect();
            value.error(match nearest(word, words.iter().copied()) {
                Some(near) => format!("\"{near}\" (one of {})", words.join(", ")),
                None => format!("one of {}", words.join(", ")),
            })
        })
    }

    /// A string, if the key is there.
    ///
    /// # Errors
    /// [`FileError`] if it is something else.
    pub fn string(&self, key: &str) -> Result<Option<&'a str>, FileError> {
        self.get(key).map(|value| value.string()).transpose()
    }

    /// What something is called, if it has a name.
    ///
    /// # Errors
    /// [`FileError`] if the name is no string or empty.
    pub fn name(&self) -> Result<Option<String>, FileError> {
        let Some(value) = self.get("name") else {
            return Ok(None);
        };
        match value.string()? {
            "" => Err(value.error("a name, not an empty string")),
            name => Ok(Some(name.to_owned())),
        }
    }

    /// Its keys, each with its value and an error about the key itself, sorted.
    pub fn entries(&self) -> impl Iterator<Item = (&'a str, Value<'a>)> + use<'a> {
        let file = self.file;
        let entry = move |(key, value): (&'a Spanned<_>, _)| {
            let key: &'a std::borrow::Cow<'a, str> = key.get_ref();
            (key.as_ref(), Value::new(file, value))
        };
        self.entries.iter().map(entry)
    }

    /// An error about a key that is there.
    #[must_use]
    pub fn key_error(&self, key: &str, expected: impl Into<String>) -> FileError {
        let found = self.entries.get_key_value(key);
        let at = found.map_or(self.span.0, |(key, _)| key.span().start);
        let found = format!("the key {}", quoted(key));
        let place = self.file.place(at);
        self.file.source.error(place, found, expected)
    }

    /// Tables under a key: one, several or none.
    ///
    /// # Errors
    /// [`FileError`] if it is something else.
    pub fn tables(&self, key: &str) -> Result<Vec<Table<'a>>, FileError> {
        match self.get(key) {
            None => Ok(Vec::new()),
            Some(value) if value.content.is_table() => Ok(vec![value.table()?]),
            Some(value) => value.array("tables")?.map(|value| value.table()).collect(),
        }
    }

    /// An error about the table as a whole.
    pub fn error(&self, found: impl Into<String>, expected: impl Into<String>) -> FileError {
        let place = self.file.place(self.span.0);
        self.file.source.error(place, found, expected)
    }
}

impl<'a> Value<'a> {
    fn new(file: File<'a>, value: &'a Spanned<DeValue<'a>>) -> Self {
        let Range { start, end } = value.span();
        Self {
            file,
            span: (start, end),
            content: value.get_ref(),
        }
    }

    /// An error about this value, quoting it.
    pub fn error(&self, expected: impl Into<String>) -> FileError {
        let text = self.file.text.get(self.span.0..self.span.1).unwrap_or("");
        let found = quoted(text);
        self.file
            .source
            .error(self.file.place(self.span.0), found, expected)
    }

    /// A string.
    ///
    /// # Errors
    /// [`FileError`] if it is something else.
    pub fn string(&self) -> Result<&'a str, FileError> {
        self.content.as_str().ok_or_else(|| self.error("a string"))
    }

    /// A table.
    ///
    /// # Errors
    /// [`FileError`] if it is something else.
    pub fn table(&self) -> Result<Table<'a>, FileError> {
        let entries = self
            .content
            .as_table()
            .ok_or_else(|| self.error("a table"))?;
        Ok(Table {
            file: self.file,
            span: self.span,
            entries,
        })
    }

    /// The members of an array.
    ///
    /// # Errors
    /// [`FileError`] if it is something else.
    pub fn array(&self, of: &str) -> Result<impl Iterator<Item = Value<'a>> + use<'a>, FileError> {
        let expected = || self.error(format!("an array of {of}"));
        let array = self.content.as_array().ok_or_else(expected)?;
        let file = self.file;
        Ok(array.iter().map(move |value| Value::new(file, value)))
    }

    /// A coordinate or a size in a world, whole or not.
    ///
    /// # Errors
    /// [`FileError`] if it is something else.
    pub fn number(&self, what: &str) -> Result<f64, FileError> {
        let number = match self.content {
            DeValue::Integer(n) if n.radix() == 10 => n.as_str().parse().ok(),
            DeValue::Integer(n) => u32::from_str_radix(n.as_str(), n.radix())
                .ok()
                .map(f64::from),
            DeValue::Float(n) => n.as_str().parse().ok(),
            _ => None,
        };
        number
            .filter(|n: &f64| n.abs() <= LARGEST)
            .ok_or_else(|| self.error(format!("{what}: {A_NUMBER}")))
    }

    /// A number from 0 in a world, whole or not.
    ///
    /// # Errors
    /// [`FileError`] if it is something else.
    pub fn size(&self, what: &str) -> Result<f64, FileError> {
        let number = self.number(what)?;
        if number >= 0.0 {
            return Ok(number);
        }
        Err(self.error(format!("{what}: a number from 0")))
    }

    /// A point `[x, y]` of a world.
    ///
    /// # Errors
    /// [`FileError`] if it is something else.
    pub fn point(&self, what: &str) -> Result<Point, FileError> {
        match self.content.as_array() {
            Some(numbers) if numbers.len() == 2 => {
                let mut numbers = numbers.iter().map(|n| Value::new(self.file, n));
                let mut next = || numbers.next().map_or(Ok(0.0), |n| n.number(what));
                Ok(Point::new(next()?, next()?))
            }
            _ => Err(self.error(format!("{what}: a point [x, y]"))),
        }
    }

    /// A number, a word or a truth value as it would be written on a command line.
    ///
    /// # Errors
    /// [`FileError`] if it is an array, a table or a date.
    pub fn scalar(&self) -> Result<String, FileError> {
        match self.content {
            DeValue::Integer(n) if n.radix() == 10 => Ok(n.as_str().to_owned()),
            DeValue::Float(n) => Ok(n.as_str().to_owned()),
            DeValue::Boolean(truth) => Ok(truth.to_string()),
            DeValue::String(text) => Ok(text.to_string()),
            _ => Err(self.error("a number, a string, true or false")),
        }
    }

    /// Whether it is an array.
    #[must_use]
    pub fn is_array(&self) -> bool {
        self.content.is_array()
    }

    /// `true` or `false`.
    ///
    /// # Errors
    /// [`FileError`] if it is neither.
    pub fn truth(&self) -> Result<bool, FileError> {
        let truth = self.content.as_bool();
        truth.ok_or_else(|| self.error("true or false"))
    }

    /// A whole number from 0 that counts things in memory.
    #[must_use]
    pub fn index(&self) -> Option<usize> {
        match self.content {
            DeValue::Integer(n) => usize::from_str_radix(n.as_str(), n.radix()).ok(),
            _ => None,
        }
    }

    /// A number from 0, whole or not.
    ///
    /// # Errors
    /// [`FileError`] if it is something else.
    pub fn amount(&self, what: &str) -> Result<f64, FileError> {
        let number = match self.content {
            DeValue::Integer(n) => i64::from_str_radix(n.as_str(), n.radix())
                .ok()
                .and_then(|n| u32::try_from(n).ok())
                .map(f64::from),
            DeValue::Float(n) => n.as_str().parse().ok(),
            _ => None,
        };
        number
            .filter(|n: &f64| n.is_finite() && *n >= 0.0)
            .ok_or_else(|| self.error(format!("{what}: a number from 0")))
    }

    /// A whole number from 0.
    ///
    /// # Errors
    /// [`FileError`] if it is something else.
    pub fn count(&self, what: &str) -> Result<u32, FileError> {
        let number = match self.content {
            DeValue::Integer(n) => u32::from_str_radix(n.as_str(), n.radix()).ok(),
            _ => None,
        };
        number.ok_or_else(|| self.error(format!("{what}: a whole number from 0")))
    }

    /// A cell `[x, y]` of a map of this size.
    ///
    /// # Errors
    /// [`FileError`] if it is something else.
    pub fn cell(&self, size: (u32, u32)) -> Result<Cell, FileError> {
        let (corner, _) = self.rectangle(size)?;
        match self.content.as_array() {
            Some(numbers) if numbers.len() == 2 => Ok(corner),
            _ => Err(self.error("a cell [x, y]")),
        }
    }

    /// Cells: an array of `[x, y]` and of rectangles `[x, y, width, height]`.
    pub(crate) fn cells(&self, size: (u32, u32)) -> Result<Vec<Cell>, FileError> {
        let mut cells = Vec::new();
        for value in self.array("cells [x, y] or [x, y, width, height]")? {
            let (Cell { x, y }, (width, height)) = value.rectangle(size)?;
            let rows = y..y + height;
            cells.extend(rows.flat_map(|y| (x..x + width).map(move |x| Cell { x, y })));
        }
        Ok(cells)
    }

    /// A cell or a rectangle that lies in a map of this size.
    fn rectangle(&self, size: (u32, u32)) -> Result<(Cell, (u32, u32)), FileError> {
        let what = "a cell [x, y] or a rectangle [x, y, width, height]";
        let numbers: Vec<u32> = match self.content {
            DeValue::Array(array) if matches!(array.len(), 2 | 4) => self
                .array("numbers")?
                .map(|value| value.count("a coordinate"))
                .collect::<Result<_, _>>()?,
            _ => return Err(self.error(what)),
        };
        let (cell, extent) = match numbers[..] {
            [x, y] => (Cell { x, y }, (1, 1)),
            [x, y, width, height] => (Cell { x, y }, (width, height)),
            _ => return Err(self.error(what)),
        };
        let inside = |from: u32, length: u32, size: u32| {
            length > 0 && u64::from(from) + u64::from(length) <= u64::from(size)
        };
        if inside(cell.x, extent.0, size.0) && inside(cell.y, extent.1, size.1) {
            return Ok((cell, extent));
        }
        Err(self.error(format!("cells inside the map of {} x {}", size.0, size.1)))
    }
}

/// The one of `known` that someone who wrote `word` may have meant.
#[must_use]
pub fn nearest<'k>(word: &str, known: impl Iterator<Item = &'k str>) -> Option<&'k str> {
    let by_distance = known.map(|known| (strsim::damerau_levenshtein(known, word), known));
    let (distance, nearest) = by_distance.min()?;
    (distance <= 2).then_some(nearest)
}

/// The end of an error about a `word` that is none of the names there are: the one that was probably meant,
/// and all of them.
///
/// ```
/// # use pf_io::toml_tree::there_are;
/// assert_eq!(there_are("yrad", "map", &["yard", "hall"]), "did you mean `yard`? the maps are `yard`, `hall`");
/// assert_eq!(there_are("office", "map", &["yard"]), "the maps are `yard`");
/// ```
#[must_use]
pub fn there_are(word: &str, what: &str, names: &[&str]) -> String {
    let near = nearest(word, names.iter().copied());
    let near = near.map_or(String::new(), |near| format!("did you mean `{near}`? "));
    let quoted: Vec<_> = names.iter().map(|name| format!("`{name}`")).collect();
    format!("{near}the {what}s are {}", quoted.join(", "))
}
