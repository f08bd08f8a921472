//! From grids to worlds: the blocked cells of a grid as few, large rectangles.

use crate::{Point, Rectangle, World};
use pf_grid::{Cell, Grid};

/// The world of a grid: cell (x, y) is the unit square from (x, y) to (x + 1, y + 1), the blocked
/// cells are merged into few, large rectangles, which may overlap. No blocked cell is missed, no
/// free one is covered. Terrain is not kept.
///
/// A path through cell centres that is legal under any [`Moves`](pf_grid::Moves) is free in the
/// world for a robot without size. The converse does not hold: the robot may slip between two
/// blocked cells that meet at a corner, as [`Moves::Always`](pf_grid::Moves::Always) allows.
///
/// The rectangles are maximal and found greedily in near linear time; the smallest such cover is
/// NP-hard to find (Culberson and Reckhow 1994).
///
/// ```
/// # use pf_geom::*;
/// let grid = pf_grid::Grid::parse("
///     ..@..
///     @@@@@
///     ..@..
/// ").unwrap();
/// let world = world_of(&grid);
/// assert_eq!(world.shapes().count(), 2);
/// assert_eq!(world.bounds().max(), Point::new(5.0, 3.0));
/// ```
#[must_use]
pub fn world_of(grid: &Grid) -> World {
    let shapes = cover(grid).into_iter().map(|block| block.shape().into());
    let all = Block {
        left: 0,
        right: grid.width() as usize,
        top: 0,
        bottom: grid.height() as usize,
    };
    World::with_shapes(all.shape(), shapes)
}

/// Cells from `left` to before `right`, from `top` to before `bottom`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Block {
    left: usize,
    right: usize,
    top: usize,
    bottom: usize,
}

impl Block {
    fn area(&self) -> usize {
        (self.right - self.left) * (self.bottom - self.top)
    }

    fn shape(&self) -> Rectangle {
        #[expect(clippy::cast_precision_loss, reason = "far below 2^53")]
        let corner = |x: usize, y: usize| Point::new(x as f64, y as f64);
        Rectangle::spanning(corner(self.left, self.top), corner(self.right, self.bottom))
    }
}

/// A bit per cell, each row in words of its own, so that a run of cells is looked at 64 at a time.
#[derive(Clone)]
struct Bits {
    words: Vec<u64>,
    /// Words a row.
    pitch: usize,
    width: usize,
    height: usize,
}

impl Bits {
    fn none(width: usize, height: usize) -> Self {
        let pitch = width.div_ceil(64);
        Self {
            words: vec![0; pitch * height],
            pitch,
            width,
            height,
        }
    }

    fn row(&self, y: usize) -> &[u64] {
        &self.words[y * self.pitch..(y + 1) * self.pitch]
    }

    /// The words of a run and which of their bits belong to it.
    fn masks(left: usize, right: usize) -> impl Iterator<Item = (usize, u64)> {
        let (first, last) = (left / 64, (right - 1) / 64);
        (first..=last).map(move |k| {
            let mut mask = u64::MAX;
            if k == first {
                mask &= u64::MAX << (left % 64);
            }
            if k == last {
                mask &= u64::MAX >> (63 - (right - 1) % 64);
            }
            (k, mask)
        })
    }

    fn has_all(&self, y: usize, left: usize, right: usize) -> bool {
        let row = self.row(y);
        Self::masks(left, right).all(|(k, mask)| row[k] & mask == mask)
    }

    /// Sets or clears a block; says whether that changed anything.
    fn fill(&mut self, block: &Block, to: bool) -> bool {
        let mut changed = false;
        for y in block.top..block.bottom {
            let row = &mut self.words[y * self.pitch..(y + 1) * self.pitch];
            for (k, mask) in Self::masks(block.left, block.right) {
                let before = row[k];
                row[k] = if to { before | mask } else { before & !mask };
                changed |= row[k] != before;
            }
        }
        changed
    }

    /// The first cell from `x` on, up to `limit`, that is not in the set.
    fn run_right(&self, y: usize, x: usize, limit: usize) -> usize {
        let row = self.row(y);
        let mut at = x;
        while at < limit {
            let gaps = !row[at / 64] >> (at % 64);
            if gaps != 0 {
                return limit.min(at + gaps.trailing_zeros() as usize);
            }
            at = (at / 64 + 1) * 64;
        }
        limit
    }

    /// Where the run of the set that ends before `x` begins, `limit` at the lowest.
    fn run_left(&self, y: usize, x: usize, limit: usize) -> usize {
        let row = self.row(y);
        let mut at = x;
        while at > limit {
            let gaps = !row[(at - 1) / 64] << (63 - (at - 1) % 64);
            if gaps != 0 {
                return limit.max(at - gaps.leading_zeros() as usize);
            }
            at = (at - 1) / 64 * 64;
        }
        limit
    }

    fn grow_sideways(&self, block: &mut Block) {
        let (mut left, mut right) = (0, self.width);
        for y in block.top..block.bottom {
            left = self.run_left(y, block.left, left);
            right = self.run_right(y, block.right, right);
        }
        (block.left, block.right) = (left, right);
    }

    fn grow_upright(&self, block: &mut Block) {
        let full = |&y: &usize| self.has_all(y, block.left, block.right);
        let above = (0..block.top).rev().take_while(full).count();
        let below = (block.bottom..self.height).take_while(full).count();
        block.top -= above;
        block.bottom += below;
    }

    /// A maximal block around `block`.
    fn grown(&self, block: Block) -> Block {
        let (mut wide, mut tall) = (block, block);
        self.grow_sideways(&mut wide);
        self.grow_upright(&mut wide);
        self.grow_upright(&mut tall);
        self.grow_sideways(&mut tall);
        if tall.area() > wide.area() {
            tall
        } else {
            wide
        }
    }

    /// The largest block whose top row is the run to the right of a cell, or part of it with that
    /// cell, the first of the set in its row.
    fn largest_below(&self, x: usize, y: usize) -> Block {
        let (mut left, mut right) = (0, self.width);
        let mut best = Block {
            left: x,
            right: x + 1,
            top: y,
            bottom: y + 1,
        };
        for bottom in y..self.height {
            left = self.run_left(bottom, x, left);
            right = self.run_right(bottom, x, right);
            if right <= x {
                break;
            }
            let block = Block {
                left,
                right,
                top: y,
                bottom: bottom + 1,
            };
            if block.area() > best.area() {
                best = block;
            }
            // Nothing further down can be larger.
            if (right - left) * (self.height - y) <= best.area() {
                break;
            }
        }
        best
    }
}

/// Blocks of blocked cells that together are all of them, none of them needless.
fn cover(grid: &Grid) -> Vec<Block> {
    let (width, height) = (grid.width() as usize, grid.height() as usize);
    let mut blocked = Bits::none(width, height);
    for cell in grid.layout().cells().filter(|&cell| !grid.is_free(cell)) {
        let Cell { x, y } = cell;
        blocked.words[y as usize * blocked.pitch + x as usize / 64] |= 1 << (x % 64);
    }
    let mut blocks = Vec::new();
    let mut open = blocked.clone();
    for y in 0..height {
        for k in 0..open.pitch {
            while open.row(y)[k] != 0 {
                let x = 64 * k + open.row(y)[k].trailing_zeros() as usize;
                let block = blocked.grown(open.largest_below(x, y));
                open.fill(&block, false);
                blocks.push(block);
            }
        }
    }
    // What the others cover is not needed: first small ones that large ones cover, then the
    // other way round.
    let mut covered = Bits::none(width, height);
    blocks.sort_by_key(|block| std::cmp::Reverse(block.area()));
    blocks.retain(|block| covered.fill(block, true));
    covered.words.fill(0);
    blocks.reverse();
    blocks.retain(|block| covered.fill(block, true));
    blocks.sort_by_key(|block| (block.top, block.left));
    blocks
}
