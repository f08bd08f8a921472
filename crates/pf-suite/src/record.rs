use serde::{Deserialize, Serialize};

/// What a run came to: all of it is the same whenever the run is made again, unless its budget is a
/// time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// The suite's name.
    pub suite: String,
    /// The problem's name.
    pub problem: String,
    /// `grid`, `world` or `team`.
    pub kind: String,
    /// The planner's name in the list of planners.
    pub planner: String,
    /// What tells it from others with the same planner.
    pub variant: String,
    /// The seed.
    pub seed: u64,
    /// `optimal`, `feasible`, `infeasible`, `unknown`; `declined` if the planner is not defined for
    /// the problem, `refused` if its answer did not pass the judge, `panicked`, `failed` if it is another
    /// program and did not answer as one should.
    pub outcome: String,
    /// Why it ended: `finished`, `iterations`, `evaluations`, `time`; empty without an answer.
    pub stop: String,
    /// The cost; for a team the length of the shortest plan.
    pub cost: Option<f64>,
    /// How long the path is.
    pub length: Option<f64>,
    /// The least distance from an obstacle.
    pub clearance: Option<f64>,
    /// Complete attempts.
    pub evaluations: u64,
    /// Iterations of the planner's main loop.
    pub iterations: u64,
    /// States settled, sampled or visited.
    pub expanded: u64,
    /// What else the planner had to say.
    pub notes: Vec<String>,
    /// By improvement: evaluations and expansions until then, and the cost.
    pub convergence: Vec<(u64, u64, f64)>,
    /// For a team the objectives of all plans: length, danger, turning.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub front: Vec<[f64; 3]>,
    /// Of all that the result depends on, and the number of repetitions, on which its times depend.
    pub fingerprint: String,
}

/// How long a run took, in microseconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Times {
    /// Planning.
    pub elapsed_us: f64,
    /// Until the first solution, if the planner says so.
    pub first_us: Option<f64>,
    /// Planning, and what it takes to put the question in the planner's terms and the answer in ours.
    pub latency_us: f64,
}

/// A line of `runs.jsonl`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Line {
    /// What it came to.
    #[serde(flatten)]
    pub record: Record,
    /// How long it took.
    #[serde(flatten)]
    pub times: Times,
}

/// What tells a run from all others; lines are sorted by it.
pub(crate) type Name<'r> = (&'r str, &'r str, &'r str, &'r str, u64);

impl Record {
    pub(crate) fn name(&self) -> Name<'_> {
        (
            &self.suite,
            &self.problem,
            &self.planner,
            &self.variant,
            self.seed,
        )
    }

    /// Whether there is a path.
    #[must_use]
    pub fn solved(&self) -> bool {
        self.cost.is_some()
    }

    /// Planner and variant, as tables say it.
    #[must_use]
    pub fn contender(&self) -> String {
        if self.variant.is_empty() {
            self.planner.clone()
        } else {
            format!("{} {}", self.planner, self.variant)
        }
    }
}
