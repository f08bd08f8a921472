//! What the tables hold.

use super::{
    data::Data,
    table::{Table, p_value, percent, short, time, within},
};
use crate::{
    comparisons::{Friedman, critical_difference, friedman, holm, leaning, wilcoxon},
    record::Line,
    statistics::{Spread, median_interval, wilson},
};
use std::cmp::Ordering;

/// Medians and intervals of some numbers.
pub(crate) fn median(values: &[f64], show: impl Fn(f64) -> String) -> String {
    let median = Spread::of(values.iter().copied()).map(|spread| spread.median);
    median.map_or_else(
        || "-".to_owned(),
        |median| within(median, median_interval(values), show),
    )
}

/// The rate of runs that were solved, and the interval in which it lies.
pub(crate) fn success<'l>(lines: impl Iterator<Item = &'l Line>) -> (u32, u32, [f64; 2]) {
    let (mut solved, mut runs) = (0, 0);
    for line in lines {
        runs += 1;
        solved += u32::from(line.record.solved());
    }
    (solved, runs, wilson(solved, runs))
}

/// Everybody over all problems.
pub(crate) fn contenders(data: &Data<'_>) -> Table {
    let row = |c: usize| {
        let lines: Vec<_> = data.all_of(c).collect();
        let (solved, runs, [low, high]) = success(lines.iter().map(|(_, line)| *line));
        let rate = if runs == 0 {
            "-".to_owned()
        } else {
            let rate = f64::from(solved) / f64::from(runs);
            within(rate, Some([low, high]), percent)
        };
        let found = || lines.iter().filter(|(_, line)| line.record.solved());
        let over: Vec<f64> = found()
            .map(|(p, line)| data.relative(*p, line) - 1.0)
            .collect();
        let times: Vec<f64> = lines.iter().map(|(_, l)| l.times.elapsed_us).collect();
        let effort: Vec<f64> = lines.iter().map(|(_, l)| effort(data, c, l)).collect();
        let unit = if data.evaluates(c) { "ev" } else { "ex" };
        let count = |word: &str| {
            let count = lines
                .iter()
                .filter(|(_, l)| l.record.outcome == word)
                .count();
            (count > 0).then(|| format!("{count} {word}"))
        };
        let declined = data.declined(c);
        let declined = (declined > 0).then(|| format!("{declined} declined"));
        let odd: Vec<_> = [
            count("panicked"),
            count("failed"),
            count("refused"),
            declined,
        ]
        .into_iter()
        .flatten()
        .collect();
        vec![
            data.contenders[c].clone(),
            runs.to_string(),
            solved.to_string(),
            rate,
            median(&over, percent),
            median(&times, time),
            format!("{} {unit}", median(&effort, short)),
            odd.join(", "),
        ]
    };
    Table {
        name: "contenders",
        title: "Contenders, over all problems".to_owned(),
        words: "Success with Wilson's 95 % interval. Medians with 95 % bootstrap intervals: how much \
                more than the best known a found path costs, the time of a run, evaluations (ev) or \
                expansions (ex) of a run."
            .to_owned(),
        heads: vec![
            "contender",
            "runs",
            "solved",
            "success",
            "over the best",
            "time",
            "effort",
            "",
        ],
        names: 1,
        grouped: false,
        rows: (0..data.contenders.len()).map(row).collect(),
    }
}

/// What a run took: evaluations where there are any, else expansions.
#[expect(clippy::cast_precision_loss, reason = "counts far below 2^53")]
fn effort(data: &Data<'_>, contender: usize, line: &Line) -> f64 {
    let record = &line.record;
    if data.evaluates(contender) {
        record.evaluations as f64
    } else {
        record.expanded as f64
    }
}

/// Everybody on every problem.
pub(crate) fn problems(data: &Data<'_>) -> Table {
    let mut rows = Vec::new();
    for (p, problem) in data.problems.iter().enumerate() {
        for (c, contender) in data.contenders.iter().enumerate() {
            let lines = data.runs(p, c);
            if lines.is_empty() {
                continue;
            }
            let (solved, runs, _) = success(lines.iter().copied());
            let numbers = |of: &dyn Fn(&Line) -> Option<f64>| -> Vec<f64> {
                lines.iter().filter_map(|line| of(line)).collect()
            };
            let over: Vec<f64> = lines
                .iter()
                .filter(|line| line.record.solved())
                .map(|line| data.relative(p, line) - 1.0)
                .collect();
            let mut row = vec![
                problem.clone(),
                contender.clone(),
                format!("{solved}/{runs}"),
                median(&numbers(&|l| l.record.cost), short),
                median(&over, percent),
                median(&numbers(&|l| l.record.length), short),
                median(&numbers(&|l| l.record.clearance), short),
                median(&numbers(&|l| Some(l.times.elapsed_us)), time),
            ];
            if data.has_fronts() {
                row.push(median(&numbers(&|l| data.volume(p, l)), short));
            }
            rows.push(row);
        }
    }
    let mut heads = vec![
        "problem",
        "contender",
        "solved",
        "cost",
        "over the best",
        "length",
        "clearance",
        "time",
    ];
    let mut words = "Medians over the seeds, with 95 % bootstrap intervals; of the runs that were \
                     solved, but times of all."
        .to_owned();
    if data.has_fronts() {
        heads.push("hypervolume");
        words += " For teams the cost is the length of the shortest plan, and the hypervolume the share \
                  of the box of all three objectives that a front dominates, from the best of each that \
                  was found to a tenth beyond the worst among plans that no other dominates.";
    }
    Table {
        name: "problems",
        title: "By problem".to_owned(),
        words,
        heads,
        names: 2,
        grouped: true,
        rows,
    }
}

/// Two contenders and what tells them apart.
struct Pair {
    names: Vec<String>,
    better: usize,
    equal: usize,
    worse: usize,
    p: f64,
    /// Less where the test finds the first the cheaper one.
    leans: Ordering,
}

impl Pair {
    fn of(names: Vec<String>, scores: &[(f64, f64)]) -> Self {
        let count = |wanted: Ordering| {
            let same = |(a, b): &&(f64, f64)| a.total_cmp(b) == wanted;
            scores.iter().filter(same).count()
        };
        let differences: Vec<f64> = scores.iter().map(|(a, b)| a - b).collect();
        Self {
            names,
            better: count(Ordering::Less),
            equal: count(Ordering::Equal),
            worse: count(Ordering::Greater),
            p: wilcoxon(&differences),
            leans: leaning(&differences),
        }
    }
}

fn rows_of(pairs: Vec<Pair>) -> Vec<Vec<String>> {
    let corrected = holm(&pairs.iter().map(|pair| pair.p).collect::<Vec<_>>());
    let row = |(pair, corrected): (Pair, f64)| {
        let counts = [pair.better, pair.equal, pair.worse].map(|n| n.to_string());
        let verdict = match (corrected < 0.05, pair.leans.is_lt()) {
            (false, _) => "",
            (true, true) => "better",
            (true, false) => "worse",
        };
        let numbers = [p_value(pair.p), p_value(corrected), verdict.to_owned()];
        pair.names
            .into_iter()
            .chain(counts)
            .chain(numbers)
            .collect()
    };
    pairs.into_iter().zip(corrected).map(row).collect()
}

/// Pairs over problems: a problem counts once, however many seeds.
fn over_problems(
    data: &Data<'_>,
    score: impl Fn(usize, usize) -> Option<f64>,
) -> (Vec<Vec<String>>, usize) {
    let mut pairs = Vec::new();
    let mut most = 0;
    for a in 0..data.contenders.len() {
        for b in a + 1..data.contenders.len() {
            let both = |p| Some((score(p, a)?, score(p, b)?));
            let scores: Vec<_> = (0..data.problems.len()).filter_map(both).collect();
            if !scores.is_empty() {
                most = most.max(scores.len());
                let names = [a, b].map(|c| data.contenders[c].clone());
                pairs.push(Pair::of(names.to_vec(), &scores));
            }
        }
    }
    (rows_of(pairs), most)
}

const OF_PAIRS: [&str; 8] = [
    "first",
    "second",
    "better",
    "equal",
    "worse",
    "p",
    "p (Holm)",
    "the first is",
];

/// Who finds better answers.
pub(crate) fn pairs(data: &Data<'_>) -> Table {
    let (rows, most) = over_problems(data, |p, c| data.score(p, c));
    let teams = if data.has_fronts() {
        ", for teams on the hypervolumes of their fronts"
    } else {
        ""
    };
    let least = (0..most).fold(2.0f64, |p, _| p / 2.0).min(1.0);
    // As good as nothing is not worth a word.
    let least = if least > 0.001 {
        let least = p_value(least);
        format!(" With {most} problems p cannot be less than {least}.")
    } else {
        String::new()
    };
    Table {
        name: "pairs",
        title: "Pairs, over problems: costs".to_owned(),
        words: format!(
            "Wilcoxon's signed-rank test on the median costs of both on each problem, as multiples of \
             the best known{teams}; who does not arrive is worse than any who does. Counts are problems \
             on which the first was better, equal, worse. p is two-sided, exact up to 25 differences; the \
             last is corrected by Holm for all pairs.{least}"
        ),
        heads: OF_PAIRS.to_vec(),
        names: 2,
        grouped: false,
        rows,
    }
}

/// Who is quicker.
pub(crate) fn pairs_in_time(data: &Data<'_>) -> Table {
    let time = |p, c| {
        let times = data.runs(p, c).iter().map(|line| line.times.elapsed_us);
        Some(Spread::of(times)?.median.max(1e-3).ln())
    };
    Table {
        name: "pairs-in-time",
        title: "Pairs, over problems: times".to_owned(),
        words:
            "The same test on the logarithms of the median times of both on each problem, whether \
                they arrived or not: a ratio counts the same on quick problems and slow ones."
                .to_owned(),
        heads: OF_PAIRS.to_vec(),
        names: 2,
        grouped: false,
        rows: over_problems(data, time).0,
    }
}

/// Pairs on each problem, over seeds that both ran with.
pub(crate) fn pairs_by_problem(data: &Data<'_>) -> Table {
    let mut pairs = Vec::new();
    for p in 0..data.problems.len() {
        for a in 0..data.contenders.len() {
            for b in a + 1..data.contenders.len() {
                let shared = shared(data, p, a, b);
                // Where chance has no part in either there is nothing to test.
                let chance = |side: &dyn Fn(&(f64, f64)) -> f64| {
                    shared
                        .windows(2)
                        .any(|w| side(&w[0]).total_cmp(&side(&w[1])).is_ne())
                };
                if shared.len() >= 2 && (chance(&|s| s.0) || chance(&|s| s.1)) {
                    let names = [
                        data.problems[p].clone(),
                        data.contenders[a].clone(),
                        data.contenders[b].clone(),
                    ];
                    pairs.push(Pair::of(names.to_vec(), &shared));
                }
            }
        }
    }
    Table {
        name: "pairs-by-problem",
        title: "Pairs, by problem, over seeds".to_owned(),
        words: "The same test on the costs of runs with the same seed; corrected by Holm for all rows. \
                Pairs in which chance has no part are left out."
            .to_owned(),
        heads: vec![
            "problem", "first", "second", "better", "equal", "worse", "p", "p (Holm)",
            "the first is",
        ],
        names: 3,
        grouped: true,
        rows: rows_of(pairs),
    }
}

fn shared(data: &Data<'_>, problem: usize, a: usize, b: usize) -> Vec<(f64, f64)> {
    let score = |line: &Line| data.score_of(problem, line);
    let others = data.runs(problem, b);
    let pair = |line: &&Line| {
        let seed = line.record.seed;
        let at = others.binary_search_by_key(&seed, |other| other.record.seed);
        Some((score(line), score(others[at.ok()?])))
    };
    data.runs(problem, a).iter().filter_map(pair).collect()
}

/// Mean ranks over the problems in which everybody has a part.
pub(crate) struct Ranking {
    /// By mean rank, the best first.
    pub(crate) order: Vec<(usize, f64)>,
    pub(crate) problems: usize,
    pub(crate) test: Friedman,
    /// At 5 %.
    pub(crate) critical: f64,
}

pub(crate) fn ranking(data: &Data<'_>) -> Option<Ranking> {
    // Whoever has no part in anything is ranked nowhere.
    let there: Vec<usize> = (0..data.contenders.len())
        .filter(|&c| data.all_of(c).next().is_some())
        .collect();
    let row = |p| -> Option<Vec<f64>> { there.iter().map(|&c| data.score(p, c)).collect() };
    let rows: Vec<Vec<f64>> = (0..data.problems.len()).filter_map(row).collect();
    let test = friedman(&rows)?;
    let mut order: Vec<_> = there
        .iter()
        .copied()
        .zip(test.ranks.iter().copied())
        .collect();
    order.sort_by(|a, b| a.1.total_cmp(&b.1));
    Some(Ranking {
        critical: critical_difference(there.len(), rows.len(), 0.05),
        order,
        problems: rows.len(),
        test,
    })
}

pub(crate) fn ranks(data: &Data<'_>, ranking: &Ranking) -> Table {
    let row = |(c, rank): &(usize, f64)| vec![data.contenders[*c].clone(), format!("{rank:.2}")];
    let (p, f) = (ranking.test.p, ranking.test.p_iman_davenport);
    Table {
        name: "ranks",
        title: "Mean ranks".to_owned(),
        words: format!(
            "Over the {} problems in which all take part; 1 is the best. Friedman: chi squared {:.2}, p \
             {}; by the F distribution of Iman and Davenport {}. Nemenyi: at 5 % two differ if their \
             ranks are {:.2} apart.",
            ranking.problems,
            ranking.test.chi_squared,
            p_value(p),
            p_value(f),
            ranking.critical
        ),
        heads: vec!["contender", "mean rank"],
        names: 1,
        grouped: false,
        rows: ranking.order.iter().map(row).collect(),
    }
}
