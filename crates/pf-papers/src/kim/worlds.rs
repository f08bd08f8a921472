//! How many of 40 made-up worlds come out free by each set of rules.

use super::{broken, variants};
use crate::{
    PaperError,
    row::{Numbers, Row},
};
use pf_classic::VisibilityGraph;
use pf_conformance::world::{Obstacles, waypoint_world};
use pf_core::{CancelToken, Context, Planner};
use pf_lbfgs::Lbfgs;

/// Seeds that nothing was tried out on.
const SEEDS: std::ops::Range<u64> = 2001..2041;

pub(super) fn run(cancel: &CancelToken) -> Result<Vec<Row>, PaperError> {
    let mut rows = Vec::new();
    for count in [5, 10, 20, 50] {
        for (variant, params) in variants() {
            let (mut free, mut solvable) = (0, 0);
            for seed in SEEDS {
                if cancel.is_cancelled() {
                    return Err(PaperError::Interrupted);
                }
                let problem = waypoint_world(seed, count, Obstacles::Rectangles);
                let mut planner = Lbfgs::new(params.clone()).map_err(broken)?;
                let report = planner.plan(&problem, &mut Context::seeded(seed));
                free += u32::from(report.map_err(broken)?.outcome.solved().is_some());
                let exact = VisibilityGraph::default().plan(&problem, &mut Context::seeded(0));
                solvable += u32::from(exact.map_err(broken)?.outcome.solved().is_some());
            }
            rows.push(Row {
                paper: "kim",
                table: "worlds made up, of 40",
                case: format!("{count} rectangles"),
                planner: "lbfgs",
                variant: variant.to_owned(),
                published: Numbers::default(),
                measured: Numbers::default()
                    .with("free", free)
                    .with("solvable", solvable),
                reproduced: None,
            });
        }
    }
    Ok(rows)
}
