use crate::{Cell, Grid, Layout};

/// How far each cell's centre lies from the nearest blocked cell's area, exactly.
///
/// Distances are Euclidean, in cells, and kept as integers: twice the distance, squared. The
/// border of the grid is no obstacle. Time and memory are linear in the cells.
///
/// Source: Meijster, Roerdink, Hesselink, *A General Algorithm for Computing Distance Transforms
/// in Linear Time*, 2000; here to squares, not to points: a cell's area begins half a cell before
/// its centre, on either side.
///
/// ```
/// # use pf_grid::*;
/// let grid = Grid::parse("....# ..... .....").unwrap();
/// let clearance = Clearance::of(&grid);
/// assert_eq!(clearance.at(Cell::new(0, 0)), 3.5);
/// assert_eq!(clearance.at(Cell::new(3, 1)), 0.5f64.sqrt());
/// assert_eq!(clearance.at(Cell::new(4, 0)), 0.0);
/// ```
#[derive(Clone, Debug)]
pub struct Clearance {
    layout: Layout,
    /// Row by row, without border: the square of twice the distance; [`FAR`] if nothing is blocked.
    squares: Vec<u64>,
}

const FAR: u64 = u64::MAX;

impl Clearance {
    /// The clearances of a grid.
    #[must_use]
    pub fn of(grid: &Grid) -> Self {
        let layout = *grid.layout();
        let width = layout.width() as usize;
        let mut squares = vec![FAR; width * layout.height() as usize];
        vertical_gaps(grid, 0..layout.height(), &mut squares);
        vertical_gaps(grid, (0..layout.height()).rev(), &mut squares);
        let mut envelope = Envelope::default();
        for row in squares.chunks_exact_mut(width) {
            envelope.spread(row);
        }
        Self { layout, squares }
    }

    /// The distance from the centre of `cell` to the nearest blocked cell's area, in cells; 0 if
    /// the cell is blocked, infinite if none is.
    ///
    /// # Panics
    /// If there is no such cell.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "exact below 2^26 cells")]
    pub fn at(&self, cell: Cell) -> f64 {
        match self.doubled_square(cell) {
            FAR => f64::INFINITY,
            square => (square as f64).sqrt() / 2.0,
        }
    }

    /// Whether the centre of `cell` is nearer than `radius` cells to a blocked cell's area.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "exact below 2^26 cells")]
    pub fn is_below(&self, cell: Cell, radius: f64) -> bool {
        let square = self.doubled_square(cell);
        square != FAR && (square as f64) < 4.0 * radius * radius
    }

    fn doubled_square(&self, cell: Cell) -> u64 {
        assert!(self.layout.contains(cell), "{cell} is not a cell");
        self.squares[cell.y as usize * self.layout.width() as usize + cell.x as usize]
    }
}

/// Lowers each value to twice the gap to the nearest blocked cell in its column among the rows
/// already passed.
fn vertical_gaps(grid: &Grid, rows: impl Iterator<Item = u32>, values: &mut [u64]) {
    let width = grid.width() as usize;
    let mut gaps = vec![FAR; width];
    for y in rows {
        let row = &mut values[y as usize * width..][..width];
        for ((x, gap), value) in (0..).zip(&mut gaps).zip(row) {
            *gap = match *gap {
                _ if !grid.is_free(Cell { x, y }) => 0,
                0 => 1,
                FAR => FAR,
                gap => gap + 2,
            };
            *value = (*value).min(*gap);
        }
    }
}

/// The lower envelope of parabolas over a row, in doubled coordinates: column `x` lies at `2 x`,
/// the sides of its cell at `2 x - 1` and `2 x + 1`.
#[derive(Default)]
struct Envelope {
    /// Of each parabola: where it lies, how high, and the first place where it is the lowest.
    parabolas: Vec<(i64, i64, i64)>,
}

impl Envelope {
    /// From gaps along columns to squared distances.
    fn spread(&mut self, row: &mut [u64]) {
        self.parabolas.clear();
        for (x, &gap) in (0..).zip(row.iter()) {
            if let (Ok(gap), false) = (i64::try_from(gap), gap == FAR) {
                self.add(2 * x - 1, gap * gap);
                self.add(2 * x + 1, gap * gap);
            }
        }
        let mut lowest = 0;
        for (x, value) in (0..).zip(row) {
            while self.parabolas.get(lowest + 1).is_some_and(|p| p.2 <= 2 * x) {
                lowest += 1;
            }
            // In its own column a cell is as far as the gap, whatever the sides say.
            let own = value.saturating_mul(*value);
            *value = self.parabolas.get(lowest).map_or(own, |&(at, height, _)| {
                let side: i64 = 2 * x - at;
                own.min((side * side + height).unsigned_abs())
            });
        }
    }

    fn add(&mut self, at: i64, height: i64) {
        let mut first = i64::MIN;
        while let Some(&(last, last_height, last_first)) = self.parabolas.last() {
            if last == at {
                if last_height <= height {
                    return;
                }
            } else {
                // The first integer from which the new parabola is strictly lower.
                let rise = at * at + height - last * last - last_height;
                first = rise.div_euclid(2 * (at - last)) + 1;
                if first > last_first {
                    break;
                }
                first = i64::MIN;
            }
            self.parabolas.pop();
        }
        self.parabolas.push((at, height, first));
    }
}

impl Grid {
    /// The grid as it is for the centre of a round robot: every cell is blocked whose centre is
    /// nearer than `radius` cells to a blocked cell's area. The border is no obstacle.
    ///
    /// [`Inflated`](crate::Inflated) follows the changes of a grid.
    #[must_use]
    pub fn inflated(&self, radius: f64) -> Self {
        let clearance = Clearance::of(self);
        let mut inflated = self.clone();
        for cell in self.layout().cells() {
            if clearance.is_below(cell, radius) {
                inflated.set_free(&[cell], false);
            }
        }
        inflated
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clearance_is_the_distance_to_the_nearest_square() {
        // A few thousand cells of several densities, against the definition.
        for seed in 0..60u32 {
            let (width, height) = (1 + seed % 23, 1 + seed * 7 % 19);
            let noise = |c: Cell| {
                (c.x * 7919 + c.y * 104_729 + seed * 31).wrapping_mul(2_654_435_761) >> 24
            };
            let grid = Grid::new(width, height, |c| u8::from(noise(c) > 4 * seed)).unwrap();
            let clearance = Clearance::of(&grid);
            for cell in grid.layout().cells() {
                let gap = |a: u32, b: u32| (f64::from(a.abs_diff(b)) - 0.5).max(0.0);
                let expected = grid
                    .layout()
                    .cells()
                    .filter(|&other| !grid.is_free(other))
                    .map(|other| gap(cell.x, other.x).hypot(gap(cell.y, other.y)))
                    .fold(f64::INFINITY, f64::min);
                let found = clearance.at(cell);
                assert!(
                    (found - expected).abs() < 1e-9 || found.total_cmp(&expected).is_eq(),
                    "{cell}: {found}, not {expected}, in\n{grid}"
                );
            }
        }
    }
}
