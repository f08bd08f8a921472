//! The paper's figures, drawn again.

use super::{cases::Story, heat::heat};
use crate::PaperError;
use pf_core::{Context, Planner, Problem, Replanner};
use pf_grid::{Cell, GridProblem};
use pf_render::{Line, Picture};
use pf_rfd::{RfdExact, RfdField};
use std::fmt::Write;

/// A picture with a file's name, as SVG.
#[derive(Clone, Debug)]
pub struct Figure {
    /// The name, without an ending.
    pub name: String,
    /// What it shows.
    pub title: String,
    /// The picture.
    pub svg: String,
}

/// All of them: Fig. 1, and for each map Fig. 3 to 6 and the altitudes of an exact river and of an
/// altitude field before and after a change.
///
/// # Errors
/// [`PaperError::Data`] if a change makes no sense.
pub fn figures(stories: &[Story]) -> Result<Vec<Figure>, PaperError> {
    let mut figures = vec![Figure {
        name: "fig1-probability".into(),
        title: "Fig. 1: probability against gradient".into(),
        svg: probabilities(),
    }];
    for story in stories {
        let map = story.map;
        let first = &story.first.0;
        let before = shortest(first);
        figures.push(Figure {
            name: format!("fig3-{map}"),
            title: format!("Fig. 3: {map}"),
            svg: Picture::of(first.grid())
                .path("shortest path", Line::Solid, &before)
                .ends(first.start(), first.goal())
                .caption(format!("{map}: {:.2} cells", story.first.1.value()))
                .svg(),
        });
        for (figure, table, what) in [
            (4, 3, "obstacles added"),
            (5, 4, "obstacles removed"),
            (6, 5, "a major change"),
        ] {
            let (changes, then, cost) = &story.then[table - 2];
            let title = format!("Fig. {figure}: {map}, {what}");
            let length = cost.value();
            figures.push(Figure {
                name: format!("fig{figure}-{map}"),
                svg: Picture::of(then.grid())
                    .changed(changes)
                    .path("before", Line::Dashed, &before)
                    .path("shortest path", Line::Solid, &shortest(then))
                    .ends(then.start(), then.goal())
                    .caption(format!("{map}, {what}: {length:.2} cells"))
                    .svg(),
                title,
            });
        }
        let river = RfdExact::default();
        let of_river = |river: &RfdExact, cell| river.altitude(cell);
        figures.push(altitudes(story, "altitudes", river, of_river)?);
        let field = RfdField::default();
        let of_field = |field: &RfdField, cell| field.altitude(cell).unwrap_or(f64::NAN);
        figures.push(altitudes(story, "altitude-field", field, of_field)?);
    }
    Ok(figures)
}

fn shortest(problem: &GridProblem) -> Vec<Cell> {
    let report = RfdExact::default().plan(problem, &mut Context::seeded(0));
    let solved = report
        .ok()
        .and_then(|report| report.outcome.solved().cloned());
    solved.map_or_else(Vec::new, |solved| solved.solution)
}

/// What a planner knows before and after obstacles were added, its upkeep done.
fn altitudes<T: Replanner<GridProblem>>(
    story: &Story,
    name: &str,
    mut planner: T,
    altitude: impl Fn(&T, Cell) -> f64,
) -> Result<Figure, PaperError> {
    let broken = |what: String| PaperError::Data(format!("{}: {what}", story.map));
    let mut problem = story.first.0.clone();
    let mut panels = Vec::new();
    let mut panel = |planner: &T, problem: &GridProblem, title: &str| {
        let altitude = |cell: Cell| altitude(planner, cell);
        panels.push(heat(problem, &shortest(problem), &altitude, title));
    };
    let report = planner.plan(&problem, &mut Context::seeded(0));
    report.map_err(|error| broken(error.to_string()))?;
    planner.settle(&problem, &mut Context::seeded(0));
    panel(&planner, &problem, "after the plan");
    let revision = problem.revise(&story.then[1].0);
    let revision = revision.map_err(|error| broken(error.to_string()))?;
    let report = planner.replan(&revision, &mut Context::seeded(0));
    report.map_err(|error| broken(error.to_string()))?;
    planner.settle(revision.problem(), &mut Context::seeded(0));
    panel(
        &planner,
        revision.problem(),
        "obstacles added, after the replan",
    );
    let side: f64 = 460.0;
    let mut svg = format!(
        r##"<svg xmlns="http://www.w3.org/2000/svg" width="{}" height="{}" font-family="'DejaVu Sans',sans-serif" font-size="13" fill="#222"><rect width="100%" height="100%" fill="#fff"/>"##,
        2.0 * side,
        side + 60.0
    );
    for (i, panel) in (0..2).zip(&panels) {
        let _ = write!(
            svg,
            r#"<g transform="translate({} 0)">{panel}</g>"#,
            f64::from(i) * side
        );
    }
    svg.push_str("</svg>\n");
    Ok(Figure {
        name: format!("{name}-{}", story.map),
        title: format!("Altitudes, {}, on {}", planner.name(), story.map),
        svg,
    })
}

/// Fig. 1: two ways on, one level; the chance of the other by its gradient, eq. 6 without distances.
fn probabilities() -> String {
    const BASES: [(f64, &str, &str); 3] = [
        (1.5, "#0072b2", ""),
        (2.0, "#d55e00", "8 4"),
        (10.0, "#009e73", "2 3"),
    ];
    let (left, top, width, height) = (60.0, 20.0, 480.0, 300.0);
    let x = |gradient: f64| left + (gradient + 5.0) / 10.0 * width;
    let y = |chance: f64| top + (1.0 - chance) * height;
    let mut svg = format!(
        r##"<svg xmlns="http://www.w3.org/2000/svg" width="600" height="420" font-family="'DejaVu Sans',sans-serif" font-size="13" fill="#222"><rect width="600" height="420" fill="#fff"/><rect x="{left}" y="{top}" width="{width}" height="{height}" fill="none" stroke="#888"/>"##
    );
    for i in -5..=5 {
        let at = x(f64::from(i));
        let _ = write!(
            svg,
            r##"<path d="M{at} {top}v{height}" stroke="#e4e4e4"/><text x="{at}" y="{}" text-anchor="middle">{i}</text>"##,
            top + height + 18.0
        );
    }
    for i in 0..=4 {
        let chance = f64::from(i) / 4.0;
        let at = y(chance);
        let _ = write!(
            svg,
            r##"<path d="M{left} {at}h{width}" stroke="#e4e4e4"/><text x="{}" y="{}" text-anchor="end">{chance}</text>"##,
            left - 8.0,
            at + 5.0
        );
    }
    for (i, (base, colour, dash)) in (0..3).zip(BASES) {
        let mut path = String::new();
        for step in 0..=200 {
            let gradient = f64::from(step) / 20.0 - 5.0;
            let weight = base.powf(gradient);
            let letter = if step == 0 { 'M' } else { 'L' };
            let _ = write!(
                path,
                "{letter}{:.1} {:.1}",
                x(gradient),
                y(weight / (weight + 1.0))
            );
        }
        let key = 380.0;
        let at = left + 20.0 + 150.0 * f64::from(i);
        let _ = write!(
            svg,
            r#"<path d="{path}" fill="none" stroke="{colour}" stroke-width="2.5" stroke-dasharray="{dash}"/><path d="M{at} {key}h34" stroke="{colour}" stroke-width="2.5" stroke-dasharray="{dash}"/><text x="{}" y="{}">pBase = {base}</text>"#,
            at + 42.0,
            key + 5.0
        );
    }
    svg.push_str(r#"<text x="300" y="358" text-anchor="middle">gradient of one of two ways, the other is level</text><text x="18" y="170" text-anchor="middle" transform="rotate(-90 18 170)">probability of the first</text><text x="60" y="408">RFD*: P = pBase^gradient, by the sum of both (eq. 6, without distances)</text></svg>"#);
    svg.push('\n');
    svg
}
