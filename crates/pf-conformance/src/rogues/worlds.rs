//! Planners for worlds that break one law each, and the one they are but for that.

use crate::{
    Options, Verdict, examine, examine_replanner,
    world::{Found, Shortest, Worlds, oracle, search},
};
use pf_core::{
    Claims, Context, Outcome, Planner, Problem, Proof, Replanner, Report, Revision, Solved,
    Unsupported,
};
use pf_geom::{Point, Rectangle, Vector, World, WorldChange, WorldProblem};

type Cx<'a> = Context<'a, WorldProblem>;
type Answer = Result<Report<WorldProblem>, Unsupported>;
type Plan = fn(&mut WorldHonest, &WorldProblem, &mut Cx<'_>) -> Answer;
type Replan = fn(&mut WorldHonest, &Revision<'_, WorldProblem>, &mut Cx<'_>) -> Answer;

/// The [`oracle`] as a planner that keeps its last answer while the changes leave it the best.
///
/// It claims everything there is to claim, and breaks no law. One iteration settles one place.
#[derive(Clone, Debug, Default)]
pub struct WorldHonest {
    /// What was proven last, and of which problem.
    last: Option<(WorldProblem, Option<Vec<Point>>)>,
}

const ALL: Claims = Claims::NONE
    .complete()
    .optimal()
    .anytime()
    .deterministic()
    .incremental();

/// For those that may take back what they announced.
const MODEST: Claims = Claims::NONE.complete().optimal().deterministic();

impl WorldHonest {
    fn repeat(&self, problem: &WorldProblem, cx: &mut Cx<'_>) -> Report<WorldProblem> {
        match &self.last {
            Some((_, Some(path))) => cx.answer(problem, path.clone(), Proof::Optimal),
            Some((_, None)) => cx.report(Outcome::Infeasible),
            None => cx.report(Outcome::Unknown { attempt: None }),
        }
    }

    fn last_path(&self) -> Option<&Vec<Point>> {
        self.last.as_ref()?.1.as_ref()
    }

    /// Whether the last answer is still the best there is.
    fn still_best(&self, problem: &WorldProblem, changes: &[WorldChange]) -> bool {
        use WorldChange::{Added, GoalMoved, Moved, Removed, StartMoved};
        let Some((before, path)) = &self.last else {
            return false;
        };
        let cost = match path {
            None => f64::INFINITY,
            Some(path) => match problem.judge(path) {
                Ok(cost) => cost,
                Err(_) => return false,
            },
        };
        changes.iter().all(|change| match change {
            Added(_) => true,
            StartMoved(_) | GoalMoved(_) => false,
            // A path through where it was is longer. If it was not there, it is no obstacle less.
            Removed(id) | Moved(id, _) => before.world().shape(*id).is_none_or(|shape| {
                let (min, max) = shape.bounding_box();
                let middle = min + (max - min) / 2.0;
                let reach = (max - middle).norm() + problem.radius();
                let via = (middle - problem.start()).norm() + (problem.goal() - middle).norm();
                cost <= via - 2.0 * reach
            }),
        })
    }
}

impl Planner<WorldProblem> for WorldHonest {
    fn name(&self) -> &'static str {
        "honest"
    }

    fn claims(&self) -> Claims {
        ALL
    }

    fn plan(&mut self, problem: &WorldProblem, cx: &mut Cx<'_>) -> Answer {
        let found = search(problem, |place| {
            let goes_on = cx.proceed();
            if goes_on {
                cx.expanded(|| place);
            }
            goes_on
        });
        self.last = match found {
            Found::Path(shortest) => Some((problem.clone(), Some(shortest.path))),
            Found::Nothing => Some((problem.clone(), None)),
            Found::Stopped => None,
        };
        Ok(self.repeat(problem, cx))
    }
}

impl Replanner<WorldProblem> for WorldHonest {
    fn replan(&mut self, revision: &Revision<'_, WorldProblem>, cx: &mut Cx<'_>) -> Answer {
        let problem = revision.problem();
        let known = self.last.as_ref().map(|(problem, _)| problem.stamp());
        match revision.since(known) {
            Some(changes) if self.still_best(problem, changes) => {
                if let Some((before, _)) = &mut self.last {
                    *before = problem.clone();
                }
                Ok(self.repeat(problem, cx))
            }
            _ => self.plan(problem, cx),
        }
    }
}

/// A planner for worlds that breaks one law.
#[derive(Clone, Copy, Debug)]
pub struct WorldRogue {
    /// The law it breaks.
    pub law: &'static str,
    /// What it does.
    pub sin: &'static str,
    claims: Claims,
    plan: Plan,
    /// If it replans.
    replan: Option<Replan>,
}

struct Sinner {
    rogue: WorldRogue,
    honest: WorldHonest,
}

impl WorldRogue {
    const fn planner(law: &'static str, sin: &'static str, claims: Claims, plan: Plan) -> Self {
        Self {
            law,
            sin,
            claims,
            plan,
            replan: None,
        }
    }

    const fn replanner(law: &'static str, sin: &'static str, replan: Replan) -> Self {
        Self {
            law,
            sin,
            claims: ALL,
            plan: |honest, problem, cx| honest.plan(problem, cx),
            replan: Some(replan),
        }
    }

    /// What the laws say of it, on a small suite from a committed seed.
    #[must_use]
    pub fn examine(self) -> Vec<Verdict> {
        let options = Options {
            cases: 30,
            largest: 20,
            ..Options::default()
        };
        let born = || Sinner {
            rogue: self,
            honest: WorldHonest::default(),
        };
        if self.replan.is_some() {
            examine_replanner(&Worlds, &options, &|| Box::new(born()))
        } else {
            examine(&Worlds, &options, &|| Box::new(born()))
        }
    }
}

impl Planner<WorldProblem> for Sinner {
    fn name(&self) -> &str {
        self.rogue.sin
    }
    fn claims(&self) -> Claims {
        self.rogue.claims
    }
    fn plan(&mut self, problem: &WorldProblem, cx: &mut Cx<'_>) -> Answer {
        (self.rogue.plan)(&mut self.honest, problem, cx)
    }
}

impl Replanner<WorldProblem> for Sinner {
    fn replan(&mut self, revision: &Revision<'_, WorldProblem>, cx: &mut Cx<'_>) -> Answer {
        match self.rogue.replan {
            Some(replan) => replan(&mut self.honest, revision, cx),
            None => self.plan(revision.problem(), cx),
        }
    }
}

/// Every rogue for worlds: those whose sins grids do not know.
#[must_use]
pub fn world_rogues() -> Vec<WorldRogue> {
    const SOUND: &str = "sound";
    vec![
        WorldRogue::planner(SOUND, "cuts corners by 1e-6", ALL, |_, problem, cx| {
            Ok(for_another(problem, cx, |problem| {
                resized(problem, (problem.radius() - 1e-6).max(0.0))
            }))
        }),
        WorldRogue::planner(SOUND, "ignores the radius", ALL, |_, problem, cx| {
            Ok(for_another(problem, cx, |problem| resized(problem, 0.0)))
        }),
        WorldRogue::planner(SOUND, "leaves the bounds", ALL, |_, problem, cx| {
            Ok(for_another(problem, cx, unbounded))
        }),
        WorldRogue::planner(
            "honest cost",
            "states the arcs' length instead of the polyline's",
            ALL,
            |honest, problem, cx| {
                let report = honest.plan(problem, cx)?;
                Ok(match (report.outcome, oracle(problem)) {
                    (Outcome::Optimal(Solved { solution, .. }), Some(best)) => {
                        state(cx, true, solution, best.length)
                    }
                    (outcome, _) => cx.report(outcome),
                })
            },
        ),
        WorldRogue::planner(
            "honest proof",
            "calls closed what touches",
            MODEST,
            |honest, problem, cx| {
                let report = honest.plan(problem, cx)?;
                let closed = || {
                    let wider = resized(problem, problem.radius() + 1e-7);
                    wider.is_none_or(|wider| oracle(&wider).is_none())
                };
                Ok(match report.outcome {
                    Outcome::Optimal(_) if closed() => cx.report(Outcome::Infeasible),
                    outcome => cx.report(outcome),
                })
            },
        ),
        WorldRogue::replanner(
            "sound after changes",
            "drives where an obstacle moved to",
            |honest, revision, cx| {
                let moved = |change: &WorldChange| matches!(change, WorldChange::Moved(..));
                after(honest, revision, cx, moved, |path, problem| {
                    problem.judge(path).is_err()
                })
            },
        ),
        WorldRogue::replanner(
            "replan equals plan",
            "goes on round an obstacle that is gone",
            |honest, revision, cx| {
                let removed = |change: &WorldChange| matches!(change, WorldChange::Removed(_));
                after(honest, revision, cx, removed, |path, problem| {
                    problem.judge(path).is_ok()
                })
            },
        ),
    ]
}

/// The answer kept from before a change of some kind, if there still is one and the old one is
/// wanted; the honest one otherwise.
fn after(
    honest: &mut WorldHonest,
    revision: &Revision<'_, WorldProblem>,
    cx: &mut Cx<'_>,
    kind: fn(&WorldChange) -> bool,
    wanted: impl FnOnce(&Vec<Point>, &WorldProblem) -> bool,
) -> Answer {
    let problem = revision.problem();
    let known = honest.last.as_ref().map(|(problem, _)| problem.stamp());
    let of_kind = revision
        .since(known)
        .is_some_and(|all| all.iter().all(kind) && !all.is_empty());
    let old = honest.last_path().cloned();
    let report = honest.replan(revision, cx)?;
    Ok(match (report.outcome, old) {
        (Outcome::Optimal(best), Some(old)) if of_kind && wanted(&old, problem) => {
            let cost = problem.judge(&old).unwrap_or(best.cost);
            // A sound path is not called the best; one that is not has no cost to be wrong about.
            let optimal = problem.judge(&old).is_err();
            state(cx, optimal, old, cost)
        }
        (outcome, _) => cx.report(outcome),
    })
}

/// The answer to another problem, told as if it were one to this.
fn for_another(
    problem: &WorldProblem,
    cx: &mut Cx<'_>,
    change: impl FnOnce(&WorldProblem) -> Option<WorldProblem>,
) -> Report<WorldProblem> {
    let other = change(problem);
    let found = search(other.as_ref().unwrap_or(problem), |place| {
        let goes_on = cx.proceed();
        if goes_on {
            cx.expanded(|| place);
        }
        goes_on
    });
    match found {
        Found::Path(Shortest { length, path }) => {
            let cost = problem.judge(&path).unwrap_or(length);
            state(cx, true, path, cost)
        }
        Found::Nothing => cx.report(Outcome::Infeasible),
        Found::Stopped => cx.report(Outcome::Unknown { attempt: None }),
    }
}

/// Announces and reports a solution as it is, right or wrong.
fn state(cx: &mut Cx<'_>, optimal: bool, solution: Vec<Point>, cost: f64) -> Report<WorldProblem> {
    let solved = Solved { solution, cost };
    cx.improved(|| solved.clone());
    cx.report(if optimal && !cx.stopped() {
        Outcome::Optimal(solved)
    } else {
        Outcome::Feasible(solved)
    })
}

/// The same for a robot of another size.
fn resized(problem: &WorldProblem, radius: f64) -> Option<WorldProblem> {
    WorldProblem::new(
        problem.shared_world(),
        radius,
        problem.start(),
        problem.goal(),
    )
    .ok()
}

/// The same with bounds a unit farther out.
fn unbounded(problem: &WorldProblem) -> Option<WorldProblem> {
    let (bounds, unit) = (problem.world().bounds(), Vector::repeat(1.0));
    let wider = Rectangle::new(bounds.min() - unit, bounds.max() + unit).ok()?;
    let shapes = problem.world().shapes().map(|(_, shape)| shape.clone());
    let world = World::with_shapes(wider, shapes);
    WorldProblem::new(world, problem.radius(), problem.start(), problem.goal()).ok()
}
