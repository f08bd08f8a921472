//! `bench walk`: what a step of the bees costs, however long the walk and however large the world.
//!
//! A step is timed at places of a made-up world, observation included: a colony that remembers so
//! and so many places decides there what to do next. Allocations are counted by the program beside.

use crate::{
    Counter, beside,
    protocol::{json, say, timed},
    worlds,
};
use anyhow::{Context as _, Result};
use pf_abc::{AbcParams, Colony};
use pf_conformance::seeded;
use pf_core::{Context, LocalPlanner, Observable, PlanRng};
use pf_geom::{Observation, Point, Vector, World, WorldProblem};
use rand::RngExt;
use serde::{Deserialize, Serialize};

#[derive(clap::Args)]
pub(crate) struct Args {
    /// How many places a step is timed at
    #[arg(long, default_value_t = 200, value_parser = clap::value_parser!(u32).range(1..))]
    places: u32,
    /// How often all are timed, in turn; the least time of each counts
    #[arg(long, default_value_t = 7, value_parser = clap::value_parser!(u32).range(1..))]
    rounds: u32,
    /// Seed of worlds and places
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// One JSON object a line
    #[arg(long)]
    json: bool,
}

/// A row: times by the first row of its kind.
#[derive(Serialize)]
struct Row {
    suite: &'static str,
    case: String,
    median_us: f64,
    ratio: f64,
    target: f64,
}

/// What the program beside counts.
#[derive(Deserialize, Serialize)]
struct Count {
    steps: u32,
    first: u64,
    others: u64,
}

const VISITED: [u32; 5] = [10, 100, 1000, 10_000, 100_000];
const OBSTACLES: [u32; 4] = [10, 100, 1000, 10_000];

/// A colony that stands somewhere, and where it is asked.
struct Contender {
    name: String,
    problem: WorldProblem,
    colony: Colony,
    places: Vec<Point>,
    least: Vec<f64>,
}

impl Contender {
    fn new(name: String, problem: WorldProblem, places: Vec<Point>) -> Result<Self> {
        Ok(Self {
            name,
            problem,
            colony: Colony::new(AbcParams {
                steps: u64::MAX,
                ..AbcParams::default()
            })?,
            least: vec![f64::INFINITY; places.len()],
            places,
        })
    }

    /// A step at every place, from the same memory each round.
    fn round(&mut self) {
        let sensor = LocalPlanner::<WorldProblem>::sensor(&self.colony);
        let mut seen = Observation::default();
        let mut cx = Context::seeded(7);
        self.colony.reset();
        for (place, least) in self.places.iter().zip(&mut self.least) {
            let (time, _) = timed(|| {
                self.problem.observe(place, &sensor, &mut seen);
                self.colony.step(&seen, &mut cx)
            });
            *least = least.min(time.as_secs_f64() * 1e6);
        }
    }

    fn median(&self) -> f64 {
        let mut sorted = self.least.clone();
        sorted.sort_by(f64::total_cmp);
        sorted[sorted.len() / 2]
    }
}

pub(crate) fn run(args: &Args, counter: Option<Counter>) -> Result<()> {
    if let Some(counter) = counter {
        return count(args, counter);
    }
    let groups = [
        (by_visited(args)?, 1.2),
        (by_visited_again(args)?, 1.2),
        (by_obstacles(args)?, 2.0),
    ];
    if !args.json {
        let heads = ["case", "median us", "ratio", "target"];
        say(format_args!(
            "{:<44} {:>10} {:>7} {:>7}",
            heads[0], heads[1], heads[2], heads[3]
        ))?;
    }
    for (mut group, target) in groups {
        for _ in 0..args.rounds {
            group.iter_mut().for_each(Contender::round);
        }
        let first = group.first().map_or(f64::NAN, Contender::median);
        for contender in &group {
            let row = Row {
                suite: "walk",
                case: contender.name.clone(),
                median_us: contender.median(),
                ratio: contender.median() / first,
                target,
            };
            if args.json {
                json(&row)?;
                continue;
            }
            say(format_args!(
                "{:<44} {:>10.2} {:>7.3} {:>7}",
                row.case, row.median_us, row.ratio, row.target
            ))?;
        }
    }
    match ask() {
        Some(count) if args.json => json(&count),
        Some(Count {
            steps,
            first,
            others,
        }) => say(format_args!(
            "allocations: {first} in the first step, {others} in the {steps} after it"
        )),
        None => say("allocations were not counted: pf-bench-allocations is not beside"),
    }
}

/// A world of so many shapes that keep apart, at one density, and free places away from its border.
fn scene(args: &Args, obstacles: u32) -> Result<(WorldProblem, Vec<Point>)> {
    let mut rng = seeded(args.seed);
    let bounds = worlds::square(obstacles);
    let world = World::with_shapes(bounds, worlds::shapes(&mut rng, obstacles, true));
    let goal = bounds.max();
    let problem = WorldProblem::new(world, 0.0, bounds.min(), goal)?;
    let margin = Vector::repeat(4.0);
    let (low, high) = (bounds.min() + margin, bounds.max() - margin);
    let anywhere = |rng: &mut PlanRng| {
        let x = rng.random_range(low.x..high.x);
        Point::new(x, rng.random_range(low.y..high.y))
    };
    let mut places = Vec::new();
    while places.len() < args.places as usize {
        let place = anywhere(&mut rng);
        // With something in sight.
        let near = problem.world().clearance_at(place);
        if problem.is_free(place, place) && near < 2.0 {
            places.push(place);
        }
    }
    Ok((problem, places))
}

/// A long winding way whose end is where the robot stands now.
fn by_visited(args: &Args) -> Result<Vec<Contender>> {
    let (problem, places) = scene(args, 100)?;
    let contender = |count: u32| {
        let name = format!("{count} places visited, all over");
        let mut it = Contender::new(name, problem.clone(), places.clone())?;
        let side = f64::from(count).sqrt().ceil() * 2.0;
        let row = (side / 2.0).max(1.0);
        let way: Vec<_> = (0..count)
            .map(|k| {
                let (y, x) = ((f64::from(k) / row).floor(), f64::from(k) % row);
                Point::new(50.0 - row + 2.0 * x, 50.0 - row + 2.0 * y)
            })
            .collect();
        it.colony.recall(&way, &[]);
        Ok(it)
    };
    VISITED.into_iter().map(contender).collect()
}

/// The same places again and again.
fn by_visited_again(args: &Args) -> Result<Vec<Contender>> {
    let (problem, places) = scene(args, 100)?;
    let contender = |count: u32| {
        let name = format!("{count} places visited, in a square of 20");
        let mut it = Contender::new(name, problem.clone(), places.clone())?;
        let mut rng = seeded(args.seed + 1);
        let mut along = || rng.random_range(40.0..60.0);
        let way: Vec<_> = (0..count).map(|_| Point::new(along(), along())).collect();
        it.colony.recall(&way, &[]);
        Ok(it)
    };
    VISITED.into_iter().map(contender).collect()
}

fn by_obstacles(args: &Args) -> Result<Vec<Contender>> {
    let contender = |count: u32| {
        let (problem, places) = scene(args, count)?;
        Contender::new(format!("{count} obstacles"), problem, places)
    };
    OBSTACLES.into_iter().map(contender).collect()
}

/// What the first step and all steps after it take of the allocator, in a walk on the paper's second
/// map, of rectangles, from place to place without ever arriving.
fn count(args: &Args, counter: Counter) -> Result<()> {
    let text = include_bytes!("../../../maps/worlds/cabc-2.toml");
    let file = pf_io::parse_world("cabc-2.toml", text)?;
    let robot = file.robots.first().context("the map has a robot")?;
    let map = WorldProblem::new(file.world.clone(), robot.radius, robot.start, robot.goal)?;
    let mut colony = Colony::new(AbcParams {
        steps: u64::MAX,
        ..AbcParams::default()
    })?;
    let sensor = LocalPlanner::<WorldProblem>::sensor(&colony);
    let mut seen = Observation::default();
    let mut cx = Context::seeded(args.seed);
    let mut at = map.start();
    let mut step = || {
        map.observe(&at, &sensor, &mut seen);
        if let pf_core::Step::To(next) = colony.step(&seen, &mut cx) {
            at = if next == map.goal() {
                map.start()
            } else {
                next
            };
        }
    };
    let steps = 100_000;
    let first = counter(&mut step).allocations;
    let others = counter(&mut || (0..steps).for_each(|_| step())).allocations;
    json(&Count {
        steps,
        first,
        others,
    })
}

fn ask() -> Option<Count> {
    serde_json::from_str(beside::said()?.lines().next()?).ok()
}
