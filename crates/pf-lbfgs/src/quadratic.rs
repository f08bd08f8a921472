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
    if size < 12 {
        return loss(path, gradient);
    }
    let square = |v: f64| v * v;
    let mut loss = 0.0;
    // The two points at either end, where there is less to pull: steps and the bend seen from there.
    for axis in [0, 1] {
        let steps = [0, 2, 4].map(|k| path[k + 2 + axis] - path[k + axis]);
        let bends = [steps[1] - steps[0], steps[2] - steps[1]];
        gradient[axis] = 2.0 * (bends[0] - steps[0]);
        gradient[2 + axis] = 2.0 * (bends[1] - 3.0 * bends[0]);
        loss += square(steps[0]) + square(steps[1]) + square(bends[0]);
        let last = size - 2 + axis;
        let steps = [0, 2, 4].map(|k| path[last - 2 - k] - path[last - k]);
        let bends = [steps[1] - steps[0], steps[2] - steps[1]];
        gradient[last] = 2.0 * (bends[0] - steps[0]);
        gradient[last - 2] = 2.0 * (bends[1] - 3.0 * bends[0]);
        loss += square(steps[0]) + square(bends[0]);
    }
    let four = |at: usize| path[at..at + 4].try_into().map_or(f64x4::ZERO, f64x4::new);
    let (two, six) = (f64x4::splat(2.0), f64x4::splat(6.0));
    let (mut k, mut here) = (4, four(4));
    // The steps to here and from the one before.
    let mut to_here = here - four(2);
    let mut bend_before = to_here - (four(2) - four(0));
    let mut sum = f64x4::ZERO;
    while k + 8 <= size {
        let (next, after) = (four(k + 2), four(k + 4));
        let (step, next_step) = (next - here, after - next);
        let (bend, bend_after) = (step - to_here, next_step - step);
        sum += step * step + bend * bend;
        let pull = two * (bend_before + bend_after) - six * bend;
        gradient[k..k + 4].copy_from_slice(&pull.to_array());
        (here, to_here, bend_before) = (after, next_step, bend_after);
        k += 4;
    }
    for k in k..size - 4 {
        let steps = [0, 2, 4, 6].map(|by| path[k + by - 2] - path[k + by - 4]);
        let bends = [0, 1, 2].map(|i| steps[i + 1] - steps[i]);
        gradient[k] = 2.0 * (bends[0] + bends[2]) - 6.0 * bends[1];
        loss += square(steps[2]) + square(bends[1]);
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

#[cfg(test)]
mod tests {
    use super::*;
    use pf_conformance::seeded;
    use rand::RngExt;

    #[test]
    fn lanes_say_the_same_of_paths_of_any_length() {
        let mut rng = seeded(1);
        for points in 2..40 {
            let path: Vec<f64> = (0..2 * points)
                .map(|_| rng.random_range(0.0..9.0))
                .collect();
            let [mut one, mut four] = [(); 2].map(|()| vec![f64::NAN; path.len()]);
            let (a, b) = (loss(&path, &mut one), loss_in_lanes(&path, &mut four));
            assert!((a - b).abs() <= 1e-12 * a, "{points}: {a} {b}");
            let near = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-12 * 100.0;
            assert!(
                one.iter().zip(&four).all(near),
                "{points}: {one:?} {four:?}"
            );
        }
    }
}
