//! What a memory does for bees: on the paper's maps, on made-up ones with traps, and where a trap is
//! hardest to leave.

use super::{Task, maps};
use crate::PaperError;
use pf_abc::AbcParams;
use pf_conformance::world::{dead_end, nested_traps, spiral, trap_world};
use pf_geom::WorldProblem;
use std::sync::Arc;

/// Worlds with traps from this seed on, so that none served to settle the defaults.
const HELD_OUT: u64 = 1000;
/// How many worlds.
const WORLDS: u64 = 100;
/// Seeds in each.
const SEEDS: u32 = 20;

/// A way to get out of traps, or not.
fn variants(steps: u64) -> [(&'static str, AbcParams); 4] {
    let ours = AbcParams {
        steps,
        ..AbcParams::default()
    };
    let without = AbcParams {
        memory: 0.0,
        ..ours.clone()
    };
    let first = AbcParams {
        reach: 2.0,
        delay: 0,
        w3: 0.01,
        ..ours.clone()
    };
    [
        ("no memory, 1, 0, 0", without.clone()),
        ("no memory, .7, 0, .03", without.weighing([0.7, 0.0, 0.03])),
        ("memory, reach 2, no delay, w3 .01", first),
        ("memory", ours),
    ]
}

pub(super) fn tasks(runs: u32) -> Result<Vec<Task>, PaperError> {
    let mut tasks = Vec::new();
    let mut add = |table, case: String, problems: Arc<[WorldProblem]>, steps, seeds| {
        for (variant, params) in variants(steps) {
            tasks.push(Task {
                table,
                case: case.clone(),
                variant: variant.to_owned(),
                params,
                problems: Arc::clone(&problems),
                seeds,
                printed: None,
            });
        }
    };
    for (number, map) in (1..).zip(maps()?) {
        let case = format!("map {number}");
        add("memory on the two maps", case, Arc::from([map]), 200, runs);
    }
    let worlds: Arc<[_]> = (HELD_OUT..HELD_OUT + WORLDS).map(trap_world).collect();
    let table = "memory in 100 worlds with traps, 20 seeds each, 400 steps";
    add(
        table,
        "held-out worlds".into(),
        Arc::clone(&worlds),
        400,
        SEEDS,
    );
    let mut hard = Vec::new();
    hard.extend((1..=3).map(|n| (format!("spiral, {n} turns"), spiral(n))));
    hard.extend((1..=3).map(|n| (format!("{n} nested pockets"), nested_traps(n))));
    hard.extend([20.0, 40.0, 80.0].map(|n| (format!("dead end {n} long"), dead_end(n))));
    for (case, problem) in hard {
        let table = "memory where it is hard, 20 seeds, 2000 steps";
        add(table, case, Arc::from([problem]), 2000, SEEDS);
    }
    for half in [1.0, 1.5, 2.0, 3.0, 4.0, 6.0] {
        for (variant, params) in variants(400) {
            if variant != "memory" && variant != "no memory, 1, 0, 0" {
                continue;
            }
            tasks.push(Task {
                table: "how far the robot sees, 100 worlds with traps, 5 seeds, 400 steps",
                case: format!("H = {half}"),
                variant: variant.to_owned(),
                params: AbcParams { half, ..params },
                problems: Arc::clone(&worlds),
                seeds: 5,
                printed: None,
            });
        }
    }
    Ok(tasks)
}
