//! Worlds in which little room is left: obstacles that touch, corridors as wide as the robot,
//! pockets.

use super::{
    cases::{ACROSS, Cases, block, case, corners, round_corner, tangent},
    shapes::{circle, polygon},
    suite::best_is,
};
use crate::Truth;
use pf_geom::{Point, Shape, Vector};
use std::f64::consts::FRAC_PI_2;

/// What closes the way above and below but for the middle.
fn rest() -> [Shape; 2] {
    [block(-0.5, 1.5, 0.5, 11.0), block(-0.5, -11.0, 0.5, -1.5)]
}

pub(super) fn touching() -> Cases {
    let mut cases = vec![];
    let discs = [circle(0.0, 1.0, 1.0), circle(0.0, -1.0, 1.0)];
    let discs = [discs.to_vec(), rest().to_vec()].concat();
    // Round the upper disc to where they touch.
    let (length, lean) = tangent((3.0, 0.0), 1.0);
    let round = best_is(2.0 * (length + lean));
    let aside = [(-3.0, 1.0), (3.0, 1.0)];
    let through = [(-3.0, 1.0), (3.0, -1.0)];
    let under = [block(-1.0, 0.0, 1.0, 11.0), block(-1.0, -11.0, 1.0, 0.0)];
    let diagonal = [block(-1.0, 0.0, 0.0, 11.0), block(0.0, -11.0, 1.0, 0.0)];
    let resting = [circle(0.0, 1.0, 1.0), block(-1.0, -11.0, 1.0, 0.0)];
    let resting = [resting.to_vec(), rest()[..1].to_vec()].concat();
    let triangle = corners(&[(0.0, 0.0), (1.0, 2.0), (-1.0, 2.0)]);
    let tip = vec![
        triangle,
        block(-0.2, 1.5, 0.2, 11.0),
        block(-1.0, -11.0, 1.0, 0.0),
    ];
    for (name, shapes, ends, truth) in [
        ("two circles touch", discs.clone(), ACROSS, best_is(6.0)),
        (
            "two circles touch, from above",
            discs.clone(),
            aside,
            round.clone(),
        ),
        ("two circles touch, up and down", discs, through, round),
        ("two walls touch", under.to_vec(), ACROSS, best_is(6.0)),
        (
            "two corners touch",
            diagonal.to_vec(),
            [(-3.0, -1.0), (3.0, 1.0)],
            best_is(2.0 * 10f64.sqrt()),
        ),
        (
            "two corners touch, with a turn",
            diagonal.to_vec(),
            [(-3.0, -1.0), (3.0, 2.0)],
            best_is(10f64.sqrt() + 13f64.sqrt()),
        ),
        ("a circle touches a wall", resting, ACROSS, best_is(6.0)),
        ("a corner touches a wall", tip, ACROSS, best_is(6.0)),
    ] {
        cases.push(case(name, shapes.clone(), 0.0, ends, truth));
        cases.push(case(name, shapes, 1e-3, ends, Truth::Infeasible));
    }
    cases
}

pub(super) fn narrow() -> Cases {
    let mut cases = vec![];
    let hair = 1e-6;
    for radius in [0.1f64, 0.5, 1.0] {
        // The way in from the side bends round the upper corner into the corridor.
        let bent = round_corner(2.0, 2.0 - radius, radius);
        for (name, half, straight) in [
            ("as wide as the robot", radius, true),
            ("too narrow by a hair", radius - hair / 2.0, false),
        ] {
            let truth = |length| {
                if straight {
                    best_is(length)
                } else {
                    Truth::Infeasible
                }
            };
            let walls = [block(-1.0, half, 1.0, 11.0), block(-1.0, -11.0, 1.0, -half)];
            let corridor = format!("a corridor {name}");
            cases.push(case(&corridor, walls.clone(), radius, ACROSS, truth(6.0)));
            let side = [(-3.0, 2.0), (3.0, 0.0)];
            let (name, from_side) = (format!("{corridor}, from the side"), bent + 4.0);
            cases.push(case(&name, walls, radius, side, truth(from_side)));
            let discs = [circle(0.0, 1.0 + half, 1.0), circle(0.0, -1.0 - half, 1.0)];
            let (up, down) = (1.5 + half, -1.5 - half);
            let behind = [block(-0.5, up, 0.5, 12.0), block(-0.5, -12.0, 0.5, down)];
            let gap = [discs, behind].concat();
            let name = corridor.replace("corridor", "gap between circles");
            cases.push(case(&name, gap, radius, ACROSS, truth(6.0)));
            // A wedge that opens both ways, its narrowest place between two corners.
            let wedge = [
                corners(&[(0.0, half), (2.0, 2.0 + half), (-2.0, 2.0 + half)]),
                corners(&[(0.0, -half), (-2.0, -2.0 - half), (2.0, -2.0 - half)]),
                block(-1.0, 1.5 + half, 1.0, 14.0),
                block(-1.0, -14.0, 1.0, -1.5 - half),
            ];
            let name = corridor.replace("corridor", "gap between corners");
            cases.push(case(&name, wedge, radius, ACROSS, truth(6.0)));
        }
    }
    cases
}

pub(super) fn overlapping() -> Cases {
    let mut cases = vec![];
    for radius in [0.0, 0.5] {
        let grown = 1.0 + radius;
        let (length, lean) = tangent((2.5, 0.0), grown);
        let pair = [circle(-0.5, 0.0, 1.0), circle(0.5, 0.0, 1.0)];
        let over = best_is(2.0 * (length + grown * lean) + 1.0);
        cases.push(case("two circles overlap", pair, radius, ACROSS, over));
        let cross = [block(-1.0, -0.5, 1.0, 0.5), block(-0.5, -1.0, 0.5, 1.0)];
        // Straight to the upper corner: the nearer one lies below.
        let round = 2.0 * round_corner(2.5, 1.0, radius) + 1.0;
        cases.push(case(
            "two blocks cross",
            cross,
            radius,
            ACROSS,
            best_is(round),
        ));
    }
    cases
}

pub(super) fn pockets() -> Cases {
    let mut cases = vec![];
    let cup = corners(&[
        (0.0, 0.0),
        (4.0, 0.0),
        (4.0, 3.0),
        (3.0, 3.0),
        (3.0, 1.0),
        (1.0, 1.0),
        (1.0, 3.0),
        (0.0, 3.0),
    ]);
    for radius in [0.0, 0.5, 1.0] {
        // Up and over, then down, then back under.
        let out = round_corner(1.0, 1.0, radius);
        let rest = 1.0 + radius * FRAC_PI_2 + 3.0 + round_corner(2.0, 2.0, radius);
        let truth = best_is(out + rest);
        let ends = [(2.0, 2.0), (2.0, -2.0)];
        cases.push(case("out of a cup", [cup.clone()], radius, ends, truth));
    }
    let ends = [(2.0, 2.0), (2.0, -2.0)];
    let cup = [cup];
    let (name, hair) = ("out of a cup", 1.0 + 1e-6);
    cases.push(case(name, cup.clone(), hair, ends, Truth::Infeasible));
    let down = [(5.5, 5.0), (2.0, 2.0)];
    cases.push(case(name, cup, hair, down, Truth::Infeasible));
    // From one pocket into the next but one: over two teeth, or all in one piece.
    let teeth = comb(Point::new(-5.0, -2.0), 6, 1.0, 3.0);
    let from = (-5.0 + 0.2 + 0.5, -1.0);
    let to = (from.0 + 2.4, -1.0);
    let up = 0.5f64.hypot(2.2);
    let over = best_is(2.0 * up + 1.4);
    cases.push(case("a comb", [teeth.clone()], 0.0, [from, to], over));
    let up = round_corner(0.5, 2.2, 0.25);
    let over = best_is(2.0 * up + 1.4);
    cases.push(case("a comb", [teeth.clone()], 0.25, [from, to], over));
    let up = round_corner(0.5, 2.2, 0.5);
    let over = best_is(2.0 * up + 1.4);
    cases.push(case(
        "a comb as wide as the robot",
        [teeth.clone()],
        0.5,
        [from, to],
        over,
    ));
    let wide = 0.5 + 1e-6;
    let above = [(-1.0, 6.0), from];
    cases.push(case(
        "a comb too narrow by a hair",
        [teeth],
        wide,
        above,
        Truth::Infeasible,
    ));
    cases
}

/// A comb with its teeth up: pockets to get lost in.
fn comb(at: Point, pockets: u32, width: f64, depth: f64) -> Shape {
    let wall = 0.2;
    let all = f64::from(pockets) * (width + wall) + wall;
    let mut corners = vec![at, at + Vector::new(all, 0.0)];
    for k in (0..=pockets).rev() {
        let left = f64::from(k) * (width + wall);
        let mut corner = |x, y| corners.push(at + Vector::new(x, y));
        corner(left + wall, wall + depth);
        corner(left, wall + depth);
        if k > 0 {
            corner(left, wall);
            corner(left - width, wall);
        }
    }
    polygon(corners)
}
