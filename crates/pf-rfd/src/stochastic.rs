//! RFD and RFD*, as planners.

use crate::{RfdParams, RfdStarParams, river::River};
use pf_core::{Claims, Context, InvalidParams, Planner, Replanner, Report, Revision, Unsupported};
use pf_grid::GridProblem;

macro_rules! river {
    ($(#[$doc:meta])* $planner:ident, $params:ident, $name:literal) => {
        $(#[$doc])*
        #[derive(Clone, Debug)]
        pub struct $planner {
            params: $params,
            river: River,
        }

        impl $planner {
            /// A river that does as `params` say.
            ///
            /// # Errors
            /// [`InvalidParams`] with the first parameter that is out of its range.
            pub fn new(params: $params) -> Result<Self, InvalidParams> {
                params.check()?;
                let river = River::new(params.bed());
                Ok(Self { params, river })
            }

            /// What it was made with.
            #[must_use]
            pub fn params(&self) -> &$params {
                &self.params
            }
        }

        impl Default for $planner {
            fn default() -> Self {
                let params = $params::default();
                let river = River::new(params.bed());
                Self { params, river }
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
                Ok(self.river.plan(problem, cx))
            }
        }

        impl Replanner<GridProblem> for $planner {
            fn replan(
                &mut self,
                revision: &Revision<'_, GridProblem>,
                cx: &mut Context<'_, GridProblem>,
            ) -> Result<Report<GridProblem>, Unsupported> {
                Ok(self.river.replan(revision, cx))
            }
        }
    };
}

river! {
    /// River Formation Dynamics: drops run from the start by the gradients of the bed (eq. 1-3),
    /// erode the way they took (eq. 4), and the whole bed rises by what was eroded (eq. 5).
    ///
    /// One iteration is one run of every drop; the best path seen is the answer, with its loops cut
    /// out. After a change the altitudes are kept: a freed cell gets the first altitude, an old goal
    /// the mean of its neighbours'.
    ///
    /// Sources: Rabanal, Rodriguez, Rubio, *Using River Formation Dynamics to Design Heuristic
    /// Algorithms*, 2007; Redlarski, Dabkowski, Palkowski, *Generating optimal paths in dynamic
    /// environments using River Formation Dynamics algorithm*.
    Rfd, RfdParams, "RFD"
}

river! {
    /// An [`Rfd`] whose drops choose by `p_base^gradient / d^alpha` (eq. 6), d being a neighbour's
    /// straight distance to the goal, and erode by the same exponential. A drop beside the goal
    /// steps onto it.
    ///
    /// Source: Redlarski, Dabkowski, Palkowski, *Generating optimal paths in dynamic environments
    /// using River Formation Dynamics algorithm*.
    RfdStar, RfdStarParams, "RFD*"
}
