//! Walking through a world that is not known: what a square window about the robot shows.

use crate::{
    Circle, Point, Polygon, Rectangle, Segment, Shape, Vector, WorldProblem, clip::Clipper,
    shape::bad,
};
use pf_core::{InvalidProblem, Observable, Problem};
use std::cmp::Ordering;

/// A sensor that sees everything in an upright square about the robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    half: f64,
}

impl Window {
    /// A window that reaches `half` to each side, in the world's unit.
    ///
    /// # Errors
    /// [`InvalidProblem`] if that is not a positive number.
    pub fn new(half: f64) -> Result<Self, InvalidProblem> {
        if half > 0.0 && half.is_finite() {
            return Ok(Self { half });
        }
        Err(bad("the window's half size", half, "a positive number"))
    }

    /// How far it reaches to each side.
    #[must_use]
    pub fn half(&self) -> f64 {
        self.half
    }
}

/// What a robot knows that looks through a [`Window`]: where it is, where the goal is, and the
/// part of each obstacle in the window. Of anything else it knows nothing: in worlds that agree
/// within the window observations are equal.
///
/// The window is limited to what the robot can touch without leaving the bounds, that is the
/// bounds grown by its radius.
///
/// An obstacle in the window is given as a shape that is right within the window and means
/// nothing beyond:
/// * A circle as it is (any arc of it tells the whole), unless it covers the window.
/// * A rectangle clipped to the window. Where it reaches the window's border it is drawn out
///   beyond, so that a robot on the border finds itself inside, not at an edge that is not there.
/// * A polygon likewise; of one that falls into parts each is a shape.
/// * What covers the window is the window, drawn out.
///
/// The order says nothing, and there are no ids: what an obstacle is called says how many others
/// there are. What only touches the window from outside is not seen. Where a slanting side meets
/// the window's border is known up to rounding.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Observation {
    here: Point,
    goal: Point,
    radius: f64,
    window: (Point, Point),
    room: (Point, Point),
    shapes: Vec<Shape>,
    /// Corner lists to be used again.
    spare: Spare,
}

/// Lists kept for their room. They are no part of what is seen, so all are equal.
#[derive(Clone, Default)]
struct Spare {
    lists: Vec<Vec<Point>>,
    clipper: Clipper,
}

impl PartialEq for Spare {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl std::fmt::Debug for Spare {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("..")
    }
}

impl Observation {
    /// Where the robot is.
    #[must_use]
    pub fn here(&self) -> Point {
        self.here
    }

    /// Where it wants to be.
    #[must_use]
    pub fn goal(&self) -> Point {
        self.goal
    }

    /// The robot's radius.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// What is seen: lower and upper corner.
    #[must_use]
    pub fn window(&self) -> (Point, Point) {
        self.window
    }

    /// Where the robot's centre may go and touch nothing unseen: the window less its radius, and
    /// within the bounds. Lower and upper corner; the lower one lies above the upper one if the
    /// robot is larger than the window.
    #[must_use]
    pub fn room(&self) -> (Point, Point) {
        self.room
    }

    /// The obstacles in the window; see [`Observation`].
    #[must_use]
    pub fn shapes(&self) -> &[Shape] {
        &self.shapes
    }

    /// Whether the goal is where the robot may go within what it sees.
    #[must_use]
    pub fn shows_goal(&self) -> bool {
        self.has_room_at(self.goal)
    }

    /// Whether a point lies in the [`room`](Self::room).
    #[must_use]
    pub fn has_room_at(&self, p: Point) -> bool {
        (0..2).all(|k| self.room.0[k] <= p[k] && p[k] <= self.room.1[k])
    }

    /// How many obstacles the robot would enter on the way from `a` to `b`, by what it sees.
    #[must_use]
    pub fn entered(&self, a: Point, b: Point) -> usize {
        let way = Segment::new(a, b);
        let entered = |shape: &&Shape| shape.blocks(&way, self.radius);
        self.shapes.iter().filter(entered).count()
    }

    /// Whether the way from `a` to `b` is known to be free: it lies in the [`room`](Self::room)
    /// and no obstacle is entered. The world then lets the robot move so.
    #[must_use]
    pub fn is_free(&self, a: Point, b: Point) -> bool {
        let way = Segment::new(a, b);
        self.has_room_at(a)
            && self.has_room_at(b)
            && !self.shapes.iter().any(|s| s.blocks(&way, self.radius))
    }

    /// How far it is from a point in the window to the first obstacle in a direction, if there is
    /// one within `reach` and within the window. 0 from inside an obstacle. A direction without
    /// length hits nothing.
    #[must_use]
    pub fn ray(&self, from: Point, direction: Vector, reach: f64) -> Option<f64> {
        let unit = direction.try_normalize(0.0)?;
        let ray = Segment::new(from, from + unit * reach);
        let (_, exit) = ray.within_box(self.window.0, self.window.1)?;
        let hits = self.shapes.iter().filter_map(|s| s.first_touch(&ray));
        let first = hits.min_by(f64::total_cmp)?;
        (first <= exit).then_some(first * reach)
    }

    /// The [`ray`](Self::ray)s from a point in the directions of the axes: east, north, west and
    /// south, where north is up.
    #[must_use]
    pub fn axis_rays(&self, from: Point, reach: f64) -> [Option<f64>; 4] {
        let (x, y) = (Vector::x(), Vector::y());
        [x, y, -x, -y].map(|direction| self.ray(from, direction, reach))
    }

    fn clear(&mut self) {
        for shape in self.shapes.drain(..) {
            if let Shape::Polygon(polygon) = shape {
                self.spare.lists.push(polygon.into_corners());
            }
        }
    }

    /// Adds what is in the window of an obstacle; beyond it everything is drawn out by `margin`.
    fn see(&mut self, shape: &Shape, margin: f64) {
        let seen = match shape {
            Shape::Circle(c) => see_circle(c, self.window, margin),
            Shape::Rectangle(r) => see_box(r.min(), r.max(), self.window, margin),
            Shape::Polygon(p) => return self.see_polygon(p, margin),
        };
        self.shapes.extend(seen);
    }

    fn see_polygon(&mut self, polygon: &Polygon, margin: f64) {
        let seen = &mut self.shapes;
        if !self.spare.clipper.clip(polygon.corners(), self.window) {
            seen.extend(see_box(self.window.0, self.window.1, self.window, margin));
            return;
        }
        for part in self.spare.clipper.parts() {
            let mut list = self.spare.lists.pop().unwrap_or_default();
            part.draw_out(margin, &mut list);
            seen.push(Shape::Polygon(Polygon::even_odd(list)));
        }
    }
}

/// A box in a window, drawn out where it reaches the window's border.
fn see_box(low: Point, high: Point, (min, max): (Point, Point), margin: f64) -> Option<Shape> {
    let (mut from, mut to) = (low, high);
    for k in 0..2 {
        if high[k] <= min[k] || max[k] <= low[k] {
            return None;
        }
        if low[k] <= min[k] {
            from[k] = min[k] - margin;
        }
        if high[k] >= max[k] {
            to[k] = max[k] + margin;
        }
    }
    Some(Rectangle::spanning(from, to).into())
}

fn see_circle(circle: &Circle, (min, max): (Point, Point), margin: f64) -> Option<Shape> {
    let (centre, radius) = (circle.centre(), circle.radius());
    if crate::point_to_box(centre, min, max) >= radius {
        return None;
    }
    let far = (max - centre).abs().sup(&(centre - min).abs());
    if far.norm() <= radius {
        return see_box(min, max, (min, max), margin);
    }
    Some((*circle).into())
}

impl Observable for WorldProblem {
    type Sensor = Window;
    type Observation = Observation;

    fn start(&self) -> Point {
        Self::start(self)
    }

    /// As near as the judge wants it.
    fn arrived(&self, at: &Point) -> bool {
        (at - self.goal()).norm() <= crate::TOUCH
    }

    fn admits(&self, from: &Point, to: &Point) -> bool {
        self.is_free(*from, *to)
    }

    fn observe(&self, at: &Point, sensor: &Window, seen: &mut Observation) {
        let (half, radius) = (Vector::repeat(sensor.half), Vector::repeat(self.radius()));
        let bounds = self.world().bounds();
        seen.clear();
        seen.here = *at;
        seen.goal = self.goal();
        seen.radius = self.radius();
        let (low, high) = (at - half, at + half);
        seen.window = (
            low.sup(&(bounds.min() - radius)),
            high.inf(&(bounds.max() + radius)),
        );
        seen.room = (
            (low + radius).sup(&bounds.min()),
            (high - radius).inf(&bounds.max()),
        );
        let (min, max) = seen.window;
        // Out of the reach of a robot in its room.
        let margin = sensor.half + self.radius();
        self.world()
            .each_within(min, max, |shape| seen.see(shape, margin));
        // The tree's order would tell what else is in it.
        seen.shapes.sort_unstable_by(by_place);
    }

    fn trail(&self, visited: Vec<Point>) -> <Self as Problem>::Solution {
        visited
    }
}

/// An order by what is seen and nothing else.
fn by_place(a: &Shape, b: &Shape) -> Ordering {
    let boxes = |shape: &Shape| {
        let (min, max) = shape.bounding_box();
        [min.x, min.y, max.x, max.y]
    };
    let kind = |shape: &Shape| match shape {
        Shape::Circle(_) => 0,
        Shape::Rectangle(_) => 1,
        Shape::Polygon(_) => 2,
    };
    in_order(boxes(a), boxes(b))
        .then_with(|| kind(a).cmp(&kind(b)))
        .then_with(|| in_order(corners(a), corners(b)))
}

/// The coordinates of a polygon's corners, one after the other.
fn corners(shape: &Shape) -> impl Iterator<Item = f64> {
    let corners = match shape {
        Shape::Polygon(p) => p.corners(),
        _ => &[],
    };
    corners.iter().flat_map(|c| [c.x, c.y])
}

fn in_order(a: impl IntoIterator<Item = f64>, b: impl IntoIterator<Item = f64>) -> Ordering {
    let (mut a, mut b) = (a.into_iter(), b.into_iter());
    loop {
        match (a.next(), b.next()) {
            (Some(x), Some(y)) => match x.total_cmp(&y) {
                Ordering::Equal => {}
                differ => return differ,
            },
            (x, y) => return x.is_some().cmp(&y.is_some()),
        }
    }
}
