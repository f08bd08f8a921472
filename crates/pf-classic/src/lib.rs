#![doc = include_str!("../README.md")]

mod auto;
mod best_first;
mod d_star_lite;
mod jps;
mod visibility_graph;

pub use auto::{Auto, AutoParams};
pub use best_first::{AStar, AStarParams, Dijkstra, DijkstraParams, SearchParams};
pub use d_star_lite::{DStarLite, DStarLiteParams};
pub use jps::{Jps, JpsParams, Prepared, PreparedParams};
pub use visibility_graph::{VisibilityGraph, VisibilityGraphParams};
