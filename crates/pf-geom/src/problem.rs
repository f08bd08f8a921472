use crate::{Point, Segment, Shape, ShapeId, TOUCH, Vector, World, shape::bad};
use pf_core::{InvalidProblem, Problem, Stamp, Violation};
use std::sync::Arc;

/// From one point to another among obstacles, for a round robot.
///
/// The world is shared between clones until one of them changes it, so a clone is cheap.
#[derive(Clone, Debug)]
pub struct WorldProblem {
    world: Arc<World>,
    radius: f64,
    start: Point,
    goal: Point,
    stamp: Stamp,
}

/// What may happen in a world.
#[derive(Clone, Debug, PartialEq)]
pub enum WorldChange {
    /// The robot is elsewhere.
    StartMoved(Point),
    /// The target is elsewhere.
    GoalMoved(Point),
    /// A new obstacle; it gets the next id.
    Added(Shape),
    /// An obstacle is gone; its id is never used again.
    Removed(ShapeId),
    /// An obstacle is elsewhere.
    Moved(ShapeId, Vector),
}

impl WorldProblem {
    /// A problem in `world` for a robot of `radius`. A start or goal inside an obstacle is a fair
    /// question with a sad answer.
    ///
    /// # Errors
    /// [`InvalidProblem`] if the radius is negative or not finite, or a point is not finite or
    /// out of bounds.
    pub fn new(
        world: impl Into<Arc<World>>,
        radius: f64,
        start: Point,
        goal: Point,
    ) -> Result<Self, InvalidProblem> {
        let world = world.into();
        if !(radius >= 0.0 && radius.is_finite()) {
            return Err(bad("the robot's radius", radius, "a number from 0"));
        }
        world.check_point("the start", start)?;
        world.check_point("the goal", goal)?;
        Ok(Self {
            world,
            radius,
            start,
            goal,
            stamp: Stamp::fresh(),
        })
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

    /// The robot's radius.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Where from.
    #[must_use]
    pub fn start(&self) -> Point {
        self.start
    }

    /// Where to.
    #[must_use]
    pub fn goal(&self) -> Point {
        self.goal
    }

    /// Whether the robot may move straight from `a` to `b`.
    #[must_use]
    pub fn is_free(&self, a: Point, b: Point) -> bool {
        self.world.is_free(&Segment::new(a, b), self.radius)
    }
}

impl Problem for WorldProblem {
    type State = Point;
    /// A polyline, start and goal included.
    type Solution = Vec<Point>;
    /// Its length, in the world's unit.
    type Cost = f64;
    type Change = WorldChange;

    fn judge(&self, path: &Vec<Point>) -> Result<f64, Violation> {
        let (Some(first), Some(last)) = (path.first(), path.last()) else {
            return Err(Violation::Empty);
        };
        if (first - self.start).norm() > TOUCH || !self.is_free(*first, *first) {
            return Err(Violation::WrongStart);
        }
        if (last - self.goal).norm() > TOUCH {
            return Err(Violation::WrongGoal);
        }
        let mut length = 0.0;
        for (at, pair) in path.windows(2).enumerate() {
            if !self.is_free(pair[0], pair[1]) {
                return Err(Violation::Collision { at });
            }
            length += (pair[1] - pair[0]).norm();
        }
        Ok(length)
    }

    fn apply(&mut self, changes: &[WorldChange]) -> Result<(), InvalidProblem> {
        use WorldChange::{Added, GoalMoved, Moved, Removed, StartMoved};
        // Which ids will be there depends on the changes before; so does what may be moved.
        let mut next = self.world.next_id();
        let mut added: Vec<(ShapeId, Option<Shape>)> = Vec::new();
        for change in changes {
            match change {
                StartMoved(p) => self.world.check_point("the new start", *p)?,
                GoalMoved(p) => self.world.check_point("the new goal", *p)?,
                Added(shape) => {
                    added.push((next, Some(shape.clone())));
                    next += 1;
                }
                Removed(id) | Moved(id, _) => {
                    let known = match added.iter().rfind(|(known, _)| known == id) {
                        Some((_, shape)) => shape.as_ref(),
                        None => self.world.shape(*id),
                    };
                    let known = known.ok_or(InvalidProblem::NoSuchObstacle { id: *id })?;
                    let after = match change {
                        Moved(_, by) => Some(known.translated(*by)?),
                        _ => None,
                    };
                    added.push((*id, after));
                }
            }
        }
        for change in changes {
            match change {
                StartMoved(p) => self.start = *p,
                GoalMoved(p) => self.goal = *p,
                Added(shape) => {
                    Arc::make_mut(&mut self.world).add(shape.clone());
                }
                Removed(id) => Arc::make_mut(&mut self.world).remove(*id)?,
                Moved(id, by) => Arc::make_mut(&mut self.world).translate(*id, *by)?,
            }
        }
        if !changes.is_empty() {
            self.stamp = Stamp::fresh();
        }
        Ok(())
    }

    fn stamp(&self) -> Stamp {
        self.stamp
    }
}
