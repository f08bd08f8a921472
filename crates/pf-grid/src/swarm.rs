//! Walkers by chance, many at a time: what river drops and ants share.
//!
//! In each iteration every walker goes from the start, step by step, by what the [`Medium`] says;
//! then the medium learns from all their walks. Walkers do not see each other, so they may walk on
//! several threads; each has a generator of its own, made from the seed, the iteration and its
//! number, and the medium learns in the order of the numbers: the number of threads changes nothing.

mod chances;
mod unloop;
mod walk;

pub use chances::Chances;
pub use walk::{Draw, Ended, Visited, Walk};

use crate::{GridCost, GridProblem};
use pf_core::{Context, Outcome, Problem, Proof, Report, Solved};
use rand::Rng;
use unloop::{Unloop, cells, cost, walk_cost};
use walk::{Tour, Walkers};

/// What walkers walk by, and what they leave behind.
pub trait Medium: Sync {
    /// The direction of the next step from the cell with id `at`; none if there is no way on.
    fn next(&self, at: u32, draw: Draw, visited: &Visited) -> Option<u32>;

    /// Makes ready for an iteration, counted from 1.
    fn begin(&mut self, iteration: u64) {
        let _ = iteration;
    }

    /// Learns from the walks of an iteration. `best` is the cost of the best path so far.
    fn learn(&mut self, problem: &GridProblem, walks: &[Walk], best: Option<GridCost>);

    /// Shows itself to a listener.
    fn show(&self, problem: &GridProblem, cx: &mut Context<'_, GridProblem>);
}

/// How many walk, how far, and for how long.
#[derive(Clone, Copy, Debug)]
pub struct SwarmRules {
    /// Walkers an iteration.
    pub walkers: usize,
    /// Iterations at most.
    pub iterations: u64,
    /// Iterations without a better path after which to stop; 0 for never.
    pub patience: u64,
    /// Steps of a walk at most; 0 for as many as there are free cells.
    pub steps: usize,
    /// Threads.
    pub threads: usize,
    /// Whether walkers remember where they have been.
    pub remember: bool,
}

/// The walkers, their memory and the best path they found.
///
/// Buffers grow to the longest walk there was and are kept.
#[derive(Clone, Debug, Default)]
pub struct Swarm {
    walkers: Walkers,
    best: Vec<u32>,
    cost: Option<GridCost>,
    /// The least cost of a walk of this search, loops and all.
    walked: Option<GridCost>,
}

impl Swarm {
    /// Forgets the best path.
    pub fn forget(&mut self) {
        self.best.clear();
        self.cost = None;
    }

    /// Forgets the best path unless it is one of `problem` too.
    pub fn keep_if_valid(&mut self, problem: &GridProblem) {
        if self.cost.is_some() {
            let path = cells(problem.grid().layout(), &self.best);
            self.cost = problem.judge(&path).ok();
        }
    }

    /// Lets the walkers walk until they all take one path, the rules or the budget end it. One
    /// iteration is one walk of every walker, one evaluation one walk. The best path seen is the
    /// answer, with its loops cut out; nothing is proved but that a blocked end has no path. The
    /// note `walk` says what the cheapest walk cost with its loops.
    pub fn search(
        &mut self,
        medium: &mut impl Medium,
        problem: &GridProblem,
        rules: &SwarmRules,
        cx: &mut Context<'_, GridProblem>,
    ) -> Report<GridProblem> {
        let grid = problem.grid();
        if !grid.is_free(problem.start()) || !grid.is_free(problem.goal()) {
            return cx.report(Outcome::Infeasible);
        }
        let mut tour = Tour {
            walkers: rules.walkers,
            steps: match rules.steps {
                0 => grid.free_cells() as usize,
                steps => steps,
            },
            threads: rules.threads,
            remember: rules.remember,
            seed: cx.rng().next_u64(),
            iteration: 0,
        };
        self.walked = None;
        let mut since_better = 0;
        while tour.iteration < rules.iterations && cx.proceed() {
            if tour.iteration == 0 && self.cost.is_some() {
                self.announce(problem, cx);
            }
            tour.iteration += 1;
            since_better += 1;
            medium.begin(tour.iteration);
            let next = |at, draw, visited: &Visited| medium.next(at, draw, visited);
            self.walkers.walk(problem, &tour, &next);
            if self.look(problem, cx) {
                since_better = 0;
            }
            medium.learn(problem, &self.walkers.walks, self.cost);
            medium.show(problem, cx);
            if self.agree() || rules.patience > 0 && since_better >= rules.patience {
                break;
            }
        }
        if let Some(walked) = self.walked {
            cx.note("walk", walked.to_string());
        }
        if self.cost.is_none() {
            return cx.report(Outcome::Unknown { attempt: None });
        }
        let path = cells(grid.layout(), &self.best);
        cx.answer(problem, path, Proof::None)
    }

    /// Looks at every walk; says whether one was better than all before.
    fn look(&mut self, problem: &GridProblem, cx: &mut Context<'_, GridProblem>) -> bool {
        let grid = problem.grid();
        let layout = grid.layout();
        let start = layout.id(problem.start());
        let mut better = false;
        for walk in &self.walkers.walks {
            cx.visited(walk.steps().len() as u64);
            let arrived = walk.ended() == Ended::Arrived;
            if !arrived && !cx.listening() {
                cx.evaluated(1);
                continue;
            }
            let path = self.walkers.unloop.cut(layout, start, walk.steps());
            cx.candidate(|| cells(layout, path));
            if !arrived {
                continue;
            }
            let cost = cost(grid, path);
            let walked = walk_cost(grid, start, walk.steps());
            self.walked = Some(self.walked.map_or(walked, |least| least.min(walked)));
            if self.cost.is_none_or(|best| cost < best) {
                self.best.clear();
                self.best.extend_from_slice(path);
                self.cost = Some(cost);
                better = true;
                cx.improved(|| Solved {
                    solution: cells(layout, path),
                    cost,
                });
            }
        }
        better
    }

    fn announce(&self, problem: &GridProblem, cx: &mut Context<'_, GridProblem>) {
        if let Some(cost) = self.cost {
            cx.improved(|| Solved {
                solution: cells(problem.grid().layout(), &self.best),
                cost,
            });
        }
    }

    /// Whether all walkers arrived by one path.
    fn agree(&self) -> bool {
        let walks = &self.walkers.walks;
        let same = |walk: &Walk| walk.steps() == walks[0].steps();
        walks.iter().all(|walk| walk.ended() == Ended::Arrived) && walks.iter().all(same)
    }
}
