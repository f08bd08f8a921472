//! The runs, and the rows that come of them.

use super::{
    cases::{MAPS, Printed, Published, Story},
    contenders::{CONTENDERS, Contender, Live},
};
use crate::{
    PaperError,
    statistics::{Spread, wilson},
};
use pf_core::{Budget, CancelToken, Clock, Context, Problem, Report};
use pf_grid::{GridCost, GridProblem};
use serde::Serialize;
use std::time::Duration;

/// How the experiment is run.
#[derive(Clone, Debug)]
pub struct Options {
    /// Runs of each planner, seeded 0, 1, 2…
    pub runs: u32,
    /// Threads a swarm may use; no result but the times depends on it.
    pub threads: usize,
    /// Only the maps whose name contains this.
    pub only: Option<String>,
    /// Stops the experiment.
    pub cancel: CancelToken,
}

impl Default for Options {
    /// Twenty runs on one thread.
    fn default() -> Self {
        Self {
            runs: 20,
            threads: 1,
            only: None,
            cancel: CancelToken::default(),
        }
    }
}

/// What one planner did in one case, beside what the paper prints of it.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// `redlarski`.
    pub paper: &'static str,
    /// The paper's table, 1 to 5.
    pub table: usize,
    /// The map.
    pub case: &'static str,
    /// The planner, by its `--planner` name.
    pub planner: &'static str,
    /// The set of parameters.
    pub variant: &'static str,
    /// What the paper prints.
    pub published: Said,
    /// What was measured.
    pub measured: Measured,
    /// Whether the paper's length was reproduced; none where it prints nothing of the kind.
    pub reproduced: Option<bool>,
}

/// What the paper prints.
#[derive(Clone, Debug, Serialize)]
pub struct Said {
    /// The length; none if it prints `n/a` or nothing.
    pub length: Option<f64>,
    /// `length`, `optimal` (by the text), `not found` (n/a) or `nothing`.
    pub says: &'static str,
    /// The time in microseconds.
    pub time_us: Option<f64>,
    /// Its time by that of its own A*.
    pub ratio: Option<f64>,
}

/// What was measured.
#[derive(Clone, Debug, Serialize)]
pub struct Measured {
    /// Runs.
    pub runs: u32,
    /// In how many a path was found.
    pub found: u32,
    /// In how many it was a shortest one.
    pub optimal: u32,
    /// The share of runs with a path, and its Wilson interval at 95 %.
    pub found_rate: f64,
    /// The same of paths that are shortest.
    pub optimal_rate: f64,
    /// Wilson interval of `found_rate`.
    pub found_interval: [f64; 2],
    /// Wilson interval of `optimal_rate`.
    pub optimal_interval: [f64; 2],
    /// The length of a shortest path.
    pub shortest: f64,
    /// The mean length of those found.
    pub length: Option<f64>,
    /// Lengths of those found.
    pub lengths: Option<Spread>,
    /// Of each run with a walk that arrived, the least length of one with its loops; swarms alone.
    pub walk_lengths: Vec<f64>,
    /// The mean time to the answer, in microseconds: of planning in Table 1, of replanning in the
    /// others.
    pub time_us: f64,
    /// Times to the answer.
    pub times_us: Option<Spread>,
    /// What `settle` took after the answer.
    pub upkeep_us: Option<Spread>,
    /// Median of the time by that of A* in the same run.
    pub ratio: Option<f64>,
}

/// One answer.
#[derive(Clone, Debug)]
struct Run {
    cost: Option<GridCost>,
    walk: Option<f64>,
    micros: f64,
    upkeep: f64,
}

/// Runs the experiment; `progress` is told before each planner's turn on a map, with how many turns
/// there are.
///
/// # Errors
/// [`PaperError`] if what the program carries is broken, or somebody asked to stop.
pub fn run(
    stories: &[Story],
    published: &Published,
    options: &Options,
    progress: &mut dyn FnMut(usize, usize, &str),
) -> Result<Vec<Row>, PaperError> {
    let wanted = |story: &&Story| {
        options
            .only
            .as_ref()
            .is_none_or(|only| story.map.contains(only.as_str()))
    };
    let stories: Vec<_> = stories.iter().filter(wanted).collect();
    let turns = stories.len() * CONTENDERS.len();
    let mut rows = Vec::new();
    for (s, story) in stories.iter().enumerate() {
        let mut turn = s * CONTENDERS.len();
        let mut play = |contender: &Contender| {
            progress(
                turn,
                turns,
                &format!("{} {} {}", story.map, contender.planner, contender.variant),
            );
            turn += 1;
            play(story, contender, options)
        };
        let played: Vec<_> = CONTENDERS.iter().map(&mut play).collect::<Result<_, _>>()?;
        let yardstick = CONTENDERS
            .iter()
            .position(|c| c.planner == "astar")
            .unwrap_or(0);
        for (contender, runs) in CONTENDERS.iter().zip(&played) {
            for table in 1..=5 {
                let (_, shortest) = story.table(table);
                let measured = measured(&runs[table - 1], &played[yardstick][table - 1], shortest);
                let said = said(published, contender, table, story.map);
                let reproduced = reproduced(published, contender, table, story.map, &measured);
                rows.push(Row {
                    paper: "redlarski",
                    table,
                    case: story.map,
                    planner: contender.planner,
                    variant: contender.variant,
                    published: said,
                    measured,
                    reproduced,
                });
            }
        }
    }
    let place = |name: &str| MAPS.iter().position(|map| *map == name);
    rows.sort_by_key(|row| (row.table, place(row.case)));
    Ok(rows)
}

/// All runs of one planner on one map, by table.
fn play(
    story: &Story,
    contender: &Contender,
    options: &Options,
) -> Result<[Vec<Run>; 5], PaperError> {
    let mut tables: [Vec<Run>; 5] = std::array::from_fn(|_| Vec::new());
    // The first call of all works out what all later ones share.
    let brief = Budget::unlimited().iterations(1);
    let _ = (contender.make)(1).plan(&story.first.0, &mut Context::seeded(0).within(brief));
    for seed in 0..u64::from(options.runs) {
        let context = |table: u64| {
            let budget = Budget::unlimited().cancel(&options.cancel);
            Context::seeded(10 * seed + table).within(budget)
        };
        let mut planner = (contender.make)(options.threads);
        let problem = &story.first.0;
        tables[0].push(timed(&mut *planner, problem, context(1), |planner, cx| {
            planner.plan(problem, cx).ok()
        }));
        for (table, (changes, _, _)) in (2..).zip(&story.then) {
            let mut planner = planner.twin();
            let mut problem = problem.clone();
            let revision = problem.revise(changes);
            let revision = revision.map_err(|error| PaperError::Data(error.to_string()))?;
            let run = timed(
                &mut *planner,
                revision.problem(),
                context(table),
                |planner, cx| planner.replan(&revision, cx).ok(),
            );
            let at = usize::try_from(table).unwrap_or(1) - 1;
            tables[at].push(run);
        }
        if options.cancel.is_cancelled() {
            return Err(PaperError::Interrupted);
        }
    }
    Ok(tables)
}

fn timed(
    planner: &mut dyn Live,
    problem: &GridProblem,
    mut cx: Context<'_, GridProblem>,
    ask: impl FnOnce(&mut dyn Live, &mut Context<'_, GridProblem>) -> Option<Report<GridProblem>>,
) -> Run {
    let clock = Clock::default();
    let micros = |time: Duration| time.as_secs_f64() * 1e6;
    let began = clock.now();
    let report = ask(planner, &mut cx);
    let answered = clock.now();
    planner.settle(problem, &mut Context::seeded(0));
    let settled = clock.now();
    let solved = report.as_ref().and_then(|report| report.outcome.solved());
    let walk = report.as_ref().and_then(|report| report.note("walk"));
    Run {
        cost: solved.map(|solved| solved.cost),
        walk: walk.and_then(|walk| walk.parse().ok()),
        micros: micros(answered.saturating_sub(began)),
        upkeep: micros(settled.saturating_sub(answered)),
    }
}

fn measured(runs: &[Run], yardstick: &[Run], shortest: GridCost) -> Measured {
    let count = |fine: &dyn Fn(&Run) -> bool| {
        u32::try_from(runs.iter().filter(|run| fine(run)).count()).unwrap_or(u32::MAX)
    };
    let all = count(&|_| true);
    let found = count(&|run| run.cost.is_some());
    let optimal = count(&|run| run.cost == Some(shortest));
    let lengths = Spread::of(runs.iter().filter_map(|run| run.cost).map(GridCost::value));
    let times = Spread::of(runs.iter().map(|run| run.micros));
    let ratios = runs
        .iter()
        .zip(yardstick)
        .map(|(run, a_star)| run.micros / a_star.micros);
    let share = |hits: u32| f64::from(hits) / f64::from(all.max(1));
    Measured {
        runs: all,
        found,
        optimal,
        found_rate: share(found),
        optimal_rate: share(optimal),
        found_interval: wilson(found, all),
        optimal_interval: wilson(optimal, all),
        shortest: shortest.value(),
        length: lengths.map(|lengths| lengths.mean),
        lengths,
        walk_lengths: runs.iter().filter_map(|run| run.walk).collect(),
        time_us: times.map_or(f64::NAN, |times| times.mean),
        times_us: times,
        upkeep_us: Spread::of(runs.iter().map(|run| run.upkeep)),
        ratio: Spread::of(ratios).map(|ratios| ratios.median),
    }
}

fn said(published: &Published, contender: &Contender, table: usize, map: &str) -> Said {
    let Some(name) = contender.published_as else {
        return Said {
            length: None,
            says: "nothing",
            time_us: None,
            ratio: None,
        };
    };
    let (length, says) = match published.length(table, name, map) {
        Printed::Length(length) => (Some(length), "length"),
        Printed::Optimal => (None, "optimal"),
        Printed::None => (None, "not found"),
        Printed::Nothing => (None, "nothing"),
    };
    let time = published.time(table, name, map);
    let yardstick = published.time(table, "A*", map);
    Said {
        length,
        says,
        time_us: time.map(|time| time * 1e3),
        ratio: time.zip(yardstick).map(|(time, a_star)| time / a_star),
    }
}

/// A printed length that is the shortest is reproduced by finding it in every run; a longer one if
/// it lies within a tenth of the lengths found, from the least to the greatest; `n/a` by finding
/// nothing.
fn reproduced(
    published: &Published,
    contender: &Contender,
    table: usize,
    map: &str,
    measured: &Measured,
) -> Option<bool> {
    let name = contender.published_as.filter(|_| contender.is_published)?;
    let all_optimal = measured.optimal == measured.runs;
    match published.length(table, name, map) {
        Printed::Optimal => Some(all_optimal),
        Printed::None => Some(measured.found == 0),
        Printed::Nothing => None,
        Printed::Length(length) if (length - measured.shortest).abs() < 0.01 => Some(all_optimal),
        Printed::Length(length) => {
            Some(measured.lengths.is_some_and(|lengths| {
                0.9 * lengths.least <= length && length <= 1.1 * lengths.most
            }))
        }
    }
}
