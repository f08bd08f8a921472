//! The potential of bumps at four places at a time.

use super::{Bump, HEIGHT};
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

/// Samples inside of bumps, gathered until there are four: few samples of a path are, and nearly all the
/// work is theirs.
pub(super) struct Packed<'g> {
    lambda: f64,
    /// Of the whole path.
    gradient: &'g mut [f64],
    loss: f64,
    count: usize,
    /// By axis: where in its bump, -1 to 1, and how fast that changes.
    place: [[f64; 4]; 2],
    scale: [[f64; 4]; 2],
    /// The sample's share in its segment's second end.
    share: [f64; 4],
    /// Where in the path its segment begins.
    segment: [usize; 4],
}

/// The four samples of a segment.
pub(super) struct Samples {
    at: [f64x4; 2],
    segment: usize,
}

impl Samples {
    /// Of the segment that begins there in a path.
    #[inline]
    pub(super) fn of(path: &[f64], segment: usize) -> Self {
        let at = places(&path[segment..segment + 4], f64x4::new(SHARES));
        Self { at, segment }
    }
}

/// The samples' shares in their segment's second end.
pub(super) const SHARES: [f64; 4] = [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0];

/// By axis: where four shares of the way along a segment lie.
#[inline]
fn places(ends: &[f64], share: f64x4) -> [f64x4; 2] {
    [0, 1].map(|k| f64x4::splat(ends[k]) + share * f64x4::splat(ends[k + 2] - ends[k]))
}

impl<'g> Packed<'g> {
    pub(super) fn new(lambda: f64, gradient: &'g mut [f64]) -> Self {
        Self {
            lambda,
            gradient,
            loss: 0.0,
            count: 0,
            place: [[0.0; 4]; 2],
            scale: [[0.0; 4]; 2],
            share: [0.0; 4],
            segment: [0; 4],
        }
    }

    /// Takes those samples that are inside of a bump.
    #[inline]
    pub(super) fn take(&mut self, samples: &Samples, bump: &Bump) {
        let within = |k: usize| {
            samples.at[k].simd_gt(f64x4::splat(bump.min[k]))
                & samples.at[k].simd_lt(f64x4::splat(bump.max[k]))
        };
        let mut inside = (within(0) & within(1)).to_bitmask();
        if inside == 0 {
            return;
        }
        let at = samples.at.map(f64x4::to_array);
        while inside != 0 {
            let lane = inside.trailing_zeros() as usize;
            inside &= inside - 1;
            if self.count == 4 {
                self.flush(4);
            }
            for k in [0, 1] {
                let (place, scale) = bump.along(k, at[k][lane]);
                self.place[k][self.count] = place;
                self.scale[k][self.count] = scale;
            }
            self.share[self.count] = SHARES[lane];
            self.segment[self.count] = samples.segment;
            self.count += 1;
        }
    }

    /// Evaluates what there is, and begins anew.
    #[expect(clippy::inline_always, reason = "a tenth of the time")]
    #[inline(always)]
    fn flush(&mut self, count: usize) {
        let place = self.place.map(f64x4::new);
        let square = place[0] * place[0] + place[1] * place[1];
        let e = f64x4::splat(self.lambda * HEIGHT) * exp_minus(square);
        let (value, [gx, gy]) = height(e, place, self.scale.map(f64x4::new));
        let second = f64x4::new(self.share);
        let first = f64x4::ONE - second;
        let pulls = f64x4::transpose([first * gx, first * gy, second * gx, second * gy]);
        let value = value.to_array();
        // What is left over from an earlier four is not counted again.
        for lane in 0..count {
            self.loss += value[lane];
            let ends = &mut self.gradient[self.segment[lane]..][..4];
            for (into, pull) in ends.iter_mut().zip(pulls[lane].to_array()) {
                *into += pull;
            }
        }
        self.count = 0;
    }

    /// What all that was taken comes to.
    pub(super) fn close(mut self) -> f64 {
        self.flush(self.count);
        self.loss
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
    pub(super) fn add_lanes(
        &self,
        segment: &[f64],
        t: f64x4,
        kick: Option<&mut PlanRng>,
        sum: &mut Option<Lanes>,
    ) {
        let Some((value, [gx, gy])) = self.heights(places(segment, t), kick) else {
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
        let square = x2 + y2;
        // Outside nothing may overflow.
        let e = inside.select(
            f64x4::splat(HEIGHT) * exp_minus(square.fast_min(f64x4::splat(2.0))),
            zero,
        );
        let (value, [mut gx, mut gy]) = height(e, [nx, ny], [sx, sy]);
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
        Some((value, [gx, gy]))
    }
}

/// Heights and gradients at places in bumps, where the exponentials are these.
#[inline]
fn height(e: f64x4, [nx, ny]: [f64x4; 2], [sx, sy]: [f64x4; 2]) -> (f64x4, [f64x4; 2]) {
    let (one, two) = (f64x4::ONE, f64x4::splat(2.0));
    let (qx, qy) = (one - nx * nx, one - ny * ny);
    let both = e * qx * qy;
    let down = -two * both;
    let gx = down * qy * (nx * (qx + two) * sx);
    let gy = down * qx * (ny * (qy + two) * sy);
    (both * qx * qy, [gx, gy])
}

/// exp(-x) for x from 0 to 2: the eighth power of exp(-x/8), by its series about x = 1, in pairs of
/// terms that do not wait for each other (Estrin's scheme). A machine without fused instructions takes
/// twice as long for the general function.
#[inline]
fn exp_minus(x: f64x4) -> f64x4 {
    const CENTRE: f64 = 0.882_496_902_584_595_5;
    /// One over the factorials from 0 to 9, times the centre and the power of -1/8.
    const TERMS: [f64; 10] = {
        let mut terms = [CENTRE; 10];
        let (mut k, mut number) = (1, 1.0);
        while k < terms.len() {
            terms[k] = terms[k - 1] * -0.125 / number;
            (k, number) = (k + 1, number + 1.0);
        }
        terms
    };
    let y = x - f64x4::ONE;
    let pair = |k: usize| f64x4::splat(TERMS[k]) + f64x4::splat(TERMS[k + 1]) * y;
    let y2 = y * y;
    let four = |k: usize| pair(k) + y2 * pair(k + 2);
    let y4 = y2 * y2;
    let root = four(0) + y4 * (four(4) + y4 * pair(8));
    let square = root * root;
    let fourth = square * square;
    fourth * fourth
}
