//! Medians and rates with their intervals, a row per contender.

use super::{
    Figure,
    chart::{Area, Drawn, FONT, colour, fitted, label, sheet, sparse},
    data::Data,
    table::short,
    tables::success,
};
use crate::{
    SuiteError,
    statistics::{Spread, median_interval},
};
use plotters::{
    coord::{ranged1d::ValueFormatter, types::RangedCoordf64},
    prelude::*,
    style::text_anchor::HPos,
};

/// Room for names on the left.
const NAMES: u32 = 230;
const NAMES_END: i32 = 230;

struct Row {
    name: String,
    contender: usize,
    value: f64,
    interval: [f64; 2],
}

pub(crate) fn figures(data: &Data<'_>) -> Result<Vec<Figure>, SuiteError> {
    let all = || 0..data.contenders.len();
    let row = |c: usize, value, interval| Row {
        name: data.contenders[c].clone(),
        contender: c,
        value,
        interval,
    };
    let rates = all().filter_map(|c| {
        let (solved, runs, interval) = success(data.all_of(c).map(|(_, line)| line));
        let rate = (runs > 0).then(|| f64::from(solved) / f64::from(runs))?;
        Some(row(c, 100.0 * rate, interval.map(|share| 100.0 * share)))
    });
    let medians = |of: &dyn Fn(usize) -> Vec<f64>| -> Vec<Row> {
        let rows = all().filter_map(|c| {
            let values = of(c);
            let median = Spread::of(values.iter().copied())?.median;
            Some(row(c, median, median_interval(&values)?))
        });
        rows.collect()
    };
    let over = medians(&|c| {
        let found = data.all_of(c).filter(|(_, line)| line.record.solved());
        found
            .map(|(p, line)| 100.0 * (data.relative(p, line) - 1.0))
            .collect()
    });
    let times = medians(&|c| {
        let times = data.all_of(c).map(|(_, line)| line.times.elapsed_us);
        times.map(|us| (us / 1e3).max(1e-4)).collect()
    });
    let mut figures = Vec::new();
    for (name, title, unit, words, rows, log) in [
        (
            "success",
            "Success",
            "runs solved, %",
            "With Wilson's 95 % intervals.",
            rates.collect::<Vec<_>>(),
            false,
        ),
        (
            "cost",
            "Cost over the best known",
            "more than the best known, %",
            "Medians over the runs that were solved, with 95 % bootstrap intervals.",
            over,
            false,
        ),
        (
            "time",
            "Time",
            "time of a run, ms",
            "Medians over all runs, with 95 % bootstrap intervals.",
            times,
            true,
        ),
    ] {
        if rows.is_empty() {
            continue;
        }
        figures.push(Figure {
            name: name.to_owned(),
            title: title.to_owned(),
            words: words.to_owned(),
            svg: draw(&rows, unit, log)?,
        });
    }
    Ok(figures)
}

fn draw(rows: &[Row], unit: &str, log: bool) -> Result<String, SuiteError> {
    let count = u32::try_from(rows.len()).unwrap_or(u32::MAX / 64);
    let values = || rows.iter().flat_map(|row| row.interval);
    let most = values().fold(f64::NEG_INFINITY, f64::max);
    let least = values().fold(f64::INFINITY, f64::min);
    sheet(70 + 26 * count, |area| {
        // The first row on top.
        let up = 0.5 - f64::from(count)..0.5;
        let mut builder = ChartBuilder::on(area);
        builder
            .margin(12)
            .margin_right(24)
            .x_label_area_size(44)
            .y_label_area_size(NAMES);
        if log {
            let across = (least / 1.5..(most * 1.5).max(least * 12.0)).log_scale();
            let show = |value: &f64| sparse(*value, short);
            let mut chart = builder.build_cartesian_2d(across, up)?;
            fill(area, &mut chart, rows, unit, &show)
        } else {
            let room = ((most - least.min(0.0)) * 0.03).max(0.5);
            let across = least.min(0.0) - room..most + room;
            let mut chart = builder.build_cartesian_2d(across, up)?;
            fill(area, &mut chart, rows, unit, &|value| short(*value))
        }
    })
}

fn fill<'b, X>(
    area: &Area<'b>,
    chart: &mut ChartContext<'_, SVGBackend<'b>, Cartesian2d<X, RangedCoordf64>>,
    rows: &[Row],
    unit: &str,
    show: &dyn Fn(&f64) -> String,
) -> Drawn
where
    X: Ranged<ValueType = f64> + ValueFormatter<f64>,
{
    chart
        .configure_mesh()
        .x_desc(unit)
        .y_labels(0)
        .disable_y_mesh()
        .x_label_formatter(show)
        .axis_desc_style((FONT, 13))
        .x_label_style((FONT, 12))
        .light_line_style(WHITE)
        .bold_line_style(RGBColor(0xe6, 0xe9, 0xed))
        .draw()?;
    for (k, row) in (0u32..).zip(rows) {
        let y = -f64::from(k);
        let colour = colour(row.contender);
        let ends = row.interval.map(|x| (x, y));
        chart.draw_series(LineSeries::new(ends, colour.stroke_width(3)))?;
        let dot = Circle::new((row.value, y), 5, colour.filled());
        chart.draw_series(std::iter::once(dot))?;
        let (_, at) = chart.backend_coord(&(row.value, y));
        area.draw(&label(fitted(&row.name), (NAMES_END, at), HPos::Right))?;
    }
    Ok(())
}
