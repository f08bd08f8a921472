//! *Waypoint-Based Path Planning for Autonomous Robots with PSO*: one obstacle between start and goal,
//! swarms of 1, 10 and 20 particles.
//!
//! The paper's 240 runs, and a thousand scenes for each format of obstacle and number of particles.

mod figures;

pub use figures::figures;

use crate::{
    PaperError,
    row::{Numbers, Row},
    statistics::{Spread, wilson},
};
use pf_classic::VisibilityGraph;
use pf_conformance::world::quadrant_scene;
use pf_core::{CancelToken, Clock, Context, Planner};
use pf_geom::{Circle, Shape, World, WorldProblem};
use pf_pso::{Penalty, Pso, PsoParams, Zones};

/// Scenes from this seed on, so that none served to try things out.
const FIRST: u64 = 100_000;
/// The paper's runs of each kind.
const RUNS: u32 = 40;

/// What to run.
#[derive(Clone, Debug)]
pub struct Options {
    /// Scenes of each kind in the large experiment.
    pub scenes: u32,
    /// Stops it.
    pub cancel: CancelToken,
}

/// The sets of parameters by their names.
#[must_use]
pub fn variants() -> [(&'static str, PsoParams); 3] {
    let graded = PsoParams {
        penalty: Penalty::Length,
        ..PsoParams::paper()
    };
    [
        ("paper", PsoParams::paper()),
        ("paper, graded penalty", graded),
        ("default", PsoParams::default()),
    ]
}

/// The scene of a run; every ten runs start and goal are in two other quadrants.
#[must_use]
pub fn scene(run: u64, round: bool) -> WorldProblem {
    quadrant_scene(FIRST + run, round, run / 10)
}

/// The shortest way round the danger zones, for a point: two tangents and an arc.
fn optimum(problem: &WorldProblem, params: &PsoParams) -> Option<f64> {
    let grown = match params.zones {
        Zones::Shapes => WorldProblem::new(
            problem.shared_world(),
            problem.radius() + params.clearance,
            problem.start(),
            problem.goal(),
        ),
        Zones::Circles => {
            let zones = problem
                .world()
                .shapes()
                .filter_map(|(_, shape)| zone(shape, params));
            let world = World::with_shapes(*problem.world().bounds(), zones);
            WorldProblem::new(world, 0.0, problem.start(), problem.goal())
        }
    };
    let report = VisibilityGraph::default().plan(&grown.ok()?, &mut Context::seeded(0));
    Some(report.ok()?.outcome.solved()?.cost)
}

/// The circle that holds a shape, grown.
fn zone(shape: &Shape, params: &PsoParams) -> Option<Shape> {
    let (min, max) = shape.bounding_box();
    let middle = min + (max - min) / 2.0;
    let radius = match shape {
        Shape::Circle(circle) => circle.radius(),
        _ => (max - middle).norm(),
    };
    Some(Circle::new(middle, radius + params.clearance).ok()?.into())
}

/// What many runs of one kind came to.
#[derive(Default)]
struct Tally {
    solved: u32,
    ratios: Vec<f64>,
    fitness: Vec<f64>,
    improved: Vec<f64>,
    micros: Vec<f64>,
}

fn runs(
    params: &PsoParams,
    round: bool,
    count: u32,
    cancel: &CancelToken,
) -> Result<Tally, PaperError> {
    let broken = |error: &dyn std::fmt::Display| PaperError::Data(error.to_string());
    let mut planner = Pso::new(params.clone()).map_err(|error| broken(&error))?;
    let clock = Clock::default();
    let mut tally = Tally::default();
    for run in 0..count {
        if cancel.is_cancelled() {
            return Err(PaperError::Interrupted);
        }
        let problem = scene(run.into(), round);
        let began = clock.now();
        let report = planner.plan(&problem, &mut Context::seeded(run.into()));
        tally
            .micros
            .push(clock.now().saturating_sub(began).as_secs_f64() * 1e6);
        let report = report.map_err(|error| broken(&error))?;
        if let Some(ended) = planner.ended() {
            tally.fitness.push(ended.fitness);
            tally.improved.push(f64::from(
                u32::try_from(ended.last_improved).unwrap_or(u32::MAX),
            ));
        }
        if let Some(best) = report.outcome.solved() {
            tally.solved += 1;
            if let Some(exact) = optimum(&problem, params) {
                tally.ratios.push(best.cost / exact);
            }
        }
    }
    Ok(tally)
}

/// Runs everything.
///
/// # Errors
/// [`PaperError::Interrupted`] if somebody asked to stop.
pub fn run(
    options: &Options,
    tell: &mut dyn FnMut(usize, usize, &str),
) -> Result<Vec<Row>, PaperError> {
    let mut rows = Vec::new();
    let kinds = 2 * 3 * variants().len();
    let mut done = 0;
    for (table, count) in [
        ("the paper's 240 runs", RUNS),
        ("many scenes", options.scenes),
    ] {
        for (variant, params) in variants() {
            for round in [true, false] {
                let mut twenty = None;
                for particles in [20, 10, 1] {
                    let format = if round { "circle" } else { "rectangle" };
                    tell(
                        done,
                        2 * kinds,
                        &format!("{variant}, {format}, {particles}"),
                    );
                    done += 1;
                    let params = PsoParams {
                        particles,
                        ..params.clone()
                    };
                    let tally = runs(&params, round, count, &options.cancel)?;
                    let fitness = Spread::of(tally.fitness.iter().copied());
                    twenty = twenty.or(fitness.map(|spread| spread.median));
                    rows.push(row(
                        table, variant, format, particles, count, &tally, twenty,
                    ));
                }
            }
        }
    }
    Ok(rows)
}

fn row(
    table: &'static str,
    variant: &str,
    format: &str,
    particles: usize,
    count: u32,
    tally: &Tally,
    twenty: Option<f64>,
) -> Row {
    let [low, high] = wilson(tally.solved, count);
    let rate = f64::from(tally.solved) / f64::from(count);
    let ratios = {
        let mut sorted = tally.ratios.clone();
        sorted.sort_by(f64::total_cmp);
        sorted
    };
    let at = |percent: usize| {
        ratios
            .get(ratios.len().saturating_sub(1) * percent / 100)
            .copied()
    };
    let median = |values: &[f64]| Spread::of(values.iter().copied()).map(|s| s.median);
    let fitness = median(&tally.fitness);
    let (published, reproduced) = match particles {
        1 => (
            Numbers::default().with("success", 0.6),
            (low..=high).contains(&0.6),
        ),
        _ => (Numbers::default().with("success", ">0.97"), rate > 0.97),
    };
    Row {
        paper: "faustino",
        table,
        case: format!("{format} {particles}"),
        planner: "pso",
        variant: variant.to_owned(),
        published,
        measured: Numbers::default()
            .with("success", rate)
            .with("from", low)
            .with("to", high)
            .with("runs", count)
            .with("length/optimum", at(50))
            .with("95th percentile", at(95))
            .with("fitness", fitness)
            .with("less than 20's", twenty.zip(fitness).map(|(a, b)| a - b))
            .with("last improved", median(&tally.improved))
            .with("time us", median(&tally.micros)),
        reproduced: (variant == "paper").then_some(reproduced),
    }
}
