//! Distances of segments, beside parry's.

use super::{Args, Case, anywhere, shapes, square};
use crate::protocol::{REPETITIONS, Tally, timed};
use anyhow::Result;
use parry2d::{
    math::{Pose, Vector as Raw},
    query::distance,
    shape::{Ball, Compound, ConvexPolygon, Cuboid, Segment as Theirs, SharedShape},
};
use pf_core::PlanRng;
use pf_geom::{Point, Rectangle, Segment, Shape, Vector, World};
use rand::{RngExt, SeedableRng};
use std::time::Duration;

/// Pairs timed together: one is too short for a clock.
const BATCH: usize = 1000;

fn raw(p: Point) -> Raw {
    Raw::new(p.x, p.y)
}

fn segment_near(rng: &mut PlanRng, bounds: &Rectangle, length: f64) -> Segment {
    let a = anywhere(rng, bounds);
    let way = Vector::new(rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0));
    Segment::new(a, a + way * length)
}

/// Times two ways to the same number over batches.
fn compare<T>(
    name: &str,
    (ours, theirs): (&str, &str),
    batches: &[Vec<T>],
    by_us: impl Fn(&T) -> f64,
    by_them: impl Fn(&T) -> f64,
    target: Option<f64>,
) -> Case {
    let mut tallies = [Tally::default(), Tally::default()];
    for batch in batches {
        let mut least = [Duration::MAX; 2];
        for _ in 0..REPETITIONS {
            let (time, _) = timed(|| batch.iter().map(&by_us).sum::<f64>());
            least[0] = least[0].min(time);
            let (time, _) = timed(|| batch.iter().map(&by_them).sum::<f64>());
            least[1] = least[1].min(time);
        }
        let size = u32::try_from(batch.len()).unwrap_or(u32::MAX);
        for (tally, least) in tallies.iter_mut().zip(least) {
            tally.add_us(least.as_secs_f64() * 1e6 / f64::from(size));
        }
        for pair in batch {
            // Parry's general algorithm stops that near.
            let (a, b) = (by_us(pair), by_them(pair));
            tallies[0].mismatches += u64::from((a - b).abs() > 1e-6 * (1.0 + b));
        }
    }
    let [a, b] = tallies;
    Case::of(name, &[(ours, a), (theirs, b)], target)
}

pub(super) fn run(args: &Args, tell: &mut impl FnMut(Case) -> Result<()>) -> Result<()> {
    let mut rng = PlanRng::seed_from_u64(args.seed);
    let bounds = square(1);
    let batches: Vec<Vec<_>> = (0..100)
        .map(|_| {
            let pair = |_| {
                let (p, q) = (anywhere(&mut rng, &bounds), anywhere(&mut rng, &bounds));
                let segment = segment_near(&mut rng, &bounds, 5.0);
                let half = (p - q).abs() / 2.0;
                let pose = Pose::from_translation(raw(middle(p, q)));
                let theirs = Theirs::new(raw(segment.a), raw(segment.b));
                let cuboid = Cuboid::new(Raw::new(half.x, half.y));
                (segment, p.inf(&q), p.sup(&q), theirs, pose, cuboid)
            };
            (0..BATCH).map(pair).collect()
        })
        .collect();
    tell(compare(
        "segment to box",
        ("Segment::distance_to_box", "parry2d::query::distance"),
        &batches,
        |(segment, min, max, ..)| segment.distance_to_box(*min, *max),
        |(_, _, _, theirs, pose, cuboid)| {
            distance(&Pose::IDENTITY, theirs, pose, cuboid).map_or(f64::NAN, |d| d.distance)
        },
        Some(1.0 / 3.0),
    ))?;
    for count in [10, 200, 10_000] {
        let shapes = shapes(&mut rng, count, true);
        let compound = Compound::new(shapes.iter().map(theirs).collect());
        let world = World::with_shapes(square(count), shapes);
        let batches: Vec<Vec<_>> = (0..20)
            .map(|_| {
                let query = |_| {
                    let segment = segment_near(&mut rng, world.bounds(), 5.0);
                    (segment, Theirs::new(raw(segment.a), raw(segment.b)))
                };
                (0..BATCH / 10).map(query).collect()
            })
            .collect();
        tell(compare(
            &format!("clearance among {count}"),
            ("World::clearance", "parry2d::query::distance"),
            &batches,
            |(segment, _)| world.clearance(segment),
            |(_, theirs)| {
                distance(&Pose::IDENTITY, theirs, &Pose::IDENTITY, &compound)
                    .map_or(f64::NAN, |d| d.distance)
            },
            Some(1.0),
        ))?;
    }
    Ok(())
}

fn middle(p: Point, q: Point) -> Point {
    p + (q - p) / 2.0
}

fn theirs(shape: &Shape) -> (Pose, SharedShape) {
    let at = |p: Point| Pose::from_translation(raw(p));
    match shape {
        Shape::Circle(c) => (at(c.centre()), SharedShape::new(Ball::new(c.radius()))),
        Shape::Rectangle(r) => {
            let half = (r.max() - r.min()) / 2.0;
            let cuboid = Cuboid::new(Raw::new(half.x, half.y));
            (at(middle(r.min(), r.max())), SharedShape::new(cuboid))
        }
        Shape::Polygon(p) => {
            let corners: Vec<Raw> = p.corners().iter().map(|&c| raw(c)).collect();
            let convex = ConvexPolygon::from_convex_polyline_unmodified(corners);
            let shape = convex.map(SharedShape::new);
            (
                Pose::IDENTITY,
                shape.unwrap_or_else(|| SharedShape::new(Ball::new(0.0))),
            )
        }
    }
}
