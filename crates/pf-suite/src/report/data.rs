//! Runs by problem and contender.

use crate::{record::Line, statistics::Spread};
use pf_core::Front;
use pf_geom::Objectives;
use pf_moabc::indicators::hypervolume;
use std::{
    array,
    collections::{BTreeMap, BTreeSet},
};

/// All that is reported on.
#[derive(Debug)]
pub(crate) struct Data<'l> {
    pub(crate) suites: Vec<String>,
    pub(crate) problems: Vec<String>,
    pub(crate) contenders: Vec<String>,
    /// By problem and contender, by ascending seed; those that were declined are not among them.
    runs: BTreeMap<(usize, usize), Vec<&'l Line>>,
    declined: Vec<usize>,
    /// By problem, the least cost that anybody found.
    best: Vec<Option<f64>>,
    /// By problem, for fronts, the least and the greatest of each objective among the best plans.
    boxes: Vec<Option<[Objectives; 2]>>,
}

impl<'l> Data<'l> {
    /// Of runs that [`merged`](crate::folder::merged) has sorted.
    pub(crate) fn of(lines: &'l [Line]) -> Self {
        let set = |name: &dyn Fn(&Line) -> String| -> Vec<String> {
            let names: BTreeSet<String> = lines.iter().map(name).collect();
            names.into_iter().collect()
        };
        let suites = set(&|line| line.record.suite.clone());
        let several = suites.len() > 1;
        let problem_of = |line: &Line| {
            let record = &line.record;
            if several {
                format!("{}: {}", record.suite, record.problem)
            } else {
                record.problem.clone()
            }
        };
        let problems = set(&problem_of);
        let contenders = set(&|line| line.record.contender());
        let mut runs: BTreeMap<(usize, usize), Vec<&Line>> = BTreeMap::new();
        let mut declined = vec![0; contenders.len()];
        let mut best: Vec<Option<f64>> = vec![None; problems.len()];
        for line in lines {
            // Both are there, as the lists are made of the same lines.
            let p = problems.binary_search(&problem_of(line)).unwrap_or(0);
            let c = contenders
                .binary_search(&line.record.contender())
                .unwrap_or(0);
            if line.record.outcome == "declined" {
                declined[c] += 1;
                continue;
            }
            runs.entry((p, c)).or_default().push(line);
            if let Some(cost) = line.record.cost {
                let least = best[p].map_or(cost, |least| least.min(cost));
                best[p] = Some(least);
            }
        }
        let boxes = (0..problems.len()).map(|p| {
            let here = runs.range((p, 0)..(p + 1, 0)).flat_map(|(_, lines)| lines);
            spanned(here.flat_map(|line| line.record.front.iter().copied()))
        });
        Self {
            boxes: boxes.collect(),
            suites,
            problems,
            contenders,
            runs,
            declined,
            best,
        }
    }

    /// The runs of a contender on a problem.
    pub(crate) fn runs(&self, problem: usize, contender: usize) -> &[&'l Line] {
        self.runs
            .get(&(problem, contender))
            .map_or(&[], Vec::as_slice)
    }

    /// All runs of a contender, each with its problem.
    pub(crate) fn all_of(&self, contender: usize) -> impl Iterator<Item = (usize, &'l Line)> {
        let here = self.runs.iter().filter(move |((_, c), _)| *c == contender);
        here.flat_map(|((p, _), lines)| lines.iter().map(move |line| (*p, *line)))
    }

    pub(crate) fn declined(&self, contender: usize) -> usize {
        self.declined[contender]
    }

    pub(crate) fn best(&self, problem: usize) -> Option<f64> {
        self.best[problem]
    }

    /// A cost as a multiple of the best that is known; infinite without a solution.
    pub(crate) fn relative(&self, problem: usize, line: &Line) -> f64 {
        match (line.record.cost, self.best[problem]) {
            (Some(cost), Some(best)) if best > 0.0 => cost / best,
            // Nobody can be better than at the goal already.
            (Some(cost), _) => 1.0 + cost,
            (None, _) => f64::INFINITY,
        }
    }

    /// How good a run is, the smaller the better: the cost as a multiple of the best; for a team the
    /// share of the objectives' box that the front leaves free. To nine digits, so that rounding makes
    /// nobody better.
    pub(crate) fn score_of(&self, problem: usize, line: &Line) -> f64 {
        rounded(match self.volume(problem, line) {
            Some(volume) => 1.0 - volume,
            None => self.relative(problem, line),
        })
    }

    /// The share of the box that a front dominates: the box reaches from the best of each objective
    /// that anybody found a tenth beyond the worst among the plans that nobody dominates.
    pub(crate) fn volume(&self, problem: usize, line: &Line) -> Option<f64> {
        let [ideal, nadir] = self.boxes[problem]?;
        let front = &line.record.front;
        if front.is_empty() {
            return None;
        }
        let scaled = front.iter().map(|cost| -> Objectives {
            array::from_fn(|k| (cost[k] - ideal[k]) / (nadir[k] - ideal[k]).max(1e-12))
        });
        let scaled: Vec<_> = scaled.collect();
        Some(hypervolume(&scaled, &[1.1; 3]) / 1.1f64.powi(3))
    }

    /// A contender's score on a problem: the median of its runs. None if it has no part in it.
    pub(crate) fn score(&self, problem: usize, contender: usize) -> Option<f64> {
        let runs = self.runs(problem, contender);
        let scores = runs.iter().map(|line| self.score_of(problem, line));
        Some(rounded(Spread::of(scores)?.median))
    }

    pub(crate) fn has_fronts(&self) -> bool {
        self.boxes.iter().any(Option::is_some)
    }

    /// Whether it makes whole attempts, or else expands states.
    pub(crate) fn evaluates(&self, contender: usize) -> bool {
        self.all_of(contender)
            .any(|(_, line)| line.record.evaluations > 0)
    }
}

/// The least and the greatest of each objective among the plans that no other dominates.
fn spanned(costs: impl Iterator<Item = Objectives>) -> Option<[Objectives; 2]> {
    let front: Front<Objectives> = costs.collect();
    let first = *front.members().first()?;
    let fold = |pick: fn(f64, f64) -> f64| -> Objectives {
        let members = front.members().iter();
        members.fold(first, |ends, cost| {
            array::from_fn(|k| pick(ends[k], cost[k]))
        })
    };
    Some([fold(f64::min), fold(f64::max)])
}

fn rounded(value: f64) -> f64 {
    format!("{value:.8e}").parse().unwrap_or(value)
}
