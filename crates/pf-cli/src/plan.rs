//! `pf plan`: a path on a map.

use crate::{
    args::{PlannerArgs, QuestionArgs},
    explain,
    failure::{Failure, Status},
    question,
    report::{self, Told},
    scen,
};
use pf_core::CancelToken;
use pf_grid::Cell;
use pf_io::{Expected, write_whole};
use pf_planners::{Answer, AnyEntry, Line, Runner, find};
use pf_render::{Picture, Recorder};
use std::{
    io::stdout,
    path::{Path, PathBuf},
};

/// Plan a path on a map.
///
/// MAP is a Moving AI .map, a ROS `map_server` .yaml, a .png or .pgm (dark is blocked), or a scenario
/// .toml, whose cases are planned one after the other.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  pf plan arena.map --from 3,4 --to 60,41
  pf plan office.yaml --from 20,30 --to 370,270 --radius 3 --svg office.svg --show-expanded
  pf plan maze.png --planner dijkstra --from 1,1 --to 98,98 --moves orthogonal --json
  pf plan island.map --from 5,5 --to 90,90 --nearest
  pf plan arena.map --scen arena.map.scen --limit 100")]
pub(crate) struct Args {
    /// A map or a scenario
    map: PathBuf,
    #[command(flatten)]
    question: QuestionArgs,
    /// Where there is no path, plan to the reachable cell nearest the goal
    #[arg(long, help_heading = "Question")]
    nearest: bool,
    #[command(flatten)]
    planner: PlannerArgs,
    /// Plan every row of a Moving AI scenario file and compare with the stated optima
    #[arg(long, value_name = "FILE", help_heading = "Question",
        conflicts_with_all = ["from", "to", "case", "nearest", "svg", "png", "show_expanded"])]
    scen: Option<PathBuf>,
    /// Only the first N rows
    #[arg(long, value_name = "N", requires = "scen", help_heading = "Question")]
    limit: Option<usize>,
    /// Draw the map and the path as SVG
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    svg: Option<PathBuf>,
    /// Draw the map and the path as PNG
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    png: Option<PathBuf>,
    /// Show in the picture what the planner looked at
    #[arg(long, help_heading = "Output")]
    show_expanded: bool,
    /// Print one JSON object on one line
    #[arg(long, help_heading = "Output")]
    json: bool,
}

pub(crate) fn act(args: &Args, cancel: &CancelToken) -> Result<Status, Failure> {
    let entry = args.planner.entry("astar")?;
    if let Some(rows) = &args.scen {
        if question::is_scenario(&args.map) {
            return Err(Failure::usage("--scen wants a map, not a scenario"));
        }
        let request = scen::Request {
            map: &args.map,
            rows,
            limit: args.limit,
            json: args.json,
        };
        return scen::act(&request, entry, &args.planner, &args.question, cancel);
    }
    let questions = question::read(&args.map, &args.question)?;
    let drawing = args.svg.is_some() || args.png.is_some();
    if drawing && questions.len() > 1 {
        let names: Vec<_> = questions.iter().filter_map(|q| q.case.as_deref()).collect();
        let help = format!("choose one with --case: {}", names.join(", "));
        return Err(Failure::usage("a picture shows one case").help(help));
    }
    let ask_nearest = args.nearest && has_nearest(entry);
    let settings: &[_] = if ask_nearest {
        &[("nearest", "true")]
    } else {
        &[]
    };
    let mut runner = args.planner.runner(entry, settings)?;
    let mut out = stdout().lock();
    let mut worst = Status::Done;
    for question in &questions {
        let mut recorder = Recorder::default();
        let listen = (args.show_expanded && drawing).then_some(&mut recorder);
        let order = args.planner.order(cancel, listen);
        let answer = runner.plan(&question.scene, order)?;
        let mut told = Told {
            entry,
            question,
            seed: args.planner.seed,
            notes: Vec::new(),
            nearest: None,
            answer,
        };
        worst = worst.max(judge(&mut told));
        if told.answer.outcome == "infeasible" && args.nearest {
            told.nearest = nearest(args, &mut told, runner.as_mut(), cancel)?;
        }
        if args.json {
            report::line(&mut out, &told.json())?;
        } else {
            told.tell(&mut out)?;
        }
        if drawing {
            let cells = args.show_expanded.then(|| recorder.expanded());
            let picture = told.picture(cells);
            draw(&picture, args.svg.as_deref(), args.png.as_deref())?;
        }
        if cancel.is_cancelled() {
            return Ok(Status::Interrupted);
        }
    }
    Ok(worst)
}

fn has_nearest(entry: &dyn AnyEntry) -> bool {
    entry.parameters().iter().any(|key| key.name == "nearest")
}

/// Says why there is no path, and whether what the file expects was found.
fn judge(told: &mut Told<'_>) -> Status {
    let status = report::status(&told.answer);
    if told.answer.outcome == "infeasible" {
        told.notes = explain::why(&told.question.scene);
    }
    let (Some(expected), false) = (&told.question.expected, status == Status::Interrupted) else {
        return status;
    };
    if agrees(expected, &told.answer) {
        told.notes.push("expected: as the file says".to_owned());
        return status;
    }
    told.notes
        .push(format!("expected: the file says {}", expected.cost));
    // What a planner that proves nothing finds may well be longer.
    match told.answer.outcome {
        "optimal" | "infeasible" => Status::CheckFailed,
        _ => status,
    }
}

/// Whether an answer costs what a file says.
pub(crate) fn agrees(expected: &Expected, answer: &Answer) -> bool {
    // Both are the exact cost, shown as f64 in the same way.
    answer.costs[..] == [expected.cost.value()]
}

/// The way to the reachable cell nearest the goal: the planner's own, or Dijkstra's where the
/// planner cannot tell.
fn nearest(
    args: &Args,
    told: &mut Told<'_>,
    runner: &mut dyn Runner,
    cancel: &CancelToken,
) -> Result<Option<Line>, Failure> {
    let scene = &told.question.scene;
    if !has_nearest(told.entry) {
        let mut dijkstra = find("dijkstra")
            .map_err(|error| Failure::Internal(error.to_string()))?
            .runner(&[("nearest".to_owned(), "true".to_owned())])
            .map_err(|error| Failure::Internal(error.to_string()))?;
        let answer = dijkstra.plan(scene, args.planner.order(cancel, None))?;
        told.answer.notes.extend(answer.notes);
    }
    let note = told.answer.notes.iter().find(|note| note.key == "nearest");
    let Some(cell) = note.and_then(|note| note.text.parse::<Cell>().ok()) else {
        told.notes
            .push("nearest: no cell can be reached from the start".to_owned());
        return Ok(None);
    };
    let way = scene.clone().with_query(scene.from(), cell)?;
    let answer = runner.plan(&way, args.planner.order(cancel, None))?;
    Ok(answer.lines.into_iter().next())
}

/// Writes a picture as asked for.
pub(crate) fn draw(
    picture: &Picture,
    svg: Option<&Path>,
    png: Option<&Path>,
) -> Result<(), Failure> {
    let store = |path: &Path, bytes: &[u8]| {
        write_whole(path, |out| out.write_all(bytes)).map_err(|error| Failure::unwritten(&error))
    };
    if let Some(path) = svg {
        store(path, picture.svg().as_bytes())?;
    }
    if let Some(path) = png {
        let bytes = picture
            .png()
            .map_err(|error| Failure::Internal(error.to_string()))?;
        store(path, &bytes)?;
    }
    Ok(())
}
