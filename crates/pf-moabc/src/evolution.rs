//! What the algorithms are to the outside: planners that keep their population.

use crate::{
    baseline::{self, Verdict},
    dice::Dice,
    encoding::Encoding,
    hive::Hive,
    params::{Common, PrioritisedParams},
};
use pf_core::{Context, Front, Outcome, Problem, Proof, Report, Revision, Stamp};
use pf_geom::{TeamChange, TeamProblem};
use rand::Rng;
use std::fmt::Debug;

type Cx<'a> = Context<'a, TeamProblem>;

/// What an algorithm does with its population.
pub(crate) trait Strategy: Clone + Debug {
    /// The name the literature uses.
    fn name(&self) -> &'static str;
    /// What it has in common with the others.
    fn common(&self) -> Common;
    /// How many rows it wants.
    fn size(&self) -> usize {
        self.common().population
    }
    /// Makes ready for the population in the nest.
    fn begin(&mut self, hive: &mut Hive);
    /// One cycle; the brood is empty.
    fn cycle(&mut self, hive: &mut Hive, problem: &TeamProblem, cx: &mut Cx<'_>);
}

/// An algorithm as a planner.
#[derive(Clone, Debug)]
pub(crate) struct Evolution<S> {
    strategy: S,
    hive: Hive,
    /// Of which problem the hive is.
    known: Option<Stamp>,
    /// Whether the hive has a population.
    settled: bool,
}

impl<S: Strategy> Evolution<S> {
    pub(crate) fn new(strategy: S) -> Self {
        Self {
            strategy,
            hive: Hive::default(),
            known: None,
            settled: false,
        }
    }

    pub(crate) fn name(&self) -> &'static str {
        self.strategy.name()
    }

    /// The answer where there is nothing to search for.
    fn refuse(&mut self, problem: &TeamProblem, cx: &mut Cx<'_>) -> Option<Report<TeamProblem>> {
        self.known = None;
        if !cx.proceed() {
            return Some(cx.report(Outcome::Unknown { attempt: None }));
        }
        let dead_end = problem.dead_end()?;
        self.settled = false;
        cx.note("dead end", dead_end.to_string());
        Some(cx.report(Outcome::Infeasible))
    }

    pub(crate) fn plan(&mut self, problem: &TeamProblem, cx: &mut Cx<'_>) -> Report<TeamProblem> {
        if let Some(report) = self.refuse(problem, cx) {
            return report;
        }
        let common = self.strategy.common();
        let seed = cx.rng().next_u64();
        self.hive
            .open(Encoding::of(problem, common.step), &common, seed);
        self.search(problem, cx)
    }

    pub(crate) fn replan(
        &mut self,
        revision: &Revision<'_, TeamProblem>,
        cx: &mut Cx<'_>,
    ) -> Report<TeamProblem> {
        let problem = revision.problem();
        let changes = revision.since(self.known).filter(|_| self.settled);
        let Some(changes) = changes else {
            return self.plan(problem, cx);
        };
        let known = self.known;
        if let Some(report) = self.refuse(problem, cx) {
            return report;
        }
        if changes.is_empty()
            && let Some(front) = self.hive.front(problem)
        {
            self.known = known;
            cx.note("replanned", "kept");
            return cx.answer(problem, front.solution, Proof::None);
        }
        cx.note(
            "replanned",
            "the population was kept, a fifth of it replaced",
        );
        self.take_over(problem, changes, cx);
        self.search(problem, cx)
    }

    /// Makes the population one of a changed problem: the better four fifths of it, some of the
    /// front, the rest new.
    fn take_over(&mut self, problem: &TeamProblem, changes: &[TeamChange], cx: &mut Cx<'_>) {
        let common = self.strategy.common();
        let (size, seed) = (self.strategy.size(), cx.rng().next_u64());
        let old = std::mem::take(&mut self.hive);
        let origin = origin(old.encoding.robots(), changes);
        let hive = &mut self.hive;
        hive.open(Encoding::of(problem, common.step), &common, seed);
        if let Some((plan, _)) = &old.baseline
            && let Ok(cost) = problem.judge_plan(plan)
        {
            hive.baseline = Some((plan.clone(), cost));
            hive.news = true;
        }
        let stride = old.archive.members().count().div_ceil(size).max(1);
        let front = old.archive.members().step_by(stride).map(|(_, row)| row);
        let nest = (0..old.nest.len() * 4 / 5).map(|i| old.nest.row(i));
        let rows: Vec<&[f64]> = nest.chain(front).collect();
        let (encoding, start) = (hive.encoding.clone(), common.start());
        hive.breed(
            problem,
            &common,
            cx,
            rows.len(),
            &|_, dice: Dice, number, row| {
                let rng = &mut dice.of(number);
                encoding.take_over(&old.encoding, &origin, rows[number], start, rng, row);
            },
        );
        hive.keep_best(size - size / 5);
        if let Some(dice) = &mut hive.dice {
            dice.cycle += 1;
        }
    }

    /// Evolves the population, filled up, until the budget or the number of evaluations ends it.
    fn search(&mut self, problem: &TeamProblem, cx: &mut Cx<'_>) -> Report<TeamProblem> {
        let common = self.strategy.common();
        let hive = &mut self.hive;
        self.settled = true;
        self.known = Some(problem.stamp());
        hive.settle(problem, &common, cx, self.strategy.size());
        hive.brood.clear(hive.nest.width);
        self.strategy.begin(hive);
        hive.announce(problem, cx);
        let (mut fruitless, mut asked) = (0, None);
        while hive.evaluated < common.evaluations && cx.proceed() {
            if let Some(dice) = &mut hive.dice {
                dice.cycle += 1;
            }
            hive.brood.clear(hive.nest.width);
            self.strategy.cycle(hive, problem, cx);
            hive.announce(problem, cx);
            cx.points("population", || {
                let rows = (0..hive.nest.len()).map(|i| hive.nest.row(i));
                rows.map(|row| hive.encoding.points(problem, row)).collect()
            });
            let found = !hive.archive.is_empty() || hive.baseline.is_some();
            fruitless = if found { 0 } else { fruitless + 1 };
            if fruitless == common.patience && asked.is_none() && common.patience > 0 {
                asked = Some(ask_baseline(hive, problem, cx));
                hive.announce(problem, cx);
            }
        }
        if hive.front(problem).is_none() && asked.is_none() {
            asked = Some(ask_baseline(hive, problem, cx));
            hive.announce(problem, cx);
        }
        if let Some(Verdict::Nothing(robot)) = asked {
            cx.note(
                "dead end",
                format_args!("robot {robot} has no path even alone"),
            );
            return cx.report(Outcome::Infeasible);
        }
        self.close(problem, cx)
    }

    /// Reports the front, or the nearest miss.
    fn close(&mut self, problem: &TeamProblem, cx: &mut Cx<'_>) -> Report<TeamProblem> {
        let hive = &self.hive;
        if let Some((_, [length, danger, turning])) = &hive.baseline {
            let own = hive.archive.members().count();
            cx.note(
                "baseline",
                format!(
                    "{}; evolution found {own} plans. the baseline's: length {:.3}, danger {:.3}, turning {:.3}",
                    baseline::NAME,
                    length, danger, turning
                ),
            );
        }
        let Some(front) = hive.front(problem) else {
            let nearest = (0..hive.nest.len()).min_by(|&a, &b| {
                hive.nest.marks[a]
                    .excess
                    .total_cmp(&hive.nest.marks[b].excess)
            });
            let attempt = nearest.map(|i| {
                let plan = hive.encoding.plan(problem, hive.nest.row(i));
                Front::unchecked(vec![plan])
            });
            return cx.report(Outcome::Unknown { attempt });
        };
        cx.answer(problem, front.solution, Proof::None)
    }
}

/// Asks the baseline for a plan, and puts it into the hive.
fn ask_baseline(hive: &mut Hive, problem: &TeamProblem, cx: &mut Cx<'_>) -> Verdict {
    let verdict = baseline::plan(problem, &PrioritisedParams::default(), cx);
    if let Verdict::Plan(plan) = &verdict
        && let Ok(cost) = problem.judge_plan(plan)
    {
        hive.baseline = Some((plan.clone(), cost));
        hive.news = true;
    }
    verdict
}

/// By robot: which it was before these changes.
fn origin(robots: usize, changes: &[TeamChange]) -> Vec<Option<usize>> {
    let mut origin: Vec<_> = (0..robots).map(Some).collect();
    for change in changes {
        match change {
            TeamChange::RobotAdded(_) => origin.push(None),
            TeamChange::RobotRemoved(robot) => {
                origin.remove(*robot);
            }
            _ => {}
        }
    }
    origin
}

/// A public planner around an algorithm.
macro_rules! evolution {
    ($(#[$doc:meta])* $name:ident, $strategy:ident, $params:ident) => {
        $(#[$doc])*
        #[derive(Clone, Debug)]
        pub struct $name($crate::evolution::Evolution<$strategy>);

        impl $name {
            /// A planner that plans as `params` say.
            ///
            /// # Errors
            /// [`InvalidParams`](pf_core::InvalidParams) with the name, the value and what would
            /// fit.
            pub fn new(params: $params) -> Result<Self, pf_core::InvalidParams> {
                params.check()?;
                Ok(Self($crate::evolution::Evolution::new($strategy::new(params))))
            }
        }

        impl Default for $name {
            fn default() -> Self {
                Self($crate::evolution::Evolution::new($strategy::new($params::default())))
            }
        }

        $crate::evolution::as_planner!($name);
    };
}

macro_rules! as_planner {
    ($name:ident) => {
        impl pf_core::Planner<pf_geom::TeamProblem> for $name {
            fn name(&self) -> &str {
                self.0.name()
            }
            fn claims(&self) -> pf_core::Claims {
                pf_core::Claims::NONE.anytime().deterministic()
            }
            fn plan(
                &mut self,
                problem: &pf_geom::TeamProblem,
                cx: &mut pf_core::Context<'_, pf_geom::TeamProblem>,
            ) -> Result<pf_core::Report<pf_geom::TeamProblem>, pf_core::Unsupported> {
                Ok(self.0.plan(problem, cx))
            }
        }

        /// Keeps the population, if nothing happened in between: it is evaluated anew and a fifth of
        /// it replaced. Where nothing happened at all, it keeps the answer.
        impl pf_core::Replanner<pf_geom::TeamProblem> for $name {
            fn replan(
                &mut self,
                revision: &pf_core::Revision<'_, pf_geom::TeamProblem>,
                cx: &mut pf_core::Context<'_, pf_geom::TeamProblem>,
            ) -> Result<pf_core::Report<pf_geom::TeamProblem>, pf_core::Unsupported> {
                Ok(self.0.replan(revision, cx))
            }
        }
    };
}

pub(crate) use {as_planner, evolution};
