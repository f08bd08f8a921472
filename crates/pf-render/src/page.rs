//! Where things lie on the page, in pixels.

use crate::{Picture, frame::Frame};

/// The longer side of the map, as far as whole pixels per cell allow.
const SIDE: f64 = 1024.0;
/// Cells of a small map do not grow beyond this.
const LARGEST_CELL: f64 = 32.0;
pub(crate) const MARGIN: f64 = 16.0;
/// Room for the caption, however narrow the map.
const NARROWEST: f64 = 560.0;

pub(crate) struct Page {
    pub(crate) frame: Frame,
    /// Pixels per unit.
    pub(crate) scale: f64,
    pub(crate) map: [f64; 2],
    pub(crate) width: f64,
    /// A line's width: visible on any map, slim on a small one.
    pub(crate) pen: f64,
    pub(crate) marker: f64,
}

impl Page {
    pub(crate) fn of(picture: &Picture) -> Self {
        let frame = picture.frame;
        let [width, height] = frame.size;
        let fit = SIDE / width.max(height);
        let whole = frame.cells && fit >= 1.0;
        let scale = if whole {
            fit.round().min(LARGEST_CELL)
        } else {
            fit
        };
        // A map is at least a pixel wide, however long it is.
        let map = [width, height].map(|side| (side * scale).max(1.0));
        let cell = if frame.cells { scale } else { 14.0 };
        Self {
            frame,
            scale,
            map,
            width: (map[0] + 2.0 * MARGIN).max(NARROWEST).ceil(),
            pen: (cell * 0.25).clamp(2.5, 6.0),
            marker: (cell * 0.36).clamp(8.0, 12.0),
        }
    }

    /// A map that fills a room, on a page of this width: pens are slimmer than in a
    /// picture.
    pub(crate) fn fitting(frame: Frame, room: [f64; 2], width: f64) -> Self {
        let [w, h] = frame.size;
        let scale = (room[0] / w).min(room[1] / h);
        let cell = if frame.cells { scale } else { 9.0 };
        Self {
            frame,
            scale,
            map: [w, h].map(|side| (side * scale).max(1.0)),
            width,
            pen: (cell * 0.3).clamp(1.8, 4.0),
            marker: (cell * 0.36).clamp(6.0, 10.0),
        }
    }

    /// A length on the page, in tenths, at least so many pixels.
    pub(crate) fn length(&self, length: f64, least: f64) -> f64 {
        ((length * self.scale).max(least) * 10.0).round() / 10.0
    }

    /// The map's left edge: centred on the page.
    pub(crate) fn left(&self) -> f64 {
        ((self.width - self.map[0]) / 2.0).floor()
    }

    /// Whether y runs up.
    pub(crate) fn up(&self) -> bool {
        !self.frame.cells
    }

    /// A point of the map, from the map's upper left corner.
    pub(crate) fn place(&self, p: [f64; 2]) -> [f64; 2] {
        let Frame { min, size, .. } = self.frame;
        let y = if self.up() {
            min[1] + size[1] - p[1]
        } else {
            p[1] - min[1]
        };
        [(p[0] - min[0]) * self.scale, y * self.scale]
    }

    /// The length of the scale bar.
    pub(crate) fn bar(&self) -> f64 {
        self.frame.scale() * self.scale
    }
}

/// Two decimals are finer than any pixel.
pub(crate) fn short(x: f64) -> f64 {
    (x * 100.0).round() / 100.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use pf_geom::{Point, Rectangle, World};

    fn same(a: [f64; 2], b: [f64; 2]) -> bool {
        a.map(f64::to_bits) == b.map(f64::to_bits)
    }

    fn size_of(width: u32, height: u32) -> [f64; 2] {
        Page::of(&Picture::new(width, height)).map
    }

    #[test]
    fn small_maps_are_enlarged_and_large_ones_fit_the_screen() {
        assert!(same(size_of(20, 20), [640.0, 640.0]));
        assert!(same(size_of(512, 256), [1024.0, 512.0]));
        assert!(same(size_of(4096, 4096), [1024.0, 1024.0]));
    }

    #[test]
    fn y_runs_down_on_grids_and_up_in_worlds() {
        let grid = Page::of(&Picture::new(4, 2));
        assert!(same(grid.place([1.0, 0.5]), [32.0, 16.0]));
        let bounds = Rectangle::new(Point::new(-2.0, 10.0), Point::new(2.0, 12.0)).unwrap();
        let world = Page::of(&Picture::of_world(&World::new(bounds), 0.0));
        assert!(same(world.map, [1024.0, 512.0]));
        assert!(same(world.place([-2.0, 12.0]), [0.0, 0.0]));
        assert!(same(world.place([-1.0, 10.5]), [256.0, 384.0]));
    }
}
