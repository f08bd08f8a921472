//! Dijkstra, A* and D* Lite on grids: exact, proven and fast.

mod best_first;

pub use best_first::{AStar, AStarParams, Dijkstra, DijkstraParams, SearchParams};
