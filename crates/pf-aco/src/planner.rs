//! The Ant System and ACO*, as planners.

use crate::{AcoParams, AcoStarParams, trails::Trails};
use pf_core::{
    Claims, Context, InvalidParams, Planner, Problem, Replanner, Report, Revision, Stamp,
    Unsupported,
};
use pf_grid::{GridProblem, Swarm};

/// Ants, their trails, and what they last answered.
#[derive(Clone, Debug)]
struct Colony {
    trails: Trails,
    swarm: Swarm,
    /// What the trails are up to.
    known: Option<Stamp>,
}

impl Colony {
    fn new(params: AcoParams, alpha: f64) -> Self {
        Self {
            trails: Trails::new(params, alpha),
            swarm: Swarm::default(),
            known: None,
        }
    }

    fn plan(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Report<GridProblem> {
        self.trails.begin(problem);
        self.swarm.forget();
        self.search(problem, cx)
    }

    fn replan(
        &mut self,
        revision: &Revision<'_, GridProblem>,
        cx: &mut Context<'_, GridProblem>,
    ) -> Report<GridProblem> {
        let problem = revision.problem();
        let Some(changes) = revision.since(self.known) else {
            return self.plan(problem, cx);
        };
        self.trails.follow(problem, changes);
        self.swarm.keep_if_valid(problem);
        self.search(problem, cx)
    }

    fn search(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Report<GridProblem> {
        let rules = self.trails.params().rules();
        let report = self.swarm.search(&mut self.trails, problem, &rules, cx);
        self.known = Some(problem.stamp());
        report
    }
}

macro_rules! ants {
    ($(#[$doc:meta])* $planner:ident, $params:ident, $name:literal) => {
        $(#[$doc])*
        #[derive(Clone, Debug)]
        pub struct $planner {
            params: $params,
            colony: Colony,
        }

        impl $planner {
            /// What it was made with.
            #[must_use]
            pub fn params(&self) -> &$params {
                &self.params
            }
        }

        impl Planner<GridProblem> for $planner {
            fn name(&self) -> &'static str {
                $name
            }

            fn claims(&self) -> Claims {
                Claims::NONE.anytime().deterministic()
            }

            fn plan(
                &mut self,
                problem: &GridProblem,
                cx: &mut Context<'_, GridProblem>,
            ) -> Result<Report<GridProblem>, Unsupported> {
                Ok(self.colony.plan(problem, cx))
            }
        }

        impl Replanner<GridProblem> for $planner {
            fn replan(
                &mut self,
                revision: &Revision<'_, GridProblem>,
                cx: &mut Context<'_, GridProblem>,
            ) -> Result<Report<GridProblem>, Unsupported> {
                Ok(self.colony.replan(revision, cx))
            }
        }
    };
}

ants! {
    /// The Ant System: an ant steps by the pheromone on its edges (eq. 7), every ant that arrives
    /// deposits Q / length on the edges of its walk (eq. 8), and a share of all evaporates (eq. 9).
    ///
    /// One iteration is one walk of every ant; the best path seen is the answer,
    /// with its loops cut out. After a change the trails are kept: edges of new obstacles go, those
    /// of freed cells come with tau0.
    ///
    /// Sources: Dorigo, Maniezzo, Colorni, *Ant System: Optimization by a Colony of Cooperating
    /// Agents*, 1996; Redlarski, Dabkowski, Palkowski, *Generating optimal paths in dynamic
    /// environments using River Formation Dynamics algorithm*.
    Aco, AcoParams, "ACO"
}

ants! {
    /// An [`Aco`] in which a neighbour's weight is its edge's pheromone by d^alpha, d being its
    /// straight distance to the goal. An ant beside the goal steps onto it.
    ///
    /// Source: Redlarski, Dabkowski, Palkowski, *Generating optimal paths in dynamic environments
    /// using River Formation Dynamics algorithm*.
    AcoStar, AcoStarParams, "ACO*"
}

impl Aco {
    /// Ants that do as `params` say.
    ///
    /// # Errors
    /// [`InvalidParams`] with the first parameter that is out of its range.
    pub fn new(params: AcoParams) -> Result<Self, InvalidParams> {
        params.check()?;
        let colony = Colony::new(params.clone(), 0.0);
        Ok(Self { params, colony })
    }
}

impl AcoStar {
    /// Ants that do as `params` say.
    ///
    /// # Errors
    /// [`InvalidParams`] with the first parameter that is out of its range.
    pub fn new(params: AcoStarParams) -> Result<Self, InvalidParams> {
        let alpha = params.alpha;
        InvalidParams::unless(
            "alpha",
            alpha,
            (0.0..=64.0).contains(&alpha),
            "a number from 0 to 64",
        )?;
        params.common().check()?;
        let colony = Colony::new(params.common(), alpha);
        Ok(Self { params, colony })
    }
}

impl Default for Aco {
    fn default() -> Self {
        let params = AcoParams::default();
        let colony = Colony::new(params.clone(), 0.0);
        Self { params, colony }
    }
}

impl Default for AcoStar {
    fn default() -> Self {
        let params = AcoStarParams::default();
        let colony = Colony::new(params.common(), params.alpha);
        Self { params, colony }
    }
}
