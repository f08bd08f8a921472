use crate::Robot;
use pf_core::{InvalidProblem, Problem};
use pf_grid::{Cell, Grid, GridChange, GridProblem, Inflated, Moves};
use std::sync::Arc;

/// A scene on a grid.
#[derive(Clone, Debug)]
pub struct GridScene {
    /// The map as it was read.
    asked: GridProblem,
    /// Where the robot's centre may be: the same, inflated.
    posed: GridProblem,
    robot: Robot,
    /// Made at the first change, if the robot has a size.
    inflated: Option<Box<Inflated>>,
}

impl GridScene {
    /// From one cell of a map to another, for a robot that is a point.
    ///
    /// # Errors
    /// [`InvalidProblem`] if either cell lies outside the map.
    pub fn new(map: impl Into<Arc<Grid>>, from: Cell, to: Cell) -> Result<Self, InvalidProblem> {
        Ok(Self::of(GridProblem::new(map, from, to)?))
    }

    /// What a problem asks, for a robot that is a point.
    #[must_use]
    pub fn of(problem: GridProblem) -> Self {
        Self {
            posed: problem.clone(),
            asked: problem,
            robot: Robot::default(),
            inflated: None,
        }
    }

    /// The same under other moves.
    #[must_use]
    pub fn with_moves(mut self, moves: Moves) -> Self {
        self.asked = self.asked.with_moves(moves);
        self.posed = self.posed.with_moves(moves);
        self
    }

    /// The same for a robot, its size in cells.
    ///
    /// # Errors
    /// [`InvalidProblem`] if its size is negative or no number.
    pub fn with_robot(mut self, robot: Robot) -> Result<Self, InvalidProblem> {
        robot.check()?;
        let grid = if robot.reach() > 0.0 {
            Arc::new(self.map().inflated(robot.reach()))
        } else {
            self.asked.shared_grid()
        };
        self.posed = GridProblem::new(grid, self.from(), self.to())?.with_moves(self.moves());
        self.robot = robot;
        self.inflated = None;
        Ok(self)
    }

    /// The same map and robot, another query.
    ///
    /// # Errors
    /// [`InvalidProblem`] if either cell lies outside the map.
    pub fn with_query(mut self, from: Cell, to: Cell) -> Result<Self, InvalidProblem> {
        let moved = [GridChange::StartMoved(from), GridChange::GoalMoved(to)];
        self.asked.apply(&moved)?;
        self.posed.apply(&moved)?;
        Ok(self)
    }

    /// The map as it is now, without regard to the robot's size.
    #[must_use]
    pub fn map(&self) -> &Grid {
        self.asked.grid()
    }

    /// Where the robot's centre may be now.
    #[must_use]
    pub fn inflated(&self) -> &Grid {
        self.posed.grid()
    }

    /// What planners on grids are asked.
    #[must_use]
    pub fn problem(&self) -> &GridProblem {
        &self.posed
    }

    /// The robot, its size in cells.
    #[must_use]
    pub fn robot(&self) -> Robot {
        self.robot
    }

    /// Which steps are allowed.
    #[must_use]
    pub fn moves(&self) -> Moves {
        self.asked.moves()
    }

    /// Where from.
    #[must_use]
    pub fn from(&self) -> Cell {
        self.asked.start()
    }

    /// Where to.
    #[must_use]
    pub fn to(&self) -> Cell {
        self.asked.goal()
    }

    /// Lets `changes` happen to the map or the query; returns what they are to a robot of this
    /// size, for [`Runner::replan`](crate::Runner::replan).
    ///
    /// # Errors
    /// [`InvalidProblem`], with nothing changed, if a change makes no sense.
    pub fn change(&mut self, changes: &[GridChange]) -> Result<Vec<GridChange>, InvalidProblem> {
        let reach = self.robot.reach();
        let followed = if reach > 0.0 {
            let start = || Box::new(Inflated::new(self.asked.grid(), reach));
            self.inflated.get_or_insert_with(start).follow(changes)?
        } else {
            changes.to_vec()
        };
        self.asked.apply(changes)?;
        self.posed.apply(&followed)?;
        Ok(followed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hall() -> GridScene {
        let grid = Grid::parse("........ ........ ........ ........ ........").unwrap();
        GridScene::new(grid, Cell::new(0, 0), Cell::new(7, 4)).unwrap()
    }

    fn of(radius: f64) -> Result<GridScene, InvalidProblem> {
        hall().with_robot(Robot::of_radius(radius))
    }

    #[test]
    fn a_robot_with_a_size_follows_changes() {
        let robot = Robot {
            radius: 0.7,
            clearance: 0.5,
        };
        let mut scene = hall().with_robot(robot).unwrap();
        let (a, b) = (Cell::new(3, 2), Cell::new(5, 1));
        for changes in [
            vec![GridChange::Blocked(vec![a, b])],
            vec![GridChange::Freed(vec![a]), GridChange::StartMoved(b)],
            vec![GridChange::CostChanged(vec![a], 7)],
        ] {
            scene.change(&changes).unwrap();
            let fresh = scene.clone().with_robot(Robot::of_radius(1.2)).unwrap();
            assert_eq!(scene.inflated(), fresh.inflated());
            assert_eq!(scene.problem().start(), scene.from());
        }
        assert!(!scene.inflated().is_free(Cell::new(6, 1)));
        assert!(scene.map().is_free(Cell::new(6, 1)));
    }

    #[test]
    fn nonsense_changes_nothing() {
        for radius in [0.0, 2.0] {
            let mut scene = of(radius).unwrap();
            let inside = GridChange::Blocked(vec![Cell::new(3, 3)]);
            let outside = GridChange::GoalMoved(Cell::new(8, 0));
            assert!(scene.change(&[inside, outside]).is_err());
            assert_eq!(scene.map(), hall().map());
            assert_eq!(scene.inflated(), hall().inflated());
        }
        assert!(of(f64::NAN).is_err());
        assert!(of(-1.0).is_err());
    }
}
