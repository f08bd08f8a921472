//! How many runs came near the best known after how much effort.
//!
//! Source: Hansen et al., *COCO: Performance Assessment*, 2016: empirical distributions of runtimes.

use super::{
    Figure,
    chart::{Axes, Curve, curves},
    data::Data,
    table::percent,
};
use crate::{SuiteError, record::Line};

pub(crate) fn figures(data: &Data<'_>, target: f64) -> Result<Vec<Figure>, SuiteError> {
    let mut figures = Vec::new();
    for (evaluations, name, unit) in [
        (true, "ecdf-evaluations", "evaluations"),
        (false, "ecdf-expansions", "expansions"),
    ] {
        let mut lines = Vec::new();
        for (c, contender) in data.contenders.iter().enumerate() {
            if data.evaluates(c) == evaluations && data.all_of(c).next().is_some() {
                lines.push(Curve {
                    name: contender.clone(),
                    contender: c,
                    steps: steps(data, c, target, evaluations),
                    band: Vec::new(),
                    ends: false,
                });
            }
        }
        if lines.is_empty() {
            continue;
        }
        let axes = Axes {
            x: unit,
            y: "share of runs",
            up: (0.0, 1.02),
            mark: None,
        };
        figures.push(Figure {
            name: name.to_owned(),
            title: format!("Runs within {} of the best known, by {unit}", percent(target)),
            words: format!(
                "The share of all runs that had found a path that costs at most {} more than the best \
                 known of its problem, after so many {unit}. A line that does not reach 1 stands for \
                 runs that never came so near.",
                percent(target)
            ),
            svg: curves(&lines, &axes)?,
        });
    }
    Ok(figures)
}

/// By effort, the share of runs that were there.
#[expect(clippy::cast_precision_loss, reason = "counts far below 2^53")]
fn steps(data: &Data<'_>, contender: usize, target: f64, evaluations: bool) -> Vec<(f64, f64)> {
    let runs: Vec<_> = data.all_of(contender).collect();
    let reached = |(p, line): &(usize, &Line)| {
        let most = data.best(*p)? * (1.0 + target) + 1e-9;
        let mut points = line.record.convergence.iter();
        let (evaluated, expanded, _) = points.find(|point| point.2 <= most)?;
        let effort = if evaluations { evaluated } else { expanded };
        Some((*effort as f64).max(1.0))
    };
    let mut efforts: Vec<f64> = runs.iter().filter_map(reached).collect();
    efforts.sort_by(f64::total_cmp);
    let mut steps = vec![(1.0, 0.0)];
    for (k, effort) in (1..).zip(efforts) {
        steps.push((effort, f64::from(k) / runs.len() as f64));
    }
    steps
}
