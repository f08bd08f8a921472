use crate::{GridScene, WorldScene};
use pf_core::InvalidProblem;
use pf_geom::WorldChange;
use pf_grid::GridChange;

/// What a map, a query and a robot's size are, before a planner's problem is made of them.
///
/// The caller owns it and lets things happen in it; planners are told of them.
#[derive(Clone, Debug)]
pub enum Scene {
    /// On a grid.
    Grid(GridScene),
    /// In a world of shapes.
    World(WorldScene),
}

/// What happens in a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Changes {
    /// On a grid.
    Grid(Vec<GridChange>),
    /// In a world of shapes.
    World(Vec<WorldChange>),
}

/// A round robot, and the room it is to keep around itself, in the map's unit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Robot {
    /// Its radius; 0 for a point.
    pub radius: f64,
    /// How far it is to stay away from obstacles besides.
    pub clearance: f64,
}

impl Robot {
    /// A robot that may touch obstacles.
    #[must_use]
    pub fn of_radius(radius: f64) -> Self {
        Self {
            radius,
            clearance: 0.0,
        }
    }

    /// How far its centre stays away from obstacles.
    #[must_use]
    pub fn reach(&self) -> f64 {
        self.radius + self.clearance
    }

    pub(crate) fn check(&self) -> Result<(), InvalidProblem> {
        let values = [
            ("the robot's radius", self.radius),
            ("the clearance", self.clearance),
        ];
        for (what, value) in values {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(InvalidProblem::BadValue {
                    what: what.into(),
                    found: value.to_string(),
                    expected: "a number from 0".into(),
                });
            }
        }
        Ok(())
    }
}

impl Scene {
    /// What it is: `grid` or `world`.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Grid(_) => "grid",
            Self::World(_) => "world",
        }
    }

    /// Who moves in it.
    #[must_use]
    pub fn robot(&self) -> Robot {
        match self {
            Self::Grid(scene) => scene.robot(),
            Self::World(scene) => scene.robot(),
        }
    }

    /// Lets `changes` happen to the map or the query; returns what they are to a robot of this
    /// size, for [`Runner::replan`](crate::Runner::replan).
    ///
    /// # Errors
    /// [`InvalidProblem`], with nothing changed, if a change makes no sense.
    pub fn change(&mut self, changes: &Changes) -> Result<Changes, InvalidProblem> {
        match (self, changes) {
            (Self::Grid(scene), Changes::Grid(changes)) => scene.change(changes).map(Changes::Grid),
            (Self::World(scene), Changes::World(changes)) => {
                scene.change(changes)?;
                Ok(Changes::World(changes.clone()))
            }
            (scene, _) => Err(InvalidProblem::BadValue {
                what: "the change".into(),
                found: "one of another kind of map".to_owned(),
                expected: format!("one of a {}", scene.kind()).into(),
            }),
        }
    }
}

impl From<GridScene> for Scene {
    fn from(scene: GridScene) -> Self {
        Self::Grid(scene)
    }
}

impl From<WorldScene> for Scene {
    fn from(scene: WorldScene) -> Self {
        Self::World(scene)
    }
}
