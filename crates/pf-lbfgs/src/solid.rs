//! Obstacles as convex figures with a round border, and how deep a segment is in one.

mod convex;

use crate::class::ratio;
use convex::convex_parts;
use pf_geom::{Point, Shape, World};

/// A convex figure: everything within a radius of a point or of a convex polygon.
#[derive(Clone, Copy, Debug)]
struct Solid {
    first: usize,
    last: usize,
    radius: f64,
    min: [f64; 2],
    max: [f64; 2],
}

/// All obstacles of a world as convex figures.
#[derive(Clone, Debug, Default)]
pub(crate) struct Solids {
    solids: Vec<Solid>,
    /// Their corners, counterclockwise; a point has one.
    corners: Vec<[f64; 2]>,
}

/// Where a segment is near a figure, or deepest in it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Touch {
    /// The distance; below 0 by how much the segment must move to be outside.
    pub(crate) distance: f64,
    /// Where along the segment, 0 to 1.
    pub(crate) at: f64,
    /// The direction to the outside.
    pub(crate) out: [f64; 2],
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn sub(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn length(a: [f64; 2]) -> f64 {
    dot(a, a).sqrt()
}

fn scaled(a: [f64; 2], by: f64) -> [f64; 2] {
    [a[0] * by, a[1] * by]
}

fn between(a: [f64; 2], b: [f64; 2], t: f64) -> [f64; 2] {
    [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t]
}

/// How much of the way from `a` to `b` to go to be nearest `p`.
fn nearest(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> f64 {
    let along = sub(b, a);
    let square = dot(along, along);
    if square > 0.0 {
        (dot(sub(p, a), along) / square).clamp(0.0, 1.0)
    } else {
        0.0
    }
}

impl Solids {
    /// Takes the place of whatever it held.
    pub(crate) fn fill(&mut self, world: &World) {
        self.solids.clear();
        self.corners.clear();
        for (_, shape) in world.shapes() {
            match shape {
                Shape::Circle(c) => self.push(&[c.centre()], c.radius()),
                Shape::Rectangle(r) => self.push(&r.corners(), 0.0),
                Shape::Polygon(p) if p.is_convex() => self.push(p.corners(), 0.0),
                Shape::Polygon(p) => {
                    for part in convex_parts(p.corners()) {
                        self.push(&part, 0.0);
                    }
                }
            }
        }
    }

    fn push(&mut self, corners: &[Point], radius: f64) {
        let first = self.corners.len();
        self.corners.extend(corners.iter().map(|c| [c.x, c.y]));
        let last = self.corners.len();
        let (mut min, mut max) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for corner in &self.corners[first..last] {
            for k in 0..2 {
                min[k] = min[k].min(corner[k] - radius);
                max[k] = max[k].max(corner[k] + radius);
            }
        }
        self.solids.push(Solid {
            first,
            last,
            radius,
            min,
            max,
        });
    }

    pub(crate) fn len(&self) -> usize {
        self.solids.len()
    }

    /// A point within each figure.
    pub(crate) fn middles(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.solids.iter().map(|solid| {
            let corners = &self.corners[solid.first..solid.last];
            let share = 1.0 / ratio(corners.len(), 1);
            let sum = corners
                .iter()
                .fold([0.0; 2], |s, c| [s[0] + c[0], s[1] + c[1]]);
            scaled(sum, share)
        })
    }

    /// Whether the boxes about a segment and a figure are within `reach` of each other.
    #[inline]
    pub(crate) fn is_near(&self, solid: usize, a: [f64; 2], b: [f64; 2], reach: f64) -> bool {
        let solid = &self.solids[solid];
        (0..2).all(|k| {
            a[k].min(b[k]) <= solid.max[k] + reach && a[k].max(b[k]) >= solid.min[k] - reach
        })
    }

    /// Shows where a segment is nearer to a figure than `reach`: at either end, wherever a corner of
    /// the figure is nearest to it in between, or where it is deepest inside. All is well if nothing
    /// is shown. The nearest place alone would jump from one end to the other where a segment lies
    /// along a side.
    pub(crate) fn each_touch(
        &self,
        solid: usize,
        a: [f64; 2],
        b: [f64; 2],
        reach: f64,
        mut show: impl FnMut(Touch),
    ) {
        let solid = &self.solids[solid];
        let corners = &self.corners[solid.first..solid.last];
        let mut show = |touch: Touch| {
            let distance = touch.distance - solid.radius;
            if distance < reach {
                show(Touch { distance, ..touch });
            }
        };
        if let [centre] = corners {
            return show(to_point(a, b, *centre));
        }
        let (apart, across) = apart(a, b, corners);
        if apart.distance >= reach {
            return;
        }
        let mut outside = true;
        for (at, end) in [(0.0, a), (1.0, b)] {
            let touch = end_to_polygon(end, corners);
            outside &= touch.distance > 0.0;
            show(Touch { at, ..touch });
        }
        if outside && apart.distance <= 0.0 && !across {
            // It goes in and out, and out is nearest across a side.
            show(apart);
        }
        for &corner in corners {
            if apart.distance > 0.0 {
                show(to_point(a, b, corner));
            } else if across {
                // The segment must pass the corners on its shallow side.
                let distance = -dot(apart.out, sub(corner, a));
                show(Touch {
                    distance,
                    at: nearest(a, b, corner),
                    ..apart
                });
            }
        }
    }
}

fn to_point(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> Touch {
    let at = nearest(a, b, p);
    let away = sub(between(a, b, at), p);
    let distance = length(away);
    let out = if distance > 0.0 {
        scaled(away, 1.0 / distance)
    } else {
        // Right through the middle: either side is as good.
        let along = sub(b, a);
        let norm = length(along);
        if norm > 0.0 {
            [-along[1] / norm, along[0] / norm]
        } else {
            [0.0, 1.0]
        }
    };
    Touch { distance, at, out }
}

/// The direction in which a segment and a convex polygon are furthest apart, or overlap least, and
/// whether it is across the segment. (Separating axes.)
fn apart(a: [f64; 2], b: [f64; 2], corners: &[[f64; 2]]) -> (Touch, bool) {
    let mut best = Touch {
        distance: f64::NEG_INFINITY,
        at: 0.0,
        out: [0.0, 1.0],
    };
    let mut across = false;
    let mut from = corners[corners.len() - 1];
    for &to in corners {
        if let Some(out) = outward(from, to) {
            let (of_a, of_b) = (dot(out, sub(a, from)), dot(out, sub(b, from)));
            if of_a.min(of_b) > best.distance {
                let (distance, at) = if of_a < of_b {
                    (of_a, 0.0)
                } else {
                    (of_b, 1.0)
                };
                best = Touch { distance, at, out };
            }
        }
        from = to;
    }
    if let Some(right) = outward(a, b) {
        for out in [right, scaled(right, -1.0)] {
            let reach = |c: &[f64; 2]| -dot(out, sub(*c, a));
            let distance = corners.iter().map(reach).fold(f64::INFINITY, f64::min);
            if distance > best.distance {
                best = Touch {
                    distance,
                    at: 0.5,
                    out,
                };
                across = true;
            }
        }
    }
    (best, across)
}

/// The direction to the right of the way from one point to another.
fn outward(from: [f64; 2], to: [f64; 2]) -> Option<[f64; 2]> {
    let along = sub(to, from);
    let norm = length(along);
    (norm > 0.0).then(|| [along[1] / norm, -along[0] / norm])
}

/// The distance from a point to a convex polygon; inside, less than 0 by how deep it is.
fn end_to_polygon(end: [f64; 2], corners: &[[f64; 2]]) -> Touch {
    let (mut side, mut which) = (f64::NEG_INFINITY, [0.0, 1.0]);
    let (mut square, mut away) = (f64::INFINITY, [0.0; 2]);
    let mut from = corners[corners.len() - 1];
    for &to in corners {
        if let Some(out) = outward(from, to) {
            let distance = dot(out, sub(end, from));
            if distance > side {
                (side, which) = (distance, out);
            }
        }
        let gap = sub(end, between(from, to, nearest(from, to, end)));
        if dot(gap, gap) < square {
            (square, away) = (dot(gap, gap), gap);
        }
        from = to;
    }
    let distance = square.sqrt();
    if side > 0.0 && distance > 0.0 {
        return Touch {
            distance,
            at: 0.0,
            out: scaled(away, 1.0 / distance),
        };
    }
    Touch {
        distance: side,
        at: 0.0,
        out: which,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pf_conformance::{seeded, world::Obstacles, world::waypoint_world};
    use pf_geom::{Rectangle, Segment};
    use rand::RngExt;

    /// Distances are those of the world, and less than 0 inside.
    #[test]
    fn touches_are_exact() {
        let mut rng = seeded(5);
        for seed in 0..300 {
            let problem = waypoint_world(seed, 1, Obstacles::Mixed);
            let world = problem.world();
            let mut solids = Solids::default();
            solids.fill(world);
            let (_, shape) = world.shapes().next().unwrap();
            let (min, max) = shape.bounding_box();
            for _ in 0..40 {
                let mut place = |k: usize| rng.random_range(min[k] - 2.0..max[k] + 2.0);
                let ends = [[place(0), place(1)], [place(0), place(1)]];
                let segment = |by: [f64; 2]| {
                    let [a, b] = ends.map(|e| Point::new(e[0] + by[0], e[1] + by[1]));
                    Segment::new(a, b)
                };
                let mut touches = vec![];
                for k in 0..solids.len() {
                    solids.each_touch(k, ends[0], ends[1], 99.0, |touch| touches.push(touch));
                }
                let least = touches
                    .into_iter()
                    .min_by(|a, b| a.distance.total_cmp(&b.distance));
                let touch = least.unwrap();
                let exact = shape.distance(&segment([0.0; 2]));
                assert!(
                    (touch.distance.max(0.0) - exact).abs() < 1e-9,
                    "{touch:?} {exact}"
                );
                let inside = shape.blocks(&segment([0.0; 2]), 0.0);
                assert!(inside == (touch.distance < 0.0) || touch.distance.abs() < 1e-8);
            }
        }
    }

    #[test]
    fn a_path_through_the_very_middle_has_a_way_out() {
        let bounds = Rectangle::new(Point::new(-9.0, -9.0), Point::new(9.0, 9.0)).unwrap();
        let circle = pf_geom::Circle::new(Point::origin(), 2.0).unwrap();
        let mut solids = Solids::default();
        solids.fill(&World::with_shapes(bounds, [circle.into()]));
        let mut seen = 0;
        solids.each_touch(0, [-3.0, 0.0], [3.0, 0.0], 0.0, |touch| {
            assert!((touch.distance + 2.0).abs() < 1e-12 && touch.out[1].abs() > 0.99);
            seen += 1;
        });
        assert_eq!(seen, 1);
    }
}
