//! The D* Lite of `condor-pathfinding-grid`, which knows four-connected moves alone.

use super::event::{Class, Event};
use crate::protocol::timed;
use anyhow::{Result, anyhow};
use condor_grid::{
    Cell as Kind, Grid as Map, GridReplanner, Point, SearchRequest,
    algorithms::d_star_lite::DStarLite, search::SearchResult,
};
use pf_grid::{Cell, Grid, GridChange, GridProblem};
use std::time::Duration;

/// Its name in tables.
pub(super) const NAME: &str = "condor_grid::DStarLite";

/// The replanner and the map it is given.
///
/// It has no robot that moves: it is set up where the robot stands when the event comes, untimed, and
/// only told of cells. Where robot or goal move it has to be set up anew, and that is timed.
pub(super) struct Condor {
    map: Map,
    replanner: DStarLite,
}

impl Condor {
    pub(super) fn on(grid: &Grid) -> Result<Self> {
        let size = [grid.width() as usize, grid.height() as usize];
        let mut map = Map::new(size[0], size[1]).map_err(|error| anyhow!("{NAME}: {error:?}"))?;
        for cell in grid.layout().cells().filter(|&cell| !grid.is_free(cell)) {
            map.set_cell(point(cell), Kind::Blocked)
                .map_err(|error| anyhow!("{NAME}: {error:?}"))?;
        }
        Ok(Self {
            map,
            replanner: DStarLite::new(),
        })
    }

    /// Plans on the map as the file has it, from where the robot stands.
    pub(super) fn prepare(&mut self, robot: Cell, goal: Cell) {
        let request = SearchRequest::new(point(robot), point(goal));
        // What it finds is asked after the event.
        let _ = self.replanner.initialize(&self.map, request);
    }

    /// How long an answer takes to `problem`, which the event led to, and how many steps its path
    /// has; `None` if it says that there is none.
    pub(super) fn answer(
        &mut self,
        class: Class,
        event: &Event,
        problem: &GridProblem,
    ) -> (Duration, Option<u64>) {
        let (time, found) = match class {
            Class::GoalMoved | Class::RobotMoved => {
                let request = SearchRequest::new(point(problem.start()), point(problem.goal()));
                timed(|| self.replanner.initialize(&self.map, request))
            }
            _ => timed(|| {
                for change in &event.changes {
                    let (cells, kind) = match change {
                        GridChange::Blocked(cells) => (cells, Kind::Blocked),
                        GridChange::Freed(cells) => (cells, Kind::Open),
                        _ => continue,
                    };
                    for &cell in cells {
                        self.replanner.update_cell(point(cell), kind);
                    }
                }
                self.replanner.replan()
            }),
        };
        (time, steps(&found))
    }
}

fn steps(found: &SearchResult) -> Option<u64> {
    let path = found.as_ref().ok()?.path()?;
    Some(path.steps().len() as u64 - 1)
}

fn point(cell: Cell) -> Point {
    Point::new(cell.x as usize, cell.y as usize)
}
