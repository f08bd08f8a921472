//! Newton's method on a path, whose second derivatives make a narrow band.

use crate::{
    banded::Banded, hinge::add_outer, memory::dot, potential::Potential, published::points,
    quadratic,
};
use pf_core::Context;
use pf_geom::WorldProblem;

/// A loss of a path, twice differentiable wherever it matters.
pub(crate) trait Loss {
    /// The loss, and its gradient in place of what `gradient` held; both x and y by turns, ends
    /// included.
    fn loss(&mut self, path: &[f64], gradient: &mut [f64]) -> f64;

    /// The second derivatives by the inner points, in place of what `matrix` held, for the path whose
    /// loss was asked for last; if `cautious`, something positive definite in their place.
    fn curvature(&mut self, path: &[f64], cautious: bool, matrix: &mut Banded);

    /// Whether more matters if the inner points take a step. The curvature then counts it, too, and
    /// so does `downhill`, which begins as minus the gradient by the inner points.
    fn look_ahead(&mut self, _step: &[f64], _downhill: &mut [f64]) -> bool {
        false
    }
}

/// The paper's loss at one weight.
#[derive(Debug)]
pub(crate) struct Weighted<'a> {
    pub(crate) potential: &'a Potential,
    pub(crate) lambda: f64,
}

impl Loss for Weighted<'_> {
    fn loss(&mut self, path: &[f64], gradient: &mut [f64]) -> f64 {
        self.potential.loss_in_lanes(path, self.lambda, gradient)
    }

    fn curvature(&mut self, path: &[f64], cautious: bool, matrix: &mut Banded) {
        let inner = path.len() / 2 - 2;
        quadratic::curvature(matrix, inner);
        self.potential
            .curvature(path, self.lambda, |segment, at, bend| {
                let bend = if cautious { upward(bend) } else { bend };
                add_outer(matrix, inner, segment, at, bend);
            });
    }
}

/// The part of a symmetric matrix xx, xy, yy that bends upwards.
fn upward([xx, xy, yy]: [f64; 3]) -> [f64; 3] {
    let (mean, half) = (f64::midpoint(xx, yy), (xx - yy) / 2.0);
    let radius = half.hypot(xy);
    let (low, high) = (mean - radius, mean + radius);
    if low >= 0.0 {
        return [xx, xy, yy];
    }
    if high <= 0.0 {
        return [0.0; 3];
    }
    // The projection onto the direction of the greater one.
    let scale = high / (2.0 * radius);
    [scale * (radius + half), scale * xy, scale * (radius - half)]
}

/// How much of a step is tried next, and at least.
const SHRINK: f64 = 0.4;
const SMALLEST: f64 = 1e-7;
/// How often a step is taken back to count what it would run into.
const LOOKS: u32 = 2;

/// When to stop.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    /// At most so many steps.
    pub(crate) iterations: u64,
    /// No point moves further in a step.
    pub(crate) cap: f64,
    /// A step that promises less than this share of the loss is not worth taking.
    pub(crate) worth: f64,
}

/// Memory kept from plan to plan.
#[derive(Clone, Debug, Default)]
pub(crate) struct Newton {
    trial: Vec<f64>,
    gradient: Vec<f64>,
    after: Vec<f64>,
    step: Vec<f64>,
    ahead: Vec<f64>,
    matrix: Banded,
}

impl Newton {
    /// Minimises from `path`, in its place; says how many steps were taken and the loss. One
    /// iteration is one step.
    pub(crate) fn minimise(
        &mut self,
        loss: &mut impl Loss,
        path: &mut Vec<f64>,
        limits: Limits,
        cx: &mut Context<'_, WorldProblem>,
    ) -> (u64, f64) {
        let size = path.len();
        let inner = 2..size - 2;
        for buffer in [&mut self.gradient, &mut self.after] {
            buffer.clear();
            buffer.resize(size, 0.0);
        }
        self.trial.clear();
        self.trial.extend_from_slice(path);
        let mut here = loss.loss(path, &mut self.gradient);
        let mut taken = 0;
        while taken < limits.iterations && cx.proceed() {
            let Some(slope) = self.find_step(loss, path, limits.cap) else {
                break;
            };
            if -slope <= limits.worth * here {
                break;
            }
            let mut share = 1.0;
            let there = loop {
                for (k, d) in inner.clone().zip(&self.step) {
                    self.trial[k] = path[k] + share * d;
                }
                let there = loss.loss(&self.trial, &mut self.after);
                cx.evaluated(1);
                if there <= here + 1e-4 * share * slope {
                    break Some(there);
                }
                share *= SHRINK;
                if share < SMALLEST {
                    break None;
                }
            };
            let Some(there) = there else { break };
            taken += 1;
            std::mem::swap(path, &mut self.trial);
            std::mem::swap(&mut self.gradient, &mut self.after);
            here = there;
            cx.candidate(|| points(path).collect());
        }
        (taken, here)
    }

    /// The loss of a path.
    pub(crate) fn loss(&mut self, loss: &mut impl Loss, path: &[f64]) -> f64 {
        self.gradient.clear();
        self.gradient.resize(path.len(), 0.0);
        loss.loss(path, &mut self.gradient)
    }

    /// The step, none of its points longer than `cap`, and how fast the loss changes along it.
    fn find_step(&mut self, loss: &mut impl Loss, path: &[f64], cap: f64) -> Option<f64> {
        let inner = 2..path.len() - 2;
        let mut solved = None;
        for cautious in [false, true] {
            loss.curvature(path, cautious, &mut self.matrix);
            self.step.clear();
            self.step
                .extend(self.gradient[inner.clone()].iter().map(|g| -g));
            solved = self.matrix.solve(&mut self.step);
            if solved.is_some() {
                break;
            }
        }
        solved?;
        for _ in 0..LOOKS {
            self.ahead.clear();
            self.ahead
                .extend(self.gradient[inner.clone()].iter().map(|g| -g));
            if !loss.look_ahead(&self.step, &mut self.ahead) {
                break;
            }
            loss.curvature(path, false, &mut self.matrix);
            if self.matrix.solve(&mut self.ahead).is_none()
                || dot(&self.gradient[inner.clone()], &self.ahead) >= 0.0
            {
                break;
            }
            std::mem::swap(&mut self.step, &mut self.ahead);
        }
        let longest = self
            .step
            .chunks_exact(2)
            .map(|d| d[0].hypot(d[1]))
            .fold(0.0, f64::max);
        if longest > cap {
            for d in &mut self.step {
                *d *= cap / longest;
            }
        }
        Some(dot(&self.gradient[inner], &self.step))
    }
}
