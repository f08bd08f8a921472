//! What a walk knows, what its steps cost, and what becomes of it when the world changes.

#![expect(clippy::unwrap_used, reason = "tests")]

use pf_abc::{Abc, AbcParams, Colony, F2};
use pf_conformance::{
    PlanRng, seeded,
    world::{Kind, Recipe, random_world, trap_world},
};
use pf_core::{
    Context, LocalPlanner, Observable, Outcome, Params, Planner, Problem, Replanner, Step, Walk,
    Walked,
};
use pf_geom::{
    Circle, Observation, Point, Rectangle, Shape, Vector, World, WorldChange, WorldProblem,
};
use rand::RngExt;

fn block(a: (f64, f64), b: (f64, f64)) -> Rectangle {
    Rectangle::new(Point::new(a.0, a.1), Point::new(b.0, b.1)).unwrap()
}

/// Little foraging, as these laws are not about its quality.
fn quick() -> AbcParams {
    AbcParams {
        sources: 5,
        cycles: 2,
        w2: 0.1,
        steps: 150,
        ..AbcParams::default()
    }
}

fn trail(problem: &WorldProblem, params: &AbcParams, seed: u64) -> Vec<Point> {
    let mut colony = Colony::new(params.clone()).unwrap();
    let mut cx = Context::seeded(seed);
    let mut walk = Walk::begin(&mut colony, problem);
    while walk.step(problem, &mut cx) == Walked::On {}
    walk.into_trail()
}

/// A problem in which everything is something else that no window along a trail shows: some of
/// what was out of sight is gone, and other things are there.
fn other_out_of_sight(
    rng: &mut PlanRng,
    problem: &WorldProblem,
    trail: &[Point],
    half: f64,
) -> (WorldProblem, usize) {
    let unseen = |shape: &Shape| {
        let (min, max) = shape.bounding_box();
        let apart = |p: &Point| (0..2).any(|k| max[k] < p[k] - half || p[k] + half < min[k]);
        trail.iter().all(apart)
    };
    let before: Vec<Shape> = problem.world().shapes().map(|(_, s)| s.clone()).collect();
    let mut after: Vec<Shape> = before.iter().filter(|s| !unseen(s)).cloned().collect();
    let kept = after.len();
    let bounds = *problem.world().bounds();
    let size = bounds.max() - bounds.min();
    for _ in 0..60 {
        let share = Vector::new(rng.random_range(0.0..1.0), rng.random_range(0.0..1.0));
        let middle = bounds.min() + size.component_mul(&share);
        let new: Shape = Circle::new(middle, rng.random_range(0.1..2.0))
            .unwrap()
            .into();
        if unseen(&new) {
            after.insert(rng.random_range(0..=after.len()), new);
        }
    }
    let differ = before.len() - kept + after.len() - kept;
    let world = World::with_shapes(bounds, after);
    let (start, goal) = (problem.start(), problem.goal());
    let other = WorldProblem::new(world, problem.radius(), start, goal).unwrap();
    (other, differ)
}

#[test]
fn worlds_that_agree_in_every_visited_region_give_the_same_walk() {
    let mut rng = seeded(11);
    let (mut differences, mut shown) = (0, 0);
    for case in 0..120 {
        let problem = if case % 2 == 0 {
            trap_world(500 + case)
        } else {
            let recipe = Recipe {
                radius: rng.random_range(0.0..0.5),
                ..Recipe::any(&mut rng, 10..=30)
            };
            random_world(&mut rng, &recipe)
        };
        let params = quick();
        let walked = trail(&problem, &params, case);
        let (other, differ) = other_out_of_sight(&mut rng, &problem, &walked, params.half);
        assert_eq!(trail(&other, &params, case), walked, "case {case}");
        differences += differ;
        // Seen a little less far, and the walk is another: the test can fail.
        let (other, _) = other_out_of_sight(&mut rng, &problem, &walked, 0.5 * params.half);
        shown += usize::from(trail(&other, &params, case) != walked);
    }
    assert!(differences > 1000 && shown > 20, "{differences}, {shown}");
}

#[test]
fn ten_thousand_walks_cross_nothing() {
    let mut rng = seeded(12);
    let params = AbcParams {
        sources: 4,
        cycles: 1,
        w2: 0.0,
        steps: 60,
        ..quick()
    };
    let (mut walks, mut arrived, mut steps) = (0, 0, 0);
    for case in 0..500 {
        let problem = match case % 4 {
            0 => trap_world(600 + case),
            k => {
                let kinds = [Kind::Scattered, Kind::Clustered, Kind::Rooms];
                let recipe = Recipe {
                    kind: kinds[usize::try_from(k).unwrap() - 1],
                    ..Recipe::any(&mut rng, 5..=20)
                };
                random_world(&mut rng, &recipe)
            }
        };
        for seed in 0..20 {
            let mut colony = Colony::new(params.clone()).unwrap();
            let mut cx = Context::seeded(seed);
            let mut walk = Walk::begin(&mut colony, &problem);
            let end = loop {
                match walk.step(&problem, &mut cx) {
                    Walked::On => {}
                    end => break end,
                }
            };
            assert_ne!(end, Walked::Refused, "case {case}, seed {seed}");
            let trail = walk.into_trail();
            for pair in trail.windows(2) {
                assert!(problem.is_free(pair[0], pair[1]), "{pair:?}");
            }
            if end == Walked::Arrived {
                assert!(problem.judge(&trail).is_ok());
                arrived += 1;
            }
            steps += trail.len();
            walks += 1;
        }
    }
    assert!(
        walks == 10_000 && arrived > 4000 && steps > 100_000,
        "{arrived}, {steps}"
    );
}

/// From place to place in a world of every shape.
#[test]
fn steps_do_not_allocate_once_lists_have_their_room() {
    let mut rng = seeded(13);
    for w2 in [0.0, 0.1] {
        let recipe = Recipe {
            kind: Kind::Scattered,
            shapes: 40..=40,
            radius: 0.1,
            density: 0.2,
        };
        let problem = random_world(&mut rng, &recipe);
        let mut colony = Colony::new(AbcParams { w2, ..quick() }).unwrap();
        let sensor = LocalPlanner::<WorldProblem>::sensor(&colony);
        let mut cx = Context::seeded(1);
        let mut seen = Observation::default();
        let mut at = problem.start();
        let mut on = |seen: &mut Observation| {
            problem.observe(&at, &sensor, seen);
            if let Step::To(next) = colony.step(seen, &mut cx) {
                at = next;
            }
        };
        on(&mut seen);
        // The lists of an observation grow to what the fullest window so far took.
        (0..40).for_each(|_| on(&mut seen));
        let count = allocation_counter::measure(|| (0..100).for_each(|_| on(&mut seen)));
        assert_eq!(count.count_total, 0);
    }
}

#[test]
fn bad_parameters_are_refused_by_name() {
    for (key, value) in [
        ("half", "0"),
        ("half", "-1"),
        ("half", "inf"),
        ("half", "wide"),
        ("sources", "1"),
        ("sources", "100001"),
        ("cycles", "100001"),
        ("cycles", "-1"),
        ("steps", "-1"),
        ("w1", "-0.1"),
        ("w2", "NaN"),
        ("w3", "inf"),
        ("memory", "-1"),
        ("reach", "0.1"),
        ("reach", "17"),
        ("limit", "-1"),
        ("distance", "far"),
        ("f2", "plus"),
        ("check", "nothing"),
        ("scouts", "two"),
    ] {
        let mut params = AbcParams::default();
        let set = params.set(key, value);
        let error = set.and_then(|()| Abc::new(params).map(|_| ())).unwrap_err();
        let words = error.to_string();
        assert!(
            words.contains(&format!("`{key}`: `")),
            "{key}={value}: {words}"
        );
    }
    let mut params = AbcParams::default();
    params.set("f2", "paper-plus").unwrap();
    assert_eq!(params.f2, F2::PaperPlus);
    assert!(params.set("w4", "1").is_err());
}

/// Of two readings of f2 one keeps away from walls and the other does not.
#[test]
fn obstacles_push_back() {
    let world = World::with_shapes(
        block((0.0, 0.0), (20.0, 20.0)),
        [block((4.0, 0.0), (16.0, 9.0)).into()],
    );
    let ends = [Point::new(3.5, 9.5), Point::new(16.5, 9.5)];
    let problem = WorldProblem::new(world, 0.0, ends[0], ends[1]).unwrap();
    let clearance = |f2| {
        let params = AbcParams {
            f2,
            w2: 0.3,
            memory: 0.0,
            ..AbcParams::default()
        };
        let trail = trail(&problem, &params, 1);
        let inside = trail
            .iter()
            .filter(|p| (5.0..15.0).contains(&p.x))
            .map(|p| p.y - 9.0);
        inside.fold(f64::INFINITY, f64::min)
    };
    assert!(clearance(F2::PushBack) > 0.5 && clearance(F2::PaperPlus) < 0.3);
}

#[test]
fn a_robot_larger_than_its_window_gives_up() {
    let world = World::new(block((0.0, 0.0), (20.0, 20.0)));
    let ends = [Point::new(5.0, 5.0), Point::new(15.0, 15.0)];
    let problem = WorldProblem::new(world, 3.0, ends[0], ends[1]).unwrap();
    let report = Abc::default()
        .plan(&problem, &mut Context::seeded(0))
        .unwrap();
    assert!(matches!(report.outcome, Outcome::Unknown { .. }));
    assert!(report.note("gave up").unwrap().contains("radius 3"));
}

/// A wall with a door that closes before the robot is there, and another that opens.
#[test]
fn a_walk_goes_on_when_the_world_changes() {
    let bounds = block((0.0, 0.0), (30.0, 20.0));
    let pieces = [
        block((14.0, 0.0), (15.0, 8.0)),
        block((14.0, 11.0), (15.0, 20.0)),
    ];
    let world = World::with_shapes(bounds, pieces.map(Into::into));
    for seed in 0..20 {
        let ends = [Point::new(3.0, 10.0), Point::new(27.0, 10.0)];
        let mut problem = WorldProblem::new(world.clone(), 0.0, ends[0], ends[1]).unwrap();
        let mut colony = Colony::new(AbcParams::default()).unwrap();
        let mut cx = Context::seeded(seed);
        let mut walk = Walk::begin(&mut colony, &problem);
        let door = block((14.0, 8.0), (15.0, 11.0));
        let mut steps = 0;
        loop {
            match steps {
                2 => problem.apply(&[WorldChange::Added(door.into())]).unwrap(),
                20 => problem.apply(&[WorldChange::Removed(1)]).unwrap(),
                _ => {}
            }
            let from = *walk.trail().last().unwrap();
            let walked = walk.step(&problem, &mut cx);
            let to = *walk.trail().last().unwrap();
            assert!(problem.is_free(from, to));
            if walked != Walked::On {
                assert_eq!(walked, Walked::Arrived, "seed {seed}");
                break;
            }
            steps += 1;
        }
        assert!(steps > 20, "before anything opened");
    }
}

#[test]
fn a_replan_goes_on_from_where_the_robot_is() {
    let mut problem = trap_world(3);
    let mut planner = Abc::default();
    let report = planner.plan(&problem, &mut Context::seeded(1)).unwrap();
    let path = report.outcome.solved().unwrap().solution.clone();

    let revision = problem.revise(&[]).unwrap();
    let same = planner.replan(&revision, &mut Context::seeded(2)).unwrap();
    assert_eq!(same.outcome.solved().unwrap().solution, path);

    let changes = [WorldChange::StartMoved(path[9])];
    let revision = problem.revise(&changes).unwrap();
    let report = planner.replan(&revision, &mut Context::seeded(2)).unwrap();
    assert_eq!(report.note("replanned"), Some("after 9 steps"));
    assert!(report.outcome.solved().is_some());

    // A goal that is elsewhere altogether makes all that was learnt worthless.
    let changes = [WorldChange::GoalMoved(path[0])];
    let revision = problem.revise(&changes).unwrap();
    let report = planner.replan(&revision, &mut Context::seeded(2)).unwrap();
    assert_eq!(report.note("replanned"), Some("afresh"));
    let afresh = Abc::default()
        .plan(&problem, &mut Context::seeded(2))
        .unwrap();
    let paths = [report, afresh].map(|r| r.outcome.solved().unwrap().solution.clone());
    assert_eq!(paths[0], paths[1]);
}

/// What was told of a place counts when the robot sees it again, and not before.
#[test]
fn memory_fades_where_a_change_is_seen() {
    let world = World::new(block((0.0, 0.0), (40.0, 20.0)));
    let ends = [Point::new(3.0, 10.0), Point::new(37.0, 10.0)];
    let problem = WorldProblem::new(world, 0.0, ends[0], ends[1]).unwrap();
    let way = |rumour: Option<(f64, f64)>| {
        let mut colony = Colony::new(AbcParams::default()).unwrap();
        // Often before, the robot has gone up and down across the way.
        let been: Vec<_> = (0..110)
            .map(|k| Point::new(20.0, f64::from(k % 11) * 2.0))
            .collect();
        let changed = rumour.map(|(x, y)| (Point::new(x, y), Point::new(x + 10.0, y + 20.0)));
        colony.recall(&been, changed.as_slice());
        let mut cx = Context::seeded(5);
        let mut walk = Walk::begin(&mut colony, &problem);
        while walk.step(&problem, &mut cx) == Walked::On {}
        walk.into_trail()
    };
    let untold = way(None);
    assert_eq!(way(Some((15.0, 23.0))), untold, "out of sight");
    let told = way(Some((15.0, 0.0)));
    assert!(
        told.len() + 5 < untold.len(),
        "{} {}",
        told.len(),
        untold.len()
    );
}
