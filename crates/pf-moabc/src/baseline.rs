//! x
use pf_core::Context;
use pf_geom::{TeamPlan, TeamProblem};
pub(crate) const NAME: &str = "prioritised planning with safe intervals";
#[derive(Debug)]
pub(crate) enum Verdict {
    Plan(TeamPlan),
    Nothing(usize),
    Failed,
}
pub(crate) fn plan(_: &TeamProblem, _: &mut Context<'_, TeamProblem>) -> Verdict {
    Verdict::Failed
}
