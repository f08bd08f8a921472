use crate::failure::Failure;
use pf_geom::{Point, Rectangle};
use pf_grid::{Cell, Grid};
use std::{fmt, str::FromStr};

/// A place on a map, as options say it: a cell of a grid or a point of a world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spot {
    x: f64,
    y: f64,
}

impl FromStr for Spot {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let number = |text: &str| -> Option<f64> {
            let number = text.trim().parse().ok()?;
            f64::is_finite(number).then_some(number)
        };
        let parse = || {
            let (x, y) = text.split_once(',')?;
            Some(Self {
                x: number(x)?,
                y: number(y)?,
            })
        };
        parse().ok_or(
            "a cell is written x,y: two whole numbers from 0; \
             a point of a world may have a sign and decimals: 3.5,-2",
        )
    }
}

impl fmt::Display for Spot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{},{}", self.x, self.y)
    }
}

impl From<Cell> for Spot {
    fn from(cell: Cell) -> Self {
        Self {
            x: cell.x.into(),
            y: cell.y.into(),
        }
    }
}

impl From<Point> for Spot {
    fn from(p: Point) -> Self {
        Self { x: p.x, y: p.y }
    }
}

impl Spot {
    /// The cell of a grid, said by an option.
    pub(crate) fn cell(self, option: &str, grid: &Grid) -> Result<Cell, Failure> {
        let (w, h) = (grid.width(), grid.height());
        let cells = format!("cells go from 0,0 to {},{}", w - 1, h - 1);
        let Some(cell) = self.whole() else {
            let message = format!("{option} {self}: a cell of a grid has two whole numbers");
            return Err(Failure::usage(message).help(cells));
        };
        if grid.layout().contains(cell) {
            return Ok(cell);
        }
        let message = format!("{option} {self} lies outside the map, which has {w} x {h} cells");
        Err(Failure::usage(message).help(cells))
    }

    /// The point of a world, said by an option.
    pub(crate) fn point(self, option: &str, bounds: &Rectangle) -> Result<Point, Failure> {
        let point = Point::new(self.x, self.y);
        if bounds.contains(point) {
            return Ok(point);
        }
        let [min, max] = [bounds.min(), bounds.max()].map(Self::from);
        let message = format!("{option} {self} lies outside the world");
        Err(Failure::usage(message).help(format!("points go from {min} to {max}")))
    }

    /// Numbers too large for a cell become the largest there is, which lies outside any map.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "whole, from 0, and casts of floats saturate"
    )]
    fn whole(self) -> Option<Cell> {
        let whole = |v: f64| (v >= 0.0 && v.fract() == 0.0).then_some(v as u32);
        Some(Cell::new(whole(self.x)?, whole(self.y)?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_read() {
        let at = |x, y| Spot { x, y };
        assert_eq!("3,4".parse(), Ok(at(3.0, 4.0)));
        assert_eq!("-2.5, 1e1".parse(), Ok(at(-2.5, 10.0)));
        for wrong in ["", "3", "3,", "3,4,5", "nan,1", "inf,1", "a,b", "--to"] {
            assert!(wrong.parse::<Spot>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn cells_are_whole() {
        let grid = Grid::open(4, 3).unwrap();
        let cell = |text: &str| text.parse::<Spot>().unwrap().cell("--to", &grid).ok();
        assert_eq!(cell("3,2"), Some(Cell::new(3, 2)));
        assert_eq!(cell("3.0,2"), Some(Cell::new(3, 2)));
        for wrong in ["2.5,1", "-1,0", "4,0", "1e30,0"] {
            assert_eq!(cell(wrong), None, "{wrong}");
        }
    }
}
