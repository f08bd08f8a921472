//! Whether a robot may go along an arc, by the arc's distances to the obstacles.

use pf_geom::{Point, Rectangle, Segment, Shape, TOUCH, Vector, World, cross};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Part of a circle's border, counterclockwise, at most a whole turn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arc {
    pub(super) centre: Point,
    pub(super) radius: f64,
    /// The angle at which it begins.
    pub(super) from: f64,
    /// How far it goes, from 0.
    pub(super) sweep: f64,
}

/// The point of a circle in the direction of an angle.
pub(super) fn on_circle(centre: Point, radius: f64, angle: f64) -> Point {
    centre + Vector::new(angle.cos(), angle.sin()) * radius
}

fn angle_of(v: Vector) -> f64 {
    v.y.atan2(v.x)
}

impl Arc {
    fn at(&self, angle: f64) -> Point {
        on_circle(self.centre, self.radius, angle)
    }

    fn ends(&self) -> [Point; 2] {
        [self.at(self.from), self.at(self.from + self.sweep)]
    }

    fn covers(&self, angle: f64) -> bool {
        (angle - self.from).rem_euclid(TAU) <= self.sweep
    }

    fn distance_to_point(&self, p: Point) -> f64 {
        let away = p - self.centre;
        if self.covers(angle_of(away)) {
            return (away.norm() - self.radius).abs();
        }
        let [a, b] = self.ends();
        (p - a).norm().min((p - b).norm())
    }

    /// The angles at which it meets a segment.
    fn meets(&self, side: &Segment) -> impl Iterator<Item = f64> {
        let along = side.b - side.a;
        let length = along.norm();
        let (along, from) = (along / length, side.a - self.centre);
        let middle = -from.dot(&along);
        let half = self.radius * self.radius - cross(along, from).powi(2);
        let half = (half >= 0.0).then_some(half.max(0.0).sqrt());
        let places = half.map(|half| [middle - half, middle + half]);
        let places = places.into_iter().flatten();
        let on_side = places.filter(move |place| (0.0..=length).contains(place));
        let arc = *self;
        on_side
            .map(move |place| angle_of(from + along * place))
            .filter(move |&angle| arc.covers(angle))
    }

    fn distance_to_side(&self, side: &Segment) -> f64 {
        if self.meets(side).next().is_some() {
            return 0.0;
        }
        // Nearest are ends, or places that face each other squarely.
        let [a, b] = self.ends();
        let ends = [
            side.distance_to_point(a),
            side.distance_to_point(b),
            self.distance_to_point(side.a),
            self.distance_to_point(side.b),
        ];
        let normal = angle_of(side.b - side.a) + FRAC_PI_2;
        let square = [normal, normal + FRAC_PI_2 * 2.0]
            .into_iter()
            .filter(|&angle| self.covers(angle))
            .map(|angle| side.distance_to_point(self.at(angle)));
        ends.into_iter().chain(square).fold(f64::INFINITY, f64::min)
    }

    /// Whether it gets further than [`TOUCH`] into a shape grown by `reach`.
    fn enters(&self, shape: &Shape, reach: f64) -> bool {
        let sides = match shape {
            Shape::Circle(c) => {
                return self.distance_to_point(c.centre()) < c.radius() + reach - TOUCH;
            }
            Shape::Rectangle(r) => sides(&r.corners()),
            Shape::Polygon(p) => sides(p.corners()),
        };
        if reach > TOUCH {
            let near = |side| self.distance_to_side(side) < reach - TOUCH;
            return winds_around(&sides, self.at(self.from)) || sides.iter().any(near);
        }
        // Between two places where it meets the border it is inside or outside.
        let mut cuts: Vec<_> = sides.iter().flat_map(|side| self.meets(side)).collect();
        for cut in &mut cuts {
            *cut = (*cut - self.from).rem_euclid(TAU);
        }
        cuts.extend([0.0, self.sweep]);
        cuts.sort_by(f64::total_cmp);
        let middles = cuts.windows(2).map(|w| f64::midpoint(w[0], w[1]));
        cuts.iter().copied().chain(middles).any(|along| {
            let p = self.at(self.from + along);
            let deep = sides
                .iter()
                .all(|side| side.distance_to_point(p) > TOUCH / 2.0);
            deep && winds_around(&sides, p)
        })
    }

    fn stays_within(&self, bounds: &Rectangle) -> bool {
        let (min, max) = (bounds.min(), bounds.max());
        let outermost = (0..4)
            .map(|k| f64::from(k) * FRAC_PI_2)
            .filter(|&angle| self.covers(angle))
            .map(|angle| self.at(angle));
        outermost
            .chain(self.ends())
            .all(|p| (0..2).all(|k| min[k] - TOUCH <= p[k] && p[k] <= max[k] + TOUCH))
    }

    /// Whether a robot of `radius` may go along it.
    pub(super) fn is_free(&self, world: &World, radius: f64) -> bool {
        let reach = Vector::repeat(self.radius + radius);
        let near = world.within(self.centre - reach, self.centre + reach);
        let mut near = near.into_iter().filter_map(|id| world.shape(id));
        self.stays_within(world.bounds()) && !near.any(|shape| self.enters(shape, radius))
    }
}

fn sides(corners: &[Point]) -> Vec<Segment> {
    let next = corners.iter().cycle().skip(1);
    let pairs = corners.iter().zip(next);
    pairs.map(|(&a, &b)| Segment::new(a, b)).collect()
}

/// Whether a border goes round a point.
fn winds_around(sides: &[Segment], p: Point) -> bool {
    let seen = |side: &Segment| {
        let (a, b) = (side.a - p, side.b - p);
        cross(a, b).atan2(a.dot(&b))
    };
    sides.iter().map(seen).sum::<f64>().abs() > TAU / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seeded;
    use rand::RngExt;

    /// Beside ten thousand points of the arc.
    #[test]
    fn distances_are_those_of_the_nearest_points() {
        let mut rng = seeded(3);
        for _ in 0..200 {
            let mut point = || Point::new(rng.random_range(-3.0..3.0), rng.random_range(-3.0..3.0));
            let (centre, side) = (point(), Segment::new(point(), point()));
            let arc = Arc {
                centre,
                radius: rng.random_range(0.1..2.0),
                from: rng.random_range(-4.0..4.0),
                sweep: rng.random_range(0.0..TAU),
            };
            let points = || (0..=10_000).map(|k| arc.at(arc.from + arc.sweep * f64::from(k) / 1e4));
            let to_side = points()
                .map(|p| side.distance_to_point(p))
                .fold(9.0, f64::min);
            let to_point = points().map(|p| (p - side.a).norm()).fold(9.0, f64::min);
            assert!((arc.distance_to_side(&side) - to_side).abs() < 2e-3);
            assert!((arc.distance_to_point(side.a) - to_point).abs() < 2e-3);
        }
    }
}
