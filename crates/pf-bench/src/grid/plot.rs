//! Times by map and contender as a picture.

use crate::protocol::Row;
use anyhow::{Context as _, Result, anyhow, bail};
use pf_io::write_whole;
use pf_render::SERIES;
use plotters::prelude::*;
use std::path::Path;

const FONT: &str = "DejaVu Sans";

/// Refuses a file that cannot be drawn before anything is measured.
pub(super) fn check(file: &Path) -> Result<()> {
    match file.extension().and_then(|ending| ending.to_str()) {
        Some("svg" | "png") => Ok(()),
        _ => bail!("--plot {}: expected an .svg or .png file", file.display()),
    }
}

/// Draws mean times on a logarithmic scale: a row per map, a colour per contender.
pub(super) fn draw(file: &Path, rows: &[Row]) -> Result<()> {
    let svg = svg(rows).map_err(|error| anyhow!("--plot: {error}"))?;
    let bytes = if file.extension().is_some_and(|ending| ending == "png") {
        pf_render::png_of(&svg)?
    } else {
        svg.into_bytes()
    };
    write_whole(file, |out| out.write_all(&bytes)).context("--plot")
}

fn svg(rows: &[Row]) -> Result<String, Box<dyn std::error::Error>> {
    let (mut maps, mut planners): (Vec<&str>, Vec<String>) = (Vec::new(), Vec::new());
    for row in rows {
        if !maps.contains(&row.case.as_str()) {
            maps.push(&row.case);
        }
        if !planners.contains(&row.planner) {
            planners.push(row.planner.clone());
        }
    }
    let times = || {
        rows.iter()
            .map(|row| row.mean_us)
            .filter(|us| us.is_finite() && *us > 0.0)
    };
    let least = times().fold(f64::INFINITY, f64::min).min(1e9);
    let most = times().fold(least, f64::max);
    let height = u32::try_from(maps.len())?
        .saturating_mul(24)
        .saturating_add(300);
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, (900, height)).into_drawing_area();
        area.fill(&WHITE)?;
        // The first map on top, and below the last one room for the legend.
        let (rows_of_legend, maps_drawn) = (8, i32::try_from(maps.len())?);
        let mut chart = ChartBuilder::on(&area)
            .caption("mean time per query, us", (FONT, 18))
            .margin(12)
            .x_label_area_size(30)
            .y_label_area_size(200)
            .build_cartesian_2d(
                (least / 2.0..most * 2.0).log_scale(),
                (-rows_of_legend..maps_drawn).into_segmented(),
            )?;
        let name = |at: &SegmentValue<i32>| match at {
            SegmentValue::CenterOf(k) => usize::try_from(maps_drawn - 1 - k)
                .ok()
                .and_then(|k| maps.get(k))
                .copied(),
            _ => None,
        };
        chart
            .configure_mesh()
            .y_labels(maps.len() + 9)
            .y_label_formatter(&|at| name(at).unwrap_or_default().to_owned())
            .x_label_style((FONT, 12))
            .y_label_style((FONT, 12))
            .light_line_style(WHITE)
            .draw()?;
        for (k, planner) in planners.iter().enumerate() {
            let (r, g, b) = SERIES[k % SERIES.len()];
            let colour = RGBColor(r, g, b);
            let points = rows
                .iter()
                .filter(|row| row.planner == *planner)
                .filter_map(|row| {
                    let at = maps.iter().position(|map| *map == row.case)?;
                    let at = maps_drawn - 1 - i32::try_from(at).ok()?;
                    Some((row.mean_us, SegmentValue::CenterOf(at)))
                });
            let dots = points.map(|point| Circle::new(point, 5, colour.filled()));
            chart
                .draw_series(dots)?
                .label(planner)
                .legend(move |at| Circle::new(at, 5, colour.filled()));
        }
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::LowerRight)
            .background_style(WHITE.mix(0.85))
            .border_style(BLACK.mix(0.3))
            .label_font((FONT, 12))
            .draw()?;
        area.present()?;
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::protocol::Tally;

    #[test]
    fn maps_and_contenders_are_named() {
        let row = |map: &str, planner: &str, us: f64| {
            let mut tally = Tally::default();
            tally.add_us(us);
            tally.row(map, planner)
        };
        let rows = [
            row("Aftershock", "astar", 700.0),
            row("Aftershock", "pathfinding::astar", 4000.0),
            row("arena2", "astar", 90.0),
        ];
        let svg = svg(&rows).unwrap();
        for words in ["Aftershock", "arena2", "pathfinding::astar"] {
            assert!(svg.contains(words), "no {words}");
        }
        assert!(pf_render::png_of(&svg).unwrap().starts_with(b"\x89PNG"));
        assert!(super::svg(&[]).is_ok());
        assert!(check(Path::new("a.jpg")).is_err() && check(Path::new("a.png")).is_ok());
    }
}
