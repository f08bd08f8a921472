//! Scenes and paths as pictures.

use crate::spot::Spot;
use pf_geom::{Point, Raster};
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
            let first = raster.centre(Cell::new(0, 0));
            let side = raster.cell_size();
            let corner = [first.x - side / 2.0, first.y - side / 2.0];
            picture = picture.rasterised(raster.grid(), corner, side);
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
    let radius = scene.robot().radius;
    if radius > 0.0 && pen == Pen::Solid {
        return picture.swath(&points, radius).line(name, pen, &points);
    }
    picture.line(name, pen, &points)
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
    match scene {
        Scene::Grid(scene) => picture.ends(scene.from(), scene.to()),
        Scene::World(scene) => {
            let pair = |p: Point| [p.x, p.y];
            let problem = scene.problem();
            picture.end_points(pair(problem.start()), pair(problem.goal()))
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
