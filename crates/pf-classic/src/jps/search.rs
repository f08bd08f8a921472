//! A best-first search over jump points, in one word width.

use super::{
    jumps::{Jumps, fans},
    nodes::Nodes,
    open::Open,
};
use pf_core::Context;
use pf_grid::{
    Beeline, Cell, End, GridProblem, LastPath, Layout, Moves, Remnant, Weights, Word, successors,
};

/// A* whose nodes are jump points.
///
/// A straight run ends at the first cell from which the search may go on elsewhere; a diagonal one
/// sends runs to both sides, and only where those end, nodes come about.
#[derive(Clone, Debug, Default)]
pub(super) struct JumpSearch<W: Copy> {
    /// They keep what searches to the same goal have found out.
    nodes: Nodes<W>,
    /// By the places of nodes.
    open: Open<W>,
    /// Something lay beyond what the word orders.
    beyond: bool,
    /// The places of what the last search expanded, if it is to learn from it.
    expanded: Vec<u32>,
    goal: u32,
    /// The place at which the last search took a short cut, if it did, and where that leads.
    joined: Option<(u32, Shortcut)>,
    /// The short cut, both ends included.
    way: Vec<Cell>,
}

/// A ring of more buckets costs more than the order within a bucket is worth.
const MOST_BUCKETS: u64 = 1 << 14;

/// A walk along a diagonal is put off where its key is so many steps above the one it began at.
/// Measured on made-up maps (random cells, rectangles, mazes): without, open maps take up to three
/// times as long; with 0, mazes twice.
const SLACK: u32 = 4;
/// The same in searches that learn, if no last path is broken. In drives 4 take a twentieth longer, and a seventh in a
/// maze.
const FAR: u32 = 16;
/// What a broken path cost tells better what the new one may: in drives on Aftershock eight of ten are no more than so
/// many steps longer, in a maze and in corridors seven, and what lies below would be expanded anyway.
const MORE: u32 = 2;

/// So many steps may be taken in vain on ways of two straight pieces to the goal.
const VAIN: u32 = 16;

/// Where a way of two straight pieces leads.
#[derive(Clone, Copy, Debug)]
enum Shortcut {
    /// To what is left of the last path, so far along.
    Remnant(usize),
    Goal,
}

/// Up to which key a walk along a diagonal is not put off: so much above the one it began at, and this at the least.
#[derive(Clone, Copy, Debug)]
struct Slack<W> {
    more: W,
    least: W,
}

/// Where a search may end before it gets to the goal.
struct Ends<'p, W> {
    remnant: Option<Remnant<'p, W>>,
    line: Beeline<'p>,
    goal: Cell,
    /// So many steps towards the goal were looked at.
    steps: u32,
}

impl<W: Word> Ends<'_, W> {
    /// Where a short cut leads from a cell from which no less is `left`, if one does that is no longer; `open` is left if
    /// nothing stands in the way. `way` is then the short cut.
    fn from(&mut self, cell: Cell, left: W, open: W, way: &mut Vec<Cell>) -> Option<Shortcut> {
        let remnant = self.remnant.as_ref();
        if let Some(along) = remnant.and_then(|it| it.join(cell, left, way)) {
            return Some(Shortcut::Remnant(along));
        }
        if left > open || self.steps >= VAIN {
            return None;
        }
        let (is_open, steps) = self.line.look(cell, self.goal, way);
        self.steps += steps;
        is_open.then_some(Shortcut::Goal)
    }
}

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
        self.nodes.begin();
        let (start, goal) = (layout.id(problem.start()), layout.id(problem.goal()));
        // Who does not learn answers as if nothing had been asked before.
        if self.goal != goal || !learns {
            self.nodes.forget();
            self.goal = goal;
        }
        let broken = last.filter(|_| learns);
        let broken = broken.and_then(|last| weights.of_cost::<W>(last.broken_cost(problem)?));
        // Where a search may end at a short cut, what it expands is dearer than the way there.
        let is_far = learns && broken.is_none();
        let slack = Slack {
            more: W::STRAIGHT.times(if is_far { FAR } else { SLACK }),
            least: broken.map_or(W::default(), |cost| cost + W::STRAIGHT.times(MORE)),
        };
        let octile = weights.octile::<W>(grid, problem.moves(), problem.goal());
        let first = octile(start);
        // A jump raises the key by twice its weight at most.
        let reach = W::DIAGONAL.times(2 * (layout.width() + layout.height()));
        let mut shift = weights.shift::<W>();
        while reach.bucket(shift) > MOST_BUCKETS {
            shift += 1;
        }
        self.open.reset(first, reach, shift);
        let (place, node, _) = self.nodes.reach(start);
        (node.g, node.parent) = (W::default(), place);
        (node.arrivals, node.closed) = (0, false);
        self.open.push(first, place, W::default());
        let ends = learns.then(|| Ends {
            remnant: last.and_then(|last| last.remnant(problem, false)),
            line: Beeline::of(problem),
            goal: problem.goal(),
            steps: 0,
        });
        let end = self.search(problem, jumps, octile, slack, ends, cx);
        if learns && let End::Goal(whole) = end {
            // No way on from what was expanded is shorter than what the way there leaves of the best.
            for place in self.expanded.drain(..) {
                let node = self.nodes.at(place);
                node.left = node.left.max(whole.max(node.g) - node.g);
            }
        }
        end
    }

    /// Cells were freed: what was found out holds no more.
    pub(super) fn forget(&mut self) {
        self.nodes.forget();
    }

    fn search(
        &mut self,
        problem: &GridProblem,
        jumps: &impl Jumps,
        octile: impl Fn(u32) -> W,
        slack: Slack<W>,
        mut ends: Option<Ends<'_, W>>,
        cx: &mut Context<'_, GridProblem>,
    ) -> End<W> {
        let (grid, moves) = (problem.grid(), problem.moves());
        let goal = grid.layout().id(problem.goal());
        let (onward, all_fans) = (successors(moves), fans(moves));
        let mut bound = W::LIMIT;
        self.beyond = false;
        self.expanded.clear();
        self.joined = None;
        while let Some((place, g)) = self.open.pop(bound) {
            let node = self.nodes.at(place);
            if node.closed || node.g != g {
                continue;
            }
            if !cx.proceed() {
                return End::Cut;
            }
            node.closed = true;
            if ends.is_some() {
                self.expanded.push(place);
            }
            let (id, learned, mut arrivals) = (node.id, node.left, node.arrivals);
            cx.expanded(|| grid.layout().cell(id));
            if id == goal {
                if g < bound {
                    (bound, self.joined) = (g, None);
                }
                continue;
            }
            let open = octile(id);
            let left = open.max(learned);
            if g + left < bound
                && let Some(ends) = &mut ends
                && let Some(shortcut) = ends.from(grid.layout().cell(id), left, open, &mut self.way)
            {
                (bound, self.joined) = (g + left, Some((place, shortcut)));
                continue;
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
            let spot = jumps.place(id);
            let enough = (g + open + slack.more).max(slack.least);
            let mut lines = ways & !all_fans;
            while lines != 0 {
                let k = lines.trailing_zeros() as usize;
                lines &= lines - 1;
                if let Some((at, steps)) = jumps.run(spot, k) {
                    self.reach(at, g + W::STRAIGHT.times(steps), k, place, bound, &octile);
                }
            }
            let mut fans = ways & all_fans;
            while fans != 0 {
                let k = fans.trailing_zeros() as usize;
                fans &= fans - 1;
                let weight = if k < 4 { W::STRAIGHT } else { W::DIAGONAL };
                let open = onward[k][0xff];
                let (mut from, mut from_g) = (spot, g);
                while let Some((next, steps)) = jumps.stride(from, k) {
                    from = next;
                    from_g = from_g + weight.times(steps);
                    let ways = onward[k][usize::from(grid.around_id(from.id))];
                    // Most of what lies that way may never be asked for: it waits as a node.
                    let leads_away = from_g + octile(from.id) > enough;
                    if from.id == goal || leads_away || ways & !open != 0 {
                        self.reach(from.id, from_g, k, place, bound, &octile);
                        break;
                    }
                    let mut lines = ways & !all_fans;
                    while lines != 0 {
                        let k = lines.trailing_zeros() as usize;
                        lines &= lines - 1;
                        if let Some((at, steps)) = jumps.run(from, k) {
                            let at_g = from_g + W::STRAIGHT.times(steps);
                            self.reach(at, at_g, k, place, bound, &octile);
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
        let (place, node, is_known) = self.nodes.reach(at);
        let arrival = 1 << k;
        if is_known && g >= node.g {
            if g > node.g || node.arrivals & arrival != 0 {
                return;
            }
            // As good as the best, from elsewhere: other ways on may be due.
            node.arrivals |= arrival;
            if !node.closed {
                return;
            }
        } else {
            (node.g, node.parent, node.arrivals) = (g, parent, arrival);
        }
        node.closed = false;
        // Not consistent any more: what is reached at less is expanded again.
        let key = g + octile(at).max(node.left);
        if key < bound {
            self.open.push(key, place, g);
        } else {
            self.beyond = true;
        }
    }

    /// The path on which the last search reached its goal, the start first; or its part up to the join.
    fn path(&self, problem: &GridProblem) -> Vec<Cell> {
        let layout = problem.grid().layout();
        let (mut place, on) = match self.joined {
            Some((place, _)) => (place, &self.way[1..]),
            None => (self.nodes.place(layout.id(problem.goal())), &[][..]),
        };
        let mut node = self.nodes.get(place);
        let mut cell = layout.cell(node.id);
        let mut path = Vec::with_capacity(node.g.over(W::STRAIGHT) + 1 + on.len());
        path.push(cell);
        // The start is before itself.
        while node.parent != place {
            place = node.parent;
            node = self.nodes.get(place);
            let before = layout.cell(node.id);
            back(problem.moves(), before, cell, &mut path);
            cell = before;
        }
        path.reverse();
        path.extend_from_slice(on);
        path
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        self.nodes.bytes()
            + self.open.bytes()
            + self.expanded.capacity() * size_of::<u32>()
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
        if self.layout != Some(*problem.grid().layout()) {
            self.layout = Some(*problem.grid().layout());
            // The old memory goes before the new comes.
            self.width = Width::default();
        }
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
            Some((_, Shortcut::Remnant(along))) => Found::Joined(search.path(problem), along),
            _ => Found::Path(search.path(problem)),
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
