//! The rules of the published code beside what that code gives, kept in `../shared`.
#![expect(clippy::unwrap_used, reason = "a test that stumbles has failed")]
#![expect(
    clippy::print_stdout,
    reason = "what was left out, and spreads, are told"
)]

use pf_core::{Context, Outcome, Planner, Problem, Replanner, Report};
use pf_geom::{Point, Rectangle, World, WorldChange, WorldProblem};
use pf_lbfgs::{Lbfgs, LbfgsParams};
use serde_json::Value;
use std::{fs, path::Path};

/// What the public code gives, unless it is not at hand.
fn reference() -> Option<Value> {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/kim/reference.json");
    let Ok(text) = fs::read_to_string(path) else {
        println!("skipped: ../shared is missing");
        return None;
    };
    Some(serde_json::from_str(&text).unwrap())
}

fn numbers(value: &Value) -> Vec<f64> {
    value
        .as_array()
        .unwrap()
        .iter()
        .map(|v| v.as_f64().unwrap())
        .collect()
}

fn ends(reference: &Value, query: &str) -> [Point; 2] {
    [0, 1].map(|k| {
        let at = numbers(&reference["queries"][query][k]);
        Point::new(at[0], at[1])
    })
}

fn problem(reference: &Value, map: &str) -> WorldProblem {
    let rectangles = reference["maps"][map]
        .as_array()
        .unwrap()
        .iter()
        .map(|row| {
            let [x0, x1, y0, y1, px, py] = numbers(row).try_into().unwrap();
            let rectangle = Rectangle::new(Point::new(x0, y0), Point::new(x1, y1)).unwrap();
            rectangle.with_peak(Point::new(px, py)).unwrap().into()
        });
    let bounds = Rectangle::new(Point::new(-10.0, -10.0), Point::new(45.0, 40.0)).unwrap();
    let [start, goal] = ends(reference, "cold");
    WorldProblem::new(World::with_shapes(bounds, rectangles), 0.0, start, goal).unwrap()
}

struct Row {
    iterations: u32,
    loss: f64,
    length: f64,
}

fn row(problem: &WorldProblem, planner: &Lbfgs, report: &Report<WorldProblem>) -> Row {
    let (Outcome::Feasible(best), Some(ended)) = (&report.outcome, planner.descended()) else {
        panic!("{:?}", report.outcome);
    };
    Row {
        iterations: u32::try_from(report.stats.iterations).unwrap(),
        loss: ended.loss,
        length: problem.judge(&best.solution).unwrap(),
    }
}

fn fits(reference: &Value, case: &str, found: &Row) {
    let expected = numbers(&reference["reference"][case]);
    assert!(
        (expected[0] - 2.0..=expected[0] + 2.0).contains(&f64::from(found.iterations)),
        "{case}: {} iterations",
        found.iterations
    );
    assert!(
        (found.loss / expected[1] - 1.0).abs() < 1e-3,
        "{case}: loss {}",
        found.loss
    );
    assert!(
        (found.length / expected[2] - 1.0).abs() < 1e-3,
        "{case}: length {}",
        found.length
    );
}

fn warm(
    planner: &mut Lbfgs,
    problem: &mut WorldProblem,
    [start, goal]: [Point; 2],
) -> Report<WorldProblem> {
    let changes = [WorldChange::StartMoved(start), WorldChange::GoalMoved(goal)];
    let revision = problem.revise(&changes).unwrap();
    planner.replan(&revision, &mut Context::seeded(0)).unwrap()
}

#[test]
fn published_code_gives_what_the_public_code_gives() {
    let Some(reference) = reference() else { return };
    for (map, queries) in [("curved", &["warm1", "warm2"][..]), ("maze", &["warm1"])] {
        let mut problem = problem(&reference, map);
        let mut planner = Lbfgs::new(LbfgsParams::published_code()).unwrap();
        let report = planner.plan(&problem, &mut Context::seeded(0)).unwrap();
        fits(
            &reference,
            &format!("{map} cold"),
            &row(&problem, &planner, &report),
        );
        for query in queries {
            let report = warm(&mut planner, &mut problem, ends(&reference, query));
            fits(
                &reference,
                &format!("{map} {query}"),
                &row(&problem, &planner, &report),
            );
        }
    }
}

/// Where noise decides, the runs of 20 seeds are spread as the public code's are.
#[test]
fn random_rows_are_spread_alike() {
    let Some(reference) = reference() else { return };
    for (map, losses, least) in [("curved", [225.5, 293.7], 10), ("maze", [130.5, 171.5], 8)] {
        let problem = problem(&reference, map);
        let [start, goal] = ends(&reference, "warm1");
        let problem = WorldProblem::new(problem.shared_world(), 0.0, start, goal).unwrap();
        let mut near = [0; 2];
        for seed in 0..20 {
            let mut planner = Lbfgs::new(LbfgsParams::published_code()).unwrap();
            let report = planner.plan(&problem, &mut Context::seeded(seed)).unwrap();
            let found = row(&problem, &planner, &report).loss;
            for (count, loss) in near.iter_mut().zip(losses) {
                *count += usize::from((found / loss - 1.0).abs() < 0.03);
            }
        }
        println!("{map}: {near:?}");
        assert!(near[0] >= least && near[0] < 20, "{map}: {near:?}");
    }
}
