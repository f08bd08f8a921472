#![doc = include_str!("../README.md")]

mod banded;
mod class;
mod exact;
mod hinge;
mod memory;
mod newton;
mod params;
mod potential;
mod published;
mod quadratic;
mod solid;
mod study;

pub use params::{LbfgsParams, Obstacles, Rules};
pub use published::Descended;
pub use study::{PaperLoss, plain};

use exact::Exact;
use pf_core::{
    Claims, Context, InvalidParams, Planner, Problem, Proof, Replanner, Report, Revision, Stamp,
    Unsupported,
};
use pf_geom::{Rectangle, Shape, WorldProblem};
use potential::Potential;
use published::{Descent, points};

/// Plans smooth paths by minimising a loss over waypoints; see the [crate's page](crate).
#[derive(Clone, Debug, Default)]
pub struct Lbfgs {
    params: LbfgsParams,
    potential: Potential,
    filled: Option<Stamp>,
    descent: Descent,
    exact: Exact,
    descended: Option<Descended>,
    /// What was answered last.
    known: Option<Stamp>,
}

impl Lbfgs {
    /// A planner that plans as `params` say.
    ///
    /// # Errors
    /// [`InvalidParams`] with the name, the value and what would fit.
    pub fn new(params: LbfgsParams) -> Result<Self, InvalidParams> {
        params.check()?;
        Ok(Self {
            params,
            ..Self::default()
        })
    }

    /// How the last descent by published rules ended.
    #[must_use]
    pub fn descended(&self) -> Option<Descended> {
        self.descended
    }

    /// Makes the potential that of the problem's rectangles.
    fn fill(&mut self, problem: &WorldProblem) -> Result<(), Unsupported> {
        let wanted =
            self.params.rules != Rules::Exact || self.params.obstacles == Obstacles::Potential;
        let stamp = Some(problem.world().stamp());
        if !wanted || self.filled == stamp {
            return Ok(());
        }
        let mut others = problem.world().shapes();
        if others.any(|(_, shape)| !matches!(shape, Shape::Rectangle(_))) {
            let reason = "the paper's potential is defined for rectangles only";
            return Err(Unsupported::new(self.name(), reason));
        }
        self.potential.fill(rectangles(problem), self.params.margin);
        self.filled = stamp;
        Ok(())
    }

    /// Answers by the published rules, from the path that the descent holds.
    fn published(
        &mut self,
        problem: &WorldProblem,
        cx: &mut Context<'_, WorldProblem>,
    ) -> Report<WorldProblem> {
        self.descended = Some(self.descent.run(&self.potential, &self.params, cx));
        let path = points(&self.descent.path).collect();
        cx.answer(problem, path, Proof::None)
    }
}

fn rectangles(problem: &WorldProblem) -> impl Iterator<Item = &Rectangle> {
    problem
        .world()
        .shapes()
        .filter_map(|(_, shape)| match shape {
            Shape::Rectangle(rectangle) => Some(rectangle),
            _ => None,
        })
}

impl Planner<WorldProblem> for Lbfgs {
    fn name(&self) -> &'static str {
        "L-BFGS"
    }

    fn claims(&self) -> Claims {
        match self.params.rules {
            Rules::Exact => Claims::NONE.complete().deterministic(),
            Rules::Paper | Rules::PublishedCode => Claims::NONE.deterministic(),
        }
    }

    fn plan(
        &mut self,
        problem: &WorldProblem,
        cx: &mut Context<'_, WorldProblem>,
    ) -> Result<Report<WorldProblem>, Unsupported> {
        self.known = None;
        self.fill(problem)?;
        self.known = Some(problem.stamp());
        if self.params.rules == Rules::Exact {
            self.exact.forget();
            return Ok(self.exact.plan(problem, &self.params, &self.potential, cx));
        }
        self.descent
            .straight(problem.start(), problem.goal(), self.params.points);
        self.descent.reset_lambda(&self.params);
        Ok(self.published(problem, cx))
    }
}

/// Starts from the last path, if nothing happened in between.
impl Replanner<WorldProblem> for Lbfgs {
    fn replan(
        &mut self,
        revision: &Revision<'_, WorldProblem>,
        cx: &mut Context<'_, WorldProblem>,
    ) -> Result<Report<WorldProblem>, Unsupported> {
        let problem = revision.problem();
        let Some(changes) = revision.since(self.known) else {
            return self.plan(problem, cx);
        };
        self.known = None;
        self.fill(problem)?;
        self.known = Some(problem.stamp());
        if self.params.rules == Rules::Exact {
            let (params, potential) = (&self.params, &self.potential);
            return Ok(self
                .exact
                .replan(problem, params, potential, changes.is_empty(), cx));
        }
        self.descent.move_ends(problem.start(), problem.goal());
        if self.params.rules == Rules::Paper {
            self.descent.reset_lambda(&self.params);
        }
        Ok(self.published(problem, cx))
    }
}
