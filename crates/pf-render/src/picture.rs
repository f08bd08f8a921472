use crate::{
    cells::Raster,
    frame::Frame,
    palette,
    png::{self, NoPicture},
    svg,
};
use pf_geom::Shape;
use pf_grid::{Cell, Grid, GridChange};

/// How a line is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Line {
    /// What was asked for.
    #[default]
    Solid,
    /// What is not quite an answer: the way to the nearest cell, the path before a change.
    Dashed,
}

/// One thing to draw, in the map's units.
#[derive(Clone, Debug)]
pub(crate) enum Layer {
    /// Rectangles as path data in blocks; where the first block's first corner is and how long a
    /// block's side is.
    Cells {
        data: String,
        corner: [f64; 2],
        side: f64,
        fill: &'static str,
        opacity: f64,
    },
    /// Shapes, grown by a margin.
    Shapes {
        shapes: Vec<Shape>,
        grown: f64,
        fill: &'static str,
        opacity: f64,
    },
    /// Thin lines.
    Threads(Vec<[[f64; 2]; 2]>),
    /// Small dots.
    Dots {
        points: Vec<[f64; 2]>,
        colour: &'static str,
    },
    Line {
        points: Vec<[f64; 2]>,
        colour: &'static str,
        line: Line,
    },
    /// Parts of a path, over its line.
    Band {
        lines: Vec<Vec<[f64; 2]>>,
        colour: &'static str,
    },
    /// What a robot of this radius sweeps on its way.
    Swath {
        points: Vec<[f64; 2]>,
        colour: &'static str,
        radius: f64,
    },
    Start([f64; 2]),
    Goal([f64; 2]),
}

/// Where cells lie in the map's units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lattice {
    /// The corner of the first cell with the least coordinates.
    pub(crate) corner: [f64; 2],
    /// The side of a cell.
    pub(crate) side: f64,
    /// Columns and rows.
    pub(crate) size: [u32; 2],
}

/// What the legend shows beside a word.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Key {
    Cells(&'static str, f64),
    Line(&'static str, Line),
    Thread,
    Dot(&'static str),
    Disc(&'static str),
    Window(&'static str),
    Hair(&'static str),
    Ramp(&'static [&'static str]),
    Start,
    Goal,
}

/// A picture of a map and what happened on it.
#[derive(Clone, Debug)]
pub struct Picture {
    pub(crate) frame: Frame,
    /// Where the cells lie that are drawn.
    pub(crate) lattice: Lattice,
    pub(crate) layers: Vec<Layer>,
    pub(crate) legend: Vec<(Key, String)>,
    pub(crate) caption: Vec<String>,
    paths: usize,
}

impl Picture {
    /// An empty picture of so many cells in width and height; y runs down.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        let lattice = Lattice {
            corner: [0.0, 0.0],
            side: 1.0,
            size: [width, height],
        };
        Self::within(Frame::of_cells(width, height), lattice)
    }

    pub(crate) fn within(frame: Frame, lattice: Lattice) -> Self {
        Self {
            frame,
            lattice,
            layers: Vec::new(),
            legend: Vec::new(),
            caption: Vec::new(),
            paths: 0,
        }
    }

    /// A map: blocked cells dark, terrain in shades of sand.
    ///
    /// A map with a side of more than 1024 cells is drawn in blocks of cells, the darker the more
    /// of a block is blocked.
    #[must_use]
    pub fn of(grid: &Grid) -> Self {
        Self::new(grid.width(), grid.height())
            .terrain(grid)
            .blocked(grid)
    }

    fn blocked(mut self, grid: &Grid) -> Self {
        let mut raster = self.raster();
        raster.fill((grid.width(), grid.height()), |corner, size| {
            let blocked = cells(corner, size).filter(|&c| !grid.is_free(c)).count();
            let all = size[0] as usize * size[1] as usize;
            // Rounded up, so that a thin wall stays visible.
            u8::try_from((4 * blocked).div_ceil(all)).unwrap_or(4)
        });
        for (shade, fill) in (1..).zip(palette::BLOCKED) {
            self.push_cells(&raster, shade, fill, 1.0);
        }
        self.key(Key::Cells(palette::BLOCKED[3], 1.0), "blocked")
    }

    fn terrain(mut self, grid: &Grid) -> Self {
        if grid.is_uniform() {
            return self;
        }
        let most = f64::from(grid.cost_range().1);
        let shades = palette::TERRAIN.len();
        let mut raster = self.raster();
        raster.fill((grid.width(), grid.height()), |corner, size| {
            let free = cells(corner, size).filter(|&c| grid.is_free(c));
            match free.map(|c| grid.cost(c)).max() {
                None | Some(1) => 0,
                Some(cost) => 1 + bin(f64::from(cost).ln() / most.ln(), shades),
            }
        });
        for (shade, fill) in (1..).zip(palette::TERRAIN) {
            self.push_cells(&raster, shade, fill, 1.0);
        }
        let words = format!("terrain, up to cost {most}");
        self.key(Key::Cells(palette::TERRAIN[3], 1.0), &words)
    }

    /// Cells that only `inflated` blocks, in a light tint: too near an obstacle for the robot.
    #[must_use]
    pub fn inflated(mut self, grid: &Grid, inflated: &Grid) -> Self {
        let mut raster = self.raster();
        raster.fill((grid.width(), grid.height()), |corner, size| {
            let mut tinted = cells(corner, size);
            u8::from(tinted.any(|c| grid.is_free(c) && !inflated.is_free(c)))
        });
        self.push_cells(&raster, 1, palette::INFLATED, 1.0);
        self.key(Key::Cells(palette::INFLATED, 1.0), "too near for the robot")
    }

    /// Cells that nobody has seen, in a light tint: what is drawn of them is presumed.
    #[must_use]
    pub fn unseen(mut self, seen: impl Fn(Cell) -> bool) -> Self {
        let mut raster = self.raster();
        let [width, height] = self.lattice.size;
        raster.fill((width, height), |corner, size| {
            u8::from(cells(corner, size).all(|cell| !seen(cell)))
        });
        self.push_cells(&raster, 1, palette::INFLATED, 1.0);
        self.key(Key::Cells(palette::INFLATED, 1.0), "not seen")
    }

    /// What a search looked at, translucent, darker the later.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "a shade needs no precision")]
    pub fn expanded(mut self, order: &[Cell]) -> Self {
        const OPACITY: f64 = 0.75;
        let mut raster = self.raster();
        for (i, cell) in order.iter().enumerate() {
            let when = i as f64 / order.len() as f64;
            raster.set(cell.x, cell.y, 1 + bin(when, palette::HEAT.len()));
        }
        for (shade, fill) in (1..).zip(palette::HEAT) {
            self.push_cells(&raster, shade, fill, OPACITY);
        }
        self.key(
            Key::Cells(palette::HEAT[5], OPACITY),
            "expanded, darker later",
        )
    }

    /// Cells that were blocked, freed or given another cost.
    #[must_use]
    pub fn changed(mut self, changes: &[GridChange]) -> Self {
        let kinds = [
            (palette::NEW_BLOCKED, "newly blocked"),
            (palette::NEW_FREE, "newly free"),
            (palette::NEW_COST, "new cost"),
        ];
        let mut raster = self.raster();
        let mut seen = [false; 3];
        for change in changes {
            let (shade, cells) = match change {
                GridChange::Blocked(cells) => (1, cells),
                GridChange::Freed(cells) => (2, cells),
                GridChange::CostChanged(cells, _) => (3, cells),
                GridChange::StartMoved(_) | GridChange::GoalMoved(_) => continue,
            };
            for cell in cells {
                raster.set(cell.x, cell.y, shade);
            }
            seen[usize::from(shade) - 1] |= !cells.is_empty();
        }
        for (i, (fill, words)) in kinds.into_iter().enumerate() {
            if seen[i] {
                self.push_cells(&raster, u8::try_from(i + 1).unwrap_or(1), fill, 0.85);
                self = self.key(Key::Cells(fill, 0.85), words);
            }
        }
        self
    }

    /// A path over cells, through their centres, under a name for the legend. Each solid path gets
    /// the next colour; dashed ones share one.
    #[must_use]
    pub fn path(self, name: &str, line: Line, path: &[Cell]) -> Self {
        let points: Vec<_> = path.iter().map(|&cell| centre(cell)).collect();
        self.line(name, line, &points)
    }

    /// A path through points in the map's units, under a name for the legend.
    #[must_use]
    pub fn line(mut self, name: &str, line: Line, points: &[[f64; 2]]) -> Self {
        let colour = match line {
            Line::Solid => self.next_colour(),
            Line::Dashed => palette::DASHED,
        };
        self.paths += usize::from(line == Line::Solid);
        self.layers.push(Layer::Line {
            points: without_straight_middles(points),
            colour,
            line,
        });
        self.key(Key::Line(colour, line), name)
    }

    /// What a robot of this radius, in the map's units, sweeps on the next solid path.
    #[must_use]
    pub fn swath(mut self, points: &[[f64; 2]], radius: f64) -> Self {
        self.layers.push(Layer::Swath {
            points: without_straight_middles(points),
            colour: self.next_colour(),
            radius,
        });
        self
    }

    /// Start and goal cells.
    #[must_use]
    pub fn ends(self, start: Cell, goal: Cell) -> Self {
        self.end_points(centre(start), centre(goal))
    }

    /// Start and goal in the map's units.
    #[must_use]
    pub fn end_points(mut self, start: [f64; 2], goal: [f64; 2]) -> Self {
        self.layers.push(Layer::Start(start));
        self.layers.push(Layer::Goal(goal));
        self.key(Key::Start, "start").key(Key::Goal, "goal")
    }

    /// A line of text below the map; the first is set larger.
    #[must_use]
    pub fn caption(mut self, text: impl Into<String>) -> Self {
        self.caption.push(text.into());
        self
    }

    /// The picture as SVG.
    #[must_use]
    pub fn svg(&self) -> String {
        svg::write(self)
    }

    /// The picture as PNG, as large as the SVG says.
    ///
    /// # Errors
    /// [`NoPicture`] if it cannot be drawn.
    pub fn png(&self) -> Result<Vec<u8>, NoPicture> {
        png::png_of(&self.svg())
    }

    fn next_colour(&self) -> &'static str {
        palette::PATHS[self.paths % palette::PATHS.len()]
    }

    pub(crate) fn raster(&self) -> Raster {
        let [width, height] = self.lattice.size;
        Raster::new(width, height)
    }

    pub(crate) fn push_cells(
        &mut self,
        raster: &Raster,
        shade: u8,
        fill: &'static str,
        opacity: f64,
    ) {
        let data = raster.rectangles(shade);
        if !data.is_empty() {
            self.layers.push(Layer::Cells {
                data,
                corner: self.lattice.corner,
                side: self.lattice.side * f64::from(raster.block),
                fill,
                opacity,
            });
        }
    }

    pub(crate) fn key(mut self, key: Key, words: &str) -> Self {
        let entry = (key, words.to_owned());
        if !words.is_empty() && !self.legend.contains(&entry) {
            self.legend.push(entry);
        }
        self
    }
}

fn centre(cell: Cell) -> [f64; 2] {
    [f64::from(cell.x) + 0.5, f64::from(cell.y) + 0.5]
}

pub(crate) fn cells([x, y]: [u32; 2], [width, height]: [u32; 2]) -> impl Iterator<Item = Cell> {
    (y..y + height).flat_map(move |y| (x..x + width).map(move |x| Cell { x, y }))
}

/// Which of `bins` equal parts of 0 to 1 a number lies in.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "a handful of bins"
)]
pub(crate) fn bin(part: f64, bins: usize) -> u8 {
    (part * bins as f64).clamp(0.0, bins as f64 - 1.0) as u8
}

/// The same line with fewer points: those on the way straight ahead left out.
fn without_straight_middles(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut kept: Vec<[f64; 2]> = Vec::new();
    for &p in points {
        while let [.., a, b] = kept[..]
            && straight(a, b, p)
        {
            kept.pop();
        }
        kept.push(p);
    }
    kept
}

/// Whether a line goes on in the same direction after its second point.
fn straight(from: [f64; 2], by: [f64; 2], to: [f64; 2]) -> bool {
    let (u, v) = (minus(by, from), minus(to, by));
    let cross = u[0] * v[1] - u[1] * v[0];
    cross.abs() < 1e-12 && u[0] * v[0] + u[1] * v[1] >= 0.0
}

fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn straight_runs_are_one_segment_and_turns_back_stay() {
        let line = |xs: &[i32]| -> Vec<[f64; 2]> {
            xs.iter().map(|&x| [f64::from(x), f64::from(x)]).collect()
        };
        let thin = |xs: &[i32]| without_straight_middles(&line(xs));
        assert_eq!(thin(&[0, 1, 2, 3]), line(&[0, 3]));
        assert_eq!(thin(&[0, 1, 2, 1]), line(&[0, 2, 1]));
        assert_eq!(thin(&[4]), line(&[4]));
    }

    #[test]
    fn a_long_line_is_drawn_in_short_pieces_without_a_gap() {
        let zigzag: Vec<[f64; 2]> = (0..2500)
            .map(|k| [f64::from(k), f64::from(k % 2)])
            .collect();
        let svg = Picture::new(2500, 2)
            .line("walked", Line::Solid, &zigzag)
            .svg();
        let pieces: Vec<Vec<&str>> = svg
            .split("<polyline stroke=\"#fff\"")
            .skip(1)
            .filter_map(|piece| piece.split("points=\"").nth(1)?.split('"').next())
            .map(|points| points.split(' ').collect())
            .collect();
        assert!(pieces.len() > 1 && pieces.iter().all(|piece| piece.len() <= 1001));
        assert!(
            pieces
                .windows(2)
                .all(|pair| pair[0].last() == pair[1].first())
        );
        let points: usize = pieces.iter().map(Vec::len).sum();
        assert_eq!(points - (pieces.len() - 1), zigzag.len());
    }
}
