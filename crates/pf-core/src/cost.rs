//! How good a solution is.

use std::fmt::Debug;

/// How good a solution is, under an order that need not be total.
pub trait Cost: Clone + Debug {
    /// Whether `self` is at least as good as `other`.
    fn no_worse_than(&self, other: &Self) -> bool;

    /// Whether `self` is strictly better than `other`.
    fn beats(&self, other: &Self) -> bool {
        self.no_worse_than(other) && !other.no_worse_than(self)
    }

    /// Whether the two state the same quality; where costs are rounded, up to rounding.
    fn same_as(&self, other: &Self) -> bool {
        self.no_worse_than(other) && other.no_worse_than(self)
    }
}

/// Exact order; [`same_as`](Cost::same_as) forgives a relative error of 1e-9.
/// A cost that is not a number is no better than anything, itself included.
impl Cost for f64 {
    fn no_worse_than(&self, other: &Self) -> bool {
        self <= other
    }
    fn same_as(&self, other: &Self) -> bool {
        // The first test is for infinities, whose difference is not a number.
        self.total_cmp(other).is_eq() || (self - other).abs() <= 1e-9 * other.abs().max(1.0)
    }
}

/// Exact Pareto dominance: no worse in every objective.
impl<const N: usize> Cost for [f64; N] {
    fn no_worse_than(&self, other: &Self) -> bool {
        self.iter().zip(other).all(|(a, b)| a.no_worse_than(b))
    }
    fn same_as(&self, other: &Self) -> bool {
        self.iter().zip(other).all(|(a, b)| a.same_as(b))
    }
}

/// A set of mutually non-dominated members, in the order they came.
///
/// As a [`Cost`], a front is no worse than another if it weakly dominates each of its members.
///
/// ```
/// # use pf_core::Front;
/// let front: Front<[f64; 2]> = [[1.0, 9.0], [5.0, 9.0], [9.0, 1.0]].into_iter().collect();
/// assert_eq!(front.members(), [[1.0, 9.0], [9.0, 1.0]]);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Front<T>(Vec<T>);

impl<T> Default for Front<T> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<T> Front<T> {
    /// Adds `member` unless one already there is as good; drops those it dominates.
    /// `key` reads a member's objectives. Says whether the member was added.
    pub fn offer<C: Cost>(&mut self, member: T, key: impl Fn(&T) -> C) -> bool {
        let cost = key(&member);
        if self.0.iter().any(|m| key(m).no_worse_than(&cost)) {
            return false;
        }
        self.0.retain(|m| !cost.no_worse_than(&key(m)));
        self.0.push(member);
        true
    }

    /// The members, in the order they came.
    #[must_use]
    pub fn members(&self) -> &[T] {
        &self.0
    }

    /// A front of `members` as they are, dominated ones included, for a judge to refuse.
    #[must_use]
    pub fn unchecked(members: Vec<T>) -> Self {
        Self(members)
    }
}

/// Offers one member after the other.
impl<C: Cost> FromIterator<C> for Front<C> {
    fn from_iter<I: IntoIterator<Item = C>>(members: I) -> Self {
        let mut front = Self::default();
        for member in members {
            front.offer(member, C::clone);
        }
        front
    }
}

impl<C: Cost> Cost for Front<C> {
    fn no_worse_than(&self, other: &Self) -> bool {
        other
            .0
            .iter()
            .all(|theirs| self.0.iter().any(|ours| ours.no_worse_than(theirs)))
    }
    fn same_as(&self, other: &Self) -> bool {
        let covers = |a: &Self, b: &Self| b.0.iter().all(|x| a.0.iter().any(|y| y.same_as(x)));
        covers(self, other) && covers(other, self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn infinite_costs_are_equal_and_nan_is_not_good() {
        assert!(f64::INFINITY.same_as(&f64::INFINITY));
        assert!(!f64::NAN.no_worse_than(&1.0) && !1.0.no_worse_than(&f64::NAN));
        assert!(1.0.same_as(&(1.0 + 1e-12)) && 1.0.beats(&(1.0 + 1e-12)));
    }

    #[test]
    fn a_smaller_front_that_dominates_less_is_worse() {
        let wide: Front<[f64; 2]> = [[1.0, 9.0], [9.0, 1.0]].into_iter().collect();
        let middle: Front<[f64; 2]> = [[5.0, 5.0]].into_iter().collect();
        assert!(!middle.no_worse_than(&wide) && !wide.no_worse_than(&middle));
    }
}
