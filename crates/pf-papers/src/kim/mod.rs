//! *Real-Time Pathfinding in Dynamic Open World Conditions via L-BFGS Optimization*: three maps, cold and
//! warm starts, and what becomes of the method in worlds made up.

mod data;
mod figures;
mod grids;
mod worlds;

pub use data::{MAPS, Published, QUERIES, Reference};
pub use figures::figures;

use crate::{
    PaperError,
    row::{Numbers, Row},
    statistics::Spread,
};
use pf_core::{CancelToken, Clock, Context, Planner, Problem, Replanner, Report};
use pf_geom::{Segment, WorldProblem};
use pf_lbfgs::{Lbfgs, LbfgsParams, Obstacles, PaperLoss, plain};

/// What to run.
#[derive(Clone, Debug)]
pub struct Options {
    /// Runs of each case: their seeds are 0, 1, …
    pub runs: u32,
    /// Stops it.
    pub cancel: CancelToken,
}

/// The sets of parameters by their names.
#[must_use]
pub fn variants() -> [(&'static str, LbfgsParams); 4] {
    let potential = LbfgsParams {
        obstacles: Obstacles::Potential,
        hysteresis: 0.0,
        ..LbfgsParams::default()
    };
    let default = LbfgsParams {
        clearance: 1.0,
        hysteresis: 0.0,
        ..LbfgsParams::default()
    };
    [
        ("published_code", LbfgsParams::published_code()),
        ("paper", LbfgsParams::paper()),
        ("default, paper's loss", potential),
        ("default, clearance 1", default),
    ]
}

pub(crate) fn broken(what: impl std::fmt::Display) -> PaperError {
    PaperError::Data(what.to_string())
}

/// What one plan came to.
#[derive(Clone, Debug)]
struct Run {
    iterations: f64,
    /// At the last weight; ours at 32.
    loss: f64,
    length: f64,
    clearance: f64,
    solved: bool,
    micros: f64,
}

impl Run {
    fn of(
        problem: &WorldProblem,
        planner: &Lbfgs,
        report: &Report<WorldProblem>,
        micros: f64,
    ) -> Option<Self> {
        use pf_core::Outcome::{Feasible, Optimal, Unknown};
        let path = match &report.outcome {
            Feasible(best) | Optimal(best) => &best.solution,
            Unknown { attempt } => attempt.as_ref()?,
            pf_core::Outcome::Infeasible => return None,
        };
        let flat = plain(path);
        let loss = match planner.descended() {
            Some(ended) => ended.loss,
            None => PaperLoss::new(problem, 2.0).evaluate(&flat, 32.0, &mut vec![0.0; flat.len()]),
        };
        let segments = || path.windows(2).map(|w| Segment::new(w[0], w[1]));
        let clearances = segments().map(|s| problem.world().clearance(&s));
        Some(Self {
            iterations: f64::from(u32::try_from(report.stats.iterations).unwrap_or(u32::MAX)),
            loss,
            length: segments().map(|s| s.length()).sum(),
            clearance: clearances.fold(f64::INFINITY, f64::min),
            solved: report.outcome.solved().is_some(),
            micros,
        })
    }
}

/// A cold plan of a query, and the warm ones after a cold start.
fn story(
    published: &Published,
    map: &str,
    params: &LbfgsParams,
    seed: u64,
) -> Result<Vec<(&'static str, bool, Run)>, PaperError> {
    let clock = Clock::default();
    let mut runs = Vec::new();
    let mut planner = Lbfgs::new(params.clone()).map_err(broken)?;
    let mut problem = published.problem(map, "cold")?;
    for query in QUERIES {
        let queried = published.problem(map, query)?;
        if !data::has_free_ends(&queried) {
            break;
        }
        let warm = query != "cold";
        if warm {
            let changes = published.moves(query)?;
            let revision = problem.revise(&changes).map_err(broken)?;
            let began = clock.now();
            let report = planner.replan(&revision, &mut Context::seeded(seed));
            let micros = clock.now().saturating_sub(began).as_secs_f64() * 1e6;
            let report = report.map_err(broken)?;
            runs.extend(Run::of(&queried, &planner, &report, micros).map(|run| (query, true, run)));
        }
        let mut cold = Lbfgs::new(params.clone()).map_err(broken)?;
        // Once for the memory that it keeps.
        cold.plan(&queried, &mut Context::seeded(seed))
            .map_err(broken)?;
        let began = clock.now();
        let report = cold.plan(&queried, &mut Context::seeded(seed));
        let micros = clock.now().saturating_sub(began).as_secs_f64() * 1e6;
        let report = report.map_err(broken)?;
        runs.extend(Run::of(&queried, &cold, &report, micros).map(|run| (query, false, run)));
        if !warm {
            planner
                .plan(&problem, &mut Context::seeded(seed))
                .map_err(broken)?;
        }
    }
    Ok(runs)
}

/// Runs everything.
///
/// # Errors
/// [`PaperError::Interrupted`] if somebody asked to stop, [`PaperError::Data`] if what the program
/// carries is broken.
pub fn run(
    published: &Published,
    options: &Options,
    tell: &mut dyn FnMut(usize, usize, &str),
) -> Result<Vec<Row>, PaperError> {
    let mut rows = Vec::new();
    let steps = MAPS.len() * variants().len() + 2;
    let mut step = 0;
    for map in MAPS {
        for (variant, params) in variants() {
            if options.cancel.is_cancelled() {
                return Err(PaperError::Interrupted);
            }
            tell(step, steps, &format!("{map}, {variant}"));
            step += 1;
            let stories: Vec<_> = (0..options.runs.max(1))
                .map(|seed| story(published, map, &params, seed.into()))
                .collect::<Result<_, _>>()?;
            for place in 0..stories[0].len() {
                let (query, warm, _) = stories[0][place];
                let runs: Vec<&Run> = stories
                    .iter()
                    .filter_map(|s| s.get(place))
                    .map(|s| &s.2)
                    .collect();
                rows.push(row(published, map, query, warm, variant, &runs));
            }
        }
    }
    rows.extend(claims(&rows));
    tell(step, steps, "grids");
    rows.extend(grids::run(published)?);
    tell(step + 1, steps, "worlds");
    rows.extend(worlds::run(&options.cancel)?);
    Ok(rows)
}

fn row(
    published: &Published,
    map: &str,
    query: &str,
    warm: bool,
    variant: &str,
    runs: &[&Run],
) -> Row {
    let spread = |of: fn(&Run) -> f64| Spread::of(runs.iter().map(|run| of(run)));
    let median = |of: fn(&Run) -> f64| spread(of).map(|s| s.median);
    let count = runs.len();
    let solved = runs.iter().filter(|run| run.solved).count();
    let loss = spread(|run| run.loss);
    let mut measured = Numbers::default()
        .with("iterations", median(|run| run.iterations))
        .with("loss", loss.map(|s| s.median))
        .with("least", loss.map(|s| s.least))
        .with("most", loss.map(|s| s.most))
        .with("length", median(|run| run.length))
        .with("clearance", median(|run| run.clearance))
        .with("solved", format!("{solved}/{count}"))
        .with("time_us", median(|run| run.micros));
    let mut said = Numbers::default();
    let mut reproduced = None;
    // What is published as warm is what follows another query; the rest are cold starts.
    let known = published
        .reference(map, query)
        .filter(|_| warm || query == "cold");
    if let Some(reference) = known {
        said = said
            .with("iterations", reference.iterations)
            .with("loss", reference.loss)
            .with("length", reference.length)
            .with("clearance", reference.clearance)
            .with("time_us", reference.python_ms * 1e3);
        let micros = median(|run| run.micros).unwrap_or(f64::NAN);
        measured = measured.with("x Python", reference.python_ms * 1e3 / micros);
        // On the toy map chance decides; its spread holds the printed one.
        let near = |value: Option<f64>, printed: f64, by: f64| {
            value.is_some_and(|value| (value - printed).abs() <= by)
        };
        let agrees = if map == "toy" {
            loss.is_some_and(|s| s.least <= reference.loss * 1.001 && reference.loss <= s.most)
        } else {
            near(median(|run| run.iterations), reference.iterations, 2.0)
                && near(
                    median(|run| run.loss),
                    reference.loss,
                    1e-3 * reference.loss,
                )
        };
        reproduced = (variant == "published_code").then_some(agrees);
    }
    Row {
        paper: "kim",
        table: "plans",
        case: format!(
            "{map} {query}{}",
            if warm || query == "cold" {
                ""
            } else {
                " from scratch"
            }
        ),
        planner: "lbfgs",
        variant: variant.to_owned(),
        published: said,
        measured,
        reproduced,
    }
}

/// "Warm starts end in under 30 iterations and cost less than cold ones."
fn claims(rows: &[Row]) -> Vec<Row> {
    let find = |variant: &str, case: &str| {
        rows.iter()
            .find(|row| row.variant == variant && row.case == case)
    };
    let mut claims = Vec::new();
    for variant in ["published_code", "paper"] {
        // What the paper's own notebook prints: iterations of warm1 and warm2, and seconds.
        for (query, iterations, seconds) in [("warm1", 32.0, 0.105), ("warm2", 52.0, 0.162)] {
            let case = format!("curved {query}");
            let (Some(warm), Some(cold)) = (
                find(variant, &case),
                find(variant, &format!("{case} from scratch")),
            ) else {
                continue;
            };
            let number = |row: &Row, name: &str| row.measured.number(name).unwrap_or(f64::NAN);
            let took = number(warm, "iterations");
            let (warm_loss, cold_loss) = (number(warm, "loss"), number(cold, "loss"));
            claims.push(Row {
                paper: "kim",
                table: "claims of warm starts",
                case: case.clone(),
                planner: "lbfgs",
                variant: variant.to_owned(),
                published: Numbers::default()
                    .with("iterations", "<30")
                    .with("loss/cold", "<1")
                    .with("notebook's iterations", iterations)
                    .with("notebook's seconds", seconds),
                measured: Numbers::default()
                    .with("iterations", took)
                    .with("loss/cold", warm_loss / cold_loss),
                reproduced: Some(took < 30.0 && warm_loss < cold_loss),
            });
        }
    }
    for (variant, _) in variants().iter().skip(2) {
        for query in ["warm1", "warm2"] {
            let case = format!("curved {query}");
            if let (Some(warm), Some(cold)) = (
                find(variant, &case),
                find(variant, &format!("{case} from scratch")),
            ) {
                let number = |row: &Row| row.measured.number("loss").unwrap_or(f64::NAN);
                claims.push(Row {
                    paper: "kim",
                    table: "claims of warm starts",
                    case,
                    planner: "lbfgs",
                    variant: (*variant).to_owned(),
                    published: Numbers::default(),
                    measured: Numbers::default()
                        .with("iterations", warm.measured.number("iterations"))
                        .with("loss/cold", number(warm) / number(cold)),
                    reproduced: None,
                });
            }
        }
    }
    claims
}
