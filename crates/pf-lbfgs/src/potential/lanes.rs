//! The potential of a bump at four places at a time.

use super::{Bump, HEIGHT, SAMPLES};
use pf_core::PlanRng;
use rand::RngExt;
use wide::f64x4;

/// Where the published code adds noise: at squares of (nx, ny) below this, up to so much either way.
const PEAK: f64 = 0.01;
const NOISE: f64 = 50.0;

/// Four samples, or samples of four segments, at a time.
#[derive(Clone, Copy, Default)]
pub(super) struct Lanes {
    pub(super) value: f64x4,
    /// Gradient times the sample's share in the segment's ends: x and y of the first, of the second.
    pub(super) gradient: [f64x4; 4],
}

/// Four segments of a path.
pub(super) struct Four {
    /// By axis: where they begin, and what leads to where they end.
    pub(super) from: [f64x4; 2],
    pub(super) along: [f64x4; 2],
    /// What holds them all.
    pub(super) min: [f64; 2],
    pub(super) max: [f64; 2],
}

/// A place that no bump reaches, from where the arithmetic stays finite.
const NOWHERE: f64 = 1e20;

impl Four {
    /// The first four of a path, or as many as it has.
    pub(super) fn of(path: &[f64]) -> Self {
        let points = (path.len() / 2).min(5);
        let axis = |k: usize| {
            let at = |n: usize| path[2 * n + k];
            let mut from = [NOWHERE; 4];
            let mut along = [0.0; 4];
            let (mut min, mut max) = (at(0), at(0));
            for n in 1..points {
                from[n - 1] = at(n - 1);
                along[n - 1] = at(n) - at(n - 1);
                // Not f64::min, which minds NaN: three instructions more.
                min = if at(n) < min { at(n) } else { min };
                max = if at(n) > max { at(n) } else { max };
            }
            (f64x4::new(from), f64x4::new(along), min, max)
        };
        let (x, y) = (axis(0), axis(1));
        Self {
            from: [x.0, y.0],
            along: [x.1, y.1],
            min: [x.2, y.2],
            max: [x.3, y.3],
        }
    }
}

impl Lanes {
    /// Adds what four samples of one segment come to.
    pub(super) fn add_to(self, lambda: f64, gradient: &mut [f64]) -> f64 {
        for (into, lanes) in gradient.iter_mut().zip(self.gradient) {
            *into += lambda * lanes.reduce_add();
        }
        lambda * self.value.reduce_add()
    }
}

impl Bump {
    #[inline]
    pub(super) fn add_four(&self, four: &Four, sum: &mut Lanes) {
        for k in 0..SAMPLES {
            let t = f64::from(k) / f64::from(SAMPLES - 1);
            let at = [0, 1].map(|axis| four.from[axis] + f64x4::splat(t) * four.along[axis]);
            let Some((value, [gx, gy])) = self.heights(at, None) else {
                continue;
            };
            let (first, second) = (f64x4::splat(1.0 - t), f64x4::splat(t));
            sum.value += value;
            for (into, share) in
                sum.gradient
                    .iter_mut()
                    .zip([first * gx, first * gy, second * gx, second * gy])
            {
                *into += share;
            }
        }
    }

    #[inline]
    pub(super) fn add_lanes(
        &self,
        segment: &[f64],
        t: f64x4,
        kick: Option<&mut PlanRng>,
        sum: &mut Option<Lanes>,
    ) {
        let at = [0, 1]
            .map(|k| f64x4::splat(segment[k]) + t * f64x4::splat(segment[k + 2] - segment[k]));
        let Some((value, [gx, gy])) = self.heights(at, kick) else {
            return;
        };
        let first = f64x4::ONE - t;
        let sum = sum.get_or_insert_with(Lanes::default);
        sum.value += value;
        for (into, share) in sum
            .gradient
            .iter_mut()
            .zip([first * gx, first * gy, t * gx, t * gy])
        {
            *into += share;
        }
    }

    /// The height at four places and its gradient, with noise if somebody gives it chance; `None`
    /// if none is inside.
    #[inline]
    fn heights(&self, at: [f64x4; 2], kick: Option<&mut PlanRng>) -> Option<(f64x4, [f64x4; 2])> {
        let along = |k: usize| {
            let from = at[k] - f64x4::splat(self.peak[k]);
            let scale = from
                .simd_lt(f64x4::ZERO)
                .select(f64x4::splat(self.below[k]), f64x4::splat(self.above[k]));
            (from * scale, scale)
        };
        let ((nx, sx), (ny, sy)) = (along(0), along(1));
        let (x2, y2) = (nx * nx, ny * ny);
        let one = f64x4::ONE;
        let inside = x2.simd_lt(one) & y2.simd_lt(one);
        if inside.none() {
            return None;
        }
        let zero = f64x4::ZERO;
        let (qx, qy) = (one - x2, one - y2);
        let square = x2 + y2;
        // Outside nothing may overflow.
        let e = inside.select(
            f64x4::splat(HEIGHT) * exp_minus(square.fast_min(f64x4::splat(2.0))),
            zero,
        );
        let (px, py) = (qx * qx, qy * qy);
        let two = f64x4::splat(2.0);
        let down = -two * e;
        let mut gx = down * nx * qx * (qx + two) * py * sx;
        let mut gy = down * ny * qy * (qy + two) * px * sy;
        if let Some(rng) = kick {
            let at_peak = (f64x4::splat(PEAK) - square).simd_gt(zero);
            if at_peak.any() {
                let mut noise = || {
                    at_peak.select(
                        f64x4::new([(); 4].map(|()| rng.random_range(-NOISE..NOISE))),
                        zero,
                    )
                };
                gx += noise();
                gy += noise();
            }
        }
        Some((e * px * py, [gx, gy]))
    }
}

/// exp(-x) for x from 0 to 2: the fourth power of exp(-x/4), by its series about x = 1. A machine
/// without fused instructions takes twice as long for the general function.
#[inline]
fn exp_minus(x: f64x4) -> f64x4 {
    const CENTRE: f64 = 0.778_800_783_071_404_9;
    let y = f64x4::splat(0.25) - f64x4::splat(0.25) * x;
    let mut series = f64x4::ONE;
    for k in (1..=11).rev() {
        series = f64x4::ONE + y * f64x4::splat(1.0 / f64::from(k)) * series;
    }
    let root = series * f64x4::splat(CENTRE);
    let square = root * root;
    square * square
}
