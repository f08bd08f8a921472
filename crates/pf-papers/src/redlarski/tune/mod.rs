//! A search for parameters with which the stochastic RFD* does better than the published ones.
//!
//! Random search with racing (successive halving): many sets of parameters run on a few made-up maps, the
//! better ones on more and larger ones, until one is left. The maps are none of the nine, and their
//! generator and seeds were fixed before the first search. Then the winner meets the nine.
//!
//! Drops and iterations stay as in the paper, and altitudes are not seeded.

mod maps;

pub use maps::{Kind, Sample, sample};

use super::{cases::Story, text::number};
use crate::{
    PaperError,
    statistics::{Spread, wilson},
};
use comfy_table::{CellAlignment, Table, presets};
use pf_core::{Budget, CancelToken, Context, PlanRng, Planner};
use pf_grid::{GridCost, GridProblem};
use pf_rfd::{Pull, RfdStar, RfdStarParams, Slope, Toll};
use rand::{RngExt, SeedableRng};
use serde::Serialize;

/// The seed of the maps.
pub const MAPS_SEED: u64 = 20_070_601;
/// A run without a path counts as one of so many times the shortest length.
const MISS: f64 = 16.0;

/// How much is tried.
#[derive(Clone, Debug)]
pub struct TuneOptions {
    /// Sets of parameters at first.
    pub sets: usize,
    /// The seed they are drawn from.
    pub seed: u64,
    /// Runs of each contender on each of the nine maps.
    pub runs: u32,
    /// Threads a swarm may use; nothing depends on it.
    pub threads: usize,
    /// Stops the search.
    pub cancel: CancelToken,
}

/// One leg of the race: maps of a size, from where in the list, and how many.
const LEGS: [(u32, std::ops::Range<u64>); 4] =
    [(20, 0..6), (20, 6..18), (50, 18..30), (50, 30..54)];
/// What share goes on to the next leg.
const GOES_ON: usize = 4;

/// A set of parameters and how it did on the maps so far.
#[derive(Clone, Debug)]
pub struct Entrant {
    /// The parameters.
    pub params: RfdStarParams,
    /// The mean over all its runs of log2 (length / shortest).
    pub score: f64,
    sum: f64,
    runs: u32,
}

/// What a set of parameters did on one of the nine maps.
#[derive(Clone, Debug, Serialize)]
pub struct Check {
    /// `redlarski-tune`.
    pub paper: &'static str,
    /// The map.
    pub case: &'static str,
    /// `tuned`, `paper` or `authors_code`.
    pub variant: String,
    /// Runs, and in how many a path was found, and a shortest one.
    pub runs: u32,
    /// Runs with a path.
    pub found: u32,
    /// Runs with a shortest path.
    pub optimal: u32,
    /// Wilson interval of the share of shortest paths.
    pub optimal_interval: [f64; 2],
    /// Lengths found by the shortest.
    pub ratio: Option<Spread>,
}

/// What came of it.
#[derive(Clone, Debug)]
pub struct Tuned {
    /// The published sets, and the best found, best first, on the maps of the last leg.
    pub ranking: Vec<(String, Entrant)>,
    /// The winner and the published sets on the nine maps.
    pub checks: Vec<Check>,
}

/// Searches and checks; `progress` is told of what is done, in per cent and words.
///
/// # Errors
/// [`PaperError::Interrupted`] if somebody asked to stop.
pub fn tune(
    stories: &[Story],
    options: &TuneOptions,
    progress: &mut dyn FnMut(usize, usize, &str),
) -> Result<Tuned, PaperError> {
    let mut rng = PlanRng::seed_from_u64(options.seed);
    let entrant = |params| Entrant {
        params,
        score: 0.0,
        sum: 0.0,
        runs: 0,
    };
    let mut field: Vec<Entrant> = (0..options.sets.max(1))
        .map(|_| entrant(draw(&mut rng)))
        .collect();
    let mut published = [
        ("paper", entrant(RfdStarParams::paper())),
        ("authors_code", entrant(RfdStarParams::authors_code())),
    ];
    for (leg, (size, numbers)) in LEGS.into_iter().enumerate() {
        let samples: Vec<_> = numbers
            .clone()
            .map(|n| sample(MAPS_SEED, n, size))
            .collect();
        let all = field.len();
        for (i, entrant) in field
            .iter_mut()
            .chain(published.iter_mut().map(|p| &mut p.1))
            .enumerate()
        {
            progress(i, all + 2, &format!("leg {} of {}", leg + 1, LEGS.len()));
            race(entrant, &samples, options)?;
        }
        field.sort_by(|a, b| a.score.total_cmp(&b.score));
        if leg + 1 < LEGS.len() {
            field.truncate(all.div_ceil(GOES_ON).max(1));
        }
    }
    let winner = field[0].params.clone();
    let published_ = published.map(|(name, entrant)| (name.to_owned(), entrant));
    let best = field.into_iter().take(5).enumerate();
    let best = best.map(|(i, entrant)| (format!("found {}", i + 1), entrant));
    let mut checks = Vec::new();
    let contenders = [
        ("tuned", winner),
        ("paper", RfdStarParams::paper()),
        ("authors_code", RfdStarParams::authors_code()),
    ];
    for (i, story) in stories.iter().enumerate() {
        progress(i, stories.len(), story.map);
        for (name, params) in &contenders {
            checks.push(check(story, name, params, options)?);
        }
    }
    Ok(Tuned {
        ranking: best.chain(published_).collect(),
        checks,
    })
}

fn race(
    entrant: &mut Entrant,
    samples: &[Sample],
    options: &TuneOptions,
) -> Result<(), PaperError> {
    for (seed, sample) in (0..).zip(samples) {
        let cost = answer(&entrant.params, &sample.problem, seed, options)?;
        let ratio = cost.map_or(MISS, |cost| cost.value() / sample.shortest.value().max(1.0));
        entrant.sum += ratio.log2();
        entrant.runs += 1;
    }
    entrant.score = entrant.sum / f64::from(entrant.runs.max(1));
    Ok(())
}

fn answer(
    params: &RfdStarParams,
    problem: &GridProblem,
    seed: u64,
    options: &TuneOptions,
) -> Result<Option<GridCost>, PaperError> {
    if options.cancel.is_cancelled() {
        return Err(PaperError::Interrupted);
    }
    let params = RfdStarParams {
        threads: options.threads,
        ..params.clone()
    };
    let broken = |error: String| PaperError::Data(error);
    let mut river = RfdStar::new(params).map_err(|error| broken(error.to_string()))?;
    let budget = Budget::unlimited().cancel(&options.cancel);
    let report = river.plan(problem, &mut Context::seeded(seed).within(budget));
    let report = report.map_err(|error| broken(error.to_string()))?;
    Ok(report.outcome.solved().map(|solved| solved.cost))
}

fn check(
    story: &Story,
    name: &str,
    params: &RfdStarParams,
    options: &TuneOptions,
) -> Result<Check, PaperError> {
    let (problem, shortest) = &story.first;
    let mut costs = Vec::new();
    for seed in 0..u64::from(options.runs) {
        costs.push(answer(params, problem, 1000 + seed, options)?);
    }
    let count = |fine: &dyn Fn(&&Option<GridCost>) -> bool| {
        u32::try_from(costs.iter().filter(fine).count()).unwrap_or(u32::MAX)
    };
    let optimal = count(&|cost| **cost == Some(*shortest));
    Ok(Check {
        paper: "redlarski-tune",
        case: story.map,
        variant: name.to_owned(),
        runs: options.runs,
        found: count(&|cost| cost.is_some()),
        optimal,
        optimal_interval: wilson(optimal, options.runs),
        ratio: Spread::of(
            costs
                .iter()
                .flatten()
                .map(|cost| cost.value() / shortest.value()),
        ),
    })
}

/// A set of parameters from anywhere in what makes sense.
fn draw(rng: &mut PlanRng) -> RfdStarParams {
    let mut log = |from: f64, to: f64| from * (to / from).powf(rng.random_range(0.0..1.0));
    let (p_base, altitude, erosion) = (log(1.01, 1e6), log(0.1, 1e3), log(1e-4, 1e6));
    let pull = if rng.random_bool(0.7) {
        Pull::Power
    } else {
        Pull::Exponential
    };
    RfdStarParams {
        altitude,
        p_base,
        erosion,
        alpha: match pull {
            _ if rng.random_bool(0.15) => 0.0,
            Pull::Power => rng.random_range(0.5..32.0),
            Pull::Exponential => rng.random_range(1.05..8.0),
        },
        pull,
        slope: if rng.random_bool(0.7) {
            Slope::Gradient
        } else {
            Slope::Percent
        },
        toll: if rng.random_bool(0.5) {
            Toll::Swarm
        } else {
            Toll::Path
        },
        deposit: [0.0, 0.5, 1.0][rng.random_range(0..3)],
        climb: [1.0, 1.0, 0.1, 0.01][rng.random_range(0..4)],
        clamp: rng.random_bool(0.5),
        ..RfdStarParams::paper()
    }
}

impl Tuned {
    /// The ranking and the check, to read.
    #[must_use]
    pub fn text(&self) -> String {
        let mut ranking = Table::new();
        ranking
            .load_style(presets::UTF8_FULL_CONDENSED)
            .set_header([
                "set", "score", "maps", "p_base", "slope", "alpha", "pull", "altitude", "erosion",
                "toll", "deposit", "climb", "clamp",
            ]);
        for (name, entrant) in &self.ranking {
            let p = &entrant.params;
            ranking.add_row([
                name.clone(),
                format!("{:.3}", entrant.score),
                entrant.runs.to_string(),
                format!("{:.6}", p.p_base),
                p.slope.to_string(),
                number(p.alpha),
                p.pull.to_string(),
                format!("{:.4}", p.altitude),
                format!("{:.6}", p.erosion),
                p.toll.to_string(),
                p.deposit.to_string(),
                p.climb.to_string(),
                p.clamp.to_string(),
            ]);
        }
        let mut checks = Table::new();
        checks.load_style(presets::UTF8_FULL_CONDENSED).set_header([
            "map",
            "set",
            "found",
            "optimal (95 %)",
            "x shortest, median [quartiles]",
        ]);
        for column in checks.column_iter_mut().skip(2) {
            column.set_cell_alignment(CellAlignment::Right);
        }
        for check in &self.checks {
            let [low, high] = check.optimal_interval;
            checks.add_row([
                check.case.to_owned(),
                check.variant.clone(),
                format!("{}/{}", check.found, check.runs),
                format!("{}/{} ({low:.2}-{high:.2})", check.optimal, check.runs),
                check.ratio.map_or("-".to_owned(), |r| {
                    format!("{:.3} [{:.3}, {:.3}]", r.median, r.q1, r.q3)
                }),
            ]);
        }
        format!(
            "Made-up maps; the score is the mean of log2 (length / shortest), a miss counts as x 16\n\
             {ranking}\n\nThe nine maps, Table 1\n{checks}\n"
        )
    }
}
