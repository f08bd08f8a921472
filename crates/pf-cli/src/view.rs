//! Scenes and paths as pictures.

use crate::spot::Spot;
use pf_geom::{Point, Raster, world_of};
use pf_grid::{Cell, Grid, GridChange};
use pf_planners::{Line, Scene};
use pf_render::{Line as Pen, Picture, Recorder};
use std::collections::BTreeSet;

/// What a picture shows besides the map and the path.
pub(crate) struct Shown<'a> {
    pub(crate) recorder: &'a Recorder,
    /// The cells that a world was cut into.
    pub(crate) raster: Option<&'a Raster>,
    pub(crate) expanded: bool,
    pub(crate) graph: bool,
    pub(crate) clearance: bool,
}

impl Shown<'_> {
    /// What the planner saw and knows, over the map.
    pub(crate) fn search(&self, mut picture: Picture) -> Picture {
        if let Some(raster) = self.raster {
            picture = rasterised(picture, raster);
        }
        if self.expanded {
            if !self.recorder.expanded().is_empty() {
                picture = picture.expanded(self.recorder.expanded());
            }
            picture = picture.reached(self.recorder.reached());
        }
        if self.graph {
            picture = picture.pieces(self.recorder.pieces());
        }
        picture
    }
}

/// The cells that a world was cut into.
pub(crate) fn rasterised(picture: Picture, raster: &Raster) -> Picture {
    let first = raster.centre(Cell::new(0, 0));
    let side = raster.cell_size();
    let corner = [first.x - side / 2.0, first.y - side / 2.0];
    picture.rasterised(raster.grid(), corner, side)
}

/// A scene's map, with what is too narrow for its robot.
pub(crate) fn ground(scene: &Scene) -> Picture {
    match scene {
        Scene::Grid(scene) => {
            let picture = Picture::of(scene.map());
            if scene.robot().reach() > 0.0 {
                return picture.inflated(scene.map(), scene.inflated());
            }
            picture
        }
        Scene::World(scene) => Picture::of_world(scene.world(), scene.robot().reach()),
    }
}

/// A path, and what the scene's robot sweeps on it if it is an answer.
pub(crate) fn path(picture: Picture, scene: &Scene, name: &str, pen: Pen, line: &Line) -> Picture {
    let points = on_picture(scene, line);
    match pen {
        Pen::Solid => swath(picture, scene, &points).line(name, pen, &points),
        Pen::Dashed => picture.line(name, pen, &points),
    }
}

/// What the scene's robot sweeps on its way.
fn swath(picture: Picture, scene: &Scene, points: &[[f64; 2]]) -> Picture {
    match scene.robot().radius {
        0.0 => picture,
        radius => picture.swath(points, radius),
    }
}

/// An answer coloured by its clearance.
pub(crate) fn coloured(picture: Picture, scene: &Scene, line: &Line) -> Picture {
    let points = on_picture(scene, line);
    let picture = swath(picture, scene, &points);
    let world = match scene {
        Scene::Grid(scene) => &world_of(scene.map()),
        Scene::World(scene) => scene.world(),
    };
    picture.clearance(&points, |[x, y]| world.clearance_at(Point::new(x, y)))
}

/// The points of a line in a picture's units: the cell 0,0 has its middle at 0.5,0.5.
pub(crate) fn on_picture(scene: &Scene, line: &Line) -> Vec<[f64; 2]> {
    let shift = match scene {
        Scene::Grid(_) => 0.5,
        Scene::World(_) => 0.0,
    };
    line.iter().map(|[x, y]| [x + shift, y + shift]).collect()
}

/// Start and goal.
pub(crate) fn ends(picture: Picture, scene: &Scene) -> Picture {
    let [start, goal] = end_points(scene);
    picture.end_points(start, goal)
}

/// Start and goal in a picture's units.
pub(crate) fn end_points(scene: &Scene) -> [[f64; 2]; 2] {
    match scene {
        Scene::Grid(scene) => {
            let middle = |cell: Cell| [f64::from(cell.x) + 0.5, f64::from(cell.y) + 0.5];
            [scene.from(), scene.to()].map(middle)
        }
        Scene::World(scene) => {
            let problem = scene.problem();
            [problem.start(), problem.goal()].map(|p| [p.x, p.y])
        }
    }
}

/// Where from and where to.
pub(crate) fn query(scene: &Scene) -> [Spot; 2] {
    match scene {
        Scene::Grid(scene) => [scene.from(), scene.to()].map(Spot::from),
        Scene::World(scene) => [scene.problem().start(), scene.problem().goal()].map(Spot::from),
    }
}

/// What became of a map.
pub(crate) fn changed(picture: Picture, before: &Scene, now: &Scene) -> Picture {
    match (before, now) {
        (Scene::Grid(before), Scene::Grid(now)) => {
            picture.changed(&between(before.map(), now.map()))
        }
        (Scene::World(before), Scene::World(now)) => {
            picture.shapes_changed(before.world(), now.world())
        }
        _ => picture,
    }
}

/// What turned one grid into another of its size.
fn between(before: &Grid, now: &Grid) -> Vec<GridChange> {
    let cells = |differs: &dyn Fn(Cell) -> bool| -> Vec<Cell> {
        now.layout().cells().filter(|&cell| differs(cell)).collect()
    };
    let blocked = cells(&|c| before.is_free(c) && !now.is_free(c));
    let freed = cells(&|c| !before.is_free(c) && now.is_free(c));
    let dearer = cells(&|c| before.is_free(c) && now.is_free(c) && before.cost(c) != now.cost(c));
    let costs: BTreeSet<u8> = dearer.iter().map(|&c| now.cost(c)).collect();
    let of_cost = |cost| {
        let cells = dearer.iter().copied().filter(|&c| now.cost(c) == cost);
        GridChange::CostChanged(cells.collect(), cost)
    };
    let mut changes = vec![GridChange::Blocked(blocked), GridChange::Freed(freed)];
    changes.extend(costs.into_iter().map(of_cost));
    changes
}
