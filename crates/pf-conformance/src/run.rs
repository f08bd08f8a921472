//! One call of a planner, watched.

use crate::log::Log;
use pf_core::{
    Budget, CancelToken, Clock, Context, Event, Outcome, Problem, Report, Solved, Unsupported,
};
use std::{
    cell::Cell,
    fmt::Write,
    panic::{AssertUnwindSafe, catch_unwind},
    time::Duration,
};

/// What one call of a planner brought to light.
#[derive(Debug)]
pub(crate) struct Run<P: Problem> {
    pub(crate) report: Report<P>,
    /// What it announced, in this order.
    pub(crate) improved: Vec<Solved<P>>,
    /// Every event, one a line.
    pub(crate) trace: Log,
    /// How many states and candidates it looked at, as far as it said so.
    pub(crate) looks: u64,
}

/// How a call ended.
pub(crate) enum Ran<P: Problem> {
    Answered(Run<P>),
    Declined,
    Panicked(String),
}

/// The circumstances of a call.
#[derive(Clone, Debug)]
pub(crate) struct Setting {
    pub(crate) seed: u64,
    pub(crate) budget: Budget,
    /// Whether somebody listens.
    pub(crate) heard: bool,
    /// Cancel when the planner looks at this many states and candidates.
    pub(crate) cancel_at: Option<u64>,
    /// Time passes by [`TICK`] whenever somebody looks at the clock.
    pub(crate) ticking: bool,
}

/// The fake clock's step; long enough for a context to look at the clock every iteration.
pub(crate) const TICK: Duration = Duration::from_micros(100);

thread_local!(static LOOKS_AT_CLOCK: Cell<u32> = const { Cell::new(0) });

fn ticking() -> Duration {
    let looks = LOOKS_AT_CLOCK.get() + 1;
    LOOKS_AT_CLOCK.set(looks);
    TICK * looks
}

impl Setting {
    pub(crate) fn unlimited() -> Self {
        Self::within(Budget::unlimited())
    }

    pub(crate) fn within(budget: Budget) -> Self {
        Self {
            seed: 7,
            budget,
            heard: true,
            cancel_at: None,
            ticking: false,
        }
    }

    pub(crate) fn iterations(n: u64) -> Self {
        Self::within(Budget::unlimited().iterations(n))
    }

    /// Makes the call.
    pub(crate) fn run<P: Problem>(
        &self,
        call: impl FnOnce(&mut Context<'_, P>) -> Result<Report<P>, Unsupported>,
    ) -> Ran<P> {
        let mut recorder = Recorder::new();
        let cancel = CancelToken::default();
        let mut budget = self.budget.clone();
        if self.cancel_at.is_some() {
            budget = budget.cancel(&cancel);
        }
        let mut record = |event: &Event<'_, P>| {
            recorder.event(event);
            if self.cancel_at == Some(recorder.looks) {
                cancel.cancel();
            }
        };
        let mut cx = Context::seeded(self.seed).within(budget);
        if self.ticking {
            LOOKS_AT_CLOCK.set(0);
            cx = cx.clocked(Clock::new(ticking));
        }
        if self.heard {
            cx = cx.traced(&mut record);
        }
        match catch_unwind(AssertUnwindSafe(|| call(&mut cx))) {
            Ok(Ok(report)) => Ran::Answered(Run {
                report,
                improved: recorder.improved,
                trace: recorder.trace,
                looks: recorder.looks,
            }),
            Ok(Err(_)) => Ran::Declined,
            Err(panic) => Ran::Panicked(message(&*panic)),
        }
    }
}

fn message(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "for an unknown reason".to_owned())
}

struct Recorder<P: Problem> {
    improved: Vec<Solved<P>>,
    trace: Log,
    looks: u64,
    /// A few of the states seen, at which fields are read.
    samples: Vec<P::State>,
}

impl<P: Problem> Recorder<P> {
    fn new() -> Self {
        Self {
            improved: vec![],
            trace: Log::default(),
            looks: 0,
            samples: vec![],
        }
    }

    fn event(&mut self, event: &Event<'_, P>) {
        match event {
            Event::Expanded(state) => {
                self.looks += 1;
                if self.looks.is_power_of_two() {
                    self.samples.push((*state).clone());
                }
            }
            Event::Candidate(_) => self.looks += 1,
            Event::Improved(best) => self.improved.push((*best).clone()),
            _ => {}
        }
        // Writing to a log does not fail.
        let _ = write!(self.trace, "{event:?}");
        if let Event::Field { value, .. } = event {
            for state in &self.samples {
                let _ = write!(self.trace, " {:?}", value(state));
            }
        }
        let _ = self.trace.write_char('\n');
    }
}

impl<P: Problem> Run<P> {
    /// All of the report that one seed must give again: times are not part of it.
    pub(crate) fn fingerprint(&self) -> String {
        let Report {
            outcome,
            stop,
            stats,
            notes,
        } = &self.report;
        let (i, e, v) = (stats.iterations, stats.expanded, stats.evaluated);
        format!("{outcome:?}, {stop:?}, {i} iterations, {e} expansions, {v} evaluations, {notes:?}")
    }

    /// The outcome in a few words.
    pub(crate) fn words(&self) -> String {
        let stop = self.report.stop.word();
        match &self.report.outcome {
            Outcome::Optimal(s) | Outcome::Feasible(s) => {
                format!("{} {:?}, {stop}", self.report.outcome.word(), s.cost)
            }
            other => format!("{}, {stop}", other.word()),
        }
    }
}
