//! From grids to worlds and back.

#![expect(clippy::unwrap_used, reason = "tests")]

use pf_core::{Context, PlanRng, Problem};
use pf_geom::{
    Answer, Circle, Point, Polygon, Raster, Rectangle, Segment, Shape, TangentGraph, World,
    WorldProblem, world_of,
};
use pf_grid::{Cell, Grid, GridCost, Moves};
use rand::{RngExt, SeedableRng};
use std::collections::BTreeMap;

fn random_grid(rng: &mut PlanRng, width: u32, height: u32, share: f64) -> Grid {
    // Blocks and specks: what maps are made of.
    let blocks: Vec<[u32; 4]> = (0..6)
        .map(|_| {
            let (x, y) = (rng.random_range(0..width), rng.random_range(0..height));
            [x, y, x + rng.random_range(0..9), y + rng.random_range(0..9)]
        })
        .collect();
    Grid::new(width, height, |c| {
        let in_block = |b: &[u32; 4]| b[0] <= c.x && c.x < b[2] && b[1] <= c.y && c.y < b[3];
        u8::from(!blocks.iter().any(in_block) && rng.random_range(0.0..1.0) >= share)
    })
    .unwrap()
}

fn cells(grid: &Grid) -> impl Iterator<Item = Cell> + '_ {
    grid.layout().cells()
}

fn centre(c: Cell) -> Point {
    Point::new(f64::from(c.x) + 0.5, f64::from(c.y) + 0.5)
}

/// The cheapest path, by Dijkstra's algorithm in a few lines.
fn shortest(grid: &Grid, moves: Moves, from: Cell, to: Cell) -> Option<(GridCost, Vec<Cell>)> {
    let mut open = BTreeMap::from([((GridCost::ZERO, from), from)]);
    let mut parents = BTreeMap::new();
    while let Some(((cost, at), parent)) = open.pop_first() {
        if parents.contains_key(&at) {
            continue;
        }
        parents.insert(at, parent);
        if at == to {
            let mut path = vec![at];
            while path[path.len() - 1] != from {
                path.push(parents[&path[path.len() - 1]]);
            }
            path.reverse();
            return Some((cost, path));
        }
        for (next, step) in grid.neighbours(at, moves) {
            open.entry((cost + step, next)).or_insert(at);
        }
    }
    None
}

fn free_cell(rng: &mut PlanRng, grid: &Grid) -> Option<Cell> {
    let free: Vec<Cell> = cells(grid).filter(|&c| grid.is_free(c)).collect();
    (!free.is_empty()).then(|| free[rng.random_range(0..free.len())])
}

#[test]
fn a_grids_world_covers_the_blocked_cells_and_nothing_else() {
    let mut rng = PlanRng::seed_from_u64(1);
    for round in 0..300 {
        let (width, height) = (rng.random_range(1..150), rng.random_range(1..40));
        let share = [0.0, 0.02, 0.3, 0.7, 1.0][round % 5];
        let grid = random_grid(&mut rng, width, height, share);
        let world = world_of(&grid);
        let at = |p: f64| {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "cells"
            )]
            let index = p as u32;
            assert!((p - f64::from(index)).abs() <= 0.0);
            index
        };
        let mut covered = vec![false; (width * height) as usize];
        for (_, shape) in world.shapes() {
            let Shape::Rectangle(r) = shape else {
                panic!("{shape:?} is no rectangle")
            };
            for y in at(r.min().y)..at(r.max().y) {
                for x in at(r.min().x)..at(r.max().x) {
                    assert!(!grid.is_free(Cell { x, y }));
                    let seen = &mut covered[(y * width + x) as usize];
                    *seen = true;
                }
            }
        }
        for c in cells(&grid) {
            assert_eq!(
                covered[(c.y * width + c.x) as usize],
                !grid.is_free(c),
                "{c}"
            );
        }
    }
}

#[test]
fn few_rectangles_suffice() {
    let count = |drawing: &str| world_of(&Grid::parse(drawing).unwrap()).shapes().count();
    assert_eq!(count("... ..."), 0);
    assert_eq!(count("### ###"), 1);
    assert_eq!(count("#.# .#. #.#"), 5);
    assert_eq!(count("##### #...# #...# #####"), 4);
    assert_eq!(count(".#. ### .#."), 2);
    assert_eq!(count("##.. .##. ..##"), 3);
    assert_eq!(count("#... ##.. ###. ####"), 4);
}

#[test]
fn a_legal_path_is_free_in_the_grids_world() {
    let mut rng = PlanRng::seed_from_u64(2);
    let (mut found, mut graph) = (0, TangentGraph::default());
    for round in 0..100 {
        let grid = random_grid(&mut rng, 24, 16, [0.05, 0.2, 0.35][round % 3]);
        let (Some(from), Some(to)) = (free_cell(&mut rng, &grid), free_cell(&mut rng, &grid))
        else {
            continue;
        };
        let world = world_of(&grid);
        let problem = WorldProblem::new(world, 0.0, centre(from), centre(to)).unwrap();
        for moves in Moves::ALL {
            let Some((cost, path)) = shortest(&grid, moves, from, to) else {
                continue;
            };
            found += 1;
            let points: Vec<Point> = path.iter().map(|&c| centre(c)).collect();
            let length = if points.len() > 1 {
                problem.judge(&points).unwrap()
            } else {
                0.0
            };
            assert!((length - cost.value()).abs() < 1e-9);
            let mut cx = Context::seeded(0);
            let Answer::Route(route) = graph.shortest(&problem, &mut cx) else {
                panic!("there is a path")
            };
            assert!(route.length() <= length + 1e-9);
        }
    }
    assert!(found > 150);
}

#[test]
fn the_raster_of_a_grids_world_is_the_grid() {
    let mut rng = PlanRng::seed_from_u64(3);
    for share in [0.0, 0.1, 0.4, 0.9] {
        let grid = random_grid(&mut rng, 70, 90, share);
        let raster = Raster::of(&world_of(&grid), 1.0, 0.0).unwrap();
        assert_eq!(*raster.grid(), grid);
        for c in cells(&grid) {
            assert_eq!(raster.cell_of(raster.centre(c)), c);
            assert_eq!(raster.centre(c), centre(c));
        }
    }
}

fn random_world(rng: &mut PlanRng, count: usize) -> World {
    let bounds = Rectangle::new(Point::new(-3.0, 2.0), Point::new(17.3, 15.9)).unwrap();
    let mut world = World::new(bounds);
    while world.next_id() < count {
        let at = Point::new(rng.random_range(-4.0..18.0), rng.random_range(1.0..17.0));
        let mut near = || Point::new(rng.random_range(-1.5..1.5), rng.random_range(-1.5..1.5));
        let (p, q) = (at + near().coords, at + near().coords);
        let shape = match world.next_id() % 4 {
            0 => Circle::new(at, (p - at).norm()).map(Shape::from),
            1 => Rectangle::new(p.inf(&q), p.sup(&q)).map(Shape::from),
            _ => {
                let corners = vec![p, q, at + near().coords, at + near().coords];
                Polygon::new(corners).map(Shape::from)
            }
        };
        if let Ok(shape) = shape {
            world.add(shape);
        }
    }
    world
}

/// The free cells are those that the robot can be anywhere in; the blocked ones it cannot.
#[test]
fn a_free_cell_is_free_everywhere() {
    let mut rng = PlanRng::seed_from_u64(4);
    let mut counts = [0u32; 2];
    for round in 0..27 {
        let count = rng.random_range(0..25);
        let world = random_world(&mut rng, count);
        let radius = [0.0, 0.3, 1.0][round % 3];
        let size = [0.1, 0.37, 1.0][round / 3 % 3];
        let raster = Raster::of(&world, size, radius).unwrap();
        for c in cells(raster.grid()) {
            let half = size / 2.0;
            let inside = |p: Point| world.bounds().contains(p);
            let middle = raster.centre(c);
            let corners = [(-half, -half), (half, -half), (half, half), (-half, half)]
                .map(|(x, y)| middle + pf_geom::Vector::new(x, y));
            let free = raster.grid().is_free(c);
            counts[usize::from(free)] += 1;
            if free {
                assert!(inside(middle));
                // Diagonals, sides and the lines between are all in the cell.
                for k in 0..4 {
                    for to in [corners[(k + 1) % 4], corners[(k + 2) % 4], middle] {
                        let (a, b) = (corners[k], to);
                        let (low, high) = (world.bounds().min(), world.bounds().max());
                        let within = |p: Point| p.sup(&low).inf(&high);
                        let way = Segment::new(within(a), within(b));
                        assert!(world.is_free(&way, radius), "{way:?}");
                    }
                }
            } else if corners.iter().all(|&p| inside(p)) {
                // Something is in reach of some point of the cell.
                let all = Rectangle::new(corners[0], corners[2]).unwrap();
                let reach = pf_geom::Vector::repeat(radius + 1e-9);
                let near = world.within(all.min() - reach, all.max() + reach);
                let sides = (0..4).map(|k| Segment::new(corners[k], corners[(k + 1) % 4]));
                let least = near.iter().flat_map(|&id| {
                    let shape = world.shape(id).unwrap();
                    let (min, max) = shape.bounding_box();
                    let swallowed = all.contains(min) && all.contains(max);
                    let near = sides.clone().map(move |side| shape.distance(&side));
                    near.chain(swallowed.then_some(0.0))
                });
                let least = least.fold(f64::INFINITY, f64::min);
                assert!(least <= radius + 1e-9, "{c} is blocked by nothing, {least}");
            }
        }
    }
    assert!(counts.iter().all(|&n| n > 5_000), "{counts:?}");
}

#[test]
fn a_path_of_the_raster_passes_the_worlds_judge() {
    let mut rng = PlanRng::seed_from_u64(5);
    let (mut found, mut beside) = (0, 0);
    for round in 0..150 {
        let world = random_world(&mut rng, 12);
        let radius = [0.0, 0.2, 0.5][round % 3];
        let raster = Raster::of(&world, 0.25, radius).unwrap();
        let mut point = || Point::new(rng.random_range(-3.0..17.3), rng.random_range(2.0..15.9));
        let problem = WorldProblem::new(world, radius, point(), point()).unwrap();
        let entry = |p| raster.entry(&problem, p);
        let (Some(from), Some(to)) = (entry(problem.start()), entry(problem.goal())) else {
            continue;
        };
        beside += u32::from(!raster.grid().is_free(raster.cell_of(problem.start())));
        for moves in Moves::ALL {
            if let Some((_, cells)) = shortest(raster.grid(), moves, from, to) {
                let path = raster.path(&problem, &cells).unwrap();
                let length = problem.judge(&path).unwrap();
                assert!(length >= (problem.goal() - problem.start()).norm() - 1e-9);
                found += 1;
            }
        }
    }
    assert!(found > 200 && beside > 5, "{found} {beside}");
}

/// The start's cell is blocked, its neighbour behind the wall is not.
#[test]
fn another_cell_joins_the_start_where_the_straight_way_is_blocked() {
    let bounds = Rectangle::new(Point::origin(), Point::new(4.0, 4.0)).unwrap();
    let wall = Rectangle::new(Point::new(1.9, 1.0), Point::new(1.95, 4.0)).unwrap();
    let world = World::with_shapes(bounds, [wall.into()]);
    let raster = Raster::of(&world, 1.0, 0.0).unwrap();
    assert_eq!(raster.grid().to_string(), "....\n.#..\n.#..\n.#..\n");
    let (start, goal) = (Point::new(1.99, 1.01), Point::new(0.5, 0.5));
    let problem = WorldProblem::new(world, 0.0, start, goal).unwrap();
    // From the cell left of the wall; it cannot be seen from the start.
    let cells = [(0, 1), (0, 0)].map(|(x, y)| Cell { x, y });
    let path = raster.path(&problem, &cells).unwrap();
    assert!(path.len() > 3 && problem.judge(&path).is_ok(), "{path:?}");
    assert_eq!(raster.path(&problem, &[]), None);
    // The robot stands where nothing can be reached.
    let boxed = [(0.4, 0.4), (1.6, 0.4), (0.4, 1.6), (1.6, 1.6)];
    let walls = [(0, 1), (0, 2), (1, 3), (2, 3)].map(|(a, b): (usize, usize)| {
        let (a, b) = (boxed[a], boxed[b]);
        let max = Point::new(b.0 + 0.1, b.1 + 0.1);
        Rectangle::new(Point::new(a.0, a.1), max).unwrap().into()
    });
    let world = World::with_shapes(bounds, walls);
    let raster = Raster::of(&world, 1.0, 0.0).unwrap();
    let start = Point::new(1.2, 1.2);
    let problem = WorldProblem::new(world, 0.0, start, Point::new(3.5, 3.5)).unwrap();
    assert_eq!(raster.entry(&problem, start), None);
    let cells = [(2, 2), (3, 3)].map(|(x, y)| Cell { x, y });
    assert_eq!(raster.path(&problem, &cells), None);
}

#[test]
fn too_many_cells_and_nonsense_are_refused() {
    let bounds = Rectangle::new(Point::origin(), Point::new(1e6, 1e6)).unwrap();
    let world = World::new(bounds);
    for (cell, radius) in [
        (1.0, 0.0),
        (1e-300, 0.0),
        (0.0, 0.0),
        (-1.0, 0.0),
        (f64::NAN, 0.0),
        (f64::INFINITY, 0.0),
        (1e3, -1.0),
        (1e3, f64::NAN),
    ] {
        assert!(Raster::of(&world, cell, radius).is_err(), "{cell} {radius}");
    }
    assert_eq!(Raster::of(&world, 1e7, 0.0).unwrap().grid().width(), 1);
}
