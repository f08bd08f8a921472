//! The paper on dynamic pathfinding for uncrewed vehicles by a constrained artificial bee colony: walks
//! on two maps, by weights and by inner cycles.
//!
//! Its tables with the number of runs it has and with more; whether the judge takes what it counts;
//! and what a memory does for the same bees, on its maps and on made-up ones with traps.

mod data;
mod figures;
mod traps;
pub mod tune;
mod walk;

pub use data::{FOUND, Printed, Table, maps, tables};
pub use figures::figures;
pub use walk::{Tally, Trip, walk};

use crate::{
    PaperError,
    parallel::spread,
    row::{Numbers, Row},
    statistics::wilson,
};
use pf_abc::{AbcParams, Check, F2};
use pf_core::CancelToken;
use pf_geom::WorldProblem;
use std::{num::NonZeroUsize, sync::Arc};

/// What to run.
#[derive(Clone, Debug)]
pub struct Options {
    /// Runs of each case, besides the paper's 20 or 30.
    pub runs: u32,
    /// How many threads; only times depend on it.
    pub threads: NonZeroUsize,
    /// Stops it.
    pub cancel: CancelToken,
}

/// Walks of one kind: worlds, and so many seeds in each.
struct Task {
    table: &'static str,
    case: String,
    variant: String,
    params: AbcParams,
    problems: Arc<[WorldProblem]>,
    seeds: u32,
    /// What the paper prints, if it is its own.
    printed: Option<Printed>,
}

/// What a task came to: in all, and in the first runs, as many as the paper has.
struct Done {
    all: Tally,
    few: Tally,
}

/// Runs everything.
///
/// # Errors
/// [`PaperError::Interrupted`] if somebody asked to stop.
pub fn run(
    options: &Options,
    tell: &mut dyn FnMut(usize, usize, &str),
) -> Result<Vec<Row>, PaperError> {
    let mut tasks = published(options.runs)?;
    tasks.extend(readings(options.runs)?);
    tasks.extend(traps::tasks(options.runs)?);
    let mut done: Vec<Option<Result<Done, PaperError>>> = Vec::new();
    done.resize_with(tasks.len(), || None);
    let mut count = 0;
    let cancel = &options.cancel;
    spread(
        options.threads,
        tasks.len(),
        |k| tasks[k].work(cancel),
        |k, result| {
            count += 1;
            tell(count, tasks.len(), tasks[k].table);
            done[k] = Some(result);
            !cancel.is_cancelled()
        },
    );
    let mut rows = Vec::new();
    for (task, result) in tasks.iter().zip(done) {
        rows.push(task.row(&result.unwrap_or(Err(PaperError::Interrupted))?));
    }
    Ok(rows)
}

/// How the check of a step is called.
fn checks() -> [(&'static str, Check); 2] {
    [
        ("point checked", Check::Point),
        ("segment checked", Check::Segment),
    ]
}

fn published(runs: u32) -> Result<Vec<Task>, PaperError> {
    let maps = maps()?.map(|map| Arc::from([map]));
    let mut tasks = Vec::new();
    for table in tables()? {
        for printed in table.rows {
            let [w1, w2, w3] = printed.weights;
            for (variant, check) in checks() {
                tasks.push(Task {
                    table: table.name,
                    case: if table.name.contains("inner") {
                        format!("I = {}", printed.cycles)
                    } else {
                        format!("{w1}, {w2}, {w3}")
                    },
                    variant: variant.to_owned(),
                    params: AbcParams {
                        check,
                        cycles: printed.cycles,
                        ..AbcParams::paper().weighing(printed.weights)
                    },
                    problems: Arc::clone(&maps[table.map]),
                    seeds: runs.max(printed.of),
                    printed: Some(printed.clone()),
                });
            }
        }
    }
    Ok(tasks)
}

/// Both readings of f2, at the weights of which the paper says that it helps.
fn readings(runs: u32) -> Result<Vec<Task>, PaperError> {
    let maps = maps()?.map(|map| Arc::from([map]));
    let mut tasks = Vec::new();
    for (map, weights) in [
        (0, [0.9, 0.0, 0.03]),
        (0, [0.9, 0.3, 0.03]),
        (1, [0.8, 0.0, 0.03]),
        (1, [0.8, 0.1, 0.03]),
    ] {
        for f2 in [F2::PushBack, F2::PaperPlus] {
            let [w1, w2, w3] = weights;
            if w2 > 0.0 || f2 == F2::PushBack {
                tasks.push(Task {
                    table: "two readings of f2",
                    case: format!("map {}: {w1}, {w2}, {w3}", map + 1),
                    variant: if w2 > 0.0 {
                        f2.to_string()
                    } else {
                        "without".into()
                    },
                    params: AbcParams {
                        f2,
                        ..AbcParams::paper().weighing(weights)
                    },
                    problems: Arc::clone(&maps[map]),
                    seeds: runs,
                    printed: None,
                });
            }
        }
    }
    Ok(tasks)
}

impl Task {
    fn work(&self, cancel: &CancelToken) -> Result<Done, PaperError> {
        let few = self.printed.as_ref().map_or(0, |printed| printed.of);
        let mut done = Done {
            all: Tally::default(),
            few: Tally::default(),
        };
        for problem in self.problems.iter() {
            for seed in 0..self.seeds {
                if cancel.is_cancelled() {
                    return Err(PaperError::Interrupted);
                }
                let trip = walk(problem, &self.params, seed.into())?;
                done.all.count(problem, &trip);
                if seed < few {
                    done.few.count(problem, &trip);
                }
            }
        }
        Ok(done)
    }

    fn row(&self, done: &Done) -> Row {
        let all = &done.all;
        let [low, high] = wilson(all.target, all.runs);
        let length = all.length();
        let mut measured = Numbers::default()
            .with("arrived", f64::from(all.target) / f64::from(all.runs))
            .with("from", low)
            .with("to", high)
            .with("judge takes", f64::from(all.legal) / f64::from(all.runs))
            .with("avgP", length.map(|l| l[0]))
            .with("stdP", length.map(|l| l[1]))
            .with("avgT", all.seconds / f64::from(all.runs))
            .with("most steps", all.most_steps)
            .with("runs", all.runs);
        if done.few.runs > 0 {
            let target = format!("{}/{}", done.few.target, done.few.runs);
            measured = measured.with("target", target);
        }
        let reproduced = self.printed.as_ref().map(|printed| {
            let [from, to] = wilson(printed.target, printed.of);
            let near = match (printed.length, length) {
                (Some(theirs), Some([ours, _])) => (ours / theirs - 1.0).abs() <= 0.25,
                _ => true,
            };
            from <= high && low <= to && near
        });
        Row {
            paper: "cabc",
            table: self.table,
            case: self.case.clone(),
            planner: "abc",
            variant: self.variant.clone(),
            published: self
                .printed
                .as_ref()
                .map_or_else(Numbers::default, |printed| printed.numbers.clone()),
            measured,
            reproduced,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rate(map: usize, weights: [f64; 3], check: Check, seeds: u32) -> u32 {
        let params = AbcParams {
            check,
            ..AbcParams::paper().weighing(weights)
        };
        let problem = &maps().unwrap()[map];
        let trips = (0..seeds).map(|seed| walk(problem, &params, seed.into()).unwrap());
        u32::try_from(trips.filter(|trip| trip.arrived).count()).unwrap()
    }

    #[test]
    fn the_paper_s_rules_do_what_the_paper_says() {
        for (_, check) in checks() {
            assert_eq!(rate(1, [1.0, 0.0, 0.0], check, 20), 0);
            assert!(rate(0, [0.9, 0.0, 0.1], check, 20) <= 5);
        }
        for map in [0, 1] {
            let arrived = rate(map, [0.7, 0.0, 0.03], Check::Point, 20);
            assert!(arrived >= 12, "map {}: {arrived}", map + 1);
        }
    }
}
