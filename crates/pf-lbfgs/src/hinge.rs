//! The square of what is missing at a distance: segments against shapes, points against the bounds.

use crate::{
    banded::Banded,
    class::corners,
    newton::Loss,
    quadratic,
    solid::{Solids, Touch},
};
use pf_geom::Rectangle;

/// Keeps a path at a distance from all figures, and within the bounds.
#[derive(Clone, Debug, Default)]
pub(crate) struct Hinge {
    pub(crate) solids: Solids,
    pub(crate) bounds: Option<Rectangle>,
    /// How far to keep.
    pub(crate) distance: f64,
    /// What a missing unit costs, squared.
    pub(crate) weight: f64,
    /// Which figures may matter to which segment: pairs of both, as long as no point is further than
    /// `slack` from where it was then.
    pairs: Vec<(u32, u32)>,
    listed_at: Vec<f64>,
    listed_for: f64,
    slack: f64,
    /// What was lacking, or nearly, when the loss was last asked for.
    lacks: Vec<Lack>,
}

/// Where how much is missing, or, below 0, to spare.
#[derive(Clone, Copy, Debug)]
struct Lack {
    segment: usize,
    much: f64,
    touch: Touch,
    /// Whether the curvature counts it.
    counts: bool,
}

/// How far beyond the distance a step looks ahead, as a share of the slack: what is further lies in other
/// directions by the time a step is there.
const AHEAD: f64 = 0.05;
/// So many segments are first looked at as one.
const GROUP: usize = 8;

impl Hinge {
    /// Forgets which figures are near: the world or the path is another.
    pub(crate) fn begin(&mut self, slack: f64) {
        self.listed_at.clear();
        self.slack = slack;
    }

    fn list(&mut self, path: &[f64]) {
        let moved = |(a, b): (&f64, &f64)| (a - b).abs() <= self.slack;
        if self.listed_at.len() == path.len()
            && self.listed_for >= self.distance
            && path.iter().zip(&self.listed_at).all(moved)
        {
            return;
        }
        self.listed_at.clear();
        self.listed_at.extend_from_slice(path);
        self.listed_for = self.distance;
        self.pairs.clear();
        let reach = self.distance + self.slack;
        let segments = path.len() / 2 - 1;
        for first in (0..segments).step_by(GROUP) {
            let some = first..segments.min(first + GROUP);
            let (min, max) = corners(&path[2 * first..=2 * some.end + 1]);
            for solid in 0..self.solids.len() {
                if !self.solids.is_near(solid, min, max, reach) {
                    continue;
                }
                for segment in some.clone() {
                    let (a, b) = ends(path, segment);
                    if self.solids.is_near(solid, a, b, reach) {
                        self.pairs.push((index(segment), index(solid)));
                    }
                }
            }
        }
    }

    /// Finds every lack, and what nearly is one.
    fn look(&mut self, path: &[f64]) {
        self.list(path);
        self.lacks.clear();
        let distance = self.distance;
        let reach = distance + AHEAD * self.slack;
        for &(segment, solid) in &self.pairs {
            let (segment, solid) = (segment as usize, solid as usize);
            let (a, b) = ends(path, segment);
            if !self.solids.is_near(solid, a, b, reach) {
                continue;
            }
            self.solids.each_touch(solid, a, b, reach, |touch| {
                let much = distance - touch.distance;
                self.lacks.push(Lack {
                    segment,
                    much,
                    touch,
                    counts: much > 0.0,
                });
            });
        }
    }

    /// By how much each coordinate of an inner point is out of bounds.
    fn each_excess(&self, path: &[f64], mut excess: impl FnMut(usize, f64)) {
        let Some(bounds) = &self.bounds else { return };
        let inner = path.iter().enumerate().take(path.len() - 2).skip(2);
        for (k, value) in inner {
            let (min, max) = (bounds.min()[k % 2], bounds.max()[k % 2]);
            let over = value - value.clamp(min, max);
            if over != 0.0 {
                excess(k, over);
            }
        }
    }
}

fn ends(path: &[f64], segment: usize) -> ([f64; 2], [f64; 2]) {
    let k = 2 * segment;
    ([path[k], path[k + 1]], [path[k + 2], path[k + 3]])
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "as many of anything fit no memory"
)]
fn index(k: usize) -> u32 {
    k as u32
}

impl Loss for Hinge {
    fn loss(&mut self, path: &[f64], gradient: &mut [f64]) -> f64 {
        let mut loss = quadratic::loss_in_lanes(path, gradient);
        let weight = self.weight;
        self.look(path);
        for Lack {
            segment,
            much,
            touch,
            ..
        } in self.lacks.iter().filter(|lack| lack.counts)
        {
            loss += weight * much * much;
            for (k, share) in [(0, 1.0 - touch.at), (2, touch.at)] {
                for (axis, out) in touch.out.iter().enumerate() {
                    gradient[2 * segment + k + axis] -= 2.0 * weight * much * share * out;
                }
            }
        }
        self.each_excess(path, |k, over| {
            loss += weight * over * over;
            gradient[k] += 2.0 * weight * over;
        });
        loss
    }

    /// Without the bend of the distances themselves (Gauss and Newton), so it is positive definite.
    fn curvature(&mut self, path: &[f64], _cautious: bool, matrix: &mut Banded) {
        let points = path.len() / 2 - 2;
        quadratic::curvature(matrix, points);
        let weight = 2.0 * self.weight;
        for Lack { segment, touch, .. } in self.lacks.iter().filter(|lack| lack.counts) {
            let [x, y] = touch.out;
            let outer = [x * x, x * y, y * y].map(|v| v * weight);
            add_outer(matrix, points, *segment, touch.at, outer);
        }
        self.each_excess(path, |k, _| matrix.add(k - 2, k - 2, weight));
    }

    /// Without this a step runs into figures beside those that it minds, and is cut to nearly nothing.
    fn look_ahead(&mut self, step: &[f64], downhill: &mut [f64]) -> bool {
        let mut more = false;
        for lack in &mut self.lacks {
            let Touch { at, out, .. } = lack.touch;
            let ends = [(0, 1.0 - at), (1, at)].map(|(end, share)| {
                inner(lack.segment + end, step.len() / 2).map(|place| (place, share))
            });
            if !lack.counts {
                let away = |(k, share)| share * (out[0] * step[k] + out[1] * step[k + 1]);
                lack.counts = lack.much > ends.into_iter().flatten().map(away).sum();
                more |= lack.counts;
            }
            if lack.counts && lack.much <= 0.0 {
                for (k, share) in ends.into_iter().flatten() {
                    for axis in [0, 1] {
                        downhill[k + axis] += 2.0 * self.weight * lack.much * share * out[axis];
                    }
                }
            }
        }
        more
    }
}

/// Where a point of a path has its numbers among those of so many inner points; the path's ends are none
/// of them.
fn inner(point: usize, points: usize) -> Option<usize> {
    (1..=points).contains(&point).then(|| 2 * (point - 1))
}

/// Adds xx, xy, yy at a place of a segment, shared out to its ends, to the rows of inner points.
pub(crate) fn add_outer(
    matrix: &mut Banded,
    points: usize,
    segment: usize,
    at: f64,
    [xx, xy, yy]: [f64; 3],
) {
    let inner = |end: usize| inner(segment + end, points);
    let shares = [1.0 - at, at];
    for (end, share) in shares.iter().enumerate() {
        let Some(row) = inner(end) else { continue };
        let square = share * share;
        matrix.add(row, row, square * xx);
        matrix.add(row + 1, row, square * xy);
        matrix.add(row + 1, row + 1, square * yy);
    }
    if let (Some(first), Some(second)) = (inner(0), inner(1)) {
        let both = shares[0] * shares[1];
        matrix.add(second, first, both * xx);
        matrix.add(second, first + 1, both * xy);
        matrix.add(second + 1, first, both * xy);
        matrix.add(second + 1, first + 1, both * yy);
    }
}
