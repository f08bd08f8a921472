//! The statistics against numbers of `SciPy` 1.17.1: the calls stand beside them.

use pf_suite::{
    comparisons::{critical_difference, friedman, studentised_range, wilcoxon},
    statistics::{median_interval, wilson},
};

#[track_caller]
fn close(found: f64, expected: f64) {
    let off = (found - expected).abs();
    assert!(
        off <= 1e-9 * expected.abs().max(1e-3),
        "{found}, not {expected}"
    );
}

/// Fourteen problems, four contenders, with ties; the smaller the better.
const TABLE: [[f64; 4]; 14] = [
    [-0.763, -0.768, -0.771, -0.798],
    [-0.599, -0.591, -0.590, -0.569],
    [-0.954, -0.971, -0.968, -0.967],
    [-0.628, -0.661, -0.654, -0.657],
    [-0.882, -0.888, -0.886, -0.898],
    [-0.936, -0.931, -0.916, -0.931],
    [-0.661, -0.668, -0.609, -0.685],
    [-0.583, -0.583, -0.563, -0.625],
    [-0.775, -0.838, -0.866, -0.875],
    [-1.0, -1.0, -1.0, -1.0],
    [-0.940, -0.962, -0.965, -0.962],
    [-0.619, -0.666, -0.614, -0.669],
    [-0.972, -0.981, -0.975, -0.975],
    [-0.957, -0.978, -0.946, -0.970],
];

#[test]
#[expect(clippy::approx_constant, reason = "measurements that look like them")]
fn signed_ranks_are_exact_for_few() {
    // scipy.stats.wilcoxon(d, method="exact"): Darwin's maize.
    let maize = [49, -67, 8, 16, 6, 23, 28, 41, 14, 29, 56, 24, 75, 60, -48];
    close(wilcoxon(&maize.map(f64::from)), 0.041_259_765_625);
    // scipy.stats.wilcoxon(x, y): Hollander and Wolfe's depressions.
    let x = [1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30];
    let y = [0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29];
    let differences: Vec<f64> = x.iter().zip(y).map(|(x, y)| x - y).collect();
    close(wilcoxon(&differences), 0.039_062_5);
    let d = [
        2.618, -0.612, 0.122, 2.543, 1.147, 1.163, -0.014, -1.148, 0.667, 0.609, -0.727, -0.183,
        0.428, -0.445, 0.402, 0.595, 0.536, -0.006, 1.094, 1.391, 0.821, -0.318, 1.232, -0.001,
        1.379,
    ];
    close(wilcoxon(&d), 0.014_722_049_236_297_607);
    // scipy.stats.wilcoxon(d, method=PermutationMethod(n_resamples=10**6)), which counts all signs.
    let tied = [2, 2, -1, 3, 3, 3, -2, 5, 1, 1, 4, -1];
    close(wilcoxon(&tied.map(f64::from)), 0.025_878_906_25);
}

#[test]
fn signed_ranks_of_many_are_approximated() {
    // scipy.stats.wilcoxon(d, zero_method="wilcox", correction=True, method="approx")
    let d = [
        0.7, 1.2, 0.7, -0.9, 1.3, 0.8, -0.1, 1.0, 0.8, 0.7, 0.4, 0.9, -0.3, 0.2, -0.1, 1.0, 0.4,
        0.1, -0.4, 0.1, 0.4, 0.1, 1.7, 1.4, -2.3, -1.5, 0.2, -0.0, 0.6, 0.6,
    ];
    close(wilcoxon(&d), 0.012_033_688_338_712_933);
}

#[test]
fn mean_ranks_and_their_tests() {
    // scipy.stats.friedmanchisquare(*table.T); the F statistic of it by scipy.stats.f.sf.
    let rows: Vec<Vec<f64>> = TABLE.iter().map(|row| row.to_vec()).collect();
    let found = friedman(&rows).unwrap();
    close(found.chi_squared, 10.952_380_952_380_956);
    close(found.p, 0.011_986_176_325_417_788);
    close(found.p_iman_davenport, 0.007_628_838_730_725_745);
    close(found.ranks[0], 44.0 / 14.0);
    close(found.ranks[3], 27.0 / 14.0);
    let rows = [
        [0.78, 0.59, -0.83, 0.0, 2.48],
        [0.68, -0.24, 0.8, 1.65, 2.07],
        [0.88, 0.66, 0.71, 0.94, 2.66],
        [-2.25, 0.26, 0.83, -0.23, 1.93],
        [-0.65, 1.26, 0.67, 1.87, 2.82],
        [0.38, -0.48, -0.71, 2.95, 1.49],
        [-0.69, 0.54, 0.61, 2.05, 1.63],
        [0.01, -0.31, 1.27, 0.17, 2.27],
    ];
    let found = friedman(&rows.map(Vec::from)).unwrap();
    close(found.chi_squared, 17.5);
    close(found.p, 0.001_544_997_919_878_575);
    close(found.p_iman_davenport, 0.000_133_162_556_885_673_95);
}

#[test]
fn ranges_and_critical_differences() {
    // scipy.stats.studentized_range.ppf(1 - level, k, inf)
    for (k, at_5, at_10) in [
        (2, 2.771_807_648_699_355, 2.326_174_307_353_347_6),
        (3, 3.314_493_155_398_122, 2.902_380_213_428_251_5),
        (4, 3.633_159_574_902_627_8, 3.240_446_220_927_359),
        (5, 3.857_655_510_378_623, 3.478_280_550_703_068),
        (10, 4.474_124_221_725_907, 4.129_346_398_236_873),
        (20, 5.011_688_794_118_442_5, 4.694_104_409_490_512),
        (30, 5.301_289_574_031_17, 4.997_112_865_401_611),
    ] {
        assert!((studentised_range(k, 0.05) - at_5).abs() < 1e-7);
        assert!((studentised_range(k, 0.10) - at_10).abs() < 1e-7);
    }
    // The critical values that Demsar (2006) prints in Table 5: the range over the root of 2.
    let printed = [
        1.960, 2.343, 2.569, 2.728, 2.850, 2.949, 3.031, 3.102, 3.164,
    ];
    for (k, q) in (2..).zip(printed) {
        let found = studentised_range(k, 0.05) / 2f64.sqrt();
        assert!((found - q).abs() < 0.001, "{k}: {found}");
    }
    assert!((critical_difference(4, 14, 0.05) - 1.25).abs() < 0.005);
}

#[test]
fn rates() {
    // scipy.stats.binomtest(hits, runs).proportion_ci(0.95, method="wilson")
    for (hits, runs, low, high) in [
        (0, 20, 0.0, 0.161_125_158_052_819_35),
        (7, 20, 0.181_191_824_101_082_1, 0.567_145_723_314_763_7),
        (20, 20, 0.838_874_841_947_180_8, 1.0),
        (81, 263, 0.255_288_519_878_274_2, 0.366_209_576_982_800_04),
        (1, 1, 0.206_549_314_377_237_45, 1.0),
        (500, 1000, 0.469_069_600_368_104_2, 0.530_930_399_631_895_8),
    ] {
        let found = wilson(hits, runs);
        close(found[0], low);
        close(found[1], high);
    }
}

#[test]
fn medians() {
    // scipy.stats.bootstrap((x,), numpy.median, n_resamples=200000, method="percentile"): 0.627, 1.288
    let x = [
        0.342, 2.495, 0.98, 0.287, 0.731, 1.056, 1.314, 0.374, 0.33, 1.221, 0.627, 1.266, 2.137,
        0.192, 1.29, 3.403, 0.743, 0.444, 2.122, 1.288, 2.449, 0.708, 0.227, 0.896, 0.64,
    ];
    let found = median_interval(&x).unwrap();
    assert!(
        (found[0] - 0.627).abs() < 1e-9 && (found[1] - 1.288).abs() < 1e-9,
        "{found:?}"
    );
    assert_eq!(median_interval(&x), Some(found));
}
