//! Scenes as grids: those on grids as they are, worlds as cells.

use crate::{Changes, Conversion, Found, FromScene, Posed, Scene, WorldScene};
use pf_core::{InvalidProblem, Note, Problem, Solved, Text};
use pf_geom::{Point, Raster};
use pf_grid::{Cell, Grid, GridChange, GridProblem};

impl FromScene for GridProblem {
    const KIND: &'static str = "grid";

    fn pose(scene: &Scene) -> Result<Posed<Self>, InvalidProblem> {
        let scene = match scene {
            Scene::Grid(scene) => return Ok(Posed::exactly(scene.problem().clone())),
            Scene::World(scene) => scene,
        };
        let raster = scene.raster()?;
        let (start, goal) = ends(&raster, scene);
        let problem = Self::new(raster.grid().clone(), start, goal)?;
        Ok(Posed {
            problem: problem.with_moves(scene.moves()),
            conversion: Some(Conversion::Cells(Box::new(raster))),
        })
    }

    fn follow(
        posed: &mut Posed<Self>,
        scene: &Scene,
        changes: &Changes,
    ) -> Result<Vec<GridChange>, InvalidProblem> {
        let scene = match (scene, changes) {
            (Scene::World(scene), _) => scene,
            (Scene::Grid(_), Changes::Grid(changes)) => return Ok(changes.clone()),
            (Scene::Grid(_), Changes::World(_)) => return Ok(Vec::new()),
        };
        // Cut anew: what a shape blocked another may still block.
        let raster = scene.raster()?;
        let mut changes = between(posed.problem.grid(), raster.grid());
        let (start, goal) = ends(&raster, scene);
        if start != posed.problem.start() {
            changes.push(GridChange::StartMoved(start));
        }
        if goal != posed.problem.goal() {
            changes.push(GridChange::GoalMoved(goal));
        }
        posed.conversion = Some(Conversion::Cells(Box::new(raster)));
        Ok(changes)
    }

    fn read(posed: &Posed<Self>, scene: &Scene, solved: &Solved<Self>) -> Option<Found> {
        if let (Scene::World(scene), Some(Conversion::Cells(raster))) = (scene, &posed.conversion) {
            let path = raster.path(scene.problem(), &solved.solution)?;
            let length = scene.problem().judge(&path).ok()?;
            return Some(Found {
                costs: vec![length],
                lines: vec![path.into_iter().map(|p| [p.x, p.y]).collect()],
            });
        }
        let point = |cell: &Cell| [f64::from(cell.x), f64::from(cell.y)];
        Some(Found {
            costs: vec![solved.cost.value()],
            lines: vec![solved.solution.iter().map(point).collect()],
        })
    }

    /// The nearest reachable cell is told as a point where it is one of a world.
    fn reword(posed: &Posed<Self>, mut note: Note) -> Note {
        if let (Some(Conversion::Cells(raster)), "nearest") = (&posed.conversion, note.key)
            && let Ok(cell) = note.text.parse::<Cell>()
        {
            let centre = raster.centre(cell);
            note.text = Text::of(format_args!("{},{}", centre.x, centre.y));
        }
        note
    }
}

/// The cells where a search begins and ends: free ones near by, to whose centres there is a
/// straight way, if there are any.
fn ends(raster: &Raster, scene: &WorldScene) -> (Cell, Cell) {
    let problem = scene.problem();
    let cell = |p: Point| {
        let entry = raster.entry(problem, p);
        entry.unwrap_or_else(|| raster.cell_of(p))
    };
    (cell(problem.start()), cell(problem.goal()))
}

/// What turns one grid into another of its size.
fn between(before: &Grid, now: &Grid) -> Vec<GridChange> {
    let cells = |differs: &dyn Fn(Cell) -> bool| -> Vec<Cell> {
        now.layout().cells().filter(|&cell| differs(cell)).collect()
    };
    let blocked = cells(&|c| before.is_free(c) && !now.is_free(c));
    let freed = cells(&|c| !before.is_free(c) && now.is_free(c));
    let mut changes = Vec::new();
    if !blocked.is_empty() {
        changes.push(GridChange::Blocked(blocked));
    }
    if !freed.is_empty() {
        changes.push(GridChange::Freed(freed));
    }
    changes
}
