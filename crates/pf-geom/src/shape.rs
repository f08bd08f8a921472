mod polygon;

pub use polygon::Polygon;

pub(crate) use polygon::turn;

use crate::{Point, Segment, Vector, segment::point_to_box};
use pf_core::InvalidProblem;
use std::fmt::Display;

/// How far a path may enter an obstacle and still count as touching it, in the world's unit.
pub const TOUCH: f64 = 1e-9;

/// An obstacle.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Everything within a radius of a point.
    Circle(Circle),
    /// An upright rectangle.
    Rectangle(Rectangle),
    /// A simple polygon, convex or not.
    Polygon(Polygon),
}

/// A circle with its inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circle {
    centre: Point,
    radius: f64,
}

/// An upright rectangle with its inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    min: Point,
    max: Point,
    peak: Option<Point>,
}

impl Circle {
    /// A circle.
    ///
    /// # Errors
    /// [`InvalidProblem`] if a number is not finite or the radius is not positive.
    pub fn new(centre: Point, radius: f64) -> Result<Self, InvalidProblem> {
        check_finite("the circle's centre", centre)?;
        if !(radius > 0.0 && radius.is_finite()) {
            return Err(bad("the circle's radius", radius, "a positive number"));
        }
        Ok(Self { centre, radius })
    }

    /// Its centre.
    #[must_use]
    pub fn centre(&self) -> Point {
        self.centre
    }

    /// Its radius.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }
}

impl Rectangle {
    /// The rectangle between two opposite corners, lower left and upper right.
    ///
    /// # Errors
    /// [`InvalidProblem`] if a number is not finite or a side is not positive.
    pub fn new(min: Point, max: Point) -> Result<Self, InvalidProblem> {
        check_finite("the rectangle's lower corner", min)?;
        check_finite("the rectangle's upper corner", max)?;
        for (k, side) in ["width", "height"].into_iter().enumerate() {
            let length = max[k] - min[k];
            if !(length > 0.0 && length.is_finite()) {
                let what = format!("the rectangle's {side}");
                return Err(bad(what, length, "a positive number"));
            }
        }
        Ok(Self {
            min,
            max,
            peak: None,
        })
    }

    /// The rectangle between two corners known to be good ones.
    pub(crate) const fn spanning(min: Point, max: Point) -> Self {
        Self {
            min,
            max,
            peak: None,
        }
    }

    /// The same, with the point where its potential is highest, for planners that have one.
    ///
    /// # Errors
    /// [`InvalidProblem`] if the peak lies outside; on the border it may lie.
    pub fn with_peak(mut self, peak: Point) -> Result<Self, InvalidProblem> {
        if !self.contains(peak) {
            let place = format!("({}, {})", peak.x, peak.y);
            return Err(bad("the rectangle's peak", place, "a point in it"));
        }
        self.peak = Some(peak);
        Ok(self)
    }

    /// Its lower left corner.
    #[must_use]
    pub fn min(&self) -> Point {
        self.min
    }

    /// Its upper right corner.
    #[must_use]
    pub fn max(&self) -> Point {
        self.max
    }

    /// Where its potential is highest; the middle if nothing else was said.
    #[must_use]
    pub fn peak(&self) -> Point {
        self.peak
            .unwrap_or_else(|| nalgebra::center(&self.min, &self.max))
    }

    /// Where its potential is highest, if that was said.
    #[must_use]
    pub fn own_peak(&self) -> Option<Point> {
        self.peak
    }

    /// Its corners, counterclockwise from the lower left.
    #[must_use]
    pub fn corners(&self) -> [Point; 4] {
        let (min, max) = (self.min, self.max);
        [min, Point::new(max.x, min.y), max, Point::new(min.x, max.y)]
    }

    /// Whether a point lies in it or on its border.
    #[must_use]
    pub fn contains(&self, p: Point) -> bool {
        (0..2).all(|k| self.min[k] <= p[k] && p[k] <= self.max[k])
    }
}

impl Shape {
    /// The distance from a segment to the shape: 0 if they touch or overlap.
    #[must_use]
    pub fn distance(&self, segment: &Segment) -> f64 {
        match self {
            Self::Circle(c) => segment.distance_to_disc(c.centre, c.radius),
            Self::Rectangle(r) => segment.distance_to_box(r.min, r.max),
            Self::Polygon(p) if p.contains(segment.a) => 0.0,
            Self::Polygon(p) => p.border_distance(segment),
        }
    }

    /// The distance from a point to the shape: 0 if it lies on it or in it.
    #[must_use]
    pub fn distance_to_point(&self, p: Point) -> f64 {
        match self {
            Self::Circle(c) => ((p - c.centre).norm() - c.radius).max(0.0),
            Self::Rectangle(r) => point_to_box(p, r.min, r.max),
            Self::Polygon(polygon) if polygon.contains(p) => 0.0,
            Self::Polygon(polygon) => polygon.border_distance_to_point(p),
        }
    }

    /// Whether the centre of a disc of `radius` that moves along `segment` makes the disc enter
    /// the shape by more than [`TOUCH`].
    #[must_use]
    pub fn blocks(&self, segment: &Segment, radius: f64) -> bool {
        let depth = TOUCH - radius;
        match self {
            Self::Circle(c) => segment.distance_to_point(c.centre) < c.radius - depth,
            Self::Rectangle(r) if depth < 0.0 => segment.distance_to_box(r.min, r.max) < -depth,
            Self::Polygon(p) if depth < 0.0 => p.is_near(segment, -depth),
            Self::Rectangle(r) => {
                let inset = Vector::repeat(depth);
                segment.within_box(r.min + inset, r.max - inset).is_some()
            }
            Self::Polygon(p) => p.is_entered(segment, depth),
        }
    }

    /// How much of a segment's way it is to the shape, 0 to 1, if it gets there.
    #[must_use]
    pub fn first_touch(&self, segment: &Segment) -> Option<f64> {
        if self.distance_to_point(segment.a) <= 0.0 {
            return Some(0.0);
        }
        match self {
            Self::Circle(c) => {
                let (along, from) = (segment.b - segment.a, segment.a - c.centre);
                let (a, b) = (along.norm_squared(), from.dot(&along));
                let rest = b * b - a * (from.norm_squared() - c.radius * c.radius);
                if a <= 0.0 || rest < 0.0 {
                    return None;
                }
                let t = (-b - rest.sqrt()) / a;
                (0.0..=1.0).contains(&t).then_some(t)
            }
            Self::Rectangle(r) => segment.within_box(r.min, r.max).map(|(from, _)| from),
            Self::Polygon(p) => p.first_touch(segment),
        }
    }

    /// The smallest upright box around it: lower left and upper right corner.
    #[must_use]
    pub fn bounding_box(&self) -> (Point, Point) {
        match self {
            Self::Circle(c) => {
                let reach = Vector::repeat(c.radius);
                (c.centre - reach, c.centre + reach)
            }
            Self::Rectangle(r) => (r.min, r.max),
            Self::Polygon(p) => p.bounding_box(),
        }
    }

    /// The same shape elsewhere.
    ///
    /// # Errors
    /// [`InvalidProblem`] if a number is not finite.
    pub fn translated(&self, by: Vector) -> Result<Self, InvalidProblem> {
        Ok(match self {
            Self::Circle(c) => Self::Circle(Circle::new(c.centre + by, c.radius)?),
            Self::Rectangle(r) => {
                let moved = Rectangle::new(r.min + by, r.max + by)?;
                Self::Rectangle(match r.peak {
                    Some(peak) => moved.with_peak(peak + by)?,
                    None => moved,
                })
            }
            Self::Polygon(p) => {
                let corners = p.corners().iter().map(|c| c + by).collect();
                Self::Polygon(Polygon::new(corners)?)
            }
        })
    }
}

impl From<Circle> for Shape {
    fn from(circle: Circle) -> Self {
        Self::Circle(circle)
    }
}

impl From<Rectangle> for Shape {
    fn from(rectangle: Rectangle) -> Self {
        Self::Rectangle(rectangle)
    }
}

impl From<Polygon> for Shape {
    fn from(polygon: Polygon) -> Self {
        Self::Polygon(polygon)
    }
}

pub(crate) fn check_finite(
    what: impl Into<std::borrow::Cow<'static, str>>,
    p: Point,
) -> Result<(), InvalidProblem> {
    if p.coords.iter().all(|v| v.is_finite()) {
        return Ok(());
    }
    let found = format!("({}, {})", p.x, p.y);
    Err(bad(what, found, "two finite numbers"))
}

pub(crate) fn bad(
    what: impl Into<std::borrow::Cow<'static, str>>,
    found: impl Display,
    expected: &'static str,
) -> InvalidProblem {
    InvalidProblem::BadValue {
        what: what.into(),
        found: found.to_string(),
        expected: expected.into(),
    }
}
