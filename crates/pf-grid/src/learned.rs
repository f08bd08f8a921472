//! What searches find out about what is left.

use crate::Word;

/// By id a bound from below on what is left to a goal, as searches found it out: one that found the best path to weigh
/// `whole` knows that no less is left from what it expanded than the way there leaves of it. It holds until anything
/// becomes free or cheaper. No memory before the first.
///
/// Source: Koenig and Likhachev, *Adaptive A\**, 2005.
#[derive(Clone, Debug, Default)]
pub struct Learned<W> {
    /// By id; nothing is known where there is no weight.
    least: Vec<W>,
    /// The ids of which something is known.
    ids: Vec<u32>,
}

impl<W: Word> Learned<W> {
    /// Whether nothing is known.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.ids.is_empty()
    }

    /// What is known of an id: no less is left.
    #[inline]
    #[must_use]
    pub fn at(&self, id: u32) -> W {
        self.least.get(id as usize).copied().unwrap_or_default()
    }

    /// Learns of these ids, of so many that there are, that no less than these weights is left.
    pub fn learn(&mut self, len: usize, found: impl Iterator<Item = (u32, W)>) {
        if self.least.len() != len {
            self.least = vec![W::default(); len];
            self.ids.clear();
        }
        for (id, now) in found {
            let least = &mut self.least[id as usize];
            if *least < now {
                if *least == W::default() {
                    self.ids.push(id);
                }
                *least = now;
            }
        }
    }

    /// Nothing is known any more.
    pub fn forget(&mut self) {
        for id in self.ids.drain(..) {
            self.least[id as usize] = W::default();
        }
    }

    /// Bytes held.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.least.capacity() * size_of::<W>() + self.ids.capacity() * size_of::<u32>()
    }
}
