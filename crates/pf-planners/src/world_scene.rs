use crate::Robot;
use pf_core::{InvalidProblem, Problem};
use pf_geom::{Point, Raster, Rectangle, World, WorldChange, WorldProblem};
use pf_grid::Moves;
use std::sync::Arc;

/// A scene in a world of shapes.
#[derive(Clone, Debug)]
pub struct WorldScene {
    /// Its radius is the robot's reach.
    problem: WorldProblem,
    robot: Robot,
    cell: Option<f64>,
    moves: Option<Moves>,
}

impl WorldScene {
    /// From one point of a world to another.
    ///
    /// # Errors
    /// [`InvalidProblem`] if a point lies out of bounds or a number makes no sense.
    pub fn new(
        world: impl Into<Arc<World>>,
        robot: Robot,
        from: Point,
        to: Point,
    ) -> Result<Self, InvalidProblem> {
        robot.check()?;
        Ok(Self {
            problem: WorldProblem::new(world, robot.reach(), from, to)?,
            robot,
            cell: None,
            moves: None,
        })
    }

    /// The most cells that a world is cut into.
    pub const MOST_CELLS: f64 = 16e6;

    /// The same; for planners on grids it is cut into cells with sides of this length.
    ///
    /// # Errors
    /// [`InvalidProblem`] if it is not positive, or so small that there would be more than
    /// [`MOST_CELLS`](Self::MOST_CELLS).
    pub fn with_cell(mut self, cell: f64) -> Result<Self, InvalidProblem> {
        if !(cell > 0.0 && cell.is_finite()) {
            return Err(InvalidProblem::BadValue {
                what: "the size of a cell".into(),
                found: cell.to_string(),
                expected: "a positive number".into(),
            });
        }
        let size = self.world().bounds().max() - self.world().bounds().min();
        if size.x / cell * (size.y / cell) > Self::MOST_CELLS {
            let least = (size.x * size.y / Self::MOST_CELLS).sqrt();
            return Err(InvalidProblem::BadValue {
                what: "the size of a cell".into(),
                found: cell.to_string(),
                expected: format!("at least {least:.2e} in a world of this size").into(),
            });
        }
        self.cell = Some(cell);
        Ok(self)
    }

    /// The same; planners on grids make these moves. Any are safe in a world, so without a word
    /// all are allowed.
    #[must_use]
    pub fn with_moves(mut self, moves: Moves) -> Self {
        self.moves = Some(moves);
        self
    }

    /// What planners in worlds are asked; its radius is the robot's reach.
    #[must_use]
    pub fn problem(&self) -> &WorldProblem {
        &self.problem
    }

    /// The world as it is now.
    #[must_use]
    pub fn world(&self) -> &World {
        self.problem.world()
    }

    /// The robot, its size in the world's unit.
    #[must_use]
    pub fn robot(&self) -> Robot {
        self.robot
    }

    /// The side of a cell for planners on grids: as asked for, else half the robot's reach, but so
    /// that there are some thousand cells and not more than a million.
    #[must_use]
    pub fn cell(&self) -> f64 {
        let default = || default_cell(self.world().bounds(), self.robot.reach());
        self.cell.unwrap_or_else(default)
    }

    /// The moves of planners on grids.
    #[must_use]
    pub fn moves(&self) -> Moves {
        self.moves.unwrap_or(Moves::Always)
    }

    pub(crate) fn raster(&self) -> Result<Raster, InvalidProblem> {
        Raster::of(self.world(), self.cell(), self.robot.reach())
    }

    /// Lets `changes` happen.
    ///
    /// # Errors
    /// [`InvalidProblem`], with nothing changed, if a change makes no sense.
    pub fn change(&mut self, changes: &[WorldChange]) -> Result<(), InvalidProblem> {
        self.problem.apply(changes)
    }
}

/// A round number: one, two or five times a power of ten.
fn default_cell(bounds: &Rectangle, reach: f64) -> f64 {
    const MOST: f64 = 1e6;
    let size = bounds.max() - bounds.min();
    let (longer, shorter) = (size.x.max(size.y), size.x.min(size.y));
    let coarsest = (longer / 100.0).min(shorter / 16.0);
    let wanted = if reach > 0.0 {
        reach / 2.0
    } else {
        longer / 250.0
    };
    // So long and narrow a world that even this is too fine has coarse cells.
    let finest = (size.x * size.y / MOST).sqrt();
    let wanted = wanted.min(coarsest).max(finest);
    let power = 10f64.powf(wanted.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|step| step * power);
    let fits = |cell: &&f64| **cell >= finest;
    let fine = steps
        .iter()
        .rev()
        .find(|cell| **cell <= wanted * (1.0 + 1e-9));
    let cell = fine.filter(fits).or_else(|| steps.iter().find(fits));
    let cell = cell.copied().unwrap_or(wanted);
    // As it would be written, not as powers come out.
    format!("{cell:.3e}").parse().unwrap_or(cell)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(width: f64, height: f64, reach: f64, expected: f64) {
        let bounds = Rectangle::new(Point::origin(), Point::new(width, height)).unwrap();
        let cell = default_cell(&bounds, reach);
        assert!((cell - expected).abs() < 1e-12 * expected, "{cell}");
        let cells = (width / cell).ceil() * (height / cell).ceil();
        assert!(cells <= 1.1e6, "{cells} cells");
    }

    #[test]
    fn cells_are_round_fine_enough_and_not_too_many() {
        check(60.0, 40.0, 0.5, 0.2);
        check(60.0, 40.0, 0.0, 0.2);
        check(60.0, 40.0, 0.001, 0.05);
        check(60.0, 40.0, 10.0, 0.5);
        check(55.0, 50.0, 0.0, 0.2);
        check(1e6, 1e6, 0.5, 1000.0);
        check(1e-3, 1e-3, 0.0, 2e-6);
        check(1000.0, 2.0, 0.0, 0.1);
    }

    #[test]
    fn nonsense_is_refused() {
        let bounds = Rectangle::new(Point::origin(), Point::new(9.0, 9.0)).unwrap();
        let scene = |robot, to| WorldScene::new(World::new(bounds), robot, Point::origin(), to);
        let (p, point) = (Point::new(1.0, 1.0), Robot::default());
        assert!(scene(Robot::of_radius(-1.0), p).is_err());
        assert!(
            scene(
                Robot {
                    radius: 2.0,
                    clearance: -1.0
                },
                p
            )
            .is_err()
        );
        assert!(scene(point, Point::new(10.0, 1.0)).is_err());
        for cell in [0.0, -1.0, f64::NAN, f64::INFINITY, 0.001] {
            assert!(scene(point, p).unwrap().with_cell(cell).is_err());
        }
    }
}
