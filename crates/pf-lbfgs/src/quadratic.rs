//! The part of the loss that asks for a short and smooth path: the sums of |P(i+1) - P(i)|^2 and of
//! |P(i+1) - 2 P(i) + P(i-1)|^2 (eq. 2, 3).

use crate::banded::Banded;
use wide::f64x4;

/// The sum of both, and its gradient, which takes the place of what `gradient` held.
pub(crate) fn loss(path: &[f64], gradient: &mut [f64]) -> f64 {
    gradient.fill(0.0);
    let mut loss = 0.0;
    for k in 0..path.len() - 2 {
        let step = path[k + 2] - path[k];
        loss += step * step;
        gradient[k] -= 2.0 * step;
        gradient[k + 2] += 2.0 * step;
    }
    for k in 2..path.len() - 2 {
        let bend = path[k + 2] - 2.0 * path[k] + path[k - 2];
        loss += bend * bend;
        gradient[k - 2] += 2.0 * bend;
        gradient[k] -= 4.0 * bend;
        gradient[k + 2] += 2.0 * bend;
    }
    loss
}

/// The same, four coordinates at a time.
pub(crate) fn loss_in_lanes(path: &[f64], gradient: &mut [f64]) -> f64 {
    let size = path.len();
    let step = |k: usize| path[k + 2] - path[k];
    let bend = |k: usize| step(k) - step(k - 2);
    let square = |v: f64| v * v;
    // Of what pulls at a coordinate near an end some is missing.
    let at_end = |k: usize| {
        let step = |k: usize| if k + 2 < size { step(k) } else { 0.0 };
        let bend = |k: usize| if k >= 2 && k + 2 < size { bend(k) } else { 0.0 };
        let before = if k >= 2 {
            step(k - 2) + bend(k - 2)
        } else {
            0.0
        };
        2.0 * (before - step(k) - 2.0 * bend(k) + bend(k + 2))
    };
    let middle = 4.min(size)..size.saturating_sub(4).max(4.min(size));
    let (mut loss, mut k) = (0.0, middle.start);
    let mut sum = f64x4::ZERO;
    let four = |at: usize| path[at..at + 4].try_into().map_or(f64x4::ZERO, f64x4::new);
    let two = f64x4::splat(2.0);
    while k + 4 <= middle.end {
        let around = [k - 4, k - 2, k, k + 2, k + 4].map(four);
        let steps = [0, 1, 2, 3].map(|i| around[i + 1] - around[i]);
        let bends = [0, 1, 2].map(|i| steps[i + 1] - steps[i]);
        sum += steps[2] * steps[2] + bends[1] * bends[1];
        let pull = two * (bends[0] - two * bends[1] + bends[2] - bends[1]);
        gradient[k..k + 4].copy_from_slice(&pull.to_array());
        k += 4;
    }
    for k in (0..middle.start).chain(k..size) {
        gradient[k] = at_end(k);
        if k + 2 < size {
            loss += square(step(k));
            if k >= 2 {
                loss += square(bend(k));
            }
        }
    }
    loss + sum.reduce_add()
}

/// The matrix of second derivatives by the inner points, which takes the place of what `matrix`
/// held.
pub(crate) fn curvature(matrix: &mut Banded, points: usize) {
    matrix.reset(2 * points);
    for k in 0..points {
        // The bends at an end are of inner points only, with weight 1 for the neighbour of the end.
        let inner = usize::from(k > 0) + usize::from(k + 1 < points);
        let diagonal = 4.0
            + 8.0
            + if inner == 2 {
                4.0
            } else if inner == 1 {
                2.0
            } else {
                0.0
            };
        for i in [2 * k, 2 * k + 1] {
            matrix.add(i, i, diagonal);
            if k >= 1 {
                matrix.add(i, i - 2, -2.0 - 8.0);
            }
            if k >= 2 {
                matrix.add(i, i - 4, 2.0);
            }
        }
    }
}
