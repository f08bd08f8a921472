//! What may be set, and what is refused.

use crate::bed::{Law, Rules};
use pf_core::{InvalidParams, Key, Params, params, words};
use pf_grid::SwarmRules;
use std::str::FromStr;

/// What an [`Rfd`](crate::Rfd) does.
///
/// The default takes the constants of public code by an author; the number of drops and the first
/// altitude are published nowhere and are ours.
#[derive(Clone, Debug, PartialEq)]
pub struct RfdParams {
    /// Drops an iteration: D.
    pub drops: usize,
    /// Iterations at most.
    pub iterations: u64,
    /// Iterations without a better path after which to stop; 0 for never.
    pub patience: u64,
    /// Steps of a drop at most; 0 for as many as there are free cells.
    pub steps: usize,
    /// The altitude of every cell but the goal at first: h0.
    pub altitude: f64,
    /// The weight of a flat step: delta of eq. 3.
    pub delta: f64,
    /// The weight of an uphill step, times its gradient: omega of eq. 2.
    pub omega: f64,
    /// How much a path is eroded: E of eq. 4.
    pub erosion: f64,
    /// Stands for the gradient in eq. 4 where a step is flat.
    pub flat_erosion: f64,
    /// Stands for the gradient in eq. 4 where a step goes uphill.
    pub uphill_erosion: f64,
    /// The share of its sediment that a drop leaves where it cannot go on.
    pub deposit: f64,
    /// By how much an iteration raises the probability that a drop may step uphill or stay level,
    /// drawn anew for each step; 1 allows it always.
    pub climb: f64,
    /// No cell rises above the first altitude: in the authors' code, not in the paper.
    pub clamp: bool,
    /// Threads; they change no result.
    pub threads: usize,
}

impl Default for RfdParams {
    fn default() -> Self {
        Self {
            drops: 50,
            iterations: 100,
            patience: 0,
            steps: 0,
            altitude: 10.0,
            delta: 0.1,
            omega: 0.005,
            erosion: 1.0,
            flat_erosion: 0.001,
            uphill_erosion: 0.0001,
            deposit: 1.0,
            climb: 0.01,
            clamp: false,
            threads: 1,
        }
    }
}

params!(RfdParams {
    drops: usize = "drops an iteration",
    iterations: u64 = "iterations at most",
    patience: u64 = "iterations without a better path after which to stop; 0 for never",
    steps: usize = "steps of a drop at most; 0 for as many as there are free cells",
    altitude: f64 = "altitude of every cell but the goal at first",
    delta: f64 = "weight of a flat step",
    omega: f64 = "weight of an uphill step, times its gradient",
    erosion: f64 = "how much a path is eroded",
    flat_erosion: f64 = "stands for the gradient in the erosion of a flat step",
    uphill_erosion: f64 = "stands for the gradient in the erosion of an uphill step",
    deposit: f64 = "share of its sediment that a drop leaves where it cannot go on",
    climb: f64 = "by how much an iteration raises the probability that a step may not go down",
    clamp: bool = "no cell rises above the first altitude",
    threads: usize = "threads; they change no result",
});

/// What an exponent of [`RfdStarParams::p_base`] is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slope {
    /// The gradient: the difference of the altitudes by the length of the step (the paper).
    Gradient,
    /// 100 times the difference of the altitudes by the first altitude (the authors' code).
    Percent,
}

/// How a cell's straight distance d to the goal weighs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pull {
    /// As 1 / d^alpha (the paper).
    Power,
    /// As 1 / alpha^d (the authors' code).
    Exponential,
}

/// By what erosion is divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Toll {
    /// (N - 1) D, for N cells and D drops (eq. 4 of the paper).
    Swarm,
    /// The steps of the drop's own path (the authors' code).
    Path,
}

words!(Slope { "gradient" = Gradient, "percent" = Percent });
words!(Pull { "power" = Power, "exponential" = Exponential });
words!(Toll { "swarm" = Swarm, "path" = Path });

/// What an [`RfdStar`](crate::RfdStar) does. The default is [`paper`](Self::paper).
#[derive(Clone, Debug, PartialEq)]
pub struct RfdStarParams {
    /// As in [`RfdParams`].
    pub drops: usize,
    /// As in [`RfdParams`].
    pub iterations: u64,
    /// As in [`RfdParams`].
    pub patience: u64,
    /// As in [`RfdParams`].
    pub steps: usize,
    /// As in [`RfdParams`].
    pub altitude: f64,
    /// The base of the exponential in the gradient: pBase of eq. 6.
    pub p_base: f64,
    /// What the exponent is.
    pub slope: Slope,
    /// How much nearness to the goal draws: alpha of eq. 6; 0 for not at all.
    pub alpha: f64,
    /// How it draws.
    pub pull: Pull,
    /// As in [`RfdParams`].
    pub erosion: f64,
    /// By what erosion is divided.
    pub toll: Toll,
    /// As in [`RfdParams`].
    pub deposit: f64,
    /// As in [`RfdParams`].
    pub climb: f64,
    /// As in [`RfdParams`].
    pub clamp: bool,
    /// Altitudes begin as the distances to the goal, found by one sweep of Dijkstra's algorithm.
    pub seeded: bool,
    /// As in [`RfdParams`].
    pub threads: usize,
}

impl RfdStarParams {
    /// As the paper has it. It gives no value of `p_base`, `alpha` and the first altitude: they
    /// are ours.
    #[must_use]
    pub fn paper() -> Self {
        Self {
            drops: 50,
            iterations: 100,
            patience: 0,
            steps: 0,
            altitude: 10.0,
            p_base: 2.0,
            slope: Slope::Gradient,
            alpha: 8.0,
            pull: Pull::Power,
            erosion: 1.0,
            toll: Toll::Swarm,
            deposit: 1.0,
            climb: 1.0,
            clamp: false,
            seeded: false,
            threads: 1,
        }
    }

    /// As public code by an author has it.
    #[must_use]
    pub fn authors_code() -> Self {
        Self {
            // 5^(1/100)
            p_base: 1.016_224_591_254_408_7,
            slope: Slope::Percent,
            alpha: 5.0,
            pull: Pull::Exponential,
            toll: Toll::Path,
            deposit: 0.0,
            climb: 0.01,
            clamp: true,
            ..Self::paper()
        }
    }

    /// Altitudes that begin as the distances to the goal: the paper proposes Dijkstra or A* for the
    /// first iteration as future work, and this is our reading of it. The slope alone leads.
    #[must_use]
    pub fn seeded() -> Self {
        Self {
            p_base: 1e16,
            alpha: 0.0,
            erosion: 1e-16,
            deposit: 0.0,
            seeded: true,
            ..Self::paper()
        }
    }
}

impl Default for RfdStarParams {
    fn default() -> Self {
        Self::paper()
    }
}

const fn key(name: &'static str, about: &'static str) -> Key {
    Key { name, about }
}

fn read<T: FromStr>(into: &mut T, key: &str, value: &str) -> Result<(), InvalidParams> {
    let kind = std::any::type_name::<T>();
    let kind = kind.rsplit("::").next().unwrap_or(kind);
    *into = value
        .parse()
        .map_err(|_| InvalidParams::bad(key, value, format!("a value of type {kind}")))?;
    Ok(())
}

/// By name there is one parameter more: `variant` sets all the others.
impl Params for RfdStarParams {
    const KEYS: &'static [Key] = &[
        key(
            "variant",
            "sets all the others: paper, authors-code or seeded",
        ),
        key("drops", "drops an iteration"),
        key("iterations", "iterations at most"),
        key(
            "patience",
            "iterations without a better path after which to stop; 0 for never",
        ),
        key(
            "steps",
            "steps of a drop at most; 0 for as many as there are free cells",
        ),
        key("altitude", "altitude of every cell but the goal at first"),
        key("p_base", "base of the exponential in the gradient"),
        key("slope", "what the exponent is: gradient or percent"),
        key(
            "alpha",
            "how much nearness to the goal draws; 0 for not at all",
        ),
        key("pull", "how it draws: power or exponential"),
        key("erosion", "how much a path is eroded"),
        key("toll", "by what erosion is divided: swarm or path"),
        key(
            "deposit",
            "share of its sediment that a drop leaves where it cannot go on",
        ),
        key(
            "climb",
            "by how much an iteration raises the probability that a step may not go down",
        ),
        key("clamp", "no cell rises above the first altitude"),
        key("seeded", "altitudes begin as the distances to the goal"),
        key("threads", "threads; they change no result"),
    ];

    fn set(&mut self, key: &str, value: &str) -> Result<(), InvalidParams> {
        match key {
            "variant" => {
                *self = match value {
                    "paper" => Self::paper(),
                    "authors-code" => Self::authors_code(),
                    "seeded" => Self::seeded(),
                    _ => {
                        let expected = "paper, authors-code or seeded";
                        return Err(InvalidParams::bad(key, value, expected));
                    }
                };
                Ok(())
            }
            "drops" => read(&mut self.drops, key, value),
            "iterations" => read(&mut self.iterations, key, value),
            "patience" => read(&mut self.patience, key, value),
            "steps" => read(&mut self.steps, key, value),
            "altitude" => read(&mut self.altitude, key, value),
            "p_base" => read(&mut self.p_base, key, value),
            "slope" => read(&mut self.slope, key, value),
            "alpha" => read(&mut self.alpha, key, value),
            "pull" => read(&mut self.pull, key, value),
            "erosion" => read(&mut self.erosion, key, value),
            "toll" => read(&mut self.toll, key, value),
            "deposit" => read(&mut self.deposit, key, value),
            "climb" => read(&mut self.climb, key, value),
            "clamp" => read(&mut self.clamp, key, value),
            "seeded" => read(&mut self.seeded, key, value),
            "threads" => read(&mut self.threads, key, value),
            _ => Err(InvalidParams::unknown::<Self>(key)),
        }
    }
}

const POSITIVE: &str = "a positive number";
const NOT_NEGATIVE: &str = "a number from 0";
const SHARE: &str = "a number from 0 to 1";

fn positive(x: f64) -> bool {
    x > 0.0 && x.is_finite()
}

fn not_negative(x: f64) -> bool {
    x >= 0.0 && x.is_finite()
}

fn share(x: f64) -> bool {
    (0.0..=1.0).contains(&x)
}

fn check_swarm(drops: usize, iterations: u64, threads: usize) -> Result<(), InvalidParams> {
    InvalidParams::unless_whole("drops", drops, 1..=65_536)?;
    InvalidParams::unless(
        "iterations",
        iterations,
        iterations > 0,
        "a whole number from 1",
    )?;
    InvalidParams::unless_whole("threads", threads, 1..=256)
}

impl RfdParams {
    pub(crate) fn check(&self) -> Result<(), InvalidParams> {
        let Self {
            altitude,
            delta,
            omega,
            erosion,
            flat_erosion,
            uphill_erosion,
            deposit,
            climb,
            ..
        } = *self;
        check_swarm(self.drops, self.iterations, self.threads)?;
        InvalidParams::unless("altitude", altitude, positive(altitude), POSITIVE)?;
        InvalidParams::unless("delta", delta, not_negative(delta), NOT_NEGATIVE)?;
        InvalidParams::unless("omega", omega, not_negative(omega), NOT_NEGATIVE)?;
        InvalidParams::unless("erosion", erosion, not_negative(erosion), NOT_NEGATIVE)?;
        InvalidParams::unless(
            "flat_erosion",
            flat_erosion,
            not_negative(flat_erosion),
            NOT_NEGATIVE,
        )?;
        InvalidParams::unless(
            "uphill_erosion",
            uphill_erosion,
            not_negative(uphill_erosion),
            NOT_NEGATIVE,
        )?;
        InvalidParams::unless("deposit", deposit, share(deposit), SHARE)?;
        InvalidParams::unless("climb", climb, share(climb), SHARE)
    }

    pub(crate) fn bed(&self) -> Rules {
        Rules {
            altitude: self.altitude,
            law: Law::Linear {
                delta: self.delta,
                omega: self.omega,
                flat: self.flat_erosion,
                uphill: self.uphill_erosion,
            },
            alpha: 0.0,
            pull: Pull::Power,
            erosion: self.erosion,
            toll: Toll::Swarm,
            deposit: self.deposit,
            climb: self.climb,
            clamp: self.clamp,
            seeded: false,
            swarm: swarm(
                self.drops,
                self.iterations,
                self.patience,
                self.steps,
                self.threads,
            ),
        }
    }
}

impl RfdStarParams {
    pub(crate) fn check(&self) -> Result<(), InvalidParams> {
        let Self {
            altitude,
            p_base,
            alpha,
            erosion,
            deposit,
            climb,
            ..
        } = *self;
        check_swarm(self.drops, self.iterations, self.threads)?;
        InvalidParams::unless("altitude", altitude, positive(altitude), POSITIVE)?;
        let fine = p_base > 0.0 && p_base <= 1e30;
        InvalidParams::unless("p_base", p_base, fine, "a number above 0, up to 1e30")?;
        InvalidParams::unless(
            "alpha",
            alpha,
            (0.0..=64.0).contains(&alpha),
            "a number from 0 to 64",
        )?;
        InvalidParams::unless("erosion", erosion, not_negative(erosion), NOT_NEGATIVE)?;
        InvalidParams::unless("deposit", deposit, share(deposit), SHARE)?;
        InvalidParams::unless("climb", climb, share(climb), SHARE)
    }

    pub(crate) fn bed(&self) -> Rules {
        Rules {
            altitude: self.altitude,
            law: Law::Exponential {
                log_base: self.p_base.log2(),
                slope: self.slope,
            },
            alpha: self.alpha,
            pull: self.pull,
            erosion: self.erosion,
            toll: self.toll,
            deposit: self.deposit,
            climb: self.climb,
            clamp: self.clamp,
            seeded: self.seeded,
            swarm: swarm(
                self.drops,
                self.iterations,
                self.patience,
                self.steps,
                self.threads,
            ),
        }
    }
}

fn swarm(
    walkers: usize,
    iterations: u64,
    patience: u64,
    steps: usize,
    threads: usize,
) -> SwarmRules {
    SwarmRules {
        walkers,
        iterations,
        patience,
        steps,
        threads,
        remember: false,
    }
}
