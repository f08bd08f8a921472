//! Places in rows and columns, and which moves between neighbours no obstacle forbids.

use pf_geom::{Point, Segment, TeamProblem, Vector};

/// The moves from a place to its neighbours: columns and rows.
pub(super) const MOVES: [(i32, i32); 8] = [
    (1, 0),
    (1, 1),
    (0, 1),
    (-1, 1),
    (-1, 0),
    (-1, -1),
    (0, -1),
    (1, -1),
];

/// A lattice for robots of one radius.
#[derive(Clone, Debug)]
pub(super) struct Lattice {
    origin: Point,
    pub(super) pitch: f64,
    pub(super) columns: i32,
    pub(super) rows: i32,
    /// By place: a bit for each move that is free.
    free: Vec<u8>,
}

/// One lattice for each radius, made when it is needed.
#[derive(Clone, Debug)]
pub(super) struct Lattices {
    cells: usize,
    made: Vec<(f64, Lattice)>,
}

impl Lattices {
    pub(super) fn new(cells: usize) -> Self {
        Self {
            cells,
            made: Vec::new(),
        }
    }

    pub(super) fn of(&mut self, problem: &TeamProblem, radius: f64) -> &Lattice {
        let same = |(other, _): &(f64, Lattice)| other.total_cmp(&radius).is_eq();
        let known = self.made.iter().position(same);
        let at = known.unwrap_or_else(|| {
            self.made
                .push((radius, Lattice::of(problem, radius, self.cells)));
            self.made.len() - 1
        });
        &self.made[at].1
    }
}

impl Lattice {
    fn of(problem: &TeamProblem, radius: f64, cells: usize) -> Self {
        let bounds = problem.world().bounds();
        let size = bounds.max() - bounds.min();
        #[expect(clippy::cast_precision_loss, reason = "a number of cells")]
        let pitch = size.x.max(size.y) / cells as f64;
        #[expect(clippy::cast_possible_truncation, reason = "at most so many cells")]
        let count = |k: usize| (size[k] / pitch).floor() as i32 + 1;
        let mut lattice = Self {
            origin: bounds.min(),
            pitch,
            columns: count(0),
            rows: count(1),
            free: Vec::new(),
        };
        let world = problem.world();
        let count = lattice.len();
        let mut free = vec![0u8; count];
        for from in 0..count {
            // Half of the moves; the others are these from the other end.
            for (k, _) in MOVES.iter().enumerate().take(4) {
                let Some(to) = lattice.neighbour(from, k) else {
                    continue;
                };
                let segment = Segment::new(lattice.place(from), lattice.place(to));
                if world.is_free(&segment, radius) {
                    free[from] |= 1 << k;
                    free[to] |= 1 << (k + 4);
                }
            }
        }
        lattice.free = free;
        lattice
    }

    #[expect(clippy::cast_sign_loss, reason = "both are positive")]
    pub(super) fn len(&self) -> usize {
        self.columns as usize * self.rows as usize
    }

    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_possible_wrap,
        reason = "fewer than a million places"
    )]
    pub(super) fn place(&self, number: usize) -> Point {
        let (column, row) = (number as i32 % self.columns, number as i32 / self.columns);
        self.origin + Vector::new(column.into(), row.into()) * self.pitch
    }

    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_possible_wrap,
        clippy::cast_sign_loss,
        reason = "fewer than a million places"
    )]
    fn neighbour(&self, number: usize, k: usize) -> Option<usize> {
        let (column, row) = (number as i32 % self.columns, number as i32 / self.columns);
        let (x, y) = (column + MOVES[k].0, row + MOVES[k].1);
        let inside = (0..self.columns).contains(&x) && (0..self.rows).contains(&y);
        inside.then(|| (y * self.columns + x) as usize)
    }

    /// The places that a place leads to.
    pub(super) fn next(&self, number: usize) -> impl Iterator<Item = usize> + '_ {
        let free = self.free[number];
        (0..8)
            .filter(move |k| free >> k & 1 == 1)
            .filter_map(move |k| self.neighbour(number, k))
    }

    /// The places within two pitches to which there is a straight way from a point, and back.
    pub(super) fn near(&self, problem: &TeamProblem, radius: f64, point: Point) -> Vec<usize> {
        let offset = (point - self.origin) / self.pitch;
        #[expect(clippy::cast_possible_truncation, reason = "within the bounds")]
        let (column, row) = (offset.x.floor() as i32, offset.y.floor() as i32);
        let mut near = Vec::new();
        for y in (row - 1).max(0)..=(row + 2).min(self.rows - 1) {
            for x in (column - 1).max(0)..=(column + 2).min(self.columns - 1) {
                #[expect(clippy::cast_sign_loss, reason = "both are positive")]
                let number = (y * self.columns + x) as usize;
                let segment = Segment::new(point, self.place(number));
                if problem.world().is_free(&segment, radius) {
                    near.push(number);
                }
            }
        }
        near
    }
}
