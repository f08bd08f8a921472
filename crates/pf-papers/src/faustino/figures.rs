//! Paths of swarms of each size round a circle and a rectangle.

use super::{scene, variants};
use crate::{PaperError, page::Figure};
use pf_core::{Context, Planner};
use pf_pso::{Pso, PsoParams};
use pf_render::{Line, Picture};

/// Two pictures for each set of parameters.
///
/// # Errors
/// [`PaperError::Data`] if a set of parameters makes no sense.
pub fn figures() -> Result<Vec<Figure>, PaperError> {
    let mut figures = Vec::new();
    for (variant, params) in variants() {
        for (round, format) in [(true, "circle"), (false, "rectangle")] {
            let problem = scene(3, round);
            let mut picture = Picture::of_world(problem.world(), problem.radius());
            let (start, goal) = (problem.start(), problem.goal());
            for (particles, line) in [(1, Line::Dashed), (10, Line::Dashed), (20, Line::Solid)] {
                let params = PsoParams {
                    particles,
                    ..params.clone()
                };
                let broken = |error: &dyn std::fmt::Display| PaperError::Data(error.to_string());
                let mut planner = Pso::new(params).map_err(|error| broken(&error))?;
                let report = planner.plan(&problem, &mut Context::seeded(3));
                let report = report.map_err(|error| broken(&error))?;
                if let Some(best) = report.outcome.solved() {
                    let points: Vec<_> = best.solution.iter().map(|p| [p.x, p.y]).collect();
                    picture = picture.line(&format!("{particles} particles"), line, &points);
                }
            }
            figures.push(Figure {
                name: format!(
                    "paths-{format}-{}",
                    variant.replace(", ", "-").replace(' ', "-")
                ),
                title: format!("{variant}: round a {format}"),
                svg: picture
                    .end_points([start.x, start.y], [goal.x, goal.y])
                    .caption(format!("{variant}, {format}"))
                    .svg(),
            });
        }
    }
    Ok(figures)
}
