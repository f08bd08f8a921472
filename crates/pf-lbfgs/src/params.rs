//! What can be set.

use pf_core::{InvalidParams, params, words};

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
    /// the last one. With 0 nothing is kept for its own sake: a replan descends from the
    /// exact path and from the last one, if that goes the same way, and takes the better.
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
        InvalidParams::unless_whole("points", self.points, 1..=1_000_000)?;
        InvalidParams::unless_whole("memory", self.memory, 0..=1000)?;
        let from_0 = |key: &str, v: f64| {
            let fine = v >= 0.0 && v.is_finite();
            InvalidParams::unless(key, v, fine, "a number from 0")
        };
        let share = |key: &str, v: f64| {
            let fine = (0.0..1.0).contains(&v);
            InvalidParams::unless(key, v, fine, "a number from 0 to below 1")
        };
        from_0("clearance", self.clearance)?;
        share("hysteresis", self.hysteresis)?;
        let positive = self.margin > 0.0 && self.margin.is_finite();
        InvalidParams::unless("margin", self.margin, positive, "a positive number")?;
        from_0("lambda_obs", self.lambda_obs)?;
        share("armijo", self.armijo)?;
        from_0("spread", self.spread)
    }
}

words!(Rules { "exact" = Exact, "paper" = Paper, "published-code" = PublishedCode });
words!(Obstacles { "hinge" = Hinge, "potential" = Potential });
