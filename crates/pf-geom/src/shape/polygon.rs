//! Simple polygons, convex or not: which borders are none, and where a segment gets inside.

use super::{TOUCH, bad, check_finite};
use crate::{Point, Segment, Vector, cross};
use pf_core::InvalidProblem;

/// A simple polygon with its inside, its corners counterclockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    corners: Vec<Point>,
    /// The direction of the side that begins at each corner; only asked for if it is convex.
    along: Vec<Vector>,
    convex: bool,
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
    pub(super) fn is_near(&self, segment: &Segment, reach: f64) -> bool {
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

    pub(super) fn border_distance(&self, segment: &Segment) -> f64 {
        self.sides()
            .map(|side| side.distance_to_segment(segment))
            .fold(f64::INFINITY, f64::min)
    }

    pub(super) fn border_distance_to_point(&self, p: Point) -> f64 {
        self.sides()
            .map(|side| side.distance_to_point(p))
            .fold(f64::INFINITY, f64::min)
    }

    /// Whether a segment gets deeper inside than `depth`.
    pub(super) fn is_entered(&self, segment: &Segment, depth: f64) -> bool {
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

    /// How much of a segment's way it is to the border, 0 to 1.
    pub(super) fn first_touch(&self, segment: &Segment) -> Option<f64> {
        self.sides()
            .filter_map(|side| first_crossing(segment, &side))
            .min_by(f64::total_cmp)
    }

    /// Lower left and upper right corner of the smallest upright box around it.
    pub(super) fn bounding_box(&self) -> (Point, Point) {
        let first = self.corners[0];
        self.corners
            .iter()
            .fold((first, first), |(min, max), c| (min.inf(c), max.sup(c)))
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
