//! Symmetric matrices in which a waypoint meets only the two before and the two after it.

/// How far from the diagonal there may be something.
const REACH: usize = 5;
const WIDTH: usize = REACH + 1;

/// The lower half of a symmetric matrix, row by row, the diagonal last.
#[derive(Clone, Debug, Default)]
pub(crate) struct Banded {
    rows: Vec<[f64; WIDTH]>,
    /// Its root, after as many empty rows as one row reaches back; so in `work`.
    root: Vec<[f64; WIDTH]>,
    work: Vec<f64>,
}

impl Banded {
    /// A null matrix.
    pub(crate) fn reset(&mut self, size: usize) {
        self.rows.clear();
        self.rows.resize(size, [0.0; WIDTH]);
    }

    /// Adds to row `i`, column `j`, not above the diagonal and at most 5 off it.
    #[inline]
    pub(crate) fn add(&mut self, i: usize, j: usize, value: f64) {
        self.rows[i][j + REACH - i] += value;
    }

    /// Solves the system for `right`, in its place; `None` if the matrix is not positive definite.
    /// (Cholesky.)
    pub(crate) fn solve(&mut self, right: &mut [f64]) -> Option<()> {
        self.root.clear();
        self.root.resize(REACH, [0.0; WIDTH]);
        self.work.clear();
        self.work.resize(REACH, 0.0);
        for (i, (&row, value)) in self.rows.iter().zip(&*right).enumerate() {
            let row = next_row(row, &self.root[i..])?;
            let known = &self.work[i..];
            let sum: f64 = row[..REACH].iter().zip(known).map(|(a, b)| a * b).sum();
            self.work.push((value - sum) * row[REACH]);
            self.root.push(row);
        }
        for (i, value) in right.iter_mut().enumerate().rev() {
            let row = &self.root[i + REACH];
            *value = self.work[i + REACH] * row[REACH];
            for (rest, a) in self.work[i..].iter_mut().zip(&row[..REACH]) {
                *rest -= a * *value;
            }
        }
        Some(())
    }
}

/// A row of the root, from the matrix's and the rows before it; the diagonal is its inverse, as that
/// is what all want.
#[inline]
fn next_row(mut row: [f64; WIDTH], before: &[[f64; WIDTH]]) -> Option<[f64; WIDTH]> {
    let whole = row[REACH];
    for (j, other) in before.iter().take(REACH).enumerate() {
        let mut value = row[j];
        for k in 0..j {
            value -= row[k] * other[k + REACH - j];
        }
        row[j] = value * other[REACH];
        row[REACH] -= row[j] * row[j];
    }
    if row[REACH].is_nan() || row[REACH] <= 1e-12 * whole.abs() {
        return None;
    }
    row[REACH] = 1.0 / row[REACH].sqrt();
    Some(row)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::class::ratio;

    #[test]
    fn a_system_is_solved() {
        let mut matrix = Banded::default();
        matrix.reset(9);
        for i in 0..9usize {
            for j in i.saturating_sub(REACH)..=i {
                let value = if i == j { 9.0 } else { ratio(1, 1 + i + j) };
                matrix.add(i, j, value);
            }
        }
        let wanted: Vec<f64> = (0..9).map(|k| f64::from(k) - 3.0).collect();
        let entry = |i: usize, j: usize| {
            let (i, j) = (i.max(j), i.min(j));
            if i - j > REACH {
                0.0
            } else {
                matrix.rows[i][j + REACH - i]
            }
        };
        let mut right: Vec<f64> = (0..9)
            .map(|i| (0..9).map(|j| entry(i, j) * wanted[j]).sum())
            .collect();
        matrix.solve(&mut right).unwrap();
        assert!(
            right
                .iter()
                .zip(&wanted)
                .all(|(a, b)| (a - b).abs() < 1e-12)
        );
        matrix.add(4, 4, -10.0);
        assert!(matrix.solve(&mut right).is_none());
    }
}
