//! A rectangle of places that grows.

use crate::{Cell, Layout};

/// Columns and rows, first and last.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Window {
    pub(crate) columns: [u32; 2],
    pub(crate) rows: [u32; 2],
}

impl Window {
    /// All cells.
    pub(crate) fn whole(layout: &Layout) -> Self {
        Self {
            columns: [1, layout.width()],
            rows: [1, layout.height()],
        }
    }

    /// Grows to hold a place.
    pub(crate) fn hold(window: &mut Option<Self>, (x, y): (u32, u32)) {
        let all = window.get_or_insert(Self {
            columns: [x, x],
            rows: [y, y],
        });
        all.columns = [all.columns[0].min(x), all.columns[1].max(x)];
        all.rows = [all.rows[0].min(y), all.rows[1].max(y)];
    }

    /// With the places beside it; it does not touch the border.
    pub(crate) fn grown(self) -> Self {
        let grown = |[first, last]: [u32; 2]| [first - 1, last + 1];
        Self {
            columns: grown(self.columns),
            rows: grown(self.rows),
        }
    }

    /// Both, and what lies between them.
    pub(crate) fn with(self, other: Self) -> Self {
        let mut all = Some(self);
        Self::hold(&mut all, (other.columns[0], other.rows[0]));
        Self::hold(&mut all, (other.columns[1], other.rows[1]));
        all.unwrap_or(self)
    }

    pub(crate) fn width(self) -> usize {
        (self.columns[1] - self.columns[0]) as usize + 1
    }

    /// The places along its sides; corners come twice.
    pub(crate) fn edge(self) -> impl Iterator<Item = (u32, u32)> {
        let ([left, right], [top, bottom]) = (self.columns, self.rows);
        let level = (left..=right).flat_map(move |x| [(x, top), (x, bottom)]);
        level.chain((top..=bottom).flat_map(move |y| [(left, y), (right, y)]))
    }

    pub(crate) fn has(self, (x, y): (u32, u32)) -> bool {
        (self.columns[0]..=self.columns[1]).contains(&x)
            && (self.rows[0]..=self.rows[1]).contains(&y)
    }

    pub(crate) fn places(self) -> usize {
        self.width() * ((self.rows[1] - self.rows[0]) as usize + 1)
    }

    /// Of a place within it the number, row by row.
    pub(crate) fn place(self, (x, y): (u32, u32)) -> usize {
        (y - self.rows[0]) as usize * self.width() + (x - self.columns[0]) as usize
    }

    /// How many steps a cell, counted as the window is, is away from it at the least.
    pub(crate) fn away(self, cell: Cell) -> usize {
        let along =
            |at: u32, [from, to]: [u32; 2]| from.saturating_sub(at).max(at.saturating_sub(to));
        along(cell.x, self.columns).max(along(cell.y, self.rows)) as usize
    }
}

/// The places that are no further than so many steps from one.
pub(crate) fn square((x, y): (u32, u32), reach: u32) -> impl Iterator<Item = (u32, u32)> {
    (y - reach..=y + reach).flat_map(move |y| (x - reach..=x + reach).map(move |x| (x, y)))
}
