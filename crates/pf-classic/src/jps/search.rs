//! A best-first search over jump points, in one word width.

use super::jumps::{Jumps, fans};
use pf_core::Context;
use pf_grid::{
    Buckets, Cell, End, GridProblem, LastPath, Layout, Learned, Moves, Remnant, Weights, Word,
    successors,
};

/// What is known of a jump point.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, packed(4))]
struct Record<W> {
    /// Least weight found from the start.
    g: W,
    /// The jump point before it.
    parent: u32,
    /// The search this belongs to; others are as good as never written.
    generation: u16,
    /// The set of directions in which it was reached at weight `g`.
    arrivals: u8,
    /// Expanded at weight `g`.
    closed: bool,
}

/// A* whose nodes are jump points.
///
/// A straight run ends at the first cell from which the search may go on elsewhere; a diagonal one
/// sends runs to both sides, and only where those end, nodes come about.
#[derive(Clone, Debug, Default)]
pub(super) struct JumpSearch<W: Copy> {
    records: Vec<Record<W>>,
    generation: u16,
    open: Buckets<W>,
    layout: Option<Layout>,
    /// Something lay beyond what the word orders.
    beyond: bool,
    /// What the last search expanded, if it is to learn from it.
    expanded: Vec<u32>,
    /// What searches to the same goal have found out about jump points.
    learned: Learned<W>,
    goal: u32,
    /// Where the last search joined what is left of the last path, and how far along that is.
    joined: Option<(u32, usize)>,
    /// The way from there to the join, both ends included.
    way: Vec<Cell>,
}

/// A ring of more buckets costs more than the order within a bucket is worth.
const MOST_BUCKETS: u64 = 1 << 14;

/// A walk along a diagonal is put off where its key is so many steps above the one it began at.
/// Measured on made-up maps (random cells, rectangles, mazes): without, open maps take up to three
/// times as long; with 0, mazes twice.
const SLACK: u32 = 4;

impl<W: Word> JumpSearch<W> {
    /// Searches from start to goal, both free. If it learns, searches to come take less. Where a last path is given, it ends
    /// where it can join what is left of that.
    pub(super) fn run(
        &mut self,
        problem: &GridProblem,
        jumps: &impl Jumps,
        learns: bool,
        last: Option<&LastPath>,
        cx: &mut Context<'_, GridProblem>,
    ) -> End<W> {
        let grid = problem.grid();
        let weights = Weights::of(grid);
        if !weights.fit::<W>(grid, 2) {
            return End::TooFar;
        }
        let layout = *grid.layout();
        self.begin(&layout);
        let (start, goal) = (layout.id(problem.start()), layout.id(problem.goal()));
        // Who does not learn answers as if nothing had been asked before.
        if self.goal != goal || !learns {
            self.learned.forget();
            self.goal = goal;
        }
        let octile = weights.octile::<W>(grid, problem.moves(), problem.goal());
        let first = octile(start);
        // A jump raises the key by twice its weight at most.
        let reach = W::DIAGONAL.times(2 * (layout.width() + layout.height()));
        let mut shift = weights.shift::<W>();
        while reach.bucket(shift) > MOST_BUCKETS {
            shift += 1;
        }
        self.open.reset(first, reach, shift);
        self.records[start as usize] = Record {
            generation: self.generation,
            ..Record::default()
        };
        self.open.push(first, start, W::default());
        let remnant = last.and_then(|last| last.remnant(problem, false));
        let end = self.search(problem, jumps, octile, learns, remnant.as_ref(), cx);
        if learns && let End::Goal(whole) = end {
            // No way on from what was expanded is shorter than what the way there leaves of the best.
            let records = &self.records;
            let found = self.expanded.drain(..).map(|id| {
                let g = records[id as usize].g;
                (id, whole.max(g) - g)
            });
            self.learned.learn(records.len(), found);
        }
        end
    }

    /// Cells were freed: what was found out holds no more.
    pub(super) fn forget(&mut self) {
        self.learned.forget();
    }

    /// Makes ready for grids of a layout, so that the next search need not.
    fn prepare(&mut self, layout: &Layout) {
        if self.layout != Some(*layout) {
            self.layout = Some(*layout);
            self.records.clear();
            self.records.resize(layout.len(), Record::default());
            self.generation = 0;
            self.learned = Learned::default();
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

    fn search(
        &mut self,
        problem: &GridProblem,
        jumps: &impl Jumps,
        octile: impl Fn(u32) -> W,
        learns: bool,
        remnant: Option<&Remnant<'_, W>>,
        cx: &mut Context<'_, GridProblem>,
    ) -> End<W> {
        let (grid, moves) = (problem.grid(), problem.moves());
        let goal = grid.layout().id(problem.goal());
        let (onward, all_fans) = (successors(moves), fans(moves));
        let mut bound = W::LIMIT;
        self.beyond = false;
        self.expanded.clear();
        self.joined = None;
        while let Some((id, g)) = self.open.pop(bound) {
            let record = &mut self.records[id as usize];
            if record.closed || { record.g } != g {
                continue;
            }
            if !cx.proceed() {
                return End::Cut;
            }
            record.closed = true;
            if learns {
                self.expanded.push(id);
            }
            let mut arrivals = record.arrivals;
            cx.expanded(|| grid.layout().cell(id));
            if id == goal {
                if g < bound {
                    (bound, self.joined) = (g, None);
                }
                continue;
            }
            if let Some(remnant) = remnant {
                let left = octile(id).max(self.learned.at(id));
                if g + left < bound
                    && let Some(along) = remnant.join(grid.layout().cell(id), left, &mut self.way)
                {
                    (bound, self.joined) = (g + left, Some((id, along)));
                    continue;
                }
            }
            let around = grid.around_id(id);
            let mut ways = if arrivals == 0 {
                moves.legal(around)
            } else {
                0
            };
            while arrivals != 0 {
                ways |= onward[arrivals.trailing_zeros() as usize][usize::from(around)];
                arrivals &= arrivals - 1;
            }
            let place = jumps.place(id);
            let enough = g + octile(id) + W::STRAIGHT.times(SLACK);
            let mut lines = ways & !all_fans;
            while lines != 0 {
                let k = lines.trailing_zeros() as usize;
                lines &= lines - 1;
                if let Some((at, steps)) = jumps.run(place, k) {
                    self.reach(at, g + W::STRAIGHT.times(steps), k, id, bound, &octile);
                }
            }
            let mut fans = ways & all_fans;
            while fans != 0 {
                let k = fans.trailing_zeros() as usize;
                fans &= fans - 1;
                let weight = if k < 4 { W::STRAIGHT } else { W::DIAGONAL };
                let open = onward[k][0xff];
                let (mut from, mut from_g) = (place, g);
                while let Some((next, steps)) = jumps.stride(from, k) {
                    from = next;
                    from_g = from_g + weight.times(steps);
                    let ways = onward[k][usize::from(grid.around_id(from.id))];
                    // Most of what lies that way may never be asked for: it waits as a node.
                    let leads_away = from_g + octile(from.id) > enough;
                    if from.id == goal || leads_away || ways & !open != 0 {
                        self.reach(from.id, from_g, k, id, bound, &octile);
                        break;
                    }
                    let mut lines = ways & !all_fans;
                    while lines != 0 {
                        let k = lines.trailing_zeros() as usize;
                        lines &= lines - 1;
                        if let Some((at, steps)) = jumps.run(from, k) {
                            let at_g = from_g + W::STRAIGHT.times(steps);
                            self.reach(at, at_g, k, id, bound, &octile);
                        }
                    }
                    if ways >> k & 1 == 0 {
                        break;
                    }
                }
            }
        }
        if bound < W::LIMIT {
            End::Goal(bound)
        } else if self.beyond {
            End::TooFar
        } else {
            End::Exhausted
        }
    }
    /// Takes note of a jump point reached from another in a direction.
    #[inline]
    fn reach(
        &mut self,
        at: u32,
        g: W,
        k: usize,
        parent: u32,
        bound: W,
        octile: &impl Fn(u32) -> W,
    ) {
        let generation = self.generation;
        let record = &mut self.records[at as usize];
        let arrival = 1 << k;
        let known = record.g;
        if record.generation == generation && g >= known {
            if g > known || record.arrivals & arrival != 0 {
                return;
            }
            // As good as the best, from elsewhere: other ways on may be due.
            record.arrivals |= arrival;
            if !record.closed {
                return;
            }
            record.closed = false;
        } else {
            *record = Record {
                g,
                parent,
                generation,
                arrivals: arrival,
                closed: false,
            };
        }
        // Not consistent any more: what is reached at less is expanded again.
        let key = g + octile(at).max(self.learned.at(at));
        if key < bound {
            self.open.push(key, at, g);
        } else {
            self.beyond = true;
        }
    }

    /// The path on which the last search reached its goal, the start first; or its part up to the join.
    fn path(&self, problem: &GridProblem) -> Vec<Cell> {
        let layout = problem.grid().layout();
        let start = layout.id(problem.start());
        let (mut id, on) = match self.joined {
            Some((id, _)) => (id, &self.way[1..]),
            None => (layout.id(problem.goal()), &[][..]),
        };
        let weight = self.records[id as usize].g;
        let mut path = Vec::with_capacity(weight.over(W::STRAIGHT) + 1 + on.len());
        path.push(layout.cell(id));
        while id != start {
            let parent = self.records[id as usize].parent;
            back(
                problem.moves(),
                layout.cell(parent),
                layout.cell(id),
                &mut path,
            );
            id = parent;
        }
        path.reverse();
        path.extend_from_slice(on);
        path
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        self.records.capacity() * size_of::<Record<W>>()
            + self.open.bytes()
            + self.expanded.capacity() * size_of::<u32>()
            + self.learned.bytes()
            + self.way.capacity() * size_of::<Cell>()
    }
}

/// Appends the cells from just before `to` back to `from`: a jump goes diagonally first, or up and
/// down first where there are no diagonals.
fn back(moves: Moves, from: Cell, to: Cell, path: &mut Vec<Cell>) {
    let mut at = to;
    while at != from {
        let (dx, dy) = (from.x.abs_diff(at.x), from.y.abs_diff(at.y));
        let (along, up) = match moves {
            Moves::Orthogonal => (dx > 0, dx == 0),
            _ => (dx >= dy, dy >= dx),
        };
        let toward = |at: u32, from: u32| if from > at { at + 1 } else { at - 1 };
        at = Cell {
            x: if along { toward(at.x, from.x) } else { at.x },
            y: if up { toward(at.y, from.y) } else { at.y },
        };
        path.push(at);
    }
}

/// What was found.
#[derive(Debug)]
pub(super) enum Found {
    /// A shortest path.
    Path(Vec<Cell>),
    /// The first part of one, up to where it joins what is left of the last path, so far along.
    Joined(Vec<Cell>, usize),
    /// There is none.
    Nothing,
    /// The budget ran out first.
    Cut,
}

/// A [`JumpSearch`] in the narrowest word that orders its paths exactly, as of
/// [`ExactSearch`](pf_grid::ExactSearch).
#[derive(Clone, Debug, Default)]
pub(super) struct ExactJumps {
    width: Width,
    layout: Option<Layout>,
}

#[derive(Clone, Debug)]
enum Width {
    Narrow(JumpSearch<u32>),
    Wide(JumpSearch<u64>),
    Huge(JumpSearch<u128>),
}

impl Default for Width {
    fn default() -> Self {
        Self::Narrow(JumpSearch::default())
    }
}

impl ExactJumps {
    /// Finds a shortest path between two free cells. If it `learns`, later searches to the same goal are shorter,
    /// as long as cells are only blocked; where any is freed, it has to [`forget`](Self::forget). Where a last path is
    /// given, it ends where it can join what is left of that.
    pub(super) fn find(
        &mut self,
        problem: &GridProblem,
        jumps: &impl Jumps,
        learns: bool,
        last: Option<&LastPath>,
        cx: &mut Context<'_, GridProblem>,
    ) -> Found {
        self.prepare(problem.grid().layout());
        loop {
            let found = match &mut self.width {
                Width::Narrow(search) => find(search, problem, jumps, learns, last, cx),
                Width::Wide(search) => find(search, problem, jumps, learns, last, cx),
                Width::Huge(search) => find(search, problem, jumps, learns, last, cx),
            };
            match found {
                Some(found) => return found,
                None => self.width.widen(),
            }
        }
    }

    /// Makes ready for grids of a layout, so that the next search need not.
    pub(super) fn prepare(&mut self, layout: &Layout) {
        if self.layout == Some(*layout) {
            return;
        }
        self.layout = Some(*layout);
        // The old memory goes before the new comes.
        self.width = Width::default();
        if let Width::Narrow(search) = &mut self.width {
            search.prepare(layout);
        }
    }

    /// See [`JumpSearch::forget`].
    pub(super) fn forget(&mut self) {
        match &mut self.width {
            Width::Narrow(search) => search.forget(),
            Width::Wide(search) => search.forget(),
            Width::Huge(search) => search.forget(),
        }
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        match &self.width {
            Width::Narrow(search) => search.bytes(),
            Width::Wide(search) => search.bytes(),
            Width::Huge(search) => search.bytes(),
        }
    }
}

/// `None` if the word is too narrow.
fn find<W: Word>(
    search: &mut JumpSearch<W>,
    problem: &GridProblem,
    jumps: &impl Jumps,
    learns: bool,
    last: Option<&LastPath>,
    cx: &mut Context<'_, GridProblem>,
) -> Option<Found> {
    match search.run(problem, jumps, learns, last, cx) {
        End::Goal(_) => Some(match search.joined {
            Some((_, along)) => Found::Joined(search.path(problem), along),
            None => Found::Path(search.path(problem)),
        }),
        End::Exhausted => Some(Found::Nothing),
        End::Cut => Some(Found::Cut),
        End::TooFar => None,
    }
}

impl Width {
    fn widen(&mut self) {
        let narrow = matches!(self, Self::Narrow(_));
        // The old memory goes before the new comes.
        *self = Self::default();
        *self = if narrow {
            Self::Wide(JumpSearch::default())
        } else {
            Self::Huge(JumpSearch::default())
        };
    }
}
