//! What all charts share.

use crate::SuiteError;
use pf_render::SERIES;
use plotters::{
    coord::{Shift, ranged1d::ValueFormatter, types::RangedCoordf64},
    prelude::*,
    style::text_anchor::{HPos, Pos, VPos},
};

pub(crate) const FONT: &str = "DejaVu Sans";
pub(crate) const WIDTH: u32 = 860;
/// For what is there to compare with.
pub(crate) const GREY: RGBColor = RGBColor(0x8a, 0x91, 0x9c);

pub(crate) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub(crate) type Drawn = Result<(), Box<dyn std::error::Error>>;

/// A white sheet of this height, drawn on.
pub(crate) fn sheet(
    height: u32,
    draw: impl FnOnce(&Area<'_>) -> Drawn,
) -> Result<String, SuiteError> {
    let mut text = String::new();
    let drawn = {
        let area = SVGBackend::with_string(&mut text, (WIDTH, height)).into_drawing_area();
        let fill = area.fill(&WHITE).map_err(Into::into);
        fill.and_then(|()| draw(&area))
            .and_then(|()| Ok(area.present()?))
    };
    drawn.map_err(|error| SuiteError::Internal(format!("a chart cannot be drawn: {error}")))?;
    Ok(text)
}

/// The colour of a contender, the same in all figures.
pub(crate) fn colour(k: usize) -> RGBColor {
    let (r, g, b) = SERIES[k % SERIES.len()];
    RGBColor(r, g, b)
}

/// A line with a name.
pub(crate) struct Curve {
    pub(crate) name: String,
    /// The contender, for its colour; lines of those beyond the colours there are, are dashed.
    pub(crate) contender: usize,
    /// Corners: from each to the next one goes right and then up or down.
    pub(crate) steps: Vec<(f64, f64)>,
    /// Between what lower and what upper bound, at the same places.
    pub(crate) band: Vec<(f64, f64)>,
    /// Whether a dot says where the last corner is: there all is over, and what holds goes on to hold.
    pub(crate) ends: bool,
}

/// Titles of axes, and what they span.
pub(crate) struct Axes {
    pub(crate) x: &'static str,
    pub(crate) y: &'static str,
    pub(crate) up: (f64, f64),
    /// A height to compare with, and what it is.
    pub(crate) mark: Option<(f64, &'static str)>,
}

/// Steps over a logarithmic axis of efforts, the legend on the right.
pub(crate) fn curves(curves: &[Curve], axes: &Axes) -> Result<String, SuiteError> {
    const LEGEND: u32 = 240;
    let rows = u32::try_from(curves.len()).unwrap_or(u32::MAX / 64) + 2;
    let height = 380.max(rows * 22 + 60);
    sheet(height, |area| {
        let (left, right) = area.split_horizontally(WIDTH - LEGEND);
        let (from, to) = span(curves);
        let across = (from..to).log_scale();
        let mut chart = ChartBuilder::on(&left)
            .margin(12)
            .x_label_area_size(44)
            .y_label_area_size(64)
            .build_cartesian_2d(across, axes.up.0..axes.up.1)?;
        mesh(&mut chart, axes)?;
        if let Some((height, _)) = axes.mark {
            let ends = [(from, height), (to, height)];
            chart.draw_series(DashedLineSeries::new(ends, 6, 4, GREY.stroke_width(1)))?;
        }
        for curve in curves {
            let colour = colour(curve.contender);
            if !curve.band.is_empty() {
                let lower = stairs(&curve.steps, to, |k| curve.band[k].0);
                let mut around = stairs(&curve.steps, to, |k| curve.band[k].1);
                around.extend(lower.into_iter().rev());
                chart.draw_series(std::iter::once(Polygon::new(around, colour.mix(0.15))))?;
            }
            let line = stairs(&curve.steps, to, |k| curve.steps[k].1);
            if curve.contender < SERIES.len() {
                chart.draw_series(LineSeries::new(line, colour.stroke_width(2)))?;
            } else {
                chart.draw_series(DashedLineSeries::new(line, 7, 4, colour.stroke_width(2)))?;
            }
            if let (Some(&end), true) = (curve.steps.last(), curve.ends) {
                chart.draw_series(std::iter::once(Circle::new(end, 4, colour.filled())))?;
            }
        }
        legend(&right, curves, axes)
    })
}

fn mesh<X>(
    chart: &mut ChartContext<'_, SVGBackend<'_>, Cartesian2d<X, RangedCoordf64>>,
    axes: &Axes,
) -> Drawn
where
    X: Ranged<ValueType = f64> + ValueFormatter<f64>,
{
    chart
        .configure_mesh()
        .x_desc(axes.x)
        .y_desc(axes.y)
        .axis_desc_style((FONT, 13))
        .x_label_style((FONT, 12))
        .y_label_style((FONT, 12))
        .x_label_formatter(&|value| sparse(*value, count))
        .light_line_style(WHITE)
        .bold_line_style(RGBColor(0xe6, 0xe9, 0xed))
        .draw()?;
    Ok(())
}

/// Text at a place, its middle at the place's height.
pub(crate) fn label(text: String, at: (i32, i32), side: HPos) -> Text<'static, (i32, i32), String> {
    let style = TextStyle::from((FONT, 13).into_font());
    Text::new(text, at, style.pos(Pos::new(side, VPos::Center)))
}

/// Names beside strokes, one under the other.
fn legend(area: &Area<'_>, curves: &[Curve], axes: &Axes) -> Drawn {
    let mut y = 24;
    let mut row = |name: &str, colour: RGBColor, dashed: bool| -> Drawn {
        let pieces: &[(i32, i32)] = if dashed {
            &[(8, 15), (19, 26), (30, 37)]
        } else {
            &[(8, 37)]
        };
        for &(from, to) in pieces {
            let ends = vec![(from, y), (to, y)];
            area.draw(&PathElement::new(ends, colour.stroke_width(2)))?;
        }
        area.draw(&label(fitted(name), (44, y), HPos::Left))?;
        y += 22;
        Ok(())
    };
    for curve in curves {
        let dashed = curve.contender >= SERIES.len();
        row(&curve.name, colour(curve.contender), dashed)?;
    }
    if let Some((_, what)) = axes.mark {
        row(what, GREY, true)?;
    }
    Ok(())
}

/// A name that the legend has room for.
pub(crate) fn fitted(name: &str) -> String {
    const MOST: usize = 26;
    if name.chars().count() <= MOST {
        return name.to_owned();
    }
    let shown: String = name.chars().take(MOST - 1).collect();
    shown + "…"
}

/// What the curves span: whole powers of ten at the beginning, some room at the end.
fn span(curves: &[Curve]) -> (f64, f64) {
    let places = || {
        curves
            .iter()
            .flat_map(|curve| &curve.steps)
            .map(|step| step.0)
    };
    let (first, last) = (
        places().fold(f64::INFINITY, f64::min),
        places().fold(1.0, f64::max),
    );
    let from = 10f64.powf(first.clamp(1.0, last).log10().floor());
    (from, (last * 1.15).max(from * 10.0))
}

/// The corners of steps: each height holds until the next place, the last to the end.
fn stairs(steps: &[(f64, f64)], end: f64, height: impl Fn(usize) -> f64) -> Vec<(f64, f64)> {
    let mut corners = Vec::with_capacity(2 * steps.len() + 1);
    for (k, &(place, _)) in steps.iter().enumerate() {
        if k > 0 {
            corners.push((place, height(k - 1)));
        }
        corners.push((place, height(k)));
    }
    corners.extend(steps.len().checked_sub(1).map(|last| (end, height(last))));
    corners
}

/// 1, 10, 1k, 10k, 1M.
fn count(value: f64) -> String {
    match value {
        v if v >= 1e6 => format!("{}M", v / 1e6),
        v if v >= 1e3 => format!("{}k", v / 1e3),
        v => format!("{v}"),
    }
}

/// A label of a logarithmic axis: at one, two and five times a power of ten, as there is no room for
/// all.
pub(crate) fn sparse(value: f64, show: impl Fn(f64) -> String) -> String {
    let digits = format!("{value:e}");
    if digits.starts_with(['1', '2', '5']) {
        show(value)
    } else {
        String::new()
    }
}
