//! The paper's potential of rectangles, and its loss over a path (eq. 1-9).

mod lanes;

use crate::{class::corners, quadratic};
use lanes::{Packed, SHARES, Samples};
use pf_core::PlanRng;
use pf_geom::Rectangle;
use wide::f64x4;

/// The height of a bump.
const HEIGHT: f64 = 8.0;
/// The published code sees rectangles within this of a segment's middle.
const SIGHT: f64 = 5.0;
/// So many segments are held beside a bump at once.
const GROUP: usize = 3;
/// How many samples a segment has, both ends included.
const SAMPLES: u32 = 4;

/// One rectangle's bump: V = 8 f(nx) f(ny) with f(n) = exp(-n^2) (1 - n^2)^2, where nx and ny run
/// from -1 to 1 across the rectangle grown by the margin and are 0 at its peak.
#[derive(Clone, Copy, Debug)]
struct Bump {
    peak: [f64; 2],
    /// The grown rectangle.
    min: [f64; 2],
    max: [f64; 2],
    /// One over the distance from the peak to the grown rectangle's sides.
    below: [f64; 2],
    above: [f64; 2],
}

/// The bumps of all rectangles.
#[derive(Clone, Debug, Default)]
pub(crate) struct Potential {
    bumps: Vec<Bump>,
}

impl Bump {
    fn new(rectangle: &Rectangle, margin: f64) -> Self {
        let (min, max, peak) = (rectangle.min(), rectangle.max(), rectangle.peak());
        let pair = |of: &dyn Fn(usize) -> f64| [of(0), of(1)];
        Self {
            peak: pair(&|k| peak[k]),
            min: pair(&|k| min[k] - margin),
            max: pair(&|k| max[k] + margin),
            below: pair(&|k| 1.0 / (peak[k] - min[k] + margin)),
            above: pair(&|k| 1.0 / (max[k] + margin - peak[k])),
        }
    }

    /// Where a point lies along one axis, -1 to 1, and how fast that changes.
    fn along(&self, k: usize, x: f64) -> (f64, f64) {
        let from = x - self.peak[k];
        let scale = if from < 0.0 {
            self.below[k]
        } else {
            self.above[k]
        };
        (from * scale, scale)
    }

    /// The height at a point and its gradient.
    fn height(&self, x: f64, y: f64) -> Option<Height> {
        let ((nx, sx), (ny, sy)) = (self.along(0, x), self.along(1, y));
        if nx.abs() >= 1.0 || ny.abs() >= 1.0 {
            return None;
        }
        let (x2, y2) = (nx * nx, ny * ny);
        let (qx, qy) = (1.0 - x2, 1.0 - y2);
        let e = HEIGHT * (-(x2 + y2)).exp();
        Some(Height {
            value: e * (qx * qx) * (qy * qy),
            gradient: [
                -2.0 * e * nx * qx * (qx + 2.0) * (qy * qy) * sx,
                -2.0 * e * ny * qy * (qy + 2.0) * (qx * qx) * sy,
            ],
        })
    }

    /// The matrix of second derivatives at a point: xx, xy, yy.
    fn curvature(&self, x: f64, y: f64) -> Option<[f64; 3]> {
        let ((nx, sx), (ny, sy)) = (self.along(0, x), self.along(1, y));
        if nx.abs() >= 1.0 || ny.abs() >= 1.0 {
            return None;
        }
        let e = HEIGHT * (-(nx * nx + ny * ny)).exp();
        // f, f' and f'' but for their common exp(-n^2).
        let factors = |n: f64| {
            let q = 1.0 - n * n;
            let slope = n * q * (q + 2.0);
            let bend = q * (q + 2.0) - 4.0 * n * n * (q + 1.0) - 2.0 * n * slope;
            (q * q, -2.0 * slope, -2.0 * bend)
        };
        let ((fx, gx, hx), (fy, gy, hy)) = (factors(nx), factors(ny));
        Some([
            e * hx * fy * sx * sx,
            e * gx * gy * sx * sy,
            e * fx * hy * sy * sy,
        ])
    }

    /// The square of the distance from a point to the grown rectangle.
    fn square_distance(&self, p: [f64; 2]) -> f64 {
        let gap = |k: usize| (self.min[k] - p[k]).max(p[k] - self.max[k]).max(0.0);
        gap(0) * gap(0) + gap(1) * gap(1)
    }

    fn is_beside(&self, a: &[f64], b: &[f64]) -> bool {
        (0..2).any(|k| a[k].max(b[k]) <= self.min[k] || a[k].min(b[k]) >= self.max[k])
    }

    /// Whether all between these corners is outside.
    #[expect(
        clippy::needless_bitwise_bool,
        reason = "all at once: which of them holds is hard to guess"
    )]
    fn is_outside(&self, min: [f64; 2], max: [f64; 2]) -> bool {
        (max[0] <= self.min[0])
            | (min[0] >= self.max[0])
            | (max[1] <= self.min[1])
            | (min[1] >= self.max[1])
    }
}

struct Height {
    value: f64,
    gradient: [f64; 2],
}

impl Potential {
    /// Takes the place of whatever it held.
    pub(crate) fn fill<'a>(
        &mut self,
        rectangles: impl Iterator<Item = &'a Rectangle>,
        margin: f64,
    ) {
        self.bumps.clear();
        self.bumps.extend(rectangles.map(|r| Bump::new(r, margin)));
    }

    /// The loss of a path at `lambda`, and its gradient; `path` and `gradient` hold x and y by
    /// turns, both ends included. One sample at a time.
    pub(crate) fn loss(&self, path: &[f64], lambda: f64, gradient: &mut [f64]) -> f64 {
        let mut loss = quadratic::loss(path, gradient);
        for (a, g) in (0..path.len() - 2).step_by(2).map(|k| (&path[k..k + 4], k)) {
            for bump in &self.bumps {
                if bump.is_beside(&a[..2], &a[2..]) {
                    continue;
                }
                for k in 0..SAMPLES {
                    let t = f64::from(k) / f64::from(SAMPLES - 1);
                    let (x, y) = (a[0] + t * (a[2] - a[0]), a[1] + t * (a[3] - a[1]));
                    let Some(height) = bump.height(x, y) else {
                        continue;
                    };
                    loss += lambda * height.value;
                    for k in 0..2 {
                        gradient[g + k] += lambda * (1.0 - t) * height.gradient[k];
                        gradient[g + 2 + k] += lambda * t * height.gradient[k];
                    }
                }
            }
        }
        loss
    }

    /// The same, four samples at a time.
    pub(crate) fn loss_in_lanes(&self, path: &[f64], lambda: f64, gradient: &mut [f64]) -> f64 {
        let loss = quadratic::loss_in_lanes(path, gradient);
        let mut inside = Packed::new(lambda, gradient);
        let segments = path.len() / 2 - 1;
        for first in (0..segments).step_by(GROUP) {
            let some = 2 * first..2 * segments.min(first + GROUP);
            let (min, max) = corners(&path[some.start..some.end + 2]);
            for bump in &self.bumps {
                if !bump.is_outside(min, max) {
                    for segment in some.clone().step_by(2) {
                        inside.take(&Samples::of(path, segment), bump);
                    }
                }
            }
        }
        loss + inside.close()
    }

    /// The loss as the published code takes it: with 8 samples where the square of the distance from
    /// a segment's middle to the nearest grown rectangle is at most the margin, and only of
    /// rectangles nearer than 5 to the middle; with noise added to the gradient near a peak if
    /// somebody gives it chance.
    pub(crate) fn loss_of_published_code(
        &self,
        path: &[f64],
        lambda: f64,
        margin: f64,
        gradient: &mut [f64],
        mut kick: Option<&mut PlanRng>,
    ) -> f64 {
        let thirds = f64x4::new(SHARES);
        let sevenths = [
            f64x4::new([0.0, 1.0 / 7.0, 2.0 / 7.0, 3.0 / 7.0]),
            f64x4::new([4.0 / 7.0, 5.0 / 7.0, 6.0 / 7.0, 1.0]),
        ];
        let mut loss = quadratic::loss(path, gradient);
        for g in (0..path.len() - 2).step_by(2) {
            let segment = &path[g..g + 4];
            let middle = [0, 1].map(|k| f64::midpoint(segment[k], segment[k + 2]));
            let away = |bump: &Bump| bump.square_distance(middle);
            let nearest = self.bumps.iter().map(away).fold(f64::INFINITY, f64::min);
            let samples = if nearest <= margin {
                &sevenths[..]
            } else {
                std::slice::from_ref(&thirds)
            };
            let mut sum = None;
            for bump in self.bumps.iter().filter(|bump| away(bump) < SIGHT * SIGHT) {
                if bump.is_beside(&segment[..2], &segment[2..]) {
                    continue;
                }
                for &t in samples {
                    bump.add_lanes(segment, t, kick.as_deref_mut(), &mut sum);
                }
            }
            if let Some(sum) = sum {
                loss += sum.add_to(lambda, &mut gradient[g..g + 4]);
            }
        }
        loss
    }

    /// Adds the second derivatives of the potential's share of the loss to `add`, which takes the
    /// place of a segment's first end in the path, the sample's share in its second end, and xx, xy,
    /// yy.
    pub(crate) fn curvature(
        &self,
        path: &[f64],
        lambda: f64,
        mut add: impl FnMut(usize, f64, [f64; 3]),
    ) {
        for (place, g) in (0..path.len() - 2).step_by(2).enumerate() {
            let a = &path[g..g + 4];
            for bump in &self.bumps {
                if bump.is_beside(&a[..2], &a[2..]) {
                    continue;
                }
                for k in 0..SAMPLES {
                    let t = f64::from(k) / f64::from(SAMPLES - 1);
                    let (x, y) = (a[0] + t * (a[2] - a[0]), a[1] + t * (a[3] - a[1]));
                    if let Some(bend) = bump.curvature(x, y) {
                        add(place, t, bend.map(|v| lambda * v));
                    }
                }
            }
        }
    }

    /// The potential at a point, for contours.
    pub(crate) fn at(&self, x: f64, y: f64) -> f64 {
        let heights = self.bumps.iter().filter_map(|bump| bump.height(x, y));
        heights.map(|height| height.value).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pf_conformance::{
        seeded,
        world::{Obstacles, waypoint_world},
    };
    use pf_geom::Point;
    use rand::RngExt;

    fn any_path(rng: &mut PlanRng, points: usize) -> Vec<f64> {
        (0..2 * points)
            .map(|_| rng.random_range(0.0..40.0))
            .collect()
    }

    /// Rectangles, some with peaks of their own, even on the border.
    fn potentials() -> Vec<Potential> {
        let potential = |seed| {
            let problem = waypoint_world(seed, 20, Obstacles::Rectangles);
            let mut rng = seeded(seed);
            let peaked = crate::rectangles(&problem).map(|r| {
                let share: [f64; 2] =
                    [(); 2].map(|()| rng.random_range(-0.3..1.3f64).clamp(0.0, 1.0));
                let at = |k: usize| r.min()[k] + share[k] * (r.max()[k] - r.min()[k]);
                let at = Point::new(at(0), at(1)).inf(&r.max());
                r.with_peak(at).unwrap()
            });
            let peaked: Vec<_> = peaked.collect();
            let mut potential = Potential::default();
            potential.fill(peaked.iter(), 2.0);
            potential
        };
        (0..20).map(potential).collect()
    }

    /// The third derivatives jump at a border and at a peak, nowhere the loss or its gradient does.
    #[test]
    fn gradients_are_those_of_finite_differences() {
        let mut rng = seeded(1);
        for potential in potentials() {
            let mut path = any_path(&mut rng, 12);
            let (mut gradient, mut unused) = (vec![0.0; 24], vec![0.0; 24]);
            let mut code = vec![0.0; 24];
            potential.loss(&path, 3.0, &mut gradient);
            potential.loss_of_published_code(&path, 3.0, 2.0, &mut code, None);
            for k in 0..24 {
                let step = 1e-6;
                let mut at = |by: f64| {
                    let before = path[k];
                    path[k] += by;
                    let found = [
                        potential.loss(&path, 3.0, &mut unused),
                        potential.loss_of_published_code(&path, 3.0, 2.0, &mut unused, None),
                    ];
                    path[k] = before;
                    found
                };
                let (up, down) = (at(step), at(-step));
                for (which, exact) in [gradient[k], code[k]].into_iter().enumerate() {
                    let slope = (up[which] - down[which]) / (2.0 * step);
                    // The code's number of samples may change within a step.
                    let fits = (slope - exact).abs() < 1e-4 * exact.abs().max(10.0);
                    assert!(fits || which == 1 && slope.abs() > 1e4, "{slope} {exact}");
                }
            }
        }
    }

    #[test]
    fn curvatures_are_those_of_finite_differences() {
        let mut rng = seeded(2);
        let mut seen = 0;
        for potential in potentials() {
            for bump in &potential.bumps {
                for _ in 0..20 {
                    let place =
                        |k: usize, rng: &mut PlanRng| rng.random_range(bump.min[k]..bump.max[k]);
                    let (x, y) = (place(0, &mut rng), place(1, &mut rng));
                    let step = 1e-5;
                    let near_a_jump = (x - bump.peak[0]).abs().min((y - bump.peak[1]).abs()) < 1e-4;
                    let slope = |dx: f64, dy: f64| Some(bump.height(x + dx, y + dy)?.gradient);
                    let rise = |dx: f64, dy: f64| {
                        let (after, before) = (slope(dx, dy)?, slope(-dx, -dy)?);
                        Some([0, 1].map(|k| (after[k] - before[k]) / (2.0 * step)))
                    };
                    let (Some(by_x), Some(by_y)) = (rise(step, 0.0), rise(0.0, step)) else {
                        continue;
                    };
                    if near_a_jump {
                        continue;
                    }
                    let found = [by_x[0], by_x[1], by_y[1]];
                    let exact = bump.curvature(x, y).unwrap();
                    seen += 1;
                    for (a, b) in found.into_iter().zip(exact) {
                        assert!((a - b).abs() < 1e-5 * b.abs().max(10.0), "{a} {b}");
                    }
                }
            }
        }
        assert!(seen > 5000);
    }

    #[test]
    fn lanes_say_the_same() {
        let mut rng = seeded(3);
        for potential in potentials() {
            let path = any_path(&mut rng, 40);
            let (mut one, mut four) = (vec![0.0; 80], vec![0.0; 80]);
            let a = potential.loss(&path, 32.0, &mut one);
            let b = potential.loss_in_lanes(&path, 32.0, &mut four);
            assert!((a - b).abs() <= 1e-12 * a.abs(), "{a} {b}");
            let largest = one.iter().fold(1.0f64, |m, g| m.max(g.abs()));
            assert!(
                one.iter()
                    .zip(&four)
                    .all(|(a, b)| (a - b).abs() <= 1e-12 * largest)
            );
        }
    }
}
