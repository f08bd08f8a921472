//! Our distances are parry's, on a million random pairs, and the judge's decisions follow from
//! them.
//!
//! Parry's are its closed forms: its general algorithm (GJK) stops some 5e-8 short of the distance,
//! further than the judge may err. `docs/decisions/0008-distances-of-our-own.md` says more.

#![expect(clippy::unwrap_used, reason = "tests")]
#![expect(clippy::many_single_char_names, reason = "points")]

use parry2d::{
    math::{Pose, Vector as Raw},
    query::{ClosestPoints, PointQuery, details::closest_points_segment_segment},
    shape::{Cuboid, Segment as Theirs},
    utils::point_in_poly2d,
};
use pf_core::PlanRng;
use pf_geom::{Circle, Point, Polygon, Rectangle, Segment, Shape, TOUCH, Vector, World};
use rand::{RngExt, SeedableRng};

const PAIRS: u32 = 1_000_000;

/// Points that meet often: a coarse lattice as well as anywhere, near and far, large and small.
struct Source(PlanRng, f64);

impl Source {
    fn new(seed: u64) -> Self {
        Self(PlanRng::seed_from_u64(seed), 1.0)
    }

    fn below(&mut self, n: u32) -> u32 {
        self.0.random_range(0..n)
    }

    fn coordinate(&mut self) -> f64 {
        self.1
            * match self.below(3) {
                0 => f64::from(self.below(9)) - 4.0,
                1 => (f64::from(self.below(9)) - 4.0) * 0.1,
                _ => self.0.random_range(-4.0..4.0),
            }
    }

    fn point(&mut self) -> Point {
        Point::new(self.coordinate(), self.coordinate())
    }

    fn shape(&mut self) -> Shape {
        loop {
            let (p, q) = (self.point(), self.point());
            let shape = match self.below(3) {
                0 => Circle::new(p, (q - p).norm() * 0.5).map(Shape::from),
                1 => Rectangle::new(p.inf(&q), p.sup(&q)).map(Shape::from),
                _ => {
                    let n = 3 + self.below(4);
                    let corners = (0..n).map(|_| self.point()).collect();
                    Polygon::new(corners).map(Shape::from)
                }
            };
            if let Ok(shape) = shape {
                return shape;
            }
        }
    }

    /// A segment, often a point, or in touch with the shape, or in line with one of its sides.
    fn segment(&mut self, shape: &Shape) -> Segment {
        let corners = corners(shape);
        let k = self.below(u32::try_from(corners.len()).unwrap()) as usize;
        let (c, d) = (corners[k], corners[(k + 1) % corners.len()]);
        let t = self.coordinate() / self.1;
        let (p, q) = (self.point(), self.point());
        match self.below(10) {
            0 => Segment::new(p, p),
            1 => Segment::new(c, p),
            2 => Segment::new(c, d),
            3 => Segment::new(c + (d - c) * t, c + (d - c) * self.coordinate()),
            4 => Segment::new(c + (d - c) * t, p),
            5 => Segment::new(p, p + (d - c) * t),
            6 => Segment::new(p, p + (q - p) * 1e-9),
            7 => Segment::new(c + (p - c) * 1e-7, c + (q - c) * 1e-7),
            _ => Segment::new(p, q),
        }
    }
}

fn corners(shape: &Shape) -> Vec<Point> {
    match shape {
        Shape::Circle(c) => {
            let (at, r) = (c.centre(), c.radius());
            let angles = [0.0, 0.6, 2.5, 4.0];
            angles
                .map(|a: f64| at + Vector::new(a.cos(), a.sin()) * r)
                .to_vec()
        }
        Shape::Rectangle(r) => r.corners().to_vec(),
        Shape::Polygon(p) => p.corners().to_vec(),
    }
}

fn raw(p: Point) -> Raw {
    Raw::new(p.x, p.y)
}

fn theirs(s: &Segment) -> Theirs {
    Theirs::new(raw(s.a), raw(s.b))
}

/// Parry's closed forms. Its general algorithm stops within 5e-8 of the distance, and its closest
/// points of two segments have absolute tolerances, which take short ones for points and crossing
/// short ones for parallel. So they are scaled; and where segments do not cross an end of one is
/// nearest, which parry knows exactly.
fn between(a: &Segment, b: &Segment) -> f64 {
    let size = (a.length() * b.length()).sqrt();
    let scale = if size > 0.0 { 1.0 / size } else { 1.0 };
    let scaled = |p: Point| Point::from((p - a.a) * scale);
    let scaled = |s: &Segment| theirs(&Segment::new(scaled(s.a), scaled(s.b)));
    let (s, t) = (scaled(a), scaled(b));
    let ClosestPoints::WithinMargin(p, q) =
        closest_points_segment_segment(&Pose::IDENTITY, &s, &t, f64::MAX)
    else {
        panic!("closest points lie within any margin");
    };
    [
        (p - q).length(),
        s.distance_to_local_point(t.a, true),
        s.distance_to_local_point(t.b, true),
        t.distance_to_local_point(s.a, true),
        t.distance_to_local_point(s.b, true),
    ]
    .into_iter()
    .fold(f64::INFINITY, f64::min)
        / scale
}

fn parrys_distance(shape: &Shape, segment: &Segment) -> f64 {
    let around = |corners: &[Point]| {
        let next = corners.iter().cycle().skip(1);
        let sides = corners.iter().zip(next).map(|(&a, &b)| Segment::new(a, b));
        sides
            .map(|side| between(&side, segment))
            .fold(f64::INFINITY, f64::min)
    };
    match shape {
        Shape::Circle(c) => {
            let middle = theirs(segment).distance_to_local_point(raw(c.centre()), true);
            (middle - c.radius()).max(0.0)
        }
        Shape::Rectangle(r) => {
            let half = Cuboid::new(raw(Point::from((r.max() - r.min()) / 2.0)));
            let middle = nalgebra_centre(r);
            if half.contains_local_point(raw(segment.a) - raw(middle)) {
                return 0.0;
            }
            around(&r.corners())
        }
        Shape::Polygon(p) => {
            let corners: Vec<Raw> = p.corners().iter().map(|&c| raw(c)).collect();
            if point_in_poly2d(raw(segment.a), &corners) {
                return 0.0;
            }
            around(p.corners())
        }
    }
}

fn nalgebra_centre(r: &Rectangle) -> Point {
    r.min() + (r.max() - r.min()) / 2.0
}

#[test]
fn distances_are_those_of_parry() {
    let mut source = Source::new(1);
    let mut touching = 0;
    for k in 0..PAIRS {
        source.1 = [1.0, 1.0, 1.0, 1e-4, 100.0][k as usize % 5];
        let shape = source.shape();
        let segment = source.segment(&shape);
        let (ours, parrys) = (shape.distance(&segment), parrys_distance(&shape, &segment));
        assert!(
            (ours - parrys).abs() <= 1e-9,
            "{ours} is not {parrys}: {segment:?} {shape:?}"
        );
        touching += u32::from(ours <= 0.0);
    }
    assert!(touching > PAIRS / 10 && touching < PAIRS * 9 / 10);
}

#[test]
fn a_worlds_clearance_is_the_least_of_parrys_distances() {
    let mut source = Source::new(2);
    for _ in 0..2_000 {
        let n = source.below(40) as usize;
        let shapes: Vec<Shape> = (0..n).map(|_| source.shape()).collect();
        let bounds = Rectangle::new(Point::new(-9.0, -9.0), Point::new(9.0, 9.0)).unwrap();
        let world = World::with_shapes(bounds, shapes.clone());
        for _ in 0..20 {
            let around = source.shape();
            let segment = source.segment(&around);
            let distances = shapes.iter().map(|s| parrys_distance(s, &segment));
            let least = distances.fold(f64::INFINITY, f64::min);
            let clearance = world.clearance(&segment);
            assert!(clearance.total_cmp(&least).is_eq() || (clearance - least).abs() <= 1e-9);
            if let Some((d, id)) = world.nearest(&segment) {
                assert!((parrys_distance(&shapes[id], &segment) - d).abs() <= 1e-9);
            }
            for p in [segment.a, segment.b] {
                let point = Segment::new(p, p);
                for shape in &shapes {
                    let far = parrys_distance(shape, &point);
                    let near = shape.distance_to_point(p);
                    assert!(
                        (near - far).abs() <= 1e-9,
                        "{near} is not {far}: {p} {shape:?}"
                    );
                }
            }
        }
    }
}

/// A disc enters where it is nearer than its radius, by more than what counts as touching.
#[test]
fn what_blocks_a_robot_follows_from_the_distance() {
    let mut source = Source::new(3);
    for _ in 0..PAIRS / 2 {
        let shape = source.shape();
        let segment = source.segment(&shape);
        let radius = 0.25 * f64::from(1 + source.below(4));
        let room = parrys_distance(&shape, &segment) - radius;
        if (room + TOUCH).abs() > 1e-13 {
            let blocked = shape.blocks(&segment, radius);
            assert_eq!(blocked, room < -TOUCH, "{room}: {segment:?} {shape:?}");
        }
    }
}

/// A point enters where it gets inside, which neither touching nor running along a side does.
#[test]
fn a_point_may_touch_and_not_enter() {
    let mut source = Source::new(4);
    let mut counts = [0; 2];
    for _ in 0..PAIRS / 2 {
        let shape = source.shape();
        let segment = source.segment(&shape);
        let blocked = shape.blocks(&segment, 0.0);
        counts[usize::from(blocked)] += 1;
        if parrys_distance(&shape, &segment) > 1e-12 {
            assert!(!blocked, "apart: {segment:?} {shape:?}");
        }
        let depth = deepest(&shape, &segment);
        if depth > 2.0 * TOUCH {
            assert!(blocked, "{depth}: {segment:?} {shape:?}");
        }
    }
    assert!(counts.iter().all(|&n| n > PAIRS / 20), "{counts:?}");
    // Along every side, in its line, and through every corner.
    for _ in 0..20_000 {
        let shape = source.shape();
        if let Shape::Circle(circle) = shape {
            let out = Vector::new(0.6, 0.8);
            let on = circle.centre() + out * circle.radius();
            let along = Vector::new(-0.8, 0.6);
            for (off, blocked) in [(0.0, false), (-0.5e-9, false), (-2e-9, true)] {
                let way = Segment::new(on + out * off - along, on + out * off + along);
                assert_eq!(shape.blocks(&way, 0.0), blocked, "{off}: {shape:?}");
            }
            continue;
        }
        let corners = corners(&shape);
        for k in 0..corners.len() {
            let (a, b) = (corners[k], corners[(k + 1) % corners.len()]);
            let side = Segment::new(a, b);
            assert!(!shape.blocks(&side, 0.0), "{side:?} {shape:?}");
            let inward = Vector::new(a.y - b.y, b.x - a.x).normalize();
            let middle = side.at(0.5);
            // Where nothing else of the shape is near, a little further in is in.
            let inner = middle + inward * 3e-9;
            let alone = deepest(&shape, &Segment::new(inner, inner)) > 2.5e-9;
            for (off, blocked) in [(-1e-6, false), (0.4e-9, false), (3e-9, true)] {
                let by = inward * off;
                let way = Segment::new(side.at(0.49) + by, side.at(0.51) + by);
                if alone && (blocked || deepest(&shape, &way) < 0.9e-9) {
                    assert_eq!(shape.blocks(&way, 0.0), blocked, "{off}: {way:?} {shape:?}");
                }
            }
        }
    }
}

/// How deep a segment gets at some of its points; the deepest may be deeper.
fn deepest(shape: &Shape, segment: &Segment) -> f64 {
    let depth = |p: Point| match shape {
        Shape::Circle(c) => c.radius() - (p - c.centre()).norm(),
        Shape::Rectangle(r) if r.contains(p) => {
            let (low, high) = (p - r.min(), r.max() - p);
            low.inf(&high).min()
        }
        Shape::Polygon(polygon) if polygon.contains(p) => {
            let point = Segment::new(p, p);
            let sides = polygon.sides().map(|side| between(&side, &point));
            sides.fold(f64::INFINITY, f64::min)
        }
        _ => 0.0,
    };
    let places = (0..=10).map(|k| segment.at(f64::from(k) / 10.0));
    places.map(depth).fold(0.0, f64::max)
}

/// A ray ends on the shape, and nothing of the shape lies before.
#[test]
fn a_ray_ends_where_it_first_touches() {
    let mut source = Source::new(5);
    for _ in 0..PAIRS / 5 {
        let shape = source.shape();
        let segment = source.segment(&shape);
        match shape.first_touch(&segment) {
            None => {
                let far = parrys_distance(&shape, &segment);
                let grazes = deepest(&shape, &segment) <= 1e-7;
                assert!(far > 0.0 || grazes, "missed: {segment:?} {shape:?}");
            }
            Some(t) => {
                assert!((0.0..=1.0).contains(&t));
                let hit = segment.at(t);
                let far = shape.distance_to_point(hit);
                assert!(far <= 1e-7, "{far} at {t}: {segment:?} {shape:?}");
                let before = Segment::new(segment.a, segment.at(t * 0.999_999));
                let deep = deepest(&shape, &before);
                assert!(
                    t <= 0.0 || deep <= 1e-7,
                    "{deep} before {t}: {segment:?} {shape:?}"
                );
            }
        }
    }
}
