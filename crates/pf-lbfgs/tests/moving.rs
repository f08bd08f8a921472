//! Replans in a row: goals that drift, obstacles that move, sides that are kept.
#![expect(clippy::unwrap_used, reason = "a test that stumbles has failed")]

use pf_conformance::{
    seeded,
    world::{Obstacles as Kind, waypoint_world},
};
use pf_core::{Context, Outcome, PlanRng, Planner, Problem, Replanner, Report};
use pf_geom::{Circle, Point, Rectangle, Vector, World, WorldChange, WorldProblem};
use pf_lbfgs::{Lbfgs, LbfgsParams, Obstacles, PaperLoss, plain};
use rand::RngExt;

fn plan(planner: &mut Lbfgs, problem: &WorldProblem) -> Report<WorldProblem> {
    planner.plan(problem, &mut Context::seeded(0)).unwrap()
}

fn replan(
    planner: &mut Lbfgs,
    problem: &mut WorldProblem,
    changes: &[WorldChange],
) -> Report<WorldProblem> {
    let revision = problem.revise(changes).unwrap();
    planner.replan(&revision, &mut Context::seeded(0)).unwrap()
}

/// A free place within `reach` of another.
fn near(rng: &mut PlanRng, problem: &WorldProblem, of: Point, reach: f64) -> Point {
    loop {
        let mut by = || rng.random_range(-reach..=reach);
        let p = of + Vector::new(by(), by());
        if problem.world().bounds().contains(p) && problem.world().clearance_at(p) > 0.05 {
            return p;
        }
    }
}

/// With the paper's loss a warm start ends where a cold one does, unlike the paper's.
#[test]
fn a_warm_start_is_as_good_as_a_cold_one() {
    for obstacles in [Obstacles::Potential, Obstacles::Hinge] {
        let params = LbfgsParams {
            obstacles,
            hysteresis: 0.0,
            ..LbfgsParams::default()
        };
        let mut ratios = vec![];
        for seed in 2001..2041 {
            let mut rng = seeded(seed);
            let mut problem = waypoint_world(seed, 10, Kind::Rectangles);
            let loss = PaperLoss::new(&problem, params.margin);
            let value = |report: &Report<WorldProblem>| {
                let best = report.outcome.solved().unwrap();
                let path = plain(&best.solution);
                match obstacles {
                    Obstacles::Potential => loss.evaluate(&path, 32.0, &mut vec![0.0; path.len()]),
                    Obstacles::Hinge => best.cost,
                }
            };
            let mut warm = Lbfgs::new(params.clone()).unwrap();
            plan(&mut warm, &problem);
            for reach in [0.5, 0.5, 0.5, 1.0, 1.0, 2.0, 2.0, 10.0, 10.0] {
                let goal = near(&mut rng, &problem, problem.goal(), reach);
                let report = replan(&mut warm, &mut problem, &[WorldChange::GoalMoved(goal)]);
                let cold = plan(&mut Lbfgs::new(params.clone()).unwrap(), &problem);
                ratios.push(value(&report) / value(&cold));
            }
        }
        ratios.sort_by(f64::total_cmp);
        let (median, worst) = (ratios[ratios.len() / 2], ratios[ratios.len() - 1]);
        let high = ratios[ratios.len() * 99 / 100];
        println!("{obstacles}: median {median:.4}, 99 % {high:.4}, worst {worst:.4}");
        assert!(worst <= 1.02, "{obstacles}: {worst}");
    }
}

/// Two hundred obstacles, a goal that moves every step.
#[test]
fn a_thousand_replans_collide_never() {
    let mut rng = seeded(9);
    // Spread out as fifty are in the usual square.
    let recipe = pf_conformance::world::Recipe {
        kind: pf_conformance::world::Kind::Scattered,
        shapes: 200..=200,
        radius: 0.3,
        density: 0.3,
    };
    let mut problem = pf_conformance::world::random_world(&mut rng, &recipe);
    let mut planner = Lbfgs::default();
    let mut counts = [0; 3];
    assert!(plan(&mut planner, &problem).outcome.solved().is_some());
    for step in 0..1000 {
        let goal = loop {
            let goal = near(&mut rng, &problem, problem.goal(), 1.0);
            if problem.is_free(goal, goal) {
                break goal;
            }
        };
        let report = replan(&mut planner, &mut problem, &[WorldChange::GoalMoved(goal)]);
        match &report.outcome {
            Outcome::Feasible(best) => assert!(problem.judge(&best.solution).is_ok()),
            Outcome::Infeasible => {}
            other => panic!("step {step}: {other:?}"),
        }
        let words = ["kept", "repaired", "afresh"];
        if let Some(k) = words
            .iter()
            .position(|word| report.note("replanned") == Some(word))
        {
            counts[k] += 1;
        }
    }
    println!("kept, repaired, afresh: {counts:?}");
    assert!(counts[1] > 500, "{counts:?}");
}

#[test]
fn moving_obstacles_are_dodged() {
    for seed in 2001..2005 {
        let mut rng = seeded(seed);
        let mut problem = waypoint_world(seed, 20, Kind::Mixed);
        let mut planner = Lbfgs::new(LbfgsParams {
            clearance: 0.2,
            ..LbfgsParams::default()
        })
        .unwrap();
        plan(&mut planner, &problem);
        let mut speeds: Vec<Vector> = (0..20)
            .map(|_| Vector::new(rng.random_range(-0.5..0.5), rng.random_range(-0.5..0.5)))
            .collect();
        let mut solved = 0;
        for _ in 0..100 {
            let changes: Vec<WorldChange> = (0..20)
                .map(|id| {
                    let (min, max) = problem.world().shape(id).unwrap().bounding_box();
                    for k in 0..2 {
                        if min[k] < 0.0 || max[k] > 40.0 {
                            speeds[id][k] = speeds[id][k].abs().copysign(20.0 - min[k]);
                        }
                    }
                    WorldChange::Moved(id, speeds[id])
                })
                .collect();
            let report = replan(&mut planner, &mut problem, &changes);
            match &report.outcome {
                Outcome::Feasible(best) => {
                    assert!(problem.judge(&best.solution).is_ok());
                    solved += 1;
                }
                Outcome::Infeasible => {}
                other => panic!("{other:?}"),
            }
        }
        assert!(solved > 50, "{solved}");
    }
}

/// Whoever keeps a side for up to 5 % never goes further than that, wherever ends and obstacles move.
#[test]
fn a_replan_is_at_most_a_share_longer_than_a_plan() {
    let mut worst = 0.0f64;
    for seed in 5001..5050 {
        for (count, kind) in [(10, Kind::Rectangles), (20, Kind::Mixed), (50, Kind::Mixed)] {
            let mut rng = seeded(seed);
            let mut problem = waypoint_world(seed, count, kind);
            let mut planner = Lbfgs::default();
            plan(&mut planner, &problem);
            for step in 0..20 {
                let goal = near(&mut rng, &problem, problem.goal(), 0.8);
                let mut changes = vec![WorldChange::GoalMoved(goal)];
                if step % 7 == 3 {
                    let start = near(&mut rng, &problem, problem.start(), 0.5);
                    changes.push(WorldChange::StartMoved(start));
                }
                if step % 5 == 4 {
                    let by = Vector::new(rng.random_range(-0.3..0.3), 0.1);
                    changes.push(WorldChange::Moved(step % count, by));
                }
                let report = replan(&mut planner, &mut problem, &changes);
                let fresh = plan(&mut Lbfgs::default(), &problem);
                match (&report.outcome, &fresh.outcome) {
                    (Outcome::Feasible(kept), Outcome::Feasible(best)) => {
                        worst = worst.max(kept.cost / best.cost);
                    }
                    (Outcome::Infeasible, Outcome::Infeasible) => {}
                    (kept, best) => panic!("{seed}: {} {}", kept.word(), best.word()),
                }
            }
        }
    }
    println!("worst {worst}");
    assert!(worst <= 1.0 / 0.95 + 1e-3, "{worst}");
}

/// A circle between start and goal; the goal goes up and down behind it.
fn behind_a_circle() -> WorldProblem {
    let bounds = Rectangle::new(Point::new(-10.0, -10.0), Point::new(10.0, 10.0)).unwrap();
    let circle = Circle::new(Point::origin(), 3.0).unwrap();
    let world = World::with_shapes(bounds, [circle.into()]);
    WorldProblem::new(world, 0.0, Point::new(-8.0, 0.0), Point::new(8.0, -0.1)).unwrap()
}

/// The side changes where the other is more than 5 % shorter, and nowhere else.
#[test]
fn sides_change_only_for_more_than_the_share() {
    let side = |report: &Report<WorldProblem>| {
        let path = &report.outcome.solved().unwrap().solution;
        let nearest = path
            .iter()
            .min_by(|a, b| a.x.abs().total_cmp(&b.x.abs()))
            .unwrap();
        nearest.y > 0.0
    };
    let on_side = |above: bool, goal: f64| {
        // What each side's path is like, from a planner that never changes sides.
        let mut problem = behind_a_circle();
        let params = LbfgsParams {
            hysteresis: 0.999,
            ..LbfgsParams::default()
        };
        let mut planner = Lbfgs::new(params).unwrap();
        let y = if above { 1.0 } else { -1.0 };
        problem
            .apply(&[WorldChange::GoalMoved(Point::new(8.0, y))])
            .unwrap();
        plan(&mut planner, &problem);
        let moved = [WorldChange::GoalMoved(Point::new(8.0, goal))];
        let report = replan(&mut planner, &mut problem, &moved);
        assert_eq!(side(&report), above);
        report.outcome.solved().unwrap().cost
    };
    let mut problem = behind_a_circle();
    let mut planner = Lbfgs::default();
    let mut above = side(&plan(&mut planner, &problem));
    let mut changes = 0;
    for step in 0..400 {
        let goal = 4.0 * (f64::from(step) / 50.0).sin();
        let moved = [WorldChange::GoalMoved(Point::new(8.0, goal))];
        let report = replan(&mut planner, &mut problem, &moved);
        let (kept, other) = (on_side(above, goal), on_side(!above, goal));
        if side(&report) == above {
            assert!(other >= 0.949 * kept, "step {step}: {other} {kept}");
        } else {
            assert!(other <= 0.951 * kept, "step {step}: {other} {kept}");
            assert_eq!(report.note("replanned"), Some("afresh"));
            changes += 1;
            above = !above;
        }
    }
    assert!((2..=8).contains(&changes), "{changes}");
}
