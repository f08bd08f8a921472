//! Why there is no path, as far as a map tells.

use crate::{question::Question, spot::Spot, text, words};
use pf_geom::{Point, Segment};
use pf_grid::{Cell, Clearance, Grid};
use pf_planners::{GridScene, Robot, Scene, WorldScene};

/// What stands between start and goal of a question that has no path.
pub(crate) fn why(question: &Question) -> Vec<String> {
    let (blocked, rules) = match &question.scene {
        Scene::Grid(scene) => {
            let ends = [("start", scene.from()), ("goal", scene.to())];
            let blocked = ends.map(|(what, cell)| blocked_cell(scene, what, cell));
            (blocked, format!(" under the moves {}", scene.moves()))
        }
        Scene::World(scene) => {
            let problem = scene.problem();
            let ends = [("start", problem.start()), ("goal", problem.goal())];
            let blocked = ends.map(|(what, p)| blocked_point(question, scene, what, p));
            (blocked, String::new())
        }
    };
    let blocked: Vec<_> = blocked.into_iter().flatten().collect();
    if !blocked.is_empty() {
        return blocked;
    }
    let robot = match question.scene.robot() {
        Robot {
            radius: 0.0,
            clearance: 0.0,
        } => String::new(),
        robot => format!(" wide enough for a robot of {}", size(robot)),
    };
    vec![format!(
        "obstacles part start and goal: no way between them{robot}{rules}"
    )]
}

/// A robot's radius, and the room it is to keep if it is to keep some.
pub(crate) fn size(robot: Robot) -> String {
    match robot.clearance {
        0.0 => format!("radius {}", robot.radius),
        clearance => format!("radius {} and clearance {clearance}", robot.radius),
    }
}

fn blocked_cell(scene: &GridScene, what: &str, cell: Cell) -> Option<String> {
    if scene.inflated().is_free(cell) {
        return None;
    }
    let fault = if scene.map().is_free(cell) {
        let clearance = text::number(Clearance::of(scene.map()).at(cell));
        let needed = scene.robot().reach();
        format!("the {what} {cell} has a clearance of {clearance} cells, the robot needs {needed}")
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

fn blocked_point(question: &Question, scene: &WorldScene, what: &str, p: Point) -> Option<String> {
    let problem = scene.problem();
    if problem.is_free(p, p) {
        return None;
    }
    let (distance, id) = problem.world().nearest(&Segment::new(p, p))?;
    let (place, shape) = (Spot::from(p), words::shape(id, &question.names));
    let kind = problem.world().shape(id).map_or("shape", words::kind);
    let fault = if distance > 0.0 {
        let (distance, needed) = (text::number(distance), scene.robot().reach());
        format!("the {what} {place} is {distance} from {shape}, a {kind}; the robot needs {needed}")
    } else {
        format!("the {what} {place} lies in {shape}, a {kind}")
    };
    Some(match near(scene, p) {
        Some(near) => format!("{fault}; near by it fits at {}", Spot::from(near)),
        None => fault,
    })
}

/// A place near a point where the robot fits, in few digits: on the smallest of some circles.
fn near(scene: &WorldScene, p: Point) -> Option<Point> {
    const ROUND: u32 = 64;
    const CIRCLES: i32 = 60;
    let (problem, bounds) = (scene.problem(), scene.world().bounds());
    let size = (bounds.max() - bounds.min()).norm();
    // Three digits of the smallest circle are more than anyone wants to read.
    let grain = 10f64.powf((size / 1e4).log10().floor());
    let round = |v: f64| text::short((v / grain).round() * grain);
    (0..CIRCLES).find_map(|k| {
        let radius = size / 1000.0 * 1.12f64.powi(k);
        let mut around = (0..ROUND).map(|k| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(ROUND)).sin_cos();
            Point::new(round(p.x + radius * cos), round(p.y + radius * sin))
        });
        around.find(|&q| bounds.contains(q) && problem.is_free(q, q))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use pf_geom::{Rectangle, World};

    #[track_caller]
    fn check(drawing: &str, radius: f64, expected: &[&str]) {
        let grid = Grid::parse(drawing).unwrap();
        let goal = Cell::new(grid.width() - 1, 0);
        let scene = GridScene::new(grid, Cell::new(0, 0), goal).unwrap();
        let scene = scene.with_robot(Robot::of_radius(radius)).unwrap();
        assert_eq!(why(&Question::of("m", scene)), expected);
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

    #[track_caller]
    fn check_world(from: [f64; 2], robot: Robot, expected: &str) {
        let p = |[x, y]: [f64; 2]| Point::new(x, y);
        let rectangle = |min, max| Rectangle::new(p(min), p(max)).unwrap();
        let wall = rectangle([4.0, -10.0], [6.0, 20.0]);
        let world = World::with_shapes(rectangle([0.0, 0.0], [10.0, 10.0]), [wall.into()]);
        let scene = WorldScene::new(world, robot, p(from), p([9.0, 5.0])).unwrap();
        assert_eq!(why(&Question::of("w", scene)), [expected]);
    }

    #[test]
    fn it_says_what_stands_in_the_way_in_worlds() {
        let point = Robot::default();
        check_world(
            [5.0, 5.0],
            point,
            "the start 5,5 lies in shape 0, a rectangle; near by it fits at 6.049,5",
        );
        check_world(
            [3.5, 5.0],
            Robot::of_radius(1.0),
            "the start 3.5,5 is 0.5 from shape 0, a rectangle; the robot needs 1; near by it fits at 2.991,5.154",
        );
        let robot = Robot {
            radius: 0.5,
            clearance: 0.25,
        };
        check_world(
            [1.0, 1.0],
            robot,
            "obstacles part start and goal: no way between them wide enough for a robot of radius 0.5 and clearance 0.25",
        );
    }
}
