//! Whether contenders differ by more than chance.

use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor};

/// With at most so many differences the p-value of [`wilcoxon`] is exact.
const EXACT: usize = 25;

/// The two-sided p-value of Wilcoxon's signed-rank test on paired differences; 1 if nothing
/// differs. Differences of nothing are left out, and equal sizes share their mean rank.
///
/// With at most 25 differences it is exact, ties included: all choices of signs are counted. With
/// more it is the normal approximation with corrections for ties and continuity. A difference may be
/// infinite (one of the two never arrived); those that are no numbers are left out.
///
/// Source: Wilcoxon, *Individual Comparisons by Ranking Methods*, 1945.
///
/// ```
/// use pf_suite::comparisons::wilcoxon;
/// // All of six signs agree: two of 64 choices are that extreme.
/// assert_eq!(wilcoxon(&[0.3, 1.2, 0.1, 2.0, 0.7, 0.4]), 2.0 / 64.0);
/// ```
#[must_use]
pub fn wilcoxon(differences: &[f64]) -> f64 {
    let SignedRanks {
        ranks,
        positive,
        ties,
    } = SignedRanks::of(differences);
    if ranks.is_empty() {
        return 1.0;
    }
    if ranks.len() <= EXACT {
        return exact(&ranks, positive);
    }
    let n = float(ranks.len());
    let expected = n * (n + 1.0) / 4.0;
    let variance = n * (n + 1.0) * (2.0 * n + 1.0) / 24.0 - ties / 48.0;
    let off = ((float(positive) / 2.0 - expected).abs() - 0.5).max(0.0);
    libm::erfc(off / variance.sqrt() / std::f64::consts::SQRT_2).min(1.0)
}

/// To which side the test leans: greater if the positive differences have the greater ranks together.
pub(crate) fn leaning(differences: &[f64]) -> std::cmp::Ordering {
    let SignedRanks {
        ranks, positive, ..
    } = SignedRanks::of(differences);
    (2 * positive).cmp(&ranks.iter().sum())
}

/// What the test is made of: the ranks of differences by their size, where there is one. Twice the
/// ranks are whole numbers, ties or not.
struct SignedRanks {
    /// Doubled.
    ranks: Vec<usize>,
    /// Their sum over the positive differences.
    positive: usize,
    /// The sum of t^3 - t over ties of t.
    ties: f64,
}

impl SignedRanks {
    fn of(differences: &[f64]) -> Self {
        let mut sorted: Vec<f64> = differences
            .iter()
            .copied()
            .filter(|d| d.abs() > 0.0)
            .collect();
        sorted.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
        let (mut ranks, mut positive, mut ties) = (Vec::with_capacity(sorted.len()), 0, 0.0);
        for equal in sorted.chunk_by(|a, b| a.abs().total_cmp(&b.abs()).is_eq()) {
            let rank = 2 * ranks.len() + equal.len() + 1;
            ranks.extend(equal.iter().map(|_| rank));
            positive += rank * equal.iter().filter(|d| **d > 0.0).count();
            let count = float(equal.len());
            ties += count * count * count - count;
        }
        Self {
            ranks,
            positive,
            ties,
        }
    }
}

/// The share of all choices of signs that are as extreme as this sum of doubled ranks.
fn exact(ranks: &[usize], positive: usize) -> f64 {
    let total: usize = ranks.iter().sum();
    let mut ways = vec![0.0; total + 1];
    ways[0] = 1.0;
    for &rank in ranks {
        for sum in (rank..=total).rev() {
            ways[sum] += ways[sum - rank];
        }
    }
    let all: f64 = ways.iter().sum();
    let tail: f64 = ways[..=positive.min(total - positive)].iter().sum();
    (2.0 * tail / all).min(1.0)
}

/// Holm's correction of several p-values, in the order given.
///
/// Source: Holm, *A Simple Sequentially Rejective Multiple Test Procedure*, 1979.
#[must_use]
pub fn holm(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    let mut corrected = vec![1.0; values.len()];
    let mut largest: f64 = 0.0;
    for (rank, &i) in order.iter().enumerate() {
        let left = float(values.len() - rank);
        largest = largest.max((values[i] * left).min(1.0));
        corrected[i] = largest;
    }
    corrected
}

/// What Friedman's test says of contenders that are ranked on the same problems.
#[derive(Clone, Debug, PartialEq)]
pub struct Friedman {
    /// By contender, its mean rank; 1 is the best.
    pub ranks: Vec<f64>,
    /// The statistic, corrected for ties.
    pub chi_squared: f64,
    /// Its p-value by the chi-squared distribution, good with many problems.
    pub p: f64,
    /// The p-value by the F distribution, better with few.
    pub p_iman_davenport: f64,
}

/// Ranks contenders on problems: a row per problem, in it a cost per contender, the smaller the
/// better; equal costs share their mean rank. None with fewer than two problems or contenders, or
/// rows of different lengths.
///
/// Source: Friedman 1937; Iman and Davenport 1980; ties after Conover 1999.
#[must_use]
pub fn friedman(problems: &[Vec<f64>]) -> Option<Friedman> {
    let contenders = problems.first()?.len();
    if problems.len() < 2 || contenders < 2 || problems.iter().any(|row| row.len() != contenders) {
        return None;
    }
    let (n, k) = (float(problems.len()), float(contenders));
    let (mut sums, mut squares) = (vec![0.0; contenders], 0.0);
    for row in problems {
        for (sum, rank) in sums.iter_mut().zip(ranks(row)) {
            *sum += rank;
            squares += rank * rank;
        }
    }
    let even = n * k * (k + 1.0) * (k + 1.0) / 4.0;
    let between: f64 = sums.iter().map(|sum| sum * sum).sum::<f64>() / n - even;
    let spread = squares - even;
    // Everybody equal everywhere.
    let chi_squared = if spread > 0.0 {
        (k - 1.0) * n * between / spread
    } else {
        0.0
    };
    let left = n * (k - 1.0) - chi_squared;
    let p_iman_davenport = if left > 1e-9 {
        let statistic = (n - 1.0) * chi_squared / left;
        let f = FisherSnedecor::new(k - 1.0, (k - 1.0) * (n - 1.0)).ok()?;
        f.sf(statistic)
    } else {
        // All problems agree: as likely as that the others repeat the first one's order (Conover 1999).
        let orders: f64 = (1..=contenders).map(float).product();
        orders.powf(1.0 - n)
    };
    Some(Friedman {
        ranks: sums.iter().map(|sum| sum / n).collect(),
        chi_squared,
        p: ChiSquared::new(k - 1.0).ok()?.sf(chi_squared),
        p_iman_davenport,
    })
}

/// Ranks from 1 for the smallest; equal values share their mean rank.
#[must_use]
pub fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    let mut ranks = vec![0.0; values.len()];
    let mut before = 0;
    for equal in order.chunk_by(|&a, &b| values[a].total_cmp(&values[b]).is_eq()) {
        let rank = float(2 * before + equal.len() + 1) / 2.0;
        for &i in equal {
            ranks[i] = rank;
        }
        before += equal.len();
    }
    ranks
}

/// How far apart two mean ranks must be to differ at this level, all pairs compared: Nemenyi's
/// critical difference.
///
/// Source: Demsar, *Statistical Comparisons of Classifiers over Multiple Data Sets*, 2006, section 3.2.2.
///
/// ```
/// # use pf_suite::comparisons::critical_difference;
/// // Its example: four contenders on fourteen problems.
/// assert!((critical_difference(4, 14, 0.05) - 1.25).abs() < 0.005);
/// ```
#[must_use]
pub fn critical_difference(contenders: usize, problems: usize, level: f64) -> f64 {
    let (k, n) = (float(contenders), float(problems));
    let q = studentised_range(contenders, level) / std::f64::consts::SQRT_2;
    q * (k * (k + 1.0) / (6.0 * n)).sqrt()
}

/// The value that the range of so many standard normal variables exceeds with this probability.
///
/// The range's distribution is k times the integral of phi(z) (Phi(z) - Phi(z - q))^(k - 1) over z
/// (Tippett 1925), here by Simpson's rule, and inverted by halving.
#[must_use]
pub fn studentised_range(variables: usize, level: f64) -> f64 {
    if variables < 2 {
        return 0.0;
    }
    let (mut low, mut high) = (0.0, 60.0);
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if 1.0 - range_below(variables, middle) > level {
            low = middle;
        } else {
            high = middle;
        }
    }
    f64::midpoint(low, high)
}

/// The probability that the range of so many standard normal variables is at most `q`.
fn range_below(variables: usize, q: f64) -> f64 {
    const STEPS: u32 = 2000;
    // The largest of the variables is hardly ever out of these.
    const ENDS: [f64; 2] = [-9.0, 9.0];
    let phi = |z: f64| (-z * z / 2.0).exp() / (2.0 * std::f64::consts::PI).sqrt();
    let below = |z: f64| libm::erfc(-z / std::f64::consts::SQRT_2) / 2.0;
    let step = (ENDS[1] - ENDS[0]) / f64::from(STEPS);
    let power = i32::try_from(variables - 1).unwrap_or(i32::MAX);
    let mut sum = 0.0;
    for i in 0..=STEPS {
        let z = ENDS[0] + f64::from(i) * step;
        let weight = match i {
            0 | STEPS => 1.0,
            i if i % 2 == 1 => 4.0,
            _ => 2.0,
        };
        sum += weight * phi(z) * (below(z) - below(z - q)).powi(power);
    }
    float(variables) * sum * step / 3.0
}

#[expect(clippy::cast_precision_loss, reason = "a number of runs")]
fn float(n: usize) -> f64 {
    n as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn holm_multiplies_the_least_most() {
        let corrected = holm(&[0.01, 0.04, 0.03]);
        let expected = [0.03, 0.06, 0.06];
        assert!(
            corrected
                .iter()
                .zip(expected)
                .all(|(a, b)| (a - b).abs() < 1e-12)
        );
    }

    #[test]
    fn nothing_to_compare_is_no_difference() {
        assert!((wilcoxon(&[]) - 1.0).abs() < 1e-15);
        assert!((wilcoxon(&[0.0; 5]) - 1.0).abs() < 1e-15);
        assert!((wilcoxon(&[f64::NAN, 0.0]) - 1.0).abs() < 1e-15);
        assert!(wilcoxon(&[1.0, -1.0, 2.0, -2.0]) > 0.99);
        assert_eq!(friedman(&[]), None);
        assert_eq!(friedman(&[vec![1.0, 2.0]]), None);
        let equal = friedman(&[vec![1.0; 3], vec![2.0; 3]]).unwrap();
        assert!(equal.p > 0.99 && equal.p_iman_davenport > 0.99);
    }

    #[test]
    fn problems_that_all_agree_are_as_many_as_they_are() {
        let p = |n: usize| friedman(&vec![vec![1.0, 2.0]; n]).unwrap().p_iman_davenport;
        assert!((p(2) - 0.5).abs() < 1e-12 && (p(3) - 0.25).abs() < 1e-12);
    }

    #[test]
    fn the_verdict_is_that_of_the_ranks_and_not_of_the_counts() {
        // More of the small ones are negative; the large ones decide.
        let differences: Vec<f64> = (1..=27)
            .map(|d| f64::from(if d <= 14 { -d } else { d }))
            .collect();
        assert!(wilcoxon(&differences) < 0.05 && leaning(&differences).is_gt());
        assert!(leaning(&[1.0, -1.0]).is_eq() && leaning(&[]).is_eq());
    }

    #[test]
    fn who_never_arrives_ranks_last() {
        let infinite = [f64::INFINITY; 6];
        assert!((wilcoxon(&infinite) - 2.0 / 64.0).abs() < 1e-15);
        let last = ranks(&[3.0, f64::INFINITY, 1.0, f64::INFINITY]);
        assert_eq!(format!("{last:?}"), "[2.0, 3.5, 1.0, 3.5]");
    }
}
