//! The suite of teams.

use super::{TeamRecipe, crossing};
use crate::{
    Case, Options, Plot, Story, Suite, Truth,
    world::{
        Obstacles,
        shapes::{circle, pick, shape},
    },
};
use pf_core::{Front, PlanRng, Problem};
use pf_geom::{
    Objectives, Point, Rectangle, Robot, Segment, Shape, TeamChange, TeamPlan, TeamProblem, Timing,
    Vector, World,
};
use rand::RngExt;
use std::fmt::Write;

/// [`Suite`] of [`TeamProblem`]s.
///
/// Nobody knows the best front of a team. What is known without a planner: there is no plan where
/// starts or goals are blocked or overlap, and there is one where all may go straight at top speed,
/// or one after the other.
#[derive(Clone, Copy, Debug, Default)]
pub struct Teams;

impl Suite for Teams {
    type Problem = TeamProblem;

    fn cases(&self, options: &Options) -> Vec<Case<TeamProblem>> {
        let mut cases = drawn();
        cases.retain(|(_, team)| team.robots().len() as u64 <= options.largest);
        let case = |(name, problem): (&str, TeamProblem)| Case {
            name: name.to_owned(),
            truth: self.truth(&problem),
            problem,
        };
        cases.into_iter().map(case).collect()
    }

    fn random(&self, rng: &mut PlanRng, _: &Options) -> TeamProblem {
        let kinds = [None, Some(Obstacles::Rectangles), Some(Obstacles::Mixed)];
        let recipe = TeamRecipe {
            robots: rng.random_range(1..=4),
            radius: *pick(rng, &[0.0, 0.5, 2.0]),
            obstacles: rng.random_range(0..=8),
            kind: *pick(rng, &kinds),
        };
        crossing(rng.random(), &recipe)
    }

    fn lookalike(&self, rng: &mut PlanRng, problem: &TeamProblem) -> TeamProblem {
        let mut other = problem.clone();
        for _ in 0..3 {
            let batch = team_batch(rng, &other);
            // Batches are made for the problem, so this does not fail.
            let _ = other.apply(&batch);
        }
        other
    }

    fn story(&self, rng: &mut PlanRng, plot: Plot, options: &Options) -> Story<TeamProblem> {
        let batches = match plot {
            Plot::Mixed => 6,
            Plot::Small => 4,
            Plot::Ends => 8,
            // One beyond what counts as young.
            Plot::Long => 52,
        };
        let problem = self.random(rng, options);
        let name = format!("{plot:?} changes, {} robots", problem.robots().len());
        Story::new(name, problem, batches, |now| match plot {
            Plot::Ends => ends_batch(rng, now),
            _ => team_batch(rng, now),
        })
    }

    fn truth(&self, problem: &TeamProblem) -> Truth<Front<Objectives>> {
        if problem.dead_end().is_some() {
            return Truth::Infeasible;
        }
        let straight = TeamPlan::at_top_speed(problem, []);
        let plans = [one_by_one(&straight), straight];
        if plans.iter().any(|plan| problem.judge_plan(plan).is_ok()) {
            Truth::Solvable
        } else {
            Truth::Unknown
        }
    }

    fn draw(&self, problem: &TeamProblem) -> Option<String> {
        let mut text = String::new();
        for (number, robot) in problem.robots().iter().enumerate() {
            // Writing to a string does not fail.
            let _ = writeln!(text, "robot {number}: {robot:?}");
        }
        for (id, shape) in problem.world().shapes() {
            let _ = writeln!(text, "{id}: {shape:?}");
        }
        Some(text)
    }
}

/// The same paths, each robot setting out when the one before has arrived.
pub(crate) fn one_by_one(plan: &TeamPlan) -> TeamPlan {
    let mut late = TeamPlan::default();
    let mut begin = 0.0;
    for path in &plan.paths {
        let mut path = path.clone();
        let first = path[0];
        for p in &mut path {
            p.time += begin;
        }
        begin = path[path.len() - 1].time;
        path.insert(0, first);
        late.paths.push(path);
    }
    late
}

fn square(shapes: Vec<Shape>) -> World {
    let bounds = Rectangle::new(Point::origin(), Point::new(20.0, 20.0)).expect("a square");
    World::with_shapes(bounds, shapes)
}

fn robot(from: (f64, f64), to: (f64, f64)) -> Robot {
    Robot::new(Point::new(from.0, from.1), Point::new(to.0, to.1)).with_radius(1.0)
}

fn team(shapes: Vec<Shape>, robots: Vec<Robot>) -> TeamProblem {
    TeamProblem::new(square(shapes), robots).expect("robots in a square")
}

/// Cases with a point.
fn drawn() -> Vec<(&'static str, TeamProblem)> {
    let (east, north) = (
        robot((2.0, 10.0), (18.0, 10.0)),
        robot((10.0, 2.0), (10.0, 18.0)),
    );
    let disc = || circle(10.0, 10.0, 2.0);
    let at_goal = circle(18.0, 10.0, 0.5);
    let still = Robot {
        goal: east.start,
        ..east
    };
    vec![
        ("alone in the open", team(vec![], vec![east])),
        ("alone, a disc in the way", team(vec![disc()], vec![east])),
        ("one that is there already", team(vec![], vec![still])),
        (
            "two that meet in the middle",
            team(vec![], vec![east, north]),
        ),
        (
            "two that meet, nobody minds",
            team(vec![], vec![east, north]).with_timing(Timing::Ignored),
        ),
        (
            "head on",
            team(vec![], vec![east, robot((18.0, 10.0), (2.0, 10.0))]),
        ),
        ("two and a disc", team(vec![disc()], vec![east, north])),
        ("a blocked goal", team(vec![at_goal], vec![north, east])),
        (
            "goals that overlap",
            team(vec![], vec![east, robot((2.0, 2.0), (17.0, 10.5))]),
        ),
        (
            "starts that overlap",
            team(vec![], vec![east, robot((2.5, 11.0), (17.0, 2.0))]),
        ),
        (
            "one much faster",
            team(vec![disc()], vec![east.with_speed(7.0), north]),
        ),
    ]
}

/// A batch of what may happen to a team: obstacles come, go and move, starts and goals move, robots
/// join and leave; sometimes nothing at all. Starts and goals stay free.
pub fn team_batch(rng: &mut PlanRng, problem: &TeamProblem) -> Vec<TeamChange> {
    batch(rng, problem, |after| after.dead_end().is_none())
}

/// The same, and obstacles fall on starts and goals.
fn ends_batch(rng: &mut PlanRng, problem: &TeamProblem) -> Vec<TeamChange> {
    if rng.random_bool(0.5) {
        let robot = pick(rng, problem.robots());
        let end = *pick(rng, &[robot.start, robot.goal]);
        return vec![TeamChange::Added(circle(end.x, end.y, 1.0))];
    }
    let mut batch = batch(rng, problem, |_| true);
    batch.retain(|change| !matches!(change, TeamChange::RobotAdded(_)));
    batch
}

fn batch(
    rng: &mut PlanRng,
    problem: &TeamProblem,
    wanted: impl Fn(&TeamProblem) -> bool,
) -> Vec<TeamChange> {
    let mut now = problem.clone();
    let mut batch = vec![];
    for _ in 0..*pick(rng, &[0, 1, 1, 2, 3]) {
        let change = any_change(rng, &now);
        let mut after = now.clone();
        if after.apply(std::slice::from_ref(&change)).is_ok() && wanted(&after) {
            batch.push(change);
            now = after;
        }
    }
    batch
}

fn any_change(rng: &mut PlanRng, problem: &TeamProblem) -> TeamChange {
    use TeamChange::{Added, GoalMoved, Moved, Removed, RobotAdded, RobotRemoved, StartMoved};
    let (min, max) = (
        problem.world().bounds().min(),
        problem.world().bounds().max(),
    );
    let mut place = |radius: f64| loop {
        let p = Point::new(
            rng.random_range(min.x..max.x),
            rng.random_range(min.y..max.y),
        );
        if problem.world().is_free(&Segment::new(p, p), radius) {
            return p;
        }
    };
    let (from, to) = (place(1.0), place(1.0));
    let number = rng.random_range(0..problem.robots().len());
    let ids: Vec<_> = problem.world().shapes().map(|(id, _)| id).collect();
    match rng.random_range(0..10) {
        0..2 => GoalMoved(number, to),
        2 => StartMoved(number, from),
        3..5 => Added(shape(rng, to, 2.0)),
        5..7 if !ids.is_empty() => {
            let by = Vector::new(rng.random_range(-5.0..5.0), rng.random_range(-5.0..5.0));
            Moved(*pick(rng, &ids), by)
        }
        7 if !ids.is_empty() => Removed(*pick(rng, &ids)),
        8 if problem.robots().len() > 1 => RobotRemoved(number),
        _ if problem.robots().len() < 4 => RobotAdded(Robot::new(from, to).with_radius(0.5)),
        _ => GoalMoved(number, to),
    }
}
