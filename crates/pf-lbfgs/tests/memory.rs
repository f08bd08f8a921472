//! What a plan allocates once a planner has the memory it wants.

use allocation_counter::measure;
use pf_conformance::world::{Obstacles as Kind, waypoint_world};
use pf_core::{Context, Planner, Problem, Replanner};
use pf_geom::WorldChange;
use pf_lbfgs::{Lbfgs, LbfgsParams, Obstacles};

#[test]
fn a_plan_by_published_rules_allocates_its_path() {
    let problem = waypoint_world(1, 10, Kind::Rectangles);
    for params in [LbfgsParams::paper(), LbfgsParams::published_code()] {
        let mut planner = Lbfgs::new(params).unwrap();
        planner.plan(&problem, &mut Context::seeded(0)).unwrap();
        let mut cx = Context::seeded(0);
        let taken = measure(|| drop(planner.plan(&problem, &mut cx).unwrap()));
        assert!(taken.count_total <= 1, "{}", taken.count_total);
    }
}

/// The path and the list of notes, however long it takes to get there.
#[test]
fn ours_allocates_one_thing_beside() {
    for obstacles in [Obstacles::Hinge, Obstacles::Potential] {
        let mut problem = waypoint_world(1, 10, Kind::Rectangles);
        let mut planner = Lbfgs::new(LbfgsParams {
            obstacles,
            ..LbfgsParams::default()
        })
        .unwrap();
        let by = pf_geom::Vector::new(0.3, 0.2);
        for round in 0..20 {
            let mut cx = Context::seeded(0);
            let taken = measure(|| drop(planner.plan(&problem, &mut cx).unwrap()));
            assert!(
                round < 10 || taken.count_total <= 2,
                "{}",
                taken.count_total
            );
            let goal = problem.goal() + if round % 2 == 0 { by } else { -by };
            let changes = [WorldChange::GoalMoved(goal)];
            let revision = problem.revise(&changes).unwrap();
            let mut cx = Context::seeded(0);
            let taken = measure(|| drop(planner.replan(&revision, &mut cx).unwrap()));
            assert!(
                round < 10 || taken.count_total <= 2,
                "{}",
                taken.count_total
            );
        }
    }
}
