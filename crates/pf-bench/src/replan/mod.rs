//! `bench replan`: a change of map or query on a long way, answered by repair and afresh.
//!
//! Of each map's queries the longer half is asked, spread evenly over their lengths. For each query
//! and class of [events](event) all contenders plan on the map as the file has it and do their upkeep
//! (`settle`); then the event happens, once, and all answer it, one after the other on the same
//! problem, a different one first each time. The latency is that of a single shot: from the change,
//! that of the map included, to the answer. The upkeep is what `settle` takes after it. The path that
//! the robot goes and that things happen to is that of the first planner asked for, as in use; where
//! a tie between paths breaks is no matter to a search that starts over.
//!
//! Every answer is compared exactly with that of the fresh A*. Ours that differ make the suite fail.

mod condor;
mod event;

use crate::{
    cases::{Case, Maps},
    contenders::{FRESH, Ours, Repairers, proved},
    protocol::{Tally, geometric_mean, json, say, timed},
};
use anyhow::{Result, bail};
use condor::Condor;
use event::{Class, Event};
use pf_core::{Context, Problem};
use pf_grid::{Cell, GridCost, GridProblem, Moves};
use serde::Serialize;
use std::time::Duration;

#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  cargo xtask bench replan
  cargo xtask bench replan --maps maps/grids/redlarski --filter 100 --moves always --steps 0
  cargo xtask bench replan --filter Aftershock --event 10-near --moves no-corner-cutting
  cargo xtask bench replan --planner d-star-lite --set patience=0.3 --json")]
pub(crate) struct Args {
    #[command(flatten)]
    maps: Maps,
    #[command(flatten)]
    planners: Repairers,
    /// Only events of this class: 10-near, 1%-near, 1%-anywhere, block-7x7, goal-moved,
    /// robot-moved, blocked, freed, longer; may be given again
    #[arg(long, value_name = "CLASS", value_parser = class)]
    event: Vec<Class>,
    /// How far the robot has gone when the event comes
    #[arg(long, value_name = "N", default_value_t = 5)]
    steps: usize,
    /// Cut every cell into N x N
    #[arg(long, value_name = "N", default_value_t = 1)]
    upscale: u32,
    /// Under which moves; without a word no-corner-cutting, and orthogonal beside
    /// condor-pathfinding-grid
    #[arg(long, value_name = "RULE")]
    moves: Vec<Moves>,
    /// At most this many queries a map, of the longer half, spread evenly over their lengths
    #[arg(long, value_name = "N", default_value_t = 25)]
    limit: usize,
    /// Seed of what happens
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// One JSON object a line
    #[arg(long)]
    json: bool,
}

fn class(text: &str) -> Result<Class, String> {
    let found = Class::ALL.into_iter().find(|class| class.name() == text);
    found.ok_or_else(|| {
        let names: Vec<_> = Class::ALL.iter().map(|class| class.name()).collect();
        format!("expected {}", names.join(", "))
    })
}

/// What a contender did over the queries of one map and class.
#[derive(Default)]
struct Count {
    latency: Tally,
    upkeep: Tally,
    both: Tally,
    /// How many times faster than fresh, of each query by itself.
    paired: Vec<f64>,
    afresh: u32,
}

/// One line of the answer.
#[derive(Debug, Serialize)]
struct Row {
    suite: &'static str,
    case: String,
    moves: &'static str,
    event: &'static str,
    planner: &'static str,
    queries: usize,
    /// The median, by the name that `pf replan` uses.
    latency_us: f64,
    mean_us: f64,
    median_us: f64,
    p95_us: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    upkeep_us: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    upkeep_p95_us: Option<f64>,
    /// The median of latency and upkeep together.
    #[serde(skip_serializing_if = "Option::is_none")]
    both_us: Option<f64>,
    /// The fresh A*'s median divided by this one's.
    speedup: f64,
    /// The median of what the fresh A* takes divided by what this one takes.
    paired_speedup: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    expanded: Option<f64>,
    /// The share of answers planned afresh, as the planner says.
    #[serde(skip_serializing_if = "Option::is_none")]
    afresh: Option<f64>,
    mismatches: u64,
}

pub(crate) fn run(args: &Args) -> Result<()> {
    let rules = match &args.moves[..] {
        [] => &[Moves::OnlyWhenNoObstacles, Moves::Orthogonal][..],
        asked => asked,
    };
    let classes = match &args.event[..] {
        [] => &Class::ALL[..],
        asked => asked,
    };
    if !args.json {
        header()?;
    }
    let mut rows = Vec::new();
    for map in args.maps.files()? {
        let case = Case::load(&map)?.upscaled(args.upscale)?;
        for &moves in rules {
            for &class in classes {
                let told = bench(args, &case, moves, class)?;
                for row in &told {
                    if args.json {
                        json(row)?;
                    } else {
                        tell(row)?;
                    }
                }
                rows.extend(told);
            }
        }
    }
    if !args.json {
        summary(&rows, rules, classes)?;
    }
    // What a peer gets wrong is its affair, and shown.
    let ours = rows.iter().filter(|row| row.planner != condor::NAME);
    let mismatches: u64 = ours.map(|row| row.mismatches).sum();
    if mismatches > 0 {
        bail!("{mismatches} answers do not agree");
    }
    Ok(())
}

/// All queries of a map and class.
fn bench(args: &Args, case: &Case, moves: Moves, class: Class) -> Result<Vec<Row>> {
    let mut ours: Vec<(Ours, Count)> = args
        .planners
        .make()?
        .into_iter()
        .map(|one| (one, Count::default()))
        .collect();
    let mut condor = if moves == Moves::Orthogonal && case.grid.is_uniform() {
        Some((Condor::on(&case.grid)?, Count::default()))
    } else {
        None
    };
    // A grid of its own, which nobody else looks at: a change does not copy it.
    let mut problem =
        GridProblem::new((*case.grid).clone(), Cell::default(), Cell::default())?.with_moves(moves);
    for row in case.long(args.limit) {
        problem.apply(&[
            pf_grid::GridChange::StartMoved(row.start),
            pf_grid::GridChange::GoalMoved(row.goal),
        ])?;
        // Who plans last finds the map in the caches: each of them in turn.
        let (mut path, all) = (None, ours.len());
        let first = ours[0].1.latency.queries();
        for k in (0..all).map(|k| (first + k) % all) {
            let (one, _) = &mut ours[k];
            let report = one
                .planner
                .plan(&problem, &mut Context::seeded(args.seed))?;
            one.planner
                .settle(&problem, &mut Context::seeded(args.seed));
            // That of the first planner asked for, or A*'s if there is none.
            if k == 1 || all == 1 {
                path = report.outcome.solved().map(|best| best.solution.clone());
            }
        }
        let seed = args.seed.wrapping_mul(1 << 32) + u64::from(row.line);
        let Some(path) = path else { continue };
        let Some(event) = Event::draw(class, &problem, (&path, args.steps), seed) else {
            continue;
        };
        if let Some((condor, _)) = &mut condor {
            condor.prepare(event.robot, row.goal);
        }
        shot(
            args.seed,
            &mut ours,
            &mut condor,
            class,
            &event,
            &mut problem,
        )?;
        problem.apply(&event.undo)?;
    }
    let fresh = ours[0].1.latency.quantile(0.5);
    let peer = condor.map(|(_, count)| (condor::NAME, count));
    let all = ours
        .into_iter()
        .map(|(one, count)| (one.name, count))
        .chain(peer);
    Ok(all
        .map(|(name, count)| count.row(case, moves, class, name, fresh))
        .collect())
}

/// Lets an event happen and all contenders answer it.
fn shot(
    seed: u64,
    ours: &mut [(Ours, Count)],
    condor: &mut Option<(Condor, Count)>,
    class: Class,
    event: &Event,
    problem: &mut GridProblem,
) -> Result<()> {
    let (change, revision) = timed(|| problem.revise(&event.changes));
    let revision = revision?;
    let contenders = ours.len() + usize::from(condor.is_some());
    let first = ours[0].1.latency.queries() % contenders;
    let mut times = vec![Duration::ZERO; contenders];
    let mut costs = vec![None; contenders];
    for k in (0..contenders).map(|k| (first + k) % contenders) {
        let Some((one, count)) = ours.get_mut(k) else {
            if let Some((condor, _)) = condor {
                let (time, steps) = condor.answer(class, event, revision.problem());
                times[k] = time;
                costs[k] = Some(steps.map(|steps| GridCost::of_steps(steps, 0)));
            }
            continue;
        };
        let mut cx = Context::seeded(seed);
        let (time, report) = timed(|| one.planner.replan(&revision, &mut cx));
        let report = report?;
        times[k] = change + time;
        costs[k] = proved(&report);
        count.latency.expanded += report.stats.expanded;
        let afresh = report.note("replanned").is_none_or(|how| how == "afresh");
        count.afresh += u32::from(afresh);
        let mut cx = Context::seeded(seed);
        let (time, ()) = timed(|| one.planner.settle(revision.problem(), &mut cx));
        count.upkeep.add(time);
        count.both.add(times[k] + time);
    }
    let counts = ours.iter_mut().map(|(_, count)| count);
    let counts = counts.chain(condor.iter_mut().map(|(_, count)| count));
    for (k, count) in counts.enumerate() {
        count.latency.add(times[k]);
        count
            .paired
            .push(times[0].as_secs_f64() / times[k].as_secs_f64());
        let right = costs[k].is_some() && costs[k] == costs[0];
        count.latency.mismatches += u64::from(!right);
    }
    Ok(())
}

impl Count {
    fn row(
        mut self,
        case: &Case,
        moves: Moves,
        class: Class,
        planner: &'static str,
        fresh: f64,
    ) -> Row {
        let queries = self.latency.queries();
        #[expect(clippy::cast_precision_loss, reason = "numbers of cells and queries")]
        let mean = |sum: u64| sum as f64 / queries as f64;
        let ours = planner != condor::NAME;
        let median = self.latency.quantile(0.5);
        self.paired.sort_by(f64::total_cmp);
        Row {
            suite: "replan",
            case: case.under(moves),
            moves: moves.name(),
            event: class.name(),
            planner,
            queries,
            latency_us: median,
            mean_us: self.latency.mean(),
            median_us: median,
            p95_us: self.latency.quantile(0.95),
            upkeep_us: ours.then(|| self.upkeep.quantile(0.5)),
            upkeep_p95_us: ours.then(|| self.upkeep.quantile(0.95)),
            both_us: ours.then(|| self.both.quantile(0.5)),
            speedup: fresh / median,
            paired_speedup: self.paired.get(queries / 2).copied().unwrap_or(f64::NAN),
            expanded: ours.then(|| mean(self.latency.expanded)),
            afresh: ours.then(|| mean(self.afresh.into())),
            mismatches: self.latency.mismatches,
        }
    }
}

fn header() -> Result<()> {
    say(format_args!(
        "{:<27} {:<12} {:<22} {:>7} {:>10} {:>10} {:>8} {:>8} {:>9} {:>9} {:>9} {:>9} {:>7} {:>10}",
        "map",
        "event",
        "planner",
        "queries",
        "median us",
        "p95 us",
        "x fresh",
        "paired",
        "upkeep us",
        "its p95",
        "both us",
        "expanded",
        "afresh",
        "mismatches"
    ))
}

fn tell(row: &Row) -> Result<()> {
    let maybe = |value: Option<f64>, digits: usize| {
        value.map_or("-".to_owned(), |value| format!("{value:.digits$}"))
    };
    say(format_args!(
        "{:<27} {:<12} {:<22} {:>7} {:>10.1} {:>10.1} {:>8.2} {:>8.2} {:>9} {:>9} {:>9} {:>9} {:>7} {:>10}",
        row.case,
        row.event,
        row.planner,
        row.queries,
        row.median_us,
        row.p95_us,
        row.speedup,
        row.paired_speedup,
        maybe(row.upkeep_us, 1),
        maybe(row.upkeep_p95_us, 1),
        maybe(row.both_us, 1),
        maybe(row.expanded, 0),
        maybe(row.afresh, 2),
        row.mismatches
    ))
}

/// Per rule, class and planner: how many times faster than fresh over all maps.
fn summary(rows: &[Row], rules: &[Moves], classes: &[Class]) -> Result<()> {
    for moves in rules {
        for class in classes {
            let here = |row: &&Row| row.moves == moves.name() && row.event == class.name();
            let mut planners: Vec<&str> = Vec::new();
            for row in rows.iter().filter(here) {
                if row.planner != FRESH && !planners.contains(&row.planner) {
                    planners.push(row.planner);
                }
            }
            let all_of = |planner: &str| {
                let rows = rows.iter().filter(here);
                let rows = rows.filter(|row| row.planner == planner && row.queries > 0);
                rows.collect::<Vec<_>>()
            };
            let peer = all_of(condor::NAME);
            for planner in planners {
                let own = all_of(planner);
                let speedups: Vec<f64> = own.iter().map(|row| row.speedup).collect();
                let least = speedups.iter().copied().fold(f64::INFINITY, f64::min);
                say(format_args!(
                    "{moves}, {}: {planner} is {:.2} times as fast as a fresh A* (geometric mean \
                     of {} maps; least {least:.2})",
                    class.name(),
                    geometric_mean(&speedups),
                    speedups.len()
                ))?;
                if planner == condor::NAME || peer.len() != own.len() {
                    continue;
                }
                let beside = own.iter().zip(&peer);
                let beside: Vec<f64> = beside.map(|(a, b)| b.median_us / a.median_us).collect();
                if !beside.is_empty() {
                    let least = beside.iter().copied().fold(f64::INFINITY, f64::min);
                    say(format_args!(
                        "{moves}, {}: {planner} is {:.2} times as fast as {} (geometric mean of {} \
                         maps; least {least:.2})",
                        class.name(),
                        geometric_mean(&beside),
                        condor::NAME,
                        beside.len()
                    ))?;
                }
            }
        }
    }
    Ok(())
}
