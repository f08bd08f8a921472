//! The list itself.

use crate::{AnyEntry, Entry, UnknownPlanner, entry::entry};
use pf_classic::{AStar, AStarParams, DStarLite, DStarLiteParams, Dijkstra, DijkstraParams};
use pf_grid::GridProblem;

static GRID: &[Entry<GridProblem>] = &[
    entry!(plans "dijkstra", Dijkstra, DijkstraParams, "Dijkstra 1959"),
    entry!(plans "astar", AStar, AStarParams, "Hart, Nilsson, Raphael 1968"),
    entry!(replans "d-star-lite", DStarLite, DStarLiteParams, "Koenig, Likhachev 2002"),
];

/// The planners on grids, each as a replanner; those that only plan start over
/// ([`FromScratch`](pf_core::FromScratch)).
pub fn grid_planners() -> impl Iterator<Item = &'static Entry<GridProblem>> {
    GRID.iter()
}

/// All planners, whatever their problem.
pub fn all() -> impl Iterator<Item = &'static dyn AnyEntry> {
    grid_planners().map(|entry| entry as &dyn AnyEntry)
}

/// The planner called `key`.
///
/// # Errors
/// [`UnknownPlanner`] if there is none.
pub fn find(key: &str) -> Result<&'static dyn AnyEntry, UnknownPlanner> {
    let found = all().find(|entry| entry.key() == key);
    found.ok_or_else(|| UnknownPlanner::new(key, all().map(AnyEntry::key)))
}
