//! Teams: collisions in time against a sampler, the judge, bad questions, changes.
#![expect(clippy::unwrap_used, reason = "a test that stumbles has failed")]

use pf_core::{Cost, Front, PlanRng, Problem, Violation};
use pf_geom::{
    Circle, DANGER, DeadEnd, LENGTH, Point, Rectangle, Robot, TURNING, TeamChange, TeamPlan,
    TeamProblem, TimedPath, TimedPoint, Timing, Vector, World, closest_approach,
};
use rand::{RngExt, SeedableRng};

fn square(side: f64) -> World {
    World::new(Rectangle::new(Point::origin(), Point::new(side, side)).unwrap())
}

fn at(x: f64, y: f64, time: f64) -> TimedPoint {
    let at = Point::new(x, y);
    TimedPoint { at, time }
}

/// A path of up to 2 s: some pieces, some of them waiting, in a square with a side of 4.
fn made_up(rng: &mut PlanRng) -> TimedPath {
    let mut times: Vec<f64> = (0..rng.random_range(1..6))
        .map(|_| rng.random_range(0.0..2.0))
        .collect();
    times.sort_by(f64::total_cmp);
    let mut place = Point::new(rng.random_range(0.0..4.0), rng.random_range(0.0..4.0));
    let mut path = vec![TimedPoint {
        at: place,
        time: 0.0,
    }];
    for time in times {
        if rng.random_bool(0.8) {
            place = Point::new(rng.random_range(0.0..4.0), rng.random_range(0.0..4.0));
        }
        path.push(TimedPoint { at: place, time });
    }
    path
}

/// Where a path is, found anew.
fn place(path: &[TimedPoint], time: f64) -> Point {
    let last = path[path.len() - 1];
    let next = path
        .windows(2)
        .find(|w| w[0].time <= time && time < w[1].time);
    next.map_or(
        if time < path[0].time {
            path[0].at
        } else {
            last.at
        },
        |w| w[0].at + (w[1].at - w[0].at) * ((time - w[0].time) / (w[1].time - w[0].time)),
    )
}

/// How fast a path is at a time, at most, and until when that holds.
fn pace(path: &[TimedPoint], time: f64) -> (f64, f64) {
    let next = path
        .windows(2)
        .find(|w| w[0].time <= time && time < w[1].time);
    next.map_or((0.0, f64::INFINITY), |w| {
        (
            (w[1].at - w[0].at).norm() / (w[1].time - w[0].time),
            w[1].time,
        )
    })
}

/// Conservative advancement: whether two discs touch, by steps that are too small to miss it.
/// `None` if they come within a hair of touching.
fn sampled(a: &[TimedPoint], b: &[TimedPoint], reach: f64) -> Option<bool> {
    const HAIR: f64 = 1e-6;
    let (mut time, mut near) = (0.0, false);
    while time <= 2.0 {
        let gap = (place(a, time) - place(b, time)).norm() - reach;
        if gap < -HAIR {
            return Some(true);
        }
        near |= gap < HAIR;
        let ((fast, until), (other, other_until)) = (pace(a, time), pace(b, time));
        // So short a step at least that what it misses is a hair.
        let step = gap.max(HAIR / 2.0) / (fast + other).max(1e-3);
        // Not beyond a breakpoint, where the pace changes.
        time = (time + step).min(until.min(other_until).max(time + 1e-12));
    }
    let gap = (place(a, 2.0) - place(b, 2.0)).norm() - reach;
    near |= gap.abs() < HAIR;
    if near { None } else { Some(gap < 0.0) }
}

#[test]
fn collisions_are_those_that_a_sampler_finds() {
    let mut rng = PlanRng::seed_from_u64(8);
    let (mut hits, mut misses, mut close) = (0, 0, 0);
    for _ in 0..100_000 {
        let (a, b) = (made_up(&mut rng), made_up(&mut rng));
        let reach = rng.random_range(0.01..1.0);
        let exact = closest_approach(&a, &b).0 < reach;
        match sampled(&a, &b, reach) {
            Some(found) => {
                assert_eq!(found, exact, "{a:?} {b:?} {reach}");
                hits += u32::from(found);
                misses += u32::from(!found);
            }
            None => close += 1,
        }
    }
    assert!(
        hits > 20_000 && misses > 20_000 && close < 100,
        "{hits} {misses} {close}"
    );
}

#[test]
fn the_closest_approach_is_where_it_is_said_to_be() {
    let mut rng = PlanRng::seed_from_u64(9);
    for _ in 0..10_000 {
        let (a, b) = (made_up(&mut rng), made_up(&mut rng));
        let (distance, time) = closest_approach(&a, &b);
        assert!(((place(&a, time) - place(&b, time)).norm() - distance).abs() < 1e-9);
        assert!((closest_approach(&b, &a).0 - distance).abs() < 1e-12);
    }
}

/// Two robots whose straight ways cross in the middle at one time.
fn crossing() -> TeamProblem {
    let east = Robot::new(Point::new(1.0, 5.0), Point::new(9.0, 5.0)).with_radius(0.5);
    let north = Robot::new(Point::new(5.0, 1.0), Point::new(5.0, 9.0)).with_radius(0.5);
    TeamProblem::new(square(10.0), vec![east, north]).unwrap()
}

fn only(plan: &TeamPlan) -> Front<TeamPlan> {
    Front::unchecked(vec![plan.clone()])
}

#[test]
fn the_judge_names_the_rule_and_the_robot() {
    let team = crossing();
    let around = vec![Point::new(3.0, 3.0)];
    let good = TeamPlan::at_top_speed(&team, [vec![], around]);
    let cost = team.judge(&only(&good)).unwrap().members()[0];
    assert!((cost[LENGTH] - 8.0 - 8f64.sqrt() - 40f64.sqrt()).abs() < 1e-12);
    assert!(cost[TURNING] > 1.0 && cost[DANGER] > 8.0);

    let refused = |change: &dyn Fn(&mut TeamPlan)| {
        let mut plan = good.clone();
        change(&mut plan);
        team.judge(&only(&plan)).unwrap_err().to_string()
    };
    let said = refused(&|plan| plan.paths.truncate(1));
    assert_eq!(said, "member 0: has 1 paths, not 2");
    let said = refused(&|plan| plan.paths[1][0].at.x += 0.1);
    assert_eq!(said, "member 0: robot 1: does not begin at the start");
    let said = refused(&|plan| plan.paths[0].truncate(1));
    assert_eq!(said, "member 0: robot 0: does not end at the goal");
    let said = refused(&|plan| plan.paths[1][1].time -= 0.1);
    assert_eq!(
        said,
        "member 0: robot 1: move 0 is not possible in its time"
    );
    let said = refused(&|plan| plan.paths[1][1].time = f64::NAN);
    assert_eq!(
        said,
        "member 0: robot 1: move 0 is not possible in its time"
    );
    let said = refused(&|plan| plan.paths[0].clear());
    assert_eq!(said, "member 0: robot 0: is empty");
    let straight = TeamPlan::at_top_speed(&team, [vec![], vec![]]);
    let meeting = Violation::Meeting {
        first: 0,
        second: 1,
    };
    assert_eq!(team.judge(&only(&straight)), Err(meeting.of("member", 0)));
    let met = team.meeting(&straight).unwrap();
    assert!((met.time - 4.0).abs() < 1e-12 && met.distance < 1e-12);
    assert!(
        team.clone()
            .with_timing(Timing::Ignored)
            .judge(&only(&straight))
            .is_ok()
    );
    assert_eq!(team.judge(&Front::default()), Err(Violation::Empty));
}

#[test]
fn a_front_with_a_dominated_member_is_refused() {
    let team = crossing().with_timing(Timing::Ignored);
    let straight = TeamPlan::at_top_speed(&team, [vec![], vec![]]);
    let around = TeamPlan::at_top_speed(&team, [vec![], vec![Point::new(7.0, 3.0)]]);
    let front = Front::unchecked(vec![around, straight]);
    let dominated = Violation::Dominated { member: 0, by: 1 };
    assert_eq!(team.judge(&front), Err(dominated));
}

#[test]
fn obstacles_and_bounds_are_for_the_judge_what_they_are_for_a_mark() {
    let mut world = square(10.0);
    world.add(Circle::new(Point::new(5.0, 5.0), 1.0).unwrap().into());
    let robot = Robot::new(Point::new(1.0, 5.0), Point::new(9.0, 5.0)).with_radius(0.5);
    let team = TeamProblem::new(world, vec![robot]).unwrap();
    let mut rng = PlanRng::seed_from_u64(3);
    let mut good = 0;
    for _ in 0..10_000 {
        let mut any = || Point::new(rng.random_range(-1.0..11.0), rng.random_range(-1.0..11.0));
        let plan = TeamPlan::at_top_speed(&team, [vec![any(), any()]]);
        let mark = team.mark(|robot| &plan.paths[robot]);
        let judged = team.judge_plan(&plan);
        assert_eq!(judged.is_ok(), mark.excess == 0.0);
        let free = plan.paths[0].windows(2).all(|w| {
            team.world()
                .is_free(&pf_geom::Segment::new(w[0].at, w[1].at), 0.5)
        });
        assert_eq!(judged.is_ok(), free);
        if let Ok(cost) = judged {
            assert!(cost.same_as(&mark.objectives));
            let clearance = plan.paths[0].windows(2).map(|w| {
                team.world()
                    .clearance(&pf_geom::Segment::new(w[0].at, w[1].at))
                    - 0.5
            });
            let danger = 10.0 - clearance.fold(10.0, f64::min);
            assert!((cost[DANGER] - danger).abs() < 1e-9);
            good += 1;
        }
    }
    assert!(good > 1000, "{good}");
}

#[test]
fn waiting_is_no_turn_and_turning_back_is_half_a_circle() {
    let robot = Robot::new(Point::new(1.0, 1.0), Point::new(3.0, 1.0));
    let team = TeamProblem::new(square(10.0), vec![robot]).unwrap();
    let path = vec![
        at(1.0, 1.0, 0.0),
        at(5.0, 1.0, 4.0),
        at(5.0, 1.0, 6.0),
        at(3.0, 1.0, 9.0),
    ];
    let cost = team.judge_plan(&TeamPlan { paths: vec![path] }).unwrap();
    assert!((cost[TURNING] - std::f64::consts::PI).abs() < 1e-12);
    assert!((cost[LENGTH] - 6.0).abs() < 1e-12);
}

#[test]
fn bad_questions_are_refused_with_the_robot_s_number() {
    let (a, b) = (Point::new(1.0, 1.0), Point::new(9.0, 9.0));
    let (c, d) = (Point::new(1.0, 9.0), Point::new(9.0, 1.0));
    let refused = |robots: Vec<Robot>| {
        TeamProblem::new(square(10.0), robots)
            .unwrap_err()
            .to_string()
    };
    assert_eq!(
        refused(vec![]),
        "the number of robots is 0, expected at least one"
    );
    let one = Robot::new(a, b);
    assert_eq!(
        refused(vec![one, Robot::new(a, d)]),
        "the start of robot 1 is (1, 1), that of robot 0, expected a place of its own"
    );
    assert_eq!(
        refused(vec![one, Robot::new(c, b)]),
        "the goal of robot 1 is (9, 9), that of robot 0, expected a place of its own"
    );
    assert_eq!(
        refused(vec![one, Robot::new(c, d).with_speed(0.0)]),
        "the top speed of robot 1 is 0, expected a positive number"
    );
    assert_eq!(
        refused(vec![one.with_radius(-1.0)]),
        "the radius of robot 0 is -1, expected a number from 0"
    );
    assert_eq!(
        refused(vec![one, Robot::new(c, Point::new(11.0, 1.0))]),
        "the goal of robot 1 (11, 1) lies outside the (0, 0) to (10, 10) world"
    );
    let near = Robot::new(c, Point::new(9.0, 8.5)).with_radius(0.5);
    let team = TeamProblem::new(square(10.0), vec![one.with_radius(0.5), near]).unwrap();
    assert_eq!(team.dead_end(), Some(DeadEnd::Goals(0, 1)));
    assert_eq!(team.with_timing(Timing::Ignored).dead_end(), None);
}

#[test]
fn changes_happen_all_or_not_at_all_and_leave_their_stamp() {
    let mut team = crossing();
    let (before, robots) = (team.stamp(), team.robots().to_vec());
    let far = TeamChange::GoalMoved(0, Point::new(8.0, 8.0));
    let bad = [
        TeamChange::GoalMoved(2, Point::new(8.0, 8.0)),
        TeamChange::GoalMoved(1, Point::new(80.0, 8.0)),
        TeamChange::Removed(0),
        TeamChange::RobotRemoved(7),
        TeamChange::StartMoved(1, robots[0].start),
    ];
    for bad in bad {
        assert!(team.apply(&[far.clone(), bad]).is_err());
        assert_eq!((team.stamp(), team.robots()), (before, &robots[..]));
    }
    team.apply(&[]).unwrap();
    assert_eq!(team.stamp(), before);
    let disc = Circle::new(Point::new(5.0, 5.0), 1.0).unwrap();
    let third = Robot::new(Point::new(1.0, 1.0), Point::new(2.0, 2.0));
    team.apply(&[
        TeamChange::RobotAdded(third),
        TeamChange::RobotRemoved(0),
        TeamChange::Added(disc.into()),
        TeamChange::Moved(0, Vector::new(0.0, 1.0)),
    ])
    .unwrap();
    assert_ne!(team.stamp(), before);
    assert_eq!(team.robots(), [robots[1], third]);
    let straight = TeamPlan::at_top_speed(&team, []);
    let violation = Violation::Collision { at: 0 }
        .of("robot", 0)
        .of("member", 0);
    assert_eq!(team.judge(&only(&straight)), Err(violation));
    assert!(
        team.apply(&[TeamChange::RobotRemoved(0), TeamChange::RobotRemoved(0)])
            .is_err()
    );
}
