//! The laws of planning: what one case brings to light, and what the laws say to it.

use crate::{
    answer::{Answer, Finding, ensure},
    exam::Watch,
    run::{Run, Setting, TICK},
    suite::{Case, Options},
};
use pf_core::{Budget, CancelToken, Claims, Cost, Outcome, Planner, Problem, Solved, Stop};
use std::time::Duration;

/// After so many looks at the fake clock its time is up.
const TICKS: u32 = 20;

/// With fewer looks at states than this a run is over before anybody could stop it.
const WORTH_STOPPING: u64 = 256;

/// All that a planner did on one case.
pub(crate) struct Trial<'a, P: Problem> {
    case: &'a Case<P>,
    claims: Claims,
    limited: bool,
    // One planner, one call after the other.
    first: Run<P>,
    second: Run<P>,
    unheard: Run<P>,
    cut: Run<P>,
    after_cut: Run<P>,
    after_others: Run<P>,
    // A second planner.
    other: Run<P>,
    other_cut: Run<P>,
    // A new planner each.
    idle: Vec<(&'static str, Run<P>)>,
    one: Run<P>,
    ticked: Run<P>,
    cancelled: Option<Run<P>>,
}

impl<'a, P: Problem> Trial<'a, P> {
    /// Puts `case` to planners from `make`, with `others` in between. `None` if one declined or
    /// panicked.
    pub(crate) fn of(
        make: &dyn Fn() -> Box<dyn Planner<P>>,
        watch: &Watch,
        case: &'a Case<P>,
        others: &[P],
        options: &Options,
    ) -> Option<Self> {
        let plan = |live: &mut dyn Planner<P>, problem: &P, setting: &Setting| {
            watch.run(setting, |cx| live.plan(problem, cx))
        };
        let problem = &case.problem;
        let fresh = |setting: &Setting| plan(&mut *make(), problem, setting);
        let full = options
            .iterations
            .map_or_else(Setting::unlimited, Setting::iterations);

        let mut one = make();
        let first = plan(&mut *one, problem, &full)?;
        watch.saw(&first.report);
        let half = Setting::iterations(first.report.stats.iterations / 2);
        let second = plan(&mut *one, problem, &full)?;
        let unheard = Setting {
            heard: false,
            ..full.clone()
        };
        let unheard = plan(&mut *one, problem, &unheard)?;
        let cut = plan(&mut *one, problem, &half)?;
        let after_cut = plan(&mut *one, problem, &full)?;
        for problem in others {
            let _ = plan(&mut *one, problem, &full);
        }
        let after_others = plan(&mut *one, problem, &full)?;

        let mut two = make();
        let other = plan(&mut *two, problem, &full)?;
        let other_cut = plan(&mut *two, problem, &half)?;

        let idle = idle_budgets()
            .into_iter()
            .map(|(name, budget)| Some((name, fresh(&Setting::within(budget))?)));
        let cancel_at = (first.looks >= WORTH_STOPPING).then_some(first.looks / 4);
        let ticked = Setting {
            ticking: true,
            ..Setting::within(Budget::unlimited().time(TICK * TICKS))
        };
        Some(Self {
            case,
            claims: one.claims(),
            limited: options.iterations.is_some(),
            idle: idle.collect::<Option<_>>()?,
            one: fresh(&Setting::iterations(1))?,
            ticked: fresh(&ticked)?,
            cancelled: match cancel_at {
                Some(_) => Some(fresh(&Setting { cancel_at, ..full })?),
                None => None,
            },
            first,
            second,
            unheard,
            cut,
            after_cut,
            after_others,
            other,
            other_cut,
        })
    }

    fn answer<'b>(&'b self, run: &'b Run<P>) -> Answer<'b, P> {
        Answer {
            problem: &self.case.problem,
            truth: &self.case.truth,
            run,
        }
    }

    /// Every answer to the case, and the circumstances if they were special.
    fn answers(&self) -> impl Iterator<Item = (&'static str, Answer<'_, P>)> {
        let idle = self.idle.iter().map(|(name, run)| (*name, run));
        let cancelled = self.cancelled.iter().map(|run| ("cancelled, ", run));
        let runs = [
            ("", &self.first),
            ("asked again, ", &self.second),
            ("cut to half the iterations, ", &self.cut),
            ("after being cut short, ", &self.after_cut),
            ("after other problems, ", &self.after_others),
            ("cut to one iteration, ", &self.one),
            ("out of time, ", &self.ticked),
        ];
        let runs = runs.into_iter().chain(idle).chain(cancelled);
        runs.map(|(name, run)| (name, self.answer(run)))
    }

    fn every<'s>(&'s self, law: impl Fn(&Answer<'s, P>) -> Finding) -> Finding {
        for (when, answer) in self.answers() {
            law(&answer).map_err(|how| format!("{when}{how}"))?;
        }
        Ok(())
    }
}

fn idle_budgets() -> [(&'static str, Budget); 4] {
    let cancelled = CancelToken::default();
    cancelled.cancel();
    let budget = Budget::unlimited;
    [
        ("with no iterations, ", budget().iterations(0)),
        ("with no evaluations, ", budget().evaluations(0)),
        ("with no time, ", budget().time(Duration::ZERO)),
        ("cancelled beforehand, ", budget().cancel(&cancelled)),
    ]
}

pub(crate) fn sound<P: Problem>(trial: &Trial<'_, P>) -> Finding {
    trial.every(Answer::sound)
}

pub(crate) fn honest_cost<P: Problem>(trial: &Trial<'_, P>) -> Finding {
    trial.every(Answer::honest_cost)
}

pub(crate) fn honest_proof<P: Problem>(trial: &Trial<'_, P>) -> Finding {
    trial.every(Answer::honest_proof)
}

pub(crate) fn complete<P: Problem>(trial: &Trial<'_, P>) -> Finding {
    trial.answer(&trial.first).complete()
}

pub(crate) fn optimal<P: Problem>(trial: &Trial<'_, P>) -> Finding {
    trial.answer(&trial.first).optimal()
}

pub(crate) fn bounded<P: Problem>(trial: &Trial<'_, P>) -> Finding {
    for (when, run) in &trial.idle {
        no_work(run).map_err(|how| format!("{when}{how}"))?;
    }
    let stop = trial.first.report.stop;
    let cut = trial.limited && stop == Stop::Iterations;
    ensure(cut || stop == Stop::Finished, || {
        format!("says `{}`, and nobody stopped it", stop.word())
    })?;
    let needs = trial.first.report.stats.iterations;
    keeps_to(trial, &trial.cut, needs / 2, Stop::Iterations)?;
    keeps_to(trial, &trial.one, 1, Stop::Iterations)?;
    keeps_to(trial, &trial.ticked, u64::from(TICKS), Stop::Time)?;
    let (Some(run), all) = (&trial.cancelled, trial.first.looks) else {
        return Ok(());
    };
    let after = run.looks - all / 4;
    ensure(after <= all / 2, || {
        format!(
            "cancelled after {} of {all} states, it looked at {after} more",
            all / 4
        )
    })
}

pub(crate) fn no_work<P: Problem>(run: &Run<P>) -> Finding {
    let stats = &run.report.stats;
    let (i, e, v) = (stats.iterations, stats.expanded, stats.evaluated);
    ensure(i + e + v == 0, || {
        format!("it took {i} iterations, {e} expansions, {v} evaluations")
    })
}

/// A budget of `n` iterations, or of as many ticks of the clock, was kept, and was not hidden.
fn keeps_to<P: Problem>(trial: &Trial<'_, P>, run: &Run<P>, n: u64, stop: Stop) -> Finding {
    let took = run.report.stats.iterations;
    ensure(took <= n, || format!("with {n} iterations, it took {took}"))?;
    let needs = trial.first.report.stats.iterations;
    let short = trial.claims.deterministic && n < needs;
    ensure(!short || run.report.stop == stop, || {
        let said = run.report.stop.word();
        format!("with {n} of {needs} iterations, it stopped for `{said}`")
    })
}

pub(crate) fn anytime<P: Problem>(trial: &Trial<'_, P>) -> Finding {
    trial.every(|answer| {
        let improved = &answer.run.improved;
        for (i, pair) in improved.windows(2).enumerate() {
            let (before, after) = (&pair[0].cost, &pair[1].cost);
            ensure(after.no_worse_than(before), || {
                format!(
                    "announced {after:?} after {before:?} (improvement {})",
                    i + 1
                )
            })?;
        }
        let reported = answer.run.report.outcome.solved();
        match (improved.last(), reported) {
            (None, None) => Ok(()),
            (None, Some(_)) => Err("reported a solution that was never announced".into()),
            (Some(_), None) => Err("announced a solution, and reported none".into()),
            (Some(Solved { cost: last, .. }), Some(Solved { cost, .. })) => {
                let same = last.no_worse_than(cost) && cost.no_worse_than(last);
                ensure(same, || {
                    format!("announced {last:?} at last, and reported {cost:?}")
                })
            }
        }
    })
}

pub(crate) fn deterministic<P: Problem>(trial: &Trial<'_, P>) -> Finding {
    same(&trial.first, &trial.second).map_err(|how| format!("asked again, {how}"))?;
    same(&trial.first, &trial.other).map_err(|how| format!("another planner, {how}"))?;
    same(&trial.cut, &trial.other_cut)
        .map_err(|how| format!("another planner, both cut to half the iterations, {how}"))
}

pub(crate) fn reusable<P: Problem>(trial: &Trial<'_, P>) -> Finding {
    for (when, run) in [
        ("after being cut short", &trial.after_cut),
        ("after other problems", &trial.after_others),
    ] {
        let proven = |run: &Run<P>| {
            matches!(
                run.report.outcome,
                Outcome::Optimal(_) | Outcome::Infeasible
            )
        };
        if trial.claims.deterministic || proven(run) && proven(&trial.first) {
            agree(trial, run).map_err(|how| format!("{when}, {how}"))?;
        }
        if trial.claims.deterministic {
            same(&trial.first, run).map_err(|how| format!("{when}, {how}"))?;
        }
    }
    Ok(())
}

/// The same word, and a cost as good.
fn agree<P: Problem>(trial: &Trial<'_, P>, run: &Run<P>) -> Finding {
    let costs = (
        trial.answer(&trial.first).judged(),
        trial.answer(run).judged(),
    );
    let same_cost = match &costs {
        (Some(a), Some(b)) => a.same_as(b),
        (a, b) => a.is_some() == b.is_some(),
    };
    let same_word = trial.first.report.outcome.word() == run.report.outcome.word();
    ensure(same_cost && same_word, || {
        format!("answers {}, before: {}", run.words(), trial.first.words())
    })
}

pub(crate) fn silent<P: Problem>(trial: &Trial<'_, P>) -> Finding {
    let (heard, unheard) = (trial.second.fingerprint(), trial.unheard.fingerprint());
    ensure(heard == unheard, || {
        part("heard", &heard, "unheard", &unheard)
    })
}

/// The same report and the same trace.
pub(crate) fn same<P: Problem>(one: &Run<P>, two: &Run<P>) -> Finding {
    let (a, b) = (one.fingerprint(), two.fingerprint());
    ensure(a == b, || part("first", &a, "then", &b))?;
    one.trace.parts_from(&two.trace).map_or(Ok(()), Err)
}

/// Two texts that differ, shortened to where they do.
fn part(one: &str, a: &str, two: &str, b: &str) -> String {
    let begin = a
        .chars()
        .zip(b.chars())
        .take_while(|(a, b)| a == b)
        .count()
        .saturating_sub(40);
    let cut = |text: &str| text.chars().skip(begin).take(160).collect::<String>();
    format!("{one}: {}…, {two}: {}…", cut(a), cut(b))
}
