//! Walks on the two maps, as in the paper's Fig. 4 to 9, and with a memory.

use super::{maps, walk};
use crate::{PaperError, page::Figure};
use pf_abc::{AbcParams, Check};
use pf_conformance::world::{spiral, trap_world};
use pf_geom::WorldProblem;
use pf_render::{Line, Picture};

/// The paper's six, each by the first seed that arrives and with the whole step checked, and three of
/// ours.
///
/// # Errors
/// [`PaperError::Data`] if a map is broken.
pub fn figures() -> Result<Vec<Figure>, PaperError> {
    let maps = maps()?;
    let mut figures = Vec::new();
    for (number, map, weights) in [
        (4, 0, [0.7, 0.0, 0.03]),
        (5, 1, [0.7, 0.0, 0.03]),
        (6, 0, [1.0, 0.2, 0.03]),
        (7, 1, [0.8, 0.1, 0.03]),
        (8, 0, [1.05, 0.2, 0.03]),
        (9, 1, [0.73, 0.09, 0.03]),
    ] {
        let [w1, w2, w3] = weights;
        let params = AbcParams {
            check: Check::Segment,
            ..AbcParams::paper().weighing(weights)
        };
        let title = format!("Fig. {number}: ({w1}, {w2}, {w3}) on map {}", map + 1);
        figures.push(figure(format!("fig{number}"), &title, &maps[map], &params)?);
    }
    let ours = AbcParams::default();
    for (name, title, problem) in [
        ("memory-map2", "with a memory on map 2", &maps[1]),
        (
            "memory-traps",
            "with a memory between traps",
            &trap_world(1000),
        ),
        ("memory-spiral", "with a memory out of a spiral", &spiral(2)),
    ] {
        figures.push(figure(name.to_owned(), title, problem, &ours)?);
    }
    Ok(figures)
}

fn figure(
    name: String,
    title: &str,
    problem: &WorldProblem,
    params: &AbcParams,
) -> Result<Figure, PaperError> {
    let mut trip = walk(problem, params, 0)?;
    let mut seed = 0;
    while !trip.arrived && seed < 100 {
        seed += 1;
        trip = walk(problem, params, seed)?;
    }
    let pair = |p: &pf_geom::Point| [p.x, p.y];
    let line: Vec<_> = trip.trail.iter().map(pair).collect();
    let words = if trip.arrived {
        "arrived"
    } else {
        "did not arrive"
    };
    let svg = Picture::of_world(problem.world(), problem.radius())
        .line("walked", Line::Solid, &line)
        .end_points(pair(&problem.start()), pair(&problem.goal()))
        .caption(title)
        .caption(format!(
            "seed {seed} {words} after {} steps, length {:.1}",
            trip.steps,
            trip.length()
        ))
        .svg();
    Ok(Figure {
        name,
        title: title.to_owned(),
        svg,
    })
}
