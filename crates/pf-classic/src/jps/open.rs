//! An open list for searches of which most are short.

use pf_grid::{Buckets, Word};

/// The nodes to be expanded, the least key first.
///
/// A few lie in one row, in which the least is looked for. Once there are more, all go to [`Buckets`]: those are as
/// fast however many there are, but spread over memory that a short search has to fetch.
#[derive(Clone, Debug, Default)]
pub(super) struct Open<W> {
    few: Vec<(W, u32, W)>,
    is_many: bool,
    buckets: Buckets<W>,
    /// No key was popped above it.
    front: W,
    reach: W,
    shift: u32,
}

/// So many are a few.
const FEW: usize = 32;

impl<W: Word> Open<W> {
    /// Empties it for keys from `first` on, as [`Buckets::reset`].
    pub(super) fn reset(&mut self, first: W, reach: W, shift: u32) {
        self.few.clear();
        self.is_many = false;
        (self.front, self.reach, self.shift) = (first, reach, shift);
    }

    /// Adds a place under `key`, with a value.
    #[inline]
    pub(super) fn push(&mut self, key: W, place: u32, value: W) {
        if self.is_many {
            self.buckets.push(key, place, value);
        } else if self.few.len() < FEW {
            self.few.push((key, place, value));
        } else {
            self.spread();
            self.buckets.push(key, place, value);
        }
    }

    #[cold]
    fn spread(&mut self) {
        self.is_many = true;
        self.buckets.reset(self.front, self.reach, self.shift);
        for (key, place, value) in self.few.drain(..) {
            self.buckets.push(key, place, value);
        }
    }

    /// Takes an entry of the least key there is, or nearly, if it is below `bound`.
    #[inline]
    pub(super) fn pop(&mut self, bound: W) -> Option<(u32, W)> {
        if self.is_many {
            return self.buckets.pop(bound);
        }
        self.pop_few(bound)
    }

    fn pop_few(&mut self, bound: W) -> Option<(u32, W)> {
        let mut entries = self.few.iter().enumerate();
        let (mut at, &(mut least, ..)) = entries.next()?;
        // Of equal ones the last, which is the deepest.
        for (i, &(key, ..)) in entries {
            if key <= least {
                (at, least) = (i, key);
            }
        }
        if least >= bound {
            return None;
        }
        self.front = self.front.max(least);
        let (_, place, value) = self.few.swap_remove(at);
        Some((place, value))
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        self.few.capacity() * size_of::<(W, u32, W)>() + self.buckets.bytes()
    }
}
