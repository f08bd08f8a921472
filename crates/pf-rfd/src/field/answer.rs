//! Answers from two fields, whether they are exact or bounds.

use super::{
    basin::{Basin, Found, Side},
    chain::{Chain, KEPT},
    patch::Sight,
};
use pf_core::Context;
use pf_grid::{Distances, End, GridProblem, Hold, LastPath, Remnant, Weights, Word};

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

/// The way that one over freed cells is to beat.
#[derive(Clone, Copy, Debug)]
enum Old<W> {
    None,
    /// Down a field; `path` holds it.
    Intact(Way<W>),
    /// The last path, and what it weighs.
    Held(W),
}

/// A change of more cells than this, and than one in so many, is large.
const FEW: usize = 100;
const LARGE: usize = 64;
/// Of so many cells that a search expands one is looked at, whether an old way on holds there. Where it does,
/// it also does on the way down from there.
const SELDOM: usize = 4;

impl<W: Word> Basin<W> {
    /// The way by the field of one end, if there is one of use.
    fn way(&self, problem: &GridProblem, is_backward: bool) -> Option<Way<W>> {
        let (from, to) = if is_backward {
            (problem.goal(), problem.start())
        } else {
            (problem.start(), problem.goal())
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

    /// Answers, and says how. Of the last path so much is left.
    pub(super) fn answer(
        &mut self,
        problem: &GridProblem,
        last: (&LastPath, Hold),
        cx: &mut Context<'_, GridProblem>,
    ) -> (Found, How) {
        if !Distances::<W>::fit(problem) {
            return (Found::TooFar, How::Afresh);
        }
        self.layout = Some(*problem.grid().layout());
        self.ends = [problem.start(), problem.goal()];
        let before = cx.stats().expanded;
        let (found, how) = self.find(problem, last, cx);
        self.debt += cx.stats().expanded - before;
        self.marks.shrink();
        self.way.shrink_to(KEPT);
        self.expanded.clear();
        self.expanded.shrink_to(KEPT);
        if found != Found::Path {
            self.path.clear();
            self.path.shrink();
        }
        if found == Found::Nothing {
            self.apart = Some(self.ends);
        }
        (found, how)
    }

    fn find(
        &mut self,
        problem: &GridProblem,
        last: (&LastPath, Hold),
        cx: &mut Context<'_, GridProblem>,
    ) -> (Found, How) {
        if self.apart == Some([problem.start(), problem.goal()]) {
            return (Found::Nothing, How::Kept);
        }
        let mut ways = [self.way(problem, false), self.way(problem, true)];
        let (last, fate) = last;
        let weigh = || Weights::of(problem.grid()).of_cost::<W>(last.cost());
        let held = (fate == Hold::Legal).then(weigh).flatten();
        if let (Some(weight), [Some(to_goal), Some(to_start)]) = (held, ways)
            // Else an old way that was cut when the last path was found may be open again.
            && weight <= to_goal.whole
            && !self.is_large(&ways)
        {
            let old = Old::Held(weight);
            if let Some(answer) = self.over_freed(problem, [to_start, to_goal], old, cx) {
                return answer;
            }
        }
        // Exact fields first.
        ways.sort_by_key(|way| way.is_none_or(|way| self.sides[way.side].since < self.log.len()));
        let remnants = [false, true].map(|is_backward| {
            let is_of_use = ways
                .iter()
                .flatten()
                .any(|way| way.is_backward == is_backward);
            is_of_use
                .then(|| last.remnant(problem, is_backward))
                .flatten()
        });
        let (found, intact) = self.read_off(problem, &mut ways, &remnants);
        if let Some(found) = found {
            return (found, How::Kept);
        }
        if self.is_large(&ways) {
            return self.afar(problem, cx);
        }
        if let [Some(a), Some(b)] = ways {
            let both = if a.is_backward { [a, b] } else { [b, a] };
            let old = intact.map_or(Old::None, Old::Intact);
            if let Some(answer) = self.over_freed(problem, both, old, cx) {
                return answer;
            }
        }
        let nearer = ways.into_iter().flatten().min_by_key(|way| way.holds);
        match intact.or(nearer) {
            Some(way) => {
                let remnant = remnants[usize::from(way.is_backward)].as_ref();
                self.look(problem, way, intact.is_some(), remnant, cx)
            }
            None => self.afar(problem, cx),
        }
    }

    /// Whether so much was opened that to look at it takes longer than to search without.
    fn is_large(&self, ways: &[Option<Way<W>>; 2]) -> bool {
        let cells = self.layout.map_or(0, |layout| layout.len());
        ways.iter().flatten().all(|way| {
            let side = &self.sides[way.side];
            side.opened && self.log.len() - side.since > FEW.max(cells / LARGE)
        })
    }

    /// What the fields say without a search; else an old way that still holds and may no longer be
    /// the best, which `path` then holds.
    fn read_off(
        &mut self,
        problem: &GridProblem,
        ways: &mut [Option<Way<W>>; 2],
        remnants: &[Option<Remnant<'_, W>>; 2],
    ) -> (Option<Found>, Option<Way<W>>) {
        let layout = problem.grid().layout();
        for way in ways.iter_mut().flatten() {
            let side = &self.sides[way.side];
            let is_proof = side.since == self.log.len() || !side.opened;
            if way.whole == W::MAX {
                if is_proof {
                    return (Some(Found::Nothing), None);
                }
                continue;
            }
            if is_proof
                && let Some(remnant) = &remnants[usize::from(way.is_backward)]
                && let Some(along) = remnant.join(layout.cell(way.from), way.whole, &mut self.way)
            {
                return (Some(self.joined(way.is_backward, along)), None);
            }
            let path = &mut self.path;
            path.begin(way.from);
            let downhill = side.field.downhill(problem);
            let end = downhill.go(way.from, |k| path.push(k));
            way.holds = way.whole - side.field.at(end);
            if end == way.root {
                if is_proof {
                    self.accept(problem, way.is_backward);
                    return (Some(Found::Path), None);
                }
                return (None, Some(*way));
            }
        }
        (None, None)
    }

    /// The way in `way` becomes a part of the answer.
    fn joined(&mut self, is_backward: bool, along: usize) -> Found {
        if is_backward {
            self.way.reverse();
        }
        Found::Joined { is_backward, along }
    }

    /// The way in `path` becomes the answer.
    fn accept(&mut self, problem: &GridProblem, is_backward: bool) {
        if is_backward {
            self.path.turn(problem.grid().layout().id(problem.start()));
        }
    }

    /// What a way over freed cells costs, against the old one: see [`Patch`]. `None` if that proves
    /// nothing.
    fn over_freed(
        &mut self,
        problem: &GridProblem,
        [to_start, to_goal]: [Way<W>; 2],
        old: Old<W>,
        cx: &mut Context<'_, GridProblem>,
    ) -> Option<(Found, How)> {
        let [starts, goals] = [&self.sides[to_start.side], &self.sides[to_goal.side]];
        let is_known = !matches!(old, Old::None) || !starts.closed;
        if starts.since != goals.since || !is_known {
            return None;
        }
        let sight = Sight {
            problem,
            weights: goals.field.basis()?.1,
            sides: [starts, goals],
            ends: [to_start.root, to_goal.root],
            best: match old {
                Old::None => W::MAX,
                Old::Intact(way) => way.whole,
                Old::Held(weight) => weight,
            },
        };
        if !self.patch.look(&sight, &self.log[starts.since..]) {
            return None;
        }
        let (search, marks) = (&mut self.search, &mut self.marks);
        let end = self.patch.search(&sight, search, marks, cx);
        match end {
            End::Cut => Some((Found::Cut, How::Patched)),
            End::TooFar => Some((Found::TooFar, How::Patched)),
            End::Exhausted => Some(match old {
                Old::Intact(way) => {
                    self.accept(problem, way.is_backward);
                    (Found::Path, How::Kept)
                }
                Old::Held(_) => (Found::Held, How::Kept),
                Old::None => (Found::Nothing, How::Kept),
            }),
            End::Goal(_) => {
                // From the start down to where the freed cells begin, over them, and on.
                let at = self.search.reached();
                let first = self.search.back(at).last().map_or(at, |(id, ..)| id);
                let mut way = Chain::default();
                way.begin(first);
                let downhill = starts.field.downhill(problem);
                if downhill.go(first, |k| way.push(k)) != to_start.root {
                    return None;
                }
                way.turn(to_start.root);
                self.path = way;
                let marked = self.sides[to_goal.side].closed;
                self.go_on(problem, to_goal, at, marked);
                Some((Found::Path, How::Patched))
            }
        }
    }

    /// The answer is what `path` holds, the way of the last search to where it arrived, and the
    /// old way on from there: the one that was `marked`, if it was.
    fn go_on(&mut self, problem: &GridProblem, way: Way<W>, at: u32, marked: bool) {
        let path = &mut self.path;
        path.push_all_back(self.search.back(at).map(|(.., k)| k));
        let downhill = self.sides[way.side].field.downhill(problem);
        if marked && self.marks.holds(at) {
            self.marks.go(&downhill, at, way.root, |k| path.push(k));
        } else {
            downhill.go(at, |k| path.push(k));
        }
        self.accept(problem, way.is_backward);
    }

    /// Searches from one end to where an old way on holds, or a remnant of the last path is joined.
    fn look(
        &mut self,
        problem: &GridProblem,
        way: Way<W>,
        is_intact: bool,
        remnant: Option<&Remnant<'_, W>>,
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
            self.accept(problem, way.is_backward);
            return (Found::Path, How::Kept);
        }
        let downhill = side.field.downhill(problem);
        let (marks, line) = (&mut self.marks, &mut self.way);
        marks.clear(layout.len());
        let expanded = &mut self.expanded;
        // No field is raised where cells were freed.
        let most = if side.opened { 0 } else { side.field.room() };
        let (mut count, mut joined) = (0, None);
        let first = best;
        let arrive = |id: u32, g: W| {
            if count < most {
                expanded.push(id);
            }
            count += 1;
            let left = side.field.at(id);
            if left < W::MAX && g + left < best && (count % SELDOM == 0 || id == way.root) {
                let mut place = None;
                let mut joins = || {
                    place = remnant.and_then(|it| it.join(layout.cell(id), left, line));
                    place.is_some()
                };
                let is_below = side.damage.is_below(left);
                if is_below {
                    joins();
                }
                if is_below || marks.is_intact(&downhill, id, way.root, joins) {
                    joined = place;
                    best = g + left;
                    return Some(left);
                }
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
                self.accept(problem, way.is_backward);
                (Found::Path, How::Searched)
            }
            End::Exhausted => (Found::Nothing, How::Searched),
            End::Goal(whole) => {
                let at = self.search.reached();
                self.path.begin(way.from);
                let found = if let Some(along) = joined {
                    let back = self.search.back(at).map(|(.., k)| k);
                    self.path.push_all_back(back);
                    self.way.splice(..1, self.path.walk(&layout));
                    self.joined(way.is_backward, along)
                } else {
                    self.go_on(problem, way, at, true);
                    Found::Path
                };
                if count <= most {
                    self.raise(way, whole);
                }
                (found, How::Searched)
            }
        }
    }

    /// The last search found out that so much is the least there is, so from what it expanded no less is left
    /// than what the way there leaves of it.
    ///
    /// The damage must know of all that changed before: what it calls intact goes by values from when the field
    /// was exact, or by raised ones whose own ways it knows to be cut.
    fn raise(&mut self, way: Way<W>, whole: W) {
        debug_assert!(self.sides[way.side].is_noted(&self.log));
        let search = &self.search;
        let left = |id| {
            let g = search.weight(id).map_or(whole, |g| g.min(whole));
            whole - g
        };
        self.sides[way.side].field.raise(&self.expanded, left);
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
        let how = if fields.is_empty() {
            How::Afresh
        } else {
            How::Searched
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
                self.path.begin(layout.id(problem.start()));
                let back = self.search.back(goal);
                self.path.push_all_back(back.map(|(.., k)| k));
                self.accept(problem, false);
                Found::Path
            }
        };
        (found, how)
    }
}

/// A bound as a search takes it: nothing leads on where it is infinite, and what lies beyond the
/// limit lies there all the same.
pub(super) fn clamped<W: Word>(least: W) -> Option<W> {
    (least < W::LIMIT + W::LIMIT).then(|| least.min(W::LIMIT))
}
