//! `pf walk`: a robot that sees what is near, in a world that it does not know and that changes.

use crate::{
    args::{PlannerArgs, QuestionArgs},
    failure::{Failure, Status},
    plan::draw,
    question::{self, Happening, Question},
    report, text, view, words,
};
use pf_abc::{AbcParams, Colony};
use pf_core::{CancelToken, Context, Outcome, Params, Trace, Walk, Walked as End};
use pf_geom::{Point, Shape, World, WorldChange, WorldProblem};
use pf_io::{AnyScenario, TimeUnit, load_scenario};
use pf_planners::{Changes, Line, Scene};
use pf_render::{Line as Pen, Picture};
use serde::Serialize;
use std::{
    collections::VecDeque,
    io::{Write, stdout},
    path::{Path, PathBuf},
};

/// Walk a robot through a world it does not know, step by step, while things happen there.
///
/// At each step bees look for the best place in the square that the robot sees (--set half=H says how far),
/// and the robot goes there. The events of a scenario happen at their steps: at 3 the robot has decided
/// three times. Each step is judged in the world of its time.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  pf walk maps/worlds/cabc-2.toml
  pf walk maps/scenarios/busy-square.toml --seed 3 --png walk.png
  pf walk maps/worlds/cabc-2.toml --set memory=0 --set steps=400 --json")]
pub(crate) struct Args {
    /// A world, or a scenario in one
    world: PathBuf,
    #[command(flatten)]
    question: QuestionArgs,
    #[command(flatten)]
    planner: PlannerArgs,
    /// Draw the way over the world as it is in the end, with what stood there before, as SVG
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    svg: Option<PathBuf>,
    /// The same as PNG
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    png: Option<PathBuf>,
    /// Print one JSON object on one line
    #[arg(long, help_heading = "Output")]
    json: bool,
}

/// The object that `--json` prints.
#[derive(Serialize)]
struct Json<'a> {
    planner: &'a str,
    problem: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    case: Option<&'a str>,
    outcome: &'a str,
    stop: &'a str,
    length: f64,
    steps: u64,
    evaluated: u64,
    path: Vec<[f64; 2]>,
    seed: u64,
    events: &'a [Told],
    notes: &'a [String],
}

/// An event that happened.
#[derive(Serialize)]
struct Told {
    step: u64,
    change: String,
}

/// A walk with all that is told of it.
pub(crate) struct Walked<'a> {
    planner: &'a PlannerArgs,
    question: &'a Question,
    pub(crate) end: End,
    stop: &'static str,
    steps: u64,
    evaluated: u64,
    pub(crate) trail: Vec<Point>,
    told: Vec<Told>,
    notes: Vec<String>,
    /// From which step on the world was so.
    pub(crate) worlds: Vec<(u64, Scene)>,
    /// How long the trail was at the start and after each step.
    pub(crate) places: Vec<usize>,
    /// The scene as it is in the end.
    scene: Scene,
    /// Every obstacle wherever it stood at some time.
    stood: Vec<Shape>,
}

pub(crate) fn act(args: &Args, cancel: &CancelToken) -> Result<Status, Failure> {
    let params = params(&args.planner)?;
    let question = question::one(&args.world, &args.question)?;
    if !matches!(question.scene, Scene::World(_)) {
        return Err(question::no_world(&args.world));
    }
    check_events(&args.world, &question)?;
    let walked = walk(&args.planner, &question, params, cancel, None)?;
    let mut out = stdout().lock();
    if args.json {
        report::line(&mut out, &walked.json())?;
    } else {
        walked.tell(&mut out)?;
    }
    let (svg, png) = (args.svg.as_deref(), args.png.as_deref());
    if svg.is_some() || png.is_some() {
        draw(&walked.picture()?, svg, png)?;
    }
    walked.status(cancel)
}

pub(crate) fn params(planner: &PlannerArgs) -> Result<AbcParams, Failure> {
    let entry = planner.entry("abc")?;
    if entry.key() != "abc" {
        let message = format!("--planner: {} wants to see the whole world", entry.key());
        return Err(Failure::usage(message).help("who sees only what is near is abc"));
    }
    let mut params = AbcParams::default();
    for (key, value) in &planner.settings {
        let set = params.set(key, value);
        set.map_err(|error| Failure::usage(format!("--set: {error}")))?;
    }
    Ok(params)
}

/// Events in steps, none of which carries the robot away.
pub(crate) fn check_events(world: &Path, question: &Question) -> Result<(), Failure> {
    if question.events.is_empty() {
        return Ok(());
    }
    let seconds = match load_scenario(world)? {
        AnyScenario::Grid(scenario) => scenario.time == TimeUnit::Seconds,
        AnyScenario::World(scenario) => scenario.time == TimeUnit::Seconds,
    };
    if seconds {
        let message = format!("{} counts seconds, a walk steps", world.display());
        return Err(Failure::usage(message).help("time = \"steps\""));
    }
    let carries = |happening: &&Happening| match &happening.changes {
        Changes::World(changes) => changes
            .iter()
            .any(|change| matches!(change, WorldChange::StartMoved(_))),
        Changes::Grid(_) => false,
    };
    if let Some(event) = question.events.iter().find(carries) {
        let at = event.at;
        let message = format!("the event at {at} puts the robot elsewhere, and it is walking");
        return Err(
            Failure::usage(message).help("`pf replan` plays scenarios that say where it is")
        );
    }
    Ok(())
}

pub(crate) fn walk<'a>(
    planner: &'a PlannerArgs,
    question: &'a Question,
    params: AbcParams,
    cancel: &CancelToken,
    trace: Option<&mut dyn Trace<WorldProblem>>,
) -> Result<Walked<'a>, Failure> {
    let settings = |error| Failure::usage(format!("--set: {error}"));
    let mut colony = Colony::new(params).map_err(settings)?;
    let order = planner.order(cancel, None);
    let mut cx: Context<'_, WorldProblem> = Context::seeded(order.seed).within(order.budget);
    if let Some(trace) = trace {
        cx = cx.traced(trace);
    }
    let (mut worlds, mut places) = (vec![(0, question.scene.clone())], vec![1]);
    let mut scene = question.scene.clone();
    let mut events: VecDeque<&Happening> = question.events.iter().collect();
    let mut told = Vec::new();
    let mut steps: u64 = 0;
    let mut stood = Vec::new();
    stand(&mut stood, problem(&scene)?.world());
    let mut walk = Walk::begin(&mut colony, problem(&scene)?);
    let end = loop {
        #[expect(clippy::cast_precision_loss, reason = "a number of steps")]
        while let Some(event) = events.pop_front_if(|event| event.at <= steps as f64) {
            scene.change(&event.changes)?;
            worlds.push((steps, scene.clone()));
            stand(&mut stood, problem(&scene)?.world());
            let change = words::of(&event.changes, &question.names);
            told.push(Told {
                step: steps,
                change: match &event.name {
                    Some(name) => format!("{name}: {change}"),
                    None => change,
                },
            });
        }
        if !cx.proceed() {
            break End::On;
        }
        match walk.step(problem(&scene)?, &mut cx) {
            End::On => steps += 1,
            end => break end,
        }
        places.push(walk.trail().len());
    };
    let trail = walk.into_trail();
    let attempt = Some(trail.clone());
    let report = cx.report(Outcome::Unknown { attempt });
    Ok(Walked {
        planner,
        question,
        end,
        stop: report.stop.word(),
        steps,
        evaluated: report.stats.evaluated,
        trail,
        told,
        notes: report.notes.iter().map(ToString::to_string).collect(),
        worlds,
        places,
        scene,
        stood,
    })
}

/// Adds what stands where nothing like it has stood.
fn stand(stood: &mut Vec<Shape>, world: &World) {
    for (_, shape) in world.shapes() {
        if !stood.contains(shape) {
            stood.push(shape.clone());
        }
    }
}

fn problem(scene: &Scene) -> Result<&WorldProblem, Failure> {
    match scene {
        Scene::World(scene) => Ok(scene.problem()),
        Scene::Grid(_) => Err(Failure::Internal("a grid".to_owned())),
    }
}

impl Walked<'_> {
    pub(crate) fn status(&self, cancel: &CancelToken) -> Result<Status, Failure> {
        match self.end {
            End::Arrived => Ok(Status::Done),
            End::Refused => Err(Failure::Internal("a step was not as was seen".to_owned())),
            End::On if cancel.is_cancelled() => Ok(Status::Interrupted),
            End::On | End::GaveUp => Ok(Status::NotFound),
        }
    }

    fn line(&self) -> Line {
        self.trail.iter().map(|p| [p.x, p.y]).collect()
    }

    fn json(&self) -> Json<'_> {
        Json {
            planner: "abc",
            problem: "world",
            case: self.question.case.as_deref(),
            outcome: if self.end == End::Arrived {
                "feasible"
            } else {
                "unknown"
            },
            stop: self.stop,
            length: report::length(&self.line()),
            steps: self.steps,
            evaluated: self.evaluated,
            path: self.line(),
            seed: self.planner.seed,
            events: &self.told,
            notes: &self.notes,
        }
    }

    fn title(&self) -> String {
        let [from, to] = view::query(&self.question.scene);
        let case = self.question.case.as_ref();
        format!(
            "cABC on {}{}: {from} to {to}, world unknown",
            self.question.file,
            case.map(|case| format!(", {case}")).unwrap_or_default(),
        )
    }

    pub(crate) fn end(&self) -> String {
        let words = match self.end {
            End::Arrived => "arrived",
            End::GaveUp => "gave up",
            End::Refused => "stopped at a step that cannot be made",
            End::On => "out of budget",
        };
        let length = text::number(report::length(&self.line()));
        format!("{words} after {} steps, length {length}", self.steps)
    }

    fn tell(&self, out: &mut dyn Write) -> Result<(), Failure> {
        writeln!(out, "{}", self.title())?;
        for Told { step, change } in &self.told {
            writeln!(out, "  at {step:<7} {change}")?;
        }
        writeln!(out, "  {:<10} {}", "walk", self.end())?;
        writeln!(
            out,
            "  {:<10} {} places",
            "evaluated",
            text::count(self.evaluated)
        )?;
        for note in &self.notes {
            writeln!(out, "  {note}")?;
        }
        Ok(())
    }

    fn picture(&self) -> Result<Picture, Failure> {
        let world = problem(&self.scene)?.world();
        let ever = World::with_shapes(*world.bounds(), self.stood.iter().cloned());
        let mut now = ever.clone();
        for (id, shape) in ever.shapes() {
            if !world.shapes().any(|(_, other)| other == shape) {
                now.remove(id)?;
            }
        }
        let picture = view::ground(&self.scene).shapes_changed(&ever, &now);
        let picture = view::path(picture, &self.scene, "walked", Pen::Solid, &self.line());
        Ok(view::ends(picture, &self.scene)
            .caption(self.title())
            .caption(format!("{}, {} events", self.end(), self.told.len())))
    }
}
