//! Distances between a segment and simple figures, in closed form.
//!
//! A segment may be a point. Distances are those to the closed figure: 0 if they touch or overlap.

use crate::{Point, Vector};

/// A straight piece of path, or a point if both ends are one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// One end.
    pub a: Point,
    /// The other end.
    pub b: Point,
}

impl Segment {
    /// From `a` to `b`.
    #[must_use]
    pub const fn new(a: Point, b: Point) -> Self {
        Self { a, b }
    }

    /// Its length.
    #[must_use]
    pub fn length(&self) -> f64 {
        (self.b - self.a).norm()
    }

    /// The point at `t` of the way, 0 to 1.
    #[must_use]
    pub fn at(&self, t: f64) -> Point {
        self.a + (self.b - self.a) * t
    }

    /// How much of the way to go to be nearest `p`, 0 to 1.
    #[must_use]
    pub fn nearest(&self, p: Point) -> f64 {
        let along = self.b - self.a;
        let square = along.norm_squared();
        if square > 0.0 {
            ((p - self.a).dot(&along) / square).clamp(0.0, 1.0)
        } else {
            0.0
        }
    }

    /// The distance to a point.
    #[must_use]
    pub fn distance_to_point(&self, p: Point) -> f64 {
        (p - self.at(self.nearest(p))).norm()
    }

    /// The distance to a disc.
    #[must_use]
    pub fn distance_to_disc(&self, centre: Point, radius: f64) -> f64 {
        (self.distance_to_point(centre) - radius).max(0.0)
    }

    /// The distance to another segment.
    #[must_use]
    pub fn distance_to_segment(&self, other: &Self) -> f64 {
        if self.crosses(other) {
            return 0.0;
        }
        let ends = self
            .distance_to_point(other.a)
            .min(self.distance_to_point(other.b));
        let others = other
            .distance_to_point(self.a)
            .min(other.distance_to_point(self.b));
        ends.min(others)
    }

    /// Whether each segment has its ends on both sides of the other, or on it.
    #[must_use]
    pub fn crosses(&self, other: &Self) -> bool {
        // Rounding can put the ends of segments on one line on both sides of each other, however
        // far apart they lie along it.
        let apart = |k: usize| {
            self.a[k].max(self.b[k]) < other.a[k].min(other.b[k])
                || other.a[k].max(other.b[k]) < self.a[k].min(self.b[k])
        };
        if apart(0) || apart(1) {
            return false;
        }
        let side = |s: &Self, p: Point| cross(s.b - s.a, p - s.a);
        let (c, d) = (side(self, other.a), side(self, other.b));
        let (a, b) = (side(other, self.a), side(other, self.b));
        // Both ends on one line say nothing; then the ends' distances decide.
        let parted =
            |x: f64, y: f64| x.min(y) <= 0.0 && x.max(y) >= 0.0 && x.abs().max(y.abs()) > 0.0;
        parted(c, d) && parted(a, b)
    }

    /// The part of the way that lies in an upright box: from and to, 0 to 1.
    #[must_use]
    pub fn within_box(&self, min: Point, max: Point) -> Option<(f64, f64)> {
        let along = self.b - self.a;
        let (mut from, mut to) = (0.0f64, 1.0f64);
        for k in 0..2 {
            let (start, step) = (self.a[k], along[k]);
            if step == 0.0 {
                if start < min[k] || start > max[k] {
                    return None;
                }
                continue;
            }
            // Divided, not multiplied by the inverse, which may be infinite.
            let (low, high) = ((min[k] - start) / step, (max[k] - start) / step);
            from = from.max(low.min(high));
            to = to.min(low.max(high));
        }
        (from <= to).then_some((from, to))
    }

    /// The distance to an upright box.
    #[must_use]
    pub fn distance_to_box(&self, min: Point, max: Point) -> f64 {
        // The box from its middle, the segment in the quarter where it is looked at: beyond a side
        // the nearest point is an end; beyond a corner it may be the corner's foot on the segment.
        if self.within_box(min, max).is_some() {
            return 0.0;
        }
        let ends = point_to_box(self.a, min, max).min(point_to_box(self.b, min, max));
        let along = self.b - self.a;
        // The corner furthest towards the segment on either side of it: two of the four suffice,
        // those on the diagonal across the segment's direction.
        let (p, q) = if (along.x >= 0.0) == (along.y >= 0.0) {
            (Point::new(min.x, max.y), Point::new(max.x, min.y))
        } else {
            (min, max)
        };
        ends.min(self.distance_to_point(p))
            .min(self.distance_to_point(q))
    }
}

/// The distance from a point to an upright box.
#[must_use]
pub fn point_to_box(p: Point, min: Point, max: Point) -> f64 {
    let x = (min.x - p.x).max(p.x - max.x).max(0.0);
    let y = (min.y - p.y).max(p.y - max.y).max(0.0);
    (x * x + y * y).sqrt()
}

/// The third component of the cross product: positive if `b` lies counterclockwise of `a`.
#[inline]
#[must_use]
pub fn cross(a: Vector, b: Vector) -> f64 {
    a.x * b.y - a.y * b.x
}
