//! What comes back from planning, and what may go wrong.

use crate::{Problem, Text};
use std::{borrow::Cow, fmt, time::Duration};

/// A solution with the cost its planner states for it; `pf-conformance` checks the statement.
#[derive(Clone, Debug)]
pub struct Solved<P: Problem> {
    /// The solution.
    pub solution: P::Solution,
    /// Its stated cost.
    pub cost: P::Cost,
}

/// An honest answer, in the four words of the constraint solvers.
#[derive(Clone, Debug)]
pub enum Outcome<P: Problem> {
    /// A solution, proven best.
    Optimal(Solved<P>),
    /// A solution; better ones may exist.
    Feasible(Solved<P>),
    /// Proven: there is no solution.
    Infeasible,
    /// Nothing proven, nothing found. The nearest miss, if any, is for looking at, not for driving.
    Unknown {
        /// The nearest miss.
        attempt: Option<P::Solution>,
    },
}

impl<P: Problem> Outcome<P> {
    /// The usable solution, if there is one.
    #[must_use]
    pub fn solved(&self) -> Option<&Solved<P>> {
        match self {
            Self::Optimal(s) | Self::Feasible(s) => Some(s),
            Self::Infeasible | Self::Unknown { .. } => None,
        }
    }

    /// The word for this outcome: `optimal`, `feasible`, `infeasible` or `unknown`.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Self::Optimal(_) => "optimal",
            Self::Feasible(_) => "feasible",
            Self::Infeasible => "infeasible",
            Self::Unknown { .. } => "unknown",
        }
    }

    /// What this outcome says of another problem of which this one was a cautious conversion:
    /// a solution stays one, a proof does not survive.
    #[must_use]
    pub fn converted(self) -> Self {
        match self {
            Self::Optimal(s) => Self::Feasible(s),
            Self::Infeasible => Self::Unknown { attempt: None },
            other => other,
        }
    }
}

/// How far a planner can vouch for a solution it hands to [`Context::answer`](crate::Context::answer).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Proof {
    /// Nothing is better.
    Optimal,
    /// It is one.
    None,
}

/// Why a planner stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Stop {
    /// Of its own accord: proof, convergence, or nothing left to try.
    Finished,
    /// The iteration budget ran out.
    Iterations,
    /// The evaluation budget ran out.
    Evaluations,
    /// The time budget ran out.
    Time,
    /// Someone cancelled.
    Cancelled,
}

impl Stop {
    /// The word for this reason: `finished`, `iterations`, `evaluations`, `time` or `cancelled`.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Finished => "finished",
            Self::Iterations => "iterations",
            Self::Evaluations => "evaluations",
            Self::Time => "time",
            Self::Cancelled => "cancelled",
        }
    }
}

/// What the work took. Counts are reproducible; times are not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Stats {
    /// Calls to [`Context::proceed`](crate::Context::proceed) that were granted.
    pub iterations: u64,
    /// States settled, sampled or visited.
    pub expanded: u64,
    /// Objective evaluations.
    pub evaluated: u64,
    /// Wall-clock time.
    pub elapsed: Duration,
    /// Wall-clock time to the first solution, if there was one.
    pub first_solution: Option<Duration>,
}

/// Something worth saying about an answer: what was chosen and why, what was kept or repaired,
/// the clearance reached, the nearest reachable cell.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// What it is about, for programs: `"nearest"`, `"chose"`, `"repaired"`.
    pub key: &'static str,
    /// What there is to say, for people.
    pub text: Text,
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.key, self.text)
    }
}

/// What comes back from planning.
#[derive(Clone, Debug)]
pub struct Report<P: Problem> {
    /// The answer.
    pub outcome: Outcome<P>,
    /// Why it is the last word.
    pub stop: Stop,
    /// What it took.
    pub stats: Stats,
    /// What else there is to say.
    pub notes: Vec<Note>,
}

impl<P: Problem> Report<P> {
    /// The text of the first note under `key`.
    #[must_use]
    pub fn note(&self, key: &str) -> Option<&str> {
        let note = self.notes.iter().find(|note| note.key == key)?;
        Some(&note.text)
    }
}

/// The problem lies outside what the algorithm is defined for, e.g. jump points on a weighted grid.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{planner} does not support this problem: {reason}")]
pub struct Unsupported {
    /// Who declines.
    pub planner: String,
    /// Why.
    pub reason: Cow<'static, str>,
}

impl Unsupported {
    /// `planner` declines for `reason`.
    pub fn new(planner: impl Into<String>, reason: impl Into<Cow<'static, str>>) -> Self {
        Self {
            planner: planner.into(),
            reason: reason.into(),
        }
    }
}

/// The question makes no sense.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum InvalidProblem {
    /// Something lies outside the world.
    #[error("{what} {place} lies outside the {world} world")]
    OutOfBounds {
        /// Which thing.
        what: Cow<'static, str>,
        /// Where it is said to lie.
        place: String,
        /// How large the world is.
        world: String,
    },
    /// A change names an obstacle that is not there.
    #[error("no obstacle has id {id}")]
    NoSuchObstacle {
        /// The id named.
        id: usize,
    },
    /// A value makes no sense.
    #[error("{what} is {found}, expected {expected}")]
    BadValue {
        /// Which value.
        what: Cow<'static, str>,
        /// What it is.
        found: String,
        /// What would make sense.
        expected: Cow<'static, str>,
    },
}

/// The first rule a solution breaks.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Violation {
    /// There is nothing to mark.
    #[error("is empty")]
    Empty,
    /// It does not begin at the start.
    #[error("does not begin at the start")]
    WrongStart,
    /// It does not end at the goal.
    #[error("does not end at the goal")]
    WrongGoal,
    /// It moves in a way the problem does not allow.
    #[error("move {at} is not allowed")]
    IllegalMove {
        /// Which move, from 0.
        at: usize,
    },
    /// It touches an obstacle.
    #[error("move {at} collides")]
    Collision {
        /// Which move, from 0.
        at: usize,
    },
    /// It is faster than it can be, or goes back in time.
    #[error("move {at} is not possible in its time")]
    TooFast {
        /// Which move, from 0.
        at: usize,
    },
    /// Of what there must be one for each, there are more or fewer.
    #[error("has {found} {what}, not {expected}")]
    WrongNumber {
        /// Of what.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many there must be.
        expected: usize,
    },
    /// Two robots are in one place at one time.
    #[error("robots {first} and {second} collide")]
    Meeting {
        /// One robot, from 0.
        first: usize,
        /// The other.
        second: usize,
    },
    /// A member of a front is worse than another.
    #[error("member {member} is dominated by member {by}")]
    Dominated {
        /// Which, from 0.
        member: usize,
        /// By which.
        by: usize,
    },
    /// A part breaks a rule.
    #[error("{part} {number}: {violation}")]
    Part {
        /// What it is part of: `"robot"`, `"member"`.
        part: &'static str,
        /// Which, from 0.
        number: usize,
        /// The rule.
        violation: Box<Violation>,
    },
}

impl Violation {
    /// The same, of a part.
    #[must_use]
    pub fn of(self, part: &'static str, number: usize) -> Self {
        Self::Part {
            part,
            number,
            violation: Box::new(self),
        }
    }
}
