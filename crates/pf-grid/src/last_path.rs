//! The last answer, for as long as nothing that happens can make another one better.

use crate::{
    Cell, GridChange, GridCost, GridProblem, Remnant, Word,
    bend::{Bend, bend},
    problem::Steps,
    remnant::FAR,
    window::Window,
};
use pf_core::{Context, Outcome, Problem, Report, Revision, Solved, Stamp};

/// The last shortest path, and what is left of it.
///
/// Its end is a shortest path, too; and where cells are blocked, whatever else is left is no shorter than
/// before. It was judged whole once, when it was found. After that the judge looks at the steps near cells
/// that were blocked, as nothing else can make a step illegal. Where they are, and the map has no terrain,
/// the path [bends](Bend) if the same steps in another order lead past: that costs what it did. If none do, it is
/// broken, and a search around the break may end where it joins one of its remnants.
///
/// ```
/// use pf_core::{Context, Problem, Proof};
/// use pf_grid::{Bend, Cell, Grid, GridChange, GridCost, GridProblem, Hold, LastPath};
///
/// let grid = Grid::open(5, 3).unwrap();
/// let mut problem = GridProblem::new(grid, Cell::new(0, 1), Cell::new(4, 1)).unwrap();
/// let across = (0..5).map(|x| Cell::new(x, 1)).collect();
/// let report = Context::seeded(0).answer(&problem, across, Proof::Optimal);
/// let mut last = LastPath::default();
/// last.remember(&problem, &report);
///
/// let changes = [GridChange::StartMoved(Cell::new(1, 1)), GridChange::Blocked(vec![Cell::new(2, 0)])];
/// assert_eq!(last.follow(&problem.revise(&changes).unwrap(), Bend::Near), Hold::Best);
/// assert_eq!(last.left().unwrap().cost, GridCost::of_steps(3, 0));
///
/// let changes = [GridChange::Blocked(vec![Cell::new(3, 1)])];
/// assert_eq!(last.follow(&problem.revise(&changes).unwrap(), Bend::Near), Hold::Broken);
/// ```
#[derive(Clone, Debug, Default)]
pub struct LastPath {
    /// Of the problem in which it was last known to hold.
    known: Option<Stamp>,
    path: Vec<Cell>,
    /// Where in it the robot is.
    at: usize,
    /// Of what is left.
    cost: GridCost,
    /// The problem in which it is broken.
    broken: Option<Stamp>,
    /// The places of the last cell of the remnant at the start and of the first of that at the goal, in the
    /// problem in which it is broken.
    ends: [Option<usize>; 2],
    /// Nothing was freed since.
    is_best: bool,
    /// The map had no terrain then: every step of the path costs its length.
    is_plain: bool,
}

/// What has become of a [`LastPath`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hold {
    /// What is left of it is a shortest path.
    Best,
    /// What is left of it is a path, and cells were freed, so that there may be a shorter one.
    Legal,
    /// It is broken, or an end moved off it, on a map without terrain: there may be [remnants](LastPath::remnant).
    Broken,
    /// It is forgotten.
    Gone,
}

/// So long a path is remembered on any map,
const SHORT: usize = 1 << 12;
/// and one of a cell in so many on large ones: eight bytes a step are half a byte a cell.
const SPARSE: usize = 16;

/// Whether a path is remembered.
fn is_short(problem: &GridProblem, path: &[Cell]) -> bool {
    path.len() <= SHORT.max(problem.grid().layout().len() / SPARSE)
}

/// The first and the last illegal step of a path, if cells were blocked in a window and nowhere else.
fn breaks(steps: &Steps<'_>, path: &[Cell], blocked: Window) -> Option<[usize; 2]> {
    let mut broken: Option<[usize; 2]> = None;
    let mut at = 0;
    while let [cell, next, ..] = path[at..] {
        // A step is hindered by cells beside both its ends, and brings a path no more than one nearer.
        let away = blocked.away(cell);
        if away > 1 {
            at = path.len().min(at + away - 1);
            continue;
        }
        if !steps.is_legal(cell, next) {
            broken = Some([broken.map_or(at, |[first, _]| first), at]);
        }
        at += 1;
    }
    broken
}

/// What a path costs on a map without terrain.
fn length(path: &[Cell]) -> GridCost {
    // No branch: of which kind a step is is hard to guess.
    let kinds = path
        .windows(2)
        .map(|pair| u64::from(pair[0].x != pair[1].x) & u64::from(pair[0].y != pair[1].y));
    let diagonal = kinds.sum();
    GridCost::of_steps(path.len() as u64 - 1 - diagonal, diagonal)
}

/// What is left of a cost without a part.
fn less(all: GridCost, part: GridCost) -> GridCost {
    GridCost {
        straight: all.straight - part.straight,
        diagonal: all.diagonal - part.diagonal,
    }
}

impl LastPath {
    /// Bytes held.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.path.capacity() * size_of::<Cell>()
    }

    /// Remembers what was answered, if it was proved, and short enough for the map.
    pub fn remember(&mut self, problem: &GridProblem, report: &Report<GridProblem>) {
        (self.known, self.broken) = (None, None);
        if let Outcome::Optimal(best) = &report.outcome
            && is_short(problem, &best.solution)
        {
            self.known = Some(problem.stamp());
            // A vector that grows by itself takes up to twice as much.
            self.path.clear();
            self.path.reserve_exact(best.solution.len());
            self.path.extend_from_slice(&best.solution);
            (self.at, self.cost, self.is_best) = (0, best.cost, true);
            self.is_plain = problem.grid().is_uniform();
        }
    }

    /// What has become of it now, bent as far as is said. If it is not told of a revision, it is gone at the next one.
    pub fn follow(&mut self, revision: &Revision<'_, GridProblem>, how: Bend) -> Hold {
        self.hold(revision, how).unwrap_or(Hold::Gone)
    }

    fn hold(&mut self, revision: &Revision<'_, GridProblem>, how: Bend) -> Option<Hold> {
        self.broken = None;
        let changes = revision.since(self.known.take())?;
        let problem = revision.problem();
        let grid = problem.grid();
        let mut blocked: Option<Window> = None;
        for change in changes {
            match change {
                GridChange::StartMoved(_) | GridChange::GoalMoved(_) => {}
                GridChange::Blocked(cells) => {
                    for cell in cells {
                        Window::hold(&mut blocked, (cell.x, cell.y));
                    }
                }
                GridChange::Freed(_) => self.is_best = false,
                GridChange::CostChanged(..) => return None,
            }
        }
        if !grid.is_free(problem.start()) || !grid.is_free(problem.goal()) {
            return None;
        }
        // What is dear may have been blocked meanwhile, or freed.
        let is_plain = self.is_plain && grid.is_uniform();
        let steps = Steps::of(problem);
        let left = &self.path[self.at..];
        let leads = left.last() == Some(&problem.goal());
        let begin = left.iter().position(|&cell| cell == problem.start());
        if let Some(begin) = begin {
            let sum = |from, to| grid.sum_of_costs(from, to);
            let (walked, _) = steps.cost(&left[..=begin], sum);
            self.cost = less(self.cost, walked);
            self.at += begin;
        }
        let left = &mut self.path[self.at..];
        let broken = blocked.and_then(|blocked| breaks(&steps, left, blocked));
        let is_whole = leads && begin.is_some();
        if is_whole && broken.is_none_or(|broken| is_plain && bend(&steps, left, broken, how)) {
            self.known = Some(problem.stamp());
            let is_best = self.is_best;
            return Some(if is_best { Hold::Best } else { Hold::Legal });
        }
        if !is_plain {
            return None;
        }
        let [first, last] = match broken {
            None => [left.len() - 1, 0],
            // Behind the last step into what is blocked, and out of it.
            Some([first, last]) => {
                let behind = last + 1;
                [first, behind + usize::from(!grid.is_free(left[behind]))]
            }
        };
        // If the robot has left the path, the first cell may be blocked: no way steps into it, so none joins there.
        self.ends = [
            begin.map(|_| self.at + first),
            leads.then_some(self.at + last),
        ];
        self.broken = Some(problem.stamp());
        Some(Hold::Broken)
    }

    /// What is left of it costs so much, if it holds.
    #[must_use]
    pub fn cost(&self) -> GridCost {
        self.cost
    }

    /// What was left of it cost so much, if it is broken and led from the robot to the goal.
    #[must_use]
    pub fn broken_cost(&self, problem: &GridProblem) -> Option<GridCost> {
        let is_whole = self.ends.iter().all(Option::is_some);
        (is_whole && self.is_broken(problem)).then_some(self.cost)
    }

    fn is_broken(&self, problem: &GridProblem) -> bool {
        self.broken == Some(problem.stamp())
    }

    /// If it is broken, what is left of it at the goal, or at the start if that `is_backward`. `None` beyond
    /// [`Word::LIMIT`], too.
    #[must_use]
    pub fn remnant<'p, W: Word>(
        &self,
        problem: &'p GridProblem,
        is_backward: bool,
    ) -> Option<Remnant<'p, W>> {
        if !self.is_broken(problem) {
            return None;
        }
        let [last, first] = self.ends;
        let mut rest = self.cost;
        let mut take_off = |cells: &[Cell]| rest = less(rest, length(cells));
        if is_backward {
            let last = last?;
            take_off(&self.path[last..]);
            let cells = self.path[self.at.max(last.saturating_sub(FAR))..=last].iter();
            return Remnant::of(problem, cells.rev().copied(), rest);
        }
        let first = first?;
        take_off(&self.path[self.at..=first]);
        let end = self.path.len().min(first + FAR + 1);
        Remnant::of(problem, self.path[first..end].iter().copied(), rest)
    }

    /// Answers with a way that joins the remnant at the goal so far along, and what is left from there; or what
    /// leads so far along the remnant at the start, and a way on from there. As what is best, if it is legal:
    /// that there is none shorter, the caller knows.
    pub fn rejoin(
        &mut self,
        problem: &GridProblem,
        (is_backward, along): (bool, usize),
        way: &[Cell],
        cx: &mut Context<'_, GridProblem>,
    ) -> Option<Report<GridProblem>> {
        if !self.is_broken(problem) {
            return None;
        }
        let (&first, &last) = (way.first()?, way.last()?);
        let (more, is_legal) = Steps::of(problem).cost(way, |_, _| 2);
        let place = if is_backward {
            self.ends[0]?.checked_sub(along)?
        } else {
            self.ends[1]? + along
        };
        let joined = *self.path.get(place).filter(|_| place >= self.at)?;
        // What comes off the path, what of that was not walked yet, and where the way leads from and to.
        let (off, from, ends) = if is_backward {
            (place..self.path.len(), place, [joined, problem.goal()])
        } else {
            (0..place + 1, self.at, [problem.start(), joined])
        };
        if !is_legal || [first, last] != ends || !problem.grid().is_free(first) {
            return None;
        }
        self.cost = less(self.cost, length(&self.path[from..off.end])) + more;
        if let Some(begin) = off.end.checked_sub(way.len()).filter(|_| !is_backward) {
            // What was walked leaves room for it.
            self.path[begin..off.end].copy_from_slice(way);
            self.at = begin;
        } else {
            // A vector that grows by itself takes up to twice as much.
            self.path.reserve_exact(way.len().saturating_sub(off.len()));
            self.path.splice(off, way.iter().copied());
            if is_backward {
                self.path.drain(..self.at);
            }
            self.at = 0;
        }
        self.broken = None;
        self.known = is_short(problem, &self.path[self.at..]).then(|| problem.stamp());
        Some(self.report(problem, cx))
    }

    /// Answers with what is left of it, as what is best.
    fn report(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Report<GridProblem> {
        let best = self.whole();
        debug_assert_eq!(problem.judge(&best.solution), Ok(best.cost));
        self.is_best = true;
        cx.improved(|| best.clone());
        cx.report(Outcome::Optimal(best))
    }

    fn whole(&self) -> Solved<GridProblem> {
        Solved {
            solution: self.path[self.at..].to_vec(),
            cost: self.cost,
        }
    }

    /// What is left of it, if it holds.
    #[must_use]
    pub fn left(&self) -> Option<Solved<GridProblem>> {
        self.known.map(|_| self.whole())
    }

    /// Answers with what is left of it, if it holds, as what is best. The note `replanned` says `kept`.
    pub fn keep(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Option<Report<GridProblem>> {
        self.known?;
        cx.note("replanned", "kept");
        Some(self.report(problem, cx))
    }

    /// Follows a revision, and answers if what is left is still best and the budget allows an iteration.
    pub fn answer(
        &mut self,
        revision: &Revision<'_, GridProblem>,
        how: Bend,
        cx: &mut Context<'_, GridProblem>,
    ) -> Option<Report<GridProblem>> {
        let is_best = self.follow(revision, how) == Hold::Best && cx.proceed();
        is_best.then(|| self.keep(revision.problem(), cx))?
    }
}
