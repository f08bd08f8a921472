//! Scenes with one obstacle, odd questions, and swarms that are kept.

use pf_conformance::world::quadrant_scene;
use pf_core::{Context, Event, Outcome, Planner, Problem, Replanner};
use pf_geom::{Answer, Point, TangentGraph, Vector, WorldChange, WorldProblem};
use pf_pso::{Pso, PsoParams};

#[test]
fn twenty_particles_find_a_way_nearly_always() {
    for params in [PsoParams::default(), PsoParams::paper()] {
        for round in [true, false] {
            let mut planner = Pso::new(params.clone()).unwrap();
            let mut solved = 0;
            for seed in 0..100 {
                let problem = quadrant_scene(200_000 + seed, round, seed / 10);
                let report = planner.plan(&problem, &mut Context::seeded(seed)).unwrap();
                solved += u32::from(report.outcome.solved().is_some());
            }
            assert!(solved >= 98, "{solved} of 100");
        }
    }
}

/// The worst ways are those past the wrong side of the obstacle.
#[test]
fn few_swarms_gather_on_the_longer_side() {
    let mut planner = Pso::default();
    let mut far = 0;
    for seed in 0..200 {
        let problem = quadrant_scene(200_000 + seed, seed % 2 == 0, seed / 10);
        let grown = WorldProblem::new(
            problem.shared_world(),
            problem.radius() + PsoParams::default().clearance,
            problem.start(),
            problem.goal(),
        );
        let report = planner.plan(&problem, &mut Context::seeded(seed)).unwrap();
        let exact = TangentGraph::default().shortest(&grown.unwrap(), &mut Context::seeded(0));
        if let (Some(best), Answer::Route(route)) = (report.outcome.solved(), exact) {
            far += u32::from(best.cost > 1.1 * route.length());
        }
    }
    assert!(far <= 10, "{far} of 200 are over 1.1 times the shortest");
}

#[test]
fn announced_ways_get_shorter() {
    let problem = quadrant_scene(1, true, 0);
    let mut lengths = Vec::new();
    let mut listen = |event: &Event<'_, WorldProblem>| {
        if let Event::Improved(best) = event {
            assert_eq!(problem.judge(&best.solution), Ok(best.cost));
            lengths.push(best.cost);
        }
    };
    let mut cx = Context::seeded(1).traced(&mut listen);
    let report = Pso::default().plan(&problem, &mut cx).unwrap();
    let handed_out = lengths.pop();
    assert_eq!(handed_out, report.outcome.solved().map(|best| best.cost));
    assert!(lengths.len() > 10, "only {} improvements", lengths.len());
    assert!(lengths.is_sorted_by(|a, b| a > b));
}

#[test]
fn a_kept_swarm_follows_the_goal() {
    let mut problem = quadrant_scene(1, true, 0);
    let mut planner = Pso::default();
    planner.plan(&problem, &mut Context::seeded(1)).unwrap();
    for _ in 0..10 {
        let goal = problem.goal() - Vector::new(0.05, 0.02);
        let changes = [WorldChange::GoalMoved(goal)];
        let revision = problem.revise(&changes).unwrap();
        let report = planner.replan(&revision, &mut Context::seeded(1)).unwrap();
        assert_eq!(report.note("replanned"), Some("repaired"));
        assert!(report.outcome.solved().is_some());
    }
}

#[test]
fn odd_questions_get_honest_answers() {
    let scene = quadrant_scene(1, true, 0);
    let world = scene.shared_world();
    let ask = |params: PsoParams, start: Point, goal: Point| {
        let problem = WorldProblem::new(world.clone(), 0.2, start, goal).unwrap();
        let report = Pso::new(params)
            .unwrap()
            .plan(&problem, &mut Context::seeded(1))
            .unwrap();
        if let Some(best) = report.outcome.solved() {
            assert!(problem.judge(&best.solution).is_ok());
        }
        report.outcome
    };
    let (min, max) = world.shape(0).unwrap().bounding_box();
    let middle = min + (max - min) / 2.0;
    let (start, goal) = (scene.start(), scene.goal());
    assert!(matches!(
        ask(PsoParams::default(), middle, goal),
        Outcome::Infeasible
    ));
    assert!(matches!(
        ask(PsoParams::default(), start, middle),
        Outcome::Infeasible
    ));
    assert!(ask(PsoParams::default(), start, start).solved().is_some());
    for (waypoints, iterations) in [(0, 150), (1, 150), (10_000, 2)] {
        ask(
            PsoParams {
                waypoints,
                iterations,
                ..PsoParams::default()
            },
            start,
            goal,
        );
    }
}

#[test]
fn bad_parameters_are_named_with_value_and_range() {
    let refused = |params: PsoParams| Pso::new(params).map(|_| ()).unwrap_err().to_string();
    let params = PsoParams {
        particles: 0,
        ..PsoParams::default()
    };
    assert_eq!(
        refused(params),
        "parameter `particles`: `0` is not a whole number from 1 to 1000000"
    );
    let params = PsoParams {
        clearance: f64::NAN,
        ..PsoParams::default()
    };
    assert_eq!(
        refused(params),
        "parameter `clearance`: `NaN` is not a number from 0"
    );
}
