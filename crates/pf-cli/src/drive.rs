//! `pf drive`: a robot with a sensor in a map that it does not know.

use crate::{
    args::{PlannerArgs, QuestionArgs},
    failure::{Failure, Status},
    plan::draw,
    question::{self, Question},
    report, text, view,
};
use pf_core::{CancelToken, Context, Replanner, Stop};
use pf_grid::{Arrival, Cell, Drive, Grid, GridProblem, Travel};
use pf_io::{FileKind, kind_of, read_scen};
use pf_planners::{AnyEntry, Entry, GridScene, Line, Scene, grid_planners};
use pf_render::{Line as Pen, Picture};
use serde::Serialize;
use std::{
    io::{Write, stdout},
    path::{Path, PathBuf},
    time::Duration,
};

/// Drive a robot with a sensor through a map it does not know.
///
/// The robot presumes free what it has not seen. It sees all cells whose middles lie within the
/// sensor's radius, and the eight around it; walls do not hide what is behind them. It follows its
/// path until it sees something that is not as it presumed, and plans anew at each such discovery.
/// With --radius or --clearance the map is first inflated by the robot's size, and that is what it
/// sees.
///
/// Without a query it drives from the map's first free cell to its last, row by row.
///
/// The latency runs from a discovery to the answer, the change of the known map included; the planning
/// in all also counts the first plan and the upkeep after each answer. Beside what the way has cost
/// stands what it would have cost with the map known.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  pf drive maps/grids/redlarski/maze-100.map --sensor 10
  pf drive arena.map --sensor 15 --scen arena.map.scen --row 130 --json
  pf drive office.yaml --sensor 40 --from 20,30 --to 370,270 --radius 3 --svg drive.svg
  pf drive arena.map --sensor 8 --from 3,4 --to 60,41 --planner astar --moves always")]
pub(crate) struct Args {
    /// A grid: Moving AI .map, ROS `map_server` .yaml, .png or .pgm; or a scenario .toml on one
    map: PathBuf,
    /// The sensor's radius in cells
    #[arg(long, value_name = "R", value_parser = radius, allow_negative_numbers = true)]
    sensor: f64,
    #[command(flatten)]
    question: QuestionArgs,
    /// Take the query from a Moving AI scenario file
    #[arg(long, value_name = "FILE", help_heading = "Question", requires = "row",
        conflicts_with_all = ["from", "to", "case"])]
    scen: Option<PathBuf>,
    /// Which of its rows, from 1
    #[arg(long, value_name = "N", help_heading = "Question", requires = "scen")]
    row: Option<usize>,
    #[command(flatten)]
    planner: PlannerArgs,
    /// Draw the way over what was seen, as SVG
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    svg: Option<PathBuf>,
    /// The same as PNG
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    png: Option<PathBuf>,
    /// Print one JSON object on one line
    #[arg(long, help_heading = "Output")]
    json: bool,
}

pub(crate) fn radius(text: &str) -> Result<f64, &'static str> {
    let radius = text.parse().ok();
    radius
        .filter(|radius: &f64| *radius >= 0.0 && radius.is_finite())
        .ok_or("a sensor's radius is a number from 0, in cells")
}

/// The object that `--json` prints.
#[derive(Serialize)]
struct Json<'a> {
    planner: &'a str,
    problem: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    case: Option<&'a str>,
    sensor: f64,
    /// That of the drive: `feasible` if it arrived.
    outcome: &'a str,
    stop: &'a str,
    cost: f64,
    length: f64,
    known_cost: Option<f64>,
    path: Vec<[u32; 2]>,
    seed: u64,
    replans: usize,
    first_us: f64,
    latency_us: f64,
    worst_us: f64,
    upkeep_us: f64,
    planning_us: f64,
    expanded: u64,
    seen: usize,
}

/// A drive with all that is told of it.
struct Told<'a> {
    args: &'a Args,
    entry: &'static Entry<GridProblem>,
    question: &'a Question,
    drive: Drive,
    travel: Travel,
    known_cost: Option<f64>,
}

pub(crate) fn act(args: &Args, cancel: &CancelToken) -> Result<Status, Failure> {
    let entry = entry(&args.planner)?;
    let row = args.scen.as_deref().zip(args.row);
    let question = ask(&args.map, &args.question, row)?;
    let Scene::Grid(scene) = &question.scene else {
        return Err(no_grid(&args.map));
    };
    let settings = |error| Failure::usage(format!("--set: {error}"));
    let mut planner = entry.make(&args.planner.settings).map_err(settings)?;
    let mut drive = Drive::new(scene.problem(), args.sensor)?;
    let travel = drive
        .run(planner.as_mut(), || context(args, cancel))
        .map_err(|unsupported| Failure::usage(unsupported.to_string()))?;
    let told = Told {
        args,
        entry,
        question: &question,
        known_cost: if travel.arrival == Arrival::Arrived {
            with_the_map(scene)?
        } else {
            None
        },
        drive,
        travel,
    };
    let mut out = stdout().lock();
    if args.json {
        report::line(&mut out, &told.json())?;
    } else {
        told.tell(&mut out)?;
    }
    let (svg, png) = (args.svg.as_deref(), args.png.as_deref());
    if svg.is_some() || png.is_some() {
        draw(&told.picture(), svg, png)?;
    }
    Ok(match told.travel.arrival {
        Arrival::Arrived => Status::Done,
        Arrival::Closed => Status::NoPath,
        Arrival::GaveUp => Status::NotFound,
        Arrival::Cancelled => Status::Interrupted,
        Arrival::Refused => {
            let message = format!("{} plans steps that cannot be made", entry.key());
            return Err(Failure::Internal(message));
        }
    })
}

pub(crate) fn entry(planner: &PlannerArgs) -> Result<&'static Entry<GridProblem>, Failure> {
    let asked = planner.entry("d-star-lite")?;
    let found = grid_planners().find(|entry| entry.key() == asked.key());
    found.ok_or_else(|| {
        let names: Vec<_> = grid_planners().map(Entry::key).collect();
        let message = format!("--planner: {} is no planner on grids", asked.key());
        Failure::usage(message).help(format!("planners on grids are {}", names.join(", ")))
    })
}

pub(crate) fn no_grid(map: &Path) -> Failure {
    let message = format!(
        "{}: a robot drives on a grid, not in a world",
        map.display()
    );
    Failure::usage(message).help("`pf plan` and `pf replan` plan in worlds")
}

/// Where to drive: as the options say, as a row of a file of queries does, or across the map.
pub(crate) fn ask(
    map: &Path,
    options: &QuestionArgs,
    row: Option<(&Path, usize)>,
) -> Result<Question, Failure> {
    let kind = kind_of(map)?;
    if question::is_about_a_world(kind) {
        return Err(no_grid(map));
    }
    let mut options = options.clone();
    if let Some((file, row)) = row {
        let grid = question::grid(map, &options)?;
        let scen = read_scen(file)?;
        scen.check_size(&grid)?;
        let found = row.checked_sub(1).and_then(|row| scen.rows.get(row));
        let Some(found) = found else {
            let message = format!("--row {row}: no such row in {}", file.display());
            let help = format!("rows go from 1 to {}", scen.rows.len());
            return Err(Failure::usage(message).help(help));
        };
        options.from = Some(found.start.into());
        options.to = Some(found.goal.into());
    } else if kind == FileKind::Grid && options.from.is_none() && options.to.is_none() {
        let grid = question::grid(map, &options)?;
        let reach = options.radius.unwrap_or(0.0) + options.clearance.unwrap_or(0.0);
        let ends = if reach > 0.0 {
            ends(&grid.inflated(reach))
        } else {
            ends(&grid)
        };
        [options.from, options.to] = ends.map(|cell| Some(cell.into()));
    }
    let mut questions = question::read(map, &options)?;
    if questions.len() > 1 {
        let names: Vec<_> = questions.iter().filter_map(|q| q.case.as_deref()).collect();
        let help = format!("choose one with --case: {}", names.join(", "));
        return Err(Failure::usage("a robot drives in one case").help(help));
    }
    let none = || Failure::usage(format!("{} asks nothing", map.display()));
    questions.pop().ok_or_else(none)
}

/// The first and the last free cell, row by row; of a map that is blocked all over, its corners.
fn ends(grid: &Grid) -> [Cell; 2] {
    let free = || grid.layout().cells().filter(|&cell| grid.is_free(cell));
    let last = Cell::new(grid.width() - 1, grid.height() - 1);
    [
        free().next().unwrap_or_default(),
        free().last().unwrap_or(last),
    ]
}

fn context(args: &Args, cancel: &CancelToken) -> Context<'static, GridProblem> {
    let order = args.planner.order(cancel, None);
    Context::seeded(order.seed).within(order.budget)
}

/// What the way costs for who knows the map.
fn with_the_map(scene: &GridScene) -> Result<Option<f64>, Failure> {
    let internal = |error: &dyn std::fmt::Display| Failure::Internal(error.to_string());
    let astar = grid_planners().find(|entry| entry.key() == "astar");
    let astar = astar.ok_or_else(|| internal(&"there is no A*"))?;
    let mut planner: Box<dyn Replanner<_>> = astar.make(&[]).map_err(|e| internal(&e))?;
    let report = planner.plan(scene.problem(), &mut Context::seeded(0));
    let report = report.map_err(|e| internal(&e))?;
    Ok(report.outcome.solved().map(|best| best.cost.value()))
}

/// The middle one, and the longest.
fn median_and_worst(times: &[Duration]) -> [Duration; 2] {
    let mut times = times.to_vec();
    times.sort_unstable();
    let at = |k: usize| times.get(k).copied().unwrap_or_default();
    [at(times.len() / 2), at(times.len().saturating_sub(1))]
}

impl Told<'_> {
    fn line(&self) -> Line {
        let point = |cell: &Cell| [f64::from(cell.x), f64::from(cell.y)];
        self.drive.trail().iter().map(point).collect()
    }

    fn outcome(&self) -> &'static str {
        match self.travel.arrival {
            Arrival::Arrived => "feasible",
            Arrival::Closed => "infeasible",
            Arrival::GaveUp | Arrival::Cancelled | Arrival::Refused => "unknown",
        }
    }

    fn seen(&self) -> usize {
        let cells = self.drive.known().grid().layout().cells();
        cells.filter(|&cell| self.drive.has_seen(cell)).count()
    }

    fn json(&self) -> Json<'_> {
        let travel = &self.travel;
        let [median, worst] = median_and_worst(&travel.latencies);
        let stop = match travel.arrival {
            Arrival::Cancelled => Stop::Cancelled,
            _ => Stop::Finished,
        };
        Json {
            planner: self.entry.key(),
            problem: "grid",
            case: self.question.case.as_deref(),
            sensor: self.args.sensor,
            outcome: self.outcome(),
            stop: stop.word(),
            cost: self.drive.cost().value(),
            length: report::length(&self.line()),
            known_cost: self.known_cost,
            path: self.drive.trail().iter().map(|c| [c.x, c.y]).collect(),
            seed: self.args.planner.seed,
            replans: travel.latencies.len(),
            first_us: text::micros(travel.first),
            latency_us: text::micros(median),
            worst_us: text::micros(worst),
            upkeep_us: text::micros(travel.upkeep),
            planning_us: text::micros(travel.planning()),
            expanded: travel.expanded,
            seen: self.seen(),
        }
    }

    fn title(&self) -> String {
        let known = self.drive.known();
        let grid = known.grid();
        let case = self.question.case.as_ref();
        format!(
            "{} on {}{}: {} x {} cells, unknown, {} to {}, {}, sensor {}",
            self.entry.name(),
            self.question.file,
            case.map(|case| format!(", {case}")).unwrap_or_default(),
            grid.width(),
            grid.height(),
            self.drive.trail()[0],
            known.goal(),
            known.moves(),
            self.args.sensor,
        )
    }

    fn end(&self) -> String {
        let at = self.drive.robot();
        match self.travel.arrival {
            Arrival::Arrived => "arrived".to_owned(),
            Arrival::Closed => format!("proved at {at} that there is no way to the goal"),
            Arrival::Cancelled => format!("interrupted at {at}"),
            Arrival::GaveUp | Arrival::Refused => {
                format!("found no path at {at} within the budget")
            }
        }
    }

    fn tell(&self, out: &mut dyn Write) -> Result<(), Failure> {
        let travel = &self.travel;
        let [median, worst] = median_and_worst(&travel.latencies);
        let cells = |n: usize| text::count(n as u64);
        writeln!(out, "{}", self.title())?;
        let mut row = |name: &str, value: &str| writeln!(out, "  {name:<10} {value}");
        row("drive", &self.end())?;
        let cost = text::number(self.drive.cost().value());
        let known = self.known_cost.map_or(String::new(), |known| {
            format!(", {} with the map known", text::number(known))
        });
        row("cost", &format!("{cost}{known}"))?;
        let moves = self.drive.trail().len() - 1;
        row("path", &format!("{} moves", cells(moves)))?;
        row("seen", &format!("{} cells", cells(self.seen())))?;
        row("replans", &cells(travel.latencies.len()))?;
        let words = format!("median {}, worst {}", text::time(median), text::time(worst));
        row("latency", &words)?;
        let words = format!(
            "{} in all: first plan {}, upkeep {}",
            text::time(travel.planning()),
            text::time(travel.first),
            text::time(travel.upkeep)
        );
        row("planning", &words)?;
        row(
            "expanded",
            &format!("{} cells", text::count(travel.expanded)),
        )?;
        Ok(())
    }

    /// What the robot knows in the end, and its way.
    fn picture(&self) -> Picture {
        let scene = &self.question.scene;
        let known = self.drive.known().grid();
        let picture = Picture::of(known).unseen(|cell| self.drive.has_seen(cell));
        let line = self.line();
        let picture = view::path(picture, scene, "driven", Pen::Solid, &line);
        let replans = text::count(self.travel.latencies.len() as u64);
        let cost = text::number(self.drive.cost().value());
        view::ends(picture, scene)
            .caption(self.title())
            .caption(format!("{}, cost {cost}, {replans} replans", self.end()))
    }
}
