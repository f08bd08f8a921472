//! Worlds of shapes in pictures.

use crate::{
    Picture,
    frame::Frame,
    palette,
    picture::{Key, Lattice, Layer, bin, cells},
};
use pf_geom::{Rectangle, Shape, ShapeId, World};
use pf_grid::Grid;

impl Picture {
    /// A world: obstacles dark, and around them, lightly, where the centre of a robot of this
    /// radius cannot be. Units are the world's and y runs up.
    #[must_use]
    pub fn of_world(world: &World, radius: f64) -> Self {
        let lattice = Lattice {
            corner: [0.0, 0.0],
            side: 1.0,
            size: [1, 1],
        };
        let mut picture = Self::within(Frame::of(world.bounds()), lattice);
        let shapes: Vec<Shape> = world.shapes().map(|(_, shape)| shape.clone()).collect();
        if shapes.is_empty() {
            return picture;
        }
        if radius > 0.0 {
            picture.shapes(shapes.clone(), radius, palette::INFLATED, 1.0);
        }
        picture.shapes(shapes, 0.0, palette::BLOCKED[3], 1.0);
        picture = picture.key(Key::Cells(palette::BLOCKED[3], 1.0), "obstacle");
        if radius > 0.0 {
            let words = "too near for the robot";
            picture = picture.key(Key::Cells(palette::INFLATED, 1.0), words);
        }
        picture
    }

    /// The cells a world was turned into: the blocked ones are tinted, and what is said of cells
    /// from now on is drawn where these lie. `corner` is that of the first cell with the least
    /// coordinates, `side` the side of a cell.
    #[must_use]
    pub fn rasterised(mut self, grid: &Grid, corner: [f64; 2], side: f64) -> Self {
        const OPACITY: f64 = 0.45;
        let (columns, rows) = (grid.width(), grid.height());
        self.lattice = Lattice {
            corner,
            side,
            size: [columns, rows],
        };
        let mut raster = self.raster();
        raster.fill((columns, rows), |corner, size| {
            u8::from(cells(corner, size).any(|cell| !grid.is_free(cell)))
        });
        self.push_cells(&raster, 1, palette::BLOCKED_CELL, OPACITY);
        self.key(Key::Cells(palette::BLOCKED_CELL, OPACITY), "blocked cell")
    }

    /// Obstacles that came, went or moved from one world to another, by their ids.
    #[must_use]
    pub fn shapes_changed(mut self, before: &World, now: &World) -> Self {
        let differs = |a: &World, b: &World| -> Vec<Shape> {
            let other = |id: ShapeId, shape: &Shape| b.shape(id) != Some(shape);
            let shapes = a.shapes().filter(|&(id, shape)| other(id, shape));
            shapes.map(|(_, shape)| shape.clone()).collect()
        };
        // What is there hides what was, not the other way round.
        let kinds = [
            (differs(before, now), palette::NEW_FREE, 0.85, "was there"),
            (differs(now, before), palette::NEW_BLOCKED, 1.0, "new there"),
        ];
        for (shapes, fill, opacity, words) in kinds {
            if !shapes.is_empty() {
                self.shapes(shapes, 0.0, fill, opacity);
                self = self.key(Key::Cells(fill, opacity), words);
            }
        }
        self
    }

    /// Straight pieces that are known to be free, as thin lines.
    #[must_use]
    pub fn pieces(mut self, pieces: &[[[f64; 2]; 2]]) -> Self {
        if pieces.is_empty() {
            return self;
        }
        self.layers.push(Layer::Threads(pieces.to_vec()));
        self.key(Key::Thread, "known to be free")
    }

    /// Points a search looked at, darker the later.
    #[must_use]
    pub fn reached(mut self, order: &[[f64; 2]]) -> Self {
        const DARK: usize = 4;
        if order.is_empty() {
            return self;
        }
        let shades = &palette::HEAT[DARK..];
        let share = order.len().div_ceil(shades.len());
        for (points, colour) in order.chunks(share).zip(shades) {
            let points = points.to_vec();
            self.layers.push(Layer::Dots { points, colour });
        }
        self.key(Key::Dot(palette::HEAT[5]), "expanded, darker later")
    }

    /// A path coloured by the distance to the nearest obstacle along it, from the least to the
    /// greatest; `at` says it of a point.
    #[must_use]
    pub fn clearance(mut self, points: &[[f64; 2]], at: impl Fn([f64; 2]) -> f64) -> Self {
        let pieces = cut(points, self.frame.size[0].max(self.frame.size[1]) / 400.0);
        let middle = |[a, b]: [[f64; 2]; 2]| [f64::midpoint(a[0], b[0]), f64::midpoint(a[1], b[1])];
        let measured: Vec<_> = pieces.iter().map(|&piece| at(middle(piece))).collect();
        let least = measured.iter().copied().fold(f64::INFINITY, f64::min);
        let most = measured.iter().copied().fold(0.0, f64::max);
        if !most.is_finite() || !least.is_finite() {
            return self;
        }
        let shades = palette::CLEARANCE.len();
        let shade = |clearance: f64| {
            let part = (clearance - least) / (most - least).max(f64::MIN_POSITIVE);
            usize::from(bin(part, shades))
        };
        let mut bands: Vec<Vec<Vec<[f64; 2]>>> = vec![Vec::new(); shades];
        let mut before = None;
        for (&[a, b], &clearance) in pieces.iter().zip(&measured) {
            let shade = shade(clearance);
            match bands[shade].last_mut() {
                Some(line) if before == Some(shade) => line.push(b),
                _ => bands[shade].push(vec![a, b]),
            }
            before = Some(shade);
        }
        // Its white rim.
        self.layers.push(Layer::Line {
            points: points.to_vec(),
            colour: palette::FREE,
            line: crate::Line::Solid,
        });
        for (k, (lines, colour)) in (1u32..).zip(bands.into_iter().zip(palette::CLEARANCE)) {
            let to = least + (most - least) * f64::from(k) / 5.0;
            let words = match k {
                1 => format!("clearance {} to {}", rounded(least), rounded(to)),
                _ => format!("to {}", rounded(to)),
            };
            if !lines.is_empty() {
                self.layers.push(Layer::Band { lines, colour });
                self = self.key(Key::Line(colour, crate::Line::Solid), &words);
            }
        }
        self
    }

    fn shapes(&mut self, shapes: Vec<Shape>, grown: f64, fill: &'static str, opacity: f64) {
        self.layers.push(Layer::Shapes {
            shapes,
            grown,
            fill,
            opacity,
        });
    }
}

impl Frame {
    fn of(bounds: &Rectangle) -> Self {
        let (min, max) = (bounds.min(), bounds.max());
        Self {
            min: [min.x, min.y],
            size: [max.x - min.x, max.y - min.y],
            cells: false,
        }
    }
}

/// A line in pieces of at most a length.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a path crosses a picture a few times"
)]
fn cut(points: &[[f64; 2]], longest: f64) -> Vec<[[f64; 2]; 2]> {
    let mut pieces = Vec::new();
    for pair in points.windows(2) {
        let [dx, dy] = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
        let count = (dx.hypot(dy) / longest).ceil().clamp(1.0, 1e4) as u32;
        let at = |k: u32| {
            let t = f64::from(k) / f64::from(count);
            [pair[0][0] + t * dx, pair[0][1] + t * dy]
        };
        pieces.extend((0..count).map(|k| [at(k), at(k + 1)]));
    }
    pieces
}

/// With two decimals, and those from ten on with one: in a legend there is little room.
fn rounded(x: f64) -> String {
    let text = if x < 10.0 {
        format!("{x:.2}")
    } else {
        format!("{x:.1}")
    };
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Line;
    use pf_geom::{Circle, Point, Polygon, Vector};

    fn yard() -> World {
        let p = Point::new;
        let bounds = Rectangle::new(p(-5.0, -5.0), p(15.0, 10.0)).unwrap();
        let corners = vec![p(8.0, 2.0), p(12.0, 2.0), p(8.0, 6.0)];
        let shapes: [Shape; 3] = [
            Circle::new(p(0.0, 0.0), 2.0).unwrap().into(),
            Rectangle::new(p(3.0, -4.0), p(6.0, 1.0)).unwrap().into(),
            Polygon::new(corners).unwrap().into(),
        ];
        World::with_shapes(bounds, shapes)
    }

    #[test]
    fn every_kind_of_shape_and_its_halo_is_drawn() {
        let path = [[-4.0, -4.0], [7.0, 6.0], [14.0, 8.0]];
        let picture = Picture::of_world(&yard(), 0.5)
            .pieces(&[[path[0], path[2]]])
            .reached(&path)
            .clearance(&path, |p| p[0].abs())
            .swath(&path, 0.5)
            .line("way", Line::Solid, &path)
            .end_points(path[0], path[2])
            .caption("a yard");
        let svg = picture.svg();
        for part in [
            "obstacle",
            "too near",
            "known to be free",
            "expanded",
            "clearance 0.",
            "5 units",
            r#"stroke-width="51.2""#,
        ] {
            assert!(svg.contains(part), "no {part} in {svg}");
        }
        assert!(picture.png().is_ok());
    }

    #[test]
    fn what_moved_is_shown_where_it_was_and_where_it_is() {
        let told = |before: &World, now: &World| {
            let svg = Picture::of_world(now, 0.0)
                .shapes_changed(before, now)
                .svg();
            ["was there", "new there"].map(|words| svg.contains(words))
        };
        let (before, mut now) = (yard(), yard());
        assert_eq!(told(&before, &now), [false, false]);
        now.translate(1, Vector::new(0.0, 2.0)).unwrap();
        assert_eq!(told(&before, &now), [true, true]);
        now.remove(1).unwrap();
        assert_eq!(told(&before, &now), [true, false]);
    }

    #[test]
    fn cells_of_a_world_lie_where_they_belong() {
        let grid = Grid::parse("#... .... ....").unwrap();
        let svg = Picture::of_world(&yard(), 0.0)
            .rasterised(&grid, [-5.0, -5.0], 5.0)
            .svg();
        // The first row is the lowest: 15 units of 51.2 pixels below the top.
        let place = "translate(0 768) scale(256 -256)";
        assert!(svg.contains(place), "{svg}");
    }

    #[test]
    fn degenerate_worlds_are_drawn_too() {
        for (width, height) in [(1e-6, 1e-6), (1e9, 1.0), (1.0, 1e9)] {
            let bounds = Rectangle::new(Point::origin(), Point::new(width, height)).unwrap();
            let world = World::new(bounds);
            let ends = [[0.0, 0.0], [width, height]];
            let picture = Picture::of_world(&world, 1.0)
                .line("", Line::Dashed, &ends)
                .clearance(&ends, |_| f64::INFINITY)
                .end_points(ends[0], ends[1]);
            assert!(picture.png().is_ok(), "{width} x {height}");
        }
    }
}
