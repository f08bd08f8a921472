//! A bed, its drops, and what they last answered.

use crate::bed::{Bed, Rules};
use pf_core::{Context, Problem, Report, Revision, Stamp};
use pf_grid::{GridProblem, Swarm};

#[derive(Clone, Debug)]
pub(crate) struct River {
    bed: Bed,
    swarm: Swarm,
    /// What the bed is up to.
    known: Option<Stamp>,
}

impl River {
    pub(crate) fn new(rules: Rules) -> Self {
        Self {
            bed: Bed::new(rules),
            swarm: Swarm::default(),
            known: None,
        }
    }

    pub(crate) fn plan(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Report<GridProblem> {
        self.bed.begin(problem);
        self.swarm.forget();
        self.search(problem, cx)
    }

    pub(crate) fn replan(
        &mut self,
        revision: &Revision<'_, GridProblem>,
        cx: &mut Context<'_, GridProblem>,
    ) -> Report<GridProblem> {
        let problem = revision.problem();
        let Some(changes) = revision.since(self.known) else {
            return self.plan(problem, cx);
        };
        self.bed.follow(problem, changes);
        self.swarm.keep_if_valid(problem);
        self.search(problem, cx)
    }

    fn search(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Report<GridProblem> {
        let rules = self.bed.rules().swarm;
        let report = self.swarm.search(&mut self.bed, problem, &rules, cx);
        self.known = Some(problem.stamp());
        report
    }
}
