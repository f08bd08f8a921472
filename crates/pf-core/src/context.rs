//! The only door to chance, time and the outside world.

use crate::{
    Clock, Event, Note, Outcome, Problem, Proof, Report, Solved, Stats, Stop, Text, Trace,
};
use rand::SeedableRng;
use std::{
    fmt, mem,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    time::Duration,
};

/// The workspace's generator. Its output for a seed is part of the public API: `StdRng` may change
/// with any release of `rand`, this named generator never does.
pub type PlanRng = rand::rngs::Xoshiro256PlusPlus;

/// Stops planners from another thread.
#[derive(Clone, Debug, Default)]
pub struct CancelToken(Arc<AtomicBool>);

impl CancelToken {
    /// Asks every planner holding this token to stop.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether someone asked.
    #[inline]
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// How much work a planner may do. The default is unlimited.
///
/// A budget in iterations or evaluations is reproducible; a budget in time is not.
#[derive(Clone, Debug, Default)]
pub struct Budget {
    iterations: Option<u64>,
    evaluations: Option<u64>,
    time: Option<Duration>,
    cancel: CancelToken,
}

impl Budget {
    /// No limit.
    #[must_use]
    pub fn unlimited() -> Self {
        Self::default()
    }
    /// At most `n` iterations; each planner's page says what one is.
    #[must_use]
    pub fn iterations(mut self, n: u64) -> Self {
        self.iterations = Some(n);
        self
    }
    /// At most `n` evaluations of the objective, rounded up to whole iterations.
    #[must_use]
    pub fn evaluations(mut self, n: u64) -> Self {
        self.evaluations = Some(n);
        self
    }
    /// At most `limit` of wall-clock time.
    #[must_use]
    pub fn time(mut self, limit: Duration) -> Self {
        self.time = Some(limit);
        self
    }
    #[inline]
    fn most_evaluations(&self) -> u64 {
        self.evaluations.unwrap_or(u64::MAX)
    }
    /// Until `token` is cancelled.
    #[must_use]
    pub fn cancel(mut self, token: &CancelToken) -> Self {
        self.cancel = token.clone();
        self
    }
}

/// Chance, time and the outside world, for one call of a planner.
///
/// ```
/// # use pf_core::*;
/// # #[derive(Clone, Debug)] struct Any;
/// # impl Problem for Any {
/// #   type State = u8; type Solution = u8; type Cost = f64; type Change = ();
/// #   fn judge(&self, _: &u8) -> Result<f64, Violation> { Ok(1.0) }
/// #   fn apply(&mut self, _: &[()]) -> Result<(), InvalidProblem> { Ok(()) }
/// #   fn stamp(&self) -> Stamp { Stamp::fresh() }
/// # }
/// let mut expansions = 0;
/// let mut count = |_: &Event<'_, Any>| expansions += 1;
/// let budget = Budget::unlimited().iterations(10);
/// let mut cx: Context<'_, Any> = Context::seeded(7).within(budget).traced(&mut count);
/// while cx.proceed() {
///     cx.expanded(|| 3);
/// }
/// let report = cx.report(Outcome::Unknown { attempt: None });
/// assert_eq!((report.stop, report.stats.iterations), (Stop::Iterations, 10));
/// assert_eq!(expansions, 10);
/// ```
pub struct Context<'a, P: Problem> {
    budget: Budget,
    clock: Clock,
    rng: PlanRng,
    trace: Option<&'a mut dyn Trace<P>>,
    stats: Stats,
    stop: Stop,
    /// No iteration before this one need look at its number or at the clock.
    calm_until: u64,
    notes: Vec<Note>,
    began: Duration,
    looked: Duration,
    next_look: u64,
    stride: u64,
}

impl<P: Problem> fmt::Debug for Context<'_, P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Context")
            .field("budget", &self.budget)
            .field("stats", &self.stats)
            .finish_non_exhaustive()
    }
}

impl<'a, P: Problem> Context<'a, P> {
    /// Unlimited, untraced; time runs from now.
    #[must_use]
    pub fn seeded(seed: u64) -> Self {
        Self::opened(
            PlanRng::seed_from_u64(seed),
            Budget::unlimited(),
            Clock::default(),
        )
    }

    fn opened(rng: PlanRng, budget: Budget, clock: Clock) -> Self {
        Self {
            budget,
            clock,
            rng,
            trace: None,
            stats: Stats::default(),
            stop: Stop::Finished,
            calm_until: 0,
            notes: Vec::new(),
            began: clock.now(),
            looked: Duration::ZERO,
            next_look: 0,
            stride: 1,
        }
    }

    /// The same, limited.
    #[must_use]
    pub fn within(mut self, budget: Budget) -> Self {
        self.budget = budget;
        self
    }

    /// The same, listened to.
    #[must_use]
    pub fn traced(mut self, trace: &'a mut dyn Trace<P>) -> Self {
        self.trace = Some(trace);
        self
    }

    /// The same, by another clock; time runs from now.
    #[must_use]
    pub fn clocked(mut self, clock: Clock) -> Self {
        self.clock = clock;
        self.began = clock.now();
        self
    }

    /// Counts one iteration and says whether the budget allows it. The head of every main loop:
    /// `while cx.proceed() { … }`.
    #[inline]
    pub fn proceed(&mut self) -> bool {
        let n = self.stats.iterations;
        // One branch for everything: searches come here with every expansion.
        let calm = (n < self.calm_until)
            & (self.stats.evaluated < self.budget.most_evaluations())
            & !self.budget.cancel.is_cancelled();
        if !calm && !self.look(n) {
            return false;
        }
        self.stats.iterations = n + 1;
        true
    }

    /// Whether the budget allows the iteration after the first `n`.
    #[cold]
    fn look(&mut self, n: u64) -> bool {
        self.calm_until = 0;
        if self.stop != Stop::Finished {
            return false;
        }
        let most = self.budget.iterations.unwrap_or(u64::MAX);
        if n >= most {
            self.stop = Stop::Iterations;
        } else if self.stats.evaluated >= self.budget.most_evaluations() {
            self.stop = Stop::Evaluations;
        } else if self.budget.cancel.is_cancelled() {
            self.stop = Stop::Cancelled;
        } else if let (Some(limit), true) = (self.budget.time, n >= self.next_look) {
            self.look_at_clock(limit, n);
        }
        if self.stop != Stop::Finished {
            return false;
        }
        self.calm_until = match self.budget.time {
            Some(_) => most.min(self.next_look),
            None => most,
        };
        true
    }

    /// Looks often when iterations are slow and seldom when they are fast.
    fn look_at_clock(&mut self, limit: Duration, n: u64) {
        let now = self.elapsed();
        if now >= limit {
            self.stop = Stop::Time;
        }
        self.stride = if now.saturating_sub(self.looked) < Duration::from_micros(50) {
            self.stride * 2
        } else {
            1
        };
        self.looked = now;
        self.next_look = n + self.stride;
    }

    /// How many evaluations the budget still allows: a planner that evaluates many candidates an
    /// iteration can stop on the dot.
    #[must_use]
    pub fn evaluations_left(&self) -> u64 {
        let max = self.budget.evaluations.unwrap_or(u64::MAX);
        max.saturating_sub(self.stats.evaluated)
    }

    /// The only source of chance a planner may use.
    pub fn rng(&mut self) -> &mut PlanRng {
        &mut self.rng
    }

    /// What the work has taken so far.
    #[must_use]
    pub fn stats(&self) -> &Stats {
        &self.stats
    }

    /// Wall-clock time since the context was made.
    #[must_use]
    pub fn elapsed(&self) -> Duration {
        self.clock.now().saturating_sub(self.began)
    }

    /// Whether the budget ended the work.
    #[must_use]
    pub fn stopped(&self) -> bool {
        self.stop != Stop::Finished
    }

    /// Whether the work was cancelled or its time is up, without counting an iteration: for a planner
    /// that waits for somebody else's work.
    pub fn is_over(&mut self) -> bool {
        if self.budget.cancel.is_cancelled() {
            self.stop = Stop::Cancelled;
        } else if self
            .budget
            .time
            .is_some_and(|limit| self.elapsed() >= limit)
        {
            self.stop = Stop::Time;
        }
        self.stopped()
    }

    /// Whether somebody listens: worth asking before preparing what only a listener needs.
    #[inline]
    #[must_use]
    pub fn listening(&self) -> bool {
        self.trace.is_some()
    }

    /// Counts a state that was looked at; `state` is built only for a listener.
    #[inline]
    pub fn expanded(&mut self, state: impl FnOnce() -> P::State) {
        self.stats.expanded += 1;
        if let Some(trace) = &mut self.trace {
            trace.event(&Event::Expanded(&state()));
        }
    }

    /// Counts `n` states visited that nobody needs to see one by one.
    #[inline]
    pub fn visited(&mut self, n: u64) {
        self.stats.expanded += n;
    }

    /// Counts an evaluation; the complete attempt is built only for a listener.
    #[inline]
    pub fn candidate(&mut self, solution: impl FnOnce() -> P::Solution) {
        self.stats.evaluated += 1;
        if let Some(trace) = &mut self.trace {
            trace.event(&Event::Candidate(&solution()));
        }
    }

    /// Counts `n` evaluations nobody needs to see.
    #[inline]
    pub fn evaluated(&mut self, n: u64) {
        self.stats.evaluated += n;
    }

    /// Announces a solution better than every one before; built only for a listener.
    pub fn improved(&mut self, best: impl FnOnce() -> Solved<P>) {
        if self.stats.first_solution.is_none() {
            self.stats.first_solution = Some(self.elapsed());
        }
        if let Some(trace) = &mut self.trace {
            trace.spent(&self.stats);
            trace.event(&Event::Improved(&best()));
        }
    }

    /// Shows a number per state to a listener.
    pub fn field(&mut self, name: &'static str, value: impl Fn(&P::State) -> f64) {
        if let Some(trace) = &mut self.trace {
            trace.event(&Event::Field {
                name,
                value: &value,
            });
        }
    }

    /// Shows a set of states to a listener, for whom alone it is built.
    pub fn points(&mut self, name: &'static str, at: impl FnOnce() -> Vec<P::State>) {
        if let Some(trace) = &mut self.trace {
            trace.event(&Event::Points { name, at: &at() });
        }
    }

    /// Adds a note to the report.
    pub fn note(&mut self, key: &'static str, text: impl fmt::Display) {
        let text = Text::of(text);
        self.notes.push(Note { key, text });
    }

    /// Does work that may take so many more iterations at the most. That it was cut short by this is not
    /// reported; the caller knows.
    ///
    /// ```
    /// # use pf_core::*;
    /// # #[derive(Clone, Debug)] struct Any;
    /// # impl Problem for Any {
    /// #   type State = u8; type Solution = u8; type Cost = f64; type Change = ();
    /// #   fn judge(&self, _: &u8) -> Result<f64, Violation> { Ok(1.0) }
    /// #   fn apply(&mut self, _: &[()]) -> Result<(), InvalidProblem> { Ok(()) }
    /// #   fn stamp(&self) -> Stamp { Stamp::fresh() }
    /// # }
    /// let budget = Budget::unlimited().iterations(10);
    /// let mut cx: Context<'_, Any> = Context::seeded(7).within(budget);
    /// let count = |cx: &mut Context<'_, Any>| (0..100).take_while(|_| cx.proceed()).count();
    /// assert_eq!((cx.at_most(4, count), cx.stopped()), (4, false));
    /// assert_eq!((cx.at_most(9, count), cx.stopped()), (6, true));
    /// ```
    pub fn at_most<R>(&mut self, iterations: u64, work: impl FnOnce(&mut Self) -> R) -> R {
        let whole = self.budget.iterations;
        let most = self.stats.iterations.saturating_add(iterations);
        self.budget.iterations = Some(whole.map_or(most, |whole| whole.min(most)));
        self.calm_until = 0;
        let result = work(self);
        self.budget.iterations = whole;
        self.calm_until = 0;
        if self.stop == Stop::Iterations && whole.is_none_or(|whole| most < whole) {
            self.stop = Stop::Finished;
        }
        result
    }

    /// Lets another planner work on another problem within the same budget, seed and books. The
    /// child's events are its own affair; its work and its notes count here.
    pub fn child<Q: Problem, R>(&mut self, work: impl FnOnce(&mut Context<'_, Q>) -> R) -> R {
        let budget = self.budget.clone();
        let mut child = Context::opened(self.rng.clone(), budget, self.clock);
        child.began = self.began;
        child.stats = self.stats;
        child.stop = self.stop;
        let result = work(&mut child);
        self.rng = child.rng;
        self.stats = child.stats;
        self.stop = child.stop;
        self.calm_until = 0;
        self.notes.append(&mut child.notes);
        result
    }

    /// Closes the books over a solution: the problem's judge marks it and states its cost, so
    /// that no planner can hand out a solution that breaks a rule. One that does is reported as
    /// the attempt of an [`Outcome::Unknown`]. A proof counts only if the budget did not cut it
    /// short.
    pub fn answer(&mut self, problem: &P, solution: P::Solution, proof: Proof) -> Report<P> {
        let Ok(cost) = problem.judge(&solution) else {
            let attempt = Some(solution);
            return self.report(Outcome::Unknown { attempt });
        };
        let solved = Solved { solution, cost };
        self.improved(|| solved.clone());
        self.report(match proof {
            Proof::Optimal if !self.stopped() => Outcome::Optimal(solved),
            _ => Outcome::Feasible(solved),
        })
    }

    /// Closes the books: the tail of every planner. The notes go with the report.
    pub fn report(&mut self, outcome: Outcome<P>) -> Report<P> {
        self.stats.elapsed = self.elapsed();
        Report {
            outcome,
            stop: self.stop,
            stats: self.stats,
            notes: mem::take(&mut self.notes),
        }
    }
}
