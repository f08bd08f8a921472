//! `pf paper`: the experiments of papers.

use crate::{
    failure::{Failure, Status},
    interrupt::at_once,
};
use indicatif::{ProgressBar, ProgressStyle};
use pf_core::CancelToken;
use pf_io::{make_folder, toml_tree::there_are};
use pf_papers::{
    PaperError, cabc, faustino, kim,
    page::{Figure, write_report},
    redlarski::{self, tune},
    row::{Row, tables},
    wang,
};
use serde::Serialize;
use std::{
    io::{Write, stdout},
    num::NonZeroUsize,
    path::{Path, PathBuf},
};

/// Run the experiment of a paper again, and print its numbers beside ours
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(subcommand)]
    paper: Paper,
}

#[derive(clap::Subcommand)]
enum Paper {
    /// Waypoints by L-BFGS on three maps, cold and warm
    Kim(KimArgs),
    /// Swarms of waypoints round one obstacle
    Faustino(FaustinoArgs),
    /// Bees that walk two unknown maps: seven tables, and what a memory does for them
    Cabc(CabcArgs),
    /// Bees and others on fronts of plans for one robot and for three
    Wang(WangArgs),
    /// Rivers and ants on nine grids: five tables
    Redlarski(RedlarskiArgs),
    /// Search parameters for RFD* on made-up maps, and check them on the paper's nine
    RedlarskiTune(TuneArgs),
}

#[derive(clap::Args)]
struct KimArgs {
    /// Runs of each case, as chance has its part in some
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..))]
    runs: u32,
    #[command(flatten)]
    output: Output,
}

#[derive(clap::Args)]
struct FaustinoArgs {
    /// Scenes for each format of obstacle and number of particles, besides the paper's 240 runs
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = clap::value_parser!(u32).range(1..))]
    runs: u32,
    #[command(flatten)]
    output: Output,
}

#[derive(clap::Args)]
struct CabcArgs {
    /// Runs of each row; the first 20 or 30 of them are compared with the paper's, too
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u32).range(1..))]
    runs: u32,
    /// How many rows are run at a time; only times depend on it
    #[arg(long, value_name = "N", default_value = "1")]
    threads: NonZeroUsize,
    #[command(flatten)]
    output: Output,
}

#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  pf paper wang --only three-discs
  pf paper wang --runs 30 --report report")]
struct WangArgs {
    /// Runs of each planner
    #[arg(long, value_name = "N", default_value_t = 30, value_parser = clap::value_parser!(u32).range(1..))]
    runs: u32,
    /// Only the problems whose name contains this
    #[arg(long, value_name = "TEXT", allow_hyphen_values = true)]
    only: Option<String>,
    #[command(flatten)]
    output: Output,
}

/// What becomes of the numbers.
#[derive(clap::Args)]
struct Output {
    /// One object per table row, one a line
    #[arg(long)]
    json: bool,
    /// Write figures and a report into this folder
    #[arg(long, value_name = "DIR")]
    report: Option<PathBuf>,
}

#[derive(clap::Args)]
struct TuneArgs {
    /// Sets of parameters to begin with
    #[arg(long, value_name = "N", default_value = "256")]
    sets: NonZeroUsize,
    /// The seed they are drawn from
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Runs on each of the nine maps
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..))]
    runs: u32,
    /// One object per map and set of parameters, one a line
    #[arg(long)]
    json: bool,
    /// How many threads a swarm may use; nothing depends on it
    #[arg(long, value_name = "N", default_value = "1")]
    threads: NonZeroUsize,
}

#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  pf paper redlarski --report report
  pf paper redlarski --runs 5 --only 20 --json")]
struct RedlarskiArgs {
    /// Runs of each planner
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..))]
    runs: u32,
    /// One object per table row, one a line
    #[arg(long)]
    json: bool,
    /// Write figures and a report into this folder
    #[arg(long, value_name = "DIR")]
    report: Option<PathBuf>,
    /// How many threads a swarm may use; lengths do not depend on it
    #[arg(long, value_name = "N", default_value = "1")]
    threads: NonZeroUsize,
    /// Only the maps whose name contains this
    #[arg(long, value_name = "TEXT", allow_hyphen_values = true)]
    only: Option<String>,
}

pub(crate) fn act(args: &Args, cancel: &CancelToken) -> Result<Status, Failure> {
    let done = match &args.paper {
        Paper::Kim(args) => act_kim(args, cancel),
        Paper::Faustino(args) => act_faustino(args, cancel),
        Paper::Cabc(args) => act_cabc(args, cancel),
        Paper::Wang(args) => act_wang(args, cancel),
        Paper::Redlarski(args) => act_redlarski(args, cancel),
        Paper::RedlarskiTune(args) => act_tune(args, cancel),
    };
    match done {
        Err(Stopped::Paper(PaperError::Interrupted)) => Ok(Status::Interrupted),
        Err(Stopped::Paper(error)) => Err(Failure::Internal(error.to_string())),
        Err(Stopped::Failure(failure)) => Err(failure),
        Ok(()) => Ok(Status::Done),
    }
}

/// Why there is no result.
enum Stopped {
    Paper(PaperError),
    Failure(Failure),
}

impl From<PaperError> for Stopped {
    fn from(error: PaperError) -> Self {
        Self::Paper(error)
    }
}

impl<E: Into<Failure>> From<E> for Stopped {
    fn from(error: E) -> Self {
        Self::Failure(error.into())
    }
}

fn act_kim(args: &KimArgs, cancel: &CancelToken) -> Result<(), Stopped> {
    let published = kim::Published::read()?;
    let options = kim::Options {
        runs: args.runs,
        cancel: cancel.clone(),
    };
    let bar = bar();
    make(args.output.report.as_deref())?;
    let rows = kim::run(&published, &options, &mut |done, all, what| {
        tell(&bar, done, all, what);
    });
    bar.finish_and_clear();
    let rows = rows?;
    let title = "Waypoints by L-BFGS";
    args.output
        .put(title, &rows, || kim::figures(&published, &rows), cancel)
}

fn act_faustino(args: &FaustinoArgs, cancel: &CancelToken) -> Result<(), Stopped> {
    let options = faustino::Options {
        scenes: args.runs,
        cancel: cancel.clone(),
    };
    let bar = bar();
    make(args.output.report.as_deref())?;
    let rows = faustino::run(&options, &mut |done, all, what| {
        tell(&bar, done, all, what);
    });
    bar.finish_and_clear();
    args.output
        .put("Swarms of waypoints", &rows?, faustino::figures, cancel)
}

fn act_cabc(args: &CabcArgs, cancel: &CancelToken) -> Result<(), Stopped> {
    let options = cabc::Options {
        runs: args.runs,
        threads: args.threads,
        cancel: cancel.clone(),
    };
    let bar = bar();
    make(args.output.report.as_deref())?;
    let rows = cabc::run(&options, &mut |done, all, what| {
        tell(&bar, done, all, what);
    });
    bar.finish_and_clear();
    let title = "Bees that walk an unknown map";
    args.output.put(title, &rows?, cabc::figures, cancel)
}

fn act_wang(args: &WangArgs, cancel: &CancelToken) -> Result<(), Stopped> {
    among(args.only.as_deref(), "problem", &wang::names()?)?;
    let options = wang::Options {
        runs: args.runs,
        only: args.only.clone(),
        cancel: cancel.clone(),
    };
    let bar = bar();
    make(args.output.report.as_deref())?;
    let rows = wang::run(&options, &mut |done, all, what| {
        tell(&bar, done, all, what);
    });
    bar.finish_and_clear();
    let rows = rows?;
    let title = "Fronts and teams";
    args.output
        .put(title, &rows, || wang::figures(&rows), cancel)
}

/// Refuses a part that is in no name: who asks for nothing has mistaken something.
fn among(only: Option<&str>, what: &str, names: &[&str]) -> Result<(), Failure> {
    let Some(only) = only.filter(|only| !names.iter().any(|name| name.contains(only))) else {
        return Ok(());
    };
    let failure = Failure::usage(format!("--only: no {what}'s name contains `{only}`"));
    Err(failure.help(there_are(only, what, names)))
}

/// Makes the folder of a report: that it cannot be made is known before minutes of work.
fn make(report: Option<&Path>) -> Result<(), Failure> {
    report.map_or(Ok(()), |folder| {
        make_folder(folder).map_err(|error| Failure::unwritten(&error))
    })
}

/// Nothing is run any more, only drawn and written.
fn drawn(cancel: &CancelToken) -> Result<(), PaperError> {
    if at_once(cancel) {
        return Err(PaperError::Interrupted);
    }
    Ok(())
}

impl Output {
    fn put(
        &self,
        title: &str,
        rows: &[Row],
        figures: impl FnOnce() -> Result<Vec<Figure>, PaperError>,
        cancel: &CancelToken,
    ) -> Result<(), Stopped> {
        drawn(cancel)?;
        if let Some(folder) = &self.report {
            write_report(folder, title, rows, &figures()?)?;
        }
        let mut out = stdout().lock();
        if self.json {
            json(&mut out, rows)?;
        } else {
            write!(out, "{}", tables(rows))?;
        }
        Ok(())
    }
}

fn act_redlarski(args: &RedlarskiArgs, cancel: &CancelToken) -> Result<(), Stopped> {
    let stories = redlarski::stories()?;
    among(args.only.as_deref(), "map", redlarski::MAPS)?;
    let options = redlarski::Options {
        runs: args.runs,
        threads: args.threads.get(),
        only: args.only.clone(),
        cancel: cancel.clone(),
    };
    let bar = bar();
    let published = redlarski::Published::read()?;
    make(args.report.as_deref())?;
    let rows = redlarski::run(&stories, &published, &options, &mut |turn, turns, what| {
        tell(&bar, turn, turns, what);
    });
    bar.finish_and_clear();
    let rows = rows?;
    drawn(cancel)?;
    if let Some(folder) = &args.report {
        redlarski::write_report(folder, &stories, &rows)?;
    }
    let mut out = stdout().lock();
    if args.json {
        json(&mut out, &rows)?;
    } else {
        write!(out, "{}", redlarski::tables(&rows))?;
        writeln!(out, "{}", redlarski::summary(&rows))?;
    }
    Ok(())
}

fn act_tune(args: &TuneArgs, cancel: &CancelToken) -> Result<(), Stopped> {
    let options = tune::TuneOptions {
        sets: args.sets.get(),
        seed: args.seed,
        runs: args.runs,
        threads: args.threads.get(),
        cancel: cancel.clone(),
    };
    let bar = bar();
    let stories = redlarski::stories()?;
    let tuned = tune::tune(&stories, &options, &mut |done, all, what| {
        tell(&bar, done, all, what);
    });
    bar.finish_and_clear();
    let tuned = tuned?;
    let mut out = stdout().lock();
    if args.json {
        json(&mut out, &tuned.checks)?;
    } else {
        write!(out, "{}", tuned.text())?;
    }
    Ok(())
}

fn bar() -> ProgressBar {
    let bar = ProgressBar::new(0);
    if let Ok(style) = ProgressStyle::with_template("{wide_bar} {pos}/{len} {msg}") {
        bar.set_style(style);
    }
    bar
}

fn tell(bar: &ProgressBar, done: usize, all: usize, what: &str) {
    bar.set_length(all as u64);
    bar.set_position(done as u64);
    bar.set_message(what.to_owned());
}

/// One object a line.
fn json(out: &mut impl Write, rows: &[impl Serialize]) -> Result<(), Failure> {
    for row in rows {
        let line = serde_json::to_string(row);
        let line = line.map_err(|error| Failure::Internal(error.to_string()))?;
        writeln!(out, "{line}")?;
    }
    Ok(())
}
