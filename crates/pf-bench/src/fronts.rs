//! `bench fronts`: what planners for teams take for an evaluation, and of that for all but it.
//!
//! Every planner gets the same evaluations on the same problems, all in turn; the median of its rounds
//! counts. Random search does little but evaluate: what another takes more than it goes into moves,
//! sorting and selection. A mismatch is a front of two threads that is not that of one.

use crate::protocol::{json, say, timed};
use anyhow::{Context as _, Result};
use pf_conformance::team::{TeamRecipe, crossing};
use pf_core::{Budget, Context};
use pf_geom::TeamProblem;
use pf_planners::{Entry, team_planners};
use serde::Serialize;

#[derive(clap::Args)]
pub(crate) struct Args {
    /// How often each contender answers
    #[arg(long, default_value_t = 9, value_parser = clap::value_parser!(u32).range(1..))]
    rounds: u32,
    /// Evaluations of an answer
    #[arg(long, default_value_t = 20_000)]
    evaluations: u64,
    /// One JSON object a line
    #[arg(long)]
    json: bool,
}

/// One line of the answer. Times are those of an evaluation, all that belongs to it included.
#[derive(Serialize)]
struct Row {
    suite: &'static str,
    case: String,
    planner: &'static str,
    queries: usize,
    mean_us: f64,
    median_us: f64,
    p95_us: f64,
    mismatches: u64,
    /// What it takes more than random search, of what that takes.
    over_evaluation: f64,
    /// A cycle with a population of 1,000 beside one with 100.
    #[serde(skip_serializing_if = "Option::is_none")]
    cycle_1000_to_100: Option<f64>,
    /// How much faster two threads are.
    #[serde(skip_serializing_if = "Option::is_none")]
    speedup: Option<f64>,
}

/// A population and a number of threads.
const SETTINGS: [(usize, usize); 3] = [(100, 1), (1000, 1), (100, 2)];

/// What the rounds of one contender took, in microseconds an evaluation.
#[derive(Clone, Default)]
struct Rounds {
    micros: Vec<f64>,
    front: Option<Vec<[f64; 3]>>,
}

impl Rounds {
    fn median(&self) -> f64 {
        self.quantile(50)
    }

    fn quantile(&self, percent: usize) -> f64 {
        let mut sorted = self.micros.clone();
        sorted.sort_by(f64::total_cmp);
        let place = sorted.len().saturating_sub(1) * percent / 100;
        sorted.get(place).copied().unwrap_or(f64::NAN)
    }
}

fn problems() -> [(&'static str, TeamProblem); 3] {
    let of = |robots, obstacles| {
        let recipe = TeamRecipe {
            robots,
            radius: 0.5,
            obstacles,
            kind: None,
        };
        crossing(1, &recipe)
    };
    [
        ("1 robot, 3 discs", of(1, 3)),
        ("3 robots, 4 discs", of(3, 4)),
        ("5 robots, 20 discs", of(5, 20)),
    ]
}

pub(crate) fn run(args: &Args) -> Result<()> {
    let entries: Vec<_> = team_planners()
        .filter(|entry| {
            entry
                .parameters()
                .iter()
                .any(|key| key.name == "population")
        })
        .collect();
    if !args.json {
        say(format_args!(
            "{:<36} {:<14} {:>12} {:>10} {:>16} {:>12} {:>8} {:>5}",
            "case",
            "planner",
            "us/evaluation",
            "p95",
            "over evaluation",
            "1000 to 100",
            "speedup",
            "bad"
        ))?;
    }
    for (name, problem) in problems() {
        let mut all = vec![vec![Rounds::default(); SETTINGS.len()]; entries.len()];
        for _ in 0..args.rounds {
            for (entry, rounds) in entries.iter().zip(&mut all) {
                for (setting, rounds) in SETTINGS.iter().zip(rounds) {
                    round(args, entry, &problem, *setting, rounds)?;
                }
            }
        }
        let random = entries
            .iter()
            .position(|entry| entry.key() == "random-search");
        let random = random.context("random search is in the list")?;
        for (entry, rounds) in entries.iter().zip(&all) {
            for (k, (population, threads)) in SETTINGS.into_iter().enumerate() {
                let base = all[random][k].median();
                let case = format!("{name}, {population}, {threads} threads");
                tell(args, &row(case, entry.key(), rounds, k, base))?;
            }
        }
    }
    Ok(())
}

fn round(
    args: &Args,
    entry: &Entry<TeamProblem>,
    problem: &TeamProblem,
    (population, threads): (usize, usize),
    rounds: &mut Rounds,
) -> Result<()> {
    let settings = [
        ("population", population.to_string()),
        ("threads", threads.to_string()),
        ("evaluations", u64::MAX.to_string()),
        ("patience", "0".to_owned()),
    ];
    let settings = settings.map(|(key, value)| (key.to_owned(), value));
    let mut planner = entry.make(&settings)?;
    let budget = Budget::unlimited().evaluations(args.evaluations);
    let mut cx = Context::seeded(1).within(budget);
    let (time, report) = timed(|| planner.plan(problem, &mut cx));
    let report = report?;
    #[expect(clippy::cast_precision_loss, reason = "a number of evaluations")]
    let evaluated = report.stats.evaluated.max(1) as f64;
    rounds.micros.push(time.as_secs_f64() * 1e6 / evaluated);
    let front = report.outcome.solved().map(|s| s.cost.members().to_vec());
    rounds.front = Some(front.unwrap_or_default());
    Ok(())
}

fn row(case: String, planner: &'static str, rounds: &[Rounds], k: usize, base: f64) -> Row {
    let own = &rounds[k];
    #[expect(clippy::cast_precision_loss, reason = "a number of rounds")]
    let count = own.micros.len().max(1) as f64;
    let large = SETTINGS[k].0 > SETTINGS[0].0;
    let threaded = SETTINGS[k].1 > 1;
    Row {
        suite: "fronts",
        case,
        planner,
        queries: own.micros.len(),
        mean_us: own.micros.iter().sum::<f64>() / count,
        median_us: own.median(),
        p95_us: own.quantile(95),
        mismatches: u64::from(threaded && own.front != rounds[0].front),
        over_evaluation: own.median() / base - 1.0,
        cycle_1000_to_100: large.then(|| 10.0 * own.median() / rounds[0].median()),
        speedup: threaded.then(|| rounds[0].median() / own.median()),
    }
}

fn tell(args: &Args, row: &Row) -> Result<()> {
    if args.json {
        return json(row);
    }
    let show = |v: Option<f64>| v.map_or(String::new(), |v| format!("{v:.2}"));
    say(format_args!(
        "{:<36} {:<14} {:>12.3} {:>10.3} {:>16.2} {:>12} {:>8} {:>5}",
        row.case,
        row.planner,
        row.median_us,
        row.p95_us,
        row.over_evaluation,
        show(row.cycle_1000_to_100),
        show(row.speedup),
        row.mismatches
    ))
}
