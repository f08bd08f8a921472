//! What a planner answered, for people and for programs.

use crate::{
    explain,
    failure::{Failure, Status},
    question::{Question, Stated},
    spot::Spot,
    text,
    view::{self, Shown},
};
use pf_core::{Note, Stats, Stop};
pub(crate) use pf_planners::length;
use pf_planners::{Answer, AnyEntry, FAULT, Line, Ruler, Scene};
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
    let at_fault = |note: &Note| note.key == FAULT;
    match answer.outcome {
        _ if answer.stop == Stop::Cancelled => Status::Interrupted,
        _ if answer.notes.iter().any(at_fault) => Status::CheckFailed,
        "infeasible" => Status::NoPath,
        "unknown" => Status::NotFound,
        _ => Status::Done,
    }
}

impl Told<'_> {
    fn line(&self) -> Option<&Line> {
        self.answer.lines.first()
    }

    fn scene(&self) -> &Scene {
        &self.question.scene
    }

    /// What the file says of this question, unless the planner answers another.
    pub(crate) fn stated(&self) -> Option<&Stated> {
        let stated = self.question.stated.as_ref();
        stated.filter(|_| !self.is_converted())
    }

    /// Whether the planner was asked about something that the map was turned into.
    fn is_converted(&self) -> bool {
        self.entry.problem() != self.scene().kind()
    }

    /// Whether the planner came to its end without a path.
    pub(crate) fn has_no_way(&self) -> bool {
        self.answer.lines.is_empty() && self.answer.stop == Stop::Finished
    }

    /// Says why there is no path, and what became of the clearance asked for.
    pub(crate) fn explain(&mut self) {
        if self.answer.outcome == "infeasible" {
            self.notes = explain::why(self.question);
        }
        let robot = self.scene().robot();
        if robot.clearance > 0.0
            && let Some(reached) = self.clearance()
        {
            let (asked, reached) = (robot.clearance, text::number(reached - robot.radius));
            self.notes.push(format!(
                "clearance: asked for {asked}, reached {reached} besides the radius"
            ));
        }
    }

    /// The least distance between the path and an obstacle, in the map's unit; `None` without
    /// either. A path from cell to cell is measured in the cells' middles.
    fn clearance(&self) -> Option<f64> {
        let line = self.line()?;
        Ruler::default().clearance(self.scene(), line, self.is_converted())
    }

    fn all_notes(&self) -> Vec<String> {
        let said = self.answer.notes.iter().map(ToString::to_string);
        said.chain(self.notes.iter().cloned()).collect()
    }

    pub(crate) fn json(&self) -> Json<'_> {
        let answer = &self.answer;
        Json {
            planner: self.entry.key(),
            problem: self.scene().kind(),
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
        let unit = match self.scene() {
            Scene::Grid(_) => " cells",
            Scene::World(_) => "",
        };
        writeln!(out, "{}", self.title())?;
        let mut row = |name: &str, value: &str| writeln!(out, "  {name:<10} {value}");
        row("outcome", meaning(answer))?;
        if let (Some(line), Some(&cost)) = (self.line(), answer.costs.first()) {
            if matches!(self.scene(), Scene::Grid(_)) {
                row("cost", &text::number(cost))?;
            }
            row("length", &format!("{}{unit}", text::number(length(line))))?;
            let stations = match self.scene() {
                Scene::Grid(_) if !self.is_converted() => "cells",
                _ => "points",
            };
            row(
                "path",
                &format!("{} {stations}", text::count(line.len() as u64)),
            )?;
            if let Some(clearance) = self.clearance() {
                let rest = match self.scene().robot().radius {
                    0.0 => String::new(),
                    radius => format!(", {} besides the radius", text::number(clearance - radius)),
                };
                row(
                    "clearance",
                    &format!("{}{unit}{rest}", text::number(clearance)),
                )?;
            }
        }
        row("time", &text::time(answer.stats.elapsed))?;
        row("expanded", &self.expanded())?;
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

    /// How much the planner looked at.
    fn expanded(&self) -> String {
        let what = match self.entry.problem() {
            "grid" => "cell",
            _ => "point",
        };
        let count = self.answer.stats.expanded;
        let many = if count == 1 { "" } else { "s" };
        format!("{} {what}{many}", text::count(count))
    }

    /// Planner, file, size, query.
    pub(crate) fn title(&self) -> String {
        let question = self.question;
        let case = question.case.as_ref().map(|case| format!(", {case}"));
        let [from, to] = view::query(self.scene());
        let (size, rules) = match self.scene() {
            Scene::Grid(scene) => {
                let (width, height) = (scene.map().width(), scene.map().height());
                // Who goes straight makes no moves.
                let moves = if self.is_converted() {
                    String::new()
                } else {
                    format!(", {}", scene.moves())
                };
                (format!("{width} x {height} cells"), moves)
            }
            Scene::World(scene) => {
                let bounds = scene.world().bounds();
                let [min, max] = [bounds.min(), bounds.max()].map(Spot::from);
                let shapes = scene.world().shapes().count();
                let many = if shapes == 1 { "" } else { "s" };
                (
                    format!("{shapes} shape{many} in {min} to {max}"),
                    String::new(),
                )
            }
        };
        let robot = match self.scene().robot() {
            robot if robot.reach() > 0.0 => format!(", {}", explain::size(robot)),
            _ => String::new(),
        };
        format!(
            "{} on {}{}: {size}, {from} to {to}{rules}{robot}",
            self.entry.name(),
            question.file,
            case.unwrap_or_default(),
        )
    }

    /// The map with what was found on it.
    pub(crate) fn picture(&self, shown: &Shown<'_>) -> Picture {
        let (scene, answer) = (self.scene(), &self.answer);
        let mut picture = shown.search(view::ground(scene));
        for line in &answer.lines {
            picture = if shown.clearance {
                view::coloured(picture, scene, line)
            } else {
                view::path(picture, scene, &self.entry.name(), Pen::Solid, line)
            };
        }
        if let Some(line) = &self.nearest {
            picture = view::path(picture, scene, "to the nearest cell", Pen::Dashed, line);
        }
        let cost = match (answer.costs.first(), scene) {
            (Some(&cost), Scene::Grid(_)) if !self.is_converted() => {
                format!("{}, cost {}", answer.outcome, text::number(cost))
            }
            (Some(&length), _) => {
                format!("{}, length {}", answer.outcome, text::number(length))
            }
            (None, _) => answer.outcome.to_owned(),
        };
        let (expanded, seed) = (self.expanded(), self.seed);
        view::ends(picture, scene)
            .caption(self.title())
            .caption(format!("{cost}, {expanded} expanded, seed {seed}"))
    }
}

/// The least distance between a line and the obstacles of a world; infinite if there are none.
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
