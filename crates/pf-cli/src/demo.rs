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
use pf_grid::{Cell, Grid, Moves};
use pf_io::{FileError, Unknown, parse_movingai, parse_ros};
use pf_planners::{Answer, AnyEntry, GridScene, Order, Robot, all};
use pf_render::Recorder;
use std::{
    fs,
    io::{Write, stdout},
    path::PathBuf,
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

/// A map that the program carries, and a question worth asking on it.
struct Show {
    name: &'static str,
    map: fn() -> Result<Grid, FileError>,
    from: Cell,
    to: Cell,
    moves: Moves,
    radius: f64,
}

macro_rules! carried {
    ($path:literal) => {
        include_bytes!(concat!("../../../maps/grids/", $path))
    };
}

const SHOWS: &[Show] = &[
    Show {
        name: "office",
        map: || {
            let yaml = parse_ros("office.yaml", carried!("office.yaml"))?;
            yaml.grid("office.pgm", carried!("office.pgm"), Unknown::Blocked)
        },
        from: Cell::new(324, 278),
        to: Cell::new(40, 248),
        moves: Moves::OnlyWhenNoObstacles,
        radius: 3.0,
    },
    Show {
        name: "maze",
        map: || parse_movingai("maze", carried!("redlarski/maze-100.map")),
        from: Cell::new(0, 0),
        to: Cell::new(99, 99),
        moves: Moves::Always,
        radius: 0.0,
    },
    Show {
        name: "mosaic",
        map: || parse_movingai("mosaic", carried!("redlarski/mosaic-100.map")),
        from: Cell::new(2, 54),
        to: Cell::new(97, 54),
        moves: Moves::Always,
        radius: 0.0,
    },
];

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
        let question = show.question()?;
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
    fn question(&self) -> Result<Question, Failure> {
        let scene = GridScene::new((self.map)()?, self.from, self.to)?
            .with_moves(self.moves)
            .with_robot(Robot::of_radius(self.radius))?;
        Ok(Question::of(self.name, scene))
    }

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
        let order = |recorder| Order {
            seed: 0,
            budget: Budget::unlimited().cancel(cancel),
            recorder,
        };
        let mut answer = runner.plan(&question.scene, order(None))?;
        for _ in 1..REPETITIONS {
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
