//! What can be set.

use pf_core::{InvalidParams, params};
use std::{fmt, ops::RangeInclusive, str::FromStr};

/// By which rules a [`Lbfgs`](crate::Lbfgs) plans.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rules {
    /// Ours: in the class of the exact shortest path, exact distances, marked until it passes.
    Exact,
    /// The paper's.
    Paper,
    /// Those of the code that the paper's authors published.
    PublishedCode,
}

/// What keeps a path away from obstacles under [`Rules::Exact`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Obstacles {
    /// The square of what is missing at the asked clearance, by exact distances from segments to
    /// shapes of any kind.
    Hinge,
    /// The paper's potential, of rectangles only.
    Potential,
}

/// How an [`Lbfgs`](crate::Lbfgs) plans. The default is ours; [`paper`](Self::paper) and
/// [`published_code`](Self::published_code) are others.
#[derive(Clone, Debug, PartialEq)]
pub struct LbfgsParams {
    /// By which rules.
    pub rules: Rules,
    /// Inner points of the path; ours takes more where the exact shortest path has more bends.
    pub points: usize,
    /// Ours: how far to keep from obstacles, beyond the robot's radius, in the world's unit.
    pub clearance: f64,
    /// Ours: what keeps the path away from obstacles.
    pub obstacles: Obstacles,
    /// Ours: by what share another way round the obstacles must be shorter to be taken instead of
    /// the last one.
    pub hysteresis: f64,
    /// The paper's potential reaches so far beyond a rectangle, in the world's unit.
    pub margin: f64,
    /// The paper's weight of the potential, in the end.
    pub lambda_obs: f64,
    /// The paper's pairs that L-BFGS remembers.
    pub memory: usize,
    /// The paper's share of the promised descent that a step must bring.
    pub armijo: f64,
    /// The paper's standard deviation of the last losses below which it ends.
    pub spread: f64,
    /// At most so many steps; in ours, for each weight of the obstacles.
    pub iterations: u64,
}

impl Default for LbfgsParams {
    fn default() -> Self {
        Self {
            rules: Rules::Exact,
            points: 20,
            clearance: 0.0,
            obstacles: Obstacles::Hinge,
            hysteresis: 0.05,
            margin: 2.0,
            lambda_obs: 32.0,
            memory: 8,
            armijo: 1e-4,
            spread: 0.1,
            iterations: 200,
        }
    }
}

params!(LbfgsParams {
    rules: Rules = "exact (ours), paper, or published-code",
    points: usize = "inner points of the path",
    clearance: f64 = "ours: how far to keep from obstacles, beyond the robot's radius",
    obstacles: Obstacles = "ours: hinge (any shape), or potential (the paper's, of rectangles)",
    hysteresis: f64 = "ours: by what share another way round must be shorter to be taken",
    margin: f64 = "how far the paper's potential reaches beyond a rectangle",
    lambda_obs: f64 = "the paper's weight of the potential, in the end",
    memory: usize = "the paper's pairs that L-BFGS remembers",
    armijo: f64 = "the paper's share of the promised descent that a step must bring",
    spread: f64 = "the paper's standard deviation of the last losses at which it ends",
    iterations: u64 = "steps at most; in ours, for each weight of the obstacles",
});

impl LbfgsParams {
    /// The paper's.
    #[must_use]
    pub fn paper() -> Self {
        Self {
            rules: Rules::Paper,
            ..Self::default()
        }
    }

    /// Those of the code that the paper's authors published: at most four tries for a step, the
    /// weight of the obstacles one further, eight samples near rectangles and none far from them,
    /// noise at the peaks, a rule to end that leaves out the newest loss, and a weight that a warm
    /// start does not reset.
    #[must_use]
    pub fn published_code() -> Self {
        Self {
            rules: Rules::PublishedCode,
            armijo: 0.01,
            ..Self::default()
        }
    }

    /// Refuses what makes no sense.
    pub(crate) fn check(&self) -> Result<(), InvalidParams> {
        whole("points", self.points as u64, 1..=1_000_000)?;
        whole("memory", self.memory as u64, 0..=1000)?;
        whole("iterations", self.iterations, 0..=u64::MAX)?;
        let share = |v: f64| (0.0..1.0).contains(&v);
        let positive = |v: f64| v > 0.0 && v.is_finite();
        let from_0 = |v: f64| v >= 0.0 && v.is_finite();
        real("clearance", self.clearance, from_0, "a number from 0")?;
        real(
            "hysteresis",
            self.hysteresis,
            share,
            "a number from 0 to below 1",
        )?;
        real("margin", self.margin, positive, "a positive number")?;
        real("lambda_obs", self.lambda_obs, from_0, "a number from 0")?;
        real("armijo", self.armijo, share, "a number from 0 to below 1")?;
        real("spread", self.spread, from_0, "a number from 0")
    }
}

fn whole(key: &str, value: u64, range: RangeInclusive<u64>) -> Result<(), InvalidParams> {
    if range.contains(&value) {
        return Ok(());
    }
    let expected = format!("a whole number from {} to {}", range.start(), range.end());
    Err(InvalidParams::bad(key, &value.to_string(), expected))
}

fn real(
    key: &str,
    value: f64,
    fits: impl Fn(f64) -> bool,
    expected: &str,
) -> Result<(), InvalidParams> {
    if fits(value) {
        return Ok(());
    }
    Err(InvalidParams::bad(key, &value.to_string(), expected))
}

/// An enum by the words for its values.
macro_rules! words {
    ($kind:ident { $($word:literal = $value:ident),* }) => {
        impl FromStr for $kind {
            type Err = String;

            fn from_str(text: &str) -> Result<Self, String> {
                match text {
                    $($word => Ok(Self::$value),)*
                    _ => Err([$($word),*].join(", ")),
                }
            }
        }

        impl fmt::Display for $kind {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(match self {
                    $(Self::$value => $word),*
                })
            }
        }
    };
}

words!(Rules { "exact" = Exact, "paper" = Paper, "published-code" = PublishedCode });
words!(Obstacles { "hinge" = Hinge, "potential" = Potential });
