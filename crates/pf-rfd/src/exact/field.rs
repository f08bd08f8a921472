//! Altitudes that are lower bounds on the distance to the goal, and the drops that raise them.

use pf_core::{Context, Solved};
use pf_grid::{Cell, Grid, GridChange, GridCost, GridProblem, Layout, Weights, Word};
use std::{cmp::Reverse, collections::BinaryHeap};

/// A pool of so many cells begins one cell upstream of where the drop is caught. Less, and drops
/// arrive late but by a better way; more, and what lies too low upstream catches the next ones.
const UPSTREAM: usize = 64;

/// How the drops ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// The best path is a shortest one.
    Proved,
    /// There is no path.
    Closed,
    /// The budget ran out.
    Cut,
    /// Altitudes are beyond what the word orders exactly.
    TooFar,
}

/// What became of a pool.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Pool<W> {
    /// It is full; its lowest outlet, and the level.
    Full(u32, W),
    /// The water is at the target; the level.
    Reached(W),
    /// It has no outlet.
    Closed,
    Cut,
    TooFar,
}

/// What a pool knows of a cell.
#[derive(Clone, Copy, Debug, Default)]
struct Record<W> {
    /// Least weight found from where the pool began.
    g: W,
    /// The pool this belongs to.
    pool: u32,
    /// The direction in which the cell was reached.
    from: u8,
    closed: bool,
}

/// Altitudes and drops in a word.
///
/// Altitudes are consistent: none is higher than a neighbour's and the step to it. So they are
/// lower bounds, and a drop that finds each cell of its way just as high as its lowest neighbour
/// and the step to that has gone a shortest way.
#[derive(Clone, Debug, Default)]
pub(super) struct Field<W: Copy + Ord> {
    altitude: Vec<W>,
    layout: Option<Layout>,
    weights: Option<Weights>,
    goal: Cell,
    records: Vec<Record<W>>,
    pool: u32,
    open: BinaryHeap<(Reverse<W>, W, u32)>,
    closed: Vec<u32>,
    trail: Vec<u32>,
    /// Where on the trail a cell stood last; it counts only if the trail agrees.
    place: Vec<u32>,
    best: Vec<u32>,
}

impl<W: Word> Field<W> {
    /// Whether the word is wide enough for every sum on this grid.
    pub(super) fn fits(problem: &GridProblem) -> bool {
        Weights::of(problem.grid()).fit::<W>(problem.grid(), 2)
    }

    /// Whether the altitudes were made for grids of this shape.
    pub(super) fn covers(&self, problem: &GridProblem) -> bool {
        self.layout == Some(*problem.grid().layout())
    }

    /// Octile altitudes.
    pub(super) fn begin(&mut self, problem: &GridProblem) {
        let grid = problem.grid();
        let layout = grid.layout();
        if self.layout != Some(*layout) {
            *self = Self::default();
            self.layout = Some(*layout);
            self.records.resize(layout.len(), Record::default());
            self.place.resize(layout.len(), 0);
        }
        let weights = Weights::of(grid);
        self.weights = Some(weights);
        self.goal = problem.goal();
        let octile = weights.octile::<W>(grid, problem.moves(), self.goal);
        self.altitude.clear();
        self.altitude.resize(layout.len(), W::default());
        for cell in layout.cells() {
            let id = layout.id(cell);
            self.altitude[id as usize] = octile(id);
        }
    }

    /// The altitude of a cell, in steps.
    #[expect(clippy::cast_precision_loss, reason = "for looking at")]
    pub(super) fn altitude(&self, cell: Cell) -> f64 {
        let Some(layout) = self.layout.filter(|layout| layout.contains(cell)) else {
            return 0.0;
        };
        let uniform = self.weights.is_none_or(|weights| weights.is_uniform());
        let unit = W::STRAIGHT.wide() as f64 * if uniform { 1.0 } else { 2.0 };
        self.altitude[layout.id(cell) as usize].wide() as f64 / unit
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        self.altitude.capacity() * size_of::<W>()
            + self.records.capacity() * size_of::<Record<W>>()
            + self.open.capacity() * size_of::<(Reverse<W>, W, u32)>()
            + (self.closed.capacity() + self.trail.capacity()) * size_of::<u32>()
            + (self.place.capacity() + self.best.capacity()) * size_of::<u32>()
    }

    /// The best path a drop took since the drops began; empty if none arrived.
    pub(super) fn path(&self) -> Vec<Cell> {
        let cells = |layout: Layout| self.best.iter().map(|&id| layout.cell(id)).collect();
        self.layout.map_or_else(Vec::new, cells)
    }

    /// Lets drops run until one changes nothing. A pool begins with `first` cells, and each holds
    /// twice as many as the one before.
    pub(super) fn run(
        &mut self,
        problem: &GridProblem,
        first: usize,
        cx: &mut Context<'_, GridProblem>,
    ) -> End {
        let layout = *problem.grid().layout();
        let start = layout.id(problem.start());
        let mut best: Option<GridCost> = None;
        let mut size = first;
        self.best.clear();
        loop {
            let changed = match self.drop(problem, &mut size, cx) {
                Ok(changed) => changed,
                Err(end) => return end,
            };
            let (cost, weight) = self.trail_cost(problem);
            let trail = &self.trail;
            let cells = || trail.iter().map(|&id| layout.cell(id)).collect::<Vec<_>>();
            cx.candidate(cells);
            if best.is_none_or(|best| cost < best) {
                best = Some(cost);
                cx.improved(|| Solved {
                    solution: cells(),
                    cost,
                });
                self.best.clear();
                self.best.extend_from_slice(&self.trail);
            }
            self.settle_trail(problem);
            cx.field("altitude", |&cell: &Cell| self.altitude(cell));
            let bound = self.altitude[start as usize];
            if bound >= W::LIMIT {
                return End::TooFar;
            }
            if !changed || weight == bound.wide() {
                return End::Proved;
            }
        }
    }

    /// One drop from the start to the goal; says whether it changed an altitude.
    fn drop(
        &mut self,
        problem: &GridProblem,
        size: &mut usize,
        cx: &mut Context<'_, GridProblem>,
    ) -> Result<bool, End> {
        let layout = *problem.grid().layout();
        let goal = layout.id(problem.goal());
        let mut at = layout.id(problem.start());
        let mut changed = false;
        self.trail.clear();
        self.put(at);
        if at == goal && !cx.proceed() {
            return Err(End::Cut);
        }
        while at != goal {
            if !cx.proceed() {
                return Err(End::Cut);
            }
            cx.expanded(|| layout.cell(at));
            let (level, next) = self.lowest(problem, at).ok_or(End::Closed)?;
            if level <= self.altitude[at as usize] {
                at = next;
                self.put(at);
                continue;
            }
            changed = true;
            let upstream = self.trail.len().saturating_sub(1 + *size / UPSTREAM);
            at = self.trail[upstream];
            self.trail.truncate(upstream + 1);
            let to = match self.fill(problem, at, goal, *size, cx) {
                Pool::Full(outlet, _) => outlet,
                Pool::Reached(_) => goal,
                Pool::Closed => return Err(End::Closed),
                Pool::Cut => return Err(End::Cut),
                Pool::TooFar => return Err(End::TooFar),
            };
            *size = size.saturating_mul(2);
            self.flow(&layout, at, to);
            at = to;
        }
        Ok(changed)
    }

    /// The least step and altitude beyond it, and where that is; ties go to the first direction.
    fn lowest(&self, problem: &GridProblem, at: u32) -> Option<(W, u32)> {
        let grid = problem.grid();
        let offsets = grid.layout().offsets();
        let weights = self.weights?;
        let mut legal = problem.moves().legal(grid.around_id(at));
        let mut lowest: Option<(W, u32)> = None;
        while legal != 0 {
            let k = legal.trailing_zeros();
            legal &= legal - 1;
            let next = at.wrapping_add_signed(offsets[k as usize]);
            let level = weights.step::<W>(grid, at, next, k) + self.altitude[next as usize];
            if lowest.is_none_or(|(least, _)| level < least) {
                lowest = Some((level, next));
            }
        }
        lowest
    }

    /// Puts a cell at the end of the trail; what lay between its two visits is cut.
    fn put(&mut self, id: u32) {
        let place = self.place[id as usize] as usize;
        if self.trail.get(place) == Some(&id) {
            self.trail.truncate(place + 1);
            return;
        }
        #[expect(clippy::cast_possible_truncation, reason = "no trail has 2^32 cells")]
        {
            self.place[id as usize] = self.trail.len() as u32;
        }
        self.trail.push(id);
    }

    /// Fills the pool around `at`: a best-first search of up to `size` cells, whose altitudes rise
    /// to the level of the lowest outlet.
    fn fill(
        &mut self,
        problem: &GridProblem,
        at: u32,
        target: u32,
        size: usize,
        cx: &mut Context<'_, GridProblem>,
    ) -> Pool<W> {
        let grid = problem.grid();
        let layout = *grid.layout();
        let offsets = layout.offsets();
        let weights = Weights::of(grid);
        if self.pool == u32::MAX {
            self.records.fill(Record::default());
            self.pool = 0;
        }
        self.pool += 1;
        self.open.clear();
        self.closed.clear();
        self.records[at as usize] = Record {
            pool: self.pool,
            ..Record::default()
        };
        self.open
            .push((Reverse(self.altitude[at as usize]), W::default(), at));
        while let Some((Reverse(level), g, id)) = self.open.pop() {
            let record = &mut self.records[id as usize];
            if record.closed || g > record.g {
                continue;
            }
            if level >= W::LIMIT {
                return Pool::TooFar;
            }
            if id == target || self.closed.len() >= size {
                self.raise(level);
                return if id == target {
                    Pool::Reached(level)
                } else {
                    Pool::Full(id, level)
                };
            }
            if !cx.proceed() {
                return Pool::Cut;
            }
            cx.expanded(|| layout.cell(id));
            record.closed = true;
            self.closed.push(id);
            let mut legal = problem.moves().legal(grid.around_id(id));
            while legal != 0 {
                let k = legal.trailing_zeros();
                legal &= legal - 1;
                let next = id.wrapping_add_signed(offsets[k as usize]);
                let through = g + weights.step::<W>(grid, id, next, k);
                let known = &mut self.records[next as usize];
                if known.pool == self.pool && known.g <= through {
                    continue;
                }
                #[expect(clippy::cast_possible_truncation, reason = "a direction is below 8")]
                {
                    *known = Record {
                        g: through,
                        pool: self.pool,
                        from: k as u8,
                        closed: false,
                    };
                }
                let level = through + self.altitude[next as usize];
                self.open.push((Reverse(level), through, next));
            }
        }
        Pool::Closed
    }

    /// Sediment up to the level of the outlet: Koenig and Likhachev 2006.
    fn raise(&mut self, level: W) {
        for &id in &self.closed {
            let risen = level - self.records[id as usize].g;
            let altitude = &mut self.altitude[id as usize];
            *altitude = risen.max(*altitude);
        }
    }

    /// Takes the drop through the pool it filled.
    fn flow(&mut self, layout: &Layout, from: u32, to: u32) {
        let offsets = layout.offsets();
        let mut way = std::mem::take(&mut self.closed);
        way.clear();
        let mut id = to;
        while id != from {
            way.push(id);
            let k = self.records[id as usize].from;
            id = id.wrapping_add_signed(-offsets[usize::from(k)]);
        }
        for &id in way.iter().rev() {
            self.put(id);
        }
        self.closed = way;
    }

    /// The backward pass: along the trail from the goal, what lies too low rises.
    fn settle_trail(&mut self, problem: &GridProblem) {
        for i in (0..self.trail.len().saturating_sub(1)).rev() {
            let id = self.trail[i];
            if let Some((level, _)) = self.lowest(problem, id) {
                let altitude = &mut self.altitude[id as usize];
                *altitude = level.max(*altitude);
            }
        }
    }

    /// What the trail costs, and what it weighs.
    fn trail_cost(&self, problem: &GridProblem) -> (GridCost, u128) {
        let grid = problem.grid();
        let straight = &grid.layout().offsets()[..4];
        let mut cost = GridCost::ZERO;
        for pair in self.trail.windows(2) {
            let sum = u64::from(grid.cost_id(pair[0])) + u64::from(grid.cost_id(pair[1]));
            if straight.contains(&pair[1].wrapping_sub(pair[0]).cast_signed()) {
                cost.straight += sum;
            } else {
                cost.diagonal += sum;
            }
        }
        // Costs count in half steps; weights do where there is terrain.
        let weight = u128::from(cost.straight) * W::STRAIGHT.wide()
            + u128::from(cost.diagonal) * W::DIAGONAL.wide();
        let halves = if grid.is_uniform() { 2 } else { 1 };
        (cost, weight / halves)
    }

    /// Follows what happened to the grid and to the goal, so that altitudes are consistent again.
    /// `None` if that takes as much as beginning anew, or more than the budget.
    pub(super) fn follow(
        &mut self,
        problem: &GridProblem,
        changes: &[GridChange],
        cx: &mut Context<'_, GridProblem>,
    ) -> Option<()> {
        let grid = problem.grid();
        let (old, now) = (self.weights?, Weights::of(grid));
        if !old.hold_under(now) {
            return None;
        }
        self.lower(problem, changes, cx)?;
        if problem.goal() != self.goal {
            self.move_goal(problem, cx)?;
        }
        Some(())
    }

    /// Where cells were freed or got cheaper, altitudes sink until they are consistent: freed
    /// cells to the octile distance, the others as far as those around them say. Blocked and
    /// dearer cells need nothing: the distances only grew.
    fn lower(
        &mut self,
        problem: &GridProblem,
        changes: &[GridChange],
        cx: &mut Context<'_, GridProblem>,
    ) -> Option<()> {
        let grid = problem.grid();
        let layout = *grid.layout();
        let offsets = layout.offsets();
        let weights = self.weights?;
        let octile = weights.octile::<W>(grid, problem.moves(), self.goal);
        self.open.clear();
        for change in changes {
            let (cells, freed) = match change {
                GridChange::Freed(cells) => (cells, true),
                GridChange::CostChanged(cells, _) => (cells, false),
                _ => continue,
            };
            for id in cells.iter().map(|&cell| layout.id(cell)) {
                if freed {
                    let altitude = &mut self.altitude[id as usize];
                    *altitude = octile(id).min(*altitude);
                }
                let around = offsets
                    .into_iter()
                    .map(|offset| id.wrapping_add_signed(offset));
                for id in around.chain([id]).filter(|&id| grid.is_free_id(id)) {
                    self.open
                        .push((Reverse(self.altitude[id as usize]), W::default(), id));
                }
            }
        }
        while let Some((Reverse(level), _, id)) = self.open.pop() {
            if level > self.altitude[id as usize] {
                continue;
            }
            if !cx.proceed() {
                return None;
            }
            cx.expanded(|| layout.cell(id));
            let mut legal = problem.moves().legal(grid.around_id(id));
            while legal != 0 {
                let k = legal.trailing_zeros();
                legal &= legal - 1;
                let next = id.wrapping_add_signed(offsets[k as usize]);
                let most = level + weights.step::<W>(grid, id, next, k);
                if self.altitude[next as usize] > most {
                    self.altitude[next as usize] = most;
                    self.open.push((Reverse(most), W::default(), next));
                }
            }
        }
        Some(())
    }

    /// An old altitude less the distance between the goals is a lower bound for the new one.
    fn move_goal(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Option<()> {
        let grid: &Grid = problem.grid();
        let layout = grid.layout();
        let (from, to) = (layout.id(problem.goal()), layout.id(self.goal));
        let most = (grid.free_cells() as usize / 8).max(64);
        let Pool::Reached(between) = self.fill(problem, from, to, most, cx) else {
            return None;
        };
        self.goal = problem.goal();
        let octile = self.weights?.octile::<W>(grid, problem.moves(), self.goal);
        for cell in layout.cells() {
            let id = layout.id(cell);
            let altitude = &mut self.altitude[id as usize];
            let kept = if *altitude > between {
                *altitude - between
            } else {
                W::default()
            };
            *altitude = octile(id).max(kept);
        }
        Some(())
    }
}
