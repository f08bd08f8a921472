//! Changed cells that lie near each other.

/// Columns and rows of a [`Patch`].
pub(super) const SIDE: u32 = 32;

/// Cells that lie near each other, and those around them.
#[derive(Clone, Debug, Default)]
pub(super) struct Patch {
    /// The first column, that of the border being 0.
    pub(super) left: u32,
    /// The first row.
    pub(super) top: u32,
    /// How many rows there are; without any the rest means nothing.
    pub(super) height: usize,
    /// A bit for each cell.
    pub(super) rows: [u32; SIDE as usize],
}

/// What becomes of a column of a patch.
#[derive(Clone, Copy, Default)]
pub(super) struct Column {
    pub(super) dirty: u32,
    pub(super) south: u32,
    pub(super) north: u32,
}

impl Patch {
    /// Adds a cell and those around it, if they lie near the others.
    pub(super) fn add(&mut self, (x, y): (u32, u32)) -> bool {
        if self.height == 0 {
            (self.left, self.top) = (x.saturating_sub(SIDE / 2), y - 1);
        }
        // Of the cell before it.
        let (x, y) = (
            (x - 1).wrapping_sub(self.left),
            (y - 1).wrapping_sub(self.top),
        );
        let fits = x.max(y) <= SIDE - 3;
        if fits {
            let y = y as usize;
            for row in &mut self.rows[y..y + 3] {
                *row |= 0b111 << x;
            }
            self.height = self.height.max(y + 3);
        }
        fits
    }
}

/// Puts those bits of a word in their places from one on that a mask has.
#[inline]
pub(super) fn put(bits: &mut [u64], at: u32, mask: u32, word: u32) {
    let (first, shift) = (at as usize / 64, at % 64);
    let (mask, word) = (u64::from(mask), u64::from(word));
    bits[first] = bits[first] & !(mask << shift) | word << shift;
    let beyond = mask >> 1 >> (63 - shift);
    if beyond != 0 {
        bits[first + 1] = bits[first + 1] & !beyond | word >> 1 >> (63 - shift);
    }
}
