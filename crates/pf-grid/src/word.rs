use std::{
    fmt::Debug,
    ops::{Add, Sub},
};

/// An integer that counts path costs in a search: a straight step of unit cost weighs
/// [`STRAIGHT`](Self::STRAIGHT), a diagonal one [`DIAGONAL`](Self::DIAGONAL).
///
/// The two are the denominator q and the numerator p of a convergent of sqrt 2. Nothing with a
/// smaller denominator comes closer to sqrt 2, so the weights order two paths as exact arithmetic
/// does while their diagonal counts differ by less than q, and every path that weighs less than
/// p q has fewer diagonal steps than that. Hence a search that ends below
/// [`LIMIT`](Self::LIMIT) = p q has found a path that is best exactly; one that does not is
/// repeated in a wider word. No table of sizes decides it beforehand.
pub trait Word:
    Copy + Ord + Debug + Default + Add<Output = Self> + Sub<Output = Self> + Send + Sync + 'static
{
    /// The least difference between two weights.
    const ONE: Self;
    /// Weight of a straight step of unit cost.
    const STRAIGHT: Self;
    /// Weight of a diagonal step of unit cost.
    const DIAGONAL: Self;
    /// A path that weighs less was compared exactly.
    const LIMIT: Self;
    /// The largest value.
    const MAX: Self;

    /// How a value lies in arrays: on large maps memory is what a search waits for.
    type Kept: Copy + Debug + Default + Send + Sync + 'static;

    /// For an array.
    #[must_use]
    fn keep(self) -> Self::Kept;
    /// From an array.
    #[must_use]
    fn of(kept: Self::Kept) -> Self;

    /// `self * n`; the caller sees to it that it fits.
    #[must_use]
    fn times(self, n: u32) -> Self;
    /// `self / 2^shift`.
    #[must_use]
    fn bucket(self, shift: u32) -> u64;
    /// `self / other`.
    #[must_use]
    fn over(self, other: Self) -> usize;
    /// As a number that holds every product of weights and cells.
    #[must_use]
    fn wide(self) -> u128;
}

macro_rules! word {
    ($word:ty, $straight:literal, $diagonal:literal) => {
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_lossless,
            clippy::unnecessary_cast,
            reason = "one text for three widths"
        )]
        impl Word for $word {
            const ONE: Self = 1;
            const STRAIGHT: Self = $straight;
            const DIAGONAL: Self = $diagonal;
            const LIMIT: Self = $straight * $diagonal;
            const MAX: Self = <$word>::MAX;

            type Kept = Self;

            #[inline]
            fn keep(self) -> Self {
                self
            }
            #[inline]
            fn of(kept: Self) -> Self {
                kept
            }
            #[inline]
            fn times(self, n: u32) -> Self {
                self * n as $word
            }
            #[inline]
            fn bucket(self, shift: u32) -> u64 {
                (self >> shift) as u64
            }
            #[inline]
            fn over(self, other: Self) -> usize {
                (self / other) as usize
            }
            #[inline]
            fn wide(self) -> u128 {
                self as u128
            }
        }
    };
}

word!(u32, 33_461, 47_321);
word!(u64, 93_222_358, 131_836_323);
word!(u128, 1_746_860_020_068_409, 2_470_433_131_948_081);

/// Forty-eight bits: computed with as sixty-four, six bytes in arrays.
///
/// It orders paths of up to 9.3 million straight steps, such as one up and down every other row of
/// 4096 x 4096 cells.
///
/// ```
/// use pf_grid::{U48, Word};
///
/// let far = U48::DIAGONAL.times(1_000_000);
/// assert_eq!(size_of_val(&far.keep()), 6);
/// assert_eq!(U48::of(far.keep()), far);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct U48(u64);

impl Add for U48 {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl Sub for U48 {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl Word for U48 {
    const ONE: Self = Self(1);
    const STRAIGHT: Self = Self(6_625_109);
    const DIAGONAL: Self = Self(9_369_319);
    const LIMIT: Self = Self(Self::STRAIGHT.0 * Self::DIAGONAL.0);
    const MAX: Self = Self((1 << 48) - 1);

    type Kept = [u16; 3];

    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "sixteen bits at a time")]
    fn keep(self) -> [u16; 3] {
        debug_assert!(self <= Self::MAX, "{self:?}");
        [self.0 as u16, (self.0 >> 16) as u16, (self.0 >> 32) as u16]
    }
    #[inline]
    fn of([low, middle, high]: [u16; 3]) -> Self {
        Self(u64::from(low) | u64::from(middle) << 16 | u64::from(high) << 32)
    }
    #[inline]
    fn times(self, n: u32) -> Self {
        Self(self.0 * u64::from(n))
    }
    #[inline]
    fn bucket(self, shift: u32) -> u64 {
        self.0 >> shift
    }
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "as in the other widths")]
    fn over(self, other: Self) -> usize {
        (self.0 / other.0) as usize
    }
    #[inline]
    fn wide(self) -> u128 {
        self.0.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Grid, Weights};

    #[test]
    fn the_weights_are_convergents_of_sqrt_2() {
        fn check<W: Word>() {
            let (p, q) = (W::DIAGONAL.wide(), W::STRAIGHT.wide());
            assert_eq!((p * p).abs_diff(2 * q * q), 1);
        }
        check::<u32>();
        check::<U48>();
        check::<u64>();
        check::<u128>();
    }

    #[test]
    fn what_is_kept_comes_back() {
        fn check<W: Word>() {
            let near = [W::default(), W::ONE, W::STRAIGHT, W::DIAGONAL];
            let far = [W::LIMIT, W::LIMIT + W::LIMIT, W::MAX - W::ONE, W::MAX];
            let steps = (0..32)
                .map(|bit| W::STRAIGHT.times(1 << bit))
                .filter(|&w| w < W::MAX);
            for value in near.into_iter().chain(far).chain(steps) {
                assert_eq!(W::of(value.keep()), value);
            }
            assert!(size_of::<W::Kept>() <= size_of::<W>());
        }
        check::<U48>();
        check::<u64>();
        check::<u128>();
    }

    #[test]
    fn two_ways_to_the_limit_and_a_map_fit_each_word() {
        let grid = Grid::open(4096, 4096).unwrap();
        let weights = Weights::of(&grid);
        assert!(weights.fit::<u32>(&grid, 2));
        assert!(weights.fit::<U48>(&grid, 2));
        assert!(U48::LIMIT.over(U48::STRAIGHT) > 4096 * 2048);
    }
}
