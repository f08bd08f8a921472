//! Wang, Li, Dou, Li, Zhao, Li: *A Novel Multi-objective Artificial Bee Colony Algorithm for
//! Multi-robot Path Planning*.
//!
//! Everybody gets the same evaluations and, where the set of parameters does not say otherwise, the
//! same beginning. Experiments I and II with 20,000 and 100,000 evaluations, further problems on which
//! nothing was tuned with 20,000.

mod contenders;
mod figures;
mod problems;

pub use contenders::{Contender, contenders};
pub use figures::figures;
pub use problems::{Trial, concave, four_discs, further, three_discs};

use crate::{
    PaperError,
    row::{Numbers, Row},
    statistics::Spread,
};
use contenders::Run;
use pf_core::CancelToken;
use pf_geom::{LENGTH, Objectives, TURNING, TeamProblem, Timing};
use pf_moabc::indicators::{breadth, error_rate, igd_plus};
use pf_suite::comparisons::{holm, wilcoxon};

/// The evaluations a run may take: in the paper's experiments, and on further problems.
const SMALL: u64 = 20_000;
const LARGE: u64 = 100_000;

/// At most so many members of the union front are looked at for IGD+.
const THINNED: usize = 400;

/// What to run.
#[derive(Clone, Debug)]
pub struct Options {
    /// Runs of each planner.
    pub runs: u32,
    /// Only the problems whose name contains this.
    pub only: Option<String>,
    /// Stops it.
    pub cancel: CancelToken,
}

/// A problem with a number of evaluations, in a table.
struct Case {
    table: &'static str,
    trial: Trial,
    evaluations: u64,
}

fn cases() -> Result<Vec<Case>, PaperError> {
    let mut cases = Vec::new();
    for (table, trial) in [
        ("experiment I", three_discs()?),
        ("experiment I", concave()?),
        ("experiment II", four_discs()?),
    ] {
        cases.extend([SMALL, LARGE].map(|evaluations| Case {
            table,
            trial: trial.clone(),
            evaluations,
        }));
    }
    cases.extend(further()?.into_iter().map(|trial| Case {
        table: "further problems",
        trial,
        evaluations: SMALL,
    }));
    Ok(cases)
}

/// The names of all problems.
///
/// # Errors
/// [`PaperError`] never, but for a fault of its own.
pub fn names() -> Result<Vec<&'static str>, PaperError> {
    let mut names: Vec<_> = cases()?.iter().map(|case| case.trial.name).collect();
    // A problem with several numbers of evaluations stands in a row.
    names.dedup();
    Ok(names)
}

/// Runs everything.
///
/// # Errors
/// [`PaperError::Interrupted`] if somebody asked to stop.
pub fn run(
    options: &Options,
    tell: &mut dyn FnMut(usize, usize, &str),
) -> Result<Vec<Row>, PaperError> {
    let mut cases = cases()?;
    if let Some(only) = &options.only {
        cases.retain(|case| case.trial.name.contains(only.as_str()));
    }
    let (all, mut done) = (cases.len() * contenders().len(), 0);
    let mut rows = Vec::new();
    for case in &cases {
        let mut fields = Vec::new();
        for contender in contenders() {
            let (name, evaluations) = (case.trial.name, case.evaluations);
            let what = format!("{name} {evaluations}, {}", contender.planner);
            tell(done, all, &what);
            done += 1;
            let runs = (0..options.runs)
                .map(|seed| contender.run(&case.trial, evaluations, seed.into(), &options.cancel));
            fields.push((contender, runs.collect::<Result<Vec<_>, _>>()?));
        }
        rows.extend(measured(case, &fields));
    }
    Ok(rows)
}

/// The rows of a case: each contender beside all the others.
fn measured(case: &Case, fields: &[(Contender, Vec<Run>)]) -> Vec<Row> {
    let trial = &case.trial;
    let fronts = fields
        .iter()
        .flat_map(|(_, runs)| runs.iter().flat_map(|run| &run.front));
    let union = undominated(fronts.copied().collect());
    let stride = union.len().div_ceil(THINNED).max(1);
    let thinned: Vec<_> = union
        .iter()
        .step_by(stride)
        .map(|c| trial.scaled(c))
        .collect();
    let volumes = |runs: &[Run]| -> Vec<f64> { runs.iter().map(|run| run.hypervolume).collect() };
    let ours = volumes(&fields[0].1);
    let p_values: Vec<f64> = fields[1..]
        .iter()
        .map(|(_, runs)| {
            let pairs = volumes(runs).into_iter().zip(&ours);
            wilcoxon(&pairs.map(|(theirs, own)| theirs - own).collect::<Vec<_>>())
        })
        .collect();
    let corrected = holm(&p_values);
    let rival = fields
        .iter()
        .find(|(contender, _)| contender.planner == "moead");
    let rival = rival.map(|(_, runs)| volumes(runs)).unwrap_or_default();
    // Of all beside MOEA/D, uncorrected.
    let beside = |runs: &[Run]| {
        let pairs = volumes(runs).into_iter().zip(&rival);
        wilcoxon(&pairs.map(|(own, theirs)| own - theirs).collect::<Vec<_>>())
    };
    let row = |(place, (contender, runs)): (usize, &(Contender, Vec<Run>))| {
        let of = |value: &dyn Fn(&Run) -> f64| Spread::of(runs.iter().map(value));
        let median = |value: &dyn Fn(&Run) -> f64| of(value).map(|spread| spread.median);
        let volume = of(&|run| run.hypervolume);
        let shortest = |run: &Run| {
            run.front
                .iter()
                .map(|c| c[LENGTH])
                .fold(f64::INFINITY, f64::min)
        };
        let scaled = |run: &Run| -> Vec<_> { run.front.iter().map(|c| trial.scaled(c)).collect() };
        let published = published(case, contender);
        let broad = median(&|run| breadth(&in_degrees(&run.front)));
        let reproduced = published
            .number("breadth")
            .zip(broad)
            .map(|(theirs, own)| (own - theirs).abs() <= 0.05 * theirs);
        Row {
            paper: "wang",
            table: case.table,
            case: format!("{} {}", trial.name, case.evaluations),
            planner: contender.planner,
            variant: contender.variant.to_owned(),
            published,
            measured: Numbers::default()
                .with("hypervolume", volume.map(|v| v.median))
                .with("hypervolume q1", volume.map(|v| v.q1))
                .with("hypervolume q3", volume.map(|v| v.q3))
                .with("igd_plus", median(&|run| igd_plus(&scaled(run), &thinned)))
                .with("p", place.checked_sub(1).map(|place| corrected[place]))
                .with("p to moead", beside(runs))
                .with("members", median(&|run| count(run.front.len())))
                .with(
                    "length/optimum",
                    median(&|run| shortest(run) / trial.ideal[LENGTH]),
                )
                .with(
                    "free in time",
                    median(&|run| free_share(&trial.problem, run)),
                )
                .with("breadth", broad)
                .with("error rate", median(&|run| error_rate(&run.front, &union)))
                .with("time ms", median(&|run| run.seconds * 1e3)),
            reproduced,
        }
    };
    fields.iter().enumerate().map(row).collect()
}

/// What the paper prints, of experiment I.
fn published(case: &Case, contender: &Contender) -> Numbers {
    let numbers = Numbers::default();
    match (case.trial.name, contender.planner, contender.variant) {
        ("three-discs", "moabc", "paper") => {
            numbers.with("breadth", 37.6823).with("error rate", 0.0)
        }
        ("three-discs", "nsga2", _) => numbers.with("breadth", 36.9044).with("error rate", 0.002),
        _ => numbers,
    }
}

#[expect(clippy::cast_precision_loss, reason = "a number of members")]
fn count(n: usize) -> f64 {
    n as f64
}

fn in_degrees(front: &[Objectives]) -> Vec<Objectives> {
    let degrees = |cost: &Objectives| {
        let mut cost = *cost;
        cost[TURNING] = cost[TURNING].to_degrees();
        cost
    };
    front.iter().map(degrees).collect()
}

/// The share of a front's plans in which no two robots collide in time.
fn free_share(problem: &TeamProblem, run: &Run) -> f64 {
    let exact = problem.clone().with_timing(Timing::Exact);
    let free = run
        .plans
        .iter()
        .filter(|plan| exact.meeting(plan).is_none());
    count(free.count()) / count(run.plans.len().max(1))
}

/// Those that no other dominates, by ascending length.
fn undominated(mut costs: Vec<Objectives>) -> Vec<Objectives> {
    costs.sort_by(|a, b| {
        let by = |k: usize| a[k].total_cmp(&b[k]);
        by(0).then_with(|| by(1)).then_with(|| by(2))
    });
    // Of those met so far the second and third objectives that no other beats in both.
    let mut stairs: Vec<[f64; 2]> = Vec::new();
    costs.retain(|&[_, y, z]| {
        let before = stairs.partition_point(|step| step[0] <= y);
        if before > 0 && stairs[before - 1][1] <= z {
            return false;
        }
        let from = stairs.partition_point(|step| step[0] < y);
        let beaten = stairs[from..].partition_point(|step| step[1] >= z);
        stairs.splice(from..from + beaten, [[y, z]]);
        true
    });
    costs
}
