//! Symmetric matrices in which a waypoint meets only the two before and the two after it.

/// How far from the diagonal there may be something.
const REACH: usize = 5;
const WIDTH: usize = REACH + 1;

/// The lower half of a symmetric matrix, row by row, the diagonal last.
#[derive(Clone, Debug, Default)]
pub(crate) struct Banded {
    size: usize,
    rows: Vec<[f64; WIDTH]>,
    factor: Vec<[f64; WIDTH]>,
}

impl Banded {
    /// A null matrix.
    pub(crate) fn reset(&mut self, size: usize) {
        self.size = size;
        self.rows.clear();
        self.rows.resize(size, [0.0; WIDTH]);
    }

    /// Adds to row `i`, column `j`, not above the diagonal and at most 5 off it.
    #[inline]
    pub(crate) fn add(&mut self, i: usize, j: usize, value: f64) {
        self.rows[i][j + REACH - i] += value;
    }

    /// Solves the system for `right`, in its place; `None` if the matrix, with `shift` added to its
    /// diagonal, is not positive definite. (Cholesky.)
    pub(crate) fn solve(&mut self, shift: f64, right: &mut [f64]) -> Option<()> {
        self.factor.clear();
        self.factor.resize(self.size, [0.0; WIDTH]);
        for i in 0..self.size {
            let mut row = self.rows[i];
            row[REACH] += shift;
            let first = i.saturating_sub(REACH);
            for j in first..i {
                let other = &self.factor[j];
                let mut value = row[j + REACH - i];
                for k in first.max(j.saturating_sub(REACH))..j {
                    value -= row[k + REACH - i] * other[k + REACH - j];
                }
                row[j + REACH - i] = value * other[REACH];
            }
            let square: f64 = row[..REACH].iter().map(|v| v * v).sum();
            let rest = row[REACH] - square;
            if rest.is_nan() || rest <= 1e-12 * row[REACH].abs() {
                return None;
            }
            // Its inverse, as that is what all want.
            row[REACH] = 1.0 / rest.sqrt();
            self.factor[i] = row;
        }
        for i in 0..self.size {
            let mut value = right[i];
            for k in i.saturating_sub(REACH)..i {
                value -= self.factor[i][k + REACH - i] * right[k];
            }
            right[i] = value * self.factor[i][REACH];
        }
        for i in (0..self.size).rev() {
            right[i] *= self.factor[i][REACH];
            let value = right[i];
            for k in i.saturating_sub(REACH)..i {
                right[k] -= self.factor[i][k + REACH - i] * value;
            }
        }
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_system_is_solved() {
        let mut matrix = Banded::default();
        matrix.reset(9);
        for i in 0..9usize {
            for j in i.saturating_sub(REACH)..=i {
                matrix.add(
                    i,
                    j,
                    if i == j {
                        9.0
                    } else {
                        1.0 / (1 + i + j) as f64
                    },
                );
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
        matrix.solve(0.0, &mut right).unwrap();
        assert!(
            right
                .iter()
                .zip(&wanted)
                .all(|(a, b)| (a - b).abs() < 1e-12)
        );
        assert!(matrix.solve(-10.0, &mut right).is_none());
    }
}
