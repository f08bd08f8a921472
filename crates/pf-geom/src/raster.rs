//! From worlds to grids: which cells a robot fits in wherever in them it is.

use crate::{
    Point, Segment, Shape, TOUCH, Vector, World, WorldProblem, segment::point_to_box, shape::bad,
};
use pf_core::{InvalidProblem, Problem};
use pf_grid::{Cell, Grid};

/// A world as a grid, on the safe side: a cell is free only if the robot enters nothing and leaves
/// the bounds nowhere, wherever in the cell its centre is.
///
/// Cell (0, 0) begins at the lower corner of the bounds; `y` of cells grows with `y` of points.
/// Where the bounds are no multiple of the cell size, the last cells reach beyond; they count as
/// far as they lie within, and are blocked if their centres do not.
///
/// So a path from centre to centre of free cells, straight or diagonal, passes the world's judge;
/// that there is none in the raster says nothing of the world.
///
/// ```
/// # use pf_geom::*;
/// # use pf_grid::Cell;
/// let bounds = Rectangle::new(Point::origin(), Point::new(4.0, 3.0)).unwrap();
/// let disc = Circle::new(Point::new(2.0, 1.5), 0.5).unwrap();
/// let world = World::with_shapes(bounds, [disc.into()]);
/// let raster = Raster::of(&world, 1.0, 0.0).unwrap();
/// assert_eq!(raster.grid().to_string(), "....\n.##.\n....\n");
/// assert_eq!(raster.cell_of(Point::new(2.0, 0.5)), Cell::new(2, 0));
/// assert_eq!(raster.centre(Cell::new(2, 0)), Point::new(2.5, 0.5));
/// ```
#[derive(Clone, Debug)]
pub struct Raster {
    grid: Grid,
    origin: Point,
    cell: f64,
}

impl Raster {
    /// The raster of a world in square cells of side `cell` for a robot of `radius`, both in the
    /// world's unit.
    ///
    /// # Errors
    /// [`InvalidProblem`] if the cell size is not positive, the radius negative, either not
    /// finite, or there would be more than [`Grid::MAX_CELLS`] cells.
    pub fn of(world: &World, cell: f64, radius: f64) -> Result<Self, InvalidProblem> {
        if !(cell > 0.0 && cell.is_finite()) {
            return Err(bad("the cell size", cell, "a positive number"));
        }
        if !(radius >= 0.0 && radius.is_finite()) {
            return Err(bad("the robot's radius", radius, "a number from 0"));
        }
        let size = world.bounds().max() - world.bounds().min();
        // The cast of a float saturates. A sliver that rounding makes is no cell.
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a positive number"
        )]
        let cells = |length: f64| (length / cell * (1.0 - 1e-12)).ceil().max(1.0) as u64;
        let (width, height) = Grid::check_size(cells(size.x), cells(size.y))?;
        let mut painter = Painter {
            world,
            radius,
            cell,
            width,
            height,
            blocked: vec![false; width as usize * height as usize],
            pieces: Vec::new(),
            whole: Vec::new(),
        };
        painter.paint();
        let blocked = painter.blocked;
        let grid = Grid::new(width, height, |Cell { x, y }| {
            u8::from(!blocked[y as usize * width as usize + x as usize])
        })?;
        Ok(Self {
            grid,
            origin: world.bounds().min(),
            cell,
        })
    }

    /// The cells.
    #[must_use]
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The side of a cell, in the world's unit.
    #[must_use]
    pub fn cell_size(&self) -> f64 {
        self.cell
    }

    /// The cell a point lies in; for a point out of bounds the nearest one.
    #[must_use]
    pub fn cell_of(&self, p: Point) -> Cell {
        let at = (p - self.origin) / self.cell;
        // Casts of floats saturate.
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to what there is"
        )]
        let index = |v: f64, n: u32| (v.floor() as u32).min(n - 1);
        Cell::new(
            index(at.x, self.grid.width()),
            index(at.y, self.grid.height()),
        )
    }

    /// The middle of a cell.
    #[must_use]
    pub fn centre(&self, cell: Cell) -> Point {
        let (x, y) = (f64::from(cell.x) + 0.5, f64::from(cell.y) + 0.5);
        self.origin + Vector::new(x, y) * self.cell
    }

    /// The free cell near a point to whose centre the robot can go straight, the nearest such by
    /// its centre among those at most [`REACH`](Self::REACH) cells away: where a search on the
    /// raster may begin or end.
    #[must_use]
    pub fn entry(&self, problem: &WorldProblem, p: Point) -> Option<Cell> {
        let mut near = self.cells_near(p);
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut seen = near.into_iter().map(|(_, cell)| cell);
        seen.find(|&cell| problem.is_free(p, self.centre(cell)))
    }

    /// How many cells away another way from the exact start or goal onto the raster is looked for.
    pub const REACH: u32 = 6;

    /// A path of the raster as one of `problem`: from its exact start through the cells' centres
    /// to its exact goal, with straight runs as one piece. If the straight way onto the path is not
    /// free, one over another cell near by is tried. `None` if none is found, or the problem does
    /// not accept the path.
    #[must_use]
    pub fn path(&self, problem: &WorldProblem, cells: &[Cell]) -> Option<Vec<Point>> {
        let (first, last) = (*cells.first()?, *cells.last()?);
        let (start, goal) = (problem.start(), problem.goal());
        if cells.len() == 1 && problem.is_free(start, goal) {
            let path = vec![start, goal];
            return problem.judge(&path).is_ok().then_some(path);
        }
        let mut path = vec![start];
        path.extend(self.detour(problem, start, self.centre(first))?);
        for (k, &cell) in cells.iter().enumerate() {
            let step = |from: Cell, to: Cell| {
                let axis = |a: u32, b: u32| i64::from(b) - i64::from(a);
                (axis(from.x, to.x), axis(from.y, to.y))
            };
            let straight_on = k > 0
                && k + 1 < cells.len()
                && step(cells[k - 1], cell) == step(cell, cells[k + 1]);
            if !straight_on {
                path.push(self.centre(cell));
            }
        }
        path.extend(self.detour(problem, goal, self.centre(last))?);
        path.push(goal);
        path.dedup();
        if path.len() == 1 {
            path.push(goal);
        }
        problem.judge(&path).is_ok().then_some(path)
    }

    /// What lies between a point and another: nothing, or the centre of a free cell near by, the way
    /// over it as short as can be.
    fn detour(&self, problem: &WorldProblem, from: Point, to: Point) -> Option<Vec<Point>> {
        if problem.is_free(from, to) {
            return Some(Vec::new());
        }
        let near = self.cells_near(from).into_iter().map(|(first, cell)| {
            let centre = self.centre(cell);
            (first + (to - centre).norm(), centre)
        });
        let mut near: Vec<_> = near.collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut centres = near.into_iter().map(|(_, centre)| centre);
        centres
            .find(|&via| problem.is_free(from, via) && problem.is_free(via, to))
            .map(|via| vec![via])
    }

    /// The free cells at most [`REACH`](Self::REACH) away and how far their centres are.
    fn cells_near(&self, p: Point) -> Vec<(f64, Cell)> {
        let at = self.cell_of(p);
        let around = |v: u32, n: u32| v.saturating_sub(Self::REACH)..n.min(v + Self::REACH + 1);
        let mut near = Vec::new();
        for y in around(at.y, self.grid.height()) {
            for x in around(at.x, self.grid.width()) {
                let cell = Cell { x, y };
                if self.grid.is_free(cell) {
                    near.push(((self.centre(cell) - p).norm(), cell));
                }
            }
        }
        near
    }
}

/// Paints the blocked cells by quartering: what is wholly free or wholly blocked is painted at
/// once, so the work goes with the borders of the shapes, not with the cells.
struct Painter<'w> {
    world: &'w World,
    radius: f64,
    cell: f64,
    width: u32,
    height: u32,
    blocked: Vec<bool>,
    /// Stack of what is near the squares in hand: whose it is, a convex core, and how near the robot may
    /// come.
    pieces: Vec<(usize, Core, f64)>,
    /// Stack of polygons whose inside may hold the squares in hand.
    whole: Vec<usize>,
}

/// A convex figure that is an obstacle once it is grown.
#[derive(Clone, Copy, Debug)]
enum Core {
    Dot(Point),
    Side(Segment),
    Solid(Point, Point),
}

/// A closed upright box.
#[derive(Clone, Copy, Debug)]
struct Span {
    min: Point,
    max: Point,
}

impl Core {
    fn distance(&self, span: &Span) -> f64 {
        match self {
            Self::Dot(p) => point_to_box(*p, span.min, span.max),
            Self::Side(side) => side.distance_to_box(span.min, span.max),
            Self::Solid(min, max) => {
                let gap = |k: usize| (min[k] - span.max[k]).max(span.min[k] - max[k]).max(0.0);
                gap(0).hypot(gap(1))
            }
        }
    }

    fn distance_to_point(&self, p: Point) -> f64 {
        match self {
            Self::Dot(dot) => (p - dot).norm(),
            Self::Side(side) => side.distance_to_point(p),
            Self::Solid(min, max) => point_to_box(p, *min, *max),
        }
    }
}

/// Whether the robot would enter.
fn hits(distance: f64, reach: f64) -> bool {
    distance <= 0.0 || distance < reach
}

impl Painter<'_> {
    /// Squares in which the tree of the world is asked; from there on the lists get shorter.
    const TILE: u32 = 64;

    fn paint(&mut self) {
        for y in (0..self.height).step_by(Self::TILE as usize) {
            for x in (0..self.width).step_by(Self::TILE as usize) {
                let span = self.span(x, y, Self::TILE);
                self.pieces.clear();
                self.whole.clear();
                let reach = Vector::repeat(self.radius);
                for id in self.world.within(span.min - reach, span.max + reach) {
                    self.collect(id);
                }
                self.quarter(x, y, Self::TILE, (0, 0));
            }
        }
        self.block_beyond();
    }

    /// Blocks the last column and row if their centres are out of bounds.
    fn block_beyond(&mut self) {
        let (width, height) = (self.width as usize, self.height as usize);
        let size = self.world.bounds().max() - self.world.bounds().min();
        let beyond = |n: u32, length: f64| (f64::from(n) - 0.5) * self.cell > length;
        if beyond(self.width, size.x) {
            (1..=height).for_each(|y| self.blocked[y * width - 1] = true);
        }
        if beyond(self.height, size.y) {
            self.blocked[(height - 1) * width..].fill(true);
        }
    }

    fn collect(&mut self, id: usize) {
        match self.world.shape(id) {
            None => {}
            Some(Shape::Circle(c)) => {
                let reach = c.radius() + self.radius;
                self.pieces.push((id, Core::Dot(c.centre()), reach));
            }
            Some(Shape::Rectangle(r)) => {
                self.pieces
                    .push((id, Core::Solid(r.min(), r.max()), self.radius));
            }
            Some(Shape::Polygon(p)) => {
                self.whole.push(id);
                let sides = p.sides().map(|side| (id, Core::Side(side), self.radius));
                self.pieces.extend(sides);
            }
        }
    }

    /// The cells of a square as a box, as far as they are within the bounds, without a margin
    /// that may be entered and still counts as touched.
    fn span(&self, x: u32, y: u32, size: u32) -> Span {
        let bounds = self.world.bounds();
        let at = |v: u32| f64::from(v) * self.cell;
        let low = bounds.min() + Vector::new(at(x), at(y));
        let high = (bounds.min() + Vector::new(at(x + size), at(y + size))).inf(&bounds.max());
        let margin = (high - low).map(|side| (TOUCH / 4.0).min(side / 4.0));
        Span {
            min: low + margin,
            max: high - margin,
        }
    }

    /// Paints a square with what lies on the stacks from `base` on.
    fn quarter(&mut self, x: u32, y: u32, size: u32, base: (usize, usize)) {
        if x >= self.width || y >= self.height {
            return;
        }
        let span = self.span(x, y, size);
        let top = (self.pieces.len(), self.whole.len());
        for k in base.0..top.0 {
            let (id, core, reach) = self.pieces[k];
            if hits(core.distance(&span), reach) {
                let corners = [
                    span.min,
                    Point::new(span.max.x, span.min.y),
                    span.max,
                    Point::new(span.min.x, span.max.y),
                ];
                // What is convex and near all corners is near everything between.
                if size == 1
                    || corners
                        .iter()
                        .all(|&c| hits(core.distance_to_point(c), reach))
                {
                    self.truncate(top);
                    return self.fill(x, y, size);
                }
                self.pieces.push((id, core, reach));
            }
        }
        let middle = nalgebra::center(&span.min, &span.max);
        for k in base.1..top.1 {
            let id = self.whole[k];
            let Some(Shape::Polygon(polygon)) = self.world.shape(id) else {
                continue;
            };
            // Crossed by no side a square lies inside or outside as a whole.
            let crossed = self.pieces[top.0..]
                .iter()
                .any(|(whose, core, _)| *whose == id && core.distance(&span) <= 0.0);
            if crossed {
                self.whole.push(id);
            } else if polygon.contains(middle) {
                self.truncate(top);
                return self.fill(x, y, size);
            }
        }
        if size > 1 && (self.pieces.len(), self.whole.len()) != top {
            let half = size / 2;
            for (dx, dy) in [(0, 0), (half, 0), (0, half), (half, half)] {
                self.quarter(x + dx, y + dy, half, top);
            }
        }
        self.truncate(top);
    }

    fn truncate(&mut self, to: (usize, usize)) {
        self.pieces.truncate(to.0);
        self.whole.truncate(to.1);
    }

    fn fill(&mut self, x: u32, y: u32, size: u32) {
        let right = self.width.min(x + size) as usize;
        for row in y..self.height.min(y + size) {
            let from = row as usize * self.width as usize;
            self.blocked[from + x as usize..from + right].fill(true);
        }
    }
}
