//! Which old ways down a field are intact, found out once for each cell.

use super::chain::KEPT;
use pf_grid::{Downhill, Word};

/// No more rounds fit a mark.
const LAST: u8 = u8::MAX / 2;

/// After so many steps on a way down it is worth asking whether there is a shorter proof.
const FAR: usize = 16;

/// What is known of the ways down from cells. A byte a cell, cleared by rounds.
#[derive(Clone, Debug, Default)]
pub(super) struct Marks {
    /// Twice the round, and one if the way is intact. Those of other rounds say nothing.
    cells: Vec<u8>,
    round: u8,
    /// Scratch: the directions of the way down from a cell.
    steps: Vec<u8>,
}

impl Marks {
    /// Makes ready for a grid of so many ids, so that the next answers need not.
    pub(super) fn prepare(&mut self, len: usize) {
        if self.cells.len() != len || self.round > LAST / 2 {
            self.wipe(len);
        }
    }

    /// Forgets all, for a grid of so many ids.
    pub(super) fn clear(&mut self, len: usize) {
        if self.cells.len() != len || self.round == LAST {
            self.wipe(len);
        }
        self.round += 1;
    }

    /// Gives back what is not worth keeping.
    pub(super) fn shrink(&mut self) {
        self.steps.clear();
        self.steps.shrink_to(KEPT);
    }

    fn wipe(&mut self, len: usize) {
        self.cells.clear();
        self.cells.resize(len, 0);
        self.round = 0;
    }

    /// Goes down from an id whose way was found intact, and shows the direction of every step. Of ways
    /// as long as each other it takes one that is known to lead to the root.
    pub(super) fn go<W: Word>(
        &self,
        downhill: &Downhill<'_, W>,
        from: u32,
        root: u32,
        mut show: impl FnMut(u32),
    ) {
        let (mut id, mut ahead) = (from, Downhill::<W>::NOWHERE);
        let is_intact = |id: u32| id == root || self.holds(id);
        while let Some(on) = downhill.next_over(id, ahead, is_intact) {
            (id, ahead) = on;
            show(ahead);
        }
    }

    /// Whether the way down from an id was found intact in this round.
    pub(super) fn holds(&self, id: u32) -> bool {
        self.cells.get(id as usize) == Some(&(self.round << 1 | 1))
    }

    /// Whether the way down from an id leads to the root. Where the first steps do lead on, `is_known` is
    /// asked once.
    #[expect(clippy::cast_possible_truncation, reason = "directions are below 8")]
    pub(super) fn is_intact<W: Word>(
        &mut self,
        downhill: &Downhill<'_, W>,
        from: u32,
        root: u32,
        is_known: impl FnOnce() -> bool,
    ) -> bool {
        self.steps.clear();
        let mut is_known = Some(is_known);
        let (mut id, mut ahead) = (from, Downhill::<W>::NOWHERE);
        let is_intact = loop {
            let mark = self.cells[id as usize];
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
            if self.steps.len() == FAR && is_known.take().is_some_and(|is_known| is_known()) {
                return true;
            }
        };
        let mark = self.round << 1 | u8::from(is_intact);
        self.cells[id as usize] = mark;
        let mut id = from;
        for &step in &self.steps {
            self.cells[id as usize] = mark;
            id = downhill.along(id, step.into());
        }
        is_intact
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        self.cells.capacity() + self.steps.capacity()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pf_core::{Context, Problem};
    use pf_grid::{Cell, Distances, Grid, GridChange, GridProblem, Sweeper};

    /// As many rounds later as fit a mark, a cell has the mark again that it had.
    #[test]
    fn what_was_found_out_in_one_round_does_not_hold_in_another() {
        let (root, far, middle) = (Cell::new(0, 0), Cell::new(8, 0), Cell::new(4, 0));
        let problem = GridProblem::new(Grid::open(9, 1).unwrap(), far, root);
        let mut problem = problem.unwrap();
        let mut field = Distances::<u32>::default();
        let cx = &mut Context::seeded(0);
        field.sweep(&problem, root, &mut Sweeper::default(), cx);
        let layout = *problem.grid().layout();
        let mut marks = Marks::default();
        for is_free in [true, false, false, true, true] {
            let change = if is_free {
                GridChange::Freed
            } else {
                GridChange::Blocked
            };
            problem.apply(&[change(vec![middle])]).unwrap();
            let downhill = field.downhill(&problem);
            marks.clear(layout.len());
            for (from, holds) in [(far, is_free), (middle, is_free), (root, true)] {
                let [from_id, root_id] = [from, root].map(|cell| layout.id(cell));
                let is_intact = marks.is_intact(&downhill, from_id, root_id, || false);
                assert_eq!(is_intact, holds, "{from:?}");
            }
            (1..LAST).for_each(|_| marks.clear(layout.len()));
        }
    }
}
