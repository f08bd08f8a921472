use crate::Word;

/// A monotone open list: a ring of stacks, each for the keys of one interval.
///
/// Pushing and popping cost a few instructions and no comparison. Entries of one bucket come out
/// last in, first out, which for A* means deepest first. Order *within* a bucket is not kept: a
/// search that uses it must allow a state to be expanded again, and end only when the bucket that
/// could hold something better is empty. How many buckets there are depends on the dearest step,
/// not on the longest path.
///
/// Source: Dial, *Algorithm 360: shortest-path forest with topological ordering*, 1969; here with
/// buckets wider than one key.
#[derive(Clone, Debug, Default)]
pub struct Buckets<W> {
    ring: Vec<Vec<(u32, W)>>,
    shift: u32,
    /// The bucket popped from, counted from key 0.
    current: u64,
    /// No bucket above it holds anything.
    last: u64,
    len: usize,
}

impl<W: Word> Buckets<W> {
    /// Empties the list for keys from `first` on, of which each push exceeds the last popped
    /// bucket by at most `reach`, in buckets of `2^shift`. Keeps the memory it has.
    pub fn reset(&mut self, first: W, reach: W, shift: u32) {
        let needed = (reach.bucket(shift) + 2).next_power_of_two();
        let needed = usize::try_from(needed).unwrap_or(usize::MAX);
        if self.len > 0 {
            for bucket in self.current..=self.last {
                let slot = self.slot(bucket);
                self.ring[slot].clear();
            }
        }
        self.ring.resize_with(needed, Vec::new);
        self.shift = shift;
        self.current = first.bucket(shift);
        self.last = self.current;
        self.len = 0;
    }

    /// How many entries there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Adds `id` under `key`, with a value of the caller's. A key below the current bucket comes
    /// next.
    #[inline]
    pub fn push(&mut self, key: W, id: u32, value: W) {
        let bucket = key.bucket(self.shift).max(self.current);
        self.last = self.last.max(bucket);
        let slot = self.slot(bucket);
        self.ring[slot].push((id, value));
        self.len += 1;
    }

    /// Takes an entry from the lowest bucket there is, up to the one in which `bound` lies.
    #[inline]
    pub fn pop(&mut self, bound: W) -> Option<(u32, W)> {
        loop {
            let slot = self.slot(self.current);
            if let Some(entry) = self.ring[slot].pop() {
                self.len -= 1;
                return Some(entry);
            }
            if self.len == 0 || self.current >= bound.bucket(self.shift) {
                return None;
            }
            self.current += 1;
        }
    }

    /// Bytes held.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let entries: usize = self.ring.iter().map(Vec::capacity).sum();
        entries * size_of::<(u32, W)>() + self.ring.capacity() * size_of::<Vec<(u32, W)>>()
    }

    /// All entries, in no particular order.
    pub fn drain(&mut self) -> impl Iterator<Item = (u32, W)> + '_ {
        self.len = 0;
        self.ring.iter_mut().flat_map(|bucket| bucket.drain(..))
    }

    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "a ring: low bits only")]
    fn slot(&self, bucket: u64) -> usize {
        bucket as usize & (self.ring.len() - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn buckets_come_out_in_order_around_the_ring() {
        let mut open = Buckets::<u32>::default();
        open.reset(1000, 64, 3);
        let mut popped = vec![];
        open.push(1000, 0, 1000);
        while let Some((_, key)) = open.pop(1400) {
            popped.push(key >> 3);
            for step in [7, 33, 64] {
                if key + step < 1400 && popped.len() < 400 {
                    open.push(key + step, 0, key + step);
                }
            }
        }
        assert!(popped.is_sorted() && popped.len() > 100);
    }

    #[test]
    fn a_bound_keeps_what_lies_beyond() {
        let mut open = Buckets::<u64>::default();
        open.reset(0, 100, 2);
        open.push(40, 1, 0);
        assert_eq!(open.pop(39), None);
        assert_eq!(open.pop(40), Some((1, 0)));
        assert!(open.is_empty());
    }
}
