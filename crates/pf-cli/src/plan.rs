//! `pf plan`: a path on a map.

use crate::{
    args::{PlannerArgs, QuestionArgs},
    failure::{Failure, Status},
    question::{self, Question, Stated},
    report::{self, Told},
    scen,
    view::Shown,
};
use pf_core::CancelToken;
use pf_grid::Cell;
use pf_io::{kind_of, write_whole};
use pf_planners::{Answer, AnyEntry, Line, Runner, Scene, find};
use pf_render::{Picture, Recorder};
use std::{
    io::stdout,
    path::{Path, PathBuf},
};

/// Plan a path on a map.
///
/// MAP is a grid (Moving AI .map, ROS `map_server` .yaml, .png or .pgm, dark is blocked), a world of
/// shapes (.toml, .geojson), or a scenario .toml, whose cases are planned one after the other. A
/// world whose file says of robots whence and whither is planned for each of them.
///
/// Any planner works on any map. For one on grids a world is cut into cells; for one in worlds the
/// blocked cells of a grid become rectangles. What such a planner proves is not claimed of the map:
/// a note says so.
///
/// The clearance told of a path is the distance between its line, where the robot's centre goes, and
/// the nearest obstacle: a robot of radius 0.5 that touches one has a clearance of 0.5. What
/// --clearance asks for is room besides the radius.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  pf plan arena.map --from 3,4 --to 60,41
  pf plan office.yaml --from 20,30 --to 370,270 --radius 3 --svg office.svg --show-expanded
  pf plan maze.png --planner dijkstra --from 1,1 --to 98,98 --moves orthogonal --json
  pf plan yard.toml --clearance 0.5 --png yard.png --show-clearance --show-graph
  pf plan yard.toml --from 2.5,-1 --to 40,30 --radius 0.4 --planner astar --cell 0.1
  pf plan island.map --from 5,5 --to 90,90 --nearest
  pf plan arena.map --scen arena.map.scen --limit 100")]
#[expect(clippy::struct_excessive_bools, reason = "a switch each")]
pub(crate) struct Args {
    /// A map or a scenario
    map: PathBuf,
    #[command(flatten)]
    question: QuestionArgs,
    /// Where there is no path on a grid, plan to the reachable cell nearest the goal
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
    /// Show in the picture how near obstacles the path goes
    #[arg(long, help_heading = "Output")]
    show_clearance: bool,
    /// Show in the picture the straight pieces that the planner knows to be free
    #[arg(long, help_heading = "Output")]
    show_graph: bool,
    /// Print one JSON object on one line
    #[arg(long, help_heading = "Output")]
    json: bool,
}

pub(crate) fn act(args: &Args, cancel: &CancelToken) -> Result<Status, Failure> {
    let kind = kind_of(&args.map)?;
    let in_world = question::is_about_a_world(kind);
    let default = if in_world {
        "visibility-graph"
    } else {
        "astar"
    };
    let entry = args.planner.entry(default)?;
    if in_world && args.nearest {
        let message = "--nearest: only a grid has cells that could be nearest";
        return Err(Failure::usage(message));
    }
    if let Some(rows) = &args.scen {
        if in_world || question::is_scenario(kind) {
            return Err(Failure::usage(
                "--scen wants a grid, not a world or scenario",
            ));
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
    if args.drawing() && questions.len() > 1 {
        return Err(one_picture(&questions));
    }
    let ask_nearest = args.nearest && has_nearest(entry);
    let settings: &[_] = if ask_nearest {
        &[("nearest", "true")]
    } else {
        &[]
    };
    let mut runner = args.planner.runner(entry, settings)?;
    let mut worst = Status::Done;
    for question in &questions {
        worst = worst.max(args.answer(entry, runner.as_mut(), question, cancel)?);
        if cancel.is_cancelled() {
            return Ok(Status::Interrupted);
        }
    }
    Ok(worst)
}

/// Several questions, one picture.
pub(crate) fn one_picture(questions: &[Question]) -> Failure {
    let names: Vec<_> = questions.iter().filter_map(|q| q.case.as_deref()).collect();
    let help = format!("choose one with --case: {}", names.join(", "));
    Failure::usage("a picture shows one case").help(help)
}

impl Args {
    fn drawing(&self) -> bool {
        self.svg.is_some() || self.png.is_some()
    }

    fn answer(
        &self,
        entry: &dyn AnyEntry,
        runner: &mut dyn Runner,
        question: &Question,
        cancel: &CancelToken,
    ) -> Result<Status, Failure> {
        let mut recorder = Recorder::default();
        let listen = (self.show_expanded || self.show_graph) && self.drawing();
        let order = self.planner.order(cancel, listen.then_some(&mut recorder));
        let answer = runner.plan(&question.scene, order)?;
        let mut told = Told {
            entry,
            question,
            seed: self.planner.seed,
            notes: Vec::new(),
            nearest: None,
            answer,
        };
        told.explain();
        let status = judge(&mut told);
        // The raster is of the question, not of what is asked besides.
        let raster = runner.raster().cloned();
        if self.nearest && told.has_no_way() {
            told.nearest = nearest(self, &mut told, runner, cancel)?;
        }
        let mut out = stdout().lock();
        if self.json {
            report::line(&mut out, &told.json())?;
        } else {
            told.tell(&mut out)?;
        }
        if self.drawing() {
            let shown = Shown {
                recorder: &recorder,
                raster: raster.as_ref(),
                expanded: self.show_expanded,
                graph: self.show_graph,
                clearance: self.show_clearance,
            };
            let picture = told.picture(&shown);
            draw(&picture, self.svg.as_deref(), self.png.as_deref())?;
        }
        Ok(status)
    }
}

fn has_nearest(entry: &dyn AnyEntry) -> bool {
    entry.parameters().iter().any(|key| key.name == "nearest")
}

/// Says whether what the file states was found.
fn judge(told: &mut Told<'_>) -> Status {
    let status = report::status(&told.answer);
    let (Some(stated), false) = (told.stated(), status == Status::Interrupted) else {
        return status;
    };
    if agrees(stated, &told.answer) {
        told.notes.push("expected: as the file says".to_owned());
        return status;
    }
    let words = format!("expected: the file says {}", stated.words);
    told.notes.push(words);
    // What a planner that proves nothing finds may well be longer.
    match told.answer.outcome {
        "optimal" | "infeasible" => Status::CheckFailed,
        _ => status,
    }
}

/// Whether an answer costs what a file says.
pub(crate) fn agrees(stated: &Stated, answer: &Answer) -> bool {
    matches!(answer.costs[..], [cost] if (cost - stated.cost).abs() <= stated.tolerance)
}

/// The way to the reachable cell nearest the goal: the planner's own, or Dijkstra's where the
/// planner cannot tell.
fn nearest(
    args: &Args,
    told: &mut Told<'_>,
    runner: &mut dyn Runner,
    cancel: &CancelToken,
) -> Result<Option<Line>, Failure> {
    let Scene::Grid(grid) = &told.question.scene else {
        return Ok(None);
    };
    if !has_nearest(told.entry) {
        let mut dijkstra = find("dijkstra")
            .map_err(|error| Failure::Internal(error.to_string()))?
            .runner(&[("nearest".to_owned(), "true".to_owned())])
            .map_err(|error| Failure::Internal(error.to_string()))?;
        let answer = dijkstra.plan(&told.question.scene, args.planner.order(cancel, None))?;
        told.answer.notes.extend(answer.notes);
    }
    let note = told.answer.notes.iter().find(|note| note.key == "nearest");
    let Some(cell) = note.and_then(|note| note.text.parse::<Cell>().ok()) else {
        told.notes
            .push("nearest: no cell can be reached from the start".to_owned());
        return Ok(None);
    };
    let way = grid.clone().with_query(grid.from(), cell)?;
    let answer = runner.plan(&way.into(), args.planner.order(cancel, None))?;
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
