//! `pf demo`: all planners on a few maps.

use crate::{
    failure::{Failure, Status},
    plan::draw,
    question::Question,
    report::{Told, length, status},
    text,
    view::Shown,
};
use comfy_table::{CellAlignment, Table, presets};
use pf_core::{Budget, CancelToken};
use pf_geom::Point;
use pf_grid::{Cell, Grid, Moves};
use pf_io::{FileError, Unknown, parse_movingai, parse_ros, parse_world};
use pf_planners::{Answer, AnyEntry, GridScene, Order, Robot, Scene, WorldScene, all};
use pf_render::Recorder;
use std::{
    fs,
    io::{Write, stdout},
    path::PathBuf,
    time::Duration,
};

/// Compare all planners on a few maps and draw pictures.
///
/// The maps are part of the program.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  pf demo
  pf demo --out /tmp/pictures")]
pub(crate) struct Args {
    /// Where the pictures go
    #[arg(long, value_name = "DIR", default_value = "demo")]
    out: PathBuf,
}

const REPETITIONS: usize = 3;
/// For planners that never know that they are done.
const PATIENCE: Duration = Duration::from_millis(40);

/// A map that the program carries, and a question worth asking on it.
struct Show {
    name: &'static str,
    scene: fn() -> Result<Scene, Failure>,
}

macro_rules! carried {
    ($path:literal) => {
        include_bytes!(concat!("../../../maps/", $path))
    };
}

const SHOWS: &[Show] = &[
    Show {
        name: "office",
        scene: || {
            let yaml = parse_ros("office.yaml", carried!("grids/office.yaml"))?;
            let pgm = carried!("grids/office.pgm");
            let scene = GridScene::new(
                yaml.grid("office.pgm", pgm, Unknown::Blocked)?,
                Cell::new(324, 278),
                Cell::new(40, 248),
            )?;
            Ok(scene.with_robot(Robot::of_radius(3.0))?.into())
        },
    },
    Show {
        name: "maze",
        scene: || {
            let map = parse_movingai("maze", carried!("grids/redlarski/maze-100.map"));
            from_cell_to_cell(map, (0, 0), (99, 99))
        },
    },
    Show {
        name: "mosaic",
        scene: || {
            let map = parse_movingai("mosaic", carried!("grids/redlarski/mosaic-100.map"));
            from_cell_to_cell(map, (2, 54), (97, 54))
        },
    },
    Show {
        name: "yard",
        scene: || {
            let yard = parse_world("yard", carried!("worlds/yard.toml"))?;
            let robot = Robot::of_radius(0.6);
            let (from, to) = (Point::new(5.0, 5.0), Point::new(105.0, 71.0));
            Ok(WorldScene::new(yard.world, robot, from, to)?.into())
        },
    },
];

fn from_cell_to_cell(
    map: Result<Grid, FileError>,
    from: (u32, u32),
    to: (u32, u32),
) -> Result<Scene, Failure> {
    let (from, to) = (Cell::new(from.0, from.1), Cell::new(to.0, to.1));
    let scene = GridScene::new(map?, from, to)?;
    Ok(scene.with_moves(Moves::Always).into())
}

pub(crate) fn act(args: &Args, cancel: &CancelToken) -> Result<Status, Failure> {
    fs::create_dir_all(&args.out).map_err(|error| {
        Failure::Internal(format!("{} cannot be made: {error}", args.out.display()))
    })?;
    let mut table = Table::new();
    table.load_style(presets::UTF8_FULL_CONDENSED).set_header([
        "map",
        "planner",
        "found",
        "length",
        "% over shortest",
        "time",
    ]);
    for column in table.column_iter_mut().skip(3) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    let mut pictures = 0;
    for show in SHOWS {
        let question = Question::of(show.name, (show.scene)()?);
        let mut answers = Vec::new();
        for entry in all() {
            let answer = show.plan(entry, &question, args, cancel)?;
            pictures += 2;
            if status(&answer) == Status::Interrupted {
                return Ok(Status::Interrupted);
            }
            answers.push((entry, answer));
        }
        rows(&mut table, show, &answers);
    }
    let mut out = stdout().lock();
    writeln!(out, "{table}")?;
    let place = args.out.display();
    writeln!(out, "{pictures} pictures, SVG and PNG, are in {place}/")?;
    Ok(Status::Done)
}

impl Show {
    /// Plans and draws. The time told is the best of a few, without the listener that a picture
    /// needs: the first call on a map also asks the system for memory.
    fn plan(
        &self,
        entry: &dyn AnyEntry,
        question: &Question,
        args: &Args,
        cancel: &CancelToken,
    ) -> Result<Answer, Failure> {
        let internal = |error: pf_core::InvalidParams| Failure::Internal(error.to_string());
        let mut runner = entry.runner(&[]).map_err(internal)?;
        let claims = entry.claims();
        let ends = claims.complete || claims.optimal;
        let mut budget = Budget::unlimited().cancel(cancel);
        if !ends {
            budget = budget.time(PATIENCE);
        }
        let order = |recorder| Order {
            seed: 0,
            budget: budget.clone(),
            recorder,
        };
        let mut answer = runner.plan(&question.scene, order(None))?;
        for _ in 1..if ends { REPETITIONS } else { 1 } {
            let again = runner.plan(&question.scene, order(None))?;
            if again.stats.elapsed < answer.stats.elapsed {
                answer = again;
            }
        }
        let mut recorder = Recorder::default();
        let told = Told {
            entry,
            question,
            seed: 0,
            notes: Vec::new(),
            nearest: None,
            answer: runner.plan(&question.scene, order(Some(&mut recorder)))?,
        };
        let picture = told.picture(&Shown {
            recorder: &recorder,
            raster: runner.raster(),
            expanded: true,
            graph: true,
            clearance: false,
        });
        let file = args.out.join(format!("{}-{}", self.name, entry.key()));
        let (svg, png) = (file.with_extension("svg"), file.with_extension("png"));
        draw(&picture, Some(&svg), Some(&png))?;
        Ok(answer)
    }
}

/// A row per planner; the shortest is what some planner found, and proved if one proves.
fn rows(table: &mut Table, show: &Show, answers: &[(&dyn AnyEntry, Answer)]) {
    let lengths = answers
        .iter()
        .filter_map(|(_, a)| a.lines.first().map(length));
    let shortest = lengths.fold(f64::INFINITY, f64::min);
    for (i, (entry, answer)) in answers.iter().enumerate() {
        let (found, over) = match answer.lines.first().map(length) {
            Some(length) => {
                let over = 100.0 * (length / shortest - 1.0);
                (text::number(length), format!("{over:.2}"))
            }
            None => ("-".to_owned(), "-".to_owned()),
        };
        table.add_row([
            if i == 0 { show.name } else { "" },
            &entry.name(),
            answer.outcome,
            &found,
            &over,
            &text::time(answer.stats.elapsed),
        ]);
    }
}
