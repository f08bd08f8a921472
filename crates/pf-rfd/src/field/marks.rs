//! Which old ways down a field are intact, found out once for each cell.

use super::chain::KEPT;
use pf_grid::{Downhill, Word};

/// No more rounds fit a mark.
const LAST: u8 = u8::MAX / 2;

/// What is known of the ways down from cells. A byte a cell, cleared by rounds.
#[derive(Clone, Debug, Default)]
pub(super) struct Marks {
    /// Twice the round, and one if the way is intact. Those of other rounds say nothing.
    marks: Vec<u8>,
    round: u8,
    /// Scratch: the directions of the way down from a cell.
    steps: Vec<u8>,
}

impl Marks {
    /// Makes ready for a grid of so many ids, so that the next answers need not.
    pub(super) fn prepare(&mut self, len: usize) {
        self.steps.shrink_to(KEPT);
        if self.marks.len() != len || self.round > LAST / 2 {
            self.wipe(len);
        }
    }

    /// Forgets all, for a grid of so many ids.
    pub(super) fn clear(&mut self, len: usize) {
        if self.marks.len() != len || self.round == LAST {
            self.wipe(len);
        }
        self.round += 1;
    }

    fn wipe(&mut self, len: usize) {
        self.marks.clear();
        self.marks.resize(len, 0);
        self.round = 0;
    }

    /// Whether the way down from an id leads to the root.
    #[expect(clippy::cast_possible_truncation, reason = "directions are below 8")]
    pub(super) fn is_intact<W: Word>(
        &mut self,
        downhill: &Downhill<'_, W>,
        from: u32,
        root: u32,
    ) -> bool {
        self.steps.clear();
        let (mut id, mut ahead) = (from, 0);
        let is_intact = loop {
            let mark = self.marks[id as usize];
            if mark >> 1 == self.round {
                break mark & 1 == 1;
            }
            if id == root {
                break true;
            }
            match downhill.next(id, ahead) {
                Some(on) => (id, ahead) = on,
                None => break false,
            }
            self.steps.push(ahead as u8);
        };
        let mark = self.round << 1 | u8::from(is_intact);
        self.marks[id as usize] = mark;
        let mut id = from;
        for &step in &self.steps {
            self.marks[id as usize] = mark;
            id = downhill.along(id, step.into());
        }
        is_intact
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        self.marks.capacity() + self.steps.capacity()
    }
}
