#![doc = include_str!("../README.md")]

mod cost;
mod inside;
mod params;
mod swarm;

pub use params::{Penalty, PsoParams, Zones};

use cost::Danger;
use pf_core::{
    Claims, Context, InvalidParams, Outcome, Planner, Problem, Proof, Replanner, Report, Revision,
    Solved, Stamp, Unsupported,
};
use pf_geom::{Point, Segment, WorldProblem};
use swarm::{Swarm, Task};

/// A particle swarm over waypoints; see the [crate's page](crate).
#[derive(Clone, Debug, Default)]
pub struct Pso {
    params: PsoParams,
    danger: Danger,
    swarm: Swarm,
    /// What was answered last, and how.
    known: Option<Stamp>,
    last: Option<Vec<Point>>,
    ended: Option<Ended>,
}

/// How a swarm ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ended {
    /// The fitness of the best place of all: minus its length, minus its penalties (eq. 3).
    pub fitness: f64,
    /// In which iteration it was found.
    pub last_improved: u64,
}

impl Pso {
    /// A planner that plans as `params` say.
    ///
    /// # Errors
    /// [`InvalidParams`] with the name, the value and what would fit.
    pub fn new(params: PsoParams) -> Result<Self, InvalidParams> {
        params.check()?;
        Ok(Self {
            params,
            ..Self::default()
        })
    }

    /// How the last swarm ended; `None` if there was no need of one.
    #[must_use]
    pub fn ended(&self) -> Option<Ended> {
        self.ended
    }

    fn answer(
        &mut self,
        problem: &WorldProblem,
        cx: &mut Context<'_, WorldProblem>,
    ) -> Report<WorldProblem> {
        self.ended = None;
        self.last = None;
        self.known = None;
        if !cx.proceed() {
            return cx.report(Outcome::Unknown { attempt: None });
        }
        let (start, goal) = (problem.start(), problem.goal());
        if !problem.is_free(start, start) || !problem.is_free(goal, goal) {
            self.swarm.clear();
            return cx.report(Outcome::Infeasible);
        }
        self.danger.fill(problem, &self.params);
        let straight = Segment::new(start, goal);
        let harmless = self.danger.penalty(problem, &self.params, &straight) <= 0.0;
        let report = if harmless && problem.is_free(start, goal) {
            // Nothing is shorter, and nothing in the way.
            self.swarm.clear();
            cx.answer(problem, vec![start, goal], Proof::Optimal)
        } else {
            self.search(problem, cx)
        };
        self.last = report.outcome.solved().map(|best| best.solution.clone());
        if !cx.stopped() {
            self.known = Some(problem.stamp());
        }
        report
    }

    fn search(
        &mut self,
        problem: &WorldProblem,
        cx: &mut Context<'_, WorldProblem>,
    ) -> Report<WorldProblem> {
        let task = Task {
            problem,
            params: &self.params,
            danger: &self.danger,
        };
        if self.swarm.is_empty() {
            self.swarm.scatter(&task, cx);
        } else {
            self.swarm.stir(&task, cx);
        }
        // The last leader that the judge lets pass: one after it may be in less danger, and still
        // collide. It may also be longer than one before, which was in danger of the clearance.
        let mut passed: Option<Vec<Point>> = None;
        let mut shortest = f64::INFINITY;
        let mut ended = Ended {
            fitness: -self.swarm.leader_cost(),
            last_improved: 0,
        };
        let mut improved = true;
        let iterations = self.params.iterations;
        for iteration in 0..=iterations {
            if improved {
                let path = task.path(self.swarm.leader());
                if let Ok(cost) = problem.judge(&path) {
                    if cost < shortest {
                        shortest = cost;
                        let solution = &path;
                        cx.improved(|| Solved {
                            solution: solution.clone(),
                            cost,
                        });
                    }
                    passed = Some(path);
                }
                ended = Ended {
                    fitness: -self.swarm.leader_cost(),
                    last_improved: iteration,
                };
            }
            if iteration == iterations || !cx.proceed() {
                break;
            }
            let inertia = self.params.inertia(iteration);
            improved = self.swarm.fly(&task, inertia, cx);
        }
        self.ended = Some(ended);
        let path = passed.unwrap_or_else(|| task.path(self.swarm.leader()));
        cx.answer(problem, path, Proof::None)
    }
}

impl Planner<WorldProblem> for Pso {
    fn name(&self) -> &'static str {
        "PSO"
    }

    fn claims(&self) -> Claims {
        Claims::NONE.deterministic()
    }

    fn plan(
        &mut self,
        problem: &WorldProblem,
        cx: &mut Context<'_, WorldProblem>,
    ) -> Result<Report<WorldProblem>, Unsupported> {
        self.swarm.clear();
        Ok(self.answer(problem, cx))
    }
}

/// Keeps the swarm, if nothing happened in between; where nothing happened at all, the answer.
impl Replanner<WorldProblem> for Pso {
    fn replan(
        &mut self,
        revision: &Revision<'_, WorldProblem>,
        cx: &mut Context<'_, WorldProblem>,
    ) -> Result<Report<WorldProblem>, Unsupported> {
        let problem = revision.problem();
        let Some(changes) = revision.since(self.known) else {
            return self.plan(problem, cx);
        };
        if changes.is_empty()
            && let Some(path) = &self.last
        {
            if !cx.proceed() {
                return Ok(cx.report(Outcome::Unknown { attempt: None }));
            }
            cx.note("replanned", "kept");
            return Ok(cx.answer(problem, path.clone(), Proof::None));
        }
        let kept = !self.swarm.is_empty();
        cx.note("replanned", if kept { "repaired" } else { "afresh" });
        Ok(self.answer(problem, cx))
    }
}
