use crate::{Faith, FromScene, Line, Scene};
use pf_core::{
    Budget, Claims, Context, InvalidProblem, Note, Outcome, Problem, Replanner, Report, Stats,
    Stop, Trace, Unsupported,
};
use pf_grid::GridChange;
use pf_render::Recorder;
use std::time::Duration;

/// Within what a planner is to answer, and who listens.
#[derive(Debug)]
pub struct Order<'a> {
    /// The seed.
    pub seed: u64,
    /// The budget.
    pub budget: Budget,
    /// What keeps the search for a picture.
    pub recorder: Option<&'a mut Recorder>,
}

impl Order<'_> {
    /// Without limits, unheard.
    #[must_use]
    pub fn seeded(seed: u64) -> Self {
        Self {
            seed,
            budget: Budget::unlimited(),
            recorder: None,
        }
    }
}

/// What a planner answered, whatever its problem.
#[derive(Clone, Debug)]
pub struct Answer {
    /// `optimal`, `feasible`, `infeasible` or `unknown`.
    pub outcome: &'static str,
    /// Why it is the last word.
    pub stop: Stop,
    /// What it took.
    pub stats: Stats,
    /// What else there is to say.
    pub notes: Vec<Note>,
    /// The cost of the solution, a number per objective; empty without a solution.
    pub costs: Vec<f64>,
    /// The solution, a line per robot or alternative; empty without a solution.
    pub lines: Vec<Line>,
    /// From the call to the answer, the change of the planner's own map included.
    pub latency: Duration,
}

/// What went wrong before a planner could answer.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Refusal {
    /// The question makes no sense.
    #[error(transparent)]
    Invalid(#[from] InvalidProblem),
    /// The planner is not defined for it.
    #[error(transparent)]
    Unsupported(#[from] Unsupported),
    /// There is nothing yet to plan anew.
    #[error("a scene must be planned before it can be planned anew")]
    NothingPlanned,
}

/// A planner that hides which problem it solves.
pub trait Runner {
    /// The name the literature uses.
    fn name(&self) -> &str;

    /// What it promises.
    fn claims(&self) -> Claims;

    /// Answers a scene from scratch.
    ///
    /// # Errors
    /// [`Refusal`] if the scene makes no sense to the planner.
    fn plan(&mut self, scene: &Scene, order: Order<'_>) -> Result<Answer, Refusal>;

    /// Answers the scene it was given last after these changes, as
    /// [`Scene::change`] returned them.
    ///
    /// # Errors
    /// [`Refusal`] if nothing was planned before, or as [`plan`](Self::plan).
    fn replan(&mut self, changes: &[GridChange], order: Order<'_>) -> Result<Answer, Refusal>;

    /// Does the upkeep that could wait until the answer was out; says how long it took.
    fn settle(&mut self, order: Order<'_>) -> Duration;
}

/// A planner on the problem `P`, and the problem as it knows it.
pub(crate) struct On<P: Problem> {
    planner: Box<dyn Replanner<P>>,
    posed: Option<(P, Faith)>,
}

impl<P: FromScene> On<P> {
    pub(crate) fn new(planner: Box<dyn Replanner<P>>) -> Self {
        Self {
            planner,
            posed: None,
        }
    }
}

fn context<P: Problem>(order: Order<'_>) -> Context<'_, P>
where
    Recorder: Trace<P>,
{
    let cx = Context::seeded(order.seed).within(order.budget);
    match order.recorder {
        Some(recorder) => cx.traced(recorder),
        None => cx,
    }
}

fn answer<P: FromScene>(problem: &P, faith: Faith, report: Report<P>, latency: Duration) -> Answer {
    let outcome = match faith {
        Faith::Exact => report.outcome,
        Faith::Converted => report.outcome.converted(),
    };
    let word = outcome.word();
    let (costs, lines) = match outcome {
        Outcome::Optimal(best) | Outcome::Feasible(best) => {
            (P::costs(&best.cost), problem.lines(&best.solution))
        }
        Outcome::Infeasible | Outcome::Unknown { .. } => (Vec::new(), Vec::new()),
    };
    Answer {
        outcome: word,
        stop: report.stop,
        stats: report.stats,
        notes: report.notes,
        costs,
        lines,
        latency,
    }
}

impl<P: FromScene> Runner for On<P>
where
    Recorder: Trace<P>,
{
    fn name(&self) -> &str {
        self.planner.name()
    }

    fn claims(&self) -> Claims {
        self.planner.claims()
    }

    fn plan(&mut self, scene: &Scene, order: Order<'_>) -> Result<Answer, Refusal> {
        let (problem, faith) = P::from_scene(scene)?;
        let mut cx = context(order);
        let report = self.planner.plan(&problem, &mut cx)?;
        let answer = answer(&problem, faith, report, cx.elapsed());
        self.posed = Some((problem, faith));
        Ok(answer)
    }

    fn replan(&mut self, changes: &[GridChange], order: Order<'_>) -> Result<Answer, Refusal> {
        let (problem, faith) = self.posed.as_mut().ok_or(Refusal::NothingPlanned)?;
        let changes = problem.changes(changes);
        let mut cx = context(order);
        let revision = problem.revise(&changes)?;
        let report = self.planner.replan(&revision, &mut cx)?;
        let latency = cx.elapsed();
        Ok(answer(problem, *faith, report, latency))
    }

    fn settle(&mut self, order: Order<'_>) -> Duration {
        let Some((problem, _)) = &self.posed else {
            return Duration::ZERO;
        };
        let mut cx = context(order);
        self.planner.settle(problem, &mut cx);
        cx.elapsed()
    }
}
