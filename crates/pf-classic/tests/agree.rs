//! All planners on grids say the same, a million times.

use pf_classic::{AStar, Auto, DStarLite, Dijkstra, Jps, Prepared};
use pf_conformance::{
    grid::{Recipe, drawing, random_batch, random_problem},
    seeded,
};
use pf_core::{Context, Outcome, Planner, Problem, Replanner, Report};
use pf_grid::{Cell, GridChange, GridCost, GridProblem};
use rand::RngExt;

const MAPS: u32 = 36_000;
const QUERIES: u32 = 40;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Said {
    Least(GridCost),
    NoPath,
    Nothing,
}

fn said(report: &Report<GridProblem>) -> Said {
    match &report.outcome {
        Outcome::Optimal(best) => Said::Least(best.cost),
        Outcome::Infeasible => Said::NoPath,
        _ => Said::Nothing,
    }
}

/// Grids up to 16 x 16 under all move rules, with and without terrain, ends on blocked cells too,
/// and changed cells in between. What D* Lite keeps from query to query must not show.
#[test]
fn a_million_small_queries() {
    let mut rng = seeded(40);
    let (mut astar, mut dijkstra) = (AStar::default(), Dijkstra::default());
    let (mut solved, mut jumped) = (0, 0);
    for map in 0..MAPS {
        let mut recipe = Recipe::any(&mut rng, 1..=16);
        // Jump points need plain cells: three maps of four stay so.
        let plain = map % 4 > 0;
        recipe.terrain &= !plain;
        let mut problem = random_problem(&mut rng, &recipe);
        let mut repaired = DStarLite::default();
        repaired.plan(&problem, &mut Context::seeded(0)).unwrap();
        let (mut jumps, mut auto) = (Jps::default(), Auto::default());
        let mut prepared = Prepared::default();
        for query in 0..QUERIES {
            let grid = problem.grid();
            let (width, height) = (grid.width(), grid.height());
            let mut cell = || Cell::new(rng.random_range(0..width), rng.random_range(0..height));
            let mut changes = match query % 4 {
                0 => vec![
                    GridChange::GoalMoved(cell()),
                    GridChange::StartMoved(cell()),
                ],
                _ => vec![GridChange::StartMoved(cell())],
            };
            if query % 2 == 1 {
                changes.extend(random_batch(&mut rng, &problem, 10));
                let keeps = |change: &_| !(plain && matches!(change, GridChange::CostChanged(..)));
                changes.retain(keeps);
            }
            let revision = problem.revise(&changes).unwrap();
            let cx = || Context::seeded(0);
            let all = [
                repaired.replan(&revision, &mut cx()),
                astar.plan(revision.problem(), &mut cx()),
                dijkstra.plan(revision.problem(), &mut cx()),
            ]
            .map(|report| said(&report.unwrap()));
            assert!(
                all[0] != Said::Nothing && all[0] == all[1] && all[1] == all[2],
                "map {map}, query {query}: D* Lite, A*, Dijkstra say {all:?} on\n{}",
                drawing(&problem)
            );
            let chosen = auto.replan(&revision, &mut cx()).unwrap();
            assert_eq!(
                said(&chosen),
                all[1],
                "map {map}, query {query}: {:?}",
                chosen.note("search")
            );
            let jumping: [&mut dyn Replanner<GridProblem>; 2] = [&mut jumps, &mut prepared];
            for planner in jumping {
                match planner.replan(&revision, &mut cx()) {
                    Ok(report) => {
                        let name = planner.name();
                        assert_eq!(said(&report), all[1], "map {map}, query {query}: {name}");
                        jumped += 1;
                    }
                    Err(why) => assert!(!revision.problem().grid().is_uniform(), "{why}"),
                }
            }
            // In the end it has answered as many queries by its table as without.
            if query % 3 == 0 {
                prepared.settle(&problem, &mut cx());
            }
            solved += u32::from(matches!(all[0], Said::Least(_)));
            if query % 7 == 0 {
                repaired.settle(&problem, &mut cx());
            }
        }
    }
    assert!(solved > 200_000, "only {solved} have a path");
    assert!(jumped > 2_200_000, "only {jumped} without terrain");
}
