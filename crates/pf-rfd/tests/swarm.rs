//! What the drops do, whoever counts the threads; and what is refused.
#![expect(clippy::unwrap_used, reason = "a test that stumbles has failed")]

use pf_core::{Context, Event, Params, Planner, Problem, Replanner};
use pf_grid::{Cell, Grid, GridChange, GridProblem, Moves};
use pf_rfd::{Rfd, RfdExact, RfdExactParams, RfdParams, RfdStar, RfdStarParams};
use std::fmt::Write;

const MAP: &str = "
    ............
    .....@@@@...
    ........@...
    ..222...@...
    ..222...@...
    .....@@@@...
    ............
";

fn problem() -> GridProblem {
    let problem = GridProblem::new(Grid::parse(MAP).unwrap(), Cell::new(0, 3), Cell::new(11, 3));
    problem.unwrap().with_moves(Moves::Always)
}

/// Every event of a plan and of a replan.
fn trace(planner: &mut dyn Replanner<GridProblem>) -> String {
    let mut text = String::new();
    let mut listen = |event: &Event<'_, GridProblem>| {
        writeln!(text, "{event:?}").unwrap();
        if let Event::Field { value, .. } = event {
            for cell in problem().grid().layout().cells() {
                write!(text, "{:?} ", value(&cell)).unwrap();
            }
        }
    };
    let mut problem = problem();
    planner
        .plan(&problem, &mut Context::seeded(3).traced(&mut listen))
        .unwrap();
    let changes = [GridChange::Freed(vec![Cell::new(8, 3)])];
    let revision = problem.revise(&changes).unwrap();
    planner
        .replan(&revision, &mut Context::seeded(4).traced(&mut listen))
        .unwrap();
    text
}

#[test]
fn threads_change_nothing() {
    let star = |threads| {
        let params = RfdStarParams {
            threads,
            iterations: 10,
            ..RfdStarParams::authors_code()
        };
        trace(&mut RfdStar::new(params).unwrap())
    };
    let one = star(1);
    assert!(one.lines().count() > 500);
    for threads in [2, 3, 50, 200] {
        assert!(star(threads) == one, "{threads} threads");
    }
    let linear = |threads| {
        let params = RfdParams {
            threads,
            iterations: 10,
            ..RfdParams::default()
        };
        trace(&mut Rfd::new(params).unwrap())
    };
    assert!(linear(2) == linear(1));
}

#[test]
fn a_seeded_river_finds_the_best_way() {
    let mut river = RfdStar::new(RfdStarParams::seeded()).unwrap();
    let exact = RfdExact::default()
        .plan(&problem(), &mut Context::seeded(0))
        .unwrap();
    let report = river.plan(&problem(), &mut Context::seeded(0)).unwrap();
    let cost = |report: &pf_core::Report<GridProblem>| report.outcome.solved().map(|s| s.cost);
    assert_eq!(cost(&report), cost(&exact));
    assert_eq!(report.outcome.word(), "feasible");
}

#[test]
fn bad_parameters_are_refused_with_name_value_and_range() {
    let rfd = |set: fn(&mut RfdParams)| {
        let mut params = RfdParams::default();
        set(&mut params);
        Rfd::new(params).map(|_| ()).unwrap_err().to_string()
    };
    let star = |key: &str, value: &str| {
        let mut params = RfdStarParams::paper();
        params.set(key, value).unwrap();
        RfdStar::new(params).map(|_| ()).unwrap_err().to_string()
    };
    assert_eq!(
        rfd(|p| p.drops = 0),
        "parameter `drops`: `0` is not a whole number from 1 to 65536"
    );
    assert_eq!(
        rfd(|p| p.altitude = -1.0),
        "parameter `altitude`: `-1` is not a positive number"
    );
    assert_eq!(
        rfd(|p| p.climb = 1.5),
        "parameter `climb`: `1.5` is not a number from 0 to 1"
    );
    assert!(rfd(|p| p.omega = f64::NAN).contains("`NaN` is not a number from 0"));
    assert_eq!(
        star("p_base", "0"),
        "parameter `p_base`: `0` is not a number above 0, up to 1e30"
    );
    assert_eq!(
        star("alpha", "-8"),
        "parameter `alpha`: `-8` is not a number from 0 to 64"
    );
    assert!(star("threads", "0").contains("a whole number from 1 to 256"));
    assert!(RfdExact::new(RfdExactParams { pool: 0 }).is_err());
}

#[test]
fn a_variant_sets_all_the_others() {
    let mut params = RfdStarParams::paper();
    params.set("variant", "authors-code").unwrap();
    assert_eq!(params, RfdStarParams::authors_code());
    params.set("drops", "7").unwrap();
    params.set("pull", "power").unwrap();
    assert_ne!(params, RfdStarParams::authors_code());
    let error = params.set("variant", "mine").unwrap_err().to_string();
    assert_eq!(
        error,
        "parameter `variant`: `mine` is not paper, authors-code or seeded"
    );
    let error = params.set("pull", "magnetic").unwrap_err().to_string();
    assert!(error.contains("Pull"), "{error}");
    let error = params.set("drop", "1").unwrap_err().to_string();
    assert!(error.contains("known: variant, drops"), "{error}");
}
