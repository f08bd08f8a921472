//! Plain plots as SVG: lines over an axis, and heights over a plane.

use std::fmt::Write;

/// Colours of Okabe and Ito, and a grey.
const COLOURS: [&str; 8] = [
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#999999",
];
const WIDTH: f64 = 560.0;
const HEIGHT: f64 = 360.0;
const LEFT: f64 = 70.0;
const TOP: f64 = 40.0;
const RIGHT: f64 = 150.0;
const BOTTOM: f64 = 50.0;

/// A line with a name.
#[derive(Clone, Debug)]
pub(crate) struct Series {
    pub(crate) name: String,
    pub(crate) points: Vec<[f64; 2]>,
}

/// Lines; with `log` both axes are logarithmic.
pub(crate) fn lines(title: &str, axes: [&str; 2], log: bool, series: &[Series]) -> String {
    let scale = |v: f64| if log { v.max(1e-12).log10() } else { v };
    let all = || series.iter().flat_map(|s| &s.points).map(|p| p.map(scale));
    let range = |k: usize| {
        let values = all().map(|p| p[k]);
        let low = values.clone().fold(f64::INFINITY, f64::min);
        let high = values.fold(f64::NEG_INFINITY, f64::max);
        if high > low {
            [low, high]
        } else {
            [low - 0.5, low + 0.5]
        }
    };
    let [x, y] = [range(0), range(1)];
    let across = |v: f64| LEFT + (v - x[0]) / (x[1] - x[0]) * (WIDTH - LEFT - RIGHT);
    let up = |v: f64| HEIGHT - BOTTOM - (v - y[0]) / (y[1] - y[0]) * (HEIGHT - TOP - BOTTOM);
    let mut svg = head(WIDTH, HEIGHT, title);
    for step in 0..=4 {
        let share = f64::from(step) / 4.0;
        let (at_x, at_y) = (x[0] + share * (x[1] - x[0]), y[0] + share * (y[1] - y[0]));
        let said = |v: f64| short(if log { 10f64.powf(v) } else { v });
        let _ = write!(
            svg,
            r##"<path d="M{0:.1} {TOP}V{1:.1}M{LEFT} {2:.1}H{3:.1}" stroke="#ddd"/><text x="{0:.1}" y="{4:.1}" text-anchor="middle">{5}</text><text x="{6:.1}" y="{2:.1}" text-anchor="end" dy="4">{7}</text>"##,
            across(at_x),
            HEIGHT - BOTTOM,
            up(at_y),
            WIDTH - RIGHT,
            HEIGHT - BOTTOM + 18.0,
            said(at_x),
            LEFT - 6.0,
            said(at_y)
        );
    }
    for (k, line) in series.iter().enumerate() {
        let colour = COLOURS[k % COLOURS.len()];
        let mut path = String::new();
        for (i, p) in line.points.iter().enumerate() {
            let p = p.map(scale);
            let letter = if i == 0 { 'M' } else { 'L' };
            let _ = write!(path, "{letter}{:.1} {:.1}", across(p[0]), up(p[1]));
        }
        let at = TOP + 16.0 * f64::from(u32::try_from(k).unwrap_or(0));
        let _ = write!(
            svg,
            r#"<path d="{path}" fill="none" stroke="{colour}" stroke-width="2"/><text x="{}" y="{}" fill="{colour}">{}</text>"#,
            WIDTH - RIGHT + 8.0,
            at + 8.0,
            line.name
        );
    }
    let _ = write!(
        svg,
        r#"<text x="{}" y="{}" text-anchor="middle">{}</text><text transform="translate(16 {}) rotate(-90)" text-anchor="middle">{}</text></svg>"#,
        (LEFT + WIDTH - RIGHT) / 2.0,
        HEIGHT - 12.0,
        axes[0],
        HEIGHT / 2.0,
        axes[1]
    );
    svg
}

/// A dot for each series in each of the cases, from 0 up; points are a case's place and a value.
#[expect(clippy::cast_precision_loss, reason = "small numbers")]
pub(crate) fn dots(title: &str, axis: &str, cases: &[String], series: &[Series]) -> String {
    let names = 16.0 + 6.0 * cases.iter().map(String::len).max().unwrap_or(0) as f64;
    let (width, row) = (WIDTH + names + 30.0, 15.0 + 4.0 * series.len() as f64);
    let right = width - RIGHT - 30.0;
    let bottom = TOP + row * cases.len() as f64;
    let values = series.iter().flat_map(|s| &s.points).map(|p| p[1]);
    let most = values.fold(f64::MIN_POSITIVE, f64::max);
    let across = |v: f64| names + v / most * (right - names);
    let mut svg = head(width, bottom + BOTTOM, title);
    for step in 0..=4 {
        let value = most * f64::from(step) / 4.0;
        let _ = write!(
            svg,
            r##"<path d="M{0:.1} {TOP}V{bottom:.1}" stroke="#ddd"/><text x="{0:.1}" y="{1:.1}" text-anchor="middle">{2}</text>"##,
            across(value),
            bottom + 18.0,
            short(value)
        );
    }
    for (n, case) in cases.iter().enumerate() {
        let at = TOP + row * n as f64;
        let _ = write!(
            svg,
            r##"<path d="M8 {at:.1}H{:.1}" stroke="#ddd"/><text x="8" y="{:.1}">{case}</text>"##,
            right,
            at + row / 2.0 + 4.0
        );
    }
    for (k, line) in series.iter().enumerate() {
        let (colour, k) = (COLOURS[k % COLOURS.len()], k as f64);
        for [case, value] in &line.points {
            let at = TOP + row * case + 9.5 + 4.0 * k;
            let _ = write!(
                svg,
                r#"<circle cx="{:.1}" cy="{at:.1}" r="4" fill="{colour}"/>"#,
                across(*value)
            );
        }
        let _ = write!(
            svg,
            r#"<circle cx="{0:.1}" cy="{1:.1}" r="4" fill="{colour}"/><text x="{2:.1}" y="{3:.1}">{4}</text>"#,
            right + 14.0,
            TOP + 16.0 * k + 4.0,
            right + 24.0,
            TOP + 16.0 * k + 8.0,
            line.name
        );
    }
    let _ = write!(
        svg,
        r#"<text x="{:.1}" y="{:.1}" text-anchor="middle">{axis}</text></svg>"#,
        f64::midpoint(names, right),
        bottom + 38.0
    );
    svg
}

/// Heights from 0 to `most` over a box of the plane, y upwards, with lines at every eighth.
pub(crate) fn contours(
    title: &str,
    [min, max]: [[f64; 2]; 2],
    most: f64,
    height: impl Fn([f64; 2]) -> f64,
) -> String {
    const SIDE: u32 = 160;
    let size = 420.0;
    let cell = size / f64::from(SIDE);
    let mut svg = head(size + 40.0, size + 60.0, title);
    let at = |i: u32, j: u32| {
        let share = [
            f64::from(i) / f64::from(SIDE),
            f64::from(j) / f64::from(SIDE),
        ];
        [0, 1].map(|k| min[k] + (max[k] - min[k]) * share[k])
    };
    // Nothing at all is below the first band.
    let band = |i: u32, j: u32| match height(at(i, j)) / most * 8.0 {
        h if h > 0.0 => h.min(7.99),
        _ => -1.0,
    };
    for j in 0..SIDE {
        let mut from = 0;
        // Equal neighbours are one rectangle.
        for i in 1..=SIDE {
            let here = band(from, j).floor();
            if i < SIDE && band(i, j).floor() - here == 0.0 {
                continue;
            }
            let light = 97.0 - 8.0 * here;
            let y = 40.0 + size - f64::from(j + 1) * cell;
            if here >= 0.0 {
                let _ = write!(
                    svg,
                    r#"<rect x="{:.2}" y="{y:.2}" width="{:.2}" height="{:.2}" fill="hsl(215 80% {light:.0}%)"/>"#,
                    20.0 + f64::from(from) * cell,
                    f64::from(i - from) * cell + 0.1,
                    cell + 0.1,
                );
            }
            from = i;
        }
    }
    let _ = write!(
        svg,
        r##"<rect x="20" y="40" width="{size}" height="{size}" fill="none" stroke="#888"/></svg>"##
    );
    svg
}

fn head(width: f64, height: f64, title: &str) -> String {
    format!(
        r##"<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" font-family="'DejaVu Sans',sans-serif" font-size="12" fill="#222"><rect width="100%" height="100%" fill="#fff"/><text x="20" y="24" font-size="14">{title}</text>"##
    )
}

fn short(value: f64) -> String {
    if value.abs() >= 100.0 {
        format!("{value:.0}")
    } else if value.abs() >= 1.0 {
        format!("{value:.1}")
    } else {
        format!("{value:.3}")
    }
}
