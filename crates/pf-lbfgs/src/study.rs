//! The paper's loss by itself, for those who study or measure it.

use crate::{potential::Potential, rectangles};
use pf_geom::{Point, WorldProblem};

/// The paper's loss (eq. 1-9) among the rectangles of one problem; other shapes are not seen.
///
/// Paths are flat: x and y by turns, start and goal included.
///
/// ```
/// use pf_geom::{Point, Rectangle, World, WorldProblem};
/// use pf_lbfgs::PaperLoss;
///
/// let corner = |v: f64| Point::new(v, v);
/// let bounds = Rectangle::new(corner(-9.0), corner(9.0)).unwrap();
/// let block = Rectangle::new(corner(-1.0), corner(1.0)).unwrap();
/// let world = World::with_shapes(bounds, [block.into()]);
/// let problem = WorldProblem::new(world, 0.0, corner(-6.0), corner(6.0)).unwrap();
///
/// let loss = PaperLoss::new(&problem, 2.0);
/// assert_eq!(loss.potential(corner(0.0)), 8.0);
/// let mut gradient = vec![0.0; 6];
/// // Two steps of squared length 72, nothing bent, and over the top two samples and two beside it.
/// let value = loss.evaluate(&[-6.0, -6.0, 0.0, 0.0, 6.0, 6.0], 1.0, &mut gradient);
/// assert!((value - 144.0 - 2.0 * 8.0 - 2.0 * loss.potential(corner(2.0))).abs() < 1e-9);
/// ```
#[derive(Clone, Debug)]
pub struct PaperLoss {
    potential: Potential,
}

impl PaperLoss {
    /// The loss among the rectangles of `problem`, each grown by `margin`.
    #[must_use]
    pub fn new(problem: &WorldProblem, margin: f64) -> Self {
        let mut potential = Potential::default();
        potential.fill(rectangles(problem), margin);
        Self { potential }
    }

    /// The loss of a path with the obstacles at weight `lambda`, and its gradient, which takes the
    /// place of what `gradient` held; both are as long. Four samples at a time.
    #[must_use]
    pub fn evaluate(&self, path: &[f64], lambda: f64, gradient: &mut [f64]) -> f64 {
        self.potential.loss_in_lanes(path, lambda, gradient)
    }

    /// The same, one sample at a time.
    #[must_use]
    pub fn evaluate_one_by_one(&self, path: &[f64], lambda: f64, gradient: &mut [f64]) -> f64 {
        self.potential.loss(path, lambda, gradient)
    }

    /// The potential at a point.
    #[must_use]
    pub fn potential(&self, at: Point) -> f64 {
        self.potential.at(at.x, at.y)
    }
}

/// A path as [`PaperLoss`] takes it.
#[must_use]
pub fn plain(path: &[Point]) -> Vec<f64> {
    path.iter().flat_map(|p| [p.x, p.y]).collect()
}
