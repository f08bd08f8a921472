//! Planners for teams that break one law each, and the one they are but for that.

use crate::{
    Options, Verdict, examine, examine_replanner,
    team::{Teams, one_by_one},
};
use pf_core::{
    Claims, Context, Front, Outcome, Planner, Problem, Replanner, Report, Revision, Solved,
    Unsupported,
};
use pf_geom::{DANGER, Objectives, TeamPlan, TeamProblem, Vector};

type Cx<'a> = Context<'a, TeamProblem>;
type Answer = Result<Report<TeamProblem>, Unsupported>;
type Plan = fn(&TeamProblem, &mut Cx<'_>) -> Report<TeamProblem>;

/// All go straight, at once or one after the other, and both if neither is better: a front of one or
/// two plans, or none. One iteration looks at one of the two.
#[derive(Clone, Copy, Debug, Default)]
pub struct TeamHonest;

const CLAIMS: Claims = Claims::NONE.anytime().deterministic();

impl Planner<TeamProblem> for TeamHonest {
    fn name(&self) -> &'static str {
        "honest"
    }

    fn claims(&self) -> Claims {
        CLAIMS
    }

    fn plan(&mut self, problem: &TeamProblem, cx: &mut Cx<'_>) -> Answer {
        Ok(honest(problem, cx))
    }
}

impl Replanner<TeamProblem> for TeamHonest {
    fn replan(&mut self, revision: &Revision<'_, TeamProblem>, cx: &mut Cx<'_>) -> Answer {
        self.plan(revision.problem(), cx)
    }
}

fn honest(problem: &TeamProblem, cx: &mut Cx<'_>) -> Report<TeamProblem> {
    let straight = TeamPlan::at_top_speed(problem, []);
    let mut front: Front<(TeamPlan, Objectives)> = Front::default();
    for plan in [straight.clone(), one_by_one(&straight)] {
        if !cx.proceed() {
            break;
        }
        if problem.dead_end().is_some() {
            return cx.report(Outcome::Infeasible);
        }
        cx.candidate(|| Front::unchecked(vec![plan.clone()]));
        if let Ok(cost) = problem.judge_plan(&plan)
            && front.offer((plan, cost), |member| member.1)
        {
            cx.improved(|| solved(&front));
        }
    }
    if front.members().is_empty() {
        return cx.report(Outcome::Unknown { attempt: None });
    }
    cx.report(Outcome::Feasible(solved(&front)))
}

fn solved(front: &Front<(TeamPlan, Objectives)>) -> Solved<TeamProblem> {
    let (plans, costs) = front.members().iter().cloned().unzip();
    Solved {
        solution: Front::unchecked(plans),
        cost: Front::unchecked(costs),
    }
}

/// A planner for teams that breaks one law.
#[derive(Clone, Copy, Debug)]
pub struct TeamRogue {
    /// The law it breaks.
    pub law: &'static str,
    /// What it does.
    pub sin: &'static str,
    plan: Plan,
    /// Whether it answers a changed problem as it was.
    stale: bool,
}

struct Sinner {
    rogue: TeamRogue,
    last: Option<TeamProblem>,
}

impl TeamRogue {
    const fn planner(law: &'static str, sin: &'static str, plan: Plan) -> Self {
        Self {
            law,
            sin,
            plan,
            stale: false,
        }
    }

    /// What the laws say of it, on a small suite from a committed seed.
    #[must_use]
    pub fn examine(self) -> Vec<Verdict> {
        let options = Options {
            cases: 20,
            ..Options::default()
        };
        let born = || Sinner {
            rogue: self,
            last: None,
        };
        if self.stale {
            examine_replanner(&Teams, &options, &|| Box::new(born()))
        } else {
            examine(&Teams, &options, &|| Box::new(born()))
        }
    }
}

impl Planner<TeamProblem> for Sinner {
    fn name(&self) -> &str {
        self.rogue.sin
    }
    fn claims(&self) -> Claims {
        CLAIMS
    }
    fn plan(&mut self, problem: &TeamProblem, cx: &mut Cx<'_>) -> Answer {
        self.last = Some(problem.clone());
        Ok((self.rogue.plan)(problem, cx))
    }
}

impl Replanner<TeamProblem> for Sinner {
    /// Sees what happens to the obstacles, and not what happens to the team.
    fn replan(&mut self, revision: &Revision<'_, TeamProblem>, cx: &mut Cx<'_>) -> Answer {
        let problem = revision.problem();
        let before = self.last.replace(problem.clone());
        let known = before.as_ref().map(Problem::stamp);
        let grew = |before: &TeamProblem| before.robots().len() < problem.robots().len();
        match before.filter(|before| revision.since(known).is_some() && grew(before)) {
            Some(before) => Ok(honest(&before, cx)),
            None => self.plan(problem, cx),
        }
    }
}

/// The same with something done to a solution, announced and reported.
fn altered(
    problem: &TeamProblem,
    cx: &mut Cx<'_>,
    alter: impl Fn(&mut Solved<TeamProblem>),
) -> Report<TeamProblem> {
    let report = cx.child(|cx: &mut Cx<'_>| honest(problem, cx));
    let Outcome::Feasible(mut solved) = report.outcome else {
        return cx.report(report.outcome);
    };
    alter(&mut solved);
    cx.improved(|| solved.clone());
    cx.report(Outcome::Feasible(solved))
}

/// Every rogue for teams: those whose sins single robots do not know.
#[must_use]
pub fn team_rogues() -> Vec<TeamRogue> {
    let mut rogues = vec![
        TeamRogue::planner("sound", "lets robots meet in time", |problem, cx| {
            let deaf = problem.clone().with_timing(pf_geom::Timing::Ignored);
            let straight = TeamPlan::at_top_speed(problem, []);
            let meets = problem.dead_end().is_none() && problem.meeting(&straight).is_some();
            honest(if meets { &deaf } else { problem }, cx)
        }),
        TeamRogue::planner("sound", "drives faster than it can", |problem, cx| {
            altered(problem, cx, |solved| {
                let mut plans = solved.solution.members().to_vec();
                for p in plans
                    .iter_mut()
                    .flat_map(|plan| plan.paths.iter_mut().flatten())
                {
                    p.time *= 0.9;
                }
                solved.solution = Front::unchecked(plans);
            })
        }),
        TeamRogue::planner("sound", "reports a dominated plan", |problem, cx| {
            altered(problem, cx, |solved| {
                let mut plans = solved.solution.members().to_vec();
                let mut costs = solved.cost.members().to_vec();
                // There and back again before setting out.
                let mut worse = plans[0].clone();
                let robot = problem.robots()[0];
                let aside = robot.start + (robot.goal - robot.start) * 0.01;
                let detour = [aside, robot.start];
                let pause = (aside - robot.start).norm() / robot.speed;
                for (k, at) in (1u32..).zip(detour) {
                    let time = pause * f64::from(k);
                    let place = worse.paths[0].len().min(k as usize);
                    worse.paths[0].insert(place, pf_geom::TimedPoint { at, time });
                }
                for p in worse.paths[0].iter_mut().skip(3) {
                    p.time += 2.0 * pause;
                }
                let Ok(cost) = problem.judge_plan(&worse) else {
                    return;
                };
                plans.push(worse);
                costs.push(cost);
                solved.solution = Front::unchecked(plans);
                solved.cost = Front::unchecked(costs);
            })
        }),
        TeamRogue::planner("honest cost", "calls every plan safe", |problem, cx| {
            altered(problem, cx, |solved| {
                let mut costs = solved.cost.members().to_vec();
                for cost in &mut costs {
                    cost[DANGER] = 0.0;
                }
                solved.cost = Front::unchecked(costs);
            })
        }),
        TeamRogue::planner(
            "honest proof",
            "calls impossible what needs waiting",
            |problem, cx| {
                let straight = TeamPlan::at_top_speed(problem, []);
                if problem.meeting(&straight).is_some() && cx.proceed() {
                    return cx.report(Outcome::Infeasible);
                }
                honest(problem, cx)
            },
        ),
        TeamRogue::planner("anytime", "drops a plan it announced", |problem, cx| {
            let report = honest(problem, cx);
            let Outcome::Feasible(solved) = report.outcome else {
                return cx.report(report.outcome);
            };
            // A plan that is longer and safer counts for another: the ends of a front are its worth.
            let robot = problem.robots()[0];
            let way = robot.goal - robot.start;
            let aside = robot.start + way * 0.5 + Vector::new(-way.y, way.x) * 0.05;
            let straight = TeamPlan::at_top_speed(problem, [vec![aside]]);
            let plan = one_by_one(&straight);
            let Ok(cost) = problem.judge_plan(&plan) else {
                return cx.report(Outcome::Feasible(solved));
            };
            let last = Solved {
                solution: Front::unchecked(vec![plan]),
                cost: Front::unchecked(vec![cost]),
            };
            cx.improved(|| last.clone());
            cx.report(Outcome::Feasible(last))
        }),
        TeamRogue::planner("silent", "has more to say to a listener", |problem, cx| {
            if cx.listening() {
                cx.note("robots", problem.robots().len().to_string());
            }
            honest(problem, cx)
        }),
    ];
    rogues.push(TeamRogue {
        law: "sound after changes",
        sin: "forgets a robot that joined",
        plan: honest,
        stale: true,
    });
    rogues
}
