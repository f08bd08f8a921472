//! The part of the loss that asks for a short and smooth path: the sums of |P(i+1) - P(i)|^2 and of
//! |P(i+1) - 2 P(i) + P(i-1)|^2 (eq. 2, 3).

use crate::banded::Banded;

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
