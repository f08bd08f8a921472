//! Teams made up by seed.

use crate::{
    PlanRng, seeded,
    world::{
        Obstacles,
        shapes::{circle, rectangle, shape},
    },
};
use pf_geom::{Point, Rectangle, Robot, Segment, Shape, TeamProblem, Vector, World};
use rand::RngExt;
use std::f64::consts::{PI, TAU};

/// The side of the square.
const SIDE: f64 = 100.0;

/// What a team made up is to be like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TeamRecipe {
    /// How many robots.
    pub robots: usize,
    /// Their radius.
    pub radius: f64,
    /// How many obstacles.
    pub obstacles: usize,
    /// Of which kind; discs of radius 3 to 6 if it is none.
    pub kind: Option<Obstacles>,
}

/// The team of `seed`: robots spread over a circle about the middle of a square with a side of 100,
/// each on its way to the other side, a little off the middle; obstacles anywhere, but not near starts
/// and goals. Robots do not overlap there; a plan there almost always is, but nobody has looked.
///
/// The same seed gives the same team, in this and every release until the changelog says otherwise.
///
/// # Panics
/// If there is no room for so many or so large robots on the circle.
///
/// ```
/// # use pf_conformance::team::{TeamRecipe, crossing};
/// let recipe = TeamRecipe { robots: 10, radius: 1.0, obstacles: 20, kind: None };
/// let team = crossing(7, &recipe);
/// assert_eq!((team.robots().len(), team.world().shapes().count()), (10, 20));
/// assert_eq!(team.dead_end(), None);
/// ```
#[must_use]
pub fn crossing(seed: u64, recipe: &TeamRecipe) -> TeamProblem {
    let mut rng = seeded(seed);
    let middle = Point::new(SIDE / 2.0, SIDE / 2.0);
    let bounds = Rectangle::new(Point::origin(), Point::new(SIDE, SIDE)).expect("a square");
    let on_circle = |angle: f64| middle + Vector::new(angle.cos(), angle.sin()) * (SIDE * 0.46);
    let turn = rng.random_range(0.0..TAU);
    let share = TAU / f64::from(u32::try_from(recipe.robots).expect("a number of robots"));
    let mut angle = turn - share;
    let robots = (0..recipe.robots).map(|_| {
        angle += share;
        // So little off that neighbours keep their distance.
        let off = rng.random_range(-0.2..0.2) * share.min(1.0);
        let (start, goal) = (on_circle(angle), on_circle(angle + PI + off));
        Robot::new(start, goal).with_radius(recipe.radius)
    });
    let robots: Vec<Robot> = robots.collect();
    let room = 2.0 * recipe.radius + 2.0;
    let mut shapes: Vec<Shape> = Vec::new();
    while shapes.len() < recipe.obstacles {
        let another = obstacle(&mut rng, recipe.kind);
        let near = |p: Point| another.distance(&Segment::new(p, p)) < room;
        if !robots
            .iter()
            .any(|robot| near(robot.start) || near(robot.goal))
        {
            shapes.push(another);
        }
    }
    TeamProblem::new(World::with_shapes(bounds, shapes), robots).expect("robots within the square")
}

fn obstacle(rng: &mut PlanRng, kind: Option<Obstacles>) -> Shape {
    let middle = Point::new(rng.random_range(0.0..SIDE), rng.random_range(0.0..SIDE));
    let size = rng.random_range(3.0..6.0);
    match kind {
        None => circle(middle.x, middle.y, size),
        Some(Obstacles::Mixed) => shape(rng, middle, size),
        Some(Obstacles::Rectangles) => {
            let half = Vector::new(size, rng.random_range(3.0..6.0));
            rectangle(middle - half, middle + half)
        }
    }
}
