//! The best cost so far, by evaluations: medians and quartiles over seeds.

use super::{
    Figure,
    chart::{Axes, Curve, curves},
    data::Data,
};
use crate::{SuiteError, record::Line, statistics::Spread};

/// A figure per problem in which somebody makes whole attempts.
pub(crate) fn figures(data: &Data<'_>) -> Result<Vec<Figure>, SuiteError> {
    let mut figures = Vec::new();
    for (p, problem) in data.problems.iter().enumerate() {
        let curve = |c: usize| {
            let steps = quartiles(data.runs(p, c));
            (!steps.is_empty()).then(|| Curve {
                name: data.contenders[c].clone(),
                contender: c,
                band: steps.iter().map(|(_, s)| (s.q1, s.q3)).collect(),
                steps: steps.iter().map(|(at, s)| (*at, s.median)).collect(),
                ends: true,
            })
        };
        let all = 0..data.contenders.len();
        let lines = all.filter(|&c| data.evaluates(c)).filter_map(curve);
        let mut lines: Vec<Curve> = lines.collect();
        let Some(best) = data.best(p).filter(|_| !lines.is_empty()) else {
            continue;
        };
        let heights = || lines.iter().flat_map(|curve| &curve.steps).map(|s| s.1);
        let highest = heights().fold(best, f64::max);
        let room = ((highest - best) * 0.06).max(best.abs() * 0.01).max(1e-9);
        let up = (best - room, highest + room);
        for curve in &mut lines {
            for (low, high) in &mut curve.band {
                // A quarter that has not arrived yet is somewhere above.
                (*low, *high) = (low.min(up.1), high.min(up.1));
            }
        }
        let axes = Axes {
            x: "evaluations",
            y: "cost of the best path so far",
            up,
            mark: Some((best, "best known")),
        };
        figures.push(Figure {
            name: format!("convergence-{}", file_name(problem)),
            title: format!("Convergence: {problem}"),
            words: "The median over the seeds and the middle half of the runs, from where more than half \
                    of the runs have a path; a dot where the longest of them ended."
                .to_owned(),
            svg: curves(&lines, &axes)?,
        });
    }
    Ok(figures)
}

/// At each place where some run improves: the spread of costs, from where the median is finite.
#[expect(clippy::cast_precision_loss, reason = "counts far below 2^53")]
fn quartiles(runs: &[&Line]) -> Vec<(f64, Spread)> {
    let mut places: Vec<u64> = runs
        .iter()
        .flat_map(|line| {
            let points = line.record.convergence.iter().map(|point| point.0);
            points.chain([line.record.evaluations])
        })
        .map(|place| place.max(1))
        .collect();
    places.sort_unstable();
    places.dedup();
    let mut steps = Vec::new();
    for place in places {
        let cost = |line: &&Line| {
            let points = line.record.convergence.iter();
            let so_far = points.filter(|point| point.0.max(1) <= place);
            so_far.map(|point| point.2).fold(f64::INFINITY, f64::min)
        };
        if let Some(spread) = Spread::of(runs.iter().map(cost))
            && spread.median.is_finite()
        {
            steps.push((place as f64, spread));
        }
    }
    steps
}

/// A problem's name as one of a file.
fn file_name(problem: &str) -> String {
    let plain = |c: char| match c {
        c if c.is_alphanumeric() || matches!(c, '-' | '.' | '_') => c,
        _ => '-',
    };
    problem.chars().map(plain).collect()
}
