//! What a plan costs, and by how much it fails to be one.

use super::{
    DANGER, LENGTH, Objectives, TURNING, TeamPlan, TeamProblem, TimedPoint, Timing,
    meet::closest_below,
};
use crate::{Robot, Segment, TOUCH, cross};
use pf_core::Violation;

/// What a plan is worth to a search: as the judge says if it is one, and how far it is from that.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mark {
    /// What it costs.
    pub objectives: Objectives,
    /// How deep paths enter obstacles, leave the bounds and robots each other, summed, in the
    /// world's unit; exactly 0 if nothing of that happens.
    pub excess: f64,
}

impl TeamProblem {
    /// Marks paths that lead from start to goal in time without asking whether they do, for a
    /// search that makes them so. `path` tells the path of a robot. Allocates nothing.
    ///
    /// Every path has two points at least. The objectives are to the bit those of [`judge_plan`](Self::judge_plan), which refuses the
    /// plan if, and only if, the excess is not 0.
    #[must_use]
    pub fn mark<'a>(&self, path: impl Fn(usize) -> &'a [TimedPoint]) -> Mark {
        let mut mark = Mark::default();
        let mut clearance = self.ease;
        for (number, robot) in self.robots.iter().enumerate() {
            let path = path(number);
            for pair in path.windows(2) {
                let segment = Segment::new(pair[0].at, pair[1].at);
                mark.objectives[LENGTH] += segment.length();
                let near = (self.obstacles).near(&self.world, &segment, robot.radius, clearance);
                clearance = near.clearance;
                mark.excess += near.depth + self.outside(&segment);
            }
            mark.objectives[TURNING] += turning(path);
        }
        for (first, second) in self.pairs() {
            let least = self.least_distance(first, second);
            let found = closest_below(path(first), path(second), least + clearance);
            clearance = clearance.min((found - least).max(0.0));
            if found < least - TOUCH {
                mark.excess += least - found;
            }
        }
        mark.objectives[DANGER] = self.ease - clearance;
        mark
    }

    /// How far a segment leaves the bounds, if it does.
    #[inline]
    fn outside(&self, segment: &Segment) -> f64 {
        let (min, max) = (self.world.bounds().min(), self.world.bounds().max());
        let (low, high) = (segment.a.inf(&segment.b), segment.a.sup(&segment.b));
        let over = |k: usize| (min[k] - low[k]).max(high[k] - max[k]);
        let farthest = over(0).max(over(1));
        if farthest > TOUCH { farthest } else { 0.0 }
    }

    /// Marks a single plan.
    ///
    /// # Errors
    /// The first rule it breaks, with the robot's number.
    pub fn judge_plan(&self, plan: &TeamPlan) -> Result<Objectives, Violation> {
        if plan.paths.len() != self.robots.len() {
            return Err(Violation::WrongNumber {
                what: "paths",
                found: plan.paths.len(),
                expected: self.robots.len(),
            });
        }
        for (number, (robot, path)) in self.robots.iter().zip(&plan.paths).enumerate() {
            let alone = self.judge_path(robot, path);
            alone.map_err(|violation| violation.of("robot", number))?;
        }
        let mark = self.mark(|robot| &plan.paths[robot]);
        if mark.excess > 0.0 {
            return Err(self.fault(plan));
        }
        Ok(mark.objectives)
    }

    /// The first thing in the way of a plan that has an excess.
    fn fault(&self, plan: &TeamPlan) -> Violation {
        for (number, (robot, path)) in self.robots.iter().zip(&plan.paths).enumerate() {
            let collides = |pair: &[TimedPoint]| {
                let segment = Segment::new(pair[0].at, pair[1].at);
                let near = self
                    .obstacles
                    .near(&self.world, &segment, robot.radius, 0.0);
                near.depth + self.outside(&segment) > 0.0
            };
            if let Some(at) = path.windows(2).position(collides) {
                return Violation::Collision { at }.of("robot", number);
            }
        }
        let met = self.meeting(plan).map(|met| (met.first, met.second));
        let (first, second) = met.unwrap_or_default();
        Violation::Meeting { first, second }
    }

    /// Whether a path leads from start to goal, and in its time.
    fn judge_path(&self, robot: &Robot, path: &[TimedPoint]) -> Result<(), Violation> {
        let (Some(first), Some(last)) = (path.first(), path.last()) else {
            return Err(Violation::Empty);
        };
        let begins = (first.at - robot.start).norm() <= TOUCH && first.time.abs() <= TOUCH;
        let here = Segment::new(first.at, first.at);
        if !begins || !self.world.is_free(&here, robot.radius) {
            return Err(Violation::WrongStart);
        }
        if (last.at - robot.goal).norm() > TOUCH || !last.time.is_finite() {
            return Err(Violation::WrongGoal);
        }
        for (at, pair) in path.windows(2).enumerate() {
            let (length, time) = (
                (pair[1].at - pair[0].at).norm(),
                pair[1].time - pair[0].time,
            );
            let most = match self.timing {
                Timing::Exact => robot.speed * time * (1.0 + 1e-9) + TOUCH,
                Timing::Ignored => f64::INFINITY,
            };
            // Written so that what is not a number does not pass.
            if !(time >= 0.0 && length <= most) {
                return Err(Violation::TooFast { at });
            }
        }
        Ok(())
    }
}

/// The sum of a path's absolute turns; where it waits it keeps its direction.
fn turning(path: &[TimedPoint]) -> f64 {
    let mut sum = 0.0;
    let mut before = crate::Vector::zeros();
    for pair in path.windows(2) {
        let along = pair[1].at - pair[0].at;
        if along.x == 0.0 && along.y == 0.0 {
            continue;
        }
        let (across, ahead) = (cross(before, along), before.dot(&along));
        before = along;
        if across != 0.0 || ahead < 0.0 {
            sum += libm::atan2(across.abs(), ahead);
        }
    }
    sum
}
