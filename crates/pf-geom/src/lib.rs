#![doc = include_str!("../README.md")]

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
