//! Worlds with pockets on the way, for planners that do not know the map.

use super::{
    oracle::oracle,
    shapes::{pick, rectangle},
};
use crate::{PlanRng, seeded};
use pf_geom::{Point, Rectangle, Segment, Shape, Vector, World, WorldProblem};
use rand::RngExt;

/// The side of the square.
const SIDE: f64 = 50.0;
/// How far obstacles keep from start and goal.
const SPARED: f64 = 1.5;
/// No shortest path is longer.
const LONGEST: f64 = 100.0;
/// A robot of this radius can go there, too: no way leads through a gap that only a point passes.
const ROBOT: f64 = 0.25;

/// The world of `seed`: a square with a side of 50, a point that is to go from near one corner of it
/// to near the opposite one, one to three traps and up to twelve rectangles. A trap is a pocket
/// with arms from 4 to 12 and a back from 8 to 18 wide, or a corner with walls from 8 to 18; its inside
/// faces the start, and one at least lies on the straight line to the goal. The shortest path is at
/// most 100 long, and so is that of a robot of radius 0.25.
///
/// The same seed gives the same world, in this and every release until the changelog says otherwise.
///
/// # Panics
/// Never, but for a fault of its own.
///
/// ```
/// # use pf_conformance::world::{oracle, trap_world};
/// let problem = trap_world(7);
/// assert!(!problem.is_free(problem.start(), problem.goal()));
/// assert!(oracle(&problem).unwrap().length <= 100.0);
/// ```
#[must_use]
pub fn trap_world(seed: u64) -> WorldProblem {
    let mut rng = seeded(seed);
    loop {
        let problem = draw(&mut rng);
        let (start, goal) = (problem.start(), problem.goal());
        let wide = WorldProblem::new(problem.shared_world(), ROBOT, start, goal);
        let wide = wide.expect("the same ends");
        if oracle(&wide).is_some_and(|best| best.length <= LONGEST) {
            return problem;
        }
    }
}

/// From the lower left to the upper right, and then perhaps mirrored.
fn draw(rng: &mut PlanRng) -> WorldProblem {
    let mut near = |from: f64| {
        let mut along = || rng.random_range(from..from + 4.0);
        Point::new(along(), along())
    };
    let ends = [near(2.0), near(44.0)];
    let mut shapes = Vec::new();
    let traps = rng.random_range(1..=3);
    while shapes.len() < 2 * traps {
        let on_the_way = shapes.is_empty();
        let trap = trap(rng, ends, on_the_way);
        let straight = Segment::new(ends[0], ends[1]);
        let blocks = trap.iter().any(|wall| wall.blocks(&straight, 0.0));
        if (blocks || !on_the_way) && trap.iter().all(|wall| spares(wall, ends)) {
            shapes.extend(trap);
        }
    }
    for _ in 0..rng.random_range(0..=12) {
        let middle = Point::new(rng.random_range(0.0..SIDE), rng.random_range(0.0..SIDE));
        let half = Vector::new(rng.random_range(1.0..3.0), rng.random_range(1.0..3.0));
        let another = rectangle(middle - half, middle + half);
        if spares(&another, ends) {
            shapes.push(another);
        }
    }
    mirrored(rng, &shapes, ends)
}

fn spares(shape: &Shape, ends: [Point; 2]) -> bool {
    ends.iter()
        .all(|end| shape.distance_to_point(*end) > SPARED)
}

/// Walls about a place, open towards the lower left.
fn trap(rng: &mut PlanRng, [start, goal]: [Point; 2], on_the_way: bool) -> Vec<Shape> {
    let share = rng.random_range(0.3..0.75);
    let aside = if on_the_way { 2.0 } else { 15.0 };
    let mut shift = || rng.random_range(-aside..aside);
    let at = start + (goal - start) * share + Vector::new(shift(), shift());
    let thick = rng.random_range(1.0..2.0);
    // Corners relative to the place where the inside ends.
    let pocket = rng.random_bool(0.6);
    let walls: Vec<[(f64, f64); 2]> = if pocket {
        let (arm, half) = (rng.random_range(4.0..12.0), rng.random_range(4.0..9.0));
        vec![
            [(0.0, -half - thick), (thick, half + thick)],
            [(-arm, half), (0.0, half + thick)],
            [(-arm, -half - thick), (0.0, -half)],
        ]
    } else {
        let mut side = || rng.random_range(8.0..18.0);
        vec![
            [(0.0, -side()), (thick, thick)],
            [(-side(), 0.0), (0.0, thick)],
        ]
    };
    let upright = rng.random_bool(0.5);
    let place = |(x, y): (f64, f64)| {
        at + if upright {
            Vector::new(x, y)
        } else {
            Vector::new(y, x)
        }
    };
    let walls = walls.iter().map(|[low, high]| {
        let (a, b) = (place(*low), place(*high));
        rectangle(a.inf(&b), a.sup(&b))
    });
    walls.collect()
}

fn mirrored(rng: &mut PlanRng, shapes: &[Shape], ends: [Point; 2]) -> WorldProblem {
    let (flip_x, flip_y) = (*pick(rng, &[true, false]), *pick(rng, &[true, false]));
    let flip = |x: f64, flip: bool| if flip { SIDE - x } else { x };
    let placed = |p: Point| Point::new(flip(p.x, flip_x), flip(p.y, flip_y));
    let shapes = shapes.iter().map(|shape| {
        let (min, max) = shape.bounding_box();
        let (a, b) = (placed(min), placed(max));
        rectangle(a.inf(&b), a.sup(&b))
    });
    let [start, goal] = ends.map(placed);
    in_a_box(Point::new(SIDE, SIDE), shapes, start, goal)
}

fn in_a_box(
    corner: Point,
    shapes: impl IntoIterator<Item = Shape>,
    start: Point,
    goal: Point,
) -> WorldProblem {
    let bounds = Rectangle::new(Point::origin(), corner).expect("a box of some size");
    let world = World::with_shapes(bounds, shapes);
    WorldProblem::new(world, 0.0, start, goal).expect("points within the box")
}

/// A wall as thick as 0.5 from corner to corner, both on it.
fn wall(a: (f64, f64), b: (f64, f64)) -> Shape {
    let half = Vector::repeat(0.25);
    let (a, b) = (Point::new(a.0, a.1), Point::new(b.0, b.1));
    rectangle(a.inf(&b) - half, a.sup(&b) + half)
}

/// A point in the middle of a square spiral that has so many turns, with corridors 4 wide; the goal lies
/// outside, behind the wall that is furthest from the way out.
///
/// # Panics
/// Never, but for a fault of its own.
#[must_use]
pub fn spiral(turns: u32) -> WorldProblem {
    let width = 4.0;
    let reach = width * f64::from(turns) + 6.0;
    let middle = (reach, reach);
    let mut shapes = Vec::new();
    let mut at = (middle.0 - width / 2.0, middle.1 - width / 2.0);
    for side in 0..4 * turns {
        let length = width * f64::from(side / 2 + 1);
        let (dx, dy) = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)][(side % 4) as usize];
        let to = (at.0 + dx * length, at.1 + dy * length);
        shapes.push(wall(at, to));
        at = to;
    }
    let goal = Point::new(2.0 * reach - 1.5, reach);
    let start = Point::new(middle.0, middle.1);
    in_a_box(Point::new(2.0 * reach, 2.0 * reach), shapes, start, goal)
}

/// So many pockets, one in another, all open towards the start; the goal lies behind them.
///
/// # Panics
/// Never, but for a fault of its own.
#[must_use]
pub fn nested_traps(levels: u32) -> WorldProblem {
    let reach = 4.0 * f64::from(levels) + 4.0;
    let mut shapes = Vec::new();
    for level in 1..=levels {
        let half = 4.0 * f64::from(level);
        let back = reach + half;
        let front = reach - half / 2.0;
        let (low, high) = (reach - half, reach + half);
        shapes.push(wall((back, low), (back, high)));
        shapes.push(wall((front, low), (back, low)));
        shapes.push(wall((front, high), (back, high)));
    }
    let start = Point::new(1.0, reach);
    let goal = Point::new(2.0 * reach + 3.0, reach);
    let corner = Point::new(2.0 * reach + 4.0, 2.0 * reach);
    in_a_box(corner, shapes, start, goal)
}

/// A point in a corridor 4 wide that is closed towards the goal and as long as `length`, from 4.
///
/// # Panics
/// If it is shorter, or endless.
#[must_use]
pub fn dead_end(length: f64) -> WorldProblem {
    assert!(
        (4.0..1e6).contains(&length),
        "a corridor from 4 to a million"
    );
    let (low, high) = (8.0, 12.0);
    let end = 6.0 + length;
    let shapes = [
        wall((6.0, low), (end, low)),
        wall((6.0, high), (end, high)),
        wall((end, low), (end, high)),
    ];
    let start = Point::new(end - length / 2.0, 10.0);
    in_a_box(
        Point::new(end + 8.0, 20.0),
        shapes,
        start,
        Point::new(end + 6.0, 10.0),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_seed_one_world_and_a_way_out() {
        let boxes = |seed| {
            let problem = trap_world(seed);
            let shapes = problem
                .world()
                .shapes()
                .map(|(_, shape)| shape.bounding_box());
            shapes.collect::<Vec<_>>()
        };
        assert_eq!(boxes(3), boxes(3));
        assert_ne!(boxes(3), boxes(4));
        for problem in [
            spiral(1),
            spiral(3),
            nested_traps(1),
            nested_traps(3),
            dead_end(40.0),
        ] {
            assert!(!problem.is_free(problem.start(), problem.goal()));
            let free = |p| problem.is_free(p, p);
            assert!(free(problem.start()) && free(problem.goal()));
            assert!(oracle(&problem).is_some());
        }
    }
}
