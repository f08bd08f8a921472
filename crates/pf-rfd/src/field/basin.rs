//! Two fields, what changed since they were exact, and answers from both.

use super::{
    marks::Marks,
    patch::{Patch, Sight},
};
use pf_core::{Context, Problem};
use pf_grid::{
    Cell, Damage, Distances, End, GridChange, GridProblem, Layout, Search, Sweeper, Swept, Weights,
    Word,
};

/// What came of a question.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Found {
    /// [`Basin::path`] is the answer.
    Path,
    /// Proof that there is none.
    Nothing,
    /// The budget ran out.
    Cut,
    /// The word is too narrow for this map.
    TooFar,
}

/// How an answer came about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum How {
    Kept,
    Patched,
    Searched,
    Afresh,
}

impl How {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Kept => "kept",
            Self::Patched => "patched",
            Self::Searched => "searched",
            Self::Afresh => "afresh",
        }
    }
}

/// A field, and what happened to the map since it was exact.
#[derive(Clone, Debug, Default)]
pub(super) struct Side<W: Word> {
    pub(super) field: Distances<W>,
    damage: Damage<W>,
    /// Where in the log what happened since begins.
    pub(super) since: usize,
    /// Where what the damage does not know begins.
    noted: usize,
    /// Something was freed, or got cheaper.
    opened: bool,
    /// Something was blocked, or got dearer.
    pub(super) closed: bool,
}

/// A field that is of use: it is rooted at one end of the way.
#[derive(Clone, Copy, Debug)]
struct Way<W> {
    side: usize,
    /// The other end.
    from: u32,
    root: u32,
    /// The other end is the goal.
    is_backward: bool,
    /// What the field says, [`Word::MAX`] if there was no way.
    whole: W,
    /// How far the old way down holds.
    holds: W,
}

/// See [`RfdField`](super::RfdField).
#[derive(Clone, Debug)]
pub(super) struct Basin<W: Word> {
    sides: [Side<W>; 2],
    layout: Option<Layout>,
    sweeper: Sweeper<W>,
    search: Search<W>,
    marks: Marks,
    /// Ids of cells that changed since the older field was exact.
    log: Vec<u32>,
    /// The last answer's path, the start first.
    last: Vec<u32>,
    /// The ends that it answers, while nothing was opened since; the path is empty if there is none.
    answered: Option<(Cell, Cell)>,
    spare: Vec<u32>,
    patch: Patch<W>,
    /// Ends of the last question, and in how many questions running each was elsewhere than before.
    ends: [Cell; 2],
    moves: [u32; 2],
    /// Expansions of the last sweep, and of answers since the fields were exact.
    effort: u64,
    debt: u64,
}

impl<W: Word> Default for Basin<W> {
    fn default() -> Self {
        Self {
            sides: [Side::default(), Side::default()],
            layout: None,
            sweeper: Sweeper::default(),
            search: Search::default(),
            marks: Marks::default(),
            log: Vec::new(),
            last: Vec::new(),
            answered: None,
            spare: Vec::new(),
            patch: Patch::default(),
            ends: [Cell::default(); 2],
            moves: [0; 2],
            effort: 0,
            debt: 0,
        }
    }
}

/// An end that has moved in so many questions running gets no field.
const RESTLESS: u32 = 2;
/// And the other end's is repaired once answers have cost that part of a sweep.
const DEBT: u64 = 8;

impl<W: Word> Basin<W> {
    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        let sides = self.sides.iter();
        let sides = sides.map(|side| side.field.bytes() + side.damage.bytes());
        let ids = self.log.capacity() + self.last.capacity() + self.spare.capacity();
        sides.sum::<usize>()
            + self.sweeper.bytes()
            + self.search.bytes()
            + self.marks.bytes()
            + self.patch.bytes()
            + ids * size_of::<u32>()
    }

    /// Whether it was made for grids of this shape.
    pub(super) fn covers(&self, problem: &GridProblem) -> bool {
        self.layout == Some(*problem.grid().layout())
    }

    /// The altitude of a cell above the goal, in steps.
    #[expect(clippy::cast_precision_loss, reason = "for looking at")]
    pub(super) fn altitude(&self, cell: Cell) -> Option<f64> {
        let layout = self.layout.filter(|layout| layout.contains(cell))?;
        let to_goal = |side: &&Side<W>| {
            let basis = side.field.basis();
            basis.is_some_and(|(root, _)| root == self.ends[1])
        };
        let side = self.sides.iter().find(to_goal)?;
        let (_, weights) = side.field.basis()?;
        let value = side.field.at(layout.id(cell));
        let unit = W::STRAIGHT.wide() as f64 * if weights.is_uniform() { 1.0 } else { 2.0 };
        (value < W::MAX).then(|| value.wide() as f64 / unit)
    }

    /// The last answer's path.
    pub(super) fn path(&self, problem: &GridProblem) -> Vec<Cell> {
        let layout = problem.grid().layout();
        self.last.iter().map(|&id| layout.cell(id)).collect()
    }

    /// Nothing is known.
    pub(super) fn begin(&mut self, problem: &GridProblem) {
        self.layout = Some(*problem.grid().layout());
        self.sides.iter_mut().for_each(|side| side.field.forget());
        self.log.clear();
        self.debt = 0;
        self.answered = None;
        self.ends = [problem.start(), problem.goal()];
        self.moves = [0; 2];
    }

    /// Sweeps from the goal and reads the answer off.
    pub(super) fn plan(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Found {
        self.begin(problem);
        if !Distances::<W>::fit(problem) {
            return Found::TooFar;
        }
        match self.sweep(problem, 0, problem.goal(), cx) {
            Swept::Whole => self.answer(problem, cx).0,
            Swept::TooFar => Found::TooFar,
            Swept::Cut | Swept::GaveUp => Found::Cut,
        }
    }

    fn sweep(
        &mut self,
        problem: &GridProblem,
        side: usize,
        root: Cell,
        cx: &mut Context<'_, GridProblem>,
    ) -> Swept {
        let before = cx.stats().expanded;
        let sweeper = &mut self.sweeper;
        let end = self.sides[side].field.sweep(problem, root, sweeper, cx);
        self.effort = cx.stats().expanded - before;
        self.sides[side].refresh(self.log.len());
        end
    }

    /// Takes note of what happened.
    pub(super) fn tell(&mut self, problem: &GridProblem, changes: &[GridChange]) {
        let ends = [problem.start(), problem.goal()];
        for (k, &end) in ends.iter().enumerate() {
            self.moves[k] = if end == self.ends[k] {
                0
            } else {
                self.moves[k].saturating_add(1)
            };
        }
        self.ends = ends;
        let layout = problem.grid().layout();
        for change in changes {
            let (cells, opens, closes) = match change {
                GridChange::Blocked(cells) => (cells, false, true),
                GridChange::Freed(cells) => (cells, true, false),
                GridChange::CostChanged(cells, _) => (cells, true, true),
                GridChange::StartMoved(_) | GridChange::GoalMoved(_) => continue,
            };
            if opens {
                self.answered = None;
            }
            for side in &mut self.sides {
                side.opened |= opens;
                side.closed |= closes;
            }
            self.log.extend(cells.iter().map(|&cell| layout.id(cell)));
        }
        if self.log.len() > layout.len() / 2 {
            // More than a field is worth.
            self.sides.iter_mut().for_each(|side| side.field.forget());
            self.log.clear();
        }
    }

    /// Makes the fields of both ends exact, those of restless ends aside.
    pub(super) fn settle(
        &mut self,
        problem: &GridProblem,
        patience: f64,
        cx: &mut Context<'_, GridProblem>,
    ) -> Found {
        self.layout = Some(*problem.grid().layout());
        if !Distances::<W>::fit(problem) {
            return Found::TooFar;
        }
        let mut wanted = Vec::with_capacity(2);
        for k in [1, 0] {
            if self.moves[k] < RESTLESS && !wanted.contains(&self.ends[k]) {
                wanted.push(self.ends[k]);
            }
        }
        let is_restless = self.moves.iter().any(|&moves| moves >= RESTLESS);
        if is_restless && self.debt < self.effort / DEBT {
            // They answer as they are for now.
            return Found::Path;
        }
        let roots = |sides: &[Side<W>; 2]| {
            [0, 1].map(|k: usize| sides[k].field.basis().map(|(root, _)| root))
        };
        for side in &mut self.sides {
            let basis = side.field.basis();
            if basis.is_some_and(|(root, _)| !wanted.contains(&root)) {
                side.field.forget();
            }
        }
        for root in wanted {
            let known = roots(&self.sides).iter().position(|&r| r == Some(root));
            let end = match known {
                Some(side) => self.restore(problem, side, root, patience, cx),
                None => {
                    let idle = roots(&self.sides).iter().position(Option::is_none);
                    self.sweep(problem, idle.unwrap_or(1), root, cx)
                }
            };
            match end {
                Swept::Whole => {}
                Swept::TooFar => return Found::TooFar,
                Swept::Cut | Swept::GaveUp => return Found::Cut,
            }
        }
        self.log.clear();
        self.debt = 0;
        self.sides.iter_mut().for_each(|side| side.refresh(0));
        // Memory that the next answer may want.
        let layout = problem.grid().layout();
        self.search.prepare(layout);
        self.marks.clear(layout.len());
        self.patch.prepare(layout);
        Found::Path
    }

    /// Repairs a field, or sweeps where that would take as long.
    #[expect(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a rough number; casts of floats saturate"
    )]
    fn restore(
        &mut self,
        problem: &GridProblem,
        side: usize,
        root: Cell,
        patience: f64,
        cx: &mut Context<'_, GridProblem>,
    ) -> Swept {
        let changed = &self.log[self.sides[side].since..];
        if changed.is_empty() {
            return Swept::Whole;
        }
        let most = (self.effort.max(200) as f64 * patience) as u64;
        if changed.len() as u64 <= most {
            let field = &mut self.sides[side].field;
            match field.repair(problem, changed, most, &mut self.sweeper, cx) {
                Swept::GaveUp => {}
                end => {
                    self.sides[side].refresh(self.log.len());
                    return end;
                }
            }
        }
        self.sweep(problem, side, root, cx)
    }

    /// The way by the field of one end, if there is one of use.
    fn way(&self, problem: &GridProblem, is_backward: bool) -> Option<Way<W>> {
        let (from, to) = match is_backward {
            false => (problem.start(), problem.goal()),
            true => (problem.goal(), problem.start()),
        };
        let now = Weights::of(problem.grid());
        let rooted = |side: &Side<W>| {
            let basis = side.field.basis();
            basis.is_some_and(|(root, weights)| root == to && weights.hold_under(now))
        };
        let side = self.sides.iter().position(rooted)?;
        let layout = problem.grid().layout();
        let from = layout.id(from);
        Some(Way {
            side,
            from,
            root: layout.id(to),
            is_backward,
            whole: self.sides[side].field.at(from),
            holds: W::default(),
        })
    }

    /// Answers, and says how.
    pub(super) fn answer(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> (Found, How) {
        if !Distances::<W>::fit(problem) {
            return (Found::TooFar, How::Afresh);
        }
        self.layout = Some(*problem.grid().layout());
        let before = cx.stats().expanded;
        let (found, how) = self.find(problem, cx);
        self.debt += cx.stats().expanded - before;
        if matches!(found, Found::Path | Found::Nothing) {
            self.answered = Some((problem.start(), problem.goal()));
            if found == Found::Nothing {
                self.last.clear();
            }
        }
        (found, how)
    }

    fn find(&mut self, problem: &GridProblem, cx: &mut Context<'_, GridProblem>) -> (Found, How) {
        let mut ways = [self.way(problem, false), self.way(problem, true)];
        // Exact fields first.
        ways.sort_by_key(|way| way.is_none_or(|way| self.sides[way.side].since < self.log.len()));
        let mut intact = None;
        for way in ways.iter_mut().flatten() {
            let side = &self.sides[way.side];
            let exact = side.since == self.log.len();
            if way.whole == W::MAX {
                if exact || !side.opened {
                    return (Found::Nothing, How::Kept);
                }
                continue;
            }
            self.spare.clear();
            let spare = &mut self.spare;
            let end = side
                .field
                .downhill(problem)
                .go(way.from, |id| spare.push(id));
            way.holds = way.whole - side.field.at(end);
            if end == way.root {
                if exact || !side.opened {
                    self.accept(way.is_backward);
                    return (Found::Path, How::Kept);
                }
                intact = Some(*way);
                break;
            }
        }
        if self.is_last_still_best(problem) {
            return match self.last.is_empty() {
                true => (Found::Nothing, How::Kept),
                false => (Found::Path, How::Kept),
            };
        }
        if let [Some(a), Some(b)] = ways {
            let (to_start, to_goal) = if a.is_backward { (a, b) } else { (b, a) };
            let sides = [&self.sides[to_start.side], &self.sides[to_goal.side]];
            let one_basis = sides[0].since == sides[1].since;
            if one_basis && (intact.is_some() || !sides[0].closed) {
                let found = self.over_freed(problem, [to_start, to_goal], intact, cx);
                if let Some(answer) = found {
                    return answer;
                }
            }
        }
        let nearer = ways.into_iter().flatten().min_by_key(|way| way.holds);
        match intact.or(nearer) {
            Some(way) => self.look(problem, way, intact.is_some(), cx),
            None => self.afar(problem, cx),
        }
    }

    /// The ways that `spare` holds becomes the answer.
    fn accept(&mut self, is_backward: bool) {
        if is_backward {
            self.spare.reverse();
        }
        std::mem::swap(&mut self.last, &mut self.spare);
    }

    /// Whether the last answer is the answer, as far as it still goes: nothing was opened since, and
    /// the rest of a shortest path is one.
    fn is_last_still_best(&mut self, problem: &GridProblem) -> bool {
        let Some((start, goal)) = self.answered else {
            return false;
        };
        if goal != problem.goal() {
            return false;
        }
        if self.last.is_empty() {
            return start == problem.start();
        }
        let from = problem.grid().layout().id(problem.start());
        let Some(at) = self.last.iter().position(|&id| id == from) else {
            return false;
        };
        self.last.drain(..at);
        if problem.judge(&self.path(problem)).is_ok() {
            return true;
        }
        self.answered = None;
        false
    }

    /// What a way over freed cells costs, against the old one: see [`Patch`]. `None` if that proves
    /// nothing.
    fn over_freed(
        &mut self,
        problem: &GridProblem,
        [to_start, to_goal]: [Way<W>; 2],
        intact: Option<Way<W>>,
        cx: &mut Context<'_, GridProblem>,
    ) -> Option<(Found, How)> {
        let [starts, goals] = [&self.sides[to_start.side], &self.sides[to_goal.side]];
        let sight = Sight {
            problem,
            weights: goals.field.basis()?.1,
            sides: [starts, goals],
            ends: [to_start.root, to_goal.root],
            best: intact.map_or(W::MAX, |way| way.whole),
        };
        if !self.patch.look(&sight, &self.log[starts.since..]) {
            return None;
        }
        let (search, marks) = (&mut self.search, &mut self.marks);
        let end = self.patch.search(&sight, search, marks, cx);
        match end {
            End::Cut => Some((Found::Cut, How::Patched)),
            End::TooFar => Some((Found::TooFar, How::Patched)),
            End::Exhausted => Some(match intact {
                Some(way) => {
                    self.accept(way.is_backward);
                    (Found::Path, How::Kept)
                }
                None => (Found::Nothing, How::Kept),
            }),
            End::Goal(_) => {
                // From the start down to where the freed cells begin, over them, and on.
                let at = self.search.reached();
                let first = self.search.back(at).last()?.0;
                let mut way = Vec::new();
                let downhill = starts.field.downhill(problem);
                if downhill.go(first, |id| way.push(id)) != to_start.root {
                    return None;
                }
                way.reverse();
                let known = way.len();
                way.extend(self.search.back(at).map(|(id, _)| id));
                way[known..].reverse();
                way.remove(known);
                way.pop();
                goals.field.downhill(problem).go(at, |id| way.push(id));
                self.spare = way;
                self.accept(false);
                Some((Found::Path, How::Patched))
            }
        }
    }

    /// Searches from one end to where an old way on holds.
    fn look(
        &mut self,
        problem: &GridProblem,
        way: Way<W>,
        is_intact: bool,
        cx: &mut Context<'_, GridProblem>,
    ) -> (Found, How) {
        let layout = *problem.grid().layout();
        let side = &mut self.sides[way.side];
        let Some((root, weights)) = side.field.basis() else {
            return self.afar(problem, cx);
        };
        side.note(problem, &self.log, root, weights);
        let side = &self.sides[way.side];
        let octile = weights.octile::<W>(problem.grid(), problem.moves(), root);
        let opened = side.damage.bound(weights, problem.moves());
        let heuristic = |id: u32| {
            let before = || (octile(id), side.field.at(id));
            let least = if side.opened {
                opened.at(layout.position(id), before)
            } else {
                side.field.at(id)
            };
            clamped(least)
        };
        let mut best = if is_intact { way.whole } else { W::LIMIT };
        if is_intact && heuristic(way.from).is_none_or(|least| least >= best) {
            self.accept(way.is_backward);
            return (Found::Path, How::Kept);
        }
        let downhill = side.field.downhill(problem);
        let marks = &mut self.marks;
        marks.clear(layout.len());
        let first = best;
        let arrive = |id: u32, g: W| {
            let left = side.field.at(id);
            if left < W::MAX
                && g + left < best
                && (side.damage.is_below(left) || marks.is_intact(&downhill, id, way.root))
            {
                best = g + left;
                return Some(left);
            }
            // What cannot beat the best need not be expanded.
            heuristic(id).filter(|&least| g + least >= best)
        };
        let seeds = [(way.from, W::default())];
        let end = self
            .search
            .run_from(problem, &seeds, first, heuristic, arrive, cx);
        match end {
            End::Cut => (Found::Cut, How::Searched),
            End::TooFar => (Found::TooFar, How::Searched),
            End::Exhausted if is_intact => {
                self.accept(way.is_backward);
                (Found::Path, How::Searched)
            }
            End::Exhausted => (Found::Nothing, How::Searched),
            End::Goal(_) => {
                let at = self.search.reached();
                self.spare.clear();
                self.spare.extend(self.search.back(at).map(|(id, _)| id));
                self.spare.reverse();
                self.spare.pop();
                let spare = &mut self.spare;
                downhill.go(at, |id| spare.push(id));
                self.accept(way.is_backward);
                (Found::Path, How::Searched)
            }
        }
    }

    /// Searches from start to goal where no field is rooted at either. By how much the distances of
    /// two cells to a third differ, they are apart at least.
    fn afar(&mut self, problem: &GridProblem, cx: &mut Context<'_, GridProblem>) -> (Found, How) {
        let grid = problem.grid();
        let layout = grid.layout();
        let now = Weights::of(grid);
        let goal = layout.id(problem.goal());
        let octile = now.octile::<W>(grid, problem.moves(), problem.goal());
        let holds = |side: &&Side<W>| {
            let basis = side.field.basis();
            side.since == self.log.len() && basis.is_some_and(|(_, then)| then.hold_under(now))
        };
        let fields: Vec<_> = self.sides.iter().filter(holds).map(|s| &s.field).collect();
        let heuristic = |id: u32| {
            let mut least = octile(id);
            for field in &fields {
                let (here, there) = (field.at(id), field.at(goal));
                if (here == W::MAX) != (there == W::MAX) {
                    return None;
                }
                least = least.max(here.max(there) - here.min(there));
            }
            Some(least)
        };
        let how = match fields.is_empty() {
            true => How::Afresh,
            false => How::Searched,
        };
        let arrive = |id, _| (id == goal).then(W::default);
        let end = self
            .search
            .run_until(problem, problem.start(), heuristic, arrive, cx);
        let found = match end {
            End::Cut => Found::Cut,
            End::TooFar => Found::TooFar,
            End::Exhausted => Found::Nothing,
            End::Goal(_) => {
                self.spare.clear();
                self.spare.extend(self.search.back(goal).map(|(id, _)| id));
                self.accept(true);
                Found::Path
            }
        };
        (found, how)
    }
}

impl<W: Word> Side<W> {
    /// The field is exact.
    fn refresh(&mut self, now: usize) {
        self.damage.clear();
        (self.since, self.noted) = (now, now);
        (self.opened, self.closed) = (false, false);
    }

    /// Works out what the changes so far do to the field.
    fn note(&mut self, problem: &GridProblem, log: &[u32], root: Cell, weights: Weights) {
        if self.noted == log.len() {
            return;
        }
        let octile = weights.octile::<W>(problem.grid(), problem.moves(), root);
        let field = &self.field;
        let news = &log[self.noted..];
        self.damage
            .add(problem, news, weights, |_, id| (octile(id), field.at(id)));
        self.noted = log.len();
    }
}

/// A bound as a search takes it: nothing leads on where it is infinite, and what lies beyond the
/// limit lies there all the same.
pub(super) fn clamped<W: Word>(least: W) -> Option<W> {
    (least < W::LIMIT + W::LIMIT).then(|| least.min(W::LIMIT))
}
