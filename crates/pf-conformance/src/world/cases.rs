//! Worlds with a point, and what formulas say about them.

use super::{
    generate::{Kind, Recipe, random_world},
    shapes::{circle, polygon, rectangle},
    suite::best_is,
    tight,
};
use crate::{Case, Truth, seeded};
use pf_geom::{Point, Rectangle, Shape, World, WorldProblem};
use std::f64::consts::{FRAC_PI_2, PI};

/// Worlds with a point, each with the truth about it.
///
/// # Panics
/// Never, but for a fault of its own.
#[must_use]
pub fn cases() -> Vec<Case<WorldProblem>> {
    [
        open(),
        single(),
        at_the_bounds(),
        ends(),
        walls(),
        tight::touching(),
        tight::narrow(),
        tight::overlapping(),
        tight::pockets(),
        many(),
    ]
    .concat()
}

pub(super) type Cases = Vec<Case<WorldProblem>>;

/// From point to point in a square from -10 to 10.
pub(super) fn case(
    name: &str,
    shapes: impl IntoIterator<Item = Shape>,
    radius: f64,
    ends: [(f64, f64); 2],
    truth: Truth<f64>,
) -> Case<WorldProblem> {
    bounded(
        name,
        (-10.0, -10.0, 10.0, 10.0),
        shapes,
        radius,
        ends,
        truth,
    )
}

fn bounded(
    name: &str,
    (left, low, right, high): (f64, f64, f64, f64),
    shapes: impl IntoIterator<Item = Shape>,
    radius: f64,
    ends: [(f64, f64); 2],
    truth: Truth<f64>,
) -> Case<WorldProblem> {
    let bounds = Rectangle::new(Point::new(left, low), Point::new(right, high));
    let world = World::with_shapes(bounds.expect("bounds of some size"), shapes);
    let [start, goal] = ends.map(|(x, y)| Point::new(x, y));
    Case {
        name: format!("{name}, radius {radius}"),
        problem: WorldProblem::new(world, radius, start, goal).expect("points within the bounds"),
        truth,
    }
}

pub(super) fn block(left: f64, low: f64, right: f64, high: f64) -> Shape {
    rectangle(Point::new(left, low), Point::new(right, high))
}

pub(super) fn corners(corners: &[(f64, f64)]) -> Shape {
    polygon(corners.iter().map(|&(x, y)| Point::new(x, y)).collect())
}

/// From left to right past the origin.
pub(super) const ACROSS: [(f64, f64); 2] = [(-3.0, 0.0), (3.0, 0.0)];

/// The way to where a path touches a disc: its length, and the angle between it and the line to
/// the disc's centre. `apart` leads from the end to the centre.
pub(super) fn tangent(apart: (f64, f64), radius: f64) -> (f64, f64) {
    let distance = apart.0.hypot(apart.1);
    let length = (distance * distance - radius * radius).sqrt();
    (length, (radius / distance).asin())
}

/// From an end round a corner to where the path goes on along an axis: the corner lies `ahead`
/// along it and `aside` from it.
pub(super) fn round_corner(ahead: f64, aside: f64, radius: f64) -> f64 {
    let (length, lean) = tangent((ahead, aside), radius);
    length + radius * (aside.atan2(ahead) + lean)
}

/// Round a disc midway between start and goal.
fn round_disc(apart: f64, radius: f64) -> f64 {
    let (length, lean) = tangent((apart, 0.0), radius);
    2.0 * (length + radius * lean)
}

fn open() -> Cases {
    let mut cases = vec![];
    for radius in [0.0, 1.0] {
        cases.push(case(
            "nothing in the way",
            [],
            radius,
            [(0.0, 0.0), (3.0, 4.0)],
            best_is(5.0),
        ));
        let aside = [circle(5.0, 5.0, 1.0), block(-4.0, -4.0, -2.0, -2.0)];
        cases.push(case(
            "obstacles beside the way",
            aside,
            radius,
            [(-5.0, 5.0), (5.0, -5.0)],
            best_is(200f64.sqrt()),
        ));
    }
    let corner = [(-10.0, -10.0), (10.0, 10.0)];
    cases.push(case(
        "from bound to bound",
        [],
        0.5,
        corner,
        best_is(800f64.sqrt()),
    ));
    cases.push(case(
        "start is goal",
        [],
        0.5,
        [(1.0, 1.0); 2],
        best_is(0.0),
    ));
    cases
}

fn single() -> Cases {
    let mut cases = vec![];
    for radius in [0.0, 0.5, 1.5] {
        let round = round_disc(3.0, 1.0 + radius);
        let disc = circle(0.0, 0.0, 1.0);
        cases.push(case(
            "a circle",
            [disc.clone()],
            radius,
            ACROSS,
            best_is(round),
        ));
        let inside = [disc, circle(0.3, -0.2, 0.3), block(-0.5, -0.5, 0.5, 0.5)];
        cases.push(case(
            "things in a circle",
            inside,
            radius,
            ACROSS,
            best_is(round),
        ));
        let round = 2.0 * round_corner(2.0, 1.0, radius) + 2.0;
        let square = || block(-1.0, -1.0, 1.0, 1.0);
        cases.push(case("a square", [square()], radius, ACROSS, best_is(round)));
        let twice = [square(), square(), circle(0.0, 0.0, 1.0)];
        cases.push(case(
            "a square twice",
            twice,
            radius,
            ACROSS,
            best_is(round),
        ));
        // The same with corners that are none.
        let straight = corners(&[
            (-1.0, -1.0),
            (0.0, -1.0),
            (1.0, -1.0),
            (1.0, 0.5),
            (1.0, 1.0),
            (-1.0, 1.0),
        ]);
        cases.push(case(
            "corners in line",
            [straight],
            radius,
            ACROSS,
            best_is(round),
        ));
    }
    // Half way round along the border.
    cases.push(case(
        "from border to border",
        [circle(0.0, 0.0, 1.0)],
        0.5,
        [(-1.5, 0.0), (1.5, 0.0)],
        best_is(1.5 * PI),
    ));
    cases
}

fn at_the_bounds() -> Cases {
    let mut cases = vec![];
    // Below there is room for a centre half a unit from the block.
    let bounds = (-5.0, -1.0, 5.0, 5.0);
    let low = || [block(-1.0, -0.5, 1.0, 2.0)];
    let below = |radius| best_is(2.0 * round_corner(2.0, 0.5, radius) + 2.0);
    let above = |radius| best_is(2.0 * round_corner(2.0, 2.0, radius) + 2.0);
    for (radius, truth) in [
        (0.4, below(0.4)),
        (0.5, below(0.5)),
        (0.5 + 1e-6, above(0.5 + 1e-6)),
        (1.0, above(1.0)),
    ] {
        cases.push(bounded(
            "the bounds as a limit",
            bounds,
            low(),
            radius,
            ACROSS,
            truth,
        ));
    }
    // From bound to bound: only a point passes, along the bounds.
    let flush = || [block(-1.0, -10.0, 1.0, 10.0)];
    let along = best_is(2.0 * (2f64.hypot(10.0)) + 2.0);
    cases.push(case("a wall up to the bounds", flush(), 0.0, ACROSS, along));
    cases.push(case(
        "a wall up to the bounds",
        flush(),
        1e-3,
        ACROSS,
        Truth::Infeasible,
    ));
    let beyond = [block(-1.0, -11.0, 1.0, 11.0)];
    cases.push(case(
        "a wall beyond the bounds",
        beyond,
        0.0,
        ACROSS,
        Truth::Infeasible,
    ));
    let disc = || [circle(0.0, 1.0, 1.0), block(-0.5, 1.5, 0.5, 12.0)];
    let bounds = (-5.0, 0.0, 5.0, 10.0);
    cases.push(bounded(
        "a circle on the bounds",
        bounds,
        disc(),
        0.0,
        ACROSS,
        best_is(6.0),
    ));
    let (name, closed) = ("a circle on the bounds", Truth::Infeasible);
    cases.push(bounded(name, bounds, disc(), 1e-3, ACROSS, closed));
    cases
}

fn ends() -> Cases {
    let mut cases = vec![];
    for shape in [
        circle(0.0, 0.0, 1.0),
        block(-1.0, -1.0, 1.0, 1.0),
        corners(&[
            (-1.0, -1.0),
            (1.0, -1.0),
            (1.0, 1.0),
            (0.0, 0.5),
            (-1.0, 1.0),
        ]),
    ] {
        for radius in [0.0, 0.5] {
            let mut ends = |name, start: f64, goal: f64, truth| {
                let ends = [(start, 0.0), (goal, 0.0)];
                cases.push(case(name, [shape.clone()], radius, ends, truth));
            };
            let border = -1.0 - radius;
            ends("start inside", 0.0, 3.0, Truth::Infeasible);
            ends("goal inside", 3.0, 0.2, Truth::Infeasible);
            ends("both inside", 0.0, 0.0, Truth::Infeasible);
            ends("start on the border", border, -5.0, best_is(5.0 + border));
            ends("goal on the border", -5.0, border, best_is(5.0 + border));
            ends("both on the border", border, border, best_is(0.0));
            ends(
                "start inside by a hair",
                border + 1e-6,
                -5.0,
                Truth::Infeasible,
            );
            ends(
                "goal inside by a hair",
                -5.0,
                border + 1e-6,
                Truth::Infeasible,
            );
        }
    }
    cases
}

/// Four walls about a square from -2 to 2.
fn ring() -> [Shape; 4] {
    [
        block(-3.0, -3.0, 3.0, -2.0),
        block(-3.0, 2.0, 3.0, 3.0),
        block(-3.0, -2.5, -2.0, 2.5),
        block(2.0, -2.5, 3.0, 2.5),
    ]
}

fn walls() -> Cases {
    let mut cases = vec![];
    let ends = [(-6.0, 0.0), (0.0, 0.0)];
    for radius in [0.0, 0.5] {
        cases.push(case(
            "walls all around",
            ring(),
            radius,
            ends,
            Truth::Infeasible,
        ));
        let swapped = [ends[1], ends[0]];
        cases.push(case(
            "walls around the start",
            ring(),
            radius,
            swapped,
            Truth::Infeasible,
        ));
        let inside = [(-1.0, 0.0), (1.0, 0.0)];
        cases.push(case("within walls", ring(), radius, inside, best_is(2.0)));
    }
    // A door in the right wall, behind the room.
    let door = |width: f64| {
        let [low, high, left, _] = ring();
        let half = width / 2.0;
        let rest = [block(2.0, -2.5, 3.0, -half), block(2.0, half, 3.0, 2.5)];
        [vec![low, high, left], rest.to_vec()].concat()
    };
    let out = [(0.0, 0.0), (6.0, 0.0)];
    for radius in [0.25, 0.5] {
        let width = 2.0 * radius;
        cases.push(case(
            "a door as wide as the robot",
            door(width),
            radius,
            out,
            best_is(6.0),
        ));
        let less = door(width - 1e-6);
        cases.push(case(
            "a door too narrow by a hair",
            less,
            radius,
            out,
            Truth::Infeasible,
        ));
        let about = [(-6.0, 0.0), (3.0 + radius, 0.0)];
        let length = round_corner(3.0, 3.0, radius) + 6.0 + radius * FRAC_PI_2 + 3.0;
        cases.push(case(
            "round the room",
            ring(),
            radius,
            about,
            best_is(length),
        ));
    }
    cases
}

fn many() -> Cases {
    let mut cases = vec![];
    // A lane between rows of discs.
    let lattice = (0..20)
        .flat_map(|i| (0..20).map(move |j| circle(2.0 * f64::from(i), 2.0 * f64::from(j), 0.3)));
    let lattice: Vec<_> = lattice.collect();
    let bounds = (-3.0, -3.0, 41.0, 41.0);
    let lane = [(-2.0, 19.0), (40.0, 19.0)];
    for radius in [0.0, 0.5, 0.7] {
        let name = "a lane among 400 circles";
        let shapes = lattice.clone();
        cases.push(bounded(name, bounds, shapes, radius, lane, best_is(42.0)));
    }
    // Walls with the gap at the right and at the left by turns.
    let walls = (0..100u32).map(|k| {
        let low = f64::from(2 * k + 1);
        let (left, right) = if k % 2 == 0 { (-1.0, 9.0) } else { (1.0, 11.0) };
        block(left, low, right, low + 1.0)
    });
    let bounds = (0.0, 0.0, 10.0, 201.0);
    let length = 2.0 * 82f64.sqrt() + 100.0 + 99.0 * 65f64.sqrt();
    cases.push(bounded(
        "to and fro past 100 walls",
        bounds,
        walls,
        0.0,
        [(0.0, 0.0), (10.0, 201.0)],
        best_is(length),
    ));
    // A chain of discs about the goal, whole and with one disc missing.
    let chain: Vec<_> = (0..120u32)
        .map(|k| {
            let angle = f64::from(k) * PI / 60.0;
            circle(8.0 * angle.cos(), 8.0 * angle.sin(), 0.3)
        })
        .collect();
    let ends = [(-9.5, 0.0), (0.0, 0.0)];
    let name = "120 circles all around";
    cases.push(case(name, chain.clone(), 0.0, ends, Truth::Infeasible));
    cases.push(case(name, chain.clone(), 0.4, ends, Truth::Infeasible));
    cases.push(case(
        "119 circles",
        chain[1..].to_vec(),
        0.1,
        ends,
        Truth::Solvable,
    ));
    // Whatever lies there, there is a way around it all.
    for seed in [1, 2] {
        let recipe = Recipe {
            kind: Kind::Scattered,
            shapes: 250..=250,
            radius: 0.0,
            density: 0.5,
        };
        let crowd = random_world(&mut seeded(seed), &recipe);
        let (min, max) = (crowd.world().bounds().min(), crowd.world().bounds().max());
        let bounds = (min.x - 5.0, min.y - 5.0, max.x + 5.0, max.y + 5.0);
        let shapes: Vec<_> = crowd
            .world()
            .shapes()
            .map(|(_, shape)| shape.clone())
            .collect();
        let ends = [(bounds.0, bounds.1), (bounds.2, bounds.3)];
        let name = format!("a crowd of 250, seed {seed}");
        cases.push(bounded(&name, bounds, shapes, 0.8, ends, Truth::Solvable));
    }
    cases
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::oracle;

    /// The formulas and the oracle know nothing of each other.
    #[test]
    fn the_oracle_says_the_same() {
        let mut wrong = vec![];
        for case in cases() {
            let found = oracle(&case.problem).map(|best| best.length);
            let agree = match (&case.truth, found) {
                (Truth::Infeasible, None) | (Truth::Solvable, Some(_)) => true,
                (Truth::Between(least, most), Some(length)) => {
                    (*least..=*most - super::super::SLACK).contains(&length)
                }
                _ => false,
            };
            if !agree {
                wrong.push(format!("{}: {:?}, found {found:?}", case.name, case.truth));
            }
        }
        assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    }
}
