//! L-BFGS with Armijo's backtracking, as published: by the paper's rules, or by its code's.

use crate::{
    memory::{Memory, dot},
    params::{LbfgsParams, Rules},
    potential::Potential,
};
use pf_core::{Context, PlanRng};
use pf_geom::{Point, WorldProblem};
use std::collections::VecDeque;

/// The paper's iteration by number from which on it may end.
const EARLIEST: u64 = 20;
/// How many losses the rule to end looks at.
const WINDOW: usize = 10;
/// The code tries so many steps, each half the one before, and takes the next untried.
const TRIES: u32 = 4;
/// Steps below this are nothing.
const SHORTEST: f64 = 1e-12;

/// A minimisation in the making; its memory is kept from plan to plan.
#[derive(Clone, Debug, Default)]
pub(crate) struct Descent {
    /// x and y of all points by turns, both ends included; so in the others.
    pub(crate) path: Vec<f64>,
    trial: Vec<f64>,
    gradient: Vec<f64>,
    after: Vec<f64>,
    direction: Vec<f64>,
    memory: Memory,
    losses: VecDeque<f64>,
    /// The weight of the obstacles in the next iteration.
    pub(crate) lambda: f64,
}

/// How a descent by the published rules ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Descended {
    /// The last loss.
    pub loss: f64,
    /// The weight of the obstacles in it.
    pub lambda: f64,
    /// How many iterations it took.
    pub iterations: u64,
}

impl Descent {
    /// Puts `points` inner points evenly on the straight line.
    pub(crate) fn straight(&mut self, start: Point, goal: Point, points: usize) {
        self.path.clear();
        for k in 0..=points + 1 {
            #[expect(clippy::cast_precision_loss, reason = "numbers of points")]
            let t = k as f64 / (points + 1) as f64;
            let at = start + (goal - start) * t;
            self.path.extend([at.x, at.y]);
        }
    }

    /// Puts the ends elsewhere; the inner points stay where they are.
    pub(crate) fn move_ends(&mut self, start: Point, goal: Point) {
        let size = self.path.len();
        self.path[..2].copy_from_slice(&[start.x, start.y]);
        self.path[size - 2..].copy_from_slice(&[goal.x, goal.y]);
    }

    /// The weight of the obstacles of a cold start: 0.1; the code's is one further.
    pub(crate) fn reset_lambda(&mut self, params: &LbfgsParams) {
        let first = if params.rules == Rules::PublishedCode {
            1.1
        } else {
            0.1
        };
        self.lambda = f64::min(first, params.lambda_obs);
    }

    /// Minimises from the path as it is. One iteration is one step.
    pub(crate) fn run(
        &mut self,
        potential: &Potential,
        params: &LbfgsParams,
        cx: &mut Context<'_, WorldProblem>,
    ) -> Descended {
        let size = self.path.len();
        for buffer in [&mut self.trial, &mut self.gradient, &mut self.after] {
            buffer.clear();
            buffer.resize(size, 0.0);
        }
        self.direction.clear();
        self.direction.resize(size - 4, 0.0);
        self.memory.reset(size - 4, params.memory);
        self.losses.clear();
        self.trial.copy_from_slice(&self.path);
        let code = params.rules == Rules::PublishedCode;
        let inner = 2..size - 2;
        let mut ended = Descended {
            loss: f64::INFINITY,
            lambda: self.lambda,
            iterations: 0,
        };
        while ended.iterations < params.iterations && cx.proceed() {
            ended.iterations += 1;
            let lambda = self.lambda;
            let loss = |path: &[f64], gradient: &mut [f64], rng: Option<&mut PlanRng>| {
                if code {
                    let margin = params.margin;
                    potential.loss_of_published_code(path, lambda, margin, gradient, rng)
                } else {
                    potential.loss_in_lanes(path, lambda, gradient)
                }
            };
            // At the same weight the last step has found both; the code's noise is another each time.
            let here = if !code && ended.iterations > 1 && lambda <= ended.lambda {
                std::mem::swap(&mut self.gradient, &mut self.after);
                ended.loss
            } else {
                loss(&self.path, &mut self.gradient, Some(cx.rng()))
            };
            self.memory
                .direction(&self.gradient[inner.clone()], &mut self.direction);
            let slope = dot(&self.gradient[inner.clone()], &self.direction);
            let mut step = 1.0;
            let mut tries = 0;
            let there = loop {
                for (k, d) in inner.clone().zip(&self.direction) {
                    self.trial[k] = self.path[k] + step * d;
                }
                let there = loss(&self.trial, &mut self.after, Some(cx.rng()));
                cx.evaluated(1);
                let enough = there <= here + params.armijo * step * slope;
                if enough || step < SHORTEST || code && tries >= TRIES {
                    break there;
                }
                step /= 2.0;
                tries += 1;
            };
            self.memory.keep(
                &self.path[inner.clone()],
                &self.trial[inner.clone()],
                &self.gradient[inner.clone()],
                &self.after[inner.clone()],
            );
            std::mem::swap(&mut self.path, &mut self.trial);
            cx.candidate(|| points(&self.path).collect());
            (ended.loss, ended.lambda) = (there, lambda);
            self.lambda = (lambda + 1.0).min(params.lambda_obs);
            self.losses.push_back(there);
            if self.losses.len() > WINDOW {
                self.losses.pop_front();
            }
            if self.is_settled(ended.iterations, code, params.spread) {
                break;
            }
        }
        if code && ended.iterations > 0 {
            // It states the loss with the weight that the next iteration would have had.
            ended.lambda = self.lambda;
            let (path, margin) = (&self.path, params.margin);
            ended.loss = potential.loss_of_published_code(
                path,
                self.lambda,
                margin,
                &mut self.gradient,
                None,
            );
        }
        ended
    }

    /// Whether the last losses differ so little that this is the end.
    fn is_settled(&self, iterations: u64, code: bool, spread: f64) -> bool {
        // The code leaves the newest out.
        let seen = if code { WINDOW - 1 } else { WINDOW };
        if iterations <= EARLIEST || self.losses.len() < WINDOW {
            return false;
        }
        let losses = self.losses.iter().take(seen);
        #[expect(clippy::cast_precision_loss, reason = "ten at most")]
        let count = seen as f64;
        let mean = losses.clone().sum::<f64>() / count;
        let variance = losses.map(|loss| (loss - mean).powi(2)).sum::<f64>() / count;
        variance.sqrt() < spread
    }
}

/// A flat path as points.
pub(crate) fn points(path: &[f64]) -> impl Iterator<Item = Point> + '_ {
    path.chunks_exact(2).map(|p| Point::new(p[0], p[1]))
}
