//! Sins of replanning.

use super::{Answer, Cx, Honest, Mind, Replan, Rogue, planners::dither, state};
use crate::grid::{Found, search};
use pf_core::{Claims, Outcome, Planner, Problem, Replanner, Report, Revision};
use pf_grid::{Cell, GridChange, GridProblem};

const ALL: Claims = Honest::CLAIMS;

const fn rogue(law: &'static str, sin: &'static str, claims: Claims, replan: Replan) -> Rogue {
    Rogue {
        law,
        sin,
        claims,
        plan: |mind, problem, cx| {
            mind.seen.push(problem.stamp());
            mind.given_up = false;
            mind.honest.plan(problem, cx)
        },
        replan: Some(replan),
        settle: |_, _, _| (),
    }
}

pub(super) const ROGUES: &[Rogue] = &[
    rogue(
        "replan equals plan",
        "makes do after terrain changes",
        ALL,
        |mind, revision, cx| {
            after_terrain(mind, revision, cx, |mut solved, cx| {
                dither(revision.problem(), &mut solved);
                state(cx, false, solved)
            })
        },
    ),
    rogue(
        "sound after changes",
        "leaps to the goal after terrain changes",
        ALL,
        |mind, revision, cx| {
            after_terrain(mind, revision, cx, |mut solved, cx| {
                let path = &mut solved.solution;
                path.drain(1..path.len() - 1);
                state(cx, true, solved)
            })
        },
    ),
    rogue(
        "blocked ends",
        "never hopes again for a goal once blocked",
        ALL,
        |mind, revision, cx| {
            let problem = revision.problem();
            mind.given_up |= !problem.grid().is_free(problem.goal());
            if mind.given_up {
                return Ok(cx.report(Outcome::Infeasible));
            }
            mind.honest.replan(revision, cx)
        },
    ),
    rogue(
        "long life",
        "stops looking after 200 batches",
        ALL,
        |mind, revision, cx| {
            mind.replans += 1;
            if mind.replans > 200 {
                return Ok(mind.honest.repeat(revision.problem(), cx));
            }
            mind.honest.replan(revision, cx)
        },
    ),
    rogue(
        "repeatable",
        "has a look of its own when it replans",
        ALL,
        |mind, revision, cx| {
            let born = mind.born;
            cx.points("first", || vec![Cell::new(born, 0)]);
            mind.honest.replan(revision, cx)
        },
    ),
    rogue(
        "empty revision",
        "works twice when nothing changed",
        ALL,
        |mind, revision, cx| {
            if revision.since(mind.honest.known) != Some(&[]) {
                return mind.honest.replan(revision, cx);
            }
            let report = mind.honest.plan(revision.problem(), cx)?;
            for _ in 0..report.stats.expanded {
                cx.expanded(|| revision.problem().start());
            }
            Ok(cx.report(report.outcome))
        },
    ),
    rogue(
        "empty revision",
        "forgets when nothing changed",
        Claims::NONE,
        |mind, revision, cx| {
            if revision.since(mind.honest.known) == Some(&[]) {
                return Ok(cx.report(Outcome::Unknown { attempt: None }));
            }
            mind.honest.replan(revision, cx)
        },
    ),
    rogue(
        "skipped revisions",
        "thinks that what it missed was nothing",
        ALL,
        |mind, revision, cx| {
            let before = |stamp| revision.since(Some(stamp)).is_some();
            let missed = !mind.seen.iter().copied().any(before);
            mind.seen.push(revision.problem().stamp());
            if missed {
                mind.honest.known = Some(revision.problem().stamp());
                return Ok(mind.honest.repeat(revision.problem(), cx));
            }
            mind.honest.replan(revision, cx)
        },
    ),
    rogue(
        "diverged clones",
        "takes what it repaired for what it planned",
        DIVERGES,
        |mind, revision, cx| {
            let known = mind.honest.known;
            let report = mind.honest.replan(revision, cx);
            if revision.since(known).is_some() {
                mind.honest.known = known;
            }
            report
        },
    ),
    rogue(
        "cut short",
        "thinks it is done when its budget is",
        ALL,
        |mind, revision, cx| {
            let last = mind.honest.last.clone();
            let report = mind.honest.replan(revision, cx);
            if cx.stopped() {
                mind.honest.last = last;
                mind.honest.known = Some(revision.problem().stamp());
            }
            report
        },
    ),
    rogue(
        "cut short",
        "calls it a day when its budget is",
        ALL,
        |mind, revision, cx| {
            let report = mind.honest.replan(revision, cx)?;
            Ok(match report.outcome {
                Outcome::Unknown { .. } => cx.report(Outcome::Infeasible),
                _ => report,
            })
        },
    ),
    Rogue {
        settle: |mind, problem, cx| match search(problem, |_| cx.proceed()) {
            Found::Path(path) => mind.honest.last = Some(super::honest::Last::Path(path)),
            Found::Nothing => mind.honest.last = Some(super::honest::Last::Nothing),
            Found::Stopped => {}
        },
        ..rogue(
            "settle harmless",
            "settles on another problem",
            ALL,
            |mind, revision, cx| mind.honest.replan(revision, cx),
        )
    },
    Rogue {
        settle: |_, _, cx| cx.evaluated(1),
        ..rogue(
            "settle harmless",
            "settles without asking",
            ALL,
            |mind, revision, cx| mind.honest.replan(revision, cx),
        )
    },
    rogue(
        "incremental",
        "starts over each time",
        ALL,
        |mind, revision, cx| mind.honest.plan(revision.problem(), cx),
    ),
];

/// Every other answer of this one starts over, so it saves nothing in the median.
const DIVERGES: Claims = Claims::NONE.complete().optimal().deterministic();

/// The honest answer, changed if terrain did and there is a way to go.
fn after_terrain(
    mind: &mut Mind,
    revision: &Revision<'_, GridProblem>,
    cx: &mut Cx<'_>,
    change: impl FnOnce(pf_core::Solved<GridProblem>, &mut Cx<'_>) -> Report<GridProblem>,
) -> Answer {
    let changes = revision.since(mind.honest.known).unwrap_or(&[]);
    let terrain = changes
        .iter()
        .any(|change| matches!(change, GridChange::CostChanged(..)));
    let report = mind.honest.replan(revision, cx)?;
    Ok(match report.outcome {
        Outcome::Optimal(solved) if terrain && solved.solution.len() > 2 => change(solved, cx),
        _ => report,
    })
}
