//! `pf replan`: a scenario in time.

use crate::{
    args::{PlannerArgs, QuestionArgs},
    failure::{Failure, Status},
    plan::{agrees, draw, one_picture},
    question::{self, Question},
    report::{self, Json, Told},
    text, view, words,
};
use pf_core::CancelToken;
use pf_io::kind_of;
use pf_planners::{AnyEntry, Line, Runner, Scene};
use pf_render::Line as Pen;
use serde::Serialize;
use std::{
    io::{Write, stdout},
    path::PathBuf,
    time::Duration,
};

/// Play the timed changes of a scenario and plan anew after each.
///
/// Event 0 is the first plan. The latency runs from a change to the answer, the change of the
/// planner's own map and a conversion of the scene's included; the upkeep is what the planner does once the answer is out, for the
/// next to come sooner. A case that follows another begins with that one's answer. The exit code
/// tells of the last event.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  pf replan door.toml
  pf replan door.toml --planner astar --json
  pf replan yard-traffic.toml --planner visibility-graph --png traffic.png
  pf replan maps/scenarios/redlarski.toml --case 'maze-100 table 3' --svg maze.svg")]
pub(crate) struct Args {
    /// A scenario file with events, or with cases that follow others
    scenario: PathBuf,
    #[command(flatten)]
    question: QuestionArgs,
    #[command(flatten)]
    planner: PlannerArgs,
    /// Draw the map as it is in the end, with the first path dashed, as SVG
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    svg: Option<PathBuf>,
    /// The same as PNG
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    png: Option<PathBuf>,
    /// Print one JSON object per line and event
    #[arg(long, help_heading = "Output")]
    json: bool,
}

/// The object of an event.
#[derive(Serialize)]
struct EventJson<'a> {
    event: usize,
    at: f64,
    change: &'a str,
    latency_us: f64,
    upkeep_us: f64,
    #[serde(flatten)]
    answer: Json<'a>,
}

/// What happened, for people and programs.
struct Moment {
    event: usize,
    at: f64,
    what: String,
}

pub(crate) fn act(args: &Args, cancel: &CancelToken) -> Result<Status, Failure> {
    let kind = kind_of(&args.scenario)?;
    if !question::is_scenario(kind) {
        let message = format!("{} is no scenario", args.scenario.display());
        let help = "for a path on a map there is `pf plan`";
        return Err(Failure::usage(message).help(help));
    }
    let mut questions = question::cases(&args.scenario, &args.question, true)?;
    if args.question.case.is_none() && questions.len() > 1 {
        questions.retain(|question| !question.events.is_empty());
    }
    let drawing = args.svg.is_some() || args.png.is_some();
    if drawing && questions.len() > 1 {
        return Err(one_picture(&questions));
    }
    let default = if question::is_about_a_world(kind) {
        "visibility-graph"
    } else {
        "d-star-lite"
    };
    let entry = args.planner.entry(default)?;
    let mut runner = args.planner.runner(entry, &[])?;
    let mut worst = Status::Done;
    for question in &mut questions {
        let mut play = Play {
            args,
            entry,
            runner: runner.as_mut(),
            cancel,
        };
        worst = worst.max(play.case(question)?);
        if worst == Status::Interrupted {
            break;
        }
    }
    Ok(worst)
}

struct Play<'a> {
    args: &'a Args,
    entry: &'static dyn AnyEntry,
    runner: &'a mut dyn Runner,
    cancel: &'a CancelToken,
}

impl Play<'_> {
    /// Plays a case from its first plan to its last event.
    fn case(&mut self, question: &mut Question) -> Result<Status, Failure> {
        let events = std::mem::take(&mut question.events);
        let mut moment = Moment {
            event: 0,
            at: 0.0,
            what: "the first plan".to_owned(),
        };
        let answer = self.runner.plan(&question.scene, self.order())?;
        let mut told = self.told(question, answer);
        if !self.args.json {
            header(&told)?;
        }
        let first: Option<Line> = told.answer.lines.first().cloned();
        let mut status = self.tell(&moment, &mut told)?;
        let mut failed = status == Status::CheckFailed;
        let before = question.scene.clone();
        for event in events {
            if self.cancel.is_cancelled() {
                return Ok(Status::Interrupted);
            }
            let words = words::of(&event.changes, &question.names);
            moment = Moment {
                event: moment.event + 1,
                at: event.at,
                what: event
                    .name
                    .map_or(words.clone(), |name| format!("{name}: {words}")),
            };
            let followed = question.scene.change(&event.changes)?;
            let answer = self
                .runner
                .replan(&question.scene, &followed, self.order())?;
            status = self.tell(&moment, &mut self.told(question, answer))?;
            failed |= status == Status::CheckFailed;
        }
        self.picture(question, first.as_ref(), &before)?;
        Ok(if failed { Status::CheckFailed } else { status })
    }

    fn order(&self) -> pf_planners::Order<'static> {
        self.args.planner.order(self.cancel, None)
    }

    fn told<'q>(&self, question: &'q Question, answer: pf_planners::Answer) -> Told<'q> {
        Told {
            entry: self.entry,
            question,
            seed: self.args.planner.seed,
            notes: Vec::new(),
            nearest: None,
            answer,
        }
    }

    /// Lets the planner do its upkeep and tells of an event.
    fn tell(&mut self, moment: &Moment, told: &mut Told<'_>) -> Result<Status, Failure> {
        let upkeep = self.runner.settle(self.order());
        let mut status = report::status(&told.answer);
        told.explain();
        if let Some(stated) = told.stated()
            && told.question.stated_after == moment.event
            && status != Status::Interrupted
            && !agrees(stated, &told.answer)
        {
            let words = format!("expected: the file says {}", stated.words);
            told.notes.push(words);
            if matches!(told.answer.outcome, "optimal" | "infeasible") {
                status = Status::CheckFailed;
            }
        }
        let mut out = stdout().lock();
        if self.args.json {
            let object = EventJson {
                event: moment.event,
                at: moment.at,
                change: &moment.what,
                latency_us: text::micros(told.answer.latency),
                upkeep_us: text::micros(upkeep),
                answer: told.json(),
            };
            report::line(&mut out, &object)?;
        } else {
            row(&mut out, moment, told, upkeep)?;
        }
        Ok(status)
    }

    /// The map as it is now, and what became of it; the last answer is planned once more, for a
    /// picture has time.
    fn picture(
        &mut self,
        question: &Question,
        first: Option<&Line>,
        before: &Scene,
    ) -> Result<(), Failure> {
        let (svg, png) = (self.args.svg.as_deref(), self.args.png.as_deref());
        if svg.is_none() && png.is_none() {
            return Ok(());
        }
        let scene = &question.scene;
        let answer = self.runner.plan(scene, self.order())?;
        let mut picture = view::changed(view::ground(scene), before, scene);
        if let Some(line) = first {
            picture = view::path(picture, scene, "at first", Pen::Dashed, line);
        }
        if let Some(line) = answer.lines.first() {
            picture = view::path(picture, scene, "in the end", Pen::Solid, line);
        }
        let told = self.told(question, answer);
        let picture = view::ends(picture, scene);
        draw(&picture.caption(told.title()), svg, png)
    }
}

fn header(told: &Told<'_>) -> Result<(), Failure> {
    let mut out = stdout().lock();
    writeln!(out, "{}", told.title())?;
    writeln!(
        out,
        "{:>5} {:>7}  {:<10} {:>10} {:>9} {:>9} {:>12}  change",
        "event", "at", "outcome", "cost", "latency", "upkeep", "expanded"
    )?;
    Ok(())
}

fn row(
    out: &mut dyn Write,
    moment: &Moment,
    told: &Told<'_>,
    upkeep: Duration,
) -> Result<(), Failure> {
    let answer = &told.answer;
    let cost = answer
        .costs
        .first()
        .map_or("-".to_owned(), |&cost| text::number(cost));
    let mut what = moment.what.clone();
    for note in &told.notes {
        what = format!("{what}; {note}");
    }
    writeln!(
        out,
        "{:>5} {:>7}  {:<10} {cost:>10} {:>9} {:>9} {:>12}  {what}",
        moment.event,
        moment.at,
        answer.outcome,
        text::time(answer.latency),
        text::time(upkeep),
        text::count(answer.stats.expanded),
    )?;
    Ok(())
}
