use super::TeamProblem;
use crate::Point;

/// Where a robot is when.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimedPoint {
    /// Where.
    pub at: Point,
    /// In seconds from the beginning.
    pub time: f64,
}

/// A robot's path in time: from its start, at time 0, to its goal, straight and evenly from point
/// to point. After the last it stays where it is. Waiting is a point twice at two times.
pub type TimedPath = Vec<TimedPoint>;

/// A timed path for each robot, by number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TeamPlan {
    /// The paths.
    pub paths: Vec<TimedPath>,
}

impl TeamPlan {
    /// Every robot from its start through the points given for it to its goal, at its top speed
    /// all the time. Robots for which no points are given go straight.
    #[must_use]
    pub fn at_top_speed(
        problem: &TeamProblem,
        through: impl IntoIterator<Item = Vec<Point>>,
    ) -> Self {
        let mut through = through.into_iter();
        let paths = problem.robots().iter().map(|robot| {
            let mut path = vec![TimedPoint {
                at: robot.start,
                time: 0.0,
            }];
            for at in through
                .next()
                .unwrap_or_default()
                .into_iter()
                .chain([robot.goal])
            {
                drive(&mut path, at, robot.speed);
            }
            path
        });
        Self {
            paths: paths.collect(),
        }
    }

    /// Where the robots are at a time.
    #[must_use]
    pub fn positions(&self, time: f64) -> Vec<Point> {
        self.paths
            .iter()
            .filter_map(|path| position(path, time))
            .collect()
    }

    /// When the last robot has arrived, in seconds.
    #[must_use]
    pub fn duration(&self) -> f64 {
        let ends = self.paths.iter().filter_map(|path| path.last());
        ends.fold(0.0, |latest, end| end.time.max(latest))
    }
}

/// Adds a point to a path, reached at a speed.
fn drive(path: &mut TimedPath, at: Point, speed: f64) {
    if let Some(last) = path.last() {
        let time = last.time + (at - last.at).norm() / speed;
        path.push(TimedPoint { at, time });
    }
}

/// Where a path is at a time; at its ends before and after.
fn position(path: &[TimedPoint], time: f64) -> Option<Point> {
    let next = path.partition_point(|p| p.time <= time);
    if next == 0 {
        return path.first().map(|p| p.at);
    }
    let from = path[next - 1];
    let Some(to) = path.get(next) else {
        return Some(from.at);
    };
    let share = (time - from.time) / (to.time - from.time);
    Some(from.at + (to.at - from.at) * share)
}
