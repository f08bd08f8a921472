//! How the program ends, and what it says when it ends badly.

use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme, NamedSource, SourceSpan};
use pf_core::InvalidProblem;
use pf_io::{FileError, Place};
use pf_planners::Refusal;
use std::{
    fs,
    io::{self, Write},
    process::ExitCode,
};

/// How a verb that did its work ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Status {
    /// All is well.
    #[default]
    Done,
    /// None found within the budget.
    NotFound,
    /// Proved: there is no path.
    NoPath,
    /// What was stated is not so.
    CheckFailed,
    /// By Ctrl-C.
    Interrupted,
}

impl Status {
    pub(crate) fn code(self) -> u8 {
        match self {
            Self::Done => 0,
            Self::NoPath => 4,
            Self::NotFound => 5,
            Self::CheckFailed => 6,
            Self::Interrupted => 130,
        }
    }
}

impl From<Status> for ExitCode {
    fn from(status: Status) -> Self {
        status.code().into()
    }
}

/// Why a verb could not do its work.
#[derive(Debug, thiserror::Error, Diagnostic)]
pub(crate) enum Failure {
    #[error("{message}")]
    Usage {
        message: String,
        #[help]
        help: Option<String>,
    },
    #[error("{message}")]
    BadFile {
        message: String,
        #[source_code]
        code: Option<NamedSource<String>>,
        #[label("here")]
        at: Option<SourceSpan>,
    },
    #[error("cannot write to standard output: {0}")]
    Output(#[from] io::Error),
    #[error("{0}")]
    Internal(String),
}

impl Failure {
    pub(crate) fn usage(message: impl Into<String>) -> Self {
        Self::Usage {
            message: message.into(),
            help: None,
        }
    }

    pub(crate) fn help(self, text: impl Into<String>) -> Self {
        match self {
            Self::Usage { message, .. } => Self::Usage {
                message,
                help: Some(text.into()),
            },
            other => other,
        }
    }

    /// A result that cannot be stored is no fault of an input.
    pub(crate) fn unwritten(error: &FileError) -> Self {
        Self::Internal(error.to_string())
    }

    fn code(&self) -> u8 {
        match self {
            Self::Usage { .. } => 2,
            Self::BadFile { .. } => 3,
            // Whoever reads our output has read enough.
            Self::Output(error) if error.kind() == io::ErrorKind::BrokenPipe => 0,
            Self::Output(_) | Self::Internal(_) => 1,
        }
    }

    /// Says what is wrong, on standard error.
    pub(crate) fn tell(&self) -> ExitCode {
        let code = self.code();
        if code != 0 {
            let mut text = String::new();
            // Names of files and cells stay in one piece, however narrow the terminal.
            let handler = GraphicalReportHandler::new_themed(GraphicalTheme::unicode())
                .with_wrap_lines(false)
                .with_context_lines(1);
            if handler.render_report(&mut text, self).is_err() {
                text = self.to_string();
            }
            let text = text.trim_matches('\n');
            let _ = writeln!(anstream::stderr(), "{text}");
        }
        code.into()
    }
}

impl From<InvalidProblem> for Failure {
    /// What the options ask makes no sense: files are checked where they are read.
    fn from(error: InvalidProblem) -> Self {
        Self::usage(error.to_string())
    }
}

impl From<Refusal> for Failure {
    fn from(refusal: Refusal) -> Self {
        match refusal {
            Refusal::NothingPlanned => Self::Internal(refusal.to_string()),
            other => Self::usage(other.to_string()),
        }
    }
}

impl From<FileError> for Failure {
    /// Shows the line of a text file in which the error lies.
    fn from(error: FileError) -> Self {
        let shown = shown(&error);
        let (code, at) = shown.map_or((None, None), |(code, at)| (Some(code), Some(at)));
        Self::BadFile {
            message: error.to_string(),
            code,
            at,
        }
    }
}

/// Lines longer than this say nothing to a reader.
const LONGEST_LINE: usize = 200;
/// Longer files are not read a second time.
const LONGEST_FILE: u64 = 1 << 22;

fn shown(error: &FileError) -> Option<(NamedSource<String>, SourceSpan)> {
    let (line, column) = match error.place() {
        Place::Line(line) => (line, None),
        Place::Column(line, column) => (line, Some(column)),
        _ => return None,
    };
    if fs::metadata(error.file()).ok()?.len() > LONGEST_FILE {
        return None;
    }
    let text = fs::read_to_string(error.file()).ok()?;
    let mut start = 0;
    let mut lines = text.split_inclusive('\n');
    for _ in 1..line {
        start += lines.next()?.len();
    }
    let content = lines.next()?.trim_end();
    if content.len() > LONGEST_LINE || content.chars().any(|c| c.is_control() && c != '\t') {
        return None;
    }
    let (from, length) = match column {
        None => (0, content.len()),
        Some(column) => {
            let mut chars = content.char_indices();
            let from = chars
                .nth(column as usize - 1)
                .map_or(content.len(), |c| c.0);
            let word = content[from..].split([' ', '\t', ',', ']']).next()?;
            (from, word.len().max(1))
        }
    };
    let code = NamedSource::new(error.file(), text);
    Some((code, (start + from, length).into()))
}
