//! Options that several verbs share.

use crate::{failure::Failure, spot::Spot};
use clap::Args;
use pf_core::{Budget, CancelToken, InvalidParams};
use pf_grid::Moves;
use pf_io::Unknown;
use pf_planners::{AnyEntry, Order, Runner, find};
use pf_render::Recorder;
use std::{num::NonZeroUsize, time::Duration};

/// Which planner, and within what.
#[derive(Args, Debug, Default)]
#[command(next_help_heading = "Planner")]
pub(crate) struct PlannerArgs {
    /// Which planner; `pf planners` lists them
    #[arg(long, value_name = "NAME")]
    pub(crate) planner: Option<String>,
    /// Set a parameter of the planner; may be given again
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = setting)]
    pub(crate) settings: Vec<(String, String)>,
    /// Seed of all chance
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) seed: u64,
    /// Stop after this time: 50ms, 2s, 1m
    #[arg(long, value_name = "DURATION", value_parser = humantime::parse_duration)]
    pub(crate) time: Option<Duration>,
    /// Stop after so many iterations
    #[arg(long, value_name = "N")]
    pub(crate) iterations: Option<u64>,
    /// How many threads a planner may use; results do not depend on it
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<NonZeroUsize>,
}

impl PlannerArgs {
    /// The entry asked for.
    pub(crate) fn entry(&self, default: &str) -> Result<&'static dyn AnyEntry, Failure> {
        find(self.planner.as_deref().unwrap_or(default)).map_err(|error| {
            let failure = Failure::usage(error.to_string());
            if error.known().is_empty() {
                return failure;
            }
            failure.help(format!("the planners are {}", error.known().join(", ")))
        })
    }

    /// A planner as asked for, with these settings besides.
    pub(crate) fn runner(
        &self,
        entry: &dyn AnyEntry,
        more: &[(&str, &str)],
    ) -> Result<Box<dyn Runner>, Failure> {
        let mut settings = self.settings.clone();
        let takes_threads = entry.parameters().iter().any(|key| key.name == "threads");
        if let Some(threads) = self.threads.filter(|_| takes_threads) {
            settings.push(("threads".to_owned(), threads.to_string()));
        }
        settings.extend(more.iter().map(|(k, v)| ((*k).to_owned(), (*v).to_owned())));
        entry.runner(&settings).map_err(|error| {
            let failure = Failure::usage(format!("--set: {error}"));
            match error {
                InvalidParams::UnknownKey { .. } => {
                    let key = entry.key();
                    failure.help(format!("`pf planners` explains the parameters of {key}"))
                }
                _ => failure,
            }
        })
    }

    /// The seed and the budget asked for.
    pub(crate) fn order<'a>(
        &self,
        cancel: &CancelToken,
        recorder: Option<&'a mut Recorder>,
    ) -> Order<'a> {
        let mut budget = Budget::unlimited().cancel(cancel);
        if let Some(time) = self.time {
            budget = budget.time(time);
        }
        if let Some(iterations) = self.iterations {
            budget = budget.iterations(iterations);
        }
        Order {
            seed: self.seed,
            budget,
            recorder,
        }
    }
}

/// The question, where the file does not say it or says it otherwise.
#[derive(Args, Clone, Debug, Default)]
#[command(next_help_heading = "Question")]
pub(crate) struct QuestionArgs {
    /// Where from: on a grid column and row, from 0, rows down; in a world a point, y up
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    pub(crate) from: Option<Spot>,
    /// Where to
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    pub(crate) to: Option<Spot>,
    /// The robot's radius, in cells or in the world's unit
    #[arg(long, value_name = "R", value_parser = distance, allow_negative_numbers = true)]
    pub(crate) radius: Option<f64>,
    /// How far the robot is to stay away from obstacles
    #[arg(long, value_name = "C", value_parser = distance, allow_negative_numbers = true)]
    pub(crate) clearance: Option<f64>,
    /// For a planner on grids, cut a world into cells with sides of this length; else half the
    /// robot's radius, or what gives some ten thousand cells
    #[arg(long, value_name = "SIDE", value_parser = side, allow_negative_numbers = true)]
    pub(crate) cell: Option<f64>,
    /// Which steps are allowed: orthogonal, always, one-corner, no-corner-cutting
    #[arg(long, value_name = "RULE")]
    pub(crate) moves: Option<Moves>,
    /// What unknown cells of a ROS map count as: free, blocked
    #[arg(long, value_name = "WHAT", value_parser = unknown)]
    pub(crate) unknown: Option<Unknown>,
    /// Only this case of a scenario, or this robot of a world
    #[arg(long, value_name = "NAME")]
    pub(crate) case: Option<String>,
}

fn setting(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((key, value)) if !key.is_empty() => Ok((key.to_owned(), value.to_owned())),
        _ => Err("a setting is written key=value".to_owned()),
    }
}

fn distance(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(distance) if distance >= 0.0 && distance.is_finite() => Ok(distance),
        _ => Err("a radius or clearance is a number from 0".to_owned()),
    }
}

fn side(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(side) if side > 0.0 && side.is_finite() => Ok(side),
        _ => Err("the side of a cell is a positive number".to_owned()),
    }
}

fn unknown(text: &str) -> Result<Unknown, String> {
    match text {
        "free" => Ok(Unknown::Free),
        "blocked" => Ok(Unknown::Blocked),
        _ => Err("expected free or blocked".to_owned()),
    }
}
