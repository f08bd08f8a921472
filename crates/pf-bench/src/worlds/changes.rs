//! Changes of a large world, and queries in it beside those in a small one.

use super::{Args, Case, anywhere, shape_in, shapes, square};
use crate::protocol::{REPETITIONS, Tally, timed};
use anyhow::Result;
use pf_core::PlanRng;
use pf_geom::{Segment, Vector, World};
use rand::{RngExt, SeedableRng};
use std::time::Duration;

const LARGE: u32 = 10_000;
const SMALL: u32 = 100;
const OPERATIONS: usize = 2000;

pub(super) fn run(args: &Args, tell: &mut impl FnMut(Case) -> Result<()>) -> Result<()> {
    let mut rng = PlanRng::seed_from_u64(args.seed);
    let mut worlds = [SMALL, LARGE].map(|count| {
        let shapes = shapes(&mut rng, count, true);
        World::with_shapes(square(count), shapes)
    });
    ask(&mut rng, &worlds, "", tell)?;
    for world in &mut worlds {
        change(&mut rng, world, tell)?;
    }
    ask(&mut rng, &worlds, " after changes", tell)
}

fn change(
    rng: &mut PlanRng,
    world: &mut World,
    tell: &mut impl FnMut(Case) -> Result<()>,
) -> Result<()> {
    let count = world.shapes().count();
    let mut tallies = [Tally::default(), Tally::default(), Tally::default()];
    for _ in 0..OPERATIONS {
        let centre = anywhere(rng, world.bounds());
        let radius = rng.random_range(1.0..3.0);
        let shape = shape_in(rng, centre, radius, true);
        let (time, id) = timed(|| world.add(shape));
        tallies[0].add(time);
        let moved = rng.random_range(0..id);
        let by = Vector::new(rng.random_range(-5.0..5.0), rng.random_range(-5.0..5.0));
        if world.shape(moved).is_some() {
            let (time, done) = timed(|| world.translate(moved, by));
            done?;
            tallies[1].add(time);
        }
        // Another one goes for the one that came.
        let known = |id: &usize| world.shape(*id).is_some();
        let gone = (rng.random_range(0..=id)..=id).find(known).unwrap_or(id);
        let (time, done) = timed(|| world.remove(gone));
        done?;
        tallies[2].add(time);
    }
    let [added, moved, removed] = tallies;
    for (what, tally) in [
        ("World::add", added),
        ("World::translate", moved),
        ("World::remove", removed),
    ] {
        tell(Case::of(
            &format!("world of {count}"),
            &[(what, tally)],
            None,
        ))?;
    }
    Ok(())
}

/// Segments of the same length in both, in units of the shapes' spacing.
fn ask(
    rng: &mut PlanRng,
    worlds: &[World; 2],
    when: &str,
    tell: &mut impl FnMut(Case) -> Result<()>,
) -> Result<()> {
    type Question = (&'static str, fn(&World, &Segment) -> f64);
    let questions: [Question; 2] = [
        ("is_free", |w, s| f64::from(u8::from(w.is_free(s, 0.2)))),
        ("clearance", World::clearance),
    ];
    for spacings in [0.5, 3.0] {
        let ways: [Vec<Segment>; 2] = [0, 1].map(|k| {
            let bounds = worlds[k].bounds();
            let mut ways = Vec::new();
            while ways.len() < 20_000 {
                let a = anywhere(rng, bounds);
                let angle: f64 = rng.random_range(0.0..std::f64::consts::TAU);
                let b = a + Vector::new(angle.cos(), angle.sin()) * 10.0 * spacings;
                if bounds.contains(b) {
                    ways.push(Segment::new(a, b));
                }
            }
            ways
        });
        for (name, ask) in questions {
            let mut tallies = [Tally::default(), Tally::default()];
            for batch in 0..200 {
                let mut least = [Duration::MAX; 2];
                for _ in 0..REPETITIONS {
                    for k in 0..2 {
                        let ways = &ways[k][batch * 100..(batch + 1) * 100];
                        let all = || ways.iter().map(|way| ask(&worlds[k], way)).sum::<f64>();
                        least[k] = least[k].min(timed(all).0);
                    }
                }
                for k in 0..2 {
                    tallies[k].add_us(least[k].as_secs_f64() * 1e6 / 100.0);
                }
            }
            let [small, large] = tallies;
            let case = format!("{name}, {spacings} long{when}");
            let (large_name, small_name) = (format!("in {LARGE}"), format!("in {SMALL}"));
            let contenders = [(&*large_name, large), (&*small_name, small)];
            tell(Case::of(&case, &contenders, Some(3.0)))?;
        }
    }
    Ok(())
}
