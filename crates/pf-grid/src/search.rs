//! The best-first search that Dijkstra, A* and their kin share.

use crate::{
    Buckets, Cell, GridProblem, Layout, Weights, Word,
    onward::{Onward, Pruned, Weighed},
};
use pf_core::Context;

/// What a search knows of a cell. Twelve bytes for [`u64`] instead of sixteen, ten for
/// [`U48`](crate::U48): on large maps memory traffic is what a search waits for.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, packed(4))]
struct Record<K> {
    /// Least weight found from the start, as a [`Word`] is kept.
    g: K,
    /// The search this belongs to; others are as good as never written.
    generation: u16,
    /// The set of directions in which the cell was reached at weight `g`.
    arrivals: u8,
    /// Expanded at weight `g`.
    closed: bool,
}

/// What a search is to find.
#[derive(Clone, Copy, Debug)]
struct Aim<W> {
    /// A path that weighs less.
    bound: W,
    /// And to keep what need not be expanded for that.
    keeps: bool,
}

/// How a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End<W> {
    /// At the goal, reached at this weight, the least there is.
    Goal(W),
    /// Everything within reach was expanded; no goal among it.
    Exhausted,
    /// The budget ran out.
    Cut,
    /// What is left lies beyond [`Word::LIMIT`]: ask in a wider word.
    TooFar,
}

/// Best-first search on a grid: exact for every move rule, with and without terrain.
///
/// Memory is kept between calls and cleared by generations: after the first call on a grid a
/// search allocates nothing, and touches only the cells it reaches. On grids without terrain only
/// canonical successors are generated.
///
/// A cell may be expanded more than once, as the open list orders buckets and not keys; the search
/// goes on until no bucket is left that could hold a better path to the goal.
#[derive(Clone, Debug, Default)]
pub struct Search<W: Word> {
    records: Vec<Record<W::Kept>>,
    generation: u16,
    open: Buckets<W>,
    /// What a search that keeps it had no need to expand after it had arrived.
    later: Vec<(u32, W)>,
    layout: Option<Layout>,
    /// Where the last search's best path was known to go on.
    reached: u32,
}

impl<W: Word> Search<W> {
    /// Searches from `start` to `goal`, or everywhere if there is none, in the order of weight
    /// plus `heuristic`. The heuristic takes ids and must be consistent.
    pub fn run(
        &mut self,
        problem: &GridProblem,
        start: Cell,
        goal: Option<Cell>,
        heuristic: impl Fn(u32) -> W,
        cx: &mut Context<'_, GridProblem>,
    ) -> End<W> {
        let goal = goal.map_or(u32::MAX, |cell| problem.grid().layout().id(cell));
        let arrive = |id, _| (id == goal).then(W::default);
        self.run_until(problem, start, |id| Some(heuristic(id)), arrive, cx)
    }

    /// Searches from the problem's start to its goal: A\* by the octile heuristic.
    ///
    /// Source: Hart, Nilsson, Raphael, *A Formal Basis for the Heuristic Determination of Minimum Cost Paths*, 1968.
    // Within a larger function it takes a twentieth longer.
    #[inline(never)]
    pub fn find(&mut self, problem: &GridProblem, cx: &mut Context<'_, GridProblem>) -> End<W> {
        let (grid, goal) = (problem.grid(), problem.goal());
        let octile = Weights::of(grid).octile(grid, problem.moves(), goal);
        self.run(problem, problem.start(), Some(goal), octile, cx)
    }

    /// Searches from `start` until no path shorter than the best one known is possible.
    ///
    /// `heuristic` takes ids and bounds from below what is left to go; `None` if nothing leads on
    /// from there. `arrive` is told every id expanded and its weight from the start, and says what
    /// it takes to go on to the goal in a way the caller knows, if it knows one. An id may be
    /// expanded, and told, more than once.
    ///
    /// A heuristic that is not consistent costs expansions, not exactness.
    pub fn run_until(
        &mut self,
        problem: &GridProblem,
        start: Cell,
        heuristic: impl Fn(u32) -> Option<W>,
        arrive: impl FnMut(u32, W) -> Option<W>,
        cx: &mut Context<'_, GridProblem>,
    ) -> End<W> {
        let start = problem.grid().layout().id(start);
        let seeds = [(start, W::default())];
        self.run_from(problem, &seeds, W::LIMIT, heuristic, arrive, cx)
    }

    /// The same, so that [`go_on`](Self::go_on) can.
    pub fn run_keeping(
        &mut self,
        problem: &GridProblem,
        start: Cell,
        heuristic: impl Fn(u32) -> Option<W>,
        arrive: impl FnMut(u32, W) -> Option<W>,
        cx: &mut Context<'_, GridProblem>,
    ) -> End<W> {
        let seeds = [(problem.grid().layout().id(start), W::default())];
        let aim = Aim {
            bound: W::LIMIT,
            keeps: true,
        };
        self.run_within(problem, &seeds, aim, heuristic, arrive, cx)
    }

    /// Goes on with a search [`run_keeping`](Self::run_keeping), by the same problem and heuristic: from where
    /// all cells are expanded over which paths are shorter than `known`, to where they are for `until`. Says how
    /// far it came within the budget.
    pub fn go_on(
        &mut self,
        problem: &GridProblem,
        (mut known, until): (W, W),
        heuristic: impl Fn(u32) -> Option<W>,
        cx: &mut Context<'_, GridProblem>,
    ) -> W {
        if self.layout != Some(*problem.grid().layout())
            || self.open.is_empty() && self.later.is_empty()
        {
            return known;
        }
        for (id, g) in self.later.drain(..) {
            let record = &mut self.records[id as usize];
            // Where it arrived nothing was expanded.
            record.closed &= W::of(record.g) != g;
            if let Some(least) = heuristic(id) {
                self.open.push(g + least, id, g);
            }
        }
        while known < until {
            let bound = until.min(known + W::STRAIGHT);
            let aim = Aim { bound, keeps: true };
            let end = self.expand(problem, aim, false, &heuristic, |_, _| None, cx);
            if end == End::Cut {
                break;
            }
            known = bound;
        }
        known
    }

    /// As [`run_until`](Self::run_until), from several ids, each with its weight to begin with, for a path that
    /// weighs less than `bound`: [`End::Exhausted`] means that there is none. Blocked seeds do not count.
    pub fn run_from(
        &mut self,
        problem: &GridProblem,
        seeds: &[(u32, W)],
        bound: W,
        heuristic: impl Fn(u32) -> Option<W>,
        arrive: impl FnMut(u32, W) -> Option<W>,
        cx: &mut Context<'_, GridProblem>,
    ) -> End<W> {
        let aim = Aim {
            bound,
            keeps: false,
        };
        self.run_within(problem, seeds, aim, heuristic, arrive, cx)
    }

    fn run_within(
        &mut self,
        problem: &GridProblem,
        seeds: &[(u32, W)],
        aim: Aim<W>,
        heuristic: impl Fn(u32) -> Option<W>,
        arrive: impl FnMut(u32, W) -> Option<W>,
        cx: &mut Context<'_, GridProblem>,
    ) -> End<W> {
        let grid = problem.grid();
        let weights = Weights::of(grid);
        self.begin(grid.layout());
        self.later.clear();
        let key = |&(id, g): &(u32, W)| {
            let least = grid.is_free_id(id).then(|| heuristic(id))??;
            Some(g + least)
        };
        let Some(first) = seeds.iter().filter_map(key).min() else {
            return End::Exhausted;
        };
        // One step changes the key by its weight and the heuristic by no more than that. Where seeds
        // lie further apart than the list is wide, some are looked at early, which is no harm.
        let reach = weights.reach();
        self.open.reset(first, reach, weights.shift::<W>());
        let mut beyond = false;
        for seed in seeds {
            let &(id, g) = seed;
            let known = self.weight(id);
            if let Some(key) = key(seed)
                && known.is_none_or(|known| g < known)
            {
                if key >= aim.bound {
                    beyond = true;
                    continue;
                }
                self.records[id as usize] = Record {
                    g: g.keep(),
                    generation: self.generation,
                    arrivals: 0,
                    closed: false,
                };
                self.open.push(key, id, g);
            }
        }
        self.expand(problem, aim, beyond, heuristic, arrive, cx)
    }

    fn expand(
        &mut self,
        problem: &GridProblem,
        aim: Aim<W>,
        beyond: bool,
        heuristic: impl Fn(u32) -> Option<W>,
        arrive: impl FnMut(u32, W) -> Option<W>,
        cx: &mut Context<'_, GridProblem>,
    ) -> End<W> {
        let (grid, moves) = (problem.grid(), problem.moves());
        let layout = grid.layout();
        let aim = (aim, beyond);
        if grid.is_uniform() {
            let onward = Pruned::new(grid, moves);
            self.search(layout, aim, heuristic, arrive, &onward, cx)
        } else {
            let onward = Weighed::new(grid, moves);
            self.search(layout, aim, heuristic, arrive, &onward, cx)
        }
    }

    /// Makes ready for grids of a layout, so that the next search need not.
    pub fn prepare(&mut self, layout: &Layout) {
        if self.layout != Some(*layout) {
            self.layout = Some(*layout);
            self.records.clear();
            self.records.resize(layout.len(), Record::default());
            self.generation = 0;
        }
    }

    fn begin(&mut self, layout: &Layout) {
        self.prepare(layout);
        if self.generation == u16::MAX {
            self.records.fill(Record::default());
            self.generation = 0;
        }
        self.generation += 1;
    }

    fn search<S: Onward<W>>(
        &mut self,
        layout: &Layout,
        (aim, mut beyond): (Aim<W>, bool),
        heuristic: impl Fn(u32) -> Option<W>,
        mut arrive: impl FnMut(u32, W) -> Option<W>,
        steps: &S,
        cx: &mut Context<'_, GridProblem>,
    ) -> End<W> {
        let offsets = layout.offsets();
        let generation = self.generation;
        // No path as heavy as this is of interest, first for exactness, then for being no better.
        let mut bound = aim.bound;
        let mut limit = if aim.keeps { W::LIMIT } else { bound };
        while let Some((id, g)) = self.open.pop(bound) {
            let record = &mut self.records[id as usize];
            if record.closed || W::of(record.g) != g {
                continue;
            }
            if !cx.proceed() {
                self.open.push(W::default(), id, g);
                return End::Cut;
            }
            record.closed = true;
            let arrivals = record.arrivals;
            cx.expanded(|| layout.cell(id));
            if let Some(rest) = arrive(id, g) {
                if g + rest < bound {
                    bound = g + rest;
                    limit = bound;
                    self.reached = id;
                }
                // There is no better way on from here.
                if heuristic(id).is_none_or(|least| least >= rest) {
                    if aim.keeps {
                        self.later.push((id, g));
                    }
                    continue;
                }
            }
            let mut onward = steps.onward(id, arrivals);
            while onward != 0 {
                let k = onward.trailing_zeros();
                onward &= onward - 1;
                let next = id.wrapping_add_signed(offsets[k as usize]);
                let next_g = g + steps.weight(id, next, k);
                let record = &mut self.records[next as usize];
                let arrival = 1 << k;
                let known = W::of(record.g);
                if record.generation == generation && next_g >= known {
                    if next_g > known || record.arrivals & arrival != 0 || !S::CANONICAL {
                        continue;
                    }
                    // From where the search began all successors are due already.
                    if record.arrivals == 0 {
                        continue;
                    }
                    // As good as the best, from elsewhere: other successors may be due.
                    record.arrivals |= arrival;
                    if !record.closed {
                        continue;
                    }
                    record.closed = false;
                } else {
                    *record = Record {
                        g: next_g.keep(),
                        generation,
                        arrivals: arrival,
                        closed: false,
                    };
                }
                let Some(least) = heuristic(next) else {
                    continue;
                };
                let key = next_g + least;
                if key < limit {
                    self.open.push(key, next, next_g);
                } else if aim.keeps && bound < aim.bound {
                    self.later.push((next, next_g));
                } else {
                    beyond = true;
                }
            }
        }
        if bound < aim.bound {
            End::Goal(bound)
        } else if beyond && aim.bound == W::LIMIT {
            End::TooFar
        } else {
            End::Exhausted
        }
    }

    /// The cell from which the last search's best path goes on in a way its caller knew: the goal,
    /// of a plain search.
    #[must_use]
    pub fn reached(&self) -> u32 {
        self.reached
    }

    /// The weight at which the last search reached a cell: the least one if the cell was expanded.
    #[must_use]
    pub fn weight(&self, id: u32) -> Option<W> {
        let record = self.records.get(id as usize)?;
        (record.generation == self.generation).then(|| W::of(record.g))
    }

    /// The path on which the last search reached `to`, the start first; empty if it did not. Of
    /// equally good ways back the first in the order of [`DIRECTIONS`](crate::DIRECTIONS) is taken.
    #[must_use]
    pub fn path(&self, to: Cell) -> Vec<Cell> {
        let Some((layout, weight)) = self.layout.and_then(|layout| {
            let weight = self.weight(layout.id(to))?;
            Some((layout, weight))
        }) else {
            return Vec::new();
        };
        let offsets = layout.offsets();
        // Every step weighs at least as much as a straight one.
        let mut path = Vec::with_capacity(weight.over(W::STRAIGHT) + 1);
        let mut id = layout.id(to);
        loop {
            path.push(layout.cell(id));
            let arrivals = self.records[id as usize].arrivals;
            if arrivals == 0 {
                path.reverse();
                return path;
            }
            let k = arrivals.trailing_zeros() as usize;
            id = id.wrapping_add_signed(-offsets[k]);
        }
    }

    /// The steps of the path on which the last search reached an id, the last one first: the id each
    /// goes from, the weight of that one, and the direction. None if it did not.
    pub fn back(&self, to: u32) -> impl Iterator<Item = (u32, W, u32)> + '_ {
        let offsets = self.layout.map_or([0; 8], |layout| layout.offsets());
        let mut at = self.weight(to).map(|_| to);
        std::iter::from_fn(move || {
            let arrivals = self.records[at? as usize].arrivals;
            let k = arrivals.trailing_zeros();
            let from = at?.wrapping_add_signed(-*offsets.get(k as usize)?);
            at = Some(from);
            Some((from, W::of(self.records[from as usize].g), k))
        })
    }

    /// Of the last search, which weighed `whole` from its start to its goal ([`Word::MAX`] if that was
    /// out of reach): how far an id is from the start, and `true`; or a bound of it from below, and
    /// `false`. [`Word::MAX`] if it is out of reach.
    ///
    /// `to_start` and `to_goal` are the heuristic's values for the two. It is a consistent heuristic
    /// itself. A path over a cell whose distance is not known is no shorter than `whole`, which of a search that
    /// [went on](Self::go_on) is how far it came.
    #[inline]
    #[must_use]
    pub fn estimate(&self, id: u32, whole: W, to_start: W, to_goal: W) -> (W, bool) {
        let record = self.records[id as usize];
        let reached = record.generation == self.generation;
        let g = W::of(record.g);
        if whole == W::MAX {
            return (if reached { g } else { W::MAX }, true);
        }
        // Every cell over which a path was shorter than the whole was expanded at its least weight.
        if reached && record.closed && g + to_goal <= whole {
            return (g, true);
        }
        let over = whole.max(to_goal) - to_goal;
        (to_start.max(over), false)
    }

    /// Puts an id among those that the last search expanded at this weight. No way [back](Self::back) leads on from it.
    pub fn insert(&mut self, id: u32, g: W) {
        self.records[id as usize] = Record {
            g: g.keep(),
            generation: self.generation,
            arrivals: 0,
            closed: true,
        };
    }

    /// The neighbour over which an id is `left` from the last search's start, by a step that is
    /// legal now, and what the step weighs; of several the first in the order of
    /// [`DIRECTIONS`](crate::DIRECTIONS).
    #[must_use]
    pub fn next(&self, problem: &GridProblem, id: u32, left: W) -> Option<(u32, W)> {
        let grid = problem.grid();
        let offsets = grid.layout().offsets();
        let weights = Weights::of(grid);
        let legal = problem.moves().legal(grid.around_id(id));
        (0..8).filter(|k| legal >> k & 1 == 1).find_map(|k: u32| {
            let next = id.wrapping_add_signed(offsets[k as usize]);
            let weight = weights.step(grid, id, next, k);
            let rest = self.weight(next)?;
            (rest < left && rest + weight == left).then_some((next, weight))
        })
    }

    /// Of the cells the last search reached, the one nearest `to` in a straight line; ties go to
    /// the upper, then the left one.
    #[must_use]
    pub fn nearest(&self, to: Cell) -> Option<Cell> {
        let layout = self.layout?;
        let square = |a: u32, b: u32| u64::from(a.abs_diff(b)).pow(2);
        layout
            .cells()
            .filter(|&cell| self.weight(layout.id(cell)).is_some())
            .min_by_key(|cell| square(cell.x, to.x) + square(cell.y, to.y))
    }

    /// How many ids the grid of the last search has.
    #[must_use]
    #[expect(clippy::len_without_is_empty, reason = "a layout is never empty")]
    pub fn len(&self) -> usize {
        self.records.len()
    }

    /// Bytes held.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.records.capacity() * size_of::<Record<W::Kept>>()
            + self.open.bytes()
            + self.later.capacity() * size_of::<(u32, W)>()
    }
}
