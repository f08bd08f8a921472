//! What a shortest path bends around: the discs that obstacles and robot make together.

use crate::{Point, Segment, Shape, ShapeId, Vector, World, cross, shape::turn};
use std::{
    f64::consts::{PI, TAU},
    ops::Range,
};

/// Angles closer than this are one.
pub(super) const SAME_ANGLE: f64 = 1e-9;

/// A disc that a path may bend around: a round obstacle grown by the robot's radius, or the robot's
/// own disc about a convex corner. A point if the robot is one.
#[derive(Clone, Debug)]
pub(super) struct Disc {
    pub(super) centre: Point,
    pub(super) radius: f64,
    /// At a corner: the outer normals of the two sides that meet there, counterclockwise. Only
    /// between them is the disc part of the obstacle's border.
    pub(super) cone: Option<(Vector, Vector)>,
    pub(super) shape: ShapeId,
}

/// Which way round.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Turn {
    /// Counterclockwise: the disc lies on the left.
    Left,
    /// Clockwise.
    Right,
}

impl Turn {
    pub(super) const BOTH: [Self; 2] = [Self::Left, Self::Right];

    pub(super) fn sign(self) -> f64 {
        match self {
            Self::Left => 1.0,
            Self::Right => -1.0,
        }
    }

    /// How far round it is from one unit vector to another, 0 to a whole turn.
    pub(super) fn angle(self, from: Vector, to: Vector) -> f64 {
        let angle = self.sign() * cross(from, to).atan2(from.dot(&to));
        if angle >= 0.0 {
            angle
        } else if angle > -SAME_ANGLE {
            0.0
        } else {
            angle + TAU
        }
    }
}

/// The discs of a shape for a robot of `radius`.
pub(super) fn discs(id: ShapeId, shape: &Shape, radius: f64, into: &mut Vec<Disc>) {
    match shape {
        Shape::Circle(circle) => into.push(Disc {
            centre: circle.centre(),
            radius: circle.radius() + radius,
            cone: None,
            shape: id,
        }),
        Shape::Rectangle(rectangle) => corners(id, &rectangle.corners(), radius, into),
        Shape::Polygon(polygon) => corners(id, polygon.corners(), radius, into),
    }
}

fn corners(id: ShapeId, corners: &[Point], radius: f64, into: &mut Vec<Disc>) {
    let n = corners.len();
    for k in (0..n).filter(|&k| turn(corners, k) > 0.0) {
        let (before, at, after) = (corners[(k + n - 1) % n], corners[k], corners[(k + 1) % n]);
        // The outside of a counterclockwise border is on its right.
        let normal = |along: Vector| Vector::new(along.y, -along.x).normalize();
        into.push(Disc {
            centre: at,
            radius,
            cone: Some((normal(at - before), normal(after - at))),
            shape: id,
        });
    }
}

impl Disc {
    /// A disc of no size that stands for a point, in whose place anything may meet.
    pub(super) fn point(centre: Point) -> Self {
        Self {
            centre,
            radius: 0.0,
            cone: None,
            shape: ShapeId::MAX,
        }
    }

    /// Whether the disc is part of the border in the direction of a unit vector.
    #[inline]
    pub(super) fn faces(&self, normal: Vector) -> bool {
        self.cone.is_none_or(|(from, to)| {
            cross(from, normal) >= -SAME_ANGLE && cross(normal, to) >= -SAME_ANGLE
                // Opposite the cone both products may be small, too.
                && normal.dot(&(from + to)) > 0.0
        })
    }
}

/// The discs of one obstacle, and a circle that holds them all.
#[derive(Clone, Debug)]
pub(super) struct Group {
    pub(super) discs: Range<usize>,
    pub(super) centre: Point,
    pub(super) reach: f64,
}

impl Group {
    /// The group of the last discs of a list.
    pub(super) fn of(discs: &[Disc], range: Range<usize>) -> Option<Self> {
        let first = discs.get(range.start)?.centre;
        let members = &discs[range.clone()];
        let (min, max) = members.iter().fold((first, first), |(min, max), disc| {
            (min.inf(&disc.centre), max.sup(&disc.centre))
        });
        let centre = nalgebra::center(&min, &max);
        let reach = |disc: &Disc| (disc.centre - centre).norm() + disc.radius;
        let reach = members.iter().map(reach).fold(0.0, f64::max);
        Some(Self {
            discs: range,
            centre,
            reach,
        })
    }

    /// Whether some tangent may lead here that leaves `from` going round it one way: a cheap test
    /// that errs on the side of yes.
    #[inline]
    pub(super) fn is_ahead_of(&self, from: &Disc, out: Turn) -> bool {
        let Some((first, last)) = from.cone else {
            return true;
        };
        // Headings are a quarter turn ahead of the normals, so their wedge is the cone, turned.
        let quarter = |v: Vector| Vector::new(-v.y, v.x) * out.sign();
        let (first, last) = (quarter(first), quarter(last));
        let apart = self.centre - from.centre;
        let slack = -(self.reach + from.radius) * (1.0 + 1e-9) - f64::MIN_POSITIVE;
        cross(first, apart) >= slack
            && cross(apart, last) >= slack
            && (first + last).dot(&apart) >= 2.0 * slack
    }
}

/// The straight way from one disc to another that touches both.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tangent {
    pub(super) length: f64,
    /// Unit vectors from the centres to the points of contact.
    pub(super) leaving: Vector,
    pub(super) arriving: Vector,
}

impl Tangent {
    /// The tangent that leaves `from` going round it one way and meets `to` going round it another;
    /// `None` if there is none, or it touches where one of the discs is not the border.
    #[inline]
    pub(super) fn between(from: &Disc, out: Turn, to: &Disc, into: Turn) -> Option<Self> {
        let apart = to.centre - from.centre;
        let square = apart.norm_squared();
        // With u the heading and m its right-hand normal, the contacts lie at out * m and into * m,
        // and the centres are this far apart along m.
        let offset = out.sign() * from.radius - into.sign() * to.radius;
        if offset == 0.0 {
            // The contacts lie square to the way between the centres: most pairs are out of the
            // question at once, without a root.
            let square = Vector::new(apart.y, -apart.x);
            let slack = -SAME_ANGLE * 2.0 * (apart.x.abs() + apart.y.abs());
            let faces = |disc: &Disc, turn: Turn| {
                disc.cone.is_none_or(|(first, last)| {
                    let sign = turn.sign();
                    sign * cross(first, square) >= slack && sign * cross(square, last) >= slack
                })
            };
            if !faces(to, into) || !faces(from, out) {
                return None;
            }
        }
        let mut rest = square - offset * offset;
        if rest < 0.0 {
            // Discs that touch, but for rounding.
            if rest < -1e-9 * square {
                return None;
            }
            rest = 0.0;
        }
        if square <= 0.0 {
            return None;
        }
        let length = rest.sqrt();
        let right = (apart * offset + Vector::new(apart.y, -apart.x) * length) / square;
        let (leaving, arriving) = (right * out.sign(), right * into.sign());
        (from.faces(leaving) && to.faces(arriving)).then_some(Self {
            length,
            leaving,
            arriving,
        })
    }

    /// The way from a point to a point, which may be the same.
    pub(super) fn straight(from: Point, to: Point) -> Self {
        Self {
            length: (to - from).norm(),
            leaving: Vector::zeros(),
            arriving: Vector::zeros(),
        }
    }

    pub(super) fn segment(&self, from: &Disc, to: &Disc) -> Segment {
        Segment::new(
            from.centre + self.leaving * from.radius,
            to.centre + self.arriving * to.radius,
        )
    }
}

/// Where along a disc the robot fits.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Room {
    /// Nowhere.
    None,
    /// All along.
    All,
    /// In these intervals of angles, ascending from -pi; the last may end beyond pi.
    Some(Vec<(f64, f64)>),
}

impl Room {
    /// The room along `disc` for a robot of `radius`.
    pub(super) fn along(disc: &Disc, world: &World, radius: f64) -> Self {
        let free = |p: Point| world.is_free(&Segment::new(p, p), radius);
        if disc.radius <= 0.0 {
            return if free(disc.centre) {
                Self::All
            } else {
                Self::None
            };
        }
        let mut events = Vec::new();
        let reach = Vector::repeat(disc.radius + radius);
        for id in world.within(disc.centre - reach, disc.centre + reach) {
            if let Some(shape) = world.shape(id) {
                let itself =
                    id == disc.shape && !matches!(shape, Shape::Polygon(p) if !p.is_convex());
                if !itself && shape.distance_to_point(disc.centre) < disc.radius + radius {
                    crossings(disc, shape, radius, &mut events);
                }
            }
        }
        let (min, max) = (world.bounds().min(), world.bounds().max());
        for k in 0..2 {
            for limit in [min[k], max[k]] {
                let share = (limit - disc.centre[k]) / disc.radius;
                if share.abs() < 1.0 {
                    let across = (1.0 - share * share).sqrt();
                    for side in [-across, across] {
                        let (x, y) = if k == 0 { (share, side) } else { (side, share) };
                        events.push(y.atan2(x));
                    }
                }
            }
        }
        let at = |angle: f64| disc.centre + Vector::new(angle.cos(), angle.sin()) * disc.radius;
        let angle_of = |v: Vector| v.y.atan2(v.x);
        // Beyond the cone of a corner the disc lies within its own obstacle.
        let middle = disc.cone.map_or(0.0, |(from, to)| angle_of(from + to));
        if events.is_empty() {
            return if free(at(middle)) {
                Self::All
            } else {
                Self::None
            };
        }
        if let Some((from, to)) = disc.cone {
            events.extend([angle_of(from), angle_of(to)]);
        }
        events.sort_by(f64::total_cmp);
        events.push(events[0] + TAU);
        let mut free_arcs: Vec<(f64, f64)> = Vec::new();
        for pair in events.windows(2) {
            if !free(at(f64::midpoint(pair[0], pair[1]))) {
                continue;
            }
            match free_arcs.last_mut() {
                Some(last) if pair[0] - last.1 <= SAME_ANGLE => last.1 = pair[1],
                _ => free_arcs.push((pair[0], pair[1])),
            }
        }
        // The last may go on where the first begins.
        if let [first, .., last] = &mut free_arcs[..]
            && first.0 + TAU - last.1 <= SAME_ANGLE
        {
            last.1 = first.1 + TAU;
            free_arcs.remove(0);
        }
        match free_arcs[..] {
            [] => Self::None,
            [(from, to)] if to - from >= TAU - SAME_ANGLE => Self::All,
            _ => Self::Some(free_arcs),
        }
    }

    /// Whether the robot may stand there.
    pub(super) fn holds(&self, normal: Vector) -> bool {
        match self {
            Self::None => false,
            Self::All => true,
            Self::Some(arcs) => arcs.iter().any(|&arc| place(arc, normal).is_some()),
        }
    }

    /// Whether the robot may go round from one place to another.
    pub(super) fn lets_pass(&self, from: Vector, angle: f64, turn: Turn) -> bool {
        match self {
            Self::None => false,
            Self::All => true,
            Self::Some(arcs) => arcs.iter().any(|&arc| {
                place(arc, from).is_some_and(|at| {
                    let room = match turn {
                        Turn::Left => arc.1 - at,
                        Turn::Right => at - arc.0,
                    };
                    angle <= room + 2.0 * SAME_ANGLE
                })
            }),
        }
    }
}

/// The angle of a unit vector, counted so that it lies in an arc, if it does.
fn place((from, to): (f64, f64), normal: Vector) -> Option<f64> {
    let angle = normal.y.atan2(normal.x);
    // On the border between two counts rounding decides, and either may be the arc's.
    [angle, angle + TAU, angle - TAU]
        .into_iter()
        .find(|&a| from - SAME_ANGLE <= a && a <= to + SAME_ANGLE)
}

/// The angles at which a disc's border crosses that of a shape grown by `radius`.
fn crossings(disc: &Disc, shape: &Shape, radius: f64, events: &mut Vec<f64>) {
    match shape {
        Shape::Circle(circle) => {
            circle_crossings(disc, circle.centre(), circle.radius() + radius, events);
        }
        Shape::Rectangle(rectangle) => border_crossings(disc, &rectangle.corners(), radius, events),
        Shape::Polygon(polygon) => border_crossings(disc, polygon.corners(), radius, events),
    }
}

fn border_crossings(disc: &Disc, corners: &[Point], radius: f64, events: &mut Vec<f64>) {
    let n = corners.len();
    for k in 0..n {
        let (a, b) = (corners[k], corners[(k + 1) % n]);
        circle_crossings(disc, a, radius, events);
        let along = (b - a).normalize();
        let normal = Vector::new(along.y, -along.x);
        // The line of the grown side, from the disc's centre.
        let away = (a - disc.centre).dot(&normal) + radius;
        let rest = disc.radius * disc.radius - away * away;
        if rest >= 0.0 {
            for side in [-rest.sqrt(), rest.sqrt()] {
                let to = normal * away + along * side;
                events.push(to.y.atan2(to.x));
            }
        }
    }
}

fn circle_crossings(disc: &Disc, centre: Point, radius: f64, events: &mut Vec<f64>) {
    let apart = centre - disc.centre;
    let square = apart.norm_squared();
    if square <= 0.0 || radius <= 0.0 {
        return;
    }
    let along = (square + disc.radius * disc.radius - radius * radius) / (2.0 * square.sqrt());
    if along.abs() < disc.radius {
        let (middle, half) = (apart.y.atan2(apart.x), (along / disc.radius).acos());
        for angle in [middle - half, middle + half] {
            events.push((angle + PI).rem_euclid(TAU) - PI);
        }
    }
}
