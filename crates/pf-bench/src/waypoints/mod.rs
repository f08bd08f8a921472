//! `bench waypoints`: plans and replans by waypoints, and what they are made of.
//!
//! On the three maps of the paper on L-BFGS all contenders answer in turn, hundreds of times; a
//! contender's least time counts. Beside each time stands the paper's loss of the answer, its
//! obstacles at weight 32.

mod argmin_peer;
mod replans;

use crate::protocol::{json, say, timed};
use anyhow::{Context as _, Result};
use argmin_peer::{Inner, minimise};
use pf_core::{Context, Planner, Problem, Replanner, Report};
use pf_geom::{Point, Rectangle, Vector, World, WorldChange, WorldProblem};
use pf_lbfgs::{Lbfgs, LbfgsParams, Obstacles, PaperLoss, plain};
use pf_pso::{Pso, PsoParams};
use serde::Serialize;
use std::{cell::RefCell, path::PathBuf, time::Duration};

#[derive(clap::Args)]
pub(crate) struct Args {
    /// Where the paper's three maps are
    #[arg(long, value_name = "DIR", default_value = "maps/worlds")]
    maps: PathBuf,
    /// How often each contender answers
    #[arg(long, default_value_t = 300, value_parser = clap::value_parser!(u32).range(1..))]
    rounds: u32,
    /// How many replans in a row
    #[arg(long, default_value_t = 1000)]
    steps: u32,
    /// One JSON object a line
    #[arg(long)]
    json: bool,
}

/// One line of the answer.
#[derive(Serialize)]
struct Row {
    suite: &'static str,
    case: String,
    planner: String,
    queries: usize,
    mean_us: f64,
    median_us: f64,
    p95_us: f64,
    mismatches: u64,
    /// What ours takes of the other's time.
    #[serde(skip_serializing_if = "Option::is_none")]
    ratio: Option<f64>,
    /// What it should take at most.
    #[serde(skip_serializing_if = "Option::is_none")]
    target: Option<f64>,
    /// The paper's loss of the answer.
    #[serde(skip_serializing_if = "Option::is_none")]
    loss: Option<f64>,
}

impl Row {
    /// From the times of one contender in microseconds.
    fn of(case: &str, planner: &str, mut micros: Vec<f64>) -> Self {
        micros.sort_by(f64::total_cmp);
        #[expect(clippy::cast_precision_loss, reason = "a number of queries")]
        let count = micros.len().max(1) as f64;
        let at = |of: usize, share: usize| micros.get((of - 1) * share / 100).copied();
        let quantile = |share| at(micros.len().max(1), share).unwrap_or(f64::NAN);
        Self {
            suite: "waypoints",
            case: case.to_owned(),
            planner: planner.to_owned(),
            queries: micros.len(),
            mean_us: micros.iter().sum::<f64>() / count,
            median_us: quantile(50),
            p95_us: quantile(95),
            mismatches: 0,
            ratio: None,
            target: None,
            loss: None,
        }
    }

    fn beside(mut self, others: f64, target: Option<f64>) -> Self {
        self.ratio = Some(self.median_us / others);
        self.target = target;
        self
    }

    fn with_loss(mut self, loss: f64) -> Self {
        self.loss = Some(loss);
        self
    }
}

fn tell(args: &Args, row: &Row) -> Result<()> {
    if args.json {
        return json(row);
    }
    let show = |v: Option<f64>| v.map_or(String::new(), |v| format!("{v:.3}"));
    say(format_args!(
        "{:<34} {:<38} {:>8} {:>10.3} {:>10.3} {:>7} {:>7} {:>10} {:>5}",
        row.case,
        row.planner,
        row.queries,
        row.median_us,
        row.p95_us,
        show(row.ratio),
        show(row.target),
        show(row.loss),
        row.mismatches
    ))
}

pub(crate) fn run(args: &Args) -> Result<()> {
    if !args.json {
        say(format_args!(
            "{:<34} {:<38} {:>8} {:>10} {:>10} {:>7} {:>7} {:>10} {:>5}",
            "case", "what", "queries", "median us", "p95 us", "ratio", "target", "loss", "wrong"
        ))?;
    }
    // The reference's times in Python on its authors' terms, in microseconds.
    for (map, python) in [("toy", 56_000.0), ("curved", 156_000.0), ("maze", 58_000.0)] {
        evaluations(args, map)?;
        plans(args, map, python)?;
    }
    swarms(args)?;
    replans::run(args)
}

/// Rectangles and ends of one of the paper's maps.
struct Map {
    bounds: Rectangle,
    shapes: Vec<pf_geom::Shape>,
    start: Point,
    goal: Point,
}

impl Map {
    fn load(args: &Args, name: &str) -> Result<Self> {
        let file = args.maps.join(format!("kim-{name}.toml"));
        let loaded = pf_io::read_world(&file).with_context(|| file.display().to_string())?;
        let robot = loaded.robots.first().context("no robot")?;
        Ok(Self {
            bounds: *loaded.world.bounds(),
            shapes: loaded.world.shapes().map(|(_, s)| s.clone()).collect(),
            start: robot.start,
            goal: robot.goal,
        })
    }

    /// A world nobody has seen.
    fn problem(&self) -> Result<WorldProblem> {
        let world = World::with_shapes(self.bounds, self.shapes.clone());
        Ok(WorldProblem::new(world, 0.0, self.start, self.goal)?)
    }
}

fn solution(report: &Report<WorldProblem>) -> Option<Vec<f64>> {
    let best = report.outcome.solved()?;
    Some(plain(&best.solution))
}

fn loss_of(loss: &PaperLoss, path: Option<&[f64]>) -> f64 {
    path.map_or(f64::NAN, |path| {
        loss.evaluate(path, 32.0, &mut vec![0.0; path.len()])
    })
}

/// One evaluation of the loss and its gradient.
fn evaluations(args: &Args, map: &str) -> Result<()> {
    let problem = Map::load(args, map)?.problem()?;
    let loss = PaperLoss::new(&problem, 2.0);
    let mut planner = Lbfgs::new(LbfgsParams::paper())?;
    let mut visited = Vec::new();
    let mut listen = |event: &pf_core::Event<'_, WorldProblem>| {
        if let pf_core::Event::Candidate(path) = event {
            visited.push(plain(path));
        }
    };
    planner.plan(&problem, &mut Context::seeded(0).traced(&mut listen))?;
    let mut gradient = vec![0.0; visited[0].len()];
    let mut times = [vec![], vec![]];
    for path in &visited {
        let mut least = [f64::INFINITY; 2];
        for _ in 0..20 {
            for (lanes, least) in least.iter_mut().enumerate() {
                let (time, _) = timed(|| {
                    let mut sum = 0.0;
                    for _ in 0..50 {
                        let path = std::hint::black_box(&path[..]);
                        sum += if lanes == 1 {
                            loss.evaluate(path, 32.0, &mut gradient)
                        } else {
                            loss.evaluate_one_by_one(path, 32.0, &mut gradient)
                        };
                    }
                    sum
                });
                *least = least.min(micros(time) / 50.0);
            }
        }
        for (times, least) in times.iter_mut().zip(least) {
            times.push(least);
        }
    }
    let [single, lanes] = times;
    let case = format!("{map}, an evaluation");
    let single = Row::of(&case, "one sample at a time", single);
    let others = single.median_us;
    tell(args, &single)?;
    tell(
        args,
        &Row::of(&case, "four samples at a time", lanes).beside(others, Some(0.55)),
    )
}

fn micros(time: Duration) -> f64 {
    time.as_secs_f64() * 1e6
}

/// Cold plans, each in a world that nobody has seen, and warm ones.
fn plans(args: &Args, name: &str, python: f64) -> Result<()> {
    let map = Map::load(args, name)?;
    let loss = PaperLoss::new(&map.problem()?, 2.0);
    let potential = LbfgsParams {
        obstacles: Obstacles::Potential,
        ..LbfgsParams::default()
    };
    let mut paper = Lbfgs::new(LbfgsParams::paper())?;
    let mut code = Lbfgs::new(LbfgsParams::published_code())?;
    let mut ours = Lbfgs::new(potential.clone())?;
    let mut hinge = Lbfgs::default();
    let mut warm = Lbfgs::new(potential)?;
    let mut moving = map.problem()?;
    warm.plan(&moving, &mut Context::seeded(0))?;
    let by = Vector::new(-0.6, 0.3);
    let first = paper.plan(&map.problem()?, &mut Context::seeded(0))?;
    let iterations = first.stats.iterations;
    let line = plain(&straight(map.start, map.goal, 20));
    let inner = Inner {
        loss: &loss,
        lambda: 32.0,
        scratch: RefCell::new((line.clone(), line.clone())),
    };
    let mut times: [Vec<f64>; 6] = Default::default();
    let mut losses = [f64::NAN; 6];
    for round in 0..args.rounds {
        let problem = map.problem()?;
        let planners = [&mut paper, &mut code, &mut ours, &mut hinge];
        for (k, planner) in planners.into_iter().enumerate() {
            let (time, report) = timed(|| planner.plan(&problem, &mut Context::seeded(0)));
            times[k].push(micros(time));
            losses[k] = loss_of(&loss, solution(&report?).as_deref());
        }
        let sign = if round % 2 == 0 { 1.0 } else { -1.0 };
        let moved = [WorldChange::GoalMoved(moving.goal() + by * sign)];
        let revision = moving.revise(&moved)?;
        let (time, report) = timed(|| warm.replan(&revision, &mut Context::seeded(0)));
        times[4].push(micros(time));
        losses[4] = loss_of(&loss, solution(&report?).as_deref());
        let (time, found) = timed(|| minimise(&inner, &line, iterations));
        times[5].push(micros(time));
        losses[5] = found.unwrap_or(f64::NAN);
    }
    let [paper, code, ours, hinge, warm, theirs] = times;
    let case = format!("{name}, a plan");
    let theirs = Row::of(&case, "argmin::LBFGS, as many iterations", theirs).with_loss(losses[5]);
    let others = theirs.median_us;
    tell(args, &theirs)?;
    for (name, times, loss, target) in [
        ("lbfgs, the paper's rules", paper, losses[0], Some(0.5)),
        ("lbfgs, the published code's rules", code, losses[1], None),
        (
            "lbfgs, ours on the paper's loss",
            ours,
            losses[2],
            Some(0.5),
        ),
        ("lbfgs, ours", hinge, losses[3], None),
        (
            "lbfgs, ours, a replan, goal moved 0.7",
            warm,
            losses[4],
            Some(0.3),
        ),
    ] {
        let published = name.contains("published");
        let row = Row::of(&case, name, times)
            .with_loss(loss)
            .beside(others, target);
        let median = row.median_us;
        tell(args, &row)?;
        if published && !args.json {
            say(format_args!(
                "{:>73} the paper's Python takes {:.0}x as long",
                "",
                python / median
            ))?;
        }
    }
    Ok(())
}

fn straight(start: Point, goal: Point, inner: u32) -> Vec<Point> {
    let at = |k: u32| start + (goal - start) * (f64::from(k) / f64::from(inner + 1));
    (0..=inner + 1).map(at).collect()
}

/// Plans of swarms by their size.
fn swarms(args: &Args) -> Result<()> {
    let sizes = [1, 10, 20, 40];
    let mut times = sizes.map(|_| vec![]);
    for scene in 0..u64::from(args.rounds) {
        let problem = pf_conformance::world::quadrant_scene(scene, scene % 2 == 0, scene / 10);
        for (particles, times) in sizes.into_iter().zip(&mut times) {
            let mut planner = Pso::new(PsoParams {
                particles,
                ..PsoParams::default()
            })?;
            let (time, report) = timed(|| planner.plan(&problem, &mut Context::seeded(scene)));
            report?;
            times.push(micros(time));
        }
    }
    let mut others = None;
    for (particles, times) in sizes.into_iter().zip(times).rev() {
        let row = Row::of(
            "one obstacle",
            &format!("pso, {particles} particles"),
            times,
        );
        let others = *others.get_or_insert(row.median_us);
        tell(args, &row.beside(others, None))?;
    }
    Ok(())
}
