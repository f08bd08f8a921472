//! The last answer's path, kept so that the next need not be read off a map again.

use crate::{Cell, DIRECTIONS, GridProblem, Layout, Weights, Word};

/// A path to the goal, what is left of it at each cell, and how much of it still holds.
///
/// It lies goal first: a robot that follows it takes cells off the end, and a detour replaces the
/// end, at a cost in the length of the detour.
#[derive(Clone, Debug, Default)]
pub struct Route<W> {
    /// The goal first.
    cells: Vec<Cell>,
    /// What the way to the goal weighs.
    left: Vec<W>,
    /// By id: where in `cells` it may lie. What is there says whether it does.
    places: Vec<u32>,
    /// So many cells from the goal on are joined by steps that hold.
    sound: usize,
}

impl<W: Word> Route<W> {
    /// Forgets the path, and makes ready for grids of a layout.
    pub fn clear(&mut self, layout: &Layout) {
        self.forget();
        if self.places.len() != layout.len() {
            self.places.clear();
            self.places.resize(layout.len(), 0);
        }
    }

    /// Forgets the path.
    pub fn forget(&mut self) {
        self.cells.clear();
        self.left.clear();
        self.sound = 0;
    }

    /// Bytes held.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.cells.capacity() * size_of::<Cell>()
            + self.left.capacity() * size_of::<W>()
            + self.places.capacity() * size_of::<u32>()
    }

    fn place(&self, id: u32, cell: Cell) -> Option<usize> {
        let place = *self.places.get(id as usize)? as usize;
        (self.cells.get(place) == Some(&cell)).then_some(place)
    }

    /// What is left to the goal from an id on the part of the route that holds.
    #[must_use]
    pub fn left(&self, id: u32, cell: Cell) -> Option<W> {
        let place = self.place(id, cell)?;
        (place < self.sound).then(|| self.left[place])
    }

    /// The most that is left anywhere on the part of the route that holds.
    #[must_use]
    pub fn most(&self) -> Option<W> {
        self.sound.checked_sub(1).map(|last| self.left[last])
    }

    /// Takes note of changed cells: what they break no longer holds.
    pub fn check(&mut self, problem: &GridProblem, changed: &[u32], weights: Weights) {
        if self.sound <= 1 {
            return;
        }
        if changed.len() > self.sound / 8 {
            // To walk along the route is less work.
            let broken = (1..self.sound).find(|&from| !self.holds(problem, from, weights));
            self.sound = broken.unwrap_or(self.sound);
            return;
        }
        let grid = problem.grid();
        let layout = grid.layout();
        for &id in changed {
            let cell = layout.cell(id);
            // A cell also hinders the diagonal steps that pass it.
            let around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy)));
            for (dx, dy) in around {
                let near = Cell {
                    x: cell.x.wrapping_add_signed(dx),
                    y: cell.y.wrapping_add_signed(dy),
                };
                if !layout.contains(near) {
                    continue;
                }
                let Some(place) = self.place(layout.id(near), near) else {
                    continue;
                };
                for from in [place, place + 1] {
                    if (1..self.sound).contains(&from) && !self.holds(problem, from, weights) {
                        self.sound = from;
                    }
                }
            }
        }
    }

    /// Whether the step from a place on towards the goal is legal and weighs what it did.
    fn holds(&self, problem: &GridProblem, from: usize, weights: Weights) -> bool {
        let (cell, next) = (self.cells[from], self.cells[from - 1]);
        let step = (
            next.x.wrapping_sub(cell.x).cast_signed(),
            next.y.wrapping_sub(cell.y).cast_signed(),
        );
        let Some(k) = (0..8).find(|&k| DIRECTIONS[k as usize] == step) else {
            return false;
        };
        let grid = problem.grid();
        let layout = grid.layout();
        let legal = problem.moves().legal(grid.around_id(layout.id(cell)));
        let weight = weights.step::<W>(grid, layout.id(cell), layout.id(next), k);
        grid.is_free(cell) && legal >> k & 1 == 1 && self.left[from] == self.left[from - 1] + weight
    }

    /// Keeps only what follows from a cell on the route that holds.
    pub fn cut_to(&mut self, id: u32, cell: Cell) {
        let keep = self.place(id, cell).map_or(0, |place| place + 1);
        self.cells.truncate(keep);
        self.left.truncate(keep);
        self.sound = self.sound.min(keep);
    }

    /// Begins anew at the goal.
    pub fn restart(&mut self, id: u32, goal: Cell) {
        self.forget();
        self.extend(id, goal, W::default());
    }

    /// Puts a cell before the route, from which so much is left.
    pub fn extend(&mut self, id: u32, cell: Cell, left: W) {
        #[expect(clippy::cast_possible_truncation, reason = "a path within the grid")]
        let place = self.cells.len() as u32;
        self.places[id as usize] = place;
        self.cells.push(cell);
        self.left.push(left);
        self.sound = self.cells.len();
    }

    /// What is left of the whole route.
    #[must_use]
    pub fn weight(&self) -> Option<W> {
        self.left.last().copied()
    }

    /// The route, the start first.
    #[must_use]
    pub fn path(&self) -> Vec<Cell> {
        self.cells.iter().rev().copied().collect()
    }
}
