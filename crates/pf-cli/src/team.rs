//! `pf team`: several robots in one world, and the choices there are.

use crate::{
    args::PlannerArgs,
    failure::{Failure, Status},
    text,
};
use comfy_table::{CellAlignment, Table, presets};
use pf_core::{Budget, CancelToken, Context, Outcome, Report, Solved, Stop};
use pf_geom::{Objectives, Robot, TeamPlan, TeamProblem, Timing};
use pf_io::{WorldFile, read_world, write_whole};
use pf_moabc::Preference;
use pf_planners::{Entry, UnknownPlanner, team_planners};
use pf_render::{TeamSheet, png_of};
use serde::Serialize;
use std::{
    fmt::Write as _,
    io::{Write, stdout},
    path::{Path, PathBuf},
};

/// Plan for all robots of a world: a front of plans, and the one that is preferred
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  pf team maps/scenarios/three-robots.toml --svg front.svg
  pf team robots.toml --planner moead --evaluations 100000 --prefer safety
  pf team robots.toml --planner prioritised --json")]
pub(crate) struct Args {
    /// A world with robots, TOML
    map: PathBuf,
    #[command(flatten)]
    planner: PlannerArgs,
    /// Stop after so many plans
    #[arg(long, value_name = "N")]
    evaluations: Option<u64>,
    /// Which plan to show: length, safety, smooth, knee
    #[arg(long, value_name = "WHAT", default_value_t)]
    prefer: Preference,
    /// The clearance from which on nothing is dangerous
    #[arg(long, value_name = "L", default_value_t = TeamProblem::EASE)]
    ease: f64,
    /// Judge paths in space only: robots may be in one place at one time
    #[arg(long)]
    ignore_time: bool,
    /// At most so many plans in the table
    #[arg(long, value_name = "N", default_value_t = 15)]
    rows: usize,
    /// One object on one line
    #[arg(long)]
    json: bool,
    /// Draw the front and the preferred plan
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// The same as PNG
    #[arg(long, value_name = "FILE")]
    png: Option<PathBuf>,
}

#[derive(Serialize)]
struct Json {
    planner: &'static str,
    problem: &'static str,
    outcome: &'static str,
    stop: &'static str,
    cost: Option<Objectives>,
    length: Option<f64>,
    /// By robot: x, y and time of its points, in the preferred plan.
    paths: Vec<Vec<[f64; 3]>>,
    clearance: Option<f64>,
    prefer: &'static str,
    front: Vec<Objectives>,
    seed: u64,
    notes: Vec<String>,
    stats: Stats,
}

#[derive(Serialize)]
struct Stats {
    iterations: u64,
    expanded: u64,
    evaluated: u64,
    elapsed_us: f64,
}

pub(crate) fn act(args: &Args, cancel: &CancelToken) -> Result<Status, Failure> {
    let entry = entry(&args.planner)?;
    let timing = if args.ignore_time {
        Timing::Ignored
    } else {
        Timing::Exact
    };
    let problem = problem(&args.map, timing, args.ease)?;
    let report = plan(&args.planner, args.evaluations, entry, &problem, cancel)?;
    if let Some(front) = report.outcome.solved() {
        draw(args, entry, &problem, front)?;
    }
    let mut out = stdout().lock();
    if args.json {
        let line = serde_json::to_string(&json(args, entry, &problem, &report));
        let line = line.map_err(|error| Failure::Internal(error.to_string()))?;
        writeln!(out, "{line}")?;
    } else {
        write!(out, "{}", words(args, entry, &problem, &report))?;
    }
    Ok(match &report.outcome {
        _ if report.stop == Stop::Cancelled => Status::Interrupted,
        Outcome::Infeasible => Status::NoPath,
        Outcome::Unknown { .. } => Status::NotFound,
        Outcome::Optimal(_) | Outcome::Feasible(_) => Status::Done,
    })
}

pub(crate) fn entry(args: &PlannerArgs) -> Result<&'static Entry<TeamProblem>, Failure> {
    let asked = args.planner.as_deref().unwrap_or("moabc");
    let found = team_planners().find(|entry| entry.key() == asked);
    found.ok_or_else(|| {
        let known: Vec<_> = team_planners().map(Entry::key).collect();
        let unknown: Result<_, UnknownPlanner> = pf_planners::find(asked);
        let message = match unknown {
            Err(unknown) => unknown.to_string(),
            Ok(_) => format!("{asked} does not plan for teams"),
        };
        Failure::usage(message).help(format!("planners for teams are {}", known.join(", ")))
    })
}

/// What the file asks.
pub(crate) fn problem(map: &Path, timing: Timing, ease: f64) -> Result<TeamProblem, Failure> {
    let file = read_world(map)?;
    let bad = |what: &dyn std::fmt::Display| Failure::BadFile {
        message: format!("{}: {what}", map.display()),
        code: None,
        at: None,
    };
    if file.robots.is_empty() {
        return Err(bad(&"found no [[robot]], expected one at least"));
    }
    let team = TeamProblem::new(file.world.clone(), robots(&file)).map_err(|error| bad(&error))?;
    let team = team.with_timing(timing).with_ease(ease);
    team.map_err(|error| Failure::usage(format!("--ease: {error}")))
}

pub(crate) fn robots(file: &WorldFile) -> Vec<Robot> {
    let robots = file.robots.iter().map(|robot| Robot {
        start: robot.start,
        goal: robot.goal,
        radius: robot.radius,
        speed: robot.speed.unwrap_or(1.0),
    });
    robots.collect()
}

pub(crate) fn plan(
    args: &PlannerArgs,
    evaluations: Option<u64>,
    entry: &Entry<TeamProblem>,
    problem: &TeamProblem,
    cancel: &CancelToken,
) -> Result<Report<TeamProblem>, Failure> {
    let mut settings = args.settings.clone();
    let takes = |name: &str| entry.parameters().iter().any(|key| key.name == name);
    let given = [
        ("threads", args.threads.map(|n| n.to_string())),
        ("evaluations", evaluations.map(|n| n.to_string())),
    ];
    for (key, value) in given {
        if let Some(value) = value.filter(|_| takes(key)) {
            settings.push((key.to_owned(), value));
        }
    }
    let planner = entry.make(&settings);
    let mut planner = planner.map_err(|error| Failure::usage(format!("--set: {error}")))?;
    let mut budget = Budget::unlimited().cancel(cancel);
    if let Some(time) = args.time {
        budget = budget.time(time);
    }
    if let Some(iterations) = args.iterations {
        budget = budget.iterations(iterations);
    }
    let mut cx = Context::seeded(args.seed).within(budget);
    let report = planner.plan(problem, &mut cx);
    report.map_err(|error| Failure::usage(error.to_string()))
}

/// The members that have a name: the preferred one first.
fn named(args: &Args, costs: &[Objectives]) -> Vec<(String, usize)> {
    let others = Preference::ALL
        .into_iter()
        .filter(|other| *other != args.prefer);
    let all = [args.prefer].into_iter().chain(others);
    let named = all.filter_map(|one| Some((one.word().to_owned(), one.choose(costs)?)));
    named.collect()
}

fn draw(
    args: &Args,
    entry: &Entry<TeamProblem>,
    problem: &TeamProblem,
    front: &Solved<TeamProblem>,
) -> Result<(), Failure> {
    if args.svg.is_none() && args.png.is_none() {
        return Ok(());
    }
    let costs = front.cost.members();
    let title = format!(
        "{}: {} plans by {}",
        args.map.display(),
        costs.len(),
        entry.key()
    );
    let svg = TeamSheet {
        problem,
        plans: &front.solution,
        costs: &front.cost,
        named: &named(args, costs),
        title: &title,
    }
    .svg();
    let store = |path: &PathBuf, bytes: &[u8]| {
        write_whole(path, |out| out.write_all(bytes)).map_err(|error| Failure::unwritten(&error))
    };
    if let Some(path) = &args.svg {
        store(path, svg.as_bytes())?;
    }
    if let Some(path) = &args.png {
        let bytes = png_of(&svg).map_err(|error| Failure::Internal(error.to_string()))?;
        store(path, &bytes)?;
    }
    Ok(())
}

fn json(
    args: &Args,
    entry: &Entry<TeamProblem>,
    problem: &TeamProblem,
    report: &Report<TeamProblem>,
) -> Json {
    let solved = report.outcome.solved();
    let front = solved
        .map(|s| s.cost.members().to_vec())
        .unwrap_or_default();
    let chosen = args.prefer.choose(&front);
    let plan = solved.zip(chosen).map(|(s, i)| &s.solution.members()[i]);
    let cost = chosen.map(|i| front[i]);
    let stats = report.stats;
    Json {
        planner: entry.key(),
        problem: "team",
        outcome: report.outcome.word(),
        stop: report.stop.word(),
        cost,
        length: cost.map(|cost| cost[0]),
        paths: plan.map(points).unwrap_or_default(),
        clearance: cost.map(|cost| problem.ease() - cost[1]),
        prefer: args.prefer.word(),
        front,
        seed: args.planner.seed,
        notes: report.notes.iter().map(ToString::to_string).collect(),
        stats: Stats {
            iterations: stats.iterations,
            expanded: stats.expanded,
            evaluated: stats.evaluated,
            elapsed_us: text::micros(stats.elapsed),
        },
    }
}

fn points(plan: &TeamPlan) -> Vec<Vec<[f64; 3]>> {
    let path = |path: &pf_geom::TimedPath| path.iter().map(|p| [p.at.x, p.at.y, p.time]).collect();
    plan.paths.iter().map(path).collect()
}

/// The answer as people read it: a table of the front, the named members marked.
fn words(
    args: &Args,
    entry: &Entry<TeamProblem>,
    problem: &TeamProblem,
    report: &Report<TeamProblem>,
) -> String {
    let mut text = format!(
        "{}: {} ({}), {} evaluations in {}\n",
        entry.key(),
        report.outcome.word(),
        report.stop.word(),
        text::count(report.stats.evaluated),
        text::time(report.stats.elapsed)
    );
    if let Some(front) = report.outcome.solved() {
        let costs = front.cost.members();
        let named = named(args, costs);
        let shown = spread(costs.len(), args.rows, &named);
        // Writing to a string does not fail.
        let _ = writeln!(text, "{}", table(problem, front, &named, &shown));
        if shown.len() < costs.len() {
            let (few, all) = (shown.len(), costs.len());
            let _ = writeln!(text, "{few} of {all} plans; --rows shows more");
        }
        if let Some((name, place)) = named.first() {
            let _ = writeln!(text, "preferred ({name}): plan {place}");
        }
    }
    for note in &report.notes {
        let _ = writeln!(text, "{note}");
    }
    text
}

/// Members to show: those with names, and others evenly.
fn spread(count: usize, rows: usize, named: &[(String, usize)]) -> Vec<usize> {
    let mut shown: Vec<usize> = named.iter().map(|(_, place)| *place).collect();
    let step = count.div_ceil(rows.max(1)).max(1);
    shown.extend((0..count).step_by(step));
    shown.sort_unstable();
    shown.dedup();
    shown
}

fn table(
    problem: &TeamProblem,
    front: &Solved<TeamProblem>,
    named: &[(String, usize)],
    shown: &[usize],
) -> Table {
    let mut table = Table::new();
    table.load_style(presets::UTF8_FULL_CONDENSED).set_header([
        "plan",
        "length",
        "clearance",
        "turning",
        "time",
        "best for",
    ]);
    for column in table.column_iter_mut().take(5) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    for &place in shown {
        let [length, danger, turning] = front.cost.members()[place];
        let best_for = named.iter().filter(|(_, own)| *own == place);
        let best_for: Vec<_> = best_for.map(|(name, _)| name.as_str()).collect();
        let clearance = problem.ease() - danger;
        let most = if danger <= 0.0 { ">= " } else { "" };
        table.add_row([
            place.to_string(),
            format!("{length:.3}"),
            format!("{most}{clearance:.3}"),
            format!("{:.1} deg", turning.to_degrees()),
            format!("{:.1} s", front.solution.members()[place].duration()),
            best_for.join(", "),
        ]);
    }
    table
}
