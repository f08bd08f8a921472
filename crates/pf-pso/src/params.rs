//! What can be set.

use pf_core::{InvalidParams, params, words};

/// What a path should not enter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Zones {
    /// The obstacle itself, grown by the robot's radius and the clearance.
    Shapes,
    /// The circle about the obstacle's middle that holds all of it, grown by the clearance (eq. 4).
    Circles,
}

/// What entering it costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Penalty {
    /// As much for every segment that does (eq. 3).
    Crossing,
    /// In proportion to the length inside, so that less is better.
    Length,
}

/// How a [`Pso`](crate::Pso) plans. The default is ours, [`paper`](Self::paper) the paper's.
#[derive(Clone, Debug, PartialEq)]
pub struct PsoParams {
    /// How many particles.
    pub particles: usize,
    /// How many waypoints each has.
    pub waypoints: usize,
    /// How often they move.
    pub iterations: u64,
    /// How strongly they are drawn to the best place of their own.
    pub c1: f64,
    /// How strongly they are drawn to the best place of all.
    pub c2: f64,
    /// The share of its velocity that a particle keeps, in the beginning.
    pub inertia_max: f64,
    /// The same in the end; in between it falls evenly.
    pub inertia_min: f64,
    /// How far from obstacles danger begins, in the world's unit.
    pub clearance: f64,
    /// What is dangerous.
    pub zones: Zones,
    /// What that costs.
    pub penalty: Penalty,
    /// How much: for each segment, or for each unit of length.
    pub weight: f64,
}

impl Default for PsoParams {
    /// Particles trust themselves more than the leader, so that they do not all gather on the side of an
    /// obstacle where it happens to be. Both weights were tuned on quadrant scenes 0 to 599 and on 60
    /// random worlds each with 5, 10 and 20 shapes; scenes from 100,000 on were held out.
    fn default() -> Self {
        Self {
            c1: 2.5,
            c2: 0.5,
            zones: Zones::Shapes,
            penalty: Penalty::Length,
            ..Self::paper()
        }
    }
}

params!(PsoParams {
    particles: usize = "how many particles",
    waypoints: usize = "how many waypoints each has",
    iterations: u64 = "how often they move",
    c1: f64 = "how strongly they are drawn to the best place of their own",
    c2: f64 = "how strongly they are drawn to the best place of all",
    inertia_max: f64 = "the share of its velocity a particle keeps, in the beginning",
    inertia_min: f64 = "the same in the end",
    clearance: f64 = "how far from obstacles danger begins",
    zones: Zones = "shapes (obstacles, grown), or circles (about each, the paper's)",
    penalty: Penalty = "length (in proportion to the length inside), or crossing (the paper's)",
    weight: f64 = "what a segment, or a unit of length, in danger costs",
});

impl PsoParams {
    /// The paper's.
    #[must_use]
    pub fn paper() -> Self {
        Self {
            particles: 20,
            waypoints: 2,
            iterations: 150,
            c1: 1.5,
            c2: 2.5,
            inertia_max: 0.9,
            inertia_min: 0.4,
            clearance: 0.8,
            zones: Zones::Circles,
            penalty: Penalty::Crossing,
            weight: 999.0,
        }
    }

    /// The share of its velocity that a particle keeps in an iteration, from 0.
    pub(crate) fn inertia(&self, iteration: u64) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "numbers of iterations")]
        let gone = iteration as f64 / self.iterations.saturating_sub(1).max(1) as f64;
        self.inertia_max + (self.inertia_min - self.inertia_max) * gone
    }

    /// Refuses what makes no sense.
    pub(crate) fn check(&self) -> Result<(), InvalidParams> {
        InvalidParams::unless_whole("particles", self.particles, 1..=1_000_000)?;
        InvalidParams::unless_whole("waypoints", self.waypoints, 0..=1_000_000)?;
        let numbers = (self.particles as u64).saturating_mul(self.waypoints as u64);
        if numbers > 100_000_000 {
            let expected = format!(
                "at most {} with so many particles",
                100_000_000 / self.particles
            );
            let value = self.waypoints.to_string();
            return Err(InvalidParams::bad("waypoints", &value, expected));
        }
        for (key, value) in [
            ("c1", self.c1),
            ("c2", self.c2),
            ("inertia_max", self.inertia_max),
            ("inertia_min", self.inertia_min),
            ("clearance", self.clearance),
            ("weight", self.weight),
        ] {
            let fine = value >= 0.0 && value.is_finite();
            InvalidParams::unless(key, value, fine, "a number from 0")?;
        }
        Ok(())
    }
}

words!(Zones { "shapes" = Shapes, "circles" = Circles });
words!(Penalty { "crossing" = Crossing, "length" = Length });
