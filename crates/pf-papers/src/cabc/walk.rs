//! Walks of bees as the paper counts them, and as the judge does.

use crate::PaperError;
use pf_abc::{AbcParams, Check, Colony};
use pf_core::{Clock, Context, LocalPlanner, Observable, Problem, Step};
use pf_geom::{Observation, Point, WorldProblem};

/// How near the goal a walk of the paper's has arrived, in units of its maps (ours, the paper does
/// not say).
const NEAR: f64 = 1.0;

/// One walk.
#[derive(Clone, Debug)]
pub struct Trip {
    /// The places visited, the start first.
    pub trail: Vec<Point>,
    /// Whether it got to the goal.
    pub arrived: bool,
    /// How many decisions that took.
    pub steps: u32,
    /// Seconds.
    pub seconds: f64,
}

/// Walks through a world. Nothing keeps the robot from a step through a wall: that is what the judge
/// is asked for afterwards.
///
/// # Errors
/// [`PaperError::Data`] if the parameters make no sense.
pub fn walk(problem: &WorldProblem, params: &AbcParams, seed: u64) -> Result<Trip, PaperError> {
    let broken = |error: pf_core::InvalidParams| PaperError::Data(error.to_string());
    let mut colony = Colony::new(params.clone()).map_err(broken)?;
    let sensor = LocalPlanner::<WorldProblem>::sensor(&colony);
    let near = match params.check {
        Check::Segment => 0.0,
        Check::Point => NEAR,
    };
    let clock = Clock::default();
    let began = clock.now();
    let mut cx = Context::seeded(seed);
    let mut view = Observation::default();
    let mut trip = Trip {
        trail: vec![problem.start()],
        arrived: false,
        steps: 0,
        seconds: 0.0,
    };
    loop {
        let at = trip.trail[trip.trail.len() - 1];
        trip.arrived = problem.arrived(&at) || (at - problem.goal()).norm() <= near;
        if trip.arrived {
            break;
        }
        problem.observe(&at, &sensor, &mut view);
        match colony.step(&view, &mut cx) {
            Step::To(next) => trip.trail.push(next),
            Step::Stay => {}
            Step::GiveUp => break,
        }
        trip.steps += 1;
    }
    trip.seconds = clock.now().saturating_sub(began).as_secs_f64();
    Ok(trip)
}

impl Trip {
    /// How long the way was.
    #[must_use]
    pub fn length(&self) -> f64 {
        let steps = self.trail.windows(2).map(|pair| (pair[1] - pair[0]).norm());
        steps.sum()
    }

    /// Whether the judge takes the way, its last piece to the goal included.
    #[must_use]
    pub fn is_legal(&self, problem: &WorldProblem) -> bool {
        let mut path = self.trail.clone();
        path.push(problem.goal());
        self.arrived && problem.judge(&path).is_ok()
    }
}

/// What many walks came to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tally {
    /// How many there were.
    pub runs: u32,
    /// How many arrived.
    pub target: u32,
    /// How many of these the judge takes.
    pub legal: u32,
    /// How long the ways of those that arrived were.
    pub lengths: Vec<f64>,
    /// The most steps of one that arrived.
    pub most_steps: u32,
    /// Seconds, of all.
    pub seconds: f64,
}

impl Tally {
    /// Counts a walk.
    pub fn count(&mut self, problem: &WorldProblem, trip: &Trip) {
        self.runs += 1;
        self.seconds += trip.seconds;
        if trip.arrived {
            self.target += 1;
            self.legal += u32::from(trip.is_legal(problem));
            self.lengths.push(trip.length());
            self.most_steps = self.most_steps.max(trip.steps);
        }
    }

    /// The mean length of the walks that arrived and its standard deviation.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "a number of walks")]
    pub fn length(&self) -> Option<[f64; 2]> {
        let n = self.lengths.len() as f64;
        let mean = self.lengths.iter().sum::<f64>() / n;
        let squares = self.lengths.iter().map(|x| (x - mean).powi(2));
        let deviation = (squares.sum::<f64>() / n).sqrt();
        (!self.lengths.is_empty()).then_some([mean, deviation])
    }
}
