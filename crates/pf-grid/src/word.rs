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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_weights_are_convergents_of_sqrt_2() {
        fn check<W: Word>() {
            let (p, q) = (W::DIAGONAL.wide(), W::STRAIGHT.wide());
            assert_eq!((p * p).abs_diff(2 * q * q), 1);
        }
        check::<u32>();
        check::<u64>();
        check::<u128>();
    }
}
