//! A number per cell, as colours.

use pf_grid::{Cell, GridProblem};
use std::fmt::Write;

/// From low to high; told apart in grey, too.
const RAMP: [[f64; 3]; 5] = [
    [8.0, 48.0, 107.0],
    [33.0, 113.0, 181.0],
    [107.0, 174.0, 214.0],
    [199.0, 221.0, 240.0],
    [255.0, 247.0, 220.0],
];

/// A panel of 460 x 520: the free cells by colour, grey without a value, the blocked ones dark, a path, a scale.
pub(super) fn heat(
    problem: &GridProblem,
    path: &[Cell],
    value: &dyn Fn(Cell) -> f64,
    title: &str,
) -> String {
    const SIDE: f64 = 440.0;
    let grid = problem.grid();
    let free = || grid.layout().cells().filter(|&cell| grid.is_free(cell));
    let most = free().map(value).fold(0.0, f64::max);
    let scale = SIDE / f64::from(grid.width().max(grid.height()));
    let mut svg = format!(
        r##"<text x="10" y="18">{title}</text><g shape-rendering="crispEdges" transform="translate(10 28) scale({scale})"><rect width="{}" height="{}" fill="#3a3a3a"/>"##,
        grid.width(),
        grid.height()
    );
    for cell in free() {
        let value = value(cell);
        let colour = if value.is_nan() {
            "#9a9a9a".to_owned()
        } else {
            colour(value / most.max(f64::MIN_POSITIVE))
        };
        let (x, y) = (cell.x, cell.y);
        let _ = write!(
            svg,
            r#"<rect x="{x}" y="{y}" width="1" height="1" fill="{colour}"/>"#
        );
    }
    let points: Vec<String> = path
        .iter()
        .map(|cell| format!("{}.5,{}.5", cell.x, cell.y))
        .collect();
    let _ = write!(
        svg,
        r##"<polyline points="{}" fill="none" shape-rendering="geometricPrecision" stroke="#d55e00" stroke-width="{}" stroke-linejoin="round"/></g>"##,
        points.join(" "),
        3.0 / scale
    );
    let y = SIDE + 44.0;
    for i in 0..40 {
        let share = f64::from(i) / 39.0;
        let _ = write!(
            svg,
            r#"<rect x="{}" y="{y}" width="5.2" height="12" fill="{}"/>"#,
            60.0 + 5.0 * f64::from(i),
            colour(share)
        );
    }
    let _ = write!(
        svg,
        r#"<text x="10" y="{0}">0 cells</text><text x="266" y="{0}">{most:.0} cells to the goal, at least</text>"#,
        y + 11.0
    );
    svg
}

fn colour(share: f64) -> String {
    let place = share.clamp(0.0, 1.0) * 4.0;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "0 to 3"
    )]
    let below = (place as usize).min(3);
    #[expect(clippy::cast_precision_loss, reason = "0 to 3")]
    let part = place - below as f64;
    let mix = |i: usize| RAMP[below][i] + (RAMP[below + 1][i] - RAMP[below][i]) * part;
    format!("rgb({:.0},{:.0},{:.0})", mix(0), mix(1), mix(2))
}
