//! Worlds of shapes in the plane, and the questions a planner asks of them.
//!
//! A [`World`] is a bounded region with obstacles: [`Circle`]s, upright [`Rectangle`]s and simple
//! [`Polygon`]s, each under an id of its own. A [`WorldProblem`] asks for a path of a round robot
//! through it; a path is a polyline, and its judge is exact: segment against grown shape, in closed
//! form, never by sampling. Touching is allowed, entering by more than [`TOUCH`] is not.
//!
//! ```
//! use pf_core::{Problem, Violation};
//! use pf_geom::{Circle, Point, Rectangle, World, WorldChange, WorldProblem};
//!
//! let bounds = Rectangle::new(Point::new(0.0, 0.0), Point::new(10.0, 6.0)).unwrap();
//! let pillar = Circle::new(Point::new(5.0, 3.0), 1.0).unwrap();
//! let world = World::with_shapes(bounds, [pillar.into()]);
//! let (start, goal) = (Point::new(1.0, 3.0), Point::new(9.0, 3.0));
//! let mut problem = WorldProblem::new(world, 0.5, start, goal).unwrap();
//!
//! let around = vec![start, Point::new(5.0, 5.0), goal];
//! assert_eq!(problem.judge(&vec![start, goal]), Err(Violation::Collision { at: 0 }));
//! assert!(problem.judge(&around).unwrap() > 8.9);
//!
//! problem.apply(&[WorldChange::Removed(0)]).unwrap();
//! assert_eq!(problem.judge(&vec![start, goal]), Ok(8.0));
//! ```
//!
//! A [`TeamProblem`] asks for timed paths of several robots that do not collide, and for the choices
//! there are between short, safe and smooth ones; collisions in time are exact as well.
//!
//! [`TangentGraph`] finds the shortest path there is; `pf-classic` makes a planner of it.

mod clip;
mod cover;
mod index;
mod problem;
mod raster;
mod segment;
mod sensor;
mod shape;
mod team;
mod visibility;
mod world;

pub use cover::world_of;
pub use problem::{WorldChange, WorldProblem};
pub use raster::Raster;
pub use segment::{Segment, cross, point_to_box};
pub use sensor::{Observation, Window};
pub use shape::{Circle, Polygon, Rectangle, Shape, TOUCH};
pub use team::{
    DANGER, DeadEnd, LENGTH, Mark, Meeting, Objectives, Robot, TURNING, TeamChange, TeamPlan,
    TeamProblem, TimedPath, TimedPoint, Timing, closest_approach,
};
pub use visibility::{Answer, Bend, Route, TangentGraph};
pub use world::{ShapeId, World};

/// A point of the plane.
pub type Point = nalgebra::Point2<f64>;
/// A vector of the plane.
pub type Vector = nalgebra::Vector2<f64>;
