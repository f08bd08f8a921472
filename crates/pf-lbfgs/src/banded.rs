//! Symmetric matrices in which a waypoint meets only the two before and the two after it.

use wide::f64x2;

/// How far from the diagonal there may be something.
const REACH: usize = 5;
const WIDTH: usize = REACH + 1;
/// Less than this share of the diagonal is nothing.
const SMALLEST: f64 = 1e-12;

/// The lower half of a symmetric matrix, column by column, the diagonal first.
#[derive(Clone, Debug, Default)]
pub(crate) struct Banded {
    columns: Vec<[f64; WIDTH]>,
    /// Columns and unknowns from the first on, and from the last back, beside each other.
    both: Vec<[f64x2; WIDTH]>,
    known: Vec<f64x2>,
}

impl Banded {
    /// A null matrix.
    pub(crate) fn reset(&mut self, size: usize) {
        self.columns.clear();
        self.columns.resize(size, [0.0; WIDTH]);
    }

    /// Adds to row `i`, column `j`, not above the diagonal and at most 5 off it.
    #[inline]
    pub(crate) fn add(&mut self, i: usize, j: usize, value: f64) {
        self.columns[j][i - j] += value;
    }

    /// Solves the system for `right`, in its place; `None` if the matrix is not positive definite.
    ///
    /// Cholesky without roots, from both ends at once: a column waits for the one before it, so two that
    /// do not wait for each other take half the time. (Twisted factorization.)
    pub(crate) fn solve(&mut self, right: &mut [f64]) -> Option<()> {
        let size = right.len();
        let half = size.saturating_sub(REACH) / 2;
        let middle = size - 2 * half;
        self.pair_up(right, half + middle);
        for k in 0..half {
            let whole = [self.columns[k][0], self.columns[size - 1 - k][0]];
            eliminate(whole, &mut self.both[k..], &mut self.known[k..])?;
        }
        // What both ends leave of the middle: each has subtracted its share from all of it.
        let columns = &self.columns[half..];
        let (both, known) = (&mut self.both[half..], &mut self.known[half..]);
        let old = |k: usize| right[half + k];
        let mut rest = [[f64x2::ZERO; WIDTH]; 2 * WIDTH];
        let mut left = [f64x2::ZERO; 2 * WIDTH];
        for j in 0..middle {
            for i in 0..middle - j {
                let [ahead, back] = [
                    both[j][i].to_array()[0],
                    both[middle - 1 - j - i][i].to_array()[1],
                ];
                rest[j][i] = f64x2::splat(ahead + back - columns[j][i]);
            }
            let [ahead, back] = [known[j].to_array()[0], known[middle - 1 - j].to_array()[1]];
            left[j] = f64x2::splat(ahead + back - old(j));
        }
        for k in 0..middle {
            eliminate([columns[k][0]; 2], &mut rest[k..], &mut left[k..])?;
        }
        for k in (0..middle).rev() {
            substitute(&rest[k], &mut left[k..]);
        }
        for k in 0..middle {
            let [there, back] = [left[k], left[middle - 1 - k]].map(|v| v.to_array()[0]);
            known[k] = f64x2::new([there, back]);
            right[half + k] = there;
        }
        for k in (0..half).rev() {
            substitute(&self.both[k], &mut self.known[k..]);
            [right[k], right[size - 1 - k]] = self.known[k].to_array();
        }
        Some(())
    }

    /// Puts the first so many columns, and the last ones mirrored, beside each other.
    fn pair_up(&mut self, right: &[f64], count: usize) {
        let size = right.len();
        let columns = &self.columns;
        self.both.clear();
        self.both.extend((0..count).map(|k| {
            std::array::from_fn(|i| {
                let back = (size - 1 - k).checked_sub(i).map_or(0.0, |j| columns[j][i]);
                f64x2::new([columns[k][i], back])
            })
        }));
        self.both.resize(count + REACH, [f64x2::ZERO; WIDTH]);
        self.known.clear();
        self.known
            .extend((0..count).map(|k| f64x2::new([right[k], right[size - 1 - k]])));
        self.known.resize(count + REACH, f64x2::ZERO);
    }
}

/// Takes the first unknown out of the others' columns. In its own stay one over what was left of the
/// diagonal, and the shares in the others.
#[inline]
fn eliminate(whole: [f64; 2], columns: &mut [[f64x2; WIDTH]], known: &mut [f64x2]) -> Option<()> {
    let (columns, _) = columns.split_first_chunk_mut::<WIDTH>()?;
    let (known, _) = known.split_first_chunk_mut::<WIDTH>()?;
    let [first, others @ ..] = columns;
    let least = f64x2::splat(SMALLEST) * f64x2::new(whole).abs();
    if !first[0].simd_gt(least).all() {
        return None;
    }
    let inverse = f64x2::ONE / first[0];
    let old = *first;
    first[0] = inverse;
    for i in 1..WIDTH {
        let share = old[i] * inverse;
        for j in i..WIDTH {
            others[i - 1][j - i] -= share * old[j];
        }
        known[i] -= share * known[0];
        first[i] = share;
    }
    known[0] *= inverse;
    Some(())
}

/// The first unknown, where the others are known.
#[inline]
fn substitute(column: &[f64x2; WIDTH], known: &mut [f64x2]) {
    for i in 1..WIDTH {
        known[0] -= column[i] * known[i];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::class::ratio;

    #[test]
    fn a_system_is_solved() {
        for size in 0..40 {
            let mut matrix = Banded::default();
            matrix.reset(size);
            for i in 0..size {
                for j in i.saturating_sub(REACH)..=i {
                    let value = if i == j { 9.0 } else { ratio(1, 1 + i + j) };
                    matrix.add(i, j, value);
                }
            }
            let wanted: Vec<f64> = (0..size).map(|k| ratio(k, 1) - 3.0).collect();
            let entry = |i: usize, j: usize| {
                let (i, j) = (i.max(j), i.min(j));
                matrix.columns[j].get(i - j).copied().unwrap_or(0.0)
            };
            let mut right: Vec<f64> = (0..size)
                .map(|i| (0..size).map(|j| entry(i, j) * wanted[j]).sum())
                .collect();
            matrix.solve(&mut right).unwrap();
            let near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-12 * ratio(size, 1);
            assert!(right.iter().zip(&wanted).all(near), "{size}: {right:?}");
            for k in 0..size {
                let mut matrix = matrix.clone();
                matrix.add(k, k, -10.0);
                assert!(matrix.solve(&mut right).is_none(), "{k} of {size}");
            }
        }
    }
}
