//! Which old ways down a field are intact, found out once for each cell.

use pf_grid::{Downhill, Word};

const INTACT: u8 = 1;
const BROKEN: u8 = 2;

/// What is known of the ways down from cells. A byte a cell, cleared by a list.
#[derive(Clone, Debug, Default)]
pub(super) struct Marks {
    marks: Vec<u8>,
    marked: Vec<u32>,
}

impl Marks {
    /// Forgets all, for a grid of so many ids.
    pub(super) fn clear(&mut self, len: usize) {
        for id in self.marked.drain(..) {
            self.marks[id as usize] = 0;
        }
        if self.marks.len() != len {
            self.marks.clear();
            self.marks.resize(len, 0);
        }
    }

    /// Whether the way down from an id leads to the root.
    pub(super) fn is_intact<W: Word>(
        &mut self,
        downhill: &Downhill<'_, W>,
        from: u32,
        root: u32,
    ) -> bool {
        let first = self.marked.len();
        let (mut id, mut ahead) = (from, 0);
        let mark = loop {
            match self.marks[id as usize] {
                0 => {}
                known => break known,
            }
            self.marked.push(id);
            if id == root {
                break INTACT;
            }
            match downhill.next(id, ahead) {
                Some(on) => (id, ahead) = on,
                None => break BROKEN,
            }
        };
        for &id in &self.marked[first..] {
            self.marks[id as usize] = mark;
        }
        mark == INTACT
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        self.marks.capacity() + self.marked.capacity() * size_of::<u32>()
    }
}
