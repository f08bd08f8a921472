//! Runs by problem and contender.

use crate::record::Line;
use std::collections::{BTreeMap, BTreeSet};

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
        Self {
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

    /// A contender's score on a problem, the smaller the better: the median of its costs as multiples
    /// of the best, to nine digits, so that rounding makes nobody better. None if it has no part in it.
    pub(crate) fn score(&self, problem: usize, contender: usize) -> Option<f64> {
        let runs = self.runs(problem, contender);
        let costs = runs.iter().map(|line| self.relative(problem, line));
        let median = crate::statistics::Spread::of(costs)?.median;
        Some(rounded(median))
    }

    /// Whether it makes whole attempts, or else expands states.
    pub(crate) fn evaluates(&self, contender: usize) -> bool {
        self.all_of(contender)
            .any(|(_, line)| line.record.evaluations > 0)
    }
}

pub(crate) fn rounded(value: f64) -> f64 {
    format!("{value:.8e}").parse().unwrap_or(value)
}
