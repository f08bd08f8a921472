use crate::DIRECTIONS;
use std::{fmt, str::FromStr};

/// A cell by column and row, from 0; `y` runs down, as in Moving AI files.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Cell {
    /// Column.
    pub x: u32,
    /// Row.
    pub y: u32,
}

impl Cell {
    /// The cell in column `x` and row `y`.
    #[must_use]
    pub const fn new(x: u32, y: u32) -> Self {
        Self { x, y }
    }

    /// The cell a step on in one of the [`DIRECTIONS`]. Beyond the map's border it is none of the map's.
    #[inline]
    #[must_use]
    pub const fn towards(self, direction: usize) -> Self {
        let (dx, dy) = DIRECTIONS[direction];
        Self {
            x: self.x.wrapping_add_signed(dx),
            y: self.y.wrapping_add_signed(dy),
        }
    }
}

/// `x,y`
impl fmt::Display for Cell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{},{}", self.x, self.y)
    }
}

impl FromStr for Cell {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let parse = || {
            let (x, y) = text.split_once(',')?;
            Some(Self::new(x.trim().parse().ok()?, y.trim().parse().ok()?))
        };
        parse().ok_or("a cell is written x,y: two whole numbers from 0")
    }
}
