//! The last answer, for as long as nothing that happens can make another one better.

use crate::{
    Cell, GridChange, GridCost, GridProblem, Tail, Word, bend::bend, problem::Steps, window::Window,
};
use pf_core::{Context, Outcome, Problem, Report, Revision, Solved, Stamp};

/// The last shortest path, and what is left of it.
///
/// Its end is a shortest path, too; and where cells are blocked, whatever else is left is no shorter than
/// before. It was judged whole once, when it was found. After that the judge looks at the steps near cells
/// that were blocked, as nothing else can make a step illegal. Where they are, and the map has no terrain,
/// the path bends if the same steps in another order lead past: that costs what it did. If none do, it is
/// broken, and a search around the break may end where it joins what is left behind it.
///
/// ```
/// use pf_core::{Context, Problem, Proof};
/// use pf_grid::{Cell, Grid, GridChange, GridCost, GridProblem, Hold, LastPath};
///
/// let grid = Grid::open(5, 3).unwrap();
/// let mut problem = GridProblem::new(grid, Cell::new(0, 1), Cell::new(4, 1)).unwrap();
/// let across = (0..5).map(|x| Cell::new(x, 1)).collect();
/// let report = Context::seeded(0).answer(&problem, across, Proof::Optimal);
/// let mut last = LastPath::default();
/// last.remember(&problem, &report);
///
/// let changes = [GridChange::StartMoved(Cell::new(1, 1)), GridChange::Blocked(vec![Cell::new(2, 0)])];
/// assert_eq!(last.follow(&problem.revise(&changes).unwrap()), Hold::Best);
/// assert_eq!(last.left().unwrap().cost, GridCost::of_steps(3, 0));
///
/// let changes = [GridChange::Blocked(vec![Cell::new(3, 1)])];
/// assert_eq!(last.follow(&problem.revise(&changes).unwrap()), Hold::Broken);
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
    /// It is broken, on a map without terrain; its [`tail`](LastPath::tail) is what is left behind the break.
    Broken,
    /// It is forgotten.
    Gone,
}

/// So long a path is remembered on any map,
const SHORT: usize = 1 << 12;
/// and one of a cell in so many on large ones: eight bytes a step are half a byte a cell.
const SPARSE: usize = 16;
/// So many steps are looked at together.
const CHUNK: usize = 32;

/// Whether a path is remembered.
fn is_short(problem: &GridProblem, path: &[Cell]) -> bool {
    path.len() <= SHORT.max(problem.grid().layout().len() / SPARSE)
}

/// The sum of two cells' costs, on a map without terrain.
fn plainly(_: u32, _: u32) -> u64 {
    2
}

impl LastPath {
    /// Bytes held.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.path.capacity() * size_of::<Cell>()
    }

    /// Remembers what was answered, if it was proved, and short enough for the map.
    pub fn remember(&mut self, problem: &GridProblem, report: &Report<GridProblem>) {
        self.known = None;
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

    /// What has become of it now. If it is not told of a revision, it is gone at the next one.
    pub fn follow(&mut self, revision: &Revision<'_, GridProblem>) -> Hold {
        match self.hold(revision) {
            Some(true) if self.is_best => Hold::Best,
            Some(true) => Hold::Legal,
            Some(false) => Hold::Broken,
            None => Hold::Gone,
        }
    }

    /// Whether it holds, if its tail does.
    fn hold(&mut self, revision: &Revision<'_, GridProblem>) -> Option<bool> {
        let changes = revision.since(self.known.take())?;
        let problem = revision.problem();
        let grid = problem.grid();
        let mut blocked: Option<Window> = None;
        for change in changes {
            match change {
                GridChange::StartMoved(_) => {}
                GridChange::GoalMoved(goal) if Some(goal) == self.path.last() => {}
                GridChange::Blocked(cells) => {
                    for cell in cells {
                        Window::hold(&mut blocked, (cell.x, cell.y));
                    }
                }
                GridChange::Freed(_) => self.is_best = false,
                GridChange::GoalMoved(_) | GridChange::CostChanged(..) => return None,
            }
        }
        let left = &self.path[self.at..];
        let gone = left.iter().position(|&cell| cell == problem.start())?;
        let steps = Steps::of(problem);
        let (walked, _) = steps.cost(&left[..=gone], |from, to| grid.sum_of_costs(from, to));
        let left = &left[gone..];
        let mut broken: Option<[usize; 2]> = None;
        let mut at = 0;
        while let (Some(blocked), Some(&cell)) = (blocked, left.get(at)) {
            // A step brings a path no more than a cell nearer.
            let away = blocked.away(cell);
            if away > CHUNK {
                at += away - 1;
                continue;
            }
            let cells = &left[at..left.len().min(at + CHUNK + 1)];
            if blocked.touches(cells) {
                for (at, pair) in (at..).zip(cells.windows(2)) {
                    if !steps.is_legal(pair[0], pair[1]) {
                        broken = Some([broken.map_or(at, |[first, _]| first), at]);
                    }
                }
            }
            at += CHUNK;
        }
        if !grid.is_free(problem.start()) || !grid.is_free(problem.goal()) {
            return None;
        }
        let mut gone = self.at + gone;
        let mut holds = true;
        if let Some(broken) = broken {
            // What is dear may have been blocked meanwhile, or freed.
            if !self.is_plain || !grid.is_uniform() {
                return None;
            }
            let left = &mut self.path[gone..];
            holds = bend(&steps, left, broken);
            if !holds {
                // Behind the last step into what is blocked, and out of it.
                let behind = broken[1] + 1;
                let behind = behind + usize::from(!grid.is_free(left[behind]));
                let (lost, _) = steps.cost(&left[..=behind], plainly);
                self.take_off(lost);
                gone += behind;
            }
        }
        self.take_off(walked);
        self.at = gone;
        self.known = holds.then(|| problem.stamp());
        Some(holds)
    }

    fn take_off(&mut self, walked: GridCost) {
        self.cost.straight -= walked.straight;
        self.cost.diagonal -= walked.diagonal;
    }

    /// What is left of it costs so much, if it holds.
    #[must_use]
    pub fn cost(&self) -> GridCost {
        self.cost
    }

    /// What is left behind the break of what was found broken last; `None` beyond [`Word::LIMIT`].
    #[must_use]
    pub fn tail<'p, W: Word>(&'p self, problem: &'p GridProblem) -> Option<Tail<'p, W>> {
        Tail::of(problem, &self.path[self.at..], self.cost)
    }

    /// Answers with a way to a place of its tail and what is left from there, if that is legal, as what is
    /// best.
    pub fn rejoin(
        &mut self,
        problem: &GridProblem,
        way: &[Cell],
        place: usize,
        cx: &mut Context<'_, GridProblem>,
    ) -> Option<Report<GridProblem>> {
        let steps = Steps::of(problem);
        let behind = self.at + place;
        let first = *way.first()?;
        let (more, is_legal) = steps.cost(way, plainly);
        let leads = first == problem.start() && way.last() == self.path.get(behind);
        if !is_legal || !leads || !problem.grid().is_free(first) {
            return None;
        }
        self.take_off(steps.cost(&self.path[self.at..=behind], plainly).0);
        self.cost = self.cost + more;
        self.path.reserve_exact(way.len());
        self.path.splice(..=behind, way.iter().copied());
        (self.at, self.is_best) = (0, true);
        let best = Solved {
            solution: self.path.clone(),
            cost: self.cost,
        };
        debug_assert_eq!(problem.judge(&best.solution), Ok(best.cost));
        self.known = is_short(problem, &self.path).then(|| problem.stamp());
        cx.improved(|| best.clone());
        Some(cx.report(Outcome::Optimal(best)))
    }

    /// What is left of it, if it holds.
    #[must_use]
    pub fn left(&self) -> Option<Solved<GridProblem>> {
        self.known.map(|_| Solved {
            solution: self.path[self.at..].to_vec(),
            cost: self.cost,
        })
    }

    /// Answers with what is left of it, if it holds, as what is best. The note `replanned` says `kept`.
    pub fn keep(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Option<Report<GridProblem>> {
        let best = self.left()?;
        debug_assert_eq!(problem.judge(&best.solution), Ok(best.cost));
        self.is_best = true;
        cx.note("replanned", "kept");
        cx.improved(|| best.clone());
        Some(cx.report(Outcome::Optimal(best)))
    }

    /// Follows a revision, and answers if what is left is still best and the budget allows an iteration.
    pub fn answer(
        &mut self,
        revision: &Revision<'_, GridProblem>,
        cx: &mut Context<'_, GridProblem>,
    ) -> Option<Report<GridProblem>> {
        let is_best = self.follow(revision) == Hold::Best && cx.proceed();
        is_best.then(|| self.keep(revision.problem(), cx))?
    }
}
