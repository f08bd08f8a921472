//! Planners on maps they were not made for.
#![expect(clippy::unwrap_used, reason = "what fails here is the test")]

use pf_core::Problem;
use pf_geom::{Circle, Point, Rectangle, Shape, Vector, World, WorldChange};
use pf_grid::{Cell, Grid, GridChange, Moves};
use pf_planners::{Answer, Changes, GridScene, Order, Robot, Scene, WorldScene, find};

#[track_caller]
fn ask(planner: &str, scene: &Scene) -> Answer {
    let mut runner = find(planner).unwrap().runner(&[]).unwrap();
    runner.plan(scene, Order::seeded(0)).unwrap()
}

fn note<'a>(answer: &'a Answer, key: &str) -> &'a str {
    let note = answer.notes.iter().find(|note| note.key == key);
    note.map_or("", |note| &note.text)
}

/// Numbers that look random, from 0 to below 1.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        #[expect(clippy::cast_precision_loss, reason = "53 bits")]
        let number = (self.0 >> 11) as f64 / (1u64 << 53) as f64;
        number
    }

    fn point(&mut self) -> Point {
        Point::new(20.0 * self.next(), 20.0 * self.next())
    }
}

fn grid(numbers: &mut Numbers, size: u32, blocked: f64) -> GridScene {
    let end = Cell::new(size - 1, size - 1);
    let mut free = |cell: Cell| cell == end || cell == Cell::new(0, 0) || numbers.next() >= blocked;
    let grid = Grid::new(size, size, |cell| u8::from(free(cell))).unwrap();
    GridScene::new(grid, Cell::new(0, 0), end).unwrap()
}

fn shape(numbers: &mut Numbers) -> Shape {
    let (at, size) = (numbers.point(), 0.3 + 2.0 * numbers.next());
    if numbers.next() < 0.5 {
        return Circle::new(at, size).unwrap().into();
    }
    let diagonal = Vector::new(size, 0.3 + 2.0 * numbers.next());
    Rectangle::new(at, at + diagonal).unwrap().into()
}

fn world(numbers: &mut Numbers, shapes: usize) -> WorldScene {
    let bounds = Rectangle::new(Point::origin(), Point::new(20.0, 20.0)).unwrap();
    let shapes: Vec<_> = (0..shapes).map(|_| shape(numbers)).collect();
    let world = World::with_shapes(bounds, shapes);
    let robot = Robot::of_radius(0.4 * numbers.next());
    WorldScene::new(world, robot, numbers.point(), numbers.point()).unwrap()
}

#[test]
fn straight_ways_on_a_grid_are_never_longer_and_claim_no_proof() {
    let mut numbers = Numbers(1);
    let (mut ways, mut walls) = (0, 0);
    for k in 0..200 {
        let scene: Scene = grid(&mut numbers, 6 + k % 9, 0.35).into();
        let (steps, straight) = (ask("astar", &scene), ask("visibility-graph", &scene));
        match (steps.outcome, straight.outcome) {
            ("optimal", "feasible") => {
                ways += 1;
                let (from, to) = (&steps.lines[0], &straight.lines[0]);
                assert_eq!((from[0], from.last()), (to[0], to.last()));
                assert!(straight.costs[0] <= steps.costs[0] + 1e-3);
                assert!(note(&straight, "converted").contains("rectangles"));
            }
            ("infeasible", "unknown") => {
                walls += 1;
                assert!(note(&straight, "unproved").contains("no way"));
            }
            other => panic!("{other:?}"),
        }
    }
    assert!(ways > 50 && walls > 30, "{ways} {walls}");
}

#[test]
fn nobody_slips_through_a_wall_of_cells() {
    // Cells that meet at corners only, and rows that meet along a seam.
    for drawing in [
        ".#. #.# .#.",
        "..#. .#.. #... ....",
        "...#### .###... ##..... .......",
    ] {
        let grid = Grid::parse(drawing).unwrap();
        let end = Cell::new(grid.width() - 1, grid.height() - 1);
        let scene = GridScene::new(grid, Cell::new(0, 0), end).unwrap();
        let scene: Scene = scene.with_moves(Moves::OnlyWhenNoObstacles).into();
        assert_eq!(ask("astar", &scene).outcome, "infeasible", "{drawing}");
        assert_eq!(
            ask("visibility-graph", &scene).outcome,
            "unknown",
            "{drawing}"
        );
    }
}

#[test]
fn cells_of_a_world_give_paths_that_its_judge_accepts() {
    let mut numbers = Numbers(2);
    let (mut ways, mut none) = (0, 0);
    for k in 0..200 {
        let world = world(&mut numbers, 5 + k % 30);
        let scene: Scene = world.clone().into();
        let (cells, exact) = (ask("astar", &scene), ask("visibility-graph", &scene));
        assert!(
            note(&cells, "converted").contains("cells of 0."),
            "{cells:?}"
        );
        match cells.outcome {
            "feasible" => {
                ways += 1;
                let path: Vec<_> = cells.lines[0]
                    .iter()
                    .map(|&[x, y]| Point::new(x, y))
                    .collect();
                let problem = world.problem();
                assert_eq!(
                    problem.judge(&path).map(f64::to_bits),
                    Ok(cells.costs[0].to_bits())
                );
                assert_eq!(
                    (path[0], path[path.len() - 1]),
                    (problem.start(), problem.goal())
                );
                assert_eq!(exact.outcome, "optimal");
                assert!(exact.costs[0] <= cells.costs[0] + 1e-3);
            }
            "unknown" => none += 1,
            other => panic!("{other}"),
        }
        if exact.outcome == "infeasible" {
            assert_eq!(cells.outcome, "unknown");
        }
    }
    assert!(ways > 100 && none > 5, "{ways} {none}");
}

#[test]
fn changes_reach_planners_on_converted_maps() {
    let mut numbers = Numbers(3);
    for _ in 0..10 {
        let mut scene: Scene = world(&mut numbers, 20).into();
        let mut runner = find("d-star-lite").unwrap().runner(&[]).unwrap();
        runner.plan(&scene, Order::seeded(0)).unwrap();
        for k in 0..6 {
            let change = match k % 4 {
                0 => WorldChange::Added(shape(&mut numbers)),
                1 => WorldChange::Moved(k, Vector::new(0.7, -0.4)),
                2 => WorldChange::GoalMoved(numbers.point()),
                _ => WorldChange::Removed(k),
            };
            let followed = scene.change(&Changes::World(vec![change])).unwrap();
            let answer = runner.replan(&scene, &followed, Order::seeded(0)).unwrap();
            let fresh = ask("astar", &scene);
            assert_eq!(answer.outcome, fresh.outcome);
            for (cost, fresh) in answer.costs.iter().zip(&fresh.costs) {
                // Paths of equal cost from cell to cell may be joined to the ends differently.
                assert!((cost - fresh).abs() < 0.2, "{cost} {fresh}");
            }
        }
        let mut scene: Scene = grid(&mut numbers, 12, 0.2).into();
        let mut runner = find("visibility-graph").unwrap().runner(&[]).unwrap();
        runner.plan(&scene, Order::seeded(0)).unwrap();
        for k in 0..6u32 {
            let cells = vec![Cell::new(3 + k, 5), Cell::new(5, 2 + k)];
            let change = match k % 3 {
                0 => GridChange::Blocked(cells),
                1 => GridChange::Freed(cells),
                _ => GridChange::StartMoved(Cell::new(k, 0)),
            };
            let followed = scene.change(&Changes::Grid(vec![change])).unwrap();
            let answer = runner.replan(&scene, &followed, Order::seeded(0)).unwrap();
            let fresh = ask("visibility-graph", &scene);
            assert_eq!(answer.outcome, fresh.outcome);
            for (cost, fresh) in answer.costs.iter().zip(&fresh.costs) {
                assert!((cost - fresh).abs() < 1e-3, "{cost} {fresh}");
            }
        }
    }
}

#[test]
fn changes_of_another_kind_are_refused() {
    let mut scene: Scene = world(&mut Numbers(4), 3).into();
    let change = Changes::Grid(vec![GridChange::GoalMoved(Cell::new(1, 1))]);
    let error = scene.change(&change).unwrap_err().to_string();
    assert!(error.contains("a world"), "{error}");
}
