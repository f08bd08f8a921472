//! Time against the resolution of a grid: A* beside L-BFGS (Fig. 11).

use super::{Published, broken};
use crate::{
    PaperError,
    row::{Numbers, Row},
};
use pf_classic::AStar;
use pf_core::{Clock, Context, Planner};
use pf_geom::{Shape, WorldProblem};
use pf_grid::{Cell, Grid, GridProblem, Moves};
use pf_lbfgs::{Lbfgs, LbfgsParams};

/// Cells a unit; the paper does not say which it swept.
pub(super) const RESOLUTIONS: [u32; 5] = [1, 2, 4, 8, 16];

/// The grid over the box of start and goal and 5 around: a cell is blocked if its place lies in a
/// rectangle, border included.
fn grid(problem: &WorldProblem, per_unit: u32) -> Result<GridProblem, PaperError> {
    let (start, goal) = (problem.start(), problem.goal());
    let margin = pf_geom::Vector::repeat(5.0);
    let (min, max) = (start.inf(&goal) - margin, start.sup(&goal) + margin);
    let scale = f64::from(per_unit);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a small number"
    )]
    let index = |v: f64| (v * scale).round() as u32;
    let (width, height) = (index(max.x - min.x) + 1, index(max.y - min.y) + 1);
    let rectangles: Vec<_> = problem
        .world()
        .shapes()
        .filter_map(|(_, shape)| match shape {
            Shape::Rectangle(r) => Some(*r),
            _ => None,
        })
        .collect();
    let grid = Grid::new(width, height, |cell| {
        let place = min + pf_geom::Vector::new(f64::from(cell.x), f64::from(cell.y)) / scale;
        u8::from(!rectangles.iter().any(|r| r.contains(place)))
    });
    let cell = |p: pf_geom::Point| Cell::new(index(p.x - min.x), index(p.y - min.y));
    let problem = GridProblem::new(grid.map_err(broken)?, cell(start), cell(goal));
    Ok(problem.map_err(broken)?.with_moves(Moves::Always))
}

fn least_micros(mut plan: impl FnMut() -> Result<bool, PaperError>) -> Result<f64, PaperError> {
    let clock = Clock::default();
    let mut least = f64::INFINITY;
    for _ in 0..10 {
        let began = clock.now();
        plan()?;
        least = least.min(clock.now().saturating_sub(began).as_secs_f64() * 1e6);
    }
    Ok(least)
}

pub(super) fn run(published: &Published) -> Result<Vec<Row>, PaperError> {
    let problem = published.problem("curved", "cold")?;
    let mut rows = Vec::new();
    let mut push = |case: String, planner, variant: &str, micros: f64, cells: Option<u32>| {
        let printed = case == "1 per unit";
        let said = Numbers::default();
        rows.push(Row {
            paper: "kim",
            table: "time against resolution, curved",
            case,
            planner,
            variant: variant.to_owned(),
            published: if printed {
                said.with("time_us", 28_600.0)
            } else {
                said
            },
            measured: Numbers::default()
                .with("cells", cells)
                .with("time_us", micros),
            reproduced: None,
        });
    };
    for per_unit in RESOLUTIONS {
        let grid = grid(&problem, per_unit)?;
        let cells = grid.grid().width() * grid.grid().height();
        let mut planner = AStar::default();
        let micros = least_micros(|| {
            let report = planner.plan(&grid, &mut Context::seeded(0));
            Ok(report.map_err(broken)?.outcome.solved().is_some())
        })?;
        push(
            format!("{per_unit} per unit"),
            "astar",
            "default",
            micros,
            Some(cells),
        );
    }
    for (variant, params) in [
        ("paper", LbfgsParams::paper()),
        ("default", LbfgsParams::default()),
    ] {
        let mut planner = Lbfgs::new(params).map_err(broken)?;
        let micros = least_micros(|| {
            let report = planner.plan(&problem, &mut Context::seeded(0));
            Ok(report.map_err(broken)?.outcome.solved().is_some())
        })?;
        push("no grid".to_owned(), "lbfgs", variant, micros, None);
    }
    Ok(rows)
}
