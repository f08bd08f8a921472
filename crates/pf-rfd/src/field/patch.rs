//! Ways over freed cells: whether one may be better than the old way, and the best there is.

use super::{answer::clamped, basin::Side, freed::Freed, marks::Marks};
use pf_core::Context;
use pf_grid::{Apart, Distances, End, GridProblem, Layout, Moves, Search, Weights, Word};

/// The freed cells, and what they are good for.
///
/// Of a way over freed cells what comes after the last of them is an old way, and no shorter than
/// the goal's field says. So a tiny search among the freed cells tells what is left from each of
/// them, over the other ones beside it and then on as ever. Where that makes no cell beside them any
/// better than it was, nothing is better anywhere. Else such cells are the *shores*: a better way
/// passes one, and before that it costs at least what an open field would. That is the certificate:
/// where no cell near the freed ones, with the way there from the start, leads over a shore to less
/// than the old way costs, that is still best. Where one does, a search goes on from there,
/// directed by the same bound. A cell that by itself helps no neighbour takes no part in the tiny search, but
/// a way may pass it before it comes to a shore, so the search begins beside it, too.
///
/// Source: ours; that nothing changes where no edge relaxes is Ramalingam and Reps, 1996.
#[derive(Clone, Debug, Default)]
pub(super) struct Patch<W> {
    freed: Freed<W>,
    /// Those that are of no use by themselves. A way over them may lead to others.
    useless: Vec<u32>,
    /// Where a better way may be: column and row, and what is left from there.
    shores: Vec<((u32, u32), W)>,
    /// Where an old way may be left: an id, and the way there from the start.
    seeds: Vec<(u32, W)>,
}

/// What a patch is looked at with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sight<'s, W: Word> {
    pub(super) problem: &'s GridProblem,
    pub(super) weights: Weights,
    /// The start's and the goal's.
    pub(super) sides: [&'s Side<W>; 2],
    /// The ids of start and goal.
    pub(super) ends: [u32; 2],
    /// What the old way weighs; [`Word::MAX`] if there is none.
    pub(super) best: W,
}

/// With more shores than that a window around them costs less.
const MOST_SHORES: usize = 48;

fn between<W: Word>(apart: Apart<W>, (ax, ay): (u32, u32), (bx, by): (u32, u32)) -> W {
    apart.by(ax.abs_diff(bx), ay.abs_diff(by))
}

impl<W: Word> Patch<W> {
    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        self.freed.bytes()
            + self.useless.capacity() * size_of::<u32>()
            + self.shores.capacity() * size_of::<((u32, u32), W)>()
            + self.seeds.capacity() * size_of::<(u32, W)>()
    }

    /// Looks around the changed cells for what may lead to less than the best. Says whether there
    /// was little enough to look at.
    pub(super) fn look(&mut self, sight: &Sight<'_, W>, changed: &[u32]) -> bool {
        self.freed.clear();
        self.useless.clear();
        self.shores.clear();
        self.seeds.clear();
        if !self.gather(sight, changed) {
            return false;
        }
        self.relax(sight);
        self.find_shores(sight) && {
            if !self.shores.is_empty() {
                self.find_seeds(sight);
            }
            true
        }
    }

    /// The freed cells, those aside over which every way is too long.
    fn gather(&mut self, sight: &Sight<'_, W>, changed: &[u32]) -> bool {
        let grid = sight.problem.grid();
        let layout = grid.layout();
        let apart = sight.weights.apart::<W>(sight.problem.moves());
        let [start, goal] = sight.ends.map(|id| layout.position(id));
        // A way may pass beside the cell.
        let slack = apart.by(1, 1) + apart.by(1, 1);
        for &id in changed {
            if !grid.is_free_id(id) {
                continue;
            }
            let at = layout.position(id);
            let over = between(apart, start, at) + between(apart, at, goal);
            if over >= sight.best && over - sight.best >= slack {
                continue;
            }
            if sight.is_useless(id) {
                self.useless.push(id);
                continue;
            }
            if self.freed.place(id).is_some() {
                continue;
            }
            let left = if id == sight.ends[1] {
                W::default()
            } else {
                W::MAX
            };
            if !self.freed.add(id, left) {
                return false;
            }
        }
        true
    }

    /// What is left from a cell: by the tiny search if it was freed, else as ever.
    #[inline]
    fn left(&self, goals: &Distances<W>, id: u32) -> W {
        match self.freed.place(id) {
            None => goals.at(id),
            Some(place) => self.freed.cells[place].1,
        }
    }

    /// The tiny search: forwards and backwards in turn, until nothing changes.
    fn relax(&mut self, sight: &Sight<'_, W>) {
        let goals = &sight.sides[1].field;
        let (mut again, mut backwards) = (true, false);
        while std::mem::take(&mut again) {
            backwards = !backwards;
            let count = self.freed.cells.len();
            for k in 0..count {
                let k = if backwards { count - 1 - k } else { k };
                let (id, mut least) = self.freed.cells[k];
                for (next, weight) in sight.steps(id) {
                    let rest = self.left(goals, next);
                    if rest == W::MAX {
                        continue;
                    }
                    // What is beyond the limit need not be known any better, and fits.
                    let over = (rest + weight).min(W::LIMIT);
                    if over < least {
                        least = over;
                        again = true;
                    }
                }
                self.freed.cells[k].1 = least;
            }
        }
    }

    /// Cells that are better off than they were.
    fn find_shores(&mut self, sight: &Sight<'_, W>) -> bool {
        let layout = *sight.problem.grid().layout();
        let goals = &sight.sides[1].field;
        let corners = !matches!(sight.problem.moves(), Moves::Always | Moves::Orthogonal);
        for k in 0..self.freed.cells.len() {
            let (id, left) = self.freed.cells[k];
            // A way may begin here.
            let is_reached = sight.sides[0].field.at(id) < W::MAX;
            if is_reached && left < goals.at(id) && !self.add_shore(sight, layout, id, left) {
                return false;
            }
            for (next, weight) in sight.steps(id) {
                let is_old = self.freed.place(next).is_none();
                if is_old
                    && left < W::MAX
                    && left + weight < goals.at(next)
                    && !self.add_shore(sight, layout, next, left + weight)
                {
                    return false;
                }
                // Where corners count, diagonal steps beside the cell are new, too.
                if !(is_old && corners) {
                    continue;
                }
                for (beyond, weight) in sight.steps(next) {
                    let rest = goals.at(beyond);
                    if self.freed.place(beyond).is_none()
                        && rest < goals.at(next)
                        && rest + weight < goals.at(next)
                        && !self.add_shore(sight, layout, next, rest + weight)
                    {
                        return false;
                    }
                }
            }
        }
        true
    }

    fn add_shore(&mut self, sight: &Sight<'_, W>, layout: Layout, id: u32, left: W) -> bool {
        let apart = sight.weights.apart::<W>(sight.problem.moves());
        let at = layout.position(id);
        let start = layout.position(sight.ends[0]);
        let beaten = |&(other, rest): &((u32, u32), W)| rest + between(apart, at, other) <= left;
        if between(apart, start, at) + left >= sight.best || self.shores.iter().any(beaten) {
            return true;
        }
        self.shores
            .retain(|&(other, rest)| left + between(apart, at, other) > rest);
        self.shores.push((at, left));
        self.shores.len() <= MOST_SHORES
    }

    /// Places near the freed cells that the start reaches as ever, and from which a shore may lead
    /// to less.
    fn find_seeds(&mut self, sight: &Sight<'_, W>) {
        let grid = sight.problem.grid();
        let layout = *grid.layout();
        let apart = sight.weights.apart::<W>(sight.problem.moves());
        let starts = &sight.sides[0].field;
        let freed = self.freed.cells.iter().map(|&(id, _)| id);
        for id in freed.chain(self.useless.iter().copied()) {
            let around = layout
                .offsets()
                .map(|offset| id.wrapping_add_signed(offset));
            for id in std::iter::once(id).chain(around) {
                let g = starts.at(id);
                if g < W::MAX
                    && grid.is_free_id(id)
                    && g + self.least(apart, layout.position(id)) < sight.best
                {
                    self.seeds.push((id, g));
                }
            }
        }
    }

    /// The least way on from a place over a shore, as if nothing stood in it.
    #[inline]
    fn least(&self, apart: Apart<W>, at: (u32, u32)) -> W {
        let shores = self.shores.iter();
        let over = shores.map(|&(other, rest)| between(apart, at, other) + rest);
        over.min().unwrap_or(W::LIMIT).min(W::LIMIT)
    }

    /// Searches from the seeds for a way that weighs less than the best, to where an old way to the
    /// goal holds.
    pub(super) fn search(
        &self,
        sight: &Sight<'_, W>,
        search: &mut Search<W>,
        marks: &mut Marks,
        cx: &mut Context<'_, GridProblem>,
    ) -> End<W> {
        if self.seeds.is_empty() {
            return End::Exhausted;
        }
        let layout = *sight.problem.grid().layout();
        let apart = sight.weights.apart::<W>(sight.problem.moves());
        let goals = sight.sides[1];
        let heuristic = |id: u32| {
            let over = self.least(apart, layout.position(id));
            clamped(self.left(&goals.field, id).min(over))
        };
        let downhill = goals.field.downhill(sight.problem);
        if goals.closed {
            marks.clear(layout.len());
        }
        let mut best = sight.best.min(W::LIMIT);
        let first = best;
        let arrive = |id: u32, g: W| {
            let left = goals.field.at(id);
            if left < W::MAX
                && g + left < best
                && (!goals.closed || marks.is_intact(&downhill, id, sight.ends[1], || false))
            {
                best = g + left;
                return Some(left);
            }
            heuristic(id).filter(|&rest| g + rest >= best)
        };
        search.run_from(sight.problem, &self.seeds, first, heuristic, arrive, cx)
    }
}

impl<W: Word> Sight<'_, W> {
    /// Whether a cell that was freed by itself makes no cell beside it any better: what `relax` and
    /// `find_shores` would find out, for the price of a look at its neighbours. Never where something was
    /// blocked, too: then the way on from a shore may lead over it.
    #[inline]
    fn is_useless(&self, id: u32) -> bool {
        let goals = &self.sides[1].field;
        let corners = !matches!(self.problem.moves(), Moves::Always | Moves::Orthogonal);
        if corners || self.sides[1].closed || self.ends.contains(&id) || goals.at(id) < W::MAX {
            return false;
        }
        let (mut over, mut most) = (W::MAX, W::default());
        for (next, weight) in self.steps(id) {
            let left = goals.at(next);
            if left == W::MAX {
                return false;
            }
            over = over.min(left + weight);
            most = most.max(left.max(weight) - weight);
        }
        over >= most
    }

    /// The ids one step away, and what the step weighs.
    #[inline]
    fn steps(&self, id: u32) -> impl Iterator<Item = (u32, W)> + '_ {
        let grid = self.problem.grid();
        let offsets = grid.layout().offsets();
        let legal = self.problem.moves().legal(grid.around_id(id));
        let steps = (0..8).filter(move |k| legal >> k & 1 == 1);
        steps.map(move |k: u32| {
            let next = id.wrapping_add_signed(offsets[k as usize]);
            (next, self.weights.step(grid, id, next, k))
        })
    }
}
