//! Paths that take a byte a step.

use pf_grid::{Cell, Layout};

/// What scratch memory keeps at the most, in entries: to fill more takes far longer than to ask
/// for memory again.
pub(super) const KEPT: usize = 1 << 16;

/// A path as its first id and the directions of its steps; or none.
///
/// Source: Freeman, *On the encoding of arbitrary geometric configurations*, 1961.
#[derive(Clone, Debug, Default)]
pub(super) struct Chain {
    /// 0, of the border, if there is no path.
    first: u32,
    steps: Vec<u8>,
}

impl Chain {
    /// No path.
    pub(super) fn clear(&mut self) {
        self.begin(0);
    }

    /// Whether there is no path.
    pub(super) fn is_none(&self) -> bool {
        self.first == 0
    }

    /// A path that ends where it begins.
    pub(super) fn begin(&mut self, first: u32) {
        self.first = first;
        self.steps.clear();
    }

    /// Goes a step on.
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "below 8")]
    pub(super) fn push(&mut self, direction: u32) {
        self.steps.push(direction as u8);
    }

    /// Goes on by steps told from the last to the first.
    pub(super) fn push_all_back(&mut self, back: impl Iterator<Item = u32>) {
        let known = self.steps.len();
        back.for_each(|direction| self.push(direction));
        self.steps[known..].reverse();
    }

    /// The same path the other way, from its last id.
    pub(super) fn turn(&mut self, last: u32) {
        self.first = last;
        self.steps.reverse();
        // Directions two apart are opposite, among straight and diagonal ones.
        self.steps.iter_mut().for_each(|step| *step ^= 2);
    }

    /// The cells, the first one first; none if there is no path.
    pub(super) fn cells(&self, layout: &Layout) -> Vec<Cell> {
        if self.is_none() {
            return Vec::new();
        }
        let mut cells = Vec::with_capacity(self.steps.len() + 1);
        cells.extend(self.walk(layout));
        cells
    }

    /// The cells of a path, the first one first.
    pub(super) fn walk(&self, layout: &Layout) -> impl Iterator<Item = Cell> + '_ {
        let mut cell = layout.cell(self.first);
        let on = self.steps.iter().map(move |&step| {
            cell = cell.towards(usize::from(step) & 7);
            cell
        });
        std::iter::once(layout.cell(self.first)).chain(on)
    }

    /// Gives back what is not worth keeping.
    pub(super) fn shrink(&mut self) {
        self.steps.shrink_to(KEPT);
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        self.steps.capacity()
    }
}
