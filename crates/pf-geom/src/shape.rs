use crate::{Point, Segment, Vector, cross, segment::point_to_box};
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

/// A simple polygon with its inside, its corners counterclockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    corners: Vec<Point>,
    /// The direction of the side that begins at each corner; only asked for if it is convex.
    along: Vec<Vector>,
    convex: bool,
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

impl Polygon {
    /// A polygon by its corners, in either direction.
    ///
    /// # Errors
    /// [`InvalidProblem`] if there are less than three corners, a number is not finite, two
    /// corners are one, the border touches or crosses itself, or there is no inside.
    pub fn new(mut corners: Vec<Point>) -> Result<Self, InvalidProblem> {
        let n = corners.len();
        if n < 3 {
            return Err(bad("the polygon", format!("{n} corners"), "at least 3"));
        }
        for (k, &corner) in corners.iter().enumerate() {
            check_finite(format!("the polygon's corner {k}"), corner)?;
        }
        check_simple(&corners)?;
        let area = twice_area(&corners);
        let scale = corners.iter().map(|c| c.coords.amax()).fold(0.0, f64::max);
        if area.abs() <= 1e-12 * scale * scale {
            return Err(bad(
                "the polygon's area",
                area.abs() / 2.0,
                "more than none",
            ));
        }
        if area < 0.0 {
            corners.reverse();
        }
        let convex = (0..n).all(|k| turn(&corners, k) >= 0.0);
        let along = (0..n).map(|k| (corners[(k + 1) % n] - corners[k]).normalize());
        Ok(Self {
            along: along.collect(),
            corners,
            convex,
        })
    }

    /// A polygon that need not be simple: inside is what its border goes round an odd number of
    /// times.
    pub(crate) const fn even_odd(corners: Vec<Point>) -> Self {
        Self {
            corners,
            along: Vec::new(),
            convex: false,
        }
    }

    /// Its corners, to be used for another.
    pub(crate) fn into_corners(self) -> Vec<Point> {
        self.corners
    }

    /// Its corners, counterclockwise.
    #[must_use]
    pub fn corners(&self) -> &[Point] {
        &self.corners
    }

    /// Whether it is convex.
    #[must_use]
    pub fn is_convex(&self) -> bool {
        self.convex
    }

    /// Its sides, each from a corner to the next.
    pub fn sides(&self) -> impl Iterator<Item = Segment> + '_ {
        let next = self.corners.iter().cycle().skip(1);
        self.corners
            .iter()
            .zip(next)
            .map(|(&a, &b)| Segment::new(a, b))
    }

    /// Whether a point lies in it; on the border either answer may come.
    #[must_use]
    pub fn contains(&self, p: Point) -> bool {
        let mut inside = false;
        for Segment { a, b } in self.sides() {
            if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) {
                inside = !inside;
            }
        }
        inside
    }

    /// Whether part of a segment lies further than `depth` to the inside of all sides' lines. Less
    /// than 0 is outside.
    fn is_within_half_planes(&self, segment: &Segment, depth: f64) -> bool {
        let (mut from, mut to) = (0.0f64, 1.0f64);
        for (on, along) in self.corners.iter().zip(&self.along) {
            let (a, b) = (
                cross(*along, segment.a - on) - depth,
                cross(*along, segment.b - on) - depth,
            );
            if a <= 0.0 && b <= 0.0 {
                return false;
            }
            if a < 0.0 {
                from = from.max(a / (a - b));
            } else if b < 0.0 {
                to = to.min(a / (a - b));
            }
        }
        from < to
    }

    /// Whether a segment comes nearer than `reach`, which is more than 0.
    fn is_near(&self, segment: &Segment, reach: f64) -> bool {
        if self.convex {
            // Few segments come near enough for their distance to matter.
            if !self.is_within_half_planes(segment, -reach) {
                return false;
            }
            if self.is_within_half_planes(segment, 0.0) {
                return true;
            }
        }
        self.contains(segment.a) || self.border_distance(segment) < reach
    }

    fn border_distance(&self, segment: &Segment) -> f64 {
        self.sides()
            .map(|side| side.distance_to_segment(segment))
            .fold(f64::INFINITY, f64::min)
    }

    fn border_distance_to_point(&self, p: Point) -> f64 {
        self.sides()
            .map(|side| side.distance_to_point(p))
            .fold(f64::INFINITY, f64::min)
    }

    /// Whether a segment gets deeper inside than `depth`.
    fn is_entered(&self, segment: &Segment, depth: f64) -> bool {
        if self.convex {
            return self.is_within_half_planes(segment, depth);
        }
        // Between two places where it meets the border a segment is inside or outside; inside, its
        // middle is at least half as deep as its deepest point.
        let mut breaks = vec![0.0, 1.0];
        let along = segment.b - segment.a;
        for side in self.sides() {
            if side.distance_to_segment(segment) <= TOUCH {
                breaks.extend([segment.nearest(side.a), segment.nearest(side.b)]);
                let across = cross(along, side.b - side.a);
                if across != 0.0 {
                    let t = cross(side.a - segment.a, side.b - side.a) / across;
                    breaks.push(t.clamp(0.0, 1.0));
                }
            }
        }
        breaks.sort_by(f64::total_cmp);
        breaks.dedup();
        let ends = [0.0, 1.0];
        let middles = breaks.windows(2).map(|w| f64::midpoint(w[0], w[1]));
        ends.into_iter().chain(middles).any(|t| {
            let p = segment.at(t);
            self.contains(p) && self.border_distance_to_point(p) > depth / 2.0
        })
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
            Self::Polygon(p) => p
                .sides()
                .filter_map(|side| first_crossing(segment, &side))
                .min_by(f64::total_cmp),
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
            Self::Polygon(p) => {
                let first = p.corners[0];
                p.corners
                    .iter()
                    .fold((first, first), |(min, max), c| (min.inf(c), max.sup(c)))
            }
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
                let corners = p.corners.iter().map(|c| c + by).collect();
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

/// How much of the segment's way it is to a side, 0 to 1.
fn first_crossing(segment: &Segment, side: &Segment) -> Option<f64> {
    let (along, edge) = (segment.b - segment.a, side.b - side.a);
    let across = cross(along, edge);
    let apart = side.a - segment.a;
    if across.abs() <= 1e-12 * along.norm() * edge.norm() {
        // Along the same line the nearer corner is met first, and it belongs to another side, too.
        return None;
    }
    let (t, s) = (cross(apart, edge) / across, cross(apart, along) / across);
    // A little more than the side, lest rounding let a ray slip between two sides at their corner,
    // or begin on a side and miss it.
    let within = |x: f64| (-1e-10..=1.0 + 1e-10).contains(&x);
    (within(t) && within(s)).then_some(t.clamp(0.0, 1.0))
}

fn twice_area(corners: &[Point]) -> f64 {
    let origin = corners[0];
    corners
        .windows(2)
        .map(|w| cross(w[0] - origin, w[1] - origin))
        .sum()
}

/// Positive where the border turns left at corner `k`.
pub(crate) fn turn(corners: &[Point], k: usize) -> f64 {
    let n = corners.len();
    let (before, at, after) = (corners[(k + n - 1) % n], corners[k], corners[(k + 1) % n]);
    cross(at - before, after - at)
}

/// No side may touch another but its neighbours, and those only at the common corner.
fn check_simple(corners: &[Point]) -> Result<(), InvalidProblem> {
    let n = corners.len();
    let side = |k: usize| Segment::new(corners[k % n], corners[(k + 1) % n]);
    let refuse = |i: usize, j: usize| {
        let found = format!("touched by its side {j} at its side {i}");
        Err(bad("the polygon's border", found, "a simple one"))
    };
    for i in 0..n {
        let (this, next) = (side(i), side(i + 1));
        if this.length() <= 0.0 {
            let found = format!("its corner {}", (i + 1) % n);
            return Err(bad(format!("the polygon's corner {i}"), found, "another"));
        }
        // A neighbour that turns back on itself.
        let (u, v) = (this.b - this.a, next.b - next.a);
        if cross(u, v) == 0.0 && u.dot(&v) < 0.0 {
            return refuse(i, (i + 1) % n);
        }
    }
    // A sweep from left to right: only sides that share some x are looked at in pairs.
    let mut sides: Vec<_> = (0..n)
        .map(|k| {
            let Segment { a, b } = side(k);
            (k, a.inf(&b), a.sup(&b))
        })
        .collect();
    sides.sort_by(|(_, a, _), (_, b, _)| a.x.total_cmp(&b.x));
    for (at, &(i, low, high)) in sides.iter().enumerate() {
        let near = sides[at + 1..].iter().take_while(|(_, l, _)| l.x <= high.x);
        for &(j, _, _) in near.filter(|(_, l, h)| l.y <= high.y && h.y >= low.y) {
            let neighbours = (i + 1) % n == j || (j + 1) % n == i;
            if !neighbours && side(i).distance_to_segment(&side(j)) <= 0.0 {
                return refuse(i.min(j), i.max(j));
            }
        }
    }
    Ok(())
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
