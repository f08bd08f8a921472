//! Worlds to try waypoint planners on: obstacles anywhere between two opposite corners.

use super::shapes::{circle, pick, rectangle, shape};
use crate::{PlanRng, seeded};
use pf_geom::{Point, Rectangle, Shape, Vector, World, WorldProblem};
use rand::RngExt;

/// The side of the square.
const SIDE: f64 = 40.0;
/// How far obstacles keep from start and goal.
const SPARED: f64 = 3.0;

/// In a swarm's scene: the robot's radius, and how far danger reaches.
const SCENE_RADIUS: f64 = 0.2;
const SCENE_CLEARANCE: f64 = 0.8;

/// What lies between start and goal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Obstacles {
    /// Upright rectangles with sides from 2 to 6.
    Rectangles,
    /// Rectangles, circles, convex and other polygons, each within a circle of radius 1 to 3.
    Mixed,
}

/// The world of `seed` with `count` obstacles that may overlap, in a square with a side of 40; a
/// point starts within 3 of one corner of it and is to go within 3 of the opposite one. Neither end
/// has an obstacle within 3. There need be no path.
///
/// The same seed gives the same world, in this and every release until the changelog says otherwise.
///
/// # Panics
/// Never, but for a fault of its own.
///
/// ```
/// # use pf_conformance::world::{Obstacles, waypoint_world};
/// let problem = waypoint_world(7, 20, Obstacles::Rectangles);
/// assert_eq!(problem.world().shapes().count(), 20);
/// ```
#[must_use]
pub fn waypoint_world(seed: u64, count: usize, obstacles: Obstacles) -> WorldProblem {
    let mut rng = seeded(seed);
    let bounds = Rectangle::new(Point::origin(), Point::new(SIDE, SIDE)).expect("a square");
    let near = |rng: &mut PlanRng| rng.random_range(0.0..SPARED);
    let mut ends = [
        Point::new(near(&mut rng), near(&mut rng)),
        Point::new(SIDE - near(&mut rng), SIDE - near(&mut rng)),
    ];
    if *pick(&mut rng, &[true, false]) {
        ends = ends.map(|end| Point::new(end.x, SIDE - end.y));
    }
    let mut shapes: Vec<Shape> = Vec::new();
    while shapes.len() < count {
        let middle = Point::new(rng.random_range(0.0..SIDE), rng.random_range(0.0..SIDE));
        let another = match obstacles {
            Obstacles::Rectangles => {
                let half = Vector::new(rng.random_range(1.0..3.0), rng.random_range(1.0..3.0));
                rectangle(middle - half, middle + half)
            }
            Obstacles::Mixed => {
                let size = rng.random_range(1.0..3.0);
                shape(&mut rng, middle, size)
            }
        };
        let spares = |end: &Point| another.distance_to_point(*end) > SPARED;
        if ends.iter().all(spares) {
            shapes.push(another);
        }
    }
    let world = World::with_shapes(bounds, shapes);
    WorldProblem::new(world, 0.0, ends[0], ends[1]).expect("points within the square")
}

/// The scene of `seed` for a swarm: one obstacle, round or upright and rectangular, with a radius or
/// half sides from 0.5 to 1.5, near the middle of a square with a side of 10. A robot of radius 0.2 is
/// to go from one quadrant to the opposite one, which two depends on `quarter`; both ends are further
/// than 0.8 from the circle about the obstacle, and the straight line is not.
///
/// # Panics
/// Never, but for a fault of its own.
#[must_use]
pub fn quadrant_scene(seed: u64, round: bool, quarter: u64) -> WorldProblem {
    let mut rng = seeded(seed);
    let bounds = Rectangle::new(Point::origin(), Point::new(10.0, 10.0)).expect("a square");
    loop {
        let mut near =
            |from: f64, to: f64| Point::new(rng.random_range(from..to), rng.random_range(from..to));
        let (low, high, middle) = (near(0.0, 4.0), near(6.0, 10.0), near(3.5, 6.5));
        let half = near(0.5, 1.5).coords;
        let ends = match quarter % 4 {
            0 => [low, high],
            1 => [Point::new(high.x, low.y), Point::new(low.x, high.y)],
            2 => [high, low],
            _ => [Point::new(low.x, high.y), Point::new(high.x, low.y)],
        };
        let (obstacle, reach) = if round {
            (circle(middle.x, middle.y, half.x), half.x)
        } else {
            (rectangle(middle - half, middle + half), half.norm())
        };
        let about = circle(middle.x, middle.y, reach);
        let straight = pf_geom::Segment::new(ends[0], ends[1]);
        let clear = |end: &Point| about.distance_to_point(*end) > SCENE_CLEARANCE;
        if ends.iter().all(clear) && about.distance(&straight) < SCENE_CLEARANCE {
            let world = World::with_shapes(bounds, [obstacle]);
            let problem = WorldProblem::new(world, SCENE_RADIUS, ends[0], ends[1]);
            return problem.expect("points within the square");
        }
    }
}
