//! Many cells as few rectangles.

use std::fmt::Write;

/// How many cells a side is drawn with at most; beyond that, blocks of cells are drawn as one.
const FINEST: u32 = 1024;

/// A shade per drawn block of cells, 0 for none.
pub(crate) struct Raster {
    /// Cells per side of a block.
    pub(crate) block: u32,
    columns: usize,
    rows: usize,
    shades: Vec<u8>,
}

impl Raster {
    /// An empty raster for a map of that size.
    pub(crate) fn new(width: u32, height: u32) -> Self {
        let block = width.max(height).div_ceil(FINEST);
        let (columns, rows) = (width.div_ceil(block), height.div_ceil(block));
        Self {
            block,
            columns: columns as usize,
            rows: rows as usize,
            shades: vec![0; columns as usize * rows as usize],
        }
    }

    /// Shades the block in which a cell lies.
    pub(crate) fn set(&mut self, x: u32, y: u32, shade: u8) {
        let (column, row) = ((x / self.block) as usize, (y / self.block) as usize);
        self.shades[row * self.columns + column] = shade;
    }

    /// Shades each block by what `shade` says of its cells: given the block's first cell and how
    /// many columns and rows it has.
    pub(crate) fn fill(
        &mut self,
        (width, height): (u32, u32),
        mut shade: impl FnMut([u32; 2], [u32; 2]) -> u8,
    ) {
        let mut at = 0;
        for y in (0..height).step_by(self.block as usize) {
            for x in (0..width).step_by(self.block as usize) {
                let size = [self.block.min(width - x), self.block.min(height - y)];
                self.shades[at] = shade([x, y], size);
                at += 1;
            }
        }
    }

    /// The blocks of one shade as SVG path data in units of blocks: runs in a row, merged with
    /// equal runs in the rows below.
    pub(crate) fn rectangles(&self, shade: u8) -> String {
        let mut data = String::new();
        // Runs that the next row may continue: first column, one past the last, first row.
        let mut open: Vec<[usize; 3]> = Vec::new();
        let mut corner = [0, 0];
        for row in 0..=self.rows {
            let runs = self.runs(row, shade);
            let mut next = Vec::with_capacity(runs.len());
            let mut old = open.iter().peekable();
            for [from, to] in runs {
                while let Some(&&[f, t, top]) = old.peek()
                    && f < from
                {
                    rectangle(&mut data, &mut corner, [f, t, top, row]);
                    old.next();
                }
                match old.peek() {
                    Some(&&[f, t, top]) if (f, t) == (from, to) => {
                        next.push([from, to, top]);
                        old.next();
                    }
                    _ => next.push([from, to, row]),
                }
            }
            for &[f, t, top] in old {
                rectangle(&mut data, &mut corner, [f, t, top, row]);
            }
            open = next;
        }
        data
    }

    /// First column and one past the last of each run of a shade in a row.
    fn runs(&self, row: usize, shade: u8) -> Vec<[usize; 2]> {
        if row == self.rows {
            return Vec::new();
        }
        let shades = &self.shades[row * self.columns..][..self.columns];
        let mut runs = Vec::new();
        let mut column = 0;
        for group in shades.chunk_by(|a, b| a == b) {
            if group[0] == shade {
                runs.push([column, column + group.len()]);
            }
            column += group.len();
        }
        runs
    }
}

fn rectangle(data: &mut String, corner: &mut [i64; 2], [left, right, top, bottom]: [usize; 4]) {
    let (x, y) = (signed(left), signed(top));
    let (width, height) = (right - left, bottom - top);
    let (dx, dy) = (x - corner[0], y - corner[1]);
    // Closing the rectangle brings the pen back to its corner.
    let space = if dy < 0 { "" } else { " " };
    let _ = write!(data, "m{dx}{space}{dy}h{width}v{height}h-{width}z");
    *corner = [x, y];
}

fn signed(n: usize) -> i64 {
    i64::try_from(n).unwrap_or(i64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The rectangles of the 1s in a drawing.
    #[track_caller]
    fn check(drawing: &str, expected: &str) {
        let rows: Vec<_> = drawing.split_whitespace().map(str::as_bytes).collect();
        let (width, height) = (rows[0].len(), rows.len());
        let mut raster = Raster::new(
            u32::try_from(width).unwrap(),
            u32::try_from(height).unwrap(),
        );
        raster.shades = rows.concat().iter().map(|b| b - b'0').collect();
        assert_eq!(raster.rectangles(1), expected);
    }

    #[test]
    fn equal_runs_below_each_other_become_one_rectangle() {
        check("000 000", "");
        check("011 011 000", "m1 0h2v2h-2z");
        check("110 011", "m0 0h2v1h-2zm1 1h2v1h-2z");
        check("101 101", "m0 0h1v2h-1zm2 0h1v2h-1z");
        check(
            "111 121 111",
            "m0 0h3v1h-3zm0 1h1v1h-1zm2 0h1v1h-1zm-2 1h3v1h-3z",
        );
    }

    #[test]
    fn large_maps_are_drawn_in_blocks() {
        let mut raster = Raster::new(4096, 3000);
        assert_eq!((raster.block, raster.columns, raster.rows), (4, 1024, 750));
        raster.set(4095, 2999, 1);
        assert_eq!(raster.rectangles(1), "m1023 749h1v1h-1z");
    }
}
