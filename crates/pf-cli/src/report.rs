//! What a planner answered, for people and for programs.

use crate::{
    failure::{Failure, Status},
    question::Question,
    text,
};
use pf_core::{Stats, Stop};
use pf_grid::{Cell, Clearance};
use pf_planners::{Answer, AnyEntry, Line, Scene};
use pf_render::{Line as Pen, Picture};
use serde::{Serialize, Serializer};
use std::io::Write;

/// An answer with all that is told of it.
pub(crate) struct Told<'a> {
    pub(crate) entry: &'a dyn AnyEntry,
    pub(crate) question: &'a Question,
    pub(crate) seed: u64,
    pub(crate) answer: Answer,
    /// Besides the planner's notes: why there is no path, what the file expected.
    pub(crate) notes: Vec<String>,
    /// The way to the reachable cell nearest the goal.
    pub(crate) nearest: Option<Line>,
}

/// The object that `--json` prints.
#[derive(Serialize)]
pub(crate) struct Json<'a> {
    planner: &'a str,
    problem: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    case: Option<&'a str>,
    outcome: &'a str,
    stop: &'a str,
    cost: Option<f64>,
    length: Option<f64>,
    path: Vec<Point>,
    clearance: Option<f64>,
    seed: u64,
    notes: Vec<String>,
    stats: JsonStats,
    #[serde(skip_serializing_if = "Option::is_none")]
    nearest_path: Option<Vec<Point>>,
}

#[derive(Serialize)]
struct JsonStats {
    iterations: u64,
    expanded: u64,
    evaluated: u64,
    elapsed_us: f64,
}

/// A point; cells are written as whole numbers.
struct Point([f64; 2]);

impl Serialize for Point {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        if self.0.iter().all(|x| x.fract() == 0.0 && x.abs() < 1e9) {
            #[expect(clippy::cast_possible_truncation, reason = "whole and small")]
            return self.0.map(|x| x as i64).serialize(to);
        }
        self.0.serialize(to)
    }
}

fn points(line: &Line) -> Vec<Point> {
    line.iter().copied().map(Point).collect()
}

impl From<Stats> for JsonStats {
    fn from(stats: Stats) -> Self {
        Self {
            iterations: stats.iterations,
            expanded: stats.expanded,
            evaluated: stats.evaluated,
            elapsed_us: text::micros(stats.elapsed),
        }
    }
}

/// What an answer means for the program's end.
pub(crate) fn status(answer: &Answer) -> Status {
    match answer.outcome {
        _ if answer.stop == Stop::Cancelled => Status::Interrupted,
        "infeasible" => Status::NoPath,
        "unknown" => Status::NotFound,
        _ => Status::Done,
    }
}

/// The length of a line, in cells.
pub(crate) fn length(line: &Line) -> f64 {
    // Straight and diagonal steps apart, so that no rounding adds up.
    let (mut diagonal, mut other) = (0u32, 0.0);
    for pair in line.windows(2) {
        let (dx, dy) = (pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]);
        if dx.abs().total_cmp(&1.0).is_eq() && dy.abs().total_cmp(&1.0).is_eq() {
            diagonal += 1;
        } else {
            other += dx.hypot(dy);
        }
    }
    other + f64::from(diagonal) * std::f64::consts::SQRT_2
}

impl Told<'_> {
    fn line(&self) -> Option<&Line> {
        self.answer.lines.first()
    }

    fn scene(&self) -> &Scene {
        &self.question.scene
    }

    /// The least distance between the path and an obstacle, in cells; `None` without either.
    fn clearance(&self) -> Option<f64> {
        let clearance = Clearance::of(self.scene().map());
        let along = self.line()?.iter().map(|&p| clearance.at(cell(p)));
        along
            .min_by(f64::total_cmp)
            .filter(|least| least.is_finite())
    }

    fn all_notes(&self) -> Vec<String> {
        let said = self.answer.notes.iter().map(ToString::to_string);
        said.chain(self.notes.iter().cloned()).collect()
    }

    pub(crate) fn json(&self) -> Json<'_> {
        let answer = &self.answer;
        Json {
            planner: self.entry.key(),
            problem: self.entry.problem(),
            case: self.question.case.as_deref(),
            outcome: answer.outcome,
            stop: answer.stop.word(),
            cost: answer.costs.first().copied(),
            length: self.line().map(length),
            path: self.line().map(points).unwrap_or_default(),
            clearance: self.clearance(),
            seed: self.seed,
            notes: self.all_notes(),
            stats: answer.stats.into(),
            nearest_path: self.nearest.as_ref().map(points),
        }
    }

    /// The paragraph for people.
    pub(crate) fn tell(&self, out: &mut dyn Write) -> Result<(), Failure> {
        let answer = &self.answer;
        writeln!(out, "{}", self.title())?;
        let mut row = |name: &str, value: &str| writeln!(out, "  {name:<10} {value}");
        row("outcome", meaning(answer))?;
        if let (Some(line), Some(&cost)) = (self.line(), answer.costs.first()) {
            row("cost", &text::number(cost))?;
            row("length", &format!("{} cells", text::number(length(line))))?;
            row("path", &format!("{} cells", text::count(line.len() as u64)))?;
            if let Some(clearance) = self.clearance() {
                row("clearance", &format!("{} cells", text::number(clearance)))?;
            }
        }
        row("time", &text::time(answer.stats.elapsed))?;
        row(
            "expanded",
            &format!("{} cells", text::count(answer.stats.expanded)),
        )?;
        for note in self.all_notes() {
            row("note", &note)?;
        }
        if let Some(line) = &self.nearest {
            let [x, y] = line[line.len() - 1];
            let length = text::number(length(line));
            row(
                "nearest",
                &format!("the path to {x},{y} takes {length} cells"),
            )?;
        }
        Ok(())
    }

    /// Planner, file, size, query.
    pub(crate) fn title(&self) -> String {
        let (scene, question) = (self.scene(), self.question);
        let case = question.case.as_ref().map(|case| format!(", {case}"));
        format!(
            "{} on {}{}: {} x {} cells, {} to {}, {}{}",
            self.entry.name(),
            question.file,
            case.unwrap_or_default(),
            scene.map().width(),
            scene.map().height(),
            scene.from(),
            scene.to(),
            scene.moves(),
            match scene.radius() {
                0.0 => String::new(),
                radius => format!(", radius {radius}"),
            }
        )
    }

    /// The map with what was found on it.
    pub(crate) fn picture(&self, expanded: Option<&[Cell]>) -> Picture {
        let (scene, answer) = (self.scene(), &self.answer);
        let mut picture = ground(scene);
        if let Some(cells) = expanded {
            picture = picture.expanded(cells);
        }
        for line in &answer.lines {
            picture = path(picture, scene, &self.entry.name(), Pen::Solid, line);
        }
        if let Some(line) = &self.nearest {
            picture = path(picture, scene, "to the nearest cell", Pen::Dashed, line);
        }
        let cost = match answer.costs.first() {
            Some(&cost) => format!("{}, cost {}", answer.outcome, text::number(cost)),
            None => answer.outcome.to_owned(),
        };
        let (expanded, seed) = (text::count(answer.stats.expanded), self.seed);
        picture
            .ends(scene.from(), scene.to())
            .caption(self.title())
            .caption(format!("{cost}, {expanded} cells expanded, seed {seed}"))
    }
}

/// A scene's map, with what is too narrow for its robot.
pub(crate) fn ground(scene: &Scene) -> Picture {
    let picture = Picture::of(scene.map());
    if scene.radius() > 0.0 {
        return picture.inflated(scene.map(), scene.inflated());
    }
    picture
}

/// A path through the centres of cells, and what the scene's robot sweeps on it if it is an answer.
pub(crate) fn path(picture: Picture, scene: &Scene, name: &str, pen: Pen, line: &Line) -> Picture {
    let centres: Vec<_> = line.iter().map(|[x, y]| [x + 0.5, y + 0.5]).collect();
    if scene.radius() > 0.0 && pen == Pen::Solid {
        return picture
            .swath(&centres, scene.radius())
            .line(name, pen, &centres);
    }
    picture.line(name, pen, &centres)
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "points of a line on a grid lie in cells"
)]
fn cell([x, y]: [f64; 2]) -> Cell {
    Cell::new(x as u32, y as u32)
}

fn meaning(answer: &Answer) -> &'static str {
    match (answer.outcome, answer.stop) {
        ("optimal", _) => "optimal: proved that no path costs less",
        ("infeasible", _) => "infeasible: proved that there is no path",
        ("feasible", Stop::Finished) => "feasible: a path, not proved to be the best",
        ("feasible", Stop::Cancelled) => "feasible: the best path when it was interrupted",
        ("feasible", _) => "feasible: the best path within the budget",
        (_, Stop::Cancelled) => "unknown: interrupted before a path was found",
        (_, Stop::Finished) => "unknown: found no path, proved nothing",
        _ => "unknown: found no path within the budget",
    }
}

/// One object on one line.
pub(crate) fn line(out: &mut dyn Write, object: &impl Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string(object).map_err(|e| Failure::Internal(e.to_string()))?;
    writeln!(out, "{text}")?;
    Ok(())
}
