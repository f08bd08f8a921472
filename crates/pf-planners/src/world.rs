//! Scenes as worlds: worlds as they are, grids as worlds of rectangles.

use crate::{Changes, Conversion, Found, FromScene, GridScene, Posed, Scene};
use pf_core::{InvalidProblem, Solved};
use pf_geom::{Point, Shape, ShapeId, World, WorldChange, WorldProblem, world_of};
use pf_grid::{Cell, GridChange};

/// The radius in cells that a robot on a grid has at least: nobody slips between two blocked cells
/// that touch at a corner or along a seam.
const THINNEST: f64 = 1e-6;

impl FromScene for WorldProblem {
    const KIND: &'static str = "world";

    fn pose(scene: &Scene) -> Result<Posed<Self>, InvalidProblem> {
        let scene = match scene {
            Scene::World(scene) => return Ok(Posed::exactly(scene.problem().clone())),
            Scene::Grid(scene) => scene,
        };
        let world = world_of(scene.map());
        let count = world.shapes().count();
        let (start, goal) = ends(scene);
        let radius = scene.robot().reach().max(THINNEST);
        Ok(Posed {
            problem: Self::new(world, radius, start, goal)?,
            conversion: Some(Conversion::Shapes(count)),
        })
    }

    fn follow(
        posed: &mut Posed<Self>,
        scene: &Scene,
        changes: &Changes,
    ) -> Result<Vec<WorldChange>, InvalidProblem> {
        let (scene, happened) = match (scene, changes) {
            (_, Changes::World(changes)) => return Ok(changes.clone()),
            (Scene::World(_), Changes::Grid(_)) => return Ok(Vec::new()),
            (Scene::Grid(scene), Changes::Grid(happened)) => (scene, happened),
        };
        let mut changes = Vec::new();
        let walls =
            |change: &GridChange| matches!(change, GridChange::Blocked(_) | GridChange::Freed(_));
        if happened.iter().any(walls) {
            let now = world_of(scene.map());
            posed.conversion = Some(Conversion::Shapes(now.shapes().count()));
            changes = between(posed.problem.world(), &now);
        }
        let (start, goal) = ends(scene);
        if start != posed.problem.start() {
            changes.push(WorldChange::StartMoved(start));
        }
        if goal != posed.problem.goal() {
            changes.push(WorldChange::GoalMoved(goal));
        }
        Ok(changes)
    }

    /// On a grid the world of its blocked cells is the judge that knows lines between cells; it is
    /// exact, and has marked the solution.
    fn read(posed: &Posed<Self>, _scene: &Scene, solved: &Solved<Self>) -> Option<Found> {
        // The middle of a cell is where its column and row say.
        let shift = match posed.conversion {
            Some(_) => 0.5,
            None => 0.0,
        };
        let point = |p: &Point| [p.x - shift, p.y - shift];
        Some(Found {
            costs: vec![solved.cost],
            lines: vec![solved.solution.iter().map(point).collect()],
        })
    }
}

fn ends(scene: &GridScene) -> (Point, Point) {
    let centre = |cell: Cell| Point::new(f64::from(cell.x) + 0.5, f64::from(cell.y) + 0.5);
    (centre(scene.from()), centre(scene.to()))
}

/// What turns one world of rectangles into another, shapes that stay left in peace.
fn between(before: &World, now: &World) -> Vec<WorldChange> {
    let key = |shape: &Shape| {
        let (min, max) = shape.bounding_box();
        [min.x, min.y, max.x, max.y].map(f64::to_bits)
    };
    let sorted = |world: &World| -> Vec<([u64; 4], ShapeId)> {
        let mut shapes: Vec<_> = world.shapes().map(|(id, s)| (key(s), id)).collect();
        shapes.sort_unstable();
        shapes
    };
    let missing_in = |others: &[([u64; 4], ShapeId)], shape: &([u64; 4], ShapeId)| {
        others
            .binary_search_by_key(&shape.0, |other| other.0)
            .is_err()
    };
    let (old, new) = (sorted(before), sorted(now));
    let gone = old.iter().filter(|shape| missing_in(&new, shape));
    let came = new.iter().filter(|shape| missing_in(&old, shape));
    let removed = gone.map(|(_, id)| WorldChange::Removed(*id));
    let added = came.filter_map(|(_, id)| now.shape(*id).cloned().map(WorldChange::Added));
    removed.chain(added).collect()
}
