//! On which side of what a path passes, and how a path is laid out in points.

use crate::solid::Solids;
use pf_geom::Point;

/// Whether two paths with the same ends pass every figure on the same side: as often to the left of
/// its middle as to the right, whatever it takes to get there.
pub(crate) fn same_class(solids: &Solids, one: &[f64], other: &[f64]) -> bool {
    solids
        .middles()
        .all(|middle| crossings(one, middle) == crossings(other, middle))
}

/// How often a path crosses the ray from a point to the right, upwards less downwards.
fn crossings(path: &[f64], [x, y]: [f64; 2]) -> i32 {
    let mut count = 0;
    for k in (0..path.len() - 2).step_by(2) {
        let [ax, ay, bx, by] = [path[k], path[k + 1], path[k + 2], path[k + 3]];
        if (ay > y) != (by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax) {
            count += if by > y { 1 } else { -1 };
        }
    }
    count
}

/// Drops corners that are nearer than `step` to the last one that stays; the ends stay.
pub(crate) fn thin(corners: &mut Vec<Point>, step: f64) {
    let Some(last) = corners.pop() else { return };
    corners.dedup_by(|next, kept| (*next - *kept).norm() < step);
    corners.push(last);
}

/// Puts a polyline into `path` with `inner` inner points, or as many as it has, if that is more: all
/// its corners, and the rest evenly in between.
pub(crate) fn lay(corners: &[Point], inner: usize, path: &mut Vec<f64>) {
    let pieces = corners.len() - 1;
    let extra = inner.saturating_sub(pieces - 1);
    let total: f64 = corners.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
    path.clear();
    let (mut so_far, mut used) = (0.0, 0);
    for (k, pair) in corners.windows(2).enumerate() {
        so_far += (pair[1] - pair[0]).norm();
        let share = if total > 0.0 { so_far / total } else { 1.0 };
        let upto = if k + 1 == pieces {
            extra
        } else {
            part(extra, share)
        };
        let here = upto.saturating_sub(used);
        used = used.max(upto);
        for j in 0..=here {
            let at = pair[0] + (pair[1] - pair[0]) * ratio(j, here + 1);
            path.extend([at.x, at.y]);
        }
    }
    let last = corners[pieces];
    path.extend([last.x, last.y]);
}

/// Puts so many points, ends included, evenly along a flat path into `path`.
pub(crate) fn respace(along: &[f64], count: usize, path: &mut Vec<f64>) {
    let step = length(along) / ratio(count.max(2) - 1, 1);
    path.clear();
    path.extend(&along[..2]);
    let mut so_far = 0.0;
    for k in (0..along.len() - 2).step_by(2) {
        let ends = &along[k..k + 4];
        let piece = length(ends);
        // The end itself is put there last, whatever rounding makes of it.
        while path.len() / 2 + 1 < count && step * ratio(path.len() / 2, 1) <= so_far + piece {
            let t = if piece > 0.0 {
                (step * ratio(path.len() / 2, 1) - so_far) / piece
            } else {
                0.0
            };
            path.extend([0, 1].map(|axis| ends[axis] + t * (ends[axis + 2] - ends[axis])));
        }
        so_far += piece;
    }
    let last = &along[along.len() - 2..];
    while path.len() / 2 < count {
        path.extend(last);
    }
}

#[expect(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "numbers of points"
)]
fn part(of: usize, share: f64) -> usize {
    (of as f64 * share).round() as usize
}

#[expect(clippy::cast_precision_loss, reason = "numbers of points")]
pub(crate) fn ratio(k: usize, of: usize) -> f64 {
    k as f64 / of as f64
}

/// The length of a flat path.
pub(crate) fn length(path: &[f64]) -> f64 {
    let piece = |k: usize| (path[k + 2] - path[k]).hypot(path[k + 3] - path[k + 1]);
    (0..path.len() - 2).step_by(2).map(piece).sum()
}

/// The corners of what holds all points of a flat path.
pub(crate) fn corners(points: &[f64]) -> ([f64; 2], [f64; 2]) {
    let (mut min, mut max) = ([points[0], points[1]], [points[0], points[1]]);
    for point in points.chunks_exact(2) {
        for k in [0, 1] {
            // Not f64::min, which minds NaN: three instructions more.
            min[k] = if point[k] < min[k] { point[k] } else { min[k] };
            max[k] = if point[k] > max[k] { point[k] } else { max[k] };
        }
    }
    (min, max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use pf_geom::{Circle, Rectangle, World};

    #[test]
    fn sides_are_told_apart() {
        let corner = |v: f64| Point::new(v, v);
        let bounds = Rectangle::new(corner(-9.0), corner(9.0)).unwrap();
        let circle = Circle::new(Point::origin(), 1.0).unwrap();
        let mut solids = Solids::default();
        solids.fill(&World::with_shapes(bounds, [circle.into()]));
        let above = [-3.0, 0.0, 0.0, 2.0, 3.0, 0.0];
        let further = [-3.0, 0.0, -5.0, 5.0, 5.0, 8.0, 3.0, 0.0];
        let below = [-3.0, 0.0, 0.0, -2.0, 3.0, 0.0];
        assert!(same_class(&solids, &above, &further));
        assert!(!same_class(&solids, &above, &below));
        let around = [
            -3.0, 0.0, 0.0, 2.0, 2.0, 0.0, 0.0, -2.0, -2.0, 0.0, 0.0, 2.0, 3.0, 0.0,
        ];
        assert!(!same_class(&solids, &above, &around));
    }

    #[test]
    fn points_are_spread_evenly() {
        let along = [0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 4.0, 0.0, 4.0, 4.0];
        let mut path = vec![];
        respace(&along, 5, &mut path);
        assert_eq!(path, [0.0, 0.0, 2.0, 0.0, 4.0, 0.0, 4.0, 2.0, 4.0, 4.0]);
        respace(&along, 2, &mut path);
        assert_eq!(path, [0.0, 0.0, 4.0, 4.0]);
        respace(&[1.0, 1.0, 1.0, 1.0], 3, &mut path);
        assert_eq!(path, [1.0; 6]);
        for count in 2..200 {
            respace(&along, count, &mut path);
            assert_eq!(
                (path.len(), &path[2 * count - 2..]),
                (2 * count, &[4.0, 4.0][..])
            );
        }
    }

    #[test]
    fn corners_stay_and_the_rest_is_even() {
        let corners = [(0.0, 0.0), (9.0, 0.0), (9.0, 3.0)].map(|(x, y)| Point::new(x, y));
        let mut path = vec![];
        lay(&corners, 3, &mut path);
        assert_eq!(path, [0.0, 0.0, 3.0, 0.0, 6.0, 0.0, 9.0, 0.0, 9.0, 3.0]);
        lay(&corners, 1, &mut path);
        assert_eq!(path.len(), 6);
        lay(&[corners[0], corners[0]], 2, &mut path);
        assert_eq!(path, [0.0; 8]);
    }
}
