//! Dijkstra, A* and D* Lite on grids: exact, proven and fast.

mod best_first;
mod d_star_lite;
mod visibility_graph;

pub use best_first::{AStar, AStarParams, Dijkstra, DijkstraParams, SearchParams};
pub use d_star_lite::{DStarLite, DStarLiteParams};
pub use visibility_graph::{VisibilityGraph, VisibilityGraphParams};
