//! Whether paired runs differ by more than chance.

/// The two-sided p-value of Wilcoxon's signed-rank test on paired differences, by its normal
/// approximation with corrections for ties and continuity; 1 if nothing differs.
///
/// Source: Wilcoxon, *Individual Comparisons by Ranking Methods*, 1945.
#[must_use]
pub fn wilcoxon(differences: &[f64]) -> f64 {
    let mut sizes: Vec<f64> = differences
        .iter()
        .copied()
        .filter(|d| d.abs() > 0.0)
        .collect();
    sizes.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    #[expect(clippy::cast_precision_loss, reason = "a number of runs")]
    let n = sizes.len() as f64;
    if sizes.is_empty() {
        return 1.0;
    }
    let (mut positive, mut ties, mut rank) = (0.0, 0.0, 0.0);
    for equal in sizes.chunk_by(|a, b| a.abs().total_cmp(&b.abs()).is_eq()) {
        #[expect(clippy::cast_precision_loss, reason = "a number of runs")]
        let count = equal.len() as f64;
        let mean = rank + f64::midpoint(count, 1.0);
        positive += mean
            * equal
                .iter()
                .map(|d| f64::from(u8::from(*d > 0.0)))
                .sum::<f64>();
        ties += count * count * count - count;
        rank += count;
    }
    let expected = n * (n + 1.0) / 4.0;
    let variance = n * (n + 1.0) * (2.0 * n + 1.0) / 24.0 - ties / 48.0;
    let off = ((positive - expected).abs() - 0.5).max(0.0);
    if variance <= 0.0 {
        return 1.0;
    }
    libm::erfc(off / variance.sqrt() / std::f64::consts::SQRT_2).min(1.0)
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
        #[expect(clippy::cast_precision_loss, reason = "a number of tests")]
        let left = (values.len() - rank) as f64;
        largest = largest.max((values[i] * left).min(1.0));
        corrected[i] = largest;
    }
    corrected
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn p_values_are_those_of_the_formula() {
        // Ten differences, all positive: W = 55, z = (27.5 - 0.5) / sqrt(96.25).
        let all: Vec<f64> = (1..=10).map(f64::from).collect();
        assert!(
            (wilcoxon(&all) - 0.005_920).abs() < 1e-5,
            "{}",
            wilcoxon(&all)
        );
        assert!(wilcoxon(&[1.0, -1.0, 2.0, -2.0]) > 0.99);
        assert!((wilcoxon(&[0.0; 5]) - 1.0).abs() < 1e-15);
    }

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
}
