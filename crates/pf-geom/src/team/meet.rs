//! Collisions in time, exactly.
//!
//! Between two breakpoints of either path both robots move evenly, so one seen from the other moves
//! along a segment; its point nearest to the origin is the closest approach.

use super::{TeamPlan, TeamProblem, TimedPoint};
use crate::{Point, Segment, TOUCH, Vector};

/// When and how two robots come too near to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// One robot.
    pub first: usize,
    /// The other, of a higher number.
    pub second: usize,
    /// When they are nearest, in seconds.
    pub time: f64,
    /// How near their middles are then.
    pub distance: f64,
}

/// How near the middles of two robots come to each other at any time, and when first: distance and
/// time. Before its first point and after its last a robot stays where it is; a path without points
/// is nowhere near.
///
/// Paths are as [`TimedPath`](crate::TimedPath) says, their times ascending.
///
/// ```
/// # use pf_geom::{Point, TimedPoint, closest_approach};
/// let at = |x, y, time| TimedPoint { at: Point::new(x, y), time };
/// let east = [at(0.0, 0.0, 0.0), at(4.0, 0.0, 4.0)];
/// let north = [at(2.0, -3.0, 0.0), at(2.0, 3.0, 6.0)];
/// let (distance, time) = closest_approach(&east, &north);
/// assert!((distance - 0.5f64.sqrt()).abs() < 1e-12 && (time - 2.5).abs() < 1e-12);
/// ```
#[must_use]
pub fn closest_approach(a: &[TimedPoint], b: &[TimedPoint]) -> (f64, f64) {
    let (mut least, mut when) = (f64::INFINITY, 0.0);
    each_interval(a, b, |relative, from, to| {
        let share = relative.nearest(Point::origin());
        let distance = relative.at(share).coords.norm_squared();
        if distance < least {
            (least, when) = (distance, from + (to - from) * share);
        }
    });
    (least.sqrt(), when)
}

/// The closest approach if it is below `limit`, else `limit`.
pub(super) fn closest_below(a: &[TimedPoint], b: &[TimedPoint], limit: f64) -> f64 {
    if apart(a, b) >= limit {
        return limit;
    }
    let mut least = limit * limit;
    each_interval(a, b, |relative, _, _| {
        let (from, along) = (relative.a.coords, relative.b - relative.a);
        let square = along.norm_squared();
        let ahead = -from.dot(&along);
        let near = if ahead <= 0.0 {
            from
        } else if ahead >= square {
            relative.b.coords
        } else {
            from + along * (ahead / square)
        };
        least = least.min(near.norm_squared());
    });
    least.sqrt()
}

/// A distance that the boxes around two paths keep.
fn apart(a: &[TimedPoint], b: &[TimedPoint]) -> f64 {
    let around = |path: &[TimedPoint]| {
        let empty = Point::new(f64::INFINITY, f64::INFINITY);
        let grow = |(min, max): (Point, Point), p: &TimedPoint| (min.inf(&p.at), max.sup(&p.at));
        path.iter().fold((empty, -empty), grow)
    };
    let ((a_min, a_max), (b_min, b_max)) = (around(a), around(b));
    let gap = |k: usize| (b_min[k] - a_max[k]).max(a_min[k] - b_max[k]).max(0.0);
    let (x, y) = (gap(0), gap(1));
    (x * x + y * y).sqrt()
}

/// Shows the way of `a` as `b` sees it, interval by interval: the segment, from when, to when.
#[inline]
fn each_interval(a: &[TimedPoint], b: &[TimedPoint], mut show: impl FnMut(&Segment, f64, f64)) {
    let (Some(first), Some(second)) = (a.first(), b.first()) else {
        return;
    };
    let place = |between: Vector| Point::from(between);
    let (mut i, mut j) = (0, 0);
    let mut time = first.time.min(second.time);
    let mut from = place(first.at - second.at);
    show(&Segment::new(from, from), time, time);
    loop {
        let next = due(a, i).min(due(b, j));
        if next == f64::INFINITY {
            return;
        }
        let to = place(reached(a, i, next) - reached(b, j, next));
        show(&Segment::new(from, to), time, next);
        i += usize::from(due(a, i) <= next);
        j += usize::from(due(b, j) <= next);
        (from, time) = (to, next);
    }
}

/// The time of the breakpoint after `i` others.
#[inline]
fn due(path: &[TimedPoint], i: usize) -> f64 {
    path.get(i + 1).map_or(f64::INFINITY, |p| p.time)
}

/// Where a path is at a time that is not after its next breakpoint.
#[inline]
fn reached(path: &[TimedPoint], i: usize, time: f64) -> Point {
    let Some(to) = path.get(i + 1) else {
        return path[i].at;
    };
    if to.time <= time {
        return to.at;
    }
    let from = path[i];
    let share = ((time - from.time) / (to.time - from.time)).max(0.0);
    from.at + (to.at - from.at) * share
}

impl TeamProblem {
    /// How near two robots may come to each other.
    #[must_use]
    pub fn least_distance(&self, first: usize, second: usize) -> f64 {
        self.robots()[first].radius + self.robots()[second].radius
    }

    /// The first two robots by number that come too near to each other, and when they are nearest;
    /// `None` if no two do, or nobody asks about time.
    #[must_use]
    pub fn meeting(&self, plan: &TeamPlan) -> Option<Meeting> {
        self.pairs().find_map(|(first, second)| {
            let (a, b) = (plan.paths.get(first)?, plan.paths.get(second)?);
            let least = self.least_distance(first, second);
            // As the planners' marks have it, to the bit.
            if closest_below(a, b, least) >= least - TOUCH {
                return None;
            }
            let (distance, time) = closest_approach(a, b);
            Some(Meeting {
                first,
                second,
                time,
                distance,
            })
        })
    }
}
