//! `pf tune`: the inverse problem of the bees' paper.

use crate::{
    args::QuestionArgs,
    failure::{Failure, Status},
    question, report,
};
use indicatif::{ProgressBar, ProgressStyle};
use pf_abc::AbcParams;
use pf_core::{CancelToken, Params};
use pf_papers::{
    PaperError,
    cabc::tune::{Found, Search, text},
};
use pf_planners::Scene;
use serde::Serialize;
use std::{
    io::{Write, stdout},
    num::NonZeroUsize,
    path::PathBuf,
    str::FromStr,
};

/// Search the weights by which bees walk short ways that arrive.
///
/// What is sought is the least avgP / (arrivals + 1) over a grid of weights, of the distance to the goal
/// (w1), of obstacles near (w2) and of turns (w3): by brute force as in the paper, and beside it by a
/// race that gives up the worse points early. Both winners walk again by fresh seeds, for a score by
/// the seeds a point was chosen by is too good. Nothing depends on the number of threads.
///
/// With --file everything that has been run is kept there, at least once a second; after Ctrl-C the same
/// command goes on from it.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  pf tune maps/worlds/cabc-1.toml --threads 2 --file tune-1.json
  pf tune maps/worlds/cabc-2.toml --w1 0.7,0.73,0.8 --w2 0:0.2:0.05 --w3 0.03
  pf tune maps/worlds/cabc-2.toml --set check=segment --set half=3 --runs 10")]
pub(crate) struct Args {
    /// A world, or a scenario in one; where it stands in the beginning
    world: PathBuf,
    #[command(flatten)]
    question: QuestionArgs,
    /// Set a parameter of the bees, those of the paper with 3 inner cycles; may be given again
    #[arg(long = "set", value_name = "KEY=VALUE", help_heading = "Search", value_parser = setting)]
    settings: Vec<(String, String)>,
    /// Values of w1: a list, or from:to:step
    #[arg(
        long,
        value_name = "VALUES",
        help_heading = "Search",
        default_value = "0.5:1.2:0.1"
    )]
    w1: Values,
    /// Values of w2
    #[arg(
        long,
        value_name = "VALUES",
        help_heading = "Search",
        default_value = "0,0.05,0.1,0.2,0.3"
    )]
    w2: Values,
    /// Values of w3
    #[arg(
        long,
        value_name = "VALUES",
        help_heading = "Search",
        default_value = "0,0.01,0.03,0.05,0.1"
    )]
    w3: Values,
    /// Runs of each point
    #[arg(long, value_name = "N", help_heading = "Search", default_value_t = 30, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    runs: u32,
    /// Runs of the winners by fresh seeds
    #[arg(long, value_name = "N", help_heading = "Search", default_value_t = 200, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    fresh: u32,
    /// How many threads
    #[arg(long, value_name = "N", help_heading = "Search", default_value = "1")]
    threads: NonZeroUsize,
    /// Keep what has been run in this file, and go on from it
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    file: Option<PathBuf>,
    /// One JSON object
    #[arg(long, help_heading = "Output")]
    json: bool,
}

/// The most points a grid may have.
const MOST: usize = 1_000_000;

/// Values of a weight.
#[derive(Clone, Debug, PartialEq)]
struct Values(Vec<f64>);

impl FromStr for Values {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |text: &str| match text.trim().parse::<f64>() {
            Ok(value) if value >= 0.0 && value.is_finite() => Ok(value),
            _ => Err(format!("`{text}` is not a number from 0")),
        };
        let Some((from, rest)) = text.split_once(':') else {
            let values: Result<_, _> = text.split(',').map(number).collect();
            return values.map(Self);
        };
        let Some((to, step)) = rest.split_once(':') else {
            return Err("a range is written from:to:step".to_owned());
        };
        let (from, to, step) = (number(from)?, number(to)?, number(step)?);
        let mut values = Vec::new();
        for k in 0u32.. {
            // As it would be written, not as sums come out.
            let value = ((from + f64::from(k) * step) * 1e9).round() / 1e9;
            if value > to + step * 1e-6 {
                break;
            }
            values.push(value);
            if values.len() > 10_000 {
                return Err(format!("`{text}` has more than 10000 values"));
            }
        }
        if values.is_empty() {
            return Err(format!("`{text}` has no value"));
        }
        Ok(Self(values))
    }
}

fn setting(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((key, value)) if !key.is_empty() => Ok((key.to_owned(), value.to_owned())),
        _ => Err("a setting is written key=value".to_owned()),
    }
}

/// The object that `--json` prints.
#[derive(Serialize)]
struct Json<'a> {
    world: &'a str,
    runs: u32,
    #[serde(flatten)]
    found: &'a Found,
}

pub(crate) fn act(args: &Args, cancel: &CancelToken) -> Result<Status, Failure> {
    let search = search(args, cancel)?;
    let points: usize = search.grid.iter().map(Vec::len).product();
    if points > MOST {
        let message = format!("the grid has {points} points, more than {MOST}");
        return Err(Failure::usage(message).help("shorter lists for --w1, --w2 and --w3"));
    }
    let bar = ProgressBar::new(0);
    let template = "{wide_bar} {pos}/{len} runs, {eta} left; {msg}";
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    let mut stage = String::new();
    let found = search.run(&mut |done, all, what| {
        if stage != what {
            what.clone_into(&mut stage);
            bar.reset();
            bar.set_length(all);
            bar.set_message(stage.clone());
        }
        bar.set_position(done);
    });
    bar.finish_and_clear();
    let found = match found {
        Ok(found) => found,
        Err(PaperError::Interrupted) => return Ok(Status::Interrupted),
        Err(PaperError::Data(message)) => return Err(Failure::usage(message)),
        Err(PaperError::File(error)) => return Err(Failure::unwritten(&error)),
        Err(error) => return Err(Failure::Internal(error.to_string())),
    };
    let mut out = stdout().lock();
    if args.json {
        let (world, runs) = (search.world.as_str(), search.runs);
        let json = Json {
            world,
            runs,
            found: &found,
        };
        report::line(&mut out, &json)?;
    } else {
        write!(out, "{}", text(&found, search.runs))?;
    }
    Ok(Status::Done)
}

fn search(args: &Args, cancel: &CancelToken) -> Result<Search, Failure> {
    let question = question::one(&args.world, &args.question)?;
    let Scene::World(scene) = &question.scene else {
        return Err(question::no_world(&args.world));
    };
    let mut params = AbcParams {
        cycles: 3,
        ..AbcParams::paper()
    };
    for (key, value) in &args.settings {
        let set = params.set(key, value);
        set.map_err(|error| Failure::usage(format!("--set: {error}")))?;
        if ["w1", "w2", "w3"].contains(&key.as_str()) {
            let message = format!("--set: {key} is what is sought");
            return Err(Failure::usage(message).help(format!("--{key} says where")));
        }
    }
    pf_abc::Abc::new(params.clone()).map_err(|error| Failure::usage(format!("--set: {error}")))?;
    Ok(Search {
        world: question.file.clone(),
        problem: scene.problem().clone(),
        params,
        grid: [&args.w1, &args.w2, &args.w3].map(|values| values.0.clone()),
        runs: args.runs,
        fresh: args.fresh,
        threads: args.threads,
        file: args.file.clone(),
        cancel: cancel.clone(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_lists_or_ranges() {
        let read = |text: &str| text.parse::<Values>().map(|values| values.0);
        assert_eq!(read("0.5:0.8:0.1"), Ok(vec![0.5, 0.6, 0.7, 0.8]));
        assert_eq!(read("1, 0"), Ok(vec![1.0, 0.0]));
        for bad in [
            "", "a", "-1", "1:2", "2:1:0.1", "0:1:0", "0:1e9:1", "nan", "1:2:inf",
        ] {
            assert!(read(bad).is_err() || read(bad) == Ok(vec![1.0]), "{bad}");
        }
    }
}
