//! Who is compared, and how a run is measured.

use super::Trial;
use crate::PaperError;
use pf_core::{Budget, CancelToken, Clock, Context, Params, Planner};
use pf_geom::{Objectives, TeamPlan, TeamProblem};
use pf_moabc::{
    Moabc, MoabcParams, Moead, MoeadParams, Nsga2, Nsga2Params, RandomSearch, RandomSearchParams,
    indicators::hypervolume,
};

/// The reference point of the hypervolume, in scaled objectives; the box it spans is 1.
const REFERENCE: Objectives = [1.1; 3];

/// A planner with a set of parameters.
#[derive(Clone, Copy, Debug)]
pub struct Contender {
    /// By the name in the list of planners.
    pub planner: &'static str,
    /// The set of parameters.
    pub variant: &'static str,
    pub(super) make: fn() -> Result<Box<dyn Planner<TeamProblem>>, PaperError>,
}

/// A run and its front.
#[derive(Clone, Debug)]
pub(super) struct Run {
    pub(super) hypervolume: f64,
    pub(super) front: Vec<Objectives>,
    pub(super) plans: Vec<TeamPlan>,
    pub(super) seconds: f64,
}

fn broken(error: impl std::fmt::Display) -> PaperError {
    PaperError::Data(error.to_string())
}

/// The paper's step, and no limit but the budget.
fn fair<P: Params>(mut params: P) -> Result<P, PaperError> {
    for (key, value) in [("step", "7"), ("evaluations", "1000000000")] {
        params.set(key, value).map_err(broken)?;
    }
    Ok(params)
}

macro_rules! contender {
    ($planner:literal, $variant:literal, $kind:ident, $params:expr) => {
        Contender {
            planner: $planner,
            variant: $variant,
            make: || Ok(Box::new($kind::new(fair($params)?).map_err(broken)?)),
        }
    };
}

/// All of them, ours first. But for `mending` all move without knowing what the numbers mean; but for
/// `paper` and `classic` all begin with the same arcs.
#[must_use]
pub fn contenders() -> [Contender; 7] {
    [
        contender!("moabc", "default", Moabc, MoabcParams::default()),
        contender!("moabc", "mending", Moabc, MoabcParams::mending()),
        contender!(
            "moabc",
            "paper",
            Moabc,
            MoabcParams {
                fan: MoabcParams::default().fan,
                ..MoabcParams::paper()
            }
        ),
        contender!(
            "moabc",
            "classic",
            Moabc,
            MoabcParams {
                fan: MoabcParams::default().fan,
                ..MoabcParams::classic()
            }
        ),
        contender!("nsga2", "default", Nsga2, Nsga2Params::default()),
        contender!("moead", "default", Moead, MoeadParams::default()),
        contender!(
            "random-search",
            "default",
            RandomSearch,
            RandomSearchParams::default()
        ),
    ]
}

impl Contender {
    /// One run with so many evaluations.
    pub(super) fn run(
        &self,
        trial: &Trial,
        evaluations: u64,
        seed: u64,
        cancel: &CancelToken,
    ) -> Result<Run, PaperError> {
        let mut planner = (self.make)()?;
        let budget = Budget::unlimited().evaluations(evaluations).cancel(cancel);
        let clock = Clock::default();
        let began = clock.now();
        let report = planner.plan(&trial.problem, &mut Context::seeded(seed).within(budget));
        let seconds = clock.now().saturating_sub(began).as_secs_f64();
        let report = report.map_err(broken)?;
        if cancel.is_cancelled() {
            return Err(PaperError::Interrupted);
        }
        // What the baseline found is not evolution's merit.
        let solved = report
            .outcome
            .solved()
            .filter(|_| report.note("baseline").is_none());
        let front: Vec<_> = solved
            .map(|s| s.cost.members().to_vec())
            .unwrap_or_default();
        let scaled: Vec<_> = front.iter().map(|cost| trial.scaled(cost)).collect();
        let spanned: f64 = REFERENCE.iter().product();
        Ok(Run {
            hypervolume: hypervolume(&scaled, &REFERENCE) / spanned,
            plans: solved
                .map(|s| s.solution.members().to_vec())
                .unwrap_or_default(),
            front,
            seconds,
        })
    }
}
