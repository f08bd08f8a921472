//! Worlds made up by seed, for tests in their thousands.

use super::shapes::{fitted, pick, rectangle, shape};
use crate::PlanRng;
use pf_geom::{Point, Rectangle, Shape, Vector, World, WorldProblem};
use rand::RngExt;
use std::{f64::consts::TAU, ops::RangeInclusive};

/// What a made-up world looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Shapes anywhere.
    Scattered,
    /// Shapes in heaps.
    Clustered,
    /// Walls across the world, each with a gap; some are just as wide as the robot, or no gap for
    /// a hair.
    Corridors,
    /// Rooms with doors, some of them just as wide as the robot or too narrow by a hair.
    Rooms,
    /// A ring without a gap around the start or the goal: there is no path.
    Closed,
}

impl Kind {
    /// Every kind.
    pub const ALL: [Self; 5] = [
        Self::Scattered,
        Self::Clustered,
        Self::Corridors,
        Self::Rooms,
        Self::Closed,
    ];
}

/// What to make up.
#[derive(Clone, Debug)]
pub struct Recipe {
    /// What the world looks like.
    pub kind: Kind,
    /// How many shapes, from 5.
    pub shapes: RangeInclusive<usize>,
    /// The robot's radius, from 0.
    pub radius: f64,
    /// How full it is, from 0 to 1: the share that the shapes cover, grown by the robot's radius
    /// and not counting overlaps; in rooms, the share of doors left out.
    pub density: f64,
}

impl Recipe {
    /// Everything at random but the number of shapes: radii from 0 to 1, often just 0.
    pub fn any(rng: &mut PlanRng, shapes: RangeInclusive<usize>) -> Self {
        Self {
            kind: *pick(rng, &Kind::ALL),
            shapes,
            radius: if rng.random_bool(0.3) {
                0.0
            } else {
                rng.random_range(0.0..=1.0)
            },
            density: rng.random_range(0.05..0.5),
        }
    }
}

/// A problem by `recipe`. Start and goal are free where there is room for the robot.
///
/// The same generator state gives the same problem, in this and every release until the changelog
/// says otherwise.
///
/// # Panics
/// If the recipe asks for what cannot be: no density, no radius, no number of shapes.
///
/// ```
/// # use pf_conformance::{world::{Kind, Recipe, random_world}, seeded};
/// let recipe = Recipe { kind: Kind::Rooms, shapes: 10..=200, radius: 0.5, density: 0.2 };
/// let problem = random_world(&mut seeded(7), &recipe);
/// assert!(problem.is_free(problem.start(), problem.start()));
/// ```
pub fn random_world(rng: &mut PlanRng, recipe: &Recipe) -> WorldProblem {
    let number = rng.random_range(recipe.shapes.clone());
    let mut draft = match recipe.kind {
        Kind::Scattered => Draft::of_side(side(number, recipe)),
        Kind::Clustered => clustered(rng, number, recipe),
        Kind::Corridors => corridors(rng, number, recipe),
        Kind::Rooms => rooms(rng, number, recipe),
        Kind::Closed => closed(rng, number, recipe),
    };
    // What is left comes anywhere.
    while draft.shapes.len() < number {
        let middle = draft.point(rng);
        let size = rng.random_range(0.3..1.0) * draft.litter;
        let more = shape(rng, middle, size);
        if draft.spares(&more, recipe.radius) {
            draft.shapes.push(more);
        }
    }
    draft.problem(rng, recipe)
}

/// The largest shapes that lie about have this radius.
const LARGEST: f64 = 1.5;

/// A world in the making.
struct Draft {
    bounds: Rectangle,
    shapes: Vec<Shape>,
    /// How large things may be that lie about.
    litter: f64,
    /// An end in the middle of a ring, and the ring's radius.
    inside: Option<(Point, f64)>,
}

/// The side of a square that so many shapes fill.
fn side(number: usize, recipe: &Recipe) -> f64 {
    let mean = LARGEST * 0.6 + recipe.radius;
    (count(number) * mean * mean * 2.5 / recipe.density).sqrt()
}

#[expect(clippy::cast_precision_loss, reason = "a number of shapes")]
fn count(number: usize) -> f64 {
    number as f64
}

impl Draft {
    fn of_side(side: f64) -> Self {
        Self {
            bounds: Rectangle::new(Point::origin(), Point::new(side, side))
                .expect("a density and a number of shapes above 0"),
            shapes: vec![],
            litter: LARGEST,
            inside: None,
        }
    }

    fn side(&self) -> f64 {
        self.bounds.max().x
    }

    fn point(&self, rng: &mut PlanRng) -> Point {
        let side = self.side();
        Point::new(rng.random_range(0.0..=side), rng.random_range(0.0..=side))
    }

    /// Whether a shape leaves room for the end in the middle of the ring.
    fn spares(&self, shape: &Shape, radius: f64) -> bool {
        self.inside
            .is_none_or(|(end, _)| shape.distance_to_point(end) > radius)
    }

    /// Start and goal are put far apart, where there is room.
    fn problem(self, rng: &mut PlanRng, recipe: &Recipe) -> WorldProblem {
        let world = World::with_shapes(self.bounds, self.shapes.iter().cloned());
        let problem = WorldProblem::new(world, recipe.radius, Point::origin(), Point::origin());
        let empty = problem.expect("a radius from 0");
        let free = |p: Point| empty.is_free(p, p);
        let mut best = [self.point(rng), self.point(rng)];
        let mut most = (0, 0.0);
        for _ in 0..400 {
            let mut ends = [self.point(rng), self.point(rng)];
            let mut outside = true;
            if let Some((end, ring)) = self.inside {
                ends[0] = end;
                outside = (ends[1] - end).norm() > ring;
            }
            let good = ends.iter().filter(|&&end| free(end)).count() + usize::from(outside);
            let found = (good, (ends[1] - ends[0]).norm());
            if found > most {
                (best, most) = (ends, found);
            }
            if good == 3 && found.1 > self.side() / 2.0 {
                break;
            }
        }
        if rng.random_bool(0.5) {
            best.reverse();
        }
        let problem = WorldProblem::new(empty.shared_world(), recipe.radius, best[0], best[1]);
        problem.expect("points within the bounds")
    }
}

fn clustered(rng: &mut PlanRng, number: usize, recipe: &Recipe) -> Draft {
    let mut draft = Draft::of_side(side(number, recipe));
    let heaps: Vec<_> = (0..number.div_ceil(8)).map(|_| draft.point(rng)).collect();
    for _ in 0..number - number / 8 {
        let spread = rng.random_range(0.0..3.0);
        let direction = rng.random_range(0.0..TAU);
        let away = Vector::new(direction.cos(), direction.sin()) * spread;
        let (heap, size) = (*pick(rng, &heaps), rng.random_range(0.3..LARGEST));
        draft.shapes.push(shape(rng, heap + away, size));
    }
    draft
}

/// A gap for a robot of `radius`: mostly with room to spare, sometimes just as wide as the robot,
/// seldom too narrow by a hair.
fn gap(rng: &mut PlanRng, radius: f64) -> f64 {
    match rng.random_range(0..20) {
        0..15 => 2.0 * radius + rng.random_range(0.1..2.0),
        15..19 => 2.0 * radius,
        _ => (2.0 * radius - 1e-6).max(0.0),
    }
}

fn corridors(rng: &mut PlanRng, number: usize, recipe: &Recipe) -> Draft {
    let walls = (number / 3).max(1);
    let mut heights = vec![];
    let mut top = 0.0;
    for _ in 0..walls {
        let below: f64 = top + gap(rng, recipe.radius).max(0.3);
        top = below + rng.random_range(0.2..1.0);
        heights.push((below, top));
    }
    let mut draft = Draft::of_side(top + 2.0 * recipe.radius + 1.0);
    draft.litter = 0.2;
    let side = draft.side();
    for (below, above) in heights {
        let gap = gap(rng, recipe.radius).min(side);
        let from = if rng.random_bool(0.3) {
            *pick(rng, &[0.0, side - gap])
        } else {
            rng.random_range(0.0..=side - gap)
        };
        // The centre of a robot without a radius may pass along the bounds, unless a wall goes on.
        let beyond = *pick(rng, &[0.0, 1.0, 1.0, 1.0]);
        for (left, right) in [(-beyond, from), (from + gap, side + beyond)] {
            if left < right {
                draft
                    .shapes
                    .push(rectangle(Point::new(left, below), Point::new(right, above)));
            }
        }
    }
    draft
}

fn rooms(rng: &mut PlanRng, number: usize, recipe: &Recipe) -> Draft {
    // A wall with a door is two shapes, and n * n rooms have 2 * n * (n - 1) walls between them.
    let across = (2..=number)
        .take_while(|n| 4 * n * (n - 1) <= number)
        .last();
    let across = across.unwrap_or(1);
    let room = 4.0 * recipe.radius + rng.random_range(3.0..6.0);
    let mut draft = Draft::of_side(count(across) * room);
    draft.litter = 0.4;
    let half = rng.random_range(0.05..0.3);
    for i in 1..across {
        for j in 0..across {
            let (wall, from) = (count(i) * room, count(j) * room);
            let gap = gap(rng, recipe.radius);
            let door = from + rng.random_range(half..=(room - half - gap));
            let (begin, end) = (from - half, from + room + half);
            let mut pieces = vec![(begin, door), (door + gap, end)];
            if rng.random_bool(recipe.density / 2.0) {
                pieces = vec![(begin, end)];
            }
            for upright in [true, false] {
                draft.shapes.extend(pieces.iter().map(|&(a, b)| {
                    let (low, high) = (Vector::new(wall - half, a), Vector::new(wall + half, b));
                    let turned = |v: Vector| if upright { v } else { v.yx() };
                    rectangle(Point::from(turned(low)), Point::from(turned(high)))
                }));
            }
        }
    }
    draft
}

fn closed(rng: &mut PlanRng, number: usize, recipe: &Recipe) -> Draft {
    let distance = 2.0 * recipe.radius + rng.random_range(2.0..4.0);
    let least = 3.0 * distance + 2.0 * recipe.radius + 2.0;
    let mut draft = Draft::of_side(side(number, recipe).max(least));
    let range = 1.5 * distance..draft.side() - 1.5 * distance;
    let middle = Point::new(rng.random_range(range.clone()), rng.random_range(range));
    if number < 14 || rng.random_bool(0.2) {
        // Four walls.
        let out = distance + rng.random_range(0.2..1.0);
        for turn in 0..4 {
            let (low, high) = (Vector::new(distance, -out), Vector::new(out, out));
            let turned = |v: Vector| (0..turn).fold(v, |v, _| Vector::new(-v.y, v.x));
            let (a, b) = (middle + turned(low), middle + turned(high));
            draft.shapes.push(rectangle(a.inf(&b), a.sup(&b)));
        }
        draft.inside = Some((middle, out * 1.5));
        return draft;
    }
    // Each holds a disc, and the discs overlap.
    let links = rng.random_range(12..=number.min(24));
    let disc = 1.1 * distance * (TAU / 2.0 / count(links)).sin();
    for k in 0..links {
        let angle = count(k) / count(links) * TAU;
        let at = middle + Vector::new(angle.cos(), angle.sin()) * distance;
        draft.shapes.push(fitted(rng, at, disc));
    }
    draft.inside = Some((middle, 1.5 * distance));
    draft
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        seeded,
        world::{SLACK, oracle},
    };
    use pf_core::Problem;

    #[test]
    fn every_kind_is_what_it_says() {
        let mut rng = seeded(1);
        for kind in Kind::ALL {
            let (mut solvable, mut bent) = (0, 0);
            for _ in 0..60 {
                let recipe = Recipe {
                    kind,
                    ..Recipe::any(&mut rng, 5..=30)
                };
                let problem = random_world(&mut rng, &recipe);
                assert!(recipe.shapes.contains(&problem.world().shapes().count()));
                let Some(shortest) = oracle(&problem) else {
                    continue;
                };
                solvable += 1;
                bent += usize::from(shortest.path.len() > 2);
                let cost = problem
                    .judge(&shortest.path)
                    .expect("a path that keeps clear");
                assert!(shortest.length - 1e-6 <= cost && cost <= shortest.length + SLACK);
            }
            if kind == Kind::Closed {
                assert_eq!(solvable, 0);
            } else {
                assert!(solvable >= 30 && bent >= 15, "{kind:?}: {solvable} {bent}");
            }
        }
    }
}
