//! One run: a planner, made anew, on a problem.

use crate::{
    problem::{Ask, SuiteProblem},
    record::{Line, Record, Times},
    suite::{Contender, Job, Suite},
};
use pf_core::{
    Budget, CancelToken, Claims, Context, Cost, Event, Note, Problem, Stats, Stop, Trace,
};
use pf_geom::{LENGTH, Objectives, TeamProblem};
use pf_planners::{Answer, Entry, FAULT, Order, Refusal, Scene, length, team_planners};
use pf_render::Recorder;
use std::{
    any::Any,
    cell::Cell,
    panic::{self, AssertUnwindSafe},
    sync::Once,
    time::Duration,
};

/// What a planner made of a problem.
#[derive(Default)]
struct Outcome {
    word: &'static str,
    stop: Option<Stop>,
    stats: Stats,
    latency: Duration,
    notes: Vec<String>,
    cost: Option<f64>,
    length: Option<f64>,
    clearance: Option<f64>,
    convergence: Vec<(u64, u64, f64)>,
    front: Vec<Objectives>,
}

impl Outcome {
    /// A run that had no answer.
    fn none(word: &'static str, note: impl Into<String>) -> Self {
        Self {
            word,
            notes: vec![note.into()],
            ..Self::default()
        }
    }
}

/// Makes a run of a suite; none if it was cancelled. A planner that panics is a result, too.
#[must_use]
pub fn solve(suite: &Suite, job: &Job, cancel: &CancelToken) -> Option<Line> {
    let (problem, contender) = (
        &suite.problems[job.problem],
        &suite.contenders[job.contender],
    );
    let work = || run(suite, problem, contender, job.seed, cancel);
    let outcome = guarded(work)?;
    let stats = outcome.stats;
    Some(Line {
        record: Record {
            suite: suite.name.clone(),
            problem: problem.name.clone(),
            kind: problem.kind().to_owned(),
            planner: contender.planner.clone(),
            variant: contender.variant.clone(),
            seed: job.seed,
            outcome: outcome.word.to_owned(),
            stop: outcome.stop.map_or("", Stop::word).to_owned(),
            cost: outcome.cost,
            length: outcome.length,
            clearance: outcome.clearance,
            evaluations: stats.evaluated,
            iterations: stats.iterations,
            expanded: stats.expanded,
            notes: outcome.notes,
            convergence: outcome.convergence,
            front: outcome.front,
            fingerprint: format!("{:016x}", job.fingerprint),
        },
        times: Times {
            elapsed_us: micros(stats.elapsed),
            first_us: stats.first_solution.map(micros),
            latency_us: micros(outcome.latency),
        },
    })
}

thread_local! {
    /// Whether a panic of this thread becomes a note.
    static NOTED: Cell<bool> = const { Cell::new(false) };
}

/// What a panic says becomes a note, and is not printed besides.
fn guarded(work: impl FnOnce() -> Option<Outcome>) -> Option<Outcome> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let usual = panic::take_hook();
        panic::set_hook(Box::new(move |facts| {
            if !NOTED.get() {
                usual(facts);
            }
        }));
    });
    NOTED.set(true);
    // All that a planner may have left half done is made anew for the next run.
    let done = panic::catch_unwind(AssertUnwindSafe(work));
    NOTED.set(false);
    done.unwrap_or_else(|panic| {
        let words = words_of(panic.as_ref());
        Some(Outcome::none("panicked", format!("panic: {words}")))
    })
}

fn words_of(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or(panic.downcast_ref::<&str>().copied())
        .unwrap_or("without words")
}

fn run(
    suite: &Suite,
    problem: &SuiteProblem,
    contender: &Contender,
    seed: u64,
    cancel: &CancelToken,
) -> Option<Outcome> {
    let budget = contender.limits.budget().cancel(cancel);
    let settings = settings(contender);
    let outcome = match &problem.ask {
        Ask::Scene(scene) => on_scene(suite, problem, scene, contender, &settings, seed, &budget),
        Ask::Team(team) => on_team(suite, team, contender, &settings, seed, &budget),
    };
    (outcome.stop != Some(Stop::Cancelled) && !cancel.is_cancelled()).then_some(outcome)
}

/// Some planners end after evaluations of their own choice, others when the budget says so.
fn settings(contender: &Contender) -> Vec<(String, String)> {
    let mut settings = contender.settings.clone();
    let entry = contender.entry();
    let has = |name| entry.is_some_and(|entry| entry.parameters().iter().any(|k| k.name == name));
    let said = settings.iter().any(|(key, _)| key == "evaluations");
    if let (Some(n), true, false) = (contender.limits.evaluations, has("evaluations"), said) {
        settings.push(("evaluations".to_owned(), n.to_string()));
    }
    settings
}

fn on_scene(
    suite: &Suite,
    problem: &SuiteProblem,
    scene: &Scene,
    contender: &Contender,
    settings: &[(String, String)],
    seed: u64,
    budget: &Budget,
) -> Outcome {
    let Some(entry) = contender.entry() else {
        return Outcome::none("declined", "there is no planner of that name");
    };
    // Settings were checked with the suite: who cannot be made now has failed, as a program does that
    // does not start. Who declines says so when it is asked.
    let plan = |recorder| -> Result<(Answer, bool, Claims), (&'static str, String)> {
        let runner = entry.runner(settings);
        let mut runner = runner.map_err(|error| ("failed", error.to_string()))?;
        let order = Order {
            seed,
            budget: budget.clone(),
            recorder,
        };
        let answer = runner.plan(scene, order);
        let declined = |refusal: Refusal| ("declined", refusal.to_string());
        let answer = answer.map_err(declined)?;
        Ok((answer, runner.raster().is_some(), runner.claims()))
    };
    let (answer, rasterised, claims) = match plan(None) {
        Ok(answered) => answered,
        Err((word, why)) => return Outcome::none(word, why),
    };
    let mut answer = answer;
    let mut others = Vec::new();
    for _ in 1..suite.repetitions {
        if let Ok((again, ..)) = plan(None) {
            quicker(&mut answer.stats, &again.stats);
            answer.latency = answer.latency.min(again.latency);
            others.push(again);
        }
    }
    let converted = answer.notes.iter().any(|note| note.key == "converted");
    let mut outcome = Outcome {
        word: word(&answer),
        stop: Some(answer.stop),
        stats: answer.stats,
        latency: answer.latency,
        cost: answer.costs.first().copied(),
        length: answer.lines.first().map(length),
        clearance: answer.lines.first().and_then(|line| {
            let ruler = &problem.ruler;
            ruler.clearance(scene, line, converted)
        }),
        notes: said(&answer.notes),
        ..Outcome::default()
    };
    for again in &others {
        outcome.compare(
            contender,
            (word(again), again.costs.first().copied()),
            again.stop,
        );
    }
    // Costs on cells that a world was cut into are none of the world's.
    if suite.convergence && !claims.optimal && !rasterised && outcome.cost.is_some() {
        let mut recorder = Recorder::of_improvements();
        if let Ok((again, _, _)) = plan(Some(&mut recorder)) {
            let improvements = recorder.improvements().iter();
            let points = improvements.map(|i| (i.evaluated, i.expanded, i.cost));
            outcome.convergence = points.collect();
            let now = (word(&again), again.costs.first().copied());
            outcome.compare(contender, now, again.stop);
        }
    }
    outcome.ends();
    outcome
}

/// An answer that was refused, and the fault of a planner in another program, are told from none.
fn word(answer: &Answer) -> &'static str {
    let has = |key| answer.notes.iter().any(|note| note.key == key);
    if has(FAULT) {
        "failed"
    } else if has("refused") {
        "refused"
    } else {
        answer.outcome
    }
}

fn on_team(
    suite: &Suite,
    team: &TeamProblem,
    contender: &Contender,
    settings: &[(String, String)],
    seed: u64,
    budget: &Budget,
) -> Outcome {
    let Some(entry) = team_planners().find(|entry| entry.key() == contender.planner) else {
        let why = format!("{} does not plan for teams", contender.planner);
        return Outcome::none("declined", why);
    };
    let mut outcome = team_run(team, entry, settings, seed, budget, None);
    for _ in 1..suite.repetitions {
        let again = team_run(team, entry, settings, seed, budget, None);
        quicker(&mut outcome.stats, &again.stats);
        outcome.latency = outcome.latency.min(again.latency);
        if let Some(stop) = again.stop {
            outcome.compare(contender, (again.word, again.cost), stop);
        }
    }
    if suite.convergence && outcome.cost.is_some() {
        let mut listener = Listener::default();
        let again = team_run(team, entry, settings, seed, budget, Some(&mut listener));
        outcome.convergence = listener.points;
        if let Some(stop) = again.stop {
            outcome.compare(contender, (again.word, again.cost), stop);
        }
    }
    outcome.ends();
    outcome
}

fn team_run(
    team: &TeamProblem,
    entry: &Entry<TeamProblem>,
    settings: &[(String, String)],
    seed: u64,
    budget: &Budget,
    listener: Option<&mut Listener>,
) -> Outcome {
    let mut planner = match entry.make(settings) {
        Ok(planner) => planner,
        Err(error) => return Outcome::none("declined", error.to_string()),
    };
    let mut cx = Context::seeded(seed).within(budget.clone());
    if let Some(listener) = listener {
        cx = cx.traced(listener);
    }
    let report = match planner.plan(team, &mut cx) {
        Ok(report) => report,
        Err(unsupported) => return Outcome::none("declined", unsupported.to_string()),
    };
    let mut outcome = Outcome {
        word: report.outcome.word(),
        stop: Some(report.stop),
        stats: report.stats,
        latency: report.stats.elapsed,
        notes: said(&report.notes),
        ..Outcome::default()
    };
    let Some(solved) = report.outcome.solved() else {
        return outcome;
    };
    match team.judge(&solved.solution) {
        Ok(cost) if cost.same_as(&solved.cost) => {
            let members = cost.members();
            let shortest = members
                .iter()
                .min_by(|a, b| a[LENGTH].total_cmp(&b[LENGTH]));
            outcome.cost = shortest.map(|cost| cost[LENGTH]);
            outcome.length = outcome.cost;
            // As `pf team` says it: below the ease it is the clearance.
            outcome.clearance = shortest.map(|cost| team.ease() - cost[1]);
            outcome.front = members.to_vec();
        }
        Ok(_) => {
            outcome.word = "refused";
            outcome
                .notes
                .push("refused: the costs are not the judge's".to_owned());
        }
        Err(violation) => {
            outcome.word = "refused";
            outcome
                .notes
                .push(format!("refused: the front {violation}"));
        }
    }
    outcome
}

impl Outcome {
    /// Says so if the same run, made again, came to something else.
    fn compare(&mut self, contender: &Contender, again: (&str, Option<f64>), stop: Stop) {
        let bits = |cost: Option<f64>| cost.map(f64::to_bits);
        let same = self.word == again.0 && bits(self.cost) == bits(again.1);
        if !same && contender.limits.time.is_none() && stop != Stop::Cancelled {
            let cost = again.1.map_or_else(String::new, |cost| format!(" {cost}"));
            let word = again.0;
            self.notes.push(format!(
                "not repeatable: the same run again was {word}{cost}"
            ));
        }
    }

    /// What was found last is what was answered, whoever listened.
    fn ends(&mut self) {
        let Some(cost) = self.cost else { return };
        let better = |last: &(u64, u64, f64)| cost < last.2;
        if self.convergence.last().is_none_or(better) {
            let stats = self.stats;
            self.convergence
                .push((stats.evaluated, stats.expanded, cost));
        }
    }
}

/// Takes over the times of the same run, made again, if that took less.
fn quicker(stats: &mut Stats, again: &Stats) {
    if again.elapsed < stats.elapsed {
        stats.elapsed = again.elapsed;
        stats.first_solution = again.first_solution;
    }
}

fn said(notes: &[Note]) -> Vec<String> {
    notes.iter().map(ToString::to_string).collect()
}

/// Microseconds with one decimal: what a clock can tell.
fn micros(time: Duration) -> f64 {
    (time.as_secs_f64() * 1e7).round() / 10.0
}

/// Keeps when the shortest plan of the front became shorter.
#[derive(Default)]
struct Listener {
    spent: Stats,
    points: Vec<(u64, u64, f64)>,
}

impl Trace<TeamProblem> for Listener {
    fn event(&mut self, event: &Event<'_, TeamProblem>) {
        let Event::Improved(best) = event else { return };
        let lengths = best.cost.members().iter().map(|cost| cost[LENGTH]);
        let cost = lengths.fold(f64::INFINITY, f64::min);
        if self.points.last().is_none_or(|last| cost < last.2) {
            let Stats {
                evaluated,
                expanded,
                ..
            } = self.spent;
            self.points.push((evaluated, expanded, cost));
        }
    }

    fn spent(&mut self, stats: &Stats) {
        self.spent = *stats;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_a_result() {
        let text = format!("index {}", 7);
        let outcome = guarded(|| panic::panic_any(text)).unwrap();
        assert_eq!(outcome.word, "panicked");
        assert_eq!(outcome.notes, ["panic: index 7"]);
        assert!(guarded(|| None).is_none());
    }
}
