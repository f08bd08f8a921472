//! From one role to another: any planner replans, any local planner plans.

use crate::{
    Claims, Context, LocalPlanner, Observable, Outcome, Planner, Problem, Proof, Replanner, Report,
    Revision, Step, Unsupported,
};

/// Makes any planner a replanner by planning again: the baseline and the oracle for real ones.
#[derive(Clone, Debug, Default)]
pub struct FromScratch<T>(pub T);

impl<P: Problem, T: Planner<P>> Planner<P> for FromScratch<T> {
    fn name(&self) -> &str {
        self.0.name()
    }
    fn claims(&self) -> Claims {
        self.0.claims()
    }
    fn plan(&mut self, problem: &P, cx: &mut Context<'_, P>) -> Result<Report<P>, Unsupported> {
        self.0.plan(problem, cx)
    }
}

impl<P: Problem, T: Planner<P>> Replanner<P> for FromScratch<T> {
    fn replan(
        &mut self,
        revision: &Revision<'_, P>,
        cx: &mut Context<'_, P>,
    ) -> Result<Report<P>, Unsupported> {
        self.plan(revision.problem(), cx)
    }
}

/// A walk, one step at a time, in a world that may change between two steps.
#[derive(Debug)]
pub struct Walk<'t, P: Observable, T: ?Sized> {
    planner: &'t mut T,
    seen: P::Observation,
    trail: Vec<P::State>,
}

/// How a step of a [`Walk`] ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Walked {
    /// Moved or waited; not there yet.
    On,
    /// The robot is there.
    Arrived,
    /// The world does not let the robot move as the planner decided.
    Refused,
    /// The planner gave up.
    GaveUp,
}

impl<'t, P: Observable, T: LocalPlanner<P> + ?Sized> Walk<'t, P, T> {
    /// Puts the robot at the start.
    pub fn begin(planner: &'t mut T, problem: &P) -> Self {
        planner.reset();
        Self {
            planner,
            seen: P::Observation::default(),
            trail: vec![problem.start()],
        }
    }

    /// One step in the world as it is now; the caller may change it before the next.
    pub fn step(&mut self, problem: &P, cx: &mut Context<'_, P>) -> Walked {
        let at = &self.trail[self.trail.len() - 1];
        if problem.arrived(at) {
            return Walked::Arrived;
        }
        problem.observe(at, &self.planner.sensor(), &mut self.seen);
        match self.planner.step(&self.seen, cx) {
            Step::GiveUp => Walked::GaveUp,
            Step::Stay => Walked::On,
            Step::To(next) if problem.admits(at, &next) => {
                cx.expanded(|| next.clone());
                self.trail.push(next);
                Walked::On
            }
            Step::To(_) => Walked::Refused,
        }
    }

    /// The states visited so far, the start first.
    #[must_use]
    pub fn trail(&self) -> &[P::State] {
        &self.trail
    }

    /// Ends the walk.
    #[must_use]
    pub fn into_trail(self) -> Vec<P::State> {
        self.trail
    }
}

/// Makes a local planner a planner by walking it through the world, one step an iteration.
#[derive(Clone, Debug, Default)]
pub struct Rollout<T>(pub T);

impl<P: Observable, T: LocalPlanner<P>> Planner<P> for Rollout<T> {
    fn name(&self) -> &str {
        self.0.name()
    }
    fn claims(&self) -> Claims {
        Claims::NONE.deterministic()
    }
    fn plan(&mut self, problem: &P, cx: &mut Context<'_, P>) -> Result<Report<P>, Unsupported> {
        let mut walk = Walk::begin(&mut self.0, problem);
        while cx.proceed() && walk.step(problem, cx) == Walked::On {}
        let arrived = walk.trail().last().is_some_and(|at| problem.arrived(at));
        let solution = problem.trail(walk.into_trail());
        if arrived {
            return Ok(cx.answer(problem, solution, Proof::None));
        }
        let attempt = Some(solution);
        Ok(cx.report(Outcome::Unknown { attempt }))
    }
}
