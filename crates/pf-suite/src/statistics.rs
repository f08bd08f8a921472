//! What is said of many runs.

use pf_core::PlanRng;
use rand::{RngExt, SeedableRng};
use serde::Serialize;

/// Mean, median and quartiles.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// The mean.
    pub mean: f64,
    /// The least.
    pub least: f64,
    /// The first quartile.
    pub q1: f64,
    /// The median.
    pub median: f64,
    /// The third quartile.
    pub q3: f64,
    /// The greatest.
    pub most: f64,
}

impl Spread {
    /// Of these values; none if there are none.
    #[must_use]
    pub fn of(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut sorted: Vec<f64> = values.into_iter().collect();
        sorted.sort_by(f64::total_cmp);
        let (&least, &most) = (sorted.first()?, sorted.last()?);
        let at = |share: f64| quantile(&sorted, share);
        Some(Self {
            mean: mean(&sorted),
            least,
            q1: at(0.25),
            median: at(0.5),
            q3: at(0.75),
            most,
        })
    }
}

#[expect(clippy::cast_precision_loss, reason = "a number of runs")]
fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Between the two values nearest to it, in proportion.
#[expect(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "an index"
)]
fn quantile(sorted: &[f64], share: f64) -> f64 {
    let place = share * (sorted.len() - 1) as f64;
    let below = place as usize;
    let above = (below + 1).min(sorted.len() - 1);
    let part = place - below as f64;
    // Infinities are values, too, and nothing times one is none.
    if part <= 0.0 || sorted[below].total_cmp(&sorted[above]).is_eq() {
        return sorted[below];
    }
    sorted[below] + (sorted[above] - sorted[below]) * part
}

/// The interval in which the rate behind `hits` of `runs` lies with 95 % confidence.
///
/// Source: Wilson, *Probable Inference, the Law of Succession, and Statistical Inference*, 1927.
///
/// ```
/// # use pf_suite::statistics::wilson;
/// let [low, high] = wilson(0, 20);
/// assert!(low == 0.0 && (high - 0.161).abs() < 0.001);
/// let [low, high] = wilson(20, 20);
/// assert!((low - 0.839).abs() < 0.001 && high == 1.0);
/// ```
#[must_use]
pub fn wilson(hits: u32, runs: u32) -> [f64; 2] {
    const Z: f64 = 1.959_963_984_540_054;
    if runs == 0 {
        return [0.0, 1.0];
    }
    let n = f64::from(runs);
    let p = f64::from(hits) / n;
    let centre = p + Z * Z / (2.0 * n);
    let half = Z * (p * (1.0 - p) / n + Z * Z / (4.0 * n * n)).sqrt();
    let scale = 1.0 + Z * Z / n;
    let low = if hits == 0 {
        0.0
    } else {
        (centre - half) / scale
    };
    let high = if hits == runs {
        1.0
    } else {
        (centre + half) / scale
    };
    [low, high]
}

/// The interval in which the median behind these values lies with 95 % confidence: the middle of the
/// medians of 2,000 samples drawn from them, with replacement and always the same seed. None without
/// values.
///
/// Source: Efron, *Bootstrap Methods: Another Look at the Jackknife*, 1979 (the percentile interval).
///
/// ```
/// # use pf_suite::statistics::median_interval;
/// let [low, high] = median_interval(&[3.0, 1.0, 2.0, 5.0, 4.0]).unwrap();
/// assert!((low, high) == (1.0, 5.0));
/// assert_eq!(median_interval(&[7.0]), Some([7.0, 7.0]));
/// ```
#[must_use]
pub fn median_interval(values: &[f64]) -> Option<[f64; 2]> {
    const SAMPLES: usize = 2000;
    const SEED: u64 = 0x70_66;
    let first = *values.first()?;
    if values.iter().all(|value| value.total_cmp(&first).is_eq()) {
        return Some([first; 2]);
    }
    let mut rng = PlanRng::seed_from_u64(SEED);
    let mut sample = vec![0.0; values.len()];
    let medians = (0..SAMPLES).map(|_| {
        for place in &mut sample {
            *place = values[rng.random_range(0..values.len())];
        }
        sample.sort_by(f64::total_cmp);
        quantile(&sample, 0.5)
    });
    let mut medians: Vec<f64> = medians.collect();
    medians.sort_by(f64::total_cmp);
    Some([quantile(&medians, 0.025), quantile(&medians, 0.975)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quartiles_lie_between_values() {
        let spread = Spread::of([4.0, 1.0, 3.0, 2.0]).unwrap();
        let all = [
            spread.least,
            spread.q1,
            spread.median,
            spread.q3,
            spread.most,
        ];
        assert_eq!(
            all.map(|x| (x * 100.0).round().to_string()),
            ["100", "175", "250", "325", "400"]
        );
        assert_eq!(Spread::of([]), None);
    }

    #[test]
    fn a_median_among_those_that_never_arrive_is_one_that_did_or_none() {
        let median = |values: &[f64]| Spread::of(values.iter().copied()).unwrap().median;
        assert_eq!(median(&[1.0, f64::INFINITY, 2.0]).to_string(), "2");
        assert_eq!(median(&[1.0, f64::INFINITY]).to_string(), "inf");
        assert_eq!(
            median(&[1.0, f64::INFINITY, f64::INFINITY]).to_string(),
            "inf"
        );
    }
}
