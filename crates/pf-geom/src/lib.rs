//! Worlds of shapes in the plane.

mod clip;
mod cover;
mod index;
mod problem;
mod raster;
mod segment;
mod sensor;
mod shape;
mod visibility;
mod world;

pub use cover::world_of;
pub use problem::{WorldChange, WorldProblem};
pub use raster::Raster;
pub use segment::{Segment, cross, point_to_box};
pub use sensor::{Observation, Window};
pub use shape::{Circle, Polygon, Rectangle, Shape, TOUCH};
pub use visibility::{Answer, Bend, Route, TangentGraph};
pub use world::{ShapeId, World};

/// A point of the plane.
pub type Point = nalgebra::Point2<f64>;
/// A vector of the plane.
pub type Vector = nalgebra::Vector2<f64>;
