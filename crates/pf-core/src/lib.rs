//! The contract every planner keeps. Read this file and you know the workspace.
//!
//! ```text
//!   Problem ── judges ──▶ Solution, Cost           a question that can mark its own answers
//!      │ revise(changes)
//!      ▼
//!   Planner::plan(&problem, &mut cx)       ─┐
//!   Replanner::replan(&revision, &mut cx)  ─┼─▶ Report { outcome, stop, stats, notes }
//!   Rollout(LocalPlanner::step(&seen, …))  ─┘
//!      │ cx: seed, budget, trace
//!      ▼
//!   Trace ◀── Event                                drawing, progress, recording
//! ```
//!
//! Four words carry the design:
//!
//! * A [`Problem`] fixes what a solution *is* and what it costs, so every planner for one
//!   problem returns the same type and one judge marks them all.
//! * A [`Context`] is the only door to chance, time and the outside world: a planner reads no
//!   clock, no entropy and no file.
//! * An [`Outcome`] is an honest answer. "There is no path" is an answer, not an error.
//! * A planner's [`Claims`] are tested, one by one, by `pf-conformance`.
//!
//! # A planner in fifteen lines
//!
//! A robot on a line of cells may step left or right; some cells are blocked. The problem knows
//! how to mark an answer, the planner knows how to find one.
//!
//! ```
//! use pf_core::*;
//! # #[derive(Clone, Debug)]
//! # struct Line { blocked: Vec<bool>, start: usize, goal: usize, stamp: Stamp }
//! # impl Problem for Line {
//! #     type State = usize;
//! #     type Solution = Vec<usize>;
//! #     type Cost = f64;
//! #     type Change = usize;
//! #     fn judge(&self, path: &Vec<usize>) -> Result<f64, Violation> {
//! #         if path.first() != Some(&self.start) { return Err(Violation::WrongStart); }
//! #         if path.last() != Some(&self.goal) { return Err(Violation::WrongGoal); }
//! #         if let Some(at) = path.windows(2).position(|w| w[0].abs_diff(w[1]) != 1 || self.blocked[w[1]]) {
//! #             return Err(Violation::IllegalMove { at });
//! #         }
//! #         Ok((path.len() - 1) as f64)
//! #     }
//! #     fn apply(&mut self, cells: &[usize]) -> Result<(), InvalidProblem> {
//! #         for &cell in cells { self.blocked[cell] ^= true; }
//! #         self.stamp = Stamp::fresh();
//! #         Ok(())
//! #     }
//! #     fn stamp(&self) -> Stamp { self.stamp }
//! # }
//! struct March;
//!
//! impl Planner<Line> for March {
//!     fn name(&self) -> &str { "march" }
//!     fn claims(&self) -> Claims { Claims::NONE.complete().optimal().deterministic() }
//!     fn plan(&mut self, p: &Line, cx: &mut Context<'_, Line>) -> Result<Report<Line>, Unsupported> {
//!         let mut path = vec![p.start];
//!         while path[path.len() - 1] != p.goal && cx.proceed() {
//!             let here = path[path.len() - 1];
//!             let next = if p.goal > here { here + 1 } else { here - 1 };
//!             if p.blocked[next] { return Ok(cx.report(Outcome::Infeasible)); }
//!             cx.expanded(|| next);
//!             path.push(next);
//!         }
//!         Ok(cx.answer(p, path, Proof::Optimal))
//!     }
//! }
//!
//! let mut line = Line { blocked: vec![false; 9], start: 1, goal: 7, stamp: Stamp::fresh() };
//! let report = March.plan(&line, &mut Context::seeded(7)).unwrap();
//! assert!(matches!(report.outcome, Outcome::Optimal(ref s) if s.cost == 6.0));
//!
//! // Any planner replans; a good one does it faster than from scratch.
//! let revision = line.revise(&[4]).unwrap();
//! let report = FromScratch(March).replan(&revision, &mut Context::seeded(7)).unwrap();
//! assert!(matches!(report.outcome, Outcome::Infeasible));
//!
//! // Out of budget is honest too: nothing proven, nothing found.
//! let mut cx = Context::seeded(7).within(Budget::unlimited().iterations(2));
//! line.revise(&[4]).unwrap();
//! let report = March.plan(&line, &mut cx).unwrap();
//! assert!(matches!(report.outcome, Outcome::Unknown { .. }));
//! assert_eq!(report.stop, Stop::Iterations);
//! ```

/// The README's example: a problem, where the page above shows a planner.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod adapters;
mod claims;
mod clock;
mod context;
mod cost;
mod outcome;
mod params;
mod stamp;
mod text;

pub use adapters::{FromScratch, Rollout, Walk, Walked};
pub use claims::Claims;
pub use clock::Clock;
pub use context::{Budget, CancelToken, Context, PlanRng};
pub use cost::{Cost, Front};
pub use outcome::{
    InvalidProblem, Note, Outcome, Proof, Report, Solved, Stats, Stop, Unsupported, Violation,
};
pub use params::{InvalidParams, Key, Params};
pub use stamp::Stamp;
pub use text::Text;

use std::fmt::Debug;

/// A well-formed planning question that can mark its own answers.
///
/// A value of this type is valid by construction: constructors and [`apply`](Self::apply) reject
/// nonsense with [`InvalidProblem`], so no planner checks its input.
pub trait Problem: Clone + Debug {
    /// What a search looks at: a cell, a point, one position per robot.
    type State: Clone + Debug;
    /// What a planner hands back: a path, a polyline, a [`Front`] of team plans.
    type Solution: Clone + Debug;
    /// How good a solution is: a number, or a vector of objectives under dominance.
    type Cost: Cost;
    /// What may happen to the world between two questions.
    type Change: Clone + Debug;

    /// Marks a solution: its true cost, or the first rule it breaks.
    ///
    /// # Errors
    /// The [`Violation`] that makes `solution` unusable.
    fn judge(&self, solution: &Self::Solution) -> Result<Self::Cost, Violation>;

    /// Makes `changes` happen, in their order: all of them, or none.
    ///
    /// # Errors
    /// [`InvalidProblem`], with `self` left as it was, if a change makes no sense here.
    fn apply(&mut self, changes: &[Self::Change]) -> Result<(), InvalidProblem>;

    /// Names the present content: equal stamps, equal content. A clone keeps the stamp until it
    /// changes; [`apply`](Self::apply) takes a fresh one unless it had nothing to do.
    fn stamp(&self) -> Stamp;

    /// Applies `changes` and returns the proof of it that [`Replanner::replan`] asks for.
    ///
    /// # Errors
    /// As [`apply`](Self::apply).
    fn revise<'a>(
        &'a mut self,
        changes: &'a [Self::Change],
    ) -> Result<Revision<'a, Self>, InvalidProblem> {
        let before = self.stamp();
        self.apply(changes)?;
        Ok(Revision {
            problem: self,
            changes,
            before,
        })
    }
}

/// A problem together with the changes that led to it; only [`Problem::revise`] makes one.
#[derive(Debug)]
pub struct Revision<'a, P: Problem> {
    problem: &'a P,
    changes: &'a [P::Change],
    before: Stamp,
}

impl<'a, P: Problem> Revision<'a, P> {
    /// The problem as it is now.
    #[must_use]
    pub fn problem(&self) -> &'a P {
        self.problem
    }

    /// The changes since the planner's `known` state of the problem, oldest first; `None` if
    /// something else happened in between (a revision it never saw, another problem): then plan
    /// afresh, for repairing would answer a world that is not there.
    #[must_use]
    pub fn since(&self, known: Option<Stamp>) -> Option<&'a [P::Change]> {
        (known == Some(self.before)).then_some(self.changes)
    }
}

/// An algorithm that answers problems of type `P`.
///
/// See the [crate's page](crate) for one in fifteen lines.
pub trait Planner<P: Problem> {
    /// The name the literature uses, e.g. `"D* Lite"`.
    fn name(&self) -> &str;

    /// What this planner, configured as it is, promises. `pf-conformance` holds it to that.
    fn claims(&self) -> Claims;

    /// Answers `problem` from scratch, within the budget and seed of `cx`.
    ///
    /// # Errors
    /// [`Unsupported`] if the problem is outside what this algorithm is defined for.
    fn plan(&mut self, problem: &P, cx: &mut Context<'_, P>) -> Result<Report<P>, Unsupported>;
}

/// A planner that keeps what it learnt and repairs its answer when the world changes.
///
/// It must accept every change of `P`; where repair cannot help it may start over, and
/// [`Stats::expanded`] will show it. Any planner becomes one through [`FromScratch`].
pub trait Replanner<P: Problem>: Planner<P> {
    /// Answers the revised problem. A planner that claims to be optimal answers as a fresh
    /// [`plan`](Planner::plan) would; the others stay sound and honest.
    ///
    /// # Errors
    /// As [`plan`](Planner::plan).
    fn replan(
        &mut self,
        revision: &Revision<'_, P>,
        cx: &mut Context<'_, P>,
    ) -> Result<Report<P>, Unsupported>;

    /// Does the upkeep that could wait until the answer was out, within the budget of `cx`.
    ///
    /// Calling it is never required for a right answer, only for a fast next one. For a problem
    /// other than the one answered last it does nothing.
    fn settle(&mut self, problem: &P, cx: &mut Context<'_, P>) {
        let _ = (problem, cx);
    }
}

/// A problem that can be entered without a map, one sensor reading at a time.
pub trait Observable: Problem {
    /// What kind of sensor the robot carries: its range, its rays.
    type Sensor;
    /// What sensor and odometry tell the robot. Its buffers are kept from step to step.
    type Observation: Debug + Default;

    /// Where the robot stands before its first step.
    fn start(&self) -> Self::State;
    /// Whether the robot has arrived.
    fn arrived(&self, at: &Self::State) -> bool;
    /// Whether the world lets the robot move so.
    fn admits(&self, from: &Self::State, to: &Self::State) -> bool;
    /// Fills `seen` with what the robot perceives at `at`.
    fn observe(&self, at: &Self::State, sensor: &Self::Sensor, seen: &mut Self::Observation);
    /// The states visited, read as a solution.
    fn trail(&self, visited: Vec<Self::State>) -> Self::Solution;
}

/// An algorithm that decides one step at a time from what it senses.
///
/// It is never given the problem, so an unknown map is unknown by type. [`Walk`] drives one step
/// by step through a world that may change; [`Rollout`] walks to the end and thereby makes a
/// [`Planner`].
pub trait LocalPlanner<P: Observable> {
    /// The name the literature uses.
    fn name(&self) -> &str;
    /// The sensor it needs.
    fn sensor(&self) -> P::Sensor;
    /// Forgets the last walk.
    fn reset(&mut self);
    /// What to do next.
    fn step(&mut self, seen: &P::Observation, cx: &mut Context<'_, P>) -> Step<P::State>;
}

/// A local planner's decision.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step<S> {
    /// Move there.
    To(S),
    /// Wait; the step counts.
    Stay,
    /// There is no hope.
    GiveUp,
}

/// Something a planner may point out while it works.
#[non_exhaustive]
pub enum Event<'e, P: Problem> {
    /// A state was settled, sampled or visited.
    Expanded(&'e P::State),
    /// A complete attempt (an ant, a particle, a bee), feasible or not.
    Candidate(&'e P::Solution),
    /// A feasible solution better than every one before it.
    Improved(&'e Solved<P>),
    /// A number per state: altitude, pheromone, distance.
    Field {
        /// What the number means.
        name: &'static str,
        /// Reads it.
        value: &'e dyn Fn(&P::State) -> f64,
    },
    /// A set of states: particles, bees, a sensor window's corners.
    Points {
        /// What they are.
        name: &'static str,
        /// Where they are.
        at: &'e [P::State],
    },
}

impl<P: Problem> Debug for Event<'_, P> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Expanded(state) => f.debug_tuple("Expanded").field(state).finish(),
            Self::Candidate(solution) => f.debug_tuple("Candidate").field(solution).finish(),
            Self::Improved(best) => f.debug_tuple("Improved").field(best).finish(),
            Self::Field { name, .. } => f.debug_tuple("Field").field(name).finish(),
            Self::Points { name, at } => f.debug_tuple("Points").field(name).field(at).finish(),
        }
    }
}

/// A listener. Any `FnMut(&Event<P>)` is one.
pub trait Trace<P: Problem> {
    /// Receives one event.
    fn event(&mut self, event: &Event<'_, P>);

    /// Receives what planning has taken so far, right before each [`Event::Improved`].
    fn spent(&mut self, _stats: &Stats) {}
}

impl<P: Problem, F: FnMut(&Event<'_, P>)> Trace<P> for F {
    fn event(&mut self, event: &Event<'_, P>) {
        self(event);
    }
}

impl<P: Problem, T: Planner<P> + ?Sized> Planner<P> for Box<T> {
    fn name(&self) -> &str {
        (**self).name()
    }
    fn claims(&self) -> Claims {
        (**self).claims()
    }
    fn plan(&mut self, problem: &P, cx: &mut Context<'_, P>) -> Result<Report<P>, Unsupported> {
        (**self).plan(problem, cx)
    }
}

impl<P: Problem, T: Replanner<P> + ?Sized> Replanner<P> for Box<T> {
    fn replan(
        &mut self,
        revision: &Revision<'_, P>,
        cx: &mut Context<'_, P>,
    ) -> Result<Report<P>, Unsupported> {
        (**self).replan(revision, cx)
    }
    fn settle(&mut self, problem: &P, cx: &mut Context<'_, P>) {
        (**self).settle(problem, cx);
    }
}
