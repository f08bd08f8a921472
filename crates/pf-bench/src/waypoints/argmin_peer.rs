//! argmin's L-BFGS with Armijo's rule on the paper's loss.

use argmin::{
    core::{CostFunction, Error, Executor, Gradient},
    solver::{
        linesearch::{BacktrackingLineSearch, condition::ArmijoCondition},
        quasinewton::LBFGS,
    },
};
use pf_lbfgs::PaperLoss;
use std::cell::RefCell;

/// The loss of the inner points at one weight; the ends stay where they are.
pub(super) struct Inner<'a> {
    pub(super) loss: &'a PaperLoss,
    pub(super) lambda: f64,
    /// A whole path, and its gradient.
    pub(super) scratch: RefCell<(Vec<f64>, Vec<f64>)>,
}

impl Inner<'_> {
    fn evaluate(&self, inner: &[f64]) -> f64 {
        let (path, gradient) = &mut *self.scratch.borrow_mut();
        let size = path.len();
        path[2..size - 2].copy_from_slice(inner);
        self.loss.evaluate(path, self.lambda, gradient)
    }
}

impl CostFunction for &Inner<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, inner: &Vec<f64>) -> Result<f64, Error> {
        Ok(self.evaluate(inner))
    }
}

impl Gradient for &Inner<'_> {
    type Param = Vec<f64>;
    type Gradient = Vec<f64>;

    fn gradient(&self, inner: &Vec<f64>) -> Result<Vec<f64>, Error> {
        self.evaluate(inner);
        let gradient = &self.scratch.borrow().1;
        Ok(gradient[2..gradient.len() - 2].to_vec())
    }
}

/// Minimises from `path` in as many iterations, and returns the last loss.
pub(super) fn minimise(problem: &Inner<'_>, path: &[f64], iterations: u64) -> Option<f64> {
    let armijo = ArmijoCondition::new(1e-4).ok()?;
    let search = BacktrackingLineSearch::new(armijo).rho(0.5).ok()?;
    let solver = LBFGS::new(search, 8)
        .with_tolerance_grad(0.0)
        .ok()?
        .with_tolerance_cost(0.0)
        .ok()?;
    let result = Executor::new(problem, solver)
        .configure(|state| {
            state
                .param(path[2..path.len() - 2].to_vec())
                .max_iters(iterations)
        })
        .timer(false)
        .run()
        .ok()?;
    Some(result.state().get_best_cost())
}
