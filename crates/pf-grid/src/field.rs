//! Distances to a goal that are repaired as the map changes: the searches of D* Lite.

use crate::{Buckets, Cell, GridProblem, Layout, Weights, Word};
use pf_core::Context;
use std::{cmp::Reverse, collections::BinaryHeap};

/// What the field knows of a cell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Node<W> {
    /// Distance to the goal as it was when the cell was last expanded; [`Word::MAX`] if never.
    g: W,
    /// One-step lookahead: the least step + g over the neighbours. [`Word::MAX`] if there is none.
    rhs: W,
}

/// A node in memory. Packed: on large maps memory traffic is what a search waits for.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, packed(4))]
struct Kept<W> {
    node: Node<W>,
    /// The plan this belongs to; others are as good as never written.
    generation: u16,
}

/// k1 = min(g, rhs) + h + `k_m`, k2 = min(g, rhs); the id breaks ties.
type Key<W> = (W, W, u32);

/// How work on a [`DistanceField`] ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Upkeep {
    /// The start's distance is known, or known to be infinite.
    Settled,
    /// The budget ran out. What was done so far is sound, a next repair goes on from it.
    Cut,
    /// Repairing has taken as much as it may.
    GaveUp,
}

/// Distances to one goal, repaired as the map changes.
///
/// They are exact where a shortest path from the start may lead, and bounds from below elsewhere:
/// [`estimate`](Self::estimate) says which.
///
/// Source: Koenig and Likhachev, *D\* Lite*, 2002, the optimised version (its Figure 4).
#[derive(Clone, Debug)]
pub struct DistanceField<W: Copy> {
    nodes: Vec<Kept<W>>,
    generation: u16,
    layout: Option<Layout>,
    weights: Option<Weights>,
    goal: u32,
    start: Cell,
    /// What keys have to be raised by for the robot having moved.
    k_m: W,
    /// The open list of a plan from scratch: no key ever falls in one.
    fresh: Buckets<W>,
    /// The open list of repairs. An entry is stale if its cell is consistent or has another key.
    repairs: BinaryHeap<Reverse<Key<W>>>,
    /// Some distance was too long for the word and is held for infinite.
    too_far: bool,
    /// The start whose distance the field was last settled for, and that distance; [`Word::MAX`]
    /// if the goal is out of reach from there.
    settled: Option<(Cell, W)>,
}

impl<W: Word> Default for DistanceField<W> {
    fn default() -> Self {
        Self {
            nodes: Vec::new(),
            generation: 0,
            layout: None,
            weights: None,
            goal: 0,
            start: Cell::default(),
            k_m: W::default(),
            fresh: Buckets::default(),
            repairs: BinaryHeap::new(),
            too_far: false,
            settled: None,
        }
    }
}

impl<W: Word> DistanceField<W> {
    /// Whether a field for this problem fits the word.
    #[must_use]
    pub fn fits(problem: &GridProblem) -> bool {
        // A key is a distance, a heuristic and k_m, which stays below the limit, too.
        Weights::of(problem.grid()).fit::<W>(problem.grid(), 2)
    }

    /// Whether the field lies over a grid of the problem's shape.
    pub fn covers(&self, problem: &GridProblem) -> bool {
        self.layout == Some(*problem.grid().layout())
    }

    /// Whether the field can be repaired into one for `problem`.
    pub fn serves(&self, problem: &GridProblem) -> bool {
        self.covers(problem)
            && self.goal == problem.grid().layout().id(problem.goal())
            && self
                .weights
                .is_some_and(|then| then.hold_under(Weights::of(problem.grid())))
    }

    /// Whether the answer may be wrong for want of width: the start seems out of reach, but some
    /// distances were cut off.
    pub fn is_too_narrow(&self, start: Cell) -> bool {
        let rhs = |layout: Layout| self.node(layout.id(start)).rhs;
        self.too_far && self.layout.is_some_and(|layout| rhs(layout) == W::MAX)
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        self.nodes.capacity() * size_of::<Kept<W>>()
            + self.fresh.bytes()
            + self.repairs.capacity() * size_of::<Reverse<Key<W>>>()
    }

    /// Searches from the goal to the start, forgetting what was known: A*, whose closed cells are
    /// consistent and whose open ones are overconsistent.
    pub fn plan(&mut self, problem: &GridProblem, cx: &mut Context<'_, GridProblem>) -> Upkeep {
        let end = self.search(problem, cx);
        self.settle_for(end, problem.start())
    }

    fn settle_for(&mut self, end: Upkeep, start: Cell) -> Upkeep {
        let rhs = self.layout.map(|layout| self.node(layout.id(start)).rhs);
        self.settled = rhs
            .filter(|_| end == Upkeep::Settled)
            .map(|rhs| (start, rhs));
        end
    }

    /// The start for which the field holds, and its distance; `None` while work on the field is
    /// unfinished.
    #[must_use]
    pub fn settled(&self) -> Option<(Cell, W)> {
        self.settled
    }

    /// Gives the field up.
    pub fn forget(&mut self) {
        self.settled = None;
        self.weights = None;
    }

    /// What is left to the goal from an id, as far as the settled field knows: the distance and
    /// `true`, or a bound from below and `false`. [`Word::MAX`] if the goal is out of reach.
    ///
    /// `to_goal` and `to_start` are the heuristic's values for the goal and the settled start. It
    /// is a consistent heuristic itself. A path over a cell that was not settled is no shorter than
    /// the settled start's own.
    #[inline]
    #[must_use]
    pub fn estimate(&self, id: u32, to_goal: W, to_start: W) -> (W, bool) {
        let Some((_, whole)) = self.settled else {
            return (to_goal, false);
        };
        let node = self.node(id);
        let consistent = node.g == node.rhs;
        if whole == W::MAX {
            return if consistent {
                (node.g, true)
            } else {
                (to_goal, false)
            };
        }
        if consistent && node.g < W::LIMIT && node.g + to_start <= whole {
            return (node.g, true);
        }
        let over = whole.max(to_start) - to_start;
        (to_goal.max(over), false)
    }

    /// The neighbour over which so much is left from a cell, by a step that is legal now, and what
    /// the step weighs; of several the first in the order of [`DIRECTIONS`](crate::DIRECTIONS).
    #[must_use]
    pub fn next(&self, problem: &GridProblem, id: u32, left: W) -> Option<(u32, W)> {
        let repair = Repair::of(problem, self.weights);
        let leads = |&(next, weight): &(u32, W)| {
            let rest = self.node(next).g;
            rest < left && rest + weight == left
        };
        repair.steps::<W>(id).find(leads)
    }

    fn search(&mut self, problem: &GridProblem, cx: &mut Context<'_, GridProblem>) -> Upkeep {
        let grid = problem.grid();
        let layout = *grid.layout();
        let weights = Weights::of(grid);
        self.begin(layout);
        self.weights = Some(weights);
        self.goal = layout.id(problem.goal());
        self.start = problem.start();
        let start = layout.id(problem.start());
        let heuristic = weights.octile::<W>(grid, problem.moves(), problem.start());
        let first = heuristic(self.goal);
        self.fresh
            .reset(first, weights.reach(), weights.shift::<W>());
        self.set_rhs(self.goal, W::default());
        self.fresh.push(first, self.goal, W::default());

        let offsets = layout.offsets();
        let mut bound = W::LIMIT;
        while let Some((id, value)) = self.fresh.pop(bound) {
            let node = self.node(id);
            if node.rhs != value || node.g == value {
                continue;
            }
            if !cx.proceed() {
                return Upkeep::Cut;
            }
            self.set_g(id, value);
            cx.expanded(|| layout.cell(id));
            if id == start {
                bound = value;
            }
            let mut legal = problem.moves().legal(grid.around_id(id));
            while legal != 0 {
                let k = legal.trailing_zeros();
                legal &= legal - 1;
                let next = id.wrapping_add_signed(offsets[k as usize]);
                let through = value + weights.step(grid, id, next, k);
                if through >= W::LIMIT {
                    self.too_far = true;
                    continue;
                }
                if through < self.node(next).rhs {
                    self.set_rhs(next, through);
                    self.fresh.push(through + heuristic(next), next, through);
                }
            }
        }
        // What still waits there lies beyond the limit, unless the start was found first.
        self.too_far |= bound == W::LIMIT && !self.fresh.is_empty();
        Upkeep::Settled
    }

    /// Hands the open list of a plan over to repairs. Costs the size of the list.
    pub fn prepare(&mut self, problem: &GridProblem) {
        if self.fresh.is_empty() {
            return;
        }
        let Some(weights) = self.weights else { return };
        let heuristic = weights.octile::<W>(problem.grid(), problem.moves(), self.start);
        let mut open = std::mem::take(&mut self.repairs).into_vec();
        let mut fresh = std::mem::take(&mut self.fresh);
        open.extend(fresh.drain().filter_map(|(id, value)| {
            let node = self.node(id);
            let live = node.rhs == value && node.g != value;
            live.then(|| Reverse((value + heuristic(id) + self.k_m, value, id)))
        }));
        self.fresh = fresh;
        self.repairs = BinaryHeap::from(open);
    }

    /// Repairs the field after the map changed at `changed` and the robot moved to the problem's
    /// start, expanding at most `most` cells.
    pub fn repair(
        &mut self,
        problem: &GridProblem,
        changed: &[u32],
        most: u64,
        cx: &mut Context<'_, GridProblem>,
    ) -> Upkeep {
        let end = self.mend(problem, changed, most, cx);
        self.settle_for(end, problem.start())
    }

    fn mend(
        &mut self,
        problem: &GridProblem,
        changed: &[u32],
        most: u64,
        cx: &mut Context<'_, GridProblem>,
    ) -> Upkeep {
        self.prepare(problem);
        let repair = Repair::of(problem, self.weights);
        let moved = repair.between(self.start, problem.start());
        if self.k_m + moved >= W::LIMIT {
            return Upkeep::GaveUp;
        }
        self.k_m = self.k_m + moved;
        self.start = problem.start();
        // A changed cell changes its own edges and the diagonals that pass it.
        for &id in changed {
            self.look_ahead(&repair, id);
            for offset in repair.offsets {
                self.look_ahead(&repair, id.wrapping_add_signed(offset));
            }
        }

        let start = repair.layout.id(problem.start());
        let mut expanded = 0;
        while let Some(&Reverse(top)) = self.repairs.peek() {
            let node = self.node(start);
            let (key, wanted) = (self.key(&repair, start), (top.0, top.1));
            if wanted >= (key.0, key.1) && node.rhs <= node.g {
                break;
            }
            let id = top.2;
            let node = self.node(id);
            if node.g == node.rhs {
                self.repairs.pop();
                continue;
            }
            let key = self.key(&repair, id);
            if wanted < (key.0, key.1) {
                self.repairs.pop();
                self.repairs.push(Reverse(key));
                continue;
            }
            if expanded == most {
                return Upkeep::GaveUp;
            }
            if !cx.proceed() {
                return Upkeep::Cut;
            }
            self.repairs.pop();
            expanded += 1;
            cx.expanded(|| repair.layout.cell(id));
            if node.g > node.rhs {
                self.lower(&repair, id);
            } else {
                self.raise(&repair, id);
            }
        }
        Upkeep::Settled
    }

    /// An overconsistent cell takes its new distance, and its neighbours look at it.
    fn lower(&mut self, repair: &Repair<'_>, id: u32) {
        let value = self.node(id).rhs;
        self.set_g(id, value);
        for (next, weight) in repair.steps::<W>(id) {
            let through = self.capped(value + weight);
            if through < self.node(next).rhs {
                self.set_rhs(next, through);
                self.queue(repair, next);
            }
        }
    }

    /// An underconsistent cell loses its distance, and those who relied on it look elsewhere.
    fn raise(&mut self, repair: &Repair<'_>, id: u32) {
        let old = self.node(id).g;
        self.set_g(id, W::MAX);
        for (next, weight) in repair.steps::<W>(id) {
            if self.node(next).rhs == old + weight {
                self.look_ahead(repair, next);
            }
        }
        self.look_ahead(repair, id);
    }

    /// Computes a cell's rhs anew.
    fn look_ahead(&mut self, repair: &Repair<'_>, id: u32) {
        if id != self.goal {
            let mut rhs = W::MAX;
            for (next, weight) in repair.steps::<W>(id) {
                let g = self.node(next).g;
                if g != W::MAX {
                    rhs = rhs.min(g + weight);
                }
            }
            let rhs = if rhs == W::MAX { rhs } else { self.capped(rhs) };
            self.set_rhs(id, rhs);
        }
        self.queue(repair, id);
    }

    fn queue(&mut self, repair: &Repair<'_>, id: u32) {
        let node = self.node(id);
        if node.g != node.rhs {
            self.repairs.push(Reverse(self.key(repair, id)));
        }
    }

    fn key(&self, repair: &Repair<'_>, id: u32) -> Key<W> {
        let node = self.node(id);
        let least = node.g.min(node.rhs);
        if least == W::MAX {
            return (W::MAX, W::MAX, id);
        }
        let cell = repair.layout.cell(id);
        (
            least + repair.between(self.start, cell) + self.k_m,
            least,
            id,
        )
    }

    /// What lies too far for the word counts as out of reach.
    fn capped(&mut self, value: W) -> W {
        if value < W::LIMIT {
            return value;
        }
        self.too_far = true;
        W::MAX
    }

    fn begin(&mut self, layout: Layout) {
        if self.layout != Some(layout) {
            self.layout = Some(layout);
            self.nodes.clear();
            self.nodes.resize(layout.len(), Kept::default());
            self.generation = 0;
        }
        if self.generation == u16::MAX {
            self.nodes.fill(Kept::default());
            self.generation = 0;
        }
        self.generation += 1;
        self.repairs.clear();
        self.k_m = W::default();
        self.too_far = false;
        self.settled = None;
    }

    #[inline]
    fn node(&self, id: u32) -> Node<W> {
        let kept = self.nodes[id as usize];
        if kept.generation == self.generation {
            return kept.node;
        }
        Node {
            g: W::MAX,
            rhs: W::MAX,
        }
    }

    #[inline]
    fn set_g(&mut self, id: u32, g: W) {
        let node = Node { g, ..self.node(id) };
        self.keep(id, node);
    }

    #[inline]
    fn set_rhs(&mut self, id: u32, rhs: W) {
        let node = Node {
            rhs,
            ..self.node(id)
        };
        self.keep(id, node);
    }

    #[inline]
    fn keep(&mut self, id: u32, node: Node<W>) {
        let generation = self.generation;
        self.nodes[id as usize] = Kept { node, generation };
    }
}

/// What a repair needs to know of the problem.
struct Repair<'p> {
    problem: &'p GridProblem,
    layout: Layout,
    offsets: [i32; 8],
    weights: Weights,
}

impl<'p> Repair<'p> {
    /// By the weights of the field, whose keys the repair must go on from.
    fn of(problem: &'p GridProblem, weights: Option<Weights>) -> Self {
        let layout = *problem.grid().layout();
        Self {
            problem,
            layout,
            offsets: layout.offsets(),
            weights: weights.unwrap_or_else(|| Weights::of(problem.grid())),
        }
    }

    /// The cells one step away, and what the step weighs: none from a blocked cell.
    fn steps<W: Word>(&self, id: u32) -> impl Iterator<Item = (u32, W)> + '_ {
        let grid = self.problem.grid();
        let legal = if grid.is_free_id(id) {
            self.problem.moves().legal(grid.around_id(id))
        } else {
            0
        };
        (0..8)
            .filter(move |k| legal >> k & 1 == 1)
            .map(move |k: u32| {
                let next = id.wrapping_add_signed(self.offsets[k as usize]);
                (next, self.weights.step(grid, id, next, k))
            })
    }

    /// The heuristic between two cells.
    fn between<W: Word>(&self, a: Cell, b: Cell) -> W {
        let grid = self.problem.grid();
        let octile = self.weights.octile::<W>(grid, self.problem.moves(), a);
        octile(self.layout.id(b))
    }
}
