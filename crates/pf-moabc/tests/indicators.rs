//! Indicators against values computed by another program (`data/README.md`).

use pf_moabc::indicators::{additive_epsilon, breadth, error_rate, hypervolume, igd_plus, spacing};
use serde_json::Value;

fn points<const N: usize>(value: &Value) -> Vec<[f64; N]> {
    let rows = value.as_array().expect("a list").iter();
    rows.map(|row| std::array::from_fn(|k| row[k].as_f64().expect("a number")))
        .collect()
}

fn check<const N: usize>(case: &Value) {
    let (front, truth) = (points::<N>(&case["front"]), points::<N>(&case["truth"]));
    let reference: [f64; N] =
        std::array::from_fn(|k| case["reference"][k].as_f64().expect("a number"));
    for (name, value) in [
        ("hypervolume", hypervolume(&front, &reference)),
        ("igd_plus", igd_plus(&front, &truth)),
        ("epsilon", additive_epsilon(&front, &truth)),
    ] {
        let expected = case[name].as_f64().expect("a number");
        let (what, off) = (&case["name"], (value - expected).abs());
        assert!(off <= 1e-10, "{what}: {name} is {value}, not {expected}");
    }
}

#[test]
fn indicators_are_as_computed_elsewhere() {
    let cases: Value = serde_json::from_str(include_str!("data/fronts.json")).unwrap();
    let cases = cases.as_array().expect("a list");
    assert!(cases.len() >= 20);
    for case in cases {
        match case["reference"].as_array().expect("a list").len() {
            2 => check::<2>(case),
            3 => check::<3>(case),
            _ => check::<4>(case),
        }
    }
}

#[test]
fn nothing_has_no_volume() {
    assert!(hypervolume::<3>(&[], &[1.0; 3]) <= 0.0);
    assert!(hypervolume(&[[f64::NAN, 0.0, 0.0]], &[1.0; 3]) <= 0.0);
    assert!(igd_plus(&[], &[[0.0, 1.0]]).is_infinite());
    assert!(additive_epsilon(&[], &[[0.0, 1.0]]).is_infinite());
}

#[test]
fn the_paper_s_measures_are_its_formulas() {
    let front = [[0.0, 4.0], [1.0, 2.0], [5.0, 0.0]];
    assert!((breadth(&front) - 3.0).abs() < 1e-15);
    let truth = [[0.0, 4.0], [5.0, 0.0], [9.0, 9.0]];
    assert!((error_rate(&front, &truth) - 1.0 / 3.0).abs() < 1e-15);
    // Gaps of 3, 3 and 6.
    assert!((spacing(&front) - 3f64.sqrt()).abs() < 1e-15);
}
