//! The law book: one table, and nothing else decides what conformance means.

use crate::{
    answer::{Finding, ensure},
    stage::{self, Stage},
    suite::Plot,
    trial::{self, Trial},
};
use pf_core::{Claims, InvalidProblem, Problem, Stamp, Violation};

/// One law.
#[derive(Clone, Copy, Debug)]
pub struct Law {
    /// What to call it.
    pub name: &'static str,
    /// What it says, in one sentence.
    pub text: &'static str,
    /// Whom it binds.
    pub binds: Binds,
}

/// Whom a law binds.
#[derive(Clone, Copy, Debug)]
pub struct Binds {
    /// In words: `"planners that claim complete"`.
    pub whom: &'static str,
    /// Only those that replan.
    pub replanners: bool,
    /// Only those that claim this.
    claims: fn(Claims) -> bool,
}

impl Binds {
    /// Whether a planner with these claims is bound.
    #[must_use]
    pub fn holds_for(&self, claims: Claims, replanner: bool) -> bool {
        (self.claims)(claims) && (replanner || !self.replanners)
    }
}

const fn planners(whom: &'static str, claims: fn(Claims) -> bool) -> Binds {
    Binds {
        whom,
        replanners: false,
        claims,
    }
}

const fn replanners(whom: &'static str, claims: fn(Claims) -> bool) -> Binds {
    Binds {
        whom,
        replanners: true,
        claims,
    }
}

const EVERY: Binds = planners("every planner", |_| true);
const COMPLETE: Binds = planners("planners that claim complete", |c| c.complete);
const OPTIMAL: Binds = planners("planners that claim optimal", |c| c.optimal);
const ANYTIME: Binds = planners("planners that claim anytime", |c| c.anytime);
const SEEDED: Binds = planners("planners that claim deterministic", |c| c.deterministic);
const REPLANS: Binds = replanners("every replanner", |_| true);
const REPLANS_SEEDED: Binds =
    replanners("replanners that claim deterministic", |c| c.deterministic);
const REPLANS_WELL: Binds = replanners("replanners that claim complete or optimal", |c| {
    c.complete || c.optimal
});
const REPAIRS: Binds = replanners("replanners that claim incremental", |c| c.incremental);

/// How a law is checked.
pub(crate) enum Test<P: Problem> {
    /// Case by case.
    Case(fn(&Trial<'_, P>) -> Finding),
    /// Story by story.
    Story(Plot, fn(&Stage<'_, P>) -> Finding),
    /// Story by story, if all goes well when nothing special happens.
    Special(fn(&Stage<'_, P>) -> Finding),
    /// Whether a case or a story ended in a panic.
    Panic,
    /// Once, at the end.
    Whole(fn(&Sums) -> Finding),
}

/// What all cases and stories together showed.
#[derive(Debug, Default)]
pub(crate) struct Sums {
    /// How many cases there were, how many were answered, how many solved.
    pub(crate) cases: u64,
    pub(crate) answered: u64,
    pub(crate) solved: u64,
    /// How many iterations that took.
    pub(crate) iterations: u64,
    /// Expansions of a replan and of a plan from scratch, a pair for each small change.
    pub(crate) savings: Vec<(u64, u64)>,
}

/// A law with its test.
pub(crate) struct Rule<P: Problem> {
    pub(crate) law: Law,
    pub(crate) test: Test<P>,
}

/// Every law there is, in the order in which they are printed.
///
/// ```
/// use pf_conformance::laws;
/// use pf_core::Claims;
///
/// let binding = laws().into_iter().filter(|law| law.binds.holds_for(Claims::NONE, false));
/// assert!(binding.into_iter().any(|law| law.name == "sound"));
/// ```
#[must_use]
pub fn laws() -> Vec<Law> {
    book::<Nothing>().into_iter().map(|rule| rule.law).collect()
}

/// The law book.
#[rustfmt::skip]
pub(crate) fn book<P: Problem>() -> Vec<Rule<P>> {
    use Test::{Case, Panic, Special, Story, Whole};
    let rule = |name, text, binds, test| Rule { law: Law { name, text, binds }, test };
    vec![
        rule("useful", "It answers at least one of the problems it is shown.", EVERY, Whole(useful)),
        rule("calm", "No question makes it panic.", EVERY, Panic),
        rule("sound", "A solution, announced or reported, obeys its problem.", EVERY, Case(trial::sound)),
        rule("honest cost", "The cost it states for a solution is what the problem's judge says.", EVERY, Case(trial::honest_cost)),
        rule("honest proof", "What it calls optimal is, what it calls infeasible is, and neither was cut short.", EVERY, Case(trial::honest_proof)),
        rule("bounded", "On no budget it does no work; on some it does no more; it says what stopped it, and stops soon.", EVERY, Case(trial::bounded)),
        rule("counted", "It asks before every iteration: who solved anything has asked.", EVERY, Whole(counted)),
        rule("reusable", "What it was asked before, or was kept from finishing, does not show in its answer.", EVERY, Case(trial::reusable)),
        rule("complete", "With budget to spare it never answers unknown.", COMPLETE, Case(trial::complete)),
        rule("optimal", "With budget to spare its solution is the best there is, and it says so.", OPTIMAL, Case(trial::optimal)),
        rule("anytime", "Its announcements only get better, and it reports the last one, stopped or not.", ANYTIME, Case(trial::anytime)),
        rule("deterministic", "One seed and one budget in iterations give one report and one trace, whichever planner is asked.", SEEDED, Case(trial::deterministic)),
        rule("silent", "Being listened to changes nothing.", SEEDED, Case(trial::silent)),
        rule("replan equals plan", "After a change it answers as well as its claims say of planning from scratch.", REPLANS_WELL, Story(Plot::Mixed, stage::replan_equals_plan)),
        rule("sound after changes", "After a change its answer obeys the revised problem, and states nothing false of it.", REPLANS, Story(Plot::Mixed, stage::sound_after_changes)),
        rule("blocked ends", "It gets over start and goal being blocked, freed, or moved onto obstacles.", REPLANS, Story(Plot::Ends, stage::blocked_ends)),
        rule("long life", "Hundreds of batches on, its answers are as right as in the beginning.", REPLANS, Story(Plot::Long, stage::long_life)),
        rule("repeatable", "One story gives one series of reports and traces, whichever replanner is asked.", REPLANS_SEEDED, Story(Plot::Mixed, stage::repeatable)),
        rule("empty revision", "Where nothing changed its answer is no worse, and if it claims incremental it took no more than planning from scratch.", REPLANS, Special(stage::empty_revision)),
        rule("skipped revisions", "A revision it was never shown does not make it answer for a world of the past.", REPLANS, Special(stage::skipped_revisions)),
        rule("diverged clones", "What it saw happen to a clone it does not take for the original, nor the other way round.", REPLANS, Special(stage::diverged_clones)),
        rule("cut short", "A replan stopped by its budget is honest, and the next one is as right as ever.", REPLANS, Special(stage::cut_short)),
        rule("settle harmless", "Settling early, twice, on another problem or not at all changes no answer.", REPLANS, Special(stage::settle_harmless)),
        rule("incremental", "After a small change it expands less than from scratch, in the median.", REPAIRS, Whole(incremental)),
    ]
}

fn useful(sums: &Sums) -> Finding {
    ensure(sums.answered > 0 || sums.cases == 0, || {
        format!("it declined all {} cases", sums.cases)
    })
}

fn counted(sums: &Sums) -> Finding {
    ensure(sums.iterations > 0 || sums.solved == 0, || {
        format!(
            "it solved {} cases and never called `cx.proceed()`",
            sums.solved
        )
    })
}

fn incremental(sums: &Sums) -> Finding {
    // Where planning from scratch expands nothing there is nothing to save.
    let mut shares: Vec<_> = sums.savings.iter().filter(|(_, plan)| *plan > 0).collect();
    // By replan / plan, without a division.
    shares.sort_by_key(|(replan, plan)| replan * 1_000_000 / plan);
    let Some((replan, plan)) = shares.get(shares.len() / 2) else {
        return Ok(());
    };
    ensure(replan < plan, || {
        let all = shares.len();
        format!("in the median of {all} small changes, {replan} expansions, {plan} from scratch")
    })
}

/// A problem there is none of, for reading the law book without one.
#[derive(Clone, Debug)]
enum Nothing {}

impl Problem for Nothing {
    type State = ();
    type Solution = ();
    type Cost = f64;
    type Change = ();

    fn judge(&self, (): &()) -> Result<f64, Violation> {
        match *self {}
    }
    fn apply(&mut self, _: &[()]) -> Result<(), InvalidProblem> {
        match *self {}
    }
    fn stamp(&self) -> Stamp {
        match *self {}
    }
}
