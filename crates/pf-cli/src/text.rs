//! Numbers as people read them.

use std::time::Duration;

/// Three significant digits and a unit.
pub(crate) fn time(time: Duration) -> String {
    let micros = time.as_secs_f64() * 1e6;
    if micros < 1000.0 {
        significant(micros) + " us"
    } else if micros < 1e6 {
        significant(micros / 1e3) + " ms"
    } else {
        significant(micros / 1e6) + " s"
    }
}

fn significant(x: f64) -> String {
    if x < 10.0 {
        format!("{x:.2}")
    } else if x < 100.0 {
        format!("{x:.1}")
    } else {
        format!("{x:.0}")
    }
}

/// At most four decimals.
pub(crate) fn number(x: f64) -> String {
    let text = format!("{x:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The number that is written with at most twelve digits.
pub(crate) fn short(x: f64) -> f64 {
    format!("{x:.11e}").parse().unwrap_or(x)
}

/// So many of something.
pub(crate) fn count(n: u64) -> String {
    indicatif::HumanCount(n).to_string()
}

/// Microseconds with one decimal: what a clock can tell.
pub(crate) fn micros(time: Duration) -> f64 {
    (time.as_secs_f64() * 1e7).round() / 10.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        assert_eq!(number(12.0), "12");
        assert_eq!(number(12.340_001), "12.34");
        assert_eq!(time(Duration::from_nanos(1500)), "1.50 us");
        assert_eq!(time(Duration::from_millis(12)), "12.0 ms");
        assert_eq!(time(Duration::from_secs(200)), "200 s");
    }
}
