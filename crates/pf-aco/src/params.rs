//! What may be set, and what is refused.

use pf_core::{InvalidParams, params};
use pf_grid::SwarmRules;

/// What an [`Aco`](crate::Aco) does. None of the values is published.
#[derive(Clone, Debug, PartialEq)]
pub struct AcoParams {
    /// Ants an iteration: m.
    pub ants: usize,
    /// Iterations at most.
    pub iterations: u64,
    /// Iterations without a better path after which to stop; 0 for never.
    pub patience: u64,
    /// Steps of an ant at most; 0 for as many as there are free cells.
    pub steps: usize,
    /// What an ant that arrives deposits on each of its edges, times the length of its path: Q
    /// of eq. 8.
    pub q: f64,
    /// The share of the pheromone that evaporates in an iteration: rho of eq. 9.
    pub rho: f64,
    /// Pheromone on every edge at first: tau0.
    pub tau0: f64,
    /// An ant does not step where it has been.
    pub tabu: bool,
    /// Trail limits of the MAX-MIN Ant System (Stuetzle and Hoos 2000).
    pub limits: bool,
    /// An ant deposits on its loops too.
    pub loops: bool,
    /// Threads; they change no result.
    pub threads: usize,
}

impl Default for AcoParams {
    fn default() -> Self {
        Self {
            ants: 50,
            iterations: 100,
            patience: 0,
            steps: 0,
            q: 100.0,
            rho: 0.1,
            tau0: 1.0,
            tabu: false,
            limits: false,
            loops: true,
            threads: 1,
        }
    }
}

params!(AcoParams {
    ants: usize = "ants an iteration",
    iterations: u64 = "iterations at most",
    patience: u64 = "iterations without a better path after which to stop; 0 for never",
    steps: usize = "steps of an ant at most; 0 for as many as there are free cells",
    q: f64 = "what an ant deposits on an edge, times the length of its path",
    rho: f64 = "share of the pheromone that evaporates in an iteration",
    tau0: f64 = "pheromone on every edge at first",
    tabu: bool = "an ant does not step where it has been",
    limits: bool = "trail limits of the MAX-MIN Ant System",
    loops: bool = "an ant deposits on its loops too",
    threads: usize = "threads; they change no result",
});

/// What an [`AcoStar`](crate::AcoStar) does. None of the values is published.
#[derive(Clone, Debug, PartialEq)]
pub struct AcoStarParams {
    /// How much a cell's nearness to the goal draws: the exponent of the straight distance.
    pub alpha: f64,
    /// As in [`AcoParams`].
    pub ants: usize,
    /// As in [`AcoParams`].
    pub iterations: u64,
    /// As in [`AcoParams`].
    pub patience: u64,
    /// As in [`AcoParams`].
    pub steps: usize,
    /// As in [`AcoParams`].
    pub q: f64,
    /// As in [`AcoParams`].
    pub rho: f64,
    /// As in [`AcoParams`].
    pub tau0: f64,
    /// As in [`AcoParams`].
    pub tabu: bool,
    /// As in [`AcoParams`].
    pub limits: bool,
    /// As in [`AcoParams`].
    pub loops: bool,
    /// As in [`AcoParams`].
    pub threads: usize,
}

impl Default for AcoStarParams {
    fn default() -> Self {
        let AcoParams {
            ants,
            iterations,
            patience,
            steps,
            q,
            rho,
            tau0,
            tabu,
            limits,
            loops,
            threads,
        } = AcoParams::default();
        Self {
            alpha: 8.0,
            ants,
            iterations,
            patience,
            steps,
            q,
            rho,
            tau0,
            tabu,
            limits,
            loops,
            threads,
        }
    }
}

params!(AcoStarParams {
    alpha: f64 = "exponent of the straight distance to the goal",
    ants: usize = "ants an iteration",
    iterations: u64 = "iterations at most",
    patience: u64 = "iterations without a better path after which to stop; 0 for never",
    steps: usize = "steps of an ant at most; 0 for as many as there are free cells",
    q: f64 = "what an ant deposits on an edge, times the length of its path",
    rho: f64 = "share of the pheromone that evaporates in an iteration",
    tau0: f64 = "pheromone on every edge at first",
    tabu: bool = "an ant does not step where it has been",
    limits: bool = "trail limits of the MAX-MIN Ant System",
    loops: bool = "an ant deposits on its loops too",
    threads: usize = "threads; they change no result",
});

impl AcoStarParams {
    /// The part that both planners have.
    pub(crate) fn common(&self) -> AcoParams {
        AcoParams {
            ants: self.ants,
            iterations: self.iterations,
            patience: self.patience,
            steps: self.steps,
            q: self.q,
            rho: self.rho,
            tau0: self.tau0,
            tabu: self.tabu,
            limits: self.limits,
            loops: self.loops,
            threads: self.threads,
        }
    }
}

impl AcoParams {
    pub(crate) fn check(&self) -> Result<(), InvalidParams> {
        let positive = |x: f64| x > 0.0 && x.is_finite();
        let number = "a positive number";
        InvalidParams::unless_whole("ants", self.ants, 1..=65_536)?;
        InvalidParams::unless(
            "iterations",
            self.iterations,
            self.iterations > 0,
            "a whole number from 1",
        )?;
        InvalidParams::unless("q", self.q, positive(self.q), number)?;
        InvalidParams::unless(
            "rho",
            self.rho,
            (0.0..=1.0).contains(&self.rho),
            "a number from 0 to 1",
        )?;
        InvalidParams::unless("tau0", self.tau0, positive(self.tau0), number)?;
        InvalidParams::unless_whole("threads", self.threads, 1..=256)
    }

    pub(crate) fn rules(&self) -> SwarmRules {
        SwarmRules {
            walkers: self.ants,
            iterations: self.iterations,
            patience: self.patience,
            steps: self.steps,
            threads: self.threads,
            remember: self.tabu,
        }
    }
}
