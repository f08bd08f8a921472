//! One answer, held against its problem and the truth: what every law comes down to.

use crate::{run::Run, suite::Truth};
use pf_core::{Claims, Cost, Outcome, Problem, Solved, Stop};

/// Whether a law holds, and if not, how it was broken.
pub(crate) type Finding = Result<(), String>;

pub(crate) fn ensure(holds: bool, how: impl FnOnce() -> String) -> Finding {
    if holds { Ok(()) } else { Err(how()) }
}

/// What was answered, and what could be known.
pub(crate) struct Answer<'a, P: Problem> {
    pub(crate) problem: &'a P,
    pub(crate) truth: &'a Truth<P::Cost>,
    pub(crate) run: &'a Run<P>,
}

impl<'a, P: Problem> Answer<'a, P> {
    fn solved(&self) -> Option<&'a Solved<P>> {
        self.run.report.outcome.solved()
    }

    fn finished(&self) -> bool {
        self.run.report.stop == Stop::Finished
    }

    /// What the judge says the reported solution costs. A proof is about the solution, not about
    /// the cost stated for it: that has a law of its own.
    pub(crate) fn judged(&self) -> Option<P::Cost> {
        self.problem.judge(&self.solved()?.solution).ok()
    }

    /// All solutions, announced or reported, and what to call each.
    fn solutions(&self) -> impl Iterator<Item = (&'static str, &'a Solved<P>)> {
        let announced = self.run.improved.iter().map(|s| ("an announced", s));
        announced.chain(self.solved().map(|s| ("the reported", s)))
    }

    pub(crate) fn sound(&self) -> Finding {
        for (what, solved) in self.solutions() {
            self.problem
                .judge(&solved.solution)
                .map_err(|violation| format!("{what} solution {violation}"))?;
        }
        Ok(())
    }

    pub(crate) fn honest_cost(&self) -> Finding {
        for (what, Solved { solution, cost }) in self.solutions() {
            if let Ok(judged) = self.problem.judge(solution) {
                ensure(judged.same_as(cost), || {
                    format!("{what} solution is said to cost {cost:?} and costs {judged:?}")
                })?;
            }
        }
        Ok(())
    }

    pub(crate) fn honest_proof(&self) -> Finding {
        let word = self.run.report.outcome.word();
        let stop = self.run.report.stop.word();
        match (&self.run.report.outcome, self.truth) {
            (Outcome::Feasible(_) | Outcome::Unknown { .. }, _) => return Ok(()),
            (Outcome::Infeasible, Truth::Optimum(_) | Truth::Between(..) | Truth::Solvable) => {
                return Err("called infeasible, and there is a solution".into());
            }
            (Outcome::Optimal(_), Truth::Optimum(best) | Truth::Between(_, best)) => {
                if let Some(cost) = self.judged() {
                    ensure(cost.no_worse_than(best), || {
                        format!("called optimal at {cost:?}, and {best:?} is possible")
                    })?;
                }
            }
            _ => {}
        }
        ensure(self.finished(), || {
            format!("called {word}, although cut short ({stop})")
        })
    }

    pub(crate) fn complete(&self) -> Finding {
        let unknown = matches!(self.run.report.outcome, Outcome::Unknown { .. });
        ensure(!(unknown && self.finished()), || {
            "answers unknown with budget to spare".into()
        })
    }

    pub(crate) fn optimal(&self) -> Finding {
        if !self.finished() {
            return Ok(());
        }
        let feasible = matches!(self.run.report.outcome, Outcome::Feasible(_));
        ensure(!feasible, || "has a solution, but no proof of it".into())?;
        match (self.judged(), self.truth) {
            (Some(cost), Truth::Optimum(best)) => ensure(cost.same_as(best), || {
                format!("costs {cost:?}, and {best:?} is the best")
            }),
            (Some(cost), Truth::Between(least, most)) => {
                let between = least.no_worse_than(&cost) && cost.no_worse_than(most);
                ensure(between, || {
                    format!("costs {cost:?}, and the best from {least:?} to {most:?}")
                })
            }
            _ => Ok(()),
        }
    }

    /// Obeys its problem and states nothing false.
    pub(crate) fn honest(&self) -> Finding {
        self.sound()?;
        self.honest_cost()?;
        self.honest_proof()
    }

    /// As good as a planner with these claims promises.
    pub(crate) fn as_claimed(&self, claims: Claims) -> Finding {
        if claims.complete {
            self.complete()?;
        }
        if claims.optimal {
            self.optimal()?;
        }
        Ok(())
    }
}
