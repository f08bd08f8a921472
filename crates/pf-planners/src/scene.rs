use pf_core::{InvalidProblem, Problem};
use pf_grid::{Cell, Grid, GridChange, GridProblem, Inflated, Moves};
use std::sync::Arc;

/// What a map, a query and a robot's size are, before a planner's problem is made of them.
///
/// The caller owns it and lets things happen in it; planners are told of them.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The map as it was read.
    asked: GridProblem,
    /// Where the robot's centre may be: the same, inflated by the radius.
    posed: GridProblem,
    radius: f64,
    /// Made at the first change, if the robot has a size.
    inflated: Option<Inflated>,
}

impl Scene {
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
            radius: 0.0,
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

    /// The same for a round robot of this radius in cells.
    ///
    /// # Errors
    /// [`InvalidProblem`] if it is negative or no number.
    pub fn with_radius(mut self, radius: f64) -> Result<Self, InvalidProblem> {
        if !(radius >= 0.0 && radius.is_finite()) {
            return Err(InvalidProblem::BadValue {
                what: "the robot's radius".into(),
                found: radius.to_string(),
                expected: "a number of cells from 0".into(),
            });
        }
        let grid = if radius > 0.0 {
            Arc::new(self.map().inflated(radius))
        } else {
            self.asked.shared_grid()
        };
        self.posed = GridProblem::new(grid, self.from(), self.to())?.with_moves(self.moves());
        self.radius = radius;
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
    pub fn grid_problem(&self) -> &GridProblem {
        &self.posed
    }

    /// The robot's radius in cells; 0 for a point.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
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
        let followed = if self.radius > 0.0 {
            let start = || Inflated::new(self.asked.grid(), self.radius);
            self.inflated.get_or_insert_with(start).follow(changes)?
        } else {
            changes.to_vec()
        };
        self.asked.apply(changes)?;
        self.posed.apply(&followed)?;
        Ok(followed)
    }
}

/// How far an answer speaks of the scene it was asked about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Faith {
    /// The problem is the scene itself.
    Exact,
    /// The scene was cautiously converted: a solution holds, a proof does not.
    Converted,
}

/// Points in the map's cells: column and row of a cell, or between them.
pub type Line = Vec<[f64; 2]>;

/// A problem that can be read out of a scene, and whose answers can be shown.
pub trait FromScene: Problem {
    /// Its name: `grid`.
    const KIND: &'static str;

    /// The problem that the scene poses.
    ///
    /// # Errors
    /// [`InvalidProblem`] if the scene makes no sense as such a problem.
    fn from_scene(scene: &Scene) -> Result<(Self, Faith), InvalidProblem>;

    /// What happened in the scene, as changes of the problem.
    fn changes(&self, changes: &[GridChange]) -> Vec<Self::Change>;

    /// A solution as lines, one per robot or alternative.
    fn lines(&self, solution: &Self::Solution) -> Vec<Line>;

    /// A cost as numbers, one per objective.
    fn costs(cost: &Self::Cost) -> Vec<f64>;
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hall() -> Scene {
        let grid = Grid::parse("........ ........ ........ ........ ........").unwrap();
        Scene::new(grid, Cell::new(0, 0), Cell::new(7, 4)).unwrap()
    }

    #[test]
    fn a_robot_with_a_size_follows_changes() {
        let mut scene = hall().with_radius(1.2).unwrap();
        let (a, b) = (Cell::new(3, 2), Cell::new(5, 1));
        for changes in [
            vec![GridChange::Blocked(vec![a, b])],
            vec![GridChange::Freed(vec![a]), GridChange::StartMoved(b)],
            vec![GridChange::CostChanged(vec![a], 7)],
        ] {
            scene.change(&changes).unwrap();
            let fresh = scene.clone().with_radius(1.2).unwrap();
            assert_eq!(scene.inflated(), fresh.inflated());
            assert_eq!(scene.grid_problem().start(), scene.from());
        }
        assert!(!scene.inflated().is_free(Cell::new(6, 1)));
        assert!(scene.map().is_free(Cell::new(6, 1)));
    }

    #[test]
    fn nonsense_changes_nothing() {
        for radius in [0.0, 2.0] {
            let mut scene = hall().with_radius(radius).unwrap();
            let inside = GridChange::Blocked(vec![Cell::new(3, 3)]);
            let outside = GridChange::GoalMoved(Cell::new(8, 0));
            assert!(scene.change(&[inside, outside]).is_err());
            assert_eq!(scene.map(), hall().map());
            assert_eq!(scene.inflated(), hall().inflated());
        }
        assert!(hall().with_radius(f64::NAN).is_err());
        assert!(hall().with_radius(-1.0).is_err());
    }
}
