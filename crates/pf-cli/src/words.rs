//! What happens in a scene, in a few words.

use crate::{spot::Spot, text};
use pf_geom::{Shape, ShapeId, WorldChange};
use pf_grid::{Cell, GridChange};
use pf_io::Names;
use pf_planners::Changes;

/// What a batch of changes does.
pub(crate) fn of(changes: &Changes, names: &Names) -> String {
    let words: Vec<_> = match changes {
        Changes::Grid(changes) => changes.iter().map(on_grid).collect(),
        Changes::World(changes) => changes.iter().map(|c| in_world(c, names)).collect(),
    };
    words.join(", ")
}

fn on_grid(change: &GridChange) -> String {
    let count = |cells: &[Cell]| match cells {
        [one] => format!("{one}"),
        many => format!("{} cells", many.len()),
    };
    match change {
        GridChange::StartMoved(cell) => format!("start to {cell}"),
        GridChange::GoalMoved(cell) => format!("goal to {cell}"),
        GridChange::Blocked(cells) => format!("{} blocked", count(cells)),
        GridChange::Freed(cells) => format!("{} freed", count(cells)),
        GridChange::CostChanged(cells, cost) => format!("{} cost {cost}", count(cells)),
    }
}

fn in_world(change: &WorldChange, names: &Names) -> String {
    match change {
        WorldChange::StartMoved(p) => format!("start to {}", Spot::from(*p)),
        WorldChange::GoalMoved(p) => format!("goal to {}", Spot::from(*p)),
        WorldChange::Added(shape) => format!("a {} added", kind(shape)),
        WorldChange::Removed(id) => format!("{} removed", shape(*id, names)),
        WorldChange::Moved(id, by) => {
            let (x, y) = (text::number(by.x), text::number(by.y));
            format!("{} moved by {x},{y}", shape(*id, names))
        }
    }
}

/// A shape by its name, else by its id.
pub(crate) fn shape(id: ShapeId, names: &Names) -> String {
    match names.of(id) {
        Some(name) => name.to_owned(),
        None => format!("shape {id}"),
    }
}

pub(crate) fn kind(shape: &Shape) -> &'static str {
    match shape {
        Shape::Circle(_) => "circle",
        Shape::Rectangle(_) => "rectangle",
        Shape::Polygon(_) => "polygon",
    }
}
