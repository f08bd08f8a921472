//! Changed cells that lie near each other.

use super::turns::RUN;

/// So many rows and columns of a patch have another one on both sides.
pub(super) const INNER: u32 = RUN - 2;

/// The rows and columns of cells that lie near each other, and of those around them.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Patch {
    /// The first column, that of the border being 0.
    pub(super) left: u32,
    /// The first row.
    pub(super) top: u32,
    /// A bit for each row from the first on; without any the rest means nothing.
    pub(super) rows: u64,
    /// The same for each column.
    pub(super) columns: u64,
}

impl Patch {
    /// Adds a cell and those around it, if they lie near the others.
    pub(super) fn add(&mut self, (x, y): (u32, u32)) -> bool {
        // Of the cell before it.
        let (x, y) = (x - 1, y - 1);
        if self.rows == 0 {
            (self.left, self.top) = [x, y].map(|at| at.saturating_sub(RUN / 2)).into();
        }
        let (x, y) = (x.wrapping_sub(self.left), y.wrapping_sub(self.top));
        let fits = x.max(y) < INNER;
        if fits {
            self.rows |= 0b111 << y;
            self.columns |= 0b111 << x;
        }
        fits
    }

    /// Whether a place lies in its rows and columns, or between them.
    pub(super) fn holds(&self, (x, y): (u32, u32)) -> bool {
        x.wrapping_sub(self.left) < RUN && y.wrapping_sub(self.top) < RUN
    }
}

/// The places of the ones of a word.
pub(super) fn ones(mut word: u64) -> impl Iterator<Item = u32> {
    std::iter::from_fn(move || {
        let at = word.trailing_zeros();
        word &= word.wrapping_sub(1);
        (at < 64).then_some(at)
    })
}

/// Puts those bits of two words in their places from one on that a mask has.
#[inline]
pub(super) fn put(bits: &mut [[u64; 2]], at: u32, mask: u64, words: [u64; 2]) {
    let (first, shift) = (at as usize / 64, at % 64);
    let mut put = |at: usize, mask: u64, words: [u64; 2]| {
        for (bits, word) in bits[at].iter_mut().zip(words) {
            *bits = *bits & !mask | word & mask;
        }
    };
    put(first, mask << shift, words.map(|word| word << shift));
    let beyond = |word: u64| word >> 1 >> (63 - shift);
    if beyond(mask) != 0 {
        put(first + 1, beyond(mask), words.map(beyond));
    }
}
