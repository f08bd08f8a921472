//! Several robots in one world, in time.

mod change;
mod mark;
mod meet;
mod obstacles;
mod plan;

pub use change::TeamChange;
pub use mark::Mark;
pub use meet::{Meeting, closest_approach};
pub use plan::{TeamPlan, TimedPath, TimedPoint};

use crate::{Point, Segment, TOUCH, World, shape::bad};
use obstacles::Obstacles;
use pf_core::{Front, InvalidProblem, Problem, Stamp, Violation};
use std::{fmt, sync::Arc};

/// What a plan costs: [`LENGTH`], [`DANGER`] and [`TURNING`]; less is better.
pub type Objectives = [f64; 3];

/// The place among the [`Objectives`] of the sum of the paths' lengths, in the world's unit.
pub const LENGTH: usize = 0;
/// The place of L - min(clearance, L), where L is [`TeamProblem::ease`] and the clearance the least
/// of all robots to obstacles and, in time, to each other (Wang et al., eq. 9, as it is meant).
pub const DANGER: usize = 1;
/// The place of the sum of the paths' absolute turns, in radians (eq. 10, as it is meant).
pub const TURNING: usize = 2;

/// A round robot and its errand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Robot {
    /// Where from.
    pub start: Point,
    /// Where to.
    pub goal: Point,
    /// In the world's unit; 0 for a point.
    pub radius: f64,
    /// Its top speed, in the world's unit per second.
    pub speed: f64,
}

impl Robot {
    /// A point with a top speed of 1.
    #[must_use]
    pub const fn new(start: Point, goal: Point) -> Self {
        Self {
            start,
            goal,
            radius: 0.0,
            speed: 1.0,
        }
    }

    /// The same with a size.
    #[must_use]
    pub const fn with_radius(mut self, radius: f64) -> Self {
        self.radius = radius;
        self
    }

    /// The same with another top speed.
    #[must_use]
    pub const fn with_speed(mut self, speed: f64) -> Self {
        self.speed = speed;
        self
    }
}

/// Whether robots can be in each other's way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Timing {
    /// They can: no two may be nearer than the sum of their radii at any time.
    #[default]
    Exact,
    /// Paths are judged in space only, each for itself.
    Ignored,
}

/// Paths for several robots among obstacles, and the choices there are.
///
/// A solution is a front: plans none of which dominates another. A plan has a timed path for each
/// robot; see [`TeamPlan`] for what is allowed. Robots have numbers, from 0.
///
/// ```
/// use pf_core::{Front, Problem, Violation};
/// use pf_geom::{LENGTH, Point, Rectangle, Robot, TeamPlan, TeamProblem, World};
///
/// let bounds = Rectangle::new(Point::new(0.0, 0.0), Point::new(10.0, 10.0)).unwrap();
/// let across = Robot::new(Point::new(1.0, 5.0), Point::new(9.0, 5.0)).with_radius(0.5);
/// let along = Robot::new(Point::new(5.0, 1.0), Point::new(5.0, 9.0)).with_radius(0.5);
/// let team = TeamProblem::new(World::new(bounds), vec![across, along]).unwrap();
///
/// // Straight ahead they meet in the middle.
/// let straight = TeamPlan::at_top_speed(&team, [vec![], vec![]]);
/// let front = Front::unchecked(vec![straight.clone()]);
/// let meeting = Violation::Meeting { first: 0, second: 1 };
/// assert_eq!(team.judge(&front), Err(meeting.of("member", 0)));
///
/// // One waits two seconds.
/// let mut waiting = straight;
/// waiting.paths[1].iter_mut().skip(1).for_each(|p| p.time += 2.0);
/// waiting.paths[1].insert(1, pf_geom::TimedPoint { at: along.start, time: 2.0 });
/// let front = Front::unchecked(vec![waiting]);
/// assert_eq!(team.judge(&front).unwrap().members()[0][LENGTH], 16.0);
/// ```
#[derive(Clone, Debug)]
pub struct TeamProblem {
    world: Arc<World>,
    obstacles: Obstacles,
    robots: Vec<Robot>,
    timing: Timing,
    ease: f64,
    stamp: Stamp,
}

/// Why there can be no plan, whatever the paths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DeadEnd {
    /// A robot starts inside an obstacle.
    Start(usize),
    /// A robot's goal is inside an obstacle.
    Goal(usize),
    /// Two robots overlap where they start.
    Starts(usize, usize),
    /// Two robots would overlap at their goals.
    Goals(usize, usize),
}

impl fmt::Display for DeadEnd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Start(robot) => write!(f, "robot {robot} starts inside an obstacle"),
            Self::Goal(robot) => write!(f, "the goal of robot {robot} is inside an obstacle"),
            Self::Starts(a, b) => write!(f, "robots {a} and {b} overlap at their starts"),
            Self::Goals(a, b) => write!(f, "robots {a} and {b} overlap at their goals"),
        }
    }
}

impl TeamProblem {
    /// The clearance from which on nothing is dangerous, where nobody says otherwise: L.
    pub const EASE: f64 = 10.0;

    /// A problem for these robots. A start or goal inside an obstacle, and starts or goals so near
    /// that robots overlap, are fair questions with a sad answer: [`dead_end`](Self::dead_end).
    ///
    /// # Errors
    /// [`InvalidProblem`] with the robot's number if there is none, a radius is negative, a speed
    /// not positive, a point out of bounds or not finite, or two robots have one start or one goal.
    pub fn new(world: impl Into<Arc<World>>, robots: Vec<Robot>) -> Result<Self, InvalidProblem> {
        let world = world.into();
        check(&world, &robots)?;
        Ok(Self {
            obstacles: Obstacles::of(&world),
            world,
            robots,
            timing: Timing::default(),
            ease: Self::EASE,
            stamp: Stamp::fresh(),
        })
    }

    /// The same with another rule about time.
    #[must_use]
    pub fn with_timing(mut self, timing: Timing) -> Self {
        self.timing = timing;
        self.stamp = Stamp::fresh();
        self
    }

    /// The same with another clearance from which on nothing is dangerous, in the world's unit.
    ///
    /// # Errors
    /// [`InvalidProblem`] if it is not a positive number.
    pub fn with_ease(mut self, ease: f64) -> Result<Self, InvalidProblem> {
        if !(ease > 0.0 && ease.is_finite()) {
            let what = "the clearance from which on nothing is dangerous";
            return Err(bad(what, ease, "a positive number"));
        }
        self.ease = ease;
        self.stamp = Stamp::fresh();
        Ok(self)
    }

    /// The obstacles.
    #[must_use]
    pub fn world(&self) -> &World {
        &self.world
    }

    /// The obstacles, to share with another problem.
    #[must_use]
    pub fn shared_world(&self) -> Arc<World> {
        Arc::clone(&self.world)
    }

    /// Who moves.
    #[must_use]
    pub fn robots(&self) -> &[Robot] {
        &self.robots
    }

    /// Whether robots can be in each other's way.
    #[must_use]
    pub fn timing(&self) -> Timing {
        self.timing
    }

    /// The clearance from which on nothing is dangerous: L.
    #[must_use]
    pub fn ease(&self) -> f64 {
        self.ease
    }

    /// Why no plan can be one, as far as starts and goals tell.
    #[must_use]
    pub fn dead_end(&self) -> Option<DeadEnd> {
        let free = |p: Point, radius| self.world.is_free(&Segment::new(p, p), radius);
        for (number, robot) in self.robots.iter().enumerate() {
            if !free(robot.start, robot.radius) {
                return Some(DeadEnd::Start(number));
            }
            if !free(robot.goal, robot.radius) {
                return Some(DeadEnd::Goal(number));
            }
        }
        for (first, second) in self.pairs() {
            let (a, b) = (&self.robots[first], &self.robots[second]);
            let least = a.radius + b.radius - TOUCH;
            if (a.start - b.start).norm() < least {
                return Some(DeadEnd::Starts(first, second));
            }
            if (a.goal - b.goal).norm() < least {
                return Some(DeadEnd::Goals(first, second));
            }
        }
        None
    }

    /// Every two robots that can be in each other's way.
    fn pairs(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let count = match self.timing {
            Timing::Exact => self.robots.len(),
            Timing::Ignored => 0,
        };
        (0..count).flat_map(move |first| (first + 1..count).map(move |second| (first, second)))
    }
}

/// Refuses robots that make no sense.
fn check(world: &World, robots: &[Robot]) -> Result<(), InvalidProblem> {
    if robots.is_empty() {
        return Err(bad("the number of robots", 0, "at least one"));
    }
    for (number, robot) in robots.iter().enumerate() {
        let named = |what: &str| format!("the {what} of robot {number}");
        if !(robot.radius >= 0.0 && robot.radius.is_finite()) {
            return Err(bad(named("radius"), robot.radius, "a number from 0"));
        }
        if !(robot.speed > 0.0 && robot.speed.is_finite()) {
            return Err(bad(named("top speed"), robot.speed, "a positive number"));
        }
        world.check_place(named("start"), robot.start)?;
        world.check_place(named("goal"), robot.goal)?;
        for (other, before) in robots[..number].iter().enumerate() {
            let ends = [
                ("start", before.start, robot.start),
                ("goal", before.goal, robot.goal),
            ];
            for (what, a, b) in ends {
                if (a - b).norm() <= TOUCH {
                    let found = format!("({}, {}), that of robot {other}", b.x, b.y);
                    return Err(bad(named(what), found, "a place of its own"));
                }
            }
        }
    }
    Ok(())
}

impl Problem for TeamProblem {
    /// One position per robot.
    type State = Vec<Point>;
    type Solution = Front<TeamPlan>;
    type Cost = Front<Objectives>;
    type Change = TeamChange;

    /// Every member passes [`judge_plan`](Self::judge_plan), and none dominates another.
    fn judge(&self, front: &Front<TeamPlan>) -> Result<Front<Objectives>, Violation> {
        if front.members().is_empty() {
            return Err(Violation::Empty);
        }
        let mut costs = Vec::with_capacity(front.members().len());
        for (number, plan) in front.members().iter().enumerate() {
            let cost = self.judge_plan(plan);
            costs.push(cost.map_err(|violation| violation.of("member", number))?);
        }
        match dominated(&costs) {
            Some((member, by)) => Err(Violation::Dominated { member, by }),
            None => Ok(Front::unchecked(costs)),
        }
    }

    fn apply(&mut self, changes: &[TeamChange]) -> Result<(), InvalidProblem> {
        if changes.is_empty() {
            return Ok(());
        }
        let mut next = self.clone();
        for change in changes {
            next.happen(change)?;
        }
        next.obstacles = Obstacles::of(&next.world);
        next.stamp = Stamp::fresh();
        *self = next;
        Ok(())
    }

    fn stamp(&self) -> Stamp {
        self.stamp
    }
}

/// A member that another one dominates, and which.
fn dominated(costs: &[Objectives]) -> Option<(usize, usize)> {
    use pf_core::Cost;
    costs.iter().enumerate().find_map(|(member, cost)| {
        let by = costs.iter().position(|other| other.beats(cost))?;
        Some((member, by))
    })
}
