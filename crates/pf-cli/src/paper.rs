//! `pf paper`: the experiments of papers.

use crate::failure::{Failure, Status};
use indicatif::{ProgressBar, ProgressStyle};
use pf_core::CancelToken;
use pf_papers::{PaperError, redlarski};
use std::{
    io::{Write, stdout},
    num::NonZeroUsize,
    path::PathBuf,
};

/// Run the experiment of a paper again, and print its numbers beside ours
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(subcommand)]
    paper: Paper,
}

#[derive(clap::Subcommand)]
enum Paper {
    /// Rivers and ants on nine grids: five tables
    Redlarski(RedlarskiArgs),
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
    #[arg(long, value_name = "TEXT")]
    only: Option<String>,
}

pub(crate) fn act(args: &Args, cancel: &CancelToken) -> Result<Status, Failure> {
    let done = match &args.paper {
        Paper::Redlarski(args) => act_redlarski(args, cancel),
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

fn act_redlarski(args: &RedlarskiArgs, cancel: &CancelToken) -> Result<(), Stopped> {
    let stories = redlarski::stories()?;
    let known = |only: &String| {
        stories
            .iter()
            .any(|story| story.map.contains(only.as_str()))
    };
    if let Some(only) = args.only.as_ref().filter(|only| !known(only)) {
        let maps = redlarski::MAPS.join(", ");
        let failure = Failure::usage(format!("--only: no map's name contains `{only}`"));
        return Err(failure.help(format!("the maps are {maps}")).into());
    }
    let options = redlarski::Options {
        runs: args.runs,
        threads: args.threads.get(),
        only: args.only.clone(),
        cancel: cancel.clone(),
    };
    let bar = ProgressBar::new(0);
    if let Ok(style) = ProgressStyle::with_template("{wide_bar} {pos}/{len} {msg}") {
        bar.set_style(style);
    }
    let published = redlarski::Published::read()?;
    let rows = redlarski::run(&stories, &published, &options, &mut |turn, turns, what| {
        bar.set_length(turns as u64);
        bar.set_position(turn as u64);
        bar.set_message(what.to_owned());
    });
    bar.finish_and_clear();
    let rows = rows?;
    if let Some(folder) = &args.report {
        redlarski::write_report(folder, &stories, &rows)?;
    }
    let mut out = stdout().lock();
    if args.json {
        for row in &rows {
            let line = serde_json::to_string(row);
            let line = line.map_err(|error| Failure::Internal(error.to_string()))?;
            writeln!(out, "{line}")?;
        }
    } else {
        write!(out, "{}", redlarski::tables(&rows))?;
        writeln!(out, "{}", redlarski::summary(&rows))?;
    }
    Ok(())
}
