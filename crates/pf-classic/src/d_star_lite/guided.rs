//! Answers from what is known of the distances, in one word width.

mod changes;

use super::distances::Distances;
use changes::Freed;
use pf_core::{Context, Outcome};
use pf_grid::{Cell, Damage, End, GridProblem, Learned, Route, Search, Upkeep, Weights, Word};

/// How an answer came about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Found {
    /// The route holds the answer.
    Path,
    /// Proof that there is none.
    Nothing,
    /// The budget ran out.
    Cut,
    /// The search took more than it may.
    GaveUp,
    /// The word is too narrow for this map.
    TooFar,
}

/// How a [`Found`] was come by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// The last path is still best.
    Kept,
    /// A search from the start, directed by what was known.
    Searched,
    /// Nothing of use was known.
    Afresh,
}

/// Distances to the goal, what is known beside them, and a search from the start that both direct.
///
/// The distances are not repaired before an answer. A search from the robot takes them as its
/// heuristic, as far as the changes since let it stand ([`Damage`]), and ends where the way on
/// is known: on the last route, or below all damage. What such a search finds out about the cells
/// it expanded is kept for the next one: no way from there is shorter than the answer less the way
/// there.
///
/// Source: Hernandez, Asin, Baier, *Making A\* run faster than D\*-Lite for path-planning in
/// partially known terrain*, 2014 (MPAA\*); the distance field and the treatment of freed cells are
/// ours.
#[derive(Clone, Debug)]
pub(super) struct Guided<W: Word> {
    pub(super) distances: Distances<W>,
    search: Search<W>,
    route: Route<W>,
    damage: Damage<W>,
    /// What was freed.
    freed: Freed,
    /// An answer came without them, and they were not made since.
    are_due: bool,
    /// What the changes are counted from: a goal and its weights.
    basis: Option<(Cell, Weights)>,
    /// Found out since anything last became free or cheaper: what is left to the basis' goal.
    learned: Learned<W>,
    /// What the last search expanded.
    closed: Vec<u32>,
    /// The weight of what it found; [`Word::MAX`] if nothing.
    whole: W,
    /// Ids on the way down the distances.
    tail: Vec<u32>,
}

impl<W: Word> Default for Guided<W> {
    fn default() -> Self {
        Self {
            distances: Distances::default(),
            search: Search::default(),
            route: Route::default(),
            damage: Damage::default(),
            freed: Freed::default(),
            are_due: false,
            basis: None,
            learned: Learned::default(),
            closed: Vec::new(),
            whole: W::MAX,
            tail: Vec::new(),
        }
    }
}

impl<W: Word> Guided<W> {
    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        self.distances.bytes()
            + self.search.bytes()
            + self.route.bytes()
            + self.damage.bytes()
            + self.learned.bytes()
            + self.freed.bytes()
            + size_of::<u32>() * (self.closed.capacity() + self.tail.capacity())
    }

    /// Makes the distances anew and takes the answer from them.
    pub(super) fn plan(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Found {
        if !fits::<W>(problem) {
            return Found::TooFar;
        }
        self.begin(problem);
        match self.distances.plan(problem, cx) {
            End::Goal(_) | End::Exhausted => self.read_off(problem),
            End::Cut => Found::Cut,
            End::TooFar => Found::TooFar,
        }
    }

    /// The same with distances that can be repaired.
    pub(super) fn found(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Found {
        if !fits::<W>(problem) {
            return Found::TooFar;
        }
        self.begin(problem);
        match self.distances.found(problem, cx) {
            Upkeep::Cut => Found::Cut,
            _ => self.read_off(problem),
        }
    }

    /// Repairs the distances after all that changed since they were right, and takes the answer from
    /// them; `None` if that took too much.
    pub(super) fn repair(
        &mut self,
        problem: &GridProblem,
        changed: &[u32],
        most: u64,
        cx: &mut Context<'_, GridProblem>,
    ) -> Option<Found> {
        self.begin(problem);
        match self.distances.repair(problem, changed, most, cx) {
            Upkeep::GaveUp => None,
            Upkeep::Cut => Some(Found::Cut),
            Upkeep::Settled => Some(self.read_off(problem)),
        }
    }

    /// Whether anything of use for this goal and these weights is known.
    pub(super) fn knows(&self, problem: &GridProblem) -> bool {
        let now = Weights::of(problem.grid());
        self.basis
            .is_some_and(|(goal, weights)| goal == problem.goal() && weights.hold_under(now))
    }

    /// Does what can be done before the next answer is asked for.
    pub(super) fn prepare(&mut self, problem: &GridProblem, cx: &mut Context<'_, GridProblem>) {
        self.learn();
        self.distances.prepare(problem);
        self.search.prepare(problem.grid().layout());
        let is_basis = self.basis.is_some_and(|(goal, _)| goal == problem.goal());
        if is_basis {
            self.distances.look_around(problem, cx);
        }
    }

    /// Nothing is known: who needs distances has to make them.
    pub(super) fn give_up(&mut self, problem: &GridProblem) {
        self.distances.give_up(problem);
        self.forget();
        self.route.forget();
        (self.basis, self.are_due) = (None, true);
    }

    /// Whether [nothing](Self::give_up) is known.
    pub(super) fn is_idle(&self) -> bool {
        self.basis.is_none() && self.are_due
    }

    fn forget(&mut self) {
        self.learned.forget();
        self.closed.clear();
        self.damage.clear();
        self.freed.clear();
    }

    /// Nothing changed yet.
    fn begin(&mut self, problem: &GridProblem) {
        let layout = problem.grid().layout();
        // If making them is cut, another answer does without.
        self.are_due = false;
        self.forget();
        self.route.clear(layout);
        self.basis = Some((problem.goal(), Weights::of(problem.grid())));
    }

    fn read_off(&mut self, problem: &GridProblem) -> Found {
        if self.distances.are_too_narrow(problem.start()) {
            return Found::TooFar;
        }
        let layout = problem.grid().layout();
        let start = layout.id(problem.start());
        match self.distances.settled() {
            Some((_, whole)) if whole < W::MAX => {
                self.tail.clear();
                if self.distances.trace(start, &mut self.tail) {
                    let goal = self.tail.pop().unwrap_or(start);
                    self.route.restart(goal, layout.cell(goal));
                    self.come_up(problem, goal, W::default());
                } else {
                    self.go_down(problem, start, whole);
                }
                Found::Path
            }
            _ => Found::Nothing,
        }
    }

    /// Answers after these further changes; a search from the start may expand so many cells at the most.
    pub(super) fn answer(
        &mut self,
        problem: &GridProblem,
        changed: &[u32],
        most: u64,
        cx: &mut Context<'_, GridProblem>,
    ) -> (Found, Way) {
        if !fits::<W>(problem) {
            return (Found::TooFar, Way::Afresh);
        }
        self.learn();
        if self.knows(problem) {
            self.note(problem, changed);
            let start = problem.grid().layout().id(problem.start());
            if self.still_best(problem, start) {
                self.route.cut_to(start, problem.start());
                return (Found::Path, Way::Kept);
            }
            if self.knows_more(problem, start) {
                let found = cx.at_most(most, |cx| self.look(problem, cx));
                // What it expanded may still be of use.
                if found == Found::Cut && !cx.stopped() {
                    return (Found::GaveUp, Way::Searched);
                }
                if found == Found::Cut {
                    self.closed.clear();
                }
                return (found, Way::Searched);
            }
        }
        // If nobody has made the distances, an answer has to.
        let found = if self.are_due {
            self.plan(problem, cx)
        } else {
            self.start_over(problem, cx)
        };
        (found, Way::Afresh)
    }

    /// Whether the distances wait to be made.
    pub(super) fn are_due(&self) -> bool {
        self.are_due
    }

    /// Forgets all, and searches from the start: the distances to the goal are made later.
    fn start_over(&mut self, problem: &GridProblem, cx: &mut Context<'_, GridProblem>) -> Found {
        self.begin(problem);
        self.are_due = true;
        match self.distances.start_over(problem, cx) {
            End::Goal(whole) => {
                let layout = problem.grid().layout();
                let goal = layout.id(problem.goal());
                self.route.restart(goal, problem.goal());
                for (id, g, _) in self.distances.way_back(goal) {
                    self.route.extend(id, layout.cell(id), whole - g);
                }
                Found::Path
            }
            End::Exhausted => Found::Nothing,
            End::Cut => Found::Cut,
            End::TooFar => Found::TooFar,
        }
    }

    /// For which start the distances were made.
    fn anchor(&self, problem: &GridProblem) -> Cell {
        self.distances
            .settled()
            .map_or(problem.goal(), |(cell, _)| cell)
    }

    /// Whether what is left of the route is as good as ever.
    fn still_best(&self, problem: &GridProblem, start: u32) -> bool {
        let Some(left) = self.route.left(start, problem.start()) else {
            return false;
        };
        self.bound(problem)(start, false).0 >= left
    }

    /// Of an id, a bound from below on what is left, and on request whether that much is left, and
    /// nothing that changed matters to it.
    fn bound<'s>(&'s self, problem: &GridProblem) -> impl Fn(u32, bool) -> (W, bool) + use<'s, W> {
        let layout = *problem.grid().layout();
        let weights = self
            .basis
            .map_or(Weights::of(problem.grid()), |(_, weights)| weights);
        let before = self.before(problem, weights);
        let opened = self.damage.bound(weights, problem.moves());
        let learned = (!self.learned.is_empty()).then_some(&self.learned);
        move |id, exactly| {
            let place = layout.position(id);
            let least = opened.at(place, || {
                let (to_goal, (least, _)) = before(place, id);
                (to_goal, least)
            });
            let exact = exactly && self.damage.is_below(least) && {
                let (_, (left, exact)) = before(place, id);
                exact && left == least
            };
            (
                learned.map_or(least, |learned| least.max(learned.at(id))),
                exact,
            )
        }
    }

    /// Searches from the start to where the way on is known.
    fn look(&mut self, problem: &GridProblem, cx: &mut Context<'_, GridProblem>) -> Found {
        let layout = *problem.grid().layout();
        let goal = layout.id(problem.goal());
        let mut search = std::mem::take(&mut self.search);
        let mut closed = std::mem::take(&mut self.closed);
        let end = {
            let bound = self.bound(problem);
            let heuristic = |id| Some(bound(id, false).0).filter(|&least| least < W::MAX);
            let most = self.route.most().unwrap_or_default();
            let arrive = |id, _| {
                closed.push(id);
                if id == goal {
                    return Some(W::default());
                }
                let (least, exact) = bound(id, true);
                if exact {
                    return Some(least);
                }
                // The route would have to take its time for places that are further than all of it.
                (least <= most)
                    .then(|| self.route.left(id, layout.cell(id)))
                    .flatten()
            };
            search.run_until(problem, problem.start(), heuristic, arrive, cx)
        };
        self.closed = closed;
        self.search = search;
        match end {
            End::Cut => return Found::Cut,
            End::TooFar => {
                self.closed.clear();
                return Found::TooFar;
            }
            End::Exhausted => {
                self.whole = W::MAX;
                return Found::Nothing;
            }
            End::Goal(whole) => self.whole = whole,
        }
        let at = self.search.reached();
        let first = self.search.weight(at).unwrap_or_default();
        let left = self.whole - first;
        self.go_down(problem, at, left);
        for (id, g, _) in self.search.back(at) {
            self.route.extend(id, layout.cell(id), self.whole - g);
        }
        Found::Path
    }

    /// What the search that gave up was looking for, somebody else has found, or not.
    pub(super) fn be_told(&mut self, problem: &GridProblem, found: &Outcome<GridProblem>) {
        let whole = match found {
            Outcome::Optimal(best) => Weights::of(problem.grid()).of_cost(best.cost),
            Outcome::Infeasible => Some(W::MAX),
            _ => None,
        };
        match whole {
            Some(whole) => self.whole = whole,
            None => self.closed.clear(),
        }
    }

    /// Whether what is known beats the plain heuristic by enough to pay for looking it up.
    fn knows_more(&self, problem: &GridProblem, start: u32) -> bool {
        let grid = problem.grid();
        if self.learned.at(start) > W::default() {
            return true;
        }
        let Some((_, whole)) = self.distances.settled() else {
            return !self.learned.is_empty();
        };
        let octile = Weights::of(grid).octile::<W>(grid, problem.moves(), problem.goal());
        self.damage.leaves(octile(start), whole)
    }

    /// Makes the route begin at an id from which so much is left: on from there along the route
    /// that holds, or down the distances until there.
    fn go_down(&mut self, problem: &GridProblem, from: u32, mut left: W) {
        let layout = *problem.grid().layout();
        let goal = layout.id(problem.goal());
        self.tail.clear();
        let mut id = from;
        loop {
            let cell = layout.cell(id);
            if self.route.left(id, cell) == Some(left) {
                self.route.cut_to(id, cell);
                break;
            }
            if id == goal {
                self.route.restart(id, cell);
                break;
            }
            self.tail.push(id);
            let Some((next, weight)) = self.distances.next(problem, id, left) else {
                // Not to be reached; the judge would see it.
                self.route.restart(id, cell);
                break;
            };
            id = next;
            left = left - weight;
        }
        self.come_up(problem, id, left);
    }

    /// Puts the tail before the route, which begins at an id from which so much is left.
    fn come_up(&mut self, problem: &GridProblem, mut id: u32, mut left: W) {
        let layout = *problem.grid().layout();
        let weights = self
            .basis
            .map_or(Weights::of(problem.grid()), |(_, weights)| weights);
        while let Some(before) = self.tail.pop() {
            let weight = weights.between::<W>(problem.grid(), before, id);
            left = left + weight;
            self.route.extend(before, layout.cell(before), left);
            id = before;
        }
    }

    /// Keeps what the last search found out.
    fn learn(&mut self) {
        if self.closed.is_empty() {
            return;
        }
        let (search, whole) = (&self.search, self.whole);
        let left = |g| {
            if whole == W::MAX {
                return W::MAX;
            }
            whole.max(g) - g
        };
        let found = self.closed.drain(..);
        let found = found.filter_map(|id| Some((id, left(search.weight(id)?))));
        self.learned.learn(search.len(), found);
    }

    /// The route, the start first.
    pub(super) fn path(&self) -> Vec<Cell> {
        self.route.path()
    }
}

/// Whether keys of searches and fields fit the word: a distance, a heuristic, and what a robot that
/// moved raises them by, which stays below the limit, too.
fn fits<W: Word>(problem: &GridProblem) -> bool {
    Weights::of(problem.grid()).fit::<W>(problem.grid(), 2)
}
