use pf_core::Cost;
use std::{cmp::Ordering, f64::consts::SQRT_2, fmt, iter::Sum, ops::Add};

/// The exact cost of a path: `(straight + diagonal * sqrt 2) / 2`.
///
/// A step costs its length times the mean of the two cells' costs. Counted in half units that is
/// the *sum* of the two costs, an integer; on a grid without terrain every step counts 2. Costs are
/// compared by integers alone, so equal paths have equal costs and no rounding decides.
///
/// ```
/// # use pf_grid::GridCost;
/// let (a, b) = (GridCost::of_steps(7, 0), GridCost::of_steps(0, 5));
/// assert!(a < b && b.value() - a.value() < 0.08);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct GridCost {
    /// Sum of the two cells' costs over all straight steps.
    pub straight: u64,
    /// Sum of the two cells' costs over all diagonal steps.
    pub diagonal: u64,
}

impl GridCost {
    /// No step at all.
    pub const ZERO: Self = Self {
        straight: 0,
        diagonal: 0,
    };

    /// The cost of so many steps on a grid without terrain.
    #[must_use]
    pub const fn of_steps(straight: u64, diagonal: u64) -> Self {
        Self {
            straight: 2 * straight,
            diagonal: 2 * diagonal,
        }
    }

    /// The cost as a number, in cells.
    #[must_use]
    #[expect(
        clippy::cast_precision_loss,
        reason = "2^53 half units are far beyond any grid"
    )]
    pub fn value(self) -> f64 {
        f64::midpoint(self.straight as f64, self.diagonal as f64 * SQRT_2)
    }
}

impl Add for GridCost {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            straight: self.straight + other.straight,
            diagonal: self.diagonal + other.diagonal,
        }
    }
}

impl Sum for GridCost {
    fn sum<I: Iterator<Item = Self>>(costs: I) -> Self {
        costs.fold(Self::ZERO, Self::add)
    }
}

/// The sign of `s + d * sqrt 2`, by integers: where the signs differ, the squares decide.
impl Ord for GridCost {
    fn cmp(&self, other: &Self) -> Ordering {
        let s = i128::from(self.straight) - i128::from(other.straight);
        let d = i128::from(self.diagonal) - i128::from(other.diagonal);
        // No grid comes near 2^62 half units, so the squares fit.
        match (s.cmp(&0), d.cmp(&0)) {
            (Ordering::Greater, Ordering::Less) => (s * s).cmp(&(2 * d * d)),
            (Ordering::Less, Ordering::Greater) => (2 * d * d).cmp(&(s * s)),
            (Ordering::Equal, sign) | (sign, _) => sign,
        }
    }
}

impl PartialOrd for GridCost {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Cost for GridCost {
    fn no_worse_than(&self, other: &Self) -> bool {
        self <= other
    }
}

impl fmt::Display for GridCost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.value().fmt(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbouring_convergents_of_sqrt_2_are_told_apart() {
        // 47321/33461 < sqrt 2 < 114243/80782, and so on: nothing lies closer to sqrt 2.
        let cost = GridCost::of_steps;
        assert!(cost(47_321, 0) < cost(0, 33_461));
        assert!(cost(114_243, 0) > cost(0, 80_782));
        assert!(cost(318_281_039, 0) < cost(0, 225_058_681));
    }

    #[test]
    fn the_order_agrees_with_numbers_where_they_are_far_apart() {
        for (a, b, c, d) in (0..4096u64).map(|i| (i & 7, i >> 3 & 7, i >> 6 & 7, i >> 9)) {
            let (p, q) = (GridCost::of_steps(a, b), GridCost::of_steps(c, d));
            assert_eq!(p.cmp(&q), p.value().total_cmp(&q.value()), "{p:?} {q:?}");
        }
    }
}
