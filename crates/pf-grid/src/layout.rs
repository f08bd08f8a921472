use crate::Cell;

/// How cells lie in memory: row by row with a border, so that every neighbour of a cell has an
/// id and no search checks bounds.
///
/// One column serves as the right border of a row and the left border of the next, so a pitch is
/// `width + 1`; a power of two in the width does not become one in the pitch, which caches like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    width: u32,
    height: u32,
    pitch: u32,
    /// `id / pitch == id * reciprocal >> shift` for every id there is.
    reciprocal: u64,
    shift: u32,
}

impl Layout {
    pub(crate) fn new(width: u32, height: u32) -> Self {
        let pitch = width + 1;
        // Exact for ids below 2^30: 2^shift >= 2^30 * pitch, and id * reciprocal stays below 2^63.
        let shift = 30 + (u32::BITS - pitch.leading_zeros());
        let reciprocal = (1u64 << shift) / u64::from(pitch) + 1;
        Self {
            width,
            height,
            pitch,
            reciprocal,
            shift,
        }
    }

    /// Columns.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// What to add to an id to go a row down.
    #[inline]
    #[must_use]
    pub fn pitch(&self) -> u32 {
        self.pitch
    }

    /// How many ids there are, the border's included: the length of a field over the grid.
    #[must_use]
    #[expect(clippy::len_without_is_empty, reason = "never empty")]
    pub fn len(&self) -> usize {
        (self.height as usize + 2) * self.pitch as usize + 1
    }

    /// Whether there is such a cell.
    #[inline]
    #[must_use]
    pub fn contains(&self, cell: Cell) -> bool {
        cell.x < self.width && cell.y < self.height
    }

    /// The id of a cell of the grid.
    #[inline]
    #[must_use]
    pub fn id(&self, cell: Cell) -> u32 {
        (cell.y + 1) * self.pitch + cell.x + 1
    }

    /// Column and row in which an id lies, the border's first column and row being 0.
    #[inline]
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "a quotient of ids")]
    pub fn position(&self, id: u32) -> (u32, u32) {
        let row = ((u64::from(id) * self.reciprocal) >> self.shift) as u32;
        (id - row * self.pitch, row)
    }

    /// The id that lies in a column and a row, as [`position`](Self::position) counts them.
    #[inline]
    #[must_use]
    pub fn id_at(&self, (column, row): (u32, u32)) -> u32 {
        row * self.pitch + column
    }

    /// The cell with this id.
    #[inline]
    #[must_use]
    pub fn cell(&self, id: u32) -> Cell {
        let (x, y) = self.position(id);
        Cell::new(x - 1, y - 1)
    }

    /// What to add to an id to go in each of the eight [`DIRECTIONS`](crate::DIRECTIONS).
    #[inline]
    #[must_use]
    #[expect(clippy::cast_possible_wrap, reason = "ids stay below 2^30")]
    pub fn offsets(&self) -> [i32; 8] {
        let p = self.pitch as i32;
        [1, p, -1, -p, p + 1, p - 1, -p - 1, 1 - p]
    }

    /// All cells, row by row.
    pub fn cells(&self) -> impl Iterator<Item = Cell> + use<> {
        let width = self.width;
        (0..self.height).flat_map(move |y| (0..width).map(move |x| Cell { x, y }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_and_cells_are_one_to_one_whatever_the_shape() {
        let shapes = [
            (1, 1),
            (1, 1 << 28),
            (1 << 28, 1),
            (3, 5),
            (511, 513),
            (16384, 16384),
            (2, 1 << 27),
        ];
        for (width, height) in shapes {
            let layout = Layout::new(width, height);
            for cell in [
                Cell::new(0, 0),
                Cell::new(width - 1, 0),
                Cell::new(0, height - 1),
                Cell::new(width / 2, height / 2),
                Cell::new(width - 1, height - 1),
            ] {
                let id = layout.id(cell);
                assert_eq!(layout.cell(id), cell, "{width} x {height}");
                let (x, y) = layout.position(id + layout.pitch);
                assert_eq!((x, y), (cell.x + 1, cell.y + 2));
                assert!((id + layout.pitch + 1) < u32::try_from(layout.len()).unwrap());
            }
        }
    }
}
