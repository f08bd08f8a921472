//! The 45 cases of the river paper's Tables 1 to 5: exact lengths and the paper's digits, from
//! scratch and, for D* Lite, the exact river and the altitude field, replanned from Table 1's state.
#![expect(clippy::unwrap_used, reason = "a test that stumbles has failed")]

use pf_classic::{AStar, DStarLite, DStarLiteParams, Dijkstra};
use pf_core::{Context, Outcome, Planner, Problem, Replanner, Report};
use pf_grid::{GridChange, GridCost, GridProblem};
use pf_io::{Scenario, read_scenario};
use pf_rfd::{RfdExact, RfdField};
use std::path::Path;

fn scenario() -> Scenario {
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../maps/scenarios/redlarski.toml"
    );
    read_scenario(Path::new(file)).unwrap()
}

#[track_caller]
fn proven(report: &Report<GridProblem>) -> GridCost {
    match &report.outcome {
        Outcome::Optimal(best) => best.cost,
        other => panic!("{other:?}"),
    }
}

/// The paper truncates to two decimals in Tables 1 to 4, and rounds in Table 5, where it also drops
/// trailing zeros.
fn printed(cost: GridCost, rounded: bool) -> String {
    if rounded {
        let text = format!("{:.2}", cost.value());
        return text.trim_end_matches('0').trim_end_matches('.').to_owned();
    }
    format!("{:.2}", (cost.value() * 100.0).floor() / 100.0)
}

#[test]
fn searches_give_the_papers_lengths() {
    let scenario = scenario();
    assert_eq!(scenario.cases.len(), 45);
    let planners: [&mut dyn Planner<GridProblem>; 4] = [
        &mut Dijkstra::default(),
        &mut AStar::default(),
        &mut RfdExact::default(),
        &mut RfdField::default(),
    ];
    for planner in planners {
        for case in &scenario.cases {
            let report = planner.plan(&case.problem, &mut Context::seeded(0));
            let cost = proven(&report.unwrap());
            let expected = case.expected.as_ref().unwrap();
            let name = format!("{} on {}", planner.name(), case.name);
            assert_eq!(cost, expected.cost, "{name}");
            let digits = printed(cost, case.name.ends_with('5'));
            assert_eq!(Some(digits), expected.printed, "{name}");
        }
    }
}

/// How often a planner says that it `did` so in the 36 cases that follow another.
fn replan_all<T: Replanner<GridProblem>>(make: impl Fn() -> T, did: &str) -> u32 {
    let scenario = scenario();
    let mut repaired = 0;
    for case in &scenario.cases {
        let Some(first) = case.follows.map(|k| &scenario.cases[k]) else {
            continue;
        };
        let mut problem = first.problem.clone();
        let mut planner = make();
        let report = planner.plan(&problem, &mut Context::seeded(0)).unwrap();
        assert_eq!(proven(&report), first.expected.as_ref().unwrap().cost);
        let mut changes = case.changes.clone();
        if case.problem.goal() != problem.goal() {
            changes.push(GridChange::GoalMoved(case.problem.goal()));
        }
        if case.problem.start() != problem.start() {
            changes.push(GridChange::StartMoved(case.problem.start()));
        }
        planner.settle(&problem, &mut Context::seeded(0));
        let revision = problem.revise(&changes).unwrap();
        assert_eq!(
            revision.problem().grid(),
            case.problem.grid(),
            "{}",
            case.name
        );
        let report = planner.replan(&revision, &mut Context::seeded(0)).unwrap();
        repaired += u32::from(report.note("replanned") == Some(did));
        let expected = &case.expected.as_ref().unwrap().cost;
        assert_eq!(proven(&report), *expected, "{}", case.name);
    }
    repaired
}

#[test]
fn d_star_lite_gives_the_papers_lengths_from_table_1s_state() {
    replan_all(DStarLite::default, "repaired");
    // Tables 3 and 4 change cells only: there, at least, an endless patience repairs.
    let published = DStarLiteParams {
        patience: f64::INFINITY,
        eager: true,
    };
    let published = || DStarLite::new(published.clone()).unwrap();
    assert!(replan_all(published, "repaired") >= 18);
}

#[test]
fn the_exact_river_gives_the_papers_lengths_from_table_1s_state() {
    assert!(replan_all(RfdExact::default, "kept") >= 30);
}

#[test]
fn the_altitude_field_gives_the_papers_lengths_from_table_1s_state() {
    // Where much was freed at once, on the larger maps, it searches without its fields.
    let afresh = replan_all(RfdField::default, "afresh");
    assert!(afresh <= 6, "{afresh}");
}
