//! `pf bench`: suites of problems and planners.

use crate::{
    failure::{Failure, Status},
    interrupt::at_once,
};
use indicatif::{ProgressBar, ProgressStyle};
use pf_core::CancelToken;
use pf_suite::{Done, Line, Plan, Shard, Suite, SuiteError, folder, report::Report, run};
use std::{
    fmt::Write as _,
    io::{Write, stdout},
    num::NonZeroUsize,
    path::PathBuf,
};

/// Run a suite of problems and planners, or say what can be said of its runs.
///
/// A suite is a TOML file: problems x planners x parameters x seeds, within budgets. What DIR holds
/// already is not run again: after Ctrl-C the same command goes on where it was. Results are the same
/// on any number of threads and in any shards, unless a budget is a time.
#[derive(clap::Args)]
#[command(
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    after_help = "\
Examples:
  pf bench maps/suites/grid-small.toml -o runs
  pf bench maps/suites/teams.toml -o part-2 --shard 2/4 --threads 2
  pf bench merge part-1 part-2 part-3 part-4 -o runs
  pf bench report runs -o report

DIR holds runs.jsonl (a line per run, as they were done) and, once nothing is left to do,
results.jsonl, results.csv (sorted, without times) and times.csv."
)]
pub(crate) struct Args {
    #[command(subcommand)]
    verb: Option<Verb>,
    /// The suite, TOML
    #[arg(required = true, value_name = "SUITE")]
    suite: Option<PathBuf>,
    /// Where results go, and where those are that need not be made again
    #[arg(short, long, required = true, value_name = "DIR")]
    out: Option<PathBuf>,
    /// How many runs are made at a time; only times depend on it
    #[arg(long, value_name = "N", default_value = "1")]
    threads: NonZeroUsize,
    /// Only the i-th of n parts
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// Throw away what DIR holds
    #[arg(long)]
    fresh: bool,
}

#[derive(clap::Subcommand)]
enum Verb {
    /// Put the runs of several folders into one
    Merge(MergeArgs),
    /// Tables, figures and a page of the runs of one or several folders
    Report(ReportArgs),
}

#[derive(clap::Args)]
struct ReportArgs {
    /// Folders of results
    #[arg(required = true, value_name = "DIR")]
    folders: Vec<PathBuf>,
    /// Where report.html, figures (SVG, PNG) and tables (CSV) go
    #[arg(short, long, value_name = "OUT")]
    out: PathBuf,
    /// In figures of effort a path is found if it costs at most so much more than the best known
    #[arg(long, value_name = "SHARE", default_value = "0.05", value_parser = share)]
    target: f64,
}

fn share(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(share) if share >= 0.0 && share.is_finite() => Ok(share),
        _ => Err("a number from 0: 0.05 is 5 %".to_owned()),
    }
}

#[derive(clap::Args)]
struct MergeArgs {
    /// Folders of results
    #[arg(required = true, value_name = "DIR")]
    folders: Vec<PathBuf>,
    /// Where they go
    #[arg(short, long, value_name = "OUT")]
    out: PathBuf,
}

pub(crate) fn act(args: &Args, cancel: &CancelToken) -> Result<Status, Failure> {
    if args.verb.is_some() && at_once(cancel) {
        return Ok(Status::Interrupted);
    }
    match (&args.verb, &args.suite, &args.out) {
        (Some(Verb::Merge(args)), ..) => merge(args),
        (Some(Verb::Report(args)), ..) => report(args),
        (None, Some(suite), Some(out)) => bench(args, suite, out, cancel),
        _ => Err(Failure::usage("which suite, and where to: SUITE -o DIR")),
    }
}

fn bench(
    args: &Args,
    file: &std::path::Path,
    out: &std::path::Path,
    cancel: &CancelToken,
) -> Result<Status, Failure> {
    let suite = Suite::read(file)?;
    let plan = Plan {
        threads: args.threads,
        shard: args.shard.unwrap_or_default(),
        afresh: args.fresh,
        cancel: cancel.clone(),
    };
    let bar = bar();
    let done = run(&suite, out, &plan, &mut |done, asked, line| {
        tell(&bar, done, asked, line);
    });
    bar.finish_and_clear();
    let done = done.map_err(|error| {
        let strange = matches!(error, SuiteError::Strange { .. });
        let failure = failure(error);
        if strange {
            let out = out.display();
            return failure.help(format!(
                "another -o, or --fresh to throw away what {out} holds"
            ));
        }
        failure
    })?;
    let mut text = stdout().lock();
    writeln!(text, "{}", words(&suite, &done, out))?;
    Ok(match done {
        Done { .. } if !done.is_complete() => Status::Interrupted,
        Done { panicked: 1.., .. } | Done { failed: 1.., .. } | Done { refused: 1.., .. } => {
            Status::CheckFailed
        }
        _ => Status::Done,
    })
}

fn words(suite: &Suite, done: &Done, out: &std::path::Path) -> String {
    let mut words = format!("{}: {} runs", suite.name, done.asked);
    for (count, what) in [
        (done.before, "were there already"),
        (done.panicked, "panicked"),
        (done.failed, "failed in another program"),
        (done.refused, "did not pass the judge"),
        (done.declined, "were declined"),
    ] {
        if count > 0 {
            // Writing to a string does not fail.
            let _ = write!(words, ", {count} {what}");
        }
    }
    let out = out.display();
    if done.is_complete() {
        words + &format!("; results are in {out}/")
    } else {
        let there = done.before + done.made;
        words + &format!("; interrupted, {there} are in {out}/, and the same command goes on")
    }
}

fn merge(args: &MergeArgs) -> Result<Status, Failure> {
    let lines = gather(&args.folders)?;
    let place = |path: &PathBuf| path.canonicalize().ok();
    let among = args
        .folders
        .iter()
        .any(|path| place(path) == place(&args.out));
    if folder::holds_runs(&args.out) && !among {
        let message = format!("{} holds runs that are not merged", args.out.display());
        let help = "name it among the folders, too, or write to another one";
        return Err(Failure::usage(message).help(help));
    }
    folder::write(&args.out, &lines).map_err(failure)?;
    let (runs, out) = (lines.len(), args.out.display());
    writeln!(stdout().lock(), "{runs} runs are in {out}/")?;
    Ok(Status::Done)
}

fn report(args: &ReportArgs) -> Result<Status, Failure> {
    let lines = gather(&args.folders)?;
    if lines.is_empty() {
        return Err(Failure::usage("there are no runs to report on"));
    }
    let report = Report::of(&lines, args.target).map_err(failure)?;
    report.write(&args.out).map_err(failure)?;
    let mut out = stdout().lock();
    writeln!(out, "{}", report.text())?;
    writeln!(
        out,
        "The page, figures and tables are in {}/",
        args.out.display()
    )?;
    Ok(Status::Done)
}

/// The runs of all folders, as one.
fn gather(folders: &[PathBuf]) -> Result<Vec<Line>, Failure> {
    let mut lines = Vec::new();
    for path in folders {
        let read = folder::read(path);
        lines.append(&mut read.map_err(|error| match error {
            // What the system would not read is a bad input.
            SuiteError::File(error) => error.into(),
            other => failure(other),
        })?);
    }
    folder::merged(lines).map_err(failure)
}

fn failure(error: SuiteError) -> Failure {
    match error {
        SuiteError::File(error) if error.found_and_expected().is_some() => error.into(),
        SuiteError::File(error) => Failure::unwritten(&error),
        SuiteError::Strange { .. } | SuiteError::InUse(_) | SuiteError::Differ { .. } => {
            Failure::usage(error.to_string())
        }
        other => Failure::Internal(other.to_string()),
    }
}

/// Progress and an estimate, where someone watches.
fn bar() -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} runs, {eta} left  {wide_msg}");
    let bar = ProgressBar::new(0);
    style.map_or(bar.clone(), |style| bar.with_style(style))
}

fn tell(bar: &ProgressBar, done: usize, asked: usize, line: Option<&Line>) {
    bar.set_length(asked as u64);
    let Some(line) = line else {
        // What was there before took no time now.
        bar.set_position(done as u64);
        bar.reset_eta();
        return;
    };
    let record = &line.record;
    bar.set_position(done as u64);
    bar.set_message(format!("{} on {}", record.contender(), record.problem));
    if matches!(record.outcome.as_str(), "panicked" | "failed" | "refused") {
        let (who, seed, note) = (record.contender(), record.seed, record.notes.join("; "));
        bar.suspend(|| {
            let _ = writeln!(
                anstream::stderr(),
                "{who} on {}, seed {seed}: {} ({note})",
                record.problem,
                record.outcome
            );
        });
    }
}
