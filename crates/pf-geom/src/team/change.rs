use super::{Robot, TeamProblem, check};
use crate::{Point, Shape, ShapeId, Vector};
use pf_core::InvalidProblem;
use std::sync::Arc;

/// What may happen to a team and its world. Robots by number, from 0.
#[derive(Clone, Debug, PartialEq)]
pub enum TeamChange {
    /// A robot is elsewhere.
    StartMoved(usize, Point),
    /// A robot's target is elsewhere.
    GoalMoved(usize, Point),
    /// A new obstacle; it gets the next id.
    Added(Shape),
    /// An obstacle is gone; its id is never used again.
    Removed(ShapeId),
    /// An obstacle is elsewhere.
    Moved(ShapeId, Vector),
    /// A new robot; it gets the next number.
    RobotAdded(Robot),
    /// A robot is gone; those after it move up by one.
    RobotRemoved(usize),
}

impl TeamProblem {
    /// Lets one change happen; the obstacles' boxes are the caller's business.
    pub(super) fn happen(&mut self, change: &TeamChange) -> Result<(), InvalidProblem> {
        use TeamChange::{Added, GoalMoved, Moved, Removed, RobotAdded, RobotRemoved, StartMoved};
        match change {
            StartMoved(robot, to) => self.robot(*robot)?.start = *to,
            GoalMoved(robot, to) => self.robot(*robot)?.goal = *to,
            Added(shape) => {
                Arc::make_mut(&mut self.world).add(shape.clone());
            }
            Removed(id) => {
                self.world.known(*id)?;
                Arc::make_mut(&mut self.world).remove(*id)?;
            }
            Moved(id, by) => {
                self.world.known(*id)?;
                Arc::make_mut(&mut self.world).translate(*id, *by)?;
            }
            RobotAdded(robot) => self.robots.push(*robot),
            RobotRemoved(robot) => {
                self.robot(*robot)?;
                self.robots.remove(*robot);
            }
        }
        check(&self.world, &self.robots)
    }

    fn robot(&mut self, number: usize) -> Result<&mut Robot, InvalidProblem> {
        let count = self.robots.len();
        self.robots
            .get_mut(number)
            .ok_or_else(|| InvalidProblem::BadValue {
                what: "the number of a robot".into(),
                found: number.to_string(),
                expected: format!("one from 0 to {}", count - 1).into(),
            })
    }
}
