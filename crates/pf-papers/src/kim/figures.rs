//! The paper's figures, drawn again.

use super::{MAPS, Published, QUERIES, broken, data::has_free_ends, variants};
use crate::{
    PaperError,
    page::Figure,
    plot::{Series, contours, lines},
    row::Row,
};
use pf_core::{Context, Event, Planner, Problem, Replanner};
use pf_geom::{Point, Rectangle, World, WorldProblem};
use pf_lbfgs::{Lbfgs, PaperLoss, plain};
use pf_render::{Line, Picture};

/// All of them; times and costs are those of `rows`.
///
/// # Errors
/// [`PaperError::Data`] if what the program carries is broken.
pub fn figures(published: &Published, rows: &[Row]) -> Result<Vec<Figure>, PaperError> {
    let mut figures = potentials(published)?;
    figures.push(schedule());
    for map in MAPS {
        figures.extend(plans(published, map)?);
    }
    figures.push(costs(rows));
    figures.push(resolutions(rows));
    Ok(figures)
}

/// Fig. 2 and 3: one rectangle with its peak in the middle and shifted, and peaks that connect two.
fn potentials(published: &Published) -> Result<Vec<Figure>, PaperError> {
    let mut figures = Vec::new();
    let corner = |v: f64| Point::new(v, v);
    for (name, title, peak) in [
        (
            "fig2-centred",
            "Fig. 2: a peak in the middle",
            Point::new(15.0, 15.0),
        ),
        (
            "fig2-shifted",
            "Fig. 2: a shifted peak",
            Point::new(12.0, 15.0),
        ),
    ] {
        let bounds = Rectangle::new(corner(0.0), corner(30.0)).map_err(broken)?;
        let rectangle = Rectangle::new(corner(10.0), corner(20.0));
        let rectangle = rectangle.and_then(|r| r.with_peak(peak)).map_err(broken)?;
        let world = World::with_shapes(bounds, [rectangle.into()]);
        let problem = WorldProblem::new(world, 0.0, corner(1.0), corner(28.0)).map_err(broken)?;
        let loss = PaperLoss::new(&problem, 2.0);
        let height = |p: [f64; 2]| loss.potential(Point::new(p[0], p[1]));
        figures.push(Figure {
            name: name.into(),
            title: title.into(),
            svg: contours(title, [[5.0, 5.0], [25.0, 25.0]], 8.0, height),
        });
    }
    let problem = published.problem("curved", "cold")?;
    let loss = PaperLoss::new(&problem, 2.0);
    let height = |p: [f64; 2]| loss.potential(Point::new(p[0], p[1]));
    let title = "Fig. 3: connected peaks (curved)";
    figures.push(Figure {
        name: "fig3-connected".into(),
        title: title.into(),
        svg: contours(title, [[-10.0, -5.0], [40.0, 35.0]], 16.0, height),
    });
    Ok(figures)
}

/// Fig. 4: how the weight of the obstacles grows.
fn schedule() -> Figure {
    let line = |first: f64| {
        let at = |k: u32| [f64::from(k + 1), (first + f64::from(k)).min(32.0)];
        (0..60).map(at).collect()
    };
    let series = [("paper", 0.1), ("published code", 1.1)].map(|(name, first)| Series {
        name: name.into(),
        points: line(first),
    });
    let title = "Fig. 4: the weight of the obstacles";
    Figure {
        name: "fig4-schedule".into(),
        title: title.into(),
        svg: lines(title, ["iteration", "lambda"], false, &series),
    }
}

/// Fig. 5 to 9: the paths of a map, query by query, and how the loss fell.
fn plans(published: &Published, map: &str) -> Result<Vec<Figure>, PaperError> {
    let mut figures = Vec::new();
    let mut planners = Vec::new();
    for (variant, params) in variants() {
        planners.push((variant, Lbfgs::new(params).map_err(broken)?));
    }
    let mut problem = published.problem(map, "cold")?;
    for query in QUERIES {
        let queried = published.problem(map, query)?;
        if !has_free_ends(&queried) {
            break;
        }
        let changes = published.moves(query)?;
        let revision = problem.revise(&changes).map_err(broken)?;
        let loss = PaperLoss::new(&queried, 2.0);
        let (start, goal) = (queried.start(), queried.goal());
        let mut picture = Picture::of_world(queried.world(), 0.0);
        let mut histories = Vec::new();
        for (variant, planner) in &mut planners {
            let mut history = Vec::new();
            let mut listen = |event: &Event<'_, WorldProblem>| {
                if let Event::Candidate(path) = event {
                    let flat = plain(path);
                    let value = loss.evaluate(&flat, 32.0, &mut vec![0.0; flat.len()]);
                    history.push([
                        f64::from(u32::try_from(history.len()).unwrap_or(0)) + 1.0,
                        value,
                    ]);
                }
            };
            let mut cx = Context::seeded(0).traced(&mut listen);
            let report = if query == "cold" {
                planner.plan(revision.problem(), &mut cx)
            } else {
                planner.replan(&revision, &mut cx)
            };
            if let Some(best) = report.map_err(broken)?.outcome.solved() {
                let points: Vec<_> = best.solution.iter().map(|p| [p.x, p.y]).collect();
                let line = if variant.starts_with("default") {
                    Line::Solid
                } else {
                    Line::Dashed
                };
                picture = picture.line(variant, line, &points);
            }
            if !history.is_empty() {
                histories.push(Series {
                    name: (*variant).to_owned(),
                    points: history,
                });
            }
        }
        let title = format!("{map} {query}");
        figures.push(Figure {
            name: format!("paths-{map}-{query}"),
            title: format!("Fig. 5-9: {title}"),
            svg: picture
                .end_points([start.x, start.y], [goal.x, goal.y])
                .caption(title.clone())
                .svg(),
        });
        let title = format!("{title}: the paper's loss at weight 32");
        figures.push(Figure {
            name: format!("history-{map}-{query}"),
            svg: lines(&title, ["step", "loss"], true, &histories),
            title,
        });
    }
    Ok(figures)
}

/// Fig. 10: what cold and warm starts end with.
fn costs(rows: &[Row]) -> Figure {
    let mut series = Vec::new();
    for (variant, _) in variants() {
        for (kind, suffix) in [("warm", ""), ("cold", " from scratch")] {
            let mut points = Vec::new();
            for (k, query) in [(1.0, "warm1"), (2.0, "warm2")] {
                let case = format!("curved {query}{suffix}");
                let row = rows
                    .iter()
                    .find(|row| row.variant == variant && row.case == case);
                points.extend(
                    row.and_then(|row| row.measured.number("loss"))
                        .map(|loss| [k, loss]),
                );
            }
            let name = variant.replace("default, ", "");
            series.push(Series {
                name: format!("{name}, {kind}"),
                points,
            });
        }
    }
    let title = "Fig. 10: loss of cold and warm starts on curved";
    Figure {
        name: "fig10-costs".into(),
        title: title.into(),
        svg: lines(title, ["query after the first", "loss"], false, &series),
    }
}

/// Fig. 11.
fn resolutions(rows: &[Row]) -> Figure {
    let rows = || {
        rows.iter()
            .filter(|row| row.table.starts_with("time against"))
    };
    let time = |row: &Row| row.measured.number("time_us").unwrap_or(f64::NAN);
    let on_grids = rows().filter(|row| row.planner == "astar");
    let mut astar = Vec::new();
    for (row, per_unit) in on_grids.zip(super::grids::RESOLUTIONS) {
        astar.push([f64::from(per_unit), time(row)]);
    }
    let mut series = vec![Series {
        name: "A*".into(),
        points: astar,
    }];
    for row in rows().filter(|row| row.planner == "lbfgs") {
        let ends = super::grids::RESOLUTIONS.map(|r| [f64::from(r), time(row)]);
        series.push(Series {
            name: format!("L-BFGS, {}", row.variant),
            points: ends.to_vec(),
        });
    }
    let title = "Fig. 11: time against the resolution of the grid";
    Figure {
        name: "fig11-resolution".into(),
        title: title.into(),
        svg: lines(title, ["cells a unit", "microseconds"], true, &series),
    }
}
