//! The few cells that were freed, found by their ids.

/// A list of up to 255 cells, and a table to find them in: small enough to stay near, where a byte
/// for each cell of the map would be fetched from afar.
#[derive(Clone, Debug)]
pub(super) struct Freed<W> {
    /// Each with what is left from it.
    pub(super) cells: Vec<(u32, W)>,
    /// Places in the list, from 1, each at the first free slot from that of its id on.
    slots: Vec<u8>,
}

const BITS: u32 = 10;

impl<W> Default for Freed<W> {
    fn default() -> Self {
        Self {
            cells: Vec::new(),
            slots: vec![0; 1 << BITS],
        }
    }
}

impl<W> Freed<W> {
    /// Forgets all.
    pub(super) fn clear(&mut self) {
        if !self.cells.is_empty() {
            self.cells.clear();
            self.slots.fill(0);
        }
    }

    /// Where in the list an id is.
    #[inline]
    pub(super) fn place(&self, id: u32) -> Option<usize> {
        let place = usize::from(self.slots[self.slot(id)]);
        place.checked_sub(1)
    }

    /// Adds a cell that is not among them; says whether there was room.
    pub(super) fn add(&mut self, id: u32, left: W) -> bool {
        let Ok(place) = u8::try_from(self.cells.len() + 1) else {
            return false;
        };
        let slot = self.slot(id);
        self.slots[slot] = place;
        self.cells.push((id, left));
        true
    }

    /// The slot of an id: its own, or the free one where it would go. There is always one, as the
    /// table is four times as long as the list may be.
    #[inline]
    fn slot(&self, id: u32) -> usize {
        // Fibonacci hashing: neighbours lie far apart.
        let mut slot = (id.wrapping_mul(0x9E37_79B1) >> (u32::BITS - BITS)) as usize;
        loop {
            match self.slots[slot] {
                0 => return slot,
                place if self.cells[usize::from(place) - 1].0 == id => return slot,
                _ => slot = (slot + 1) & (self.slots.len() - 1),
            }
        }
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        self.cells.capacity() * size_of::<(u32, W)>() + self.slots.capacity()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_list_finds_its_own_and_nothing_else() {
        let mut freed = Freed::default();
        for pitch in [1, 101, 1 << 22] {
            freed.clear();
            let ids: Vec<u32> = (7..262).map(|k| k * pitch).collect();
            assert!(ids.iter().all(|&id| freed.add(id, id)));
            assert!(!freed.add(3, 3));
            for (k, &id) in ids.iter().enumerate() {
                assert_eq!(freed.place(id), Some(k));
                assert_eq!(freed.place(id + 300 * pitch), None);
            }
        }
    }
}
