//! Planners that break one law each, to prove that every law bites.
//!
//! Each is [`Honest`] but for one sin. The test of this crate shows that the kit finds exactly that
//! sin in it, and none in the honest one. The laws are the same for all problems; [`world_rogues`]
//! have the sins that grids do not know, [`team_rogues`] those of several robots.

mod honest;
mod planners;
mod replanners;
mod teams;
mod worlds;

pub use honest::Honest;
pub use teams::{TeamHonest, TeamRogue, team_rogues};
pub use worlds::{WorldHonest, WorldRogue, world_rogues};

use crate::{Options, Verdict, examine, examine_replanner, grid::Grids};
use pf_core::{
    Claims, Context, Outcome, Planner, Replanner, Report, Revision, Solved, Stamp, Unsupported,
};
use pf_grid::GridProblem;
use std::sync::atomic::{AtomicU32, Ordering};

type Cx<'a> = Context<'a, GridProblem>;
type Answer = Result<Report<GridProblem>, Unsupported>;
type Plan = fn(&mut Mind, &GridProblem, &mut Cx<'_>) -> Answer;
type Replan = fn(&mut Mind, &Revision<'_, GridProblem>, &mut Cx<'_>) -> Answer;

/// A planner that breaks one law.
#[derive(Clone, Copy, Debug)]
pub struct Rogue {
    /// The law it breaks.
    pub law: &'static str,
    /// What it does.
    pub sin: &'static str,
    claims: Claims,
    plan: Plan,
    /// If it replans.
    replan: Option<Replan>,
    settle: fn(&mut Mind, &GridProblem, &mut Cx<'_>),
}

/// Every rogue; every law has one.
#[must_use]
pub fn rogues() -> Vec<Rogue> {
    [planners::ROGUES, replanners::ROGUES].concat()
}

impl Rogue {
    fn born(self) -> Sinner {
        static BORN: AtomicU32 = AtomicU32::new(0);
        let born = BORN.fetch_add(1, Ordering::Relaxed);
        Sinner {
            rogue: self,
            mind: Mind {
                born,
                ..Mind::default()
            },
        }
    }

    /// What the laws say of it, on a small suite from a committed seed.
    #[must_use]
    pub fn examine(self) -> Vec<Verdict> {
        let options = Options {
            cases: 30,
            largest: 4096,
            ..Options::default()
        };
        if self.replan.is_some() {
            examine_replanner(&Grids, &options, &|| Box::new(self.born()))
        } else {
            examine(&Grids, &options, &|| Box::new(self.born()))
        }
    }
}

/// What a rogue remembers.
#[derive(Debug, Default)]
struct Mind {
    honest: Honest,
    /// How many rogues there were before.
    born: u32,
    /// How many replans it has seen.
    replans: u32,
    /// Every problem it has seen.
    seen: Vec<Stamp>,
    /// What it takes for certain from now on.
    given_up: bool,
}

struct Sinner {
    rogue: Rogue,
    mind: Mind,
}

impl Planner<GridProblem> for Sinner {
    fn name(&self) -> &str {
        self.rogue.sin
    }
    fn claims(&self) -> Claims {
        self.rogue.claims
    }
    fn plan(&mut self, problem: &GridProblem, cx: &mut Cx<'_>) -> Answer {
        (self.rogue.plan)(&mut self.mind, problem, cx)
    }
}

impl Replanner<GridProblem> for Sinner {
    fn replan(&mut self, revision: &Revision<'_, GridProblem>, cx: &mut Cx<'_>) -> Answer {
        match self.rogue.replan {
            Some(replan) => replan(&mut self.mind, revision, cx),
            None => self.plan(revision.problem(), cx),
        }
    }
    fn settle(&mut self, problem: &GridProblem, cx: &mut Cx<'_>) {
        (self.rogue.settle)(&mut self.mind, problem, cx);
    }
}

/// Announces and reports a solution as it is, right or wrong.
fn state(cx: &mut Cx<'_>, optimal: bool, solved: Solved<GridProblem>) -> Report<GridProblem> {
    cx.improved(|| solved.clone());
    cx.report(if optimal && !cx.stopped() {
        Outcome::Optimal(solved)
    } else {
        Outcome::Feasible(solved)
    })
}
