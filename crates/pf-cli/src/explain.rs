//! Why there is no path, as far as a map tells.

use pf_grid::{Cell, Clearance, Grid};
use pf_planners::Scene;

/// What stands between start and goal of a scene that has no path.
pub(crate) fn why(scene: &Scene) -> Vec<String> {
    let ends = [("start", scene.from()), ("goal", scene.to())];
    let blocked: Vec<_> = ends
        .into_iter()
        .filter_map(|(what, cell)| blocked(scene, what, cell))
        .collect();
    if !blocked.is_empty() {
        return blocked;
    }
    let robot = match scene.radius() {
        0.0 => String::new(),
        radius => format!(" wide enough for a robot of radius {radius}"),
    };
    let moves = scene.moves();
    vec![format!(
        "obstacles part start and goal: no way between them{robot} under the moves {moves}"
    )]
}

fn blocked(scene: &Scene, what: &str, cell: Cell) -> Option<String> {
    if scene.inflated().is_free(cell) {
        return None;
    }
    let fault = if scene.map().is_free(cell) {
        let clearance = crate::text::number(Clearance::of(scene.map()).at(cell));
        let radius = scene.radius();
        format!("the {what} {cell} has a clearance of {clearance} cells, the robot needs {radius}")
    } else {
        format!("the {what} {cell} is blocked")
    };
    Some(match nearest_free(scene.inflated(), cell) {
        Some(near) => format!("{fault}; the nearest cell it fits is {near}"),
        None => format!("{fault}; nor does it fit anywhere else"),
    })
}

/// The free cell nearest to another in a straight line; ties go to the upper, then the left one.
fn nearest_free(grid: &Grid, to: Cell) -> Option<Cell> {
    let square = |cell: &Cell| {
        let (dx, dy) = (cell.x.abs_diff(to.x), cell.y.abs_diff(to.y));
        u64::from(dx) * u64::from(dx) + u64::from(dy) * u64::from(dy)
    };
    let free = grid.layout().cells().filter(|&cell| grid.is_free(cell));
    free.min_by_key(square)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(drawing: &str, radius: f64, expected: &[&str]) {
        let grid = Grid::parse(drawing).unwrap();
        let goal = Cell::new(grid.width() - 1, 0);
        let scene = Scene::new(grid, Cell::new(0, 0), goal).unwrap();
        assert_eq!(why(&scene.with_radius(radius).unwrap()), expected);
    }

    #[test]
    fn it_says_what_stands_in_the_way() {
        check(
            "#.. ...",
            0.0,
            &["the start 0,0 is blocked; the nearest cell it fits is 1,0"],
        );
        check(
            "...# ....",
            0.0,
            &["the goal 3,0 is blocked; the nearest cell it fits is 2,0"],
        );
        check(
            "#.... .....",
            1.0,
            &["the start 0,0 is blocked; the nearest cell it fits is 2,0"],
        );
        check(
            "..... #....",
            1.0,
            &[
                "the start 0,0 has a clearance of 0.5 cells, the robot needs 1; the nearest cell it fits is 2,0",
            ],
        );
        check(
            "..#..",
            0.0,
            &[
                "obstacles part start and goal: no way between them under the moves no-corner-cutting",
            ],
        );
        check(
            "#",
            0.0,
            &[
                "the start 0,0 is blocked; nor does it fit anywhere else",
                "the goal 0,0 is blocked; nor does it fit anywhere else",
            ],
        );
    }
}
