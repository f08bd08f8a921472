//! A folder of results: a log to which every run is added once it is done, and what is made of it.

use crate::{
    SuiteError,
    record::{Line, Name, Record},
};
use pf_io::{FileError, Place, make_folder, write_whole};
use serde::Serialize;
use std::{
    fs::{self, File, OpenOptions, TryLockError},
    io::{self, Read, Seek, SeekFrom, Write},
    path::{Path, PathBuf},
};

/// The log: a line per run, in the order in which they were done.
const LOG: &str = "runs.jsonl";
/// What runs came to, without times: sorted, and the same however they were cut.
const RESULTS: &str = "results.jsonl";
const TABLE: &str = "results.csv";
const TIMES: &str = "times.csv";
const OUTPUTS: [&str; 3] = [RESULTS, TABLE, TIMES];

/// A folder of results that is open: nobody else adds to it meanwhile.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    log: File,
}

impl Folder {
    /// Opens a folder, which is made if need be, and reads what it holds. A last line that was not
    /// written to its end is dropped.
    ///
    /// # Errors
    /// [`SuiteError`] if it cannot be made, read or written, somebody else has it open, or a line is
    /// no result.
    pub fn open(path: &Path) -> Result<(Self, Vec<Line>), SuiteError> {
        let (mut folder, file) = Self::locked(path)?;
        let log = &mut folder.log;
        let mut text = Vec::new();
        log.read_to_end(&mut text)
            .map_err(|error| FileError::io(&file, "read", error))?;
        let (lines, whole) = parse(&file, &text)?;
        let cut = log.set_len(whole).and_then(|()| log.seek(SeekFrom::End(0)));
        cut.map_err(|error| FileError::io(&file, "written", error))?;
        Ok((folder, lines))
    }

    /// Opens a folder and forgets all that it holds, readable or not.
    ///
    /// # Errors
    /// As [`open`](Self::open), but for what the folder holds.
    pub fn open_afresh(path: &Path) -> Result<Self, SuiteError> {
        let (mut folder, _) = Self::locked(path)?;
        folder.clear()?;
        Ok(folder)
    }

    /// The folder with its log, which nobody else may use now.
    fn locked(path: &Path) -> Result<(Self, PathBuf), SuiteError> {
        make_folder(path)?;
        let file = path.join(LOG);
        let written = |error| FileError::io(&file, "written", error);
        let mut options = OpenOptions::new();
        let options = options.read(true).write(true).create(true).truncate(false);
        let log = options.open(&file).map_err(written)?;
        match log.try_lock() {
            Err(TryLockError::WouldBlock) => return Err(SuiteError::InUse(path.to_owned())),
            // Where a file system knows no locks, there are none.
            Ok(()) | Err(TryLockError::Error(_)) => {}
        }
        let path = path.to_owned();
        Ok((Self { path, log }, file))
    }

    /// Forgets all that the folder holds.
    ///
    /// # Errors
    /// [`SuiteError`] if the folder cannot be written.
    pub fn clear(&mut self) -> Result<(), SuiteError> {
        self.unfinish()?;
        let cut = self.log.set_len(0).and_then(|()| self.log.rewind());
        Ok(cut.map_err(|error| FileError::io(&self.path.join(LOG), "written", error))?)
    }

    /// Removes what was made of the log, as that will grow.
    ///
    /// # Errors
    /// [`SuiteError`] if the folder cannot be written.
    pub fn unfinish(&mut self) -> Result<(), SuiteError> {
        for name in OUTPUTS {
            let file = self.path.join(name);
            match fs::remove_file(&file) {
                Err(error) if error.kind() != io::ErrorKind::NotFound => {
                    return Err(FileError::io(&file, "removed", error).into());
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Adds a run.
    ///
    /// # Errors
    /// [`SuiteError`] if it cannot be written; what was there before is still there.
    pub fn add(&mut self, line: &Line) -> Result<(), SuiteError> {
        let mut text = json(line)?;
        text.push('\n');
        let log = &mut self.log;
        let end = log.stream_position();
        // At once, so that a run is there or not.
        let done = end.and_then(|end| {
            log.write_all(text.as_bytes()).inspect_err(|_| {
                // Of half a line nothing is left; where that fails, too, it is dropped by who reads it.
                let _ = log
                    .set_len(end)
                    .and_then(|()| log.seek(SeekFrom::Start(end)));
            })
        });
        Ok(done.map_err(|error| FileError::io(&self.path.join(LOG), "written", error))?)
    }

    /// Writes the tables of these runs.
    ///
    /// # Errors
    /// [`SuiteError`] if they cannot be written; each file is written whole or not at all.
    pub fn finish(&self, lines: &[Line]) -> Result<(), SuiteError> {
        finish(&self.path, lines)
    }
}

/// Reads what a folder holds, or a file of runs; nobody need have it open.
///
/// # Errors
/// [`SuiteError`] if it cannot be read, or a line is no result.
pub fn read(path: &Path) -> Result<Vec<Line>, SuiteError> {
    let file = if path.is_dir() {
        path.join(LOG)
    } else {
        path.to_owned()
    };
    let text = fs::read(&file).map_err(|error| FileError::io(&file, "read", error))?;
    Ok(parse(&file, &text)?.0)
}

/// The lines, and how many bytes of the text they are.
fn parse(file: &Path, text: &[u8]) -> Result<(Vec<Line>, u64), FileError> {
    let mut lines = Vec::new();
    let mut whole = 0;
    for (number, line) in (1..).zip(text.split_inclusive(|&byte| byte == b'\n')) {
        let ended = line.ends_with(b"\n");
        match serde_json::from_slice(line) {
            Ok(line) if ended => lines.push(line),
            // Written by halves.
            _ if !ended => break,
            Ok(_) => {}
            Err(error) => {
                let name = file.display().to_string();
                let found = format!("a line that is no result ({error})");
                let expected = "a line as `pf bench` writes it";
                return Err(FileError::new(&name, Place::Line(number), found, expected));
            }
        }
        whole += line.len() as u64;
    }
    Ok((lines, whole))
}

/// Runs of several folders as of one: sorted, and what several have done once.
///
/// # Errors
/// [`SuiteError::Differ`] if the same run is there with different results.
pub fn merged(mut lines: Vec<Line>) -> Result<Vec<Line>, SuiteError> {
    sort(&mut lines);
    for pair in lines.windows(2) {
        let [a, b] = [&pair[0].record, &pair[1].record];
        if a.name() == b.name() && a != b {
            let what = if a.fingerprint == b.fingerprint {
                "the same run has different results"
            } else {
                "they are of different versions of the suite"
            };
            return Err(SuiteError::Differ {
                run: spoken(a.name()),
                what,
            });
        }
    }
    lines.dedup_by(|a, b| a.record.name() == b.record.name());
    Ok(lines)
}

/// Sorts runs by suite, problem, planner, variant and seed.
pub(crate) fn sort(lines: &mut [Line]) {
    lines.sort_by(|a, b| a.record.name().cmp(&b.record.name()));
}

fn spoken((suite, problem, planner, variant, seed): Name<'_>) -> String {
    let variant = if variant.is_empty() {
        String::new()
    } else {
        format!(" {variant}")
    };
    format!("{suite}: {planner}{variant} on {problem}, seed {seed}")
}

/// Whether a folder holds runs, finished or not.
#[must_use]
pub fn holds_runs(path: &Path) -> bool {
    fs::metadata(path.join(LOG)).is_ok_and(|log| log.len() > 0)
}

/// Writes runs as a folder of their own.
///
/// # Errors
/// [`SuiteError`] if they cannot be written; each file is written whole or not at all.
pub fn write(path: &Path, lines: &[Line]) -> Result<(), SuiteError> {
    let text: Vec<String> = lines.iter().map(json).collect::<Result<_, _>>()?;
    // Nobody may add to what is replaced.
    let (mut held, log) = Folder::locked(path)?;
    if let Err(error) = put(&log, &text) {
        if !holds_runs(path) {
            // It was made to be held, and for nothing else.
            let _ = fs::remove_file(&log);
        }
        return Err(error);
    }
    // Results of the old log do not stand beside the new one.
    held.unfinish()?;
    finish(path, lines)
}

fn finish(path: &Path, lines: &[Line]) -> Result<(), SuiteError> {
    let results: Vec<String> = lines
        .iter()
        .map(|line| json(&line.record))
        .collect::<Result<_, _>>()?;
    put(&path.join(RESULTS), &results)?;
    let head = "suite,problem,kind,planner,variant,seed,outcome,stop,cost,length,clearance,\
                evaluations,iterations,expanded,notes,fingerprint";
    let rows = lines.iter().map(|line| row(&line.record));
    put(&path.join(TABLE), &with_head(head, rows))?;
    let head = "suite,problem,planner,variant,seed,elapsed_us,first_us,latency_us";
    let rows = lines.iter().map(|line| {
        let (r, t) = (&line.record, line.times);
        cells([
            r.suite.clone(),
            r.problem.clone(),
            r.planner.clone(),
            r.variant.clone(),
            r.seed.to_string(),
            t.elapsed_us.to_string(),
            number(t.first_us),
            t.latency_us.to_string(),
        ])
    });
    put(&path.join(TIMES), &with_head(head, rows))
}

fn with_head(head: &str, rows: impl Iterator<Item = String>) -> Vec<String> {
    std::iter::once(head.to_owned()).chain(rows).collect()
}

fn row(r: &Record) -> String {
    cells([
        r.suite.clone(),
        r.problem.clone(),
        r.kind.clone(),
        r.planner.clone(),
        r.variant.clone(),
        r.seed.to_string(),
        r.outcome.clone(),
        r.stop.clone(),
        number(r.cost),
        number(r.length),
        number(r.clearance),
        r.evaluations.to_string(),
        r.iterations.to_string(),
        r.expanded.to_string(),
        r.notes.join("; "),
        r.fingerprint.clone(),
    ])
}

fn number(value: Option<f64>) -> String {
    value.map(|value| value.to_string()).unwrap_or_default()
}

/// A row of comma-separated values after RFC 4180.
pub(crate) fn cells(cells: impl IntoIterator<Item = String>) -> String {
    let quoted = cells.into_iter().map(|cell| {
        if cell.contains(['"', ',', '\n', '\r']) {
            format!("\"{}\"", cell.replace('"', "\"\""))
        } else {
            cell
        }
    });
    quoted.collect::<Vec<_>>().join(",")
}

fn json(value: &impl Serialize) -> Result<String, SuiteError> {
    serde_json::to_string(value).map_err(|error| SuiteError::Internal(error.to_string()))
}

fn put(file: &Path, lines: &[String]) -> Result<(), SuiteError> {
    let write = |out: &mut dyn Write| lines.iter().try_for_each(|line| writeln!(out, "{line}"));
    Ok(write_whole(file, write)?)
}
