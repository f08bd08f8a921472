//! A plan without conflicts: one robot after the other, each around those before it in time.
//!
//! Prioritised planning (Erdmann and Lozano-Perez 1987) with safe intervals (Phillips and Likhachev
//! 2011) on a lattice; robots may wait. Where the exact shortest path is free in time, it is taken.
//! If a robot finds no way, it goes first in the next attempt; if one does not even then, the others
//! give it time to get out of their way. It is not complete: an order of robots
//! may not work, a gap may be narrower than the lattice; what it proves is that a robot has no path
//! even alone.

mod intervals;
mod lattice;
mod search;
mod smooth;

use crate::params::PrioritisedParams;
use intervals::Traffic;
use lattice::Lattice;
use pf_core::{
    Claims, Context, Front, InvalidParams, Outcome, Planner, Proof, Report, Unsupported,
};
use pf_geom::{
    Answer, Point, TangentGraph, TeamPlan, TeamProblem, TimedPath, TimedPoint, Timing, WorldProblem,
};
use search::Search;

/// What notes call it.
pub(crate) const NAME: &str = "prioritised planning with safe intervals";

/// What the baseline came to.
#[derive(Debug)]
pub(crate) enum Verdict {
    /// A plan.
    Plan(TeamPlan),
    /// A robot has no path even alone.
    Nothing(usize),
    /// No order of the robots worked, or the budget ended it.
    Failed,
}

type Cx<'a> = Context<'a, TeamProblem>;

/// Prioritised planning with safe intervals as a planner of its own: one plan, without conflicts,
/// fast for many robots. One iteration plans one robot.
#[derive(Clone, Debug, Default)]
pub struct Prioritised {
    params: PrioritisedParams,
}

impl Prioritised {
    /// A planner that plans as `params` say.
    ///
    /// # Errors
    /// [`InvalidParams`] with the name, the value and what would fit.
    pub fn new(params: PrioritisedParams) -> Result<Self, InvalidParams> {
        params.check()?;
        Ok(Self { params })
    }
}

impl Planner<TeamProblem> for Prioritised {
    fn name(&self) -> &'static str {
        "prioritised planning"
    }

    fn claims(&self) -> Claims {
        Claims::NONE.anytime().deterministic()
    }

    fn plan(
        &mut self,
        problem: &TeamProblem,
        cx: &mut Cx<'_>,
    ) -> Result<Report<TeamProblem>, Unsupported> {
        if !cx.proceed() {
            return Ok(cx.report(Outcome::Unknown { attempt: None }));
        }
        if let Some(dead_end) = problem.dead_end() {
            cx.note("dead end", dead_end.to_string());
            return Ok(cx.report(Outcome::Infeasible));
        }
        Ok(match plan(problem, &self.params, cx) {
            Verdict::Plan(plan) => {
                cx.candidate(|| Front::unchecked(vec![plan.clone()]));
                cx.answer(problem, Front::unchecked(vec![plan]), Proof::None)
            }
            Verdict::Nothing(robot) => {
                cx.note(
                    "dead end",
                    format_args!("robot {robot} has no path even alone"),
                );
                cx.report(Outcome::Infeasible)
            }
            Verdict::Failed => cx.report(Outcome::Unknown { attempt: None }),
        })
    }
}

/// Plans one robot after the other, the one with the longest way first.
pub(crate) fn plan(problem: &TeamProblem, params: &PrioritisedParams, cx: &mut Cx<'_>) -> Verdict {
    let routes = match routes(problem, cx) {
        Ok(routes) => routes,
        Err(verdict) => return verdict,
    };
    let robots = problem.robots();
    let takes =
        |robot: usize| (robots[robot].goal - robots[robot].start).norm() / robots[robot].speed;
    let mut turns: Vec<Turn> = (0..robots.len())
        .map(|robot| Turn { robot, begin: 0.0 })
        .collect();
    turns.sort_by(|a, b| takes(b.robot).total_cmp(&takes(a.robot)));
    let grace = turns.first().map_or(0.0, |turn| takes(turn.robot) / 4.0);
    let mut lattices = lattice::Lattices::new(params.cells);
    for attempts in 1..=params.attempts {
        let stuck = match attempt(problem, &turns, &routes, &mut lattices, cx) {
            Ok(plan) => return Verdict::Plan(plan),
            Err(Some(stuck)) => stuck,
            Err(None) => return Verdict::Failed,
        };
        let Some(place) = turns.iter().position(|turn| turn.robot == stuck) else {
            return Verdict::Failed;
        };
        let turn = turns.remove(place);
        if attempts % 2 == 1 {
            turns.insert(0, turn);
        } else {
            for turn in &mut turns {
                turn.begin += grace;
            }
            turns.push(turn);
        }
    }
    Verdict::Failed
}

/// Whose turn it is to be planned, and when it may set out.
#[derive(Clone, Copy, Debug)]
struct Turn {
    robot: usize,
    begin: f64,
}

/// The shortest path of each robot, were it alone.
fn routes(problem: &TeamProblem, cx: &mut Cx<'_>) -> Result<Vec<Vec<Point>>, Verdict> {
    /// How much longer a polyline may be than the arcs it stands for.
    const EXCESS: f64 = 1e-3;
    let mut graph = TangentGraph::default();
    let mut routes = Vec::new();
    for (number, robot) in problem.robots().iter().enumerate() {
        let world = problem.shared_world();
        let Ok(alone) = WorldProblem::new(world, robot.radius, robot.start, robot.goal) else {
            return Err(Verdict::Failed);
        };
        match cx.child(|cx| graph.shortest(&alone, cx)) {
            Answer::Route(route) => routes.push(route.flattened(EXCESS)),
            Answer::Nothing => return Err(Verdict::Nothing(number)),
            Answer::Cut => return Err(Verdict::Failed),
        }
    }
    Ok(routes)
}

/// One order of the robots; who got stuck, if it does not work and the budget goes on.
fn attempt(
    problem: &TeamProblem,
    turns: &[Turn],
    routes: &[Vec<Point>],
    lattices: &mut lattice::Lattices,
    cx: &mut Cx<'_>,
) -> Result<TeamPlan, Option<usize>> {
    let mut paths: Vec<TimedPath> = vec![Vec::new(); routes.len()];
    let mut done: Vec<usize> = Vec::new();
    for &Turn { robot, begin } in turns {
        if !cx.proceed() {
            return Err(None);
        }
        let mut traffic = Traffic::default();
        if problem.timing() == Timing::Exact {
            for &other in &done {
                traffic.add(&paths[other], problem.least_distance(robot, other));
            }
        }
        let lattice = lattices.of(problem, problem.robots()[robot].radius);
        let path = path(problem, robot, begin, &routes[robot], lattice, &traffic);
        paths[robot] = path.ok_or(Some(robot))?;
        cx.visited(1);
        done.push(robot);
    }
    Ok(TeamPlan { paths })
}

/// A path around the traffic: along the shortest route at once, or over the lattice, or along the
/// route after a while.
fn path(
    problem: &TeamProblem,
    robot: usize,
    begin: f64,
    route: &[Point],
    lattice: &Lattice,
    traffic: &Traffic,
) -> Option<TimedPath> {
    let speed = problem.robots()[robot].speed;
    let is_free = |path: &TimedPath| {
        let mut pairs = path.windows(2);
        pairs.all(|pair| traffic.is_clear(&pair[0], &pair[1])) && traffic.lets_rest(path)
    };
    let at_once = along(route, speed, begin);
    if is_free(&at_once) && passes(problem, robot, &at_once) {
        return Some(at_once);
    }
    if let Some(path) = Search::new(problem, robot, lattice, traffic).path(begin) {
        let path = smooth::smoothed(problem, robot, &path, traffic);
        if passes(problem, robot, &path) {
            return Some(path);
        }
    }
    let (wait, latest) = (at_once.last()?.time / 20.0, traffic.settled());
    let mut delay = begin + wait;
    while delay < latest + wait && wait > 0.0 {
        let later = along(route, speed, delay);
        if is_free(&later) && passes(problem, robot, &later) {
            return Some(later);
        }
        delay += wait;
    }
    None
}

/// Whether the judge has nothing against a path were the robot alone.
fn passes(problem: &TeamProblem, robot: usize, path: &TimedPath) -> bool {
    let robot = problem.robots()[robot];
    path.windows(2).all(|pair| {
        let segment = pf_geom::Segment::new(pair[0].at, pair[1].at);
        problem.world().is_free(&segment, robot.radius)
    })
}

/// A polyline at a speed, after waiting at its start.
fn along(route: &[Point], speed: f64, delay: f64) -> TimedPath {
    let mut time = 0.0;
    let mut path: TimedPath = Vec::with_capacity(route.len() + 1);
    for &at in route {
        if let Some(last) = path.last() {
            time += (at - last.at).norm() / speed;
        }
        path.push(TimedPoint { at, time });
        if path.len() == 1 && delay > 0.0 {
            time = delay;
            path.push(TimedPoint { at, time });
        }
    }
    path
}
