//! Single shapes, given or made up.

use crate::PlanRng;
use pf_geom::{Circle, Point, Polygon, Rectangle, Shape, Vector};
use rand::RngExt;
use std::f64::consts::{PI, TAU};

pub(crate) fn pick<'a, T>(rng: &mut PlanRng, from: &'a [T]) -> &'a T {
    &from[rng.random_range(0..from.len())]
}

pub(crate) fn circle(x: f64, y: f64, radius: f64) -> Shape {
    Circle::new(Point::new(x, y), radius)
        .expect("a circle of some size")
        .into()
}

pub(crate) fn rectangle(min: Point, max: Point) -> Shape {
    Rectangle::new(min, max)
        .expect("a rectangle of some size")
        .into()
}

pub(super) fn polygon(corners: Vec<Point>) -> Shape {
    Polygon::new(corners).expect("a simple polygon").into()
}

/// Anything that fits into a disc.
pub(crate) fn shape(rng: &mut PlanRng, middle: Point, size: f64) -> Shape {
    let turn = rng.random_range(0.0..TAU);
    match rng.random_range(0..10) {
        0..3 => circle(middle.x, middle.y, size),
        3..6 => {
            let angle: f64 = rng.random_range(0.15..PI / 2.0 - 0.15);
            let half = Vector::new(angle.cos(), angle.sin()) * size;
            rectangle(middle - half, middle + half)
        }
        6..8 => {
            // Corners on the disc's border, none too near another.
            let corners = rng.random_range(3..=8u32);
            let step = TAU / f64::from(corners);
            let shift = rng.random_range(0.0..0.8);
            let around = (0..corners).map(|k| {
                let angle = f64::from(k) * step + rng.random_range(0.0..=shift * step);
                (angle + turn, size)
            });
            polygon(around.map(|(a, r)| polar(middle, a, r)).collect())
        }
        8 => {
            // A star with points of different lengths.
            let points = rng.random_range(3..=6u32);
            let step = PI / f64::from(points);
            let around = (0..2 * points).map(|k| {
                let range = if k % 2 == 0 { 0.7..1.0 } else { 0.2..0.5 };
                (f64::from(k) * step + turn, size * rng.random_range(range))
            });
            polygon(around.map(|(a, r)| polar(middle, a, r)).collect())
        }
        _ => pocket(
            middle,
            size,
            turn,
            rng.random_range(0.1..0.5),
            rng.random_range(0.2..1.0),
        ),
    }
}

/// Anything that holds a disc, and little more.
pub(super) fn fitted(rng: &mut PlanRng, middle: Point, disc: f64) -> Shape {
    match rng.random_range(0..3) {
        0 => circle(middle.x, middle.y, disc),
        1 => rectangle(middle - Vector::repeat(disc), middle + Vector::repeat(disc)),
        _ => {
            let (corners, turn) = (rng.random_range(5..=9u32), rng.random_range(0.0..TAU));
            let step = TAU / f64::from(corners);
            let size = disc / (step / 2.0).cos();
            let around = (0..corners).map(|k| polar(middle, f64::from(k) * step + turn, size));
            polygon(around.collect())
        }
    }
}

/// A square with a notch from above, turned.
fn pocket(middle: Point, size: f64, turn: f64, width: f64, depth: f64) -> Shape {
    let bottom = 1.0 - 1.8 * depth;
    let corners = [
        (-1.0, -1.0),
        (1.0, -1.0),
        (1.0, 1.0),
        (width, 1.0),
        (width, bottom),
        (-width, bottom),
        (-width, 1.0),
        (-1.0, 1.0),
    ];
    let (sin, cos) = turn.sin_cos();
    let placed = corners.map(|(x, y)| {
        let turned = Vector::new(x * cos - y * sin, x * sin + y * cos);
        middle + turned * (size / 2f64.sqrt())
    });
    polygon(placed.to_vec())
}

fn polar(middle: Point, angle: f64, radius: f64) -> Point {
    middle + Vector::new(angle.cos(), angle.sin()) * radius
}
