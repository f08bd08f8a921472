//! How times are taken and told.

use anyhow::Result;
use serde::Serialize;
use std::{
    hint::black_box,
    io::{Write, stdout},
    time::{Duration, Instant},
};

/// How often a query is asked; its least time counts.
pub(crate) const REPETITIONS: u32 = 5;

/// Times one piece of work.
#[expect(clippy::disallowed_methods, reason = "a benchmark reads the clock")]
pub(crate) fn timed<T>(work: impl FnOnce() -> T) -> (Duration, T) {
    let begin = Instant::now();
    let result = black_box(work());
    (begin.elapsed(), result)
}

/// What one contender did over the queries of one map.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tally {
    /// Least time of each query in microseconds.
    micros: Vec<f64>,
    pub(crate) mismatches: u64,
    pub(crate) expanded: u64,
    /// Queries to which the answer was that there is no path.
    pub(crate) unsolved: u64,
}

impl Tally {
    pub(crate) fn add(&mut self, least: Duration) {
        self.add_us(least.as_secs_f64() * 1e6);
    }

    /// The same in microseconds, for what is shorter than a clock's tick and timed in batches.
    pub(crate) fn add_us(&mut self, least: f64) {
        self.micros.push(least);
    }

    /// How many queries were asked.
    pub(crate) fn queries(&self) -> usize {
        self.micros.len()
    }

    pub(crate) fn sum(&self) -> f64 {
        self.micros.iter().sum()
    }

    pub(crate) fn mean(&self) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "a number of queries")]
        let queries = self.micros.len() as f64;
        self.sum() / queries
    }

    /// The value below which a share of the queries lies.
    pub(crate) fn quantile(&self, share: f64) -> f64 {
        let mut sorted = self.micros.clone();
        sorted.sort_by(f64::total_cmp);
        #[expect(
            clippy::cast_precision_loss,
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "an index"
        )]
        let at = ((sorted.len().max(1) - 1) as f64 * share).round() as usize;
        sorted.get(at).copied().unwrap_or(f64::NAN)
    }

    pub(crate) fn ns_per_expansion(&self) -> Option<f64> {
        #[expect(clippy::cast_precision_loss, reason = "a number of expansions")]
        let expanded = self.expanded as f64;
        (self.expanded > 0).then(|| self.sum() * 1e3 / expanded)
    }

    fn expansions(&self) -> Option<f64> {
        #[expect(
            clippy::cast_precision_loss,
            reason = "numbers of expansions and queries"
        )]
        let mean = self.expanded as f64 / self.micros.len() as f64;
        (self.expanded > 0).then_some(mean)
    }

    pub(crate) fn row(&self, case: &str, planner: &str) -> Row {
        Row {
            suite: "grid",
            case: case.to_owned(),
            planner: planner.to_owned(),
            queries: self.micros.len(),
            mean_us: self.mean(),
            median_us: self.quantile(0.5),
            p95_us: self.quantile(0.95),
            mismatches: self.mismatches,
            ns_per_expansion: self.ns_per_expansion(),
            bytes_per_cell: None,
            kind: "",
            moves: None,
            expanded: self.expansions(),
            allocations: None,
            unsolved: self.unsolved,
            original_ns_per_expansion: None,
        }
    }
}

/// One line of the answer.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Row {
    pub(crate) suite: &'static str,
    pub(crate) case: String,
    pub(crate) planner: String,
    pub(crate) queries: usize,
    pub(crate) mean_us: f64,
    pub(crate) median_us: f64,
    pub(crate) p95_us: f64,
    pub(crate) mismatches: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) ns_per_expansion: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) bytes_per_cell: Option<f64>,
    /// Rows of a kind are compared with each other.
    #[serde(skip)]
    pub(crate) kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) moves: Option<&'static str>,
    /// Per query.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) expanded: Option<f64>,
    /// Per query, once there is all the memory that is wanted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) allocations: Option<f64>,
    /// Queries to which the answer was that there is no path.
    pub(crate) unsolved: u64,
    /// Of the map that this one was made from by cutting its cells.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) original_ns_per_expansion: Option<f64>,
}

/// Prints a line to stdout.
pub(crate) fn say(line: impl std::fmt::Display) -> Result<()> {
    Ok(writeln!(stdout().lock(), "{line}")?)
}

pub(crate) fn json(row: &impl Serialize) -> Result<()> {
    say(serde_json::to_string(row)?)
}

/// The geometric mean.
pub(crate) fn geometric_mean(values: &[f64]) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "a number of maps")]
    let n = values.len() as f64;
    (values.iter().map(|v| v.ln()).sum::<f64>() / n).exp()
}
