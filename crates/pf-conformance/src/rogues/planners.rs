//! Sins of planning.

use super::{Answer, Cx, Honest, Mind, Plan, Rogue, state};
use crate::grid::{Found, search};
use pf_core::{Claims, Outcome, Planner, Problem, Proof, Report, Solved, Stop, Unsupported};
use pf_grid::{Cell, GridCost, GridProblem};

const ALL: Claims = Honest::CLAIMS;
/// For those that must not promise the best.
const MODEST: Claims = Claims::NONE.complete().deterministic();

const fn rogue(law: &'static str, sin: &'static str, claims: Claims, plan: Plan) -> Rogue {
    Rogue {
        law,
        sin,
        claims,
        plan,
        replan: None,
        settle: |_, _, _| (),
    }
}

pub(super) const ROGUES: &[Rogue] = &[
    rogue("useful", "declines everything", ALL, |_, _, _| {
        Err(Unsupported::new("rogue", "it is too hard"))
    }),
    rogue(
        "calm",
        "panics where there is one cell",
        ALL,
        |mind, problem, cx| {
            assert!(
                problem.grid().width() * problem.grid().height() > 1,
                "no room"
            );
            mind.honest.plan(problem, cx)
        },
    ),
    rogue("sound", "leaps to the goal", ALL, |mind, problem, cx| {
        changed(mind, problem, cx, true, |solved| {
            let path = &mut solved.solution;
            if path.len() > 2 {
                path.drain(1..path.len() - 1);
            }
        })
    }),
    rogue(
        "sound",
        "announces a leap to the goal",
        ALL,
        |mind, problem, cx| {
            let report = mind.honest.plan(problem, cx)?;
            if let Some(Solved { solution, cost }) = report.outcome.solved() {
                let solution = [&solution[..1], &solution[solution.len() - 1..]].concat();
                cx.improved(|| Solved {
                    solution,
                    cost: *cost,
                });
            }
            Ok(report)
        },
    ),
    rogue(
        "honest cost",
        "states half the cost",
        ALL,
        |mind, problem, cx| {
            changed(mind, problem, cx, true, |solved| {
                solved.cost.straight /= 2;
                solved.cost.diagonal /= 2;
            })
        },
    ),
    rogue(
        "honest proof",
        "calls a detour optimal",
        MODEST,
        |mind, problem, cx| changed(mind, problem, cx, true, |solved| dither(problem, solved)),
    ),
    rogue(
        "honest proof",
        "calls infeasible what it had no time for",
        MODEST,
        |mind, problem, cx| {
            let report = mind.honest.plan(problem, cx)?;
            Ok(match report.outcome {
                Outcome::Unknown { .. } => cx.report(Outcome::Infeasible),
                _ => report,
            })
        },
    ),
    rogue(
        "bounded",
        "looks at the start before it asks",
        ALL,
        |mind, problem, cx| {
            cx.expanded(|| problem.start());
            mind.honest.plan(problem, cx)
        },
    ),
    rogue(
        "bounded",
        "asks once and never again",
        ALL,
        |_, problem, cx| {
            let mut asked = None;
            let found = search(problem, |cell| {
                let goes_on = *asked.get_or_insert_with(|| cx.proceed());
                if goes_on {
                    cx.expanded(|| cell);
                }
                goes_on
            });
            Ok(tell(problem, cx, found))
        },
    ),
    rogue(
        "bounded",
        "does not say what stopped it",
        ALL,
        |mind, problem, cx| {
            let report = mind.honest.plan(problem, cx)?;
            Ok(Report {
                stop: Stop::Finished,
                ..report
            })
        },
    ),
    rogue("counted", "never asks", ALL, |_, problem, cx| {
        let found = search(problem, |_| true);
        Ok(tell(problem, cx, found))
    }),
    rogue(
        "reusable",
        "is tired after another problem",
        MODEST,
        |mind, problem, cx| {
            let tired = mind.seen.iter().any(|&stamp| stamp != problem.stamp());
            mind.seen.push(problem.stamp());
            changed(mind, problem, cx, !tired, |solved| {
                if tired {
                    dither(problem, solved);
                }
            })
        },
    ),
    rogue(
        "reusable",
        "is tired after being cut short",
        MODEST,
        |mind, problem, cx| {
            let tired = mind.given_up;
            let report = changed(mind, problem, cx, !tired, |solved| {
                if tired {
                    dither(problem, solved);
                }
            });
            mind.given_up |= cx.stopped();
            report
        },
    ),
    rogue(
        "complete",
        "gives up far from home",
        MODEST.optimal(),
        |mind, problem, cx| {
            let report = mind.honest.plan(problem, cx)?;
            let far = GridCost::of_steps(8, 0);
            Ok(match report.outcome {
                Outcome::Optimal(ref solved) if solved.cost > far => Report {
                    outcome: Outcome::Unknown { attempt: None },
                    ..report
                },
                _ => report,
            })
        },
    ),
    rogue(
        "optimal",
        "does not trust itself",
        ALL,
        |mind, problem, cx| changed(mind, problem, cx, false, |_| ()),
    ),
    rogue(
        "anytime",
        "reports worse than it announced",
        MODEST.anytime(),
        |mind, problem, cx| changed(mind, problem, cx, false, |solved| dither(problem, solved)),
    ),
    rogue("anytime", "announces nothing", ALL, |_, problem, cx| {
        let found = search(problem, |_| cx.proceed());
        Ok(match found {
            Found::Path(ref path) if let Ok(cost) = problem.judge(path) => {
                let solution = path.clone();
                cx.report(Outcome::Optimal(Solved { solution, cost }))
            }
            found => tell(problem, cx, found),
        })
    }),
    rogue(
        "deterministic",
        "has a look of its own",
        ALL,
        |mind, problem, cx| {
            let born = mind.born;
            cx.points("first", || vec![Cell::new(born, 0)]);
            mind.honest.plan(problem, cx)
        },
    ),
    rogue(
        "silent",
        "counts only for an audience",
        ALL,
        |_, problem, cx| {
            let found = search(problem, |cell| {
                let goes_on = cx.proceed();
                if goes_on && cx.listening() {
                    cx.expanded(|| cell);
                }
                goes_on
            });
            Ok(tell(problem, cx, found))
        },
    ),
];

/// The honest answer, changed.
fn changed(
    mind: &mut Mind,
    problem: &GridProblem,
    cx: &mut Cx<'_>,
    optimal: bool,
    change: impl FnOnce(&mut Solved<GridProblem>),
) -> Answer {
    let report = mind.honest.plan(problem, cx)?;
    Ok(match report.outcome {
        Outcome::Optimal(mut solved) => {
            change(&mut solved);
            state(cx, optimal, solved)
        }
        _ => report,
    })
}

/// Takes the first step, goes back, and takes it again.
pub(super) fn dither(problem: &GridProblem, solved: &mut Solved<GridProblem>) {
    let path = &mut solved.solution;
    if path.len() > 1 {
        path.splice(1..1, [path[1], path[0]]);
        if let Ok(cost) = problem.judge(path) {
            solved.cost = cost;
        }
    }
}

fn tell(problem: &GridProblem, cx: &mut Cx<'_>, found: Found) -> Report<GridProblem> {
    match found {
        Found::Path(path) => cx.answer(problem, path, Proof::Optimal),
        Found::Nothing => cx.report(Outcome::Infeasible),
        Found::Stopped => cx.report(Outcome::Unknown { attempt: None }),
    }
}
