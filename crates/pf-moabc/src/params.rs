//! What can be set.

use pf_core::{InvalidParams, params};
use std::ops::RangeInclusive;

/// What all algorithms have in common.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Common {
    pub(crate) population: usize,
    pub(crate) evaluations: u64,
    pub(crate) step: f64,
    pub(crate) fan: f64,
    pub(crate) noise: f64,
    pub(crate) archive: usize,
    pub(crate) patience: u64,
    pub(crate) threads: usize,
}

/// A set of parameters: those of its own and those all have, with defaults and words for both.
macro_rules! front_params {
    ($(#[$doc:meta])* $name:ident { $($field:ident: $kind:ty = $default:expr, $about:literal;)* }) => {
        $(#[$doc])*
        #[derive(Clone, Debug, PartialEq)]
        pub struct $name {
            $(#[doc = concat!("The ", $about, ".")] pub $field: $kind,)*
            /// The size of the population.
            pub population: usize,
            /// The number of plans to look at.
            pub evaluations: u64,
            /// The length of a step, in the world's unit; 0 for a twentieth of the longest straight
            /// way.
            pub step: f64,
            /// The widest opening of the arcs to begin with, in radians; 0 to begin anywhere.
            pub fan: f64,
            /// The noise on the arcs to begin with, in radians.
            pub noise: f64,
            /// The most plans to report.
            pub archive: usize,
            /// The number of cycles without a plan after which the baseline is asked; 0 for only in
            /// the end.
            pub patience: u64,
            /// The number of threads; results do not depend on it.
            pub threads: usize,
        }

        impl Default for $name {
            fn default() -> Self {
                Self {
                    $($field: $default,)*
                    population: 100,
                    evaluations: 20_000,
                    step: 0.0,
                    fan: 1.4,
                    noise: 0.2,
                    archive: 2000,
                    patience: 20,
                    threads: 1,
                }
            }
        }

        params!($name {
            $($field: $kind = $about,)*
            population: usize = "size of the population",
            evaluations: u64 = "number of plans to look at",
            step: f64 = "length of a step; 0 for a twentieth of the longest straight way",
            fan: f64 = "widest opening of the arcs to begin with, in radians; 0 to begin anywhere",
            noise: f64 = "noise on the arcs to begin with, in radians",
            archive: usize = "most plans to report",
            patience: u64 = "cycles without a plan after which the baseline is asked; 0 for the end",
            threads: usize = "threads; they change no result",
        });

        impl $name {
            /// What it has in common with the others.
            pub(crate) fn common(&self) -> Common {
                Common {
                    population: self.population,
                    evaluations: self.evaluations,
                    step: self.step,
                    fan: self.fan,
                    noise: self.noise,
                    archive: self.archive,
                    patience: self.patience,
                    threads: self.threads,
                }
            }
        }
    };
}

front_params! {
    /// How [`Moabc`](crate::Moabc) plans. The default is ours, [`paper`](Self::paper) the paper's
    /// new algorithm, [`classic`](Self::classic) the one it compares that with.
    MoabcParams {
        share: f64 = 0.5, "share of the numbers that a bee changes";
        limit: u32 = 100, "number of failures after which a source outside the first front is given up";
        mending: f64 = 0.0, "share of the bees that straighten a stretch of a way";
        rules: Rules = Rules::Ours, "rules: ours, paper or classic";
    }
}

front_params! {
    /// How [`Nsga2`](crate::Nsga2) plans.
    Nsga2Params {
        crossover: f64 = 0.9, "probability of crossover";
        crossover_index: f64 = 15.0, "distribution index of simulated binary crossover";
        mutation: f64 = 0.0, "probability that a number mutates; 0 for one number a plan";
        mutation_index: f64 = 20.0, "distribution index of polynomial mutation";
    }
}

front_params! {
    /// How [`Moead`](crate::Moead) plans.
    MoeadParams {
        neighbours: usize = 20, "number of neighbours of a subproblem";
        scale: f64 = 0.5, "scale of the difference that a move adds";
        local: f64 = 0.9, "probability that parents are neighbours";
        replaced: usize = 2, "most plans that a child takes the place of";
        mutation: f64 = 0.0, "probability that a number mutates; 0 for one number a plan";
        mutation_index: f64 = 20.0, "distribution index of polynomial mutation";
    }
}

front_params! {
    /// How [`RandomSearch`](crate::RandomSearch) plans.
    RandomSearchParams {}
}

/// How [`Prioritised`](crate::Prioritised) plans.
#[derive(Clone, Debug, PartialEq)]
pub struct PrioritisedParams {
    /// The number of cells along the longer side of the world.
    pub cells: usize,
    /// The number of orders of the robots to try.
    pub attempts: usize,
}

impl Default for PrioritisedParams {
    fn default() -> Self {
        Self {
            cells: 100,
            attempts: 20,
        }
    }
}

params!(PrioritisedParams {
    cells: usize = "number of cells along the longer side of the world",
    attempts: usize = "number of orders of the robots to try",
});

impl PrioritisedParams {
    pub(crate) fn check(&self) -> Result<(), InvalidParams> {
        InvalidParams::unless_whole("cells", self.cells, 2..=1000)?;
        InvalidParams::unless_whole("attempts", self.attempts, 1..=100_000)
    }
}

/// Whose bees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rules {
    /// Scouts first; what is in the first front is not given up.
    Ours,
    /// Every source that failed too often is given up (eq. 5).
    Paper,
    /// Section II: bees update sources as they go, and an external archive leads them.
    Classic,
}

impl std::str::FromStr for Rules {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        match text {
            "ours" => Ok(Self::Ours),
            "paper" => Ok(Self::Paper),
            "classic" => Ok(Self::Classic),
            _ => Err(()),
        }
    }
}

impl MoabcParams {
    /// The paper's new algorithm: numbers begin anywhere within their bounds (eq. 2), bees change
    /// all of them (eq. 3), every source that failed too often is given up (eq. 5). Bounds and limit
    /// are not published; they are as in the default.
    #[must_use]
    pub fn paper() -> Self {
        Self {
            share: 1.0,
            rules: Rules::Paper,
            fan: 0.0,
            ..Self::default()
        }
    }

    /// A variant of ours: most bees change less and straighten a stretch of a way besides. Unlike the
    /// others' moves this one knows what the numbers mean.
    #[must_use]
    pub fn mending() -> Self {
        Self {
            mending: 0.8,
            share: 0.3,
            ..Self::default()
        }
    }

    /// The algorithm the paper starts from (Section II): bees update sources as they go, and
    /// onlookers are led by an external archive that is sorted anew for each of them.
    #[must_use]
    pub fn classic() -> Self {
        Self {
            rules: Rules::Classic,
            ..Self::paper()
        }
    }

    pub(crate) fn check(&self) -> Result<(), InvalidParams> {
        number("share", self.share, 0.0..=1.0)?;
        number("mending", self.mending, 0.0..=1.0)?;
        self.common().check()
    }
}

impl Nsga2Params {
    pub(crate) fn check(&self) -> Result<(), InvalidParams> {
        number("crossover", self.crossover, 0.0..=1.0)?;
        number("crossover_index", self.crossover_index, 0.0..=1000.0)?;
        number("mutation", self.mutation, 0.0..=1.0)?;
        number("mutation_index", self.mutation_index, 0.0..=1000.0)?;
        self.common().check()
    }
}

impl MoeadParams {
    pub(crate) fn check(&self) -> Result<(), InvalidParams> {
        InvalidParams::unless_whole("neighbours", self.neighbours, 3..=100_000)?;
        InvalidParams::unless_whole("replaced", self.replaced, 1..=100_000)?;
        number("scale", self.scale, 0.0..=10.0)?;
        number("local", self.local, 0.0..=1.0)?;
        number("mutation", self.mutation, 0.0..=1.0)?;
        number("mutation_index", self.mutation_index, 0.0..=1000.0)?;
        self.common().check()
    }
}

impl RandomSearchParams {
    pub(crate) fn check(&self) -> Result<(), InvalidParams> {
        self.common().check()
    }
}

impl Common {
    /// Refuses what makes no sense.
    fn check(&self) -> Result<(), InvalidParams> {
        InvalidParams::unless_whole("population", self.population, 4..=100_000)?;
        InvalidParams::unless_whole("archive", self.archive, 1..=100_000)?;
        InvalidParams::unless_whole("threads", self.threads, 1..=256)?;
        number("step", self.step, 0.0..=f64::MAX)?;
        number("fan", self.fan, 0.0..=std::f64::consts::PI)?;
        number("noise", self.noise, 0.0..=std::f64::consts::PI)
    }
}

fn number(key: &str, value: f64, range: RangeInclusive<f64>) -> Result<(), InvalidParams> {
    if range.contains(&value) {
        return Ok(());
    }
    let expected = match *range.end() {
        f64::MAX => format!("a number from {}", range.start()),
        end => format!("a number from {} to {end}", range.start()),
    };
    Err(InvalidParams::bad(key, &value.to_string(), expected))
}
