//! Bees with a memory on the paper's two maps and on made-up ones with traps.
#![expect(clippy::unwrap_used, reason = "a test that stumbles has failed")]

use pf_abc::{Abc, AbcParams};
use pf_conformance::world::{oracle, trap_world};
use pf_core::{Context, Planner};
use pf_geom::WorldProblem;
use pf_io::read_world;
use std::path::Path;

/// Worlds from this seed on were looked at by nobody before the defaults were settled.
const HELD_OUT: u64 = 1000;

fn map(number: u32) -> WorldProblem {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../maps/worlds");
    let file = read_world(&folder.join(format!("cabc-{number}.toml"))).unwrap();
    let robot = &file.robots[0];
    WorldProblem::new(file.world.clone(), robot.radius, robot.start, robot.goal).unwrap()
}

/// The lengths of the walks that arrive within so many steps, of so many seeds.
fn lengths(problem: &WorldProblem, params: &AbcParams, seeds: u64) -> Vec<f64> {
    let mut planner = Abc::new(params.clone()).unwrap();
    let walks = (0..seeds).map(|seed| planner.plan(problem, &mut Context::seeded(seed)).unwrap());
    walks
        .filter_map(|r| r.outcome.solved().map(|best| best.cost))
        .collect()
}

#[expect(clippy::cast_precision_loss, reason = "a number of walks")]
fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

#[test]
fn with_memory_they_always_arrive_on_both_maps() {
    let paper_s_steps = AbcParams {
        steps: 200,
        ..AbcParams::default()
    };
    let walks = [1, 2].map(|number| lengths(&map(number), &paper_s_steps, 200));
    assert_eq!(walks.each_ref().map(Vec::len), [200, 200]);
    let means = walks.map(|walks| mean(&walks));
    assert!(means[0] <= 76.0 && means[1] <= 115.0, "{means:?}");
    let without = AbcParams {
        memory: 0.0,
        ..paper_s_steps
    };
    assert!(lengths(&map(2), &without, 20).is_empty());
}

#[test]
fn they_get_out_of_traps() {
    let params = AbcParams {
        steps: 400,
        ..AbcParams::default()
    };
    let without = AbcParams {
        memory: 0.0,
        ..params.clone()
    };
    let (mut with_memory, mut without_memory) = (0, 0);
    for seed in HELD_OUT..HELD_OUT + 100 {
        let problem = trap_world(seed);
        assert!(oracle(&problem).unwrap().length <= 100.0);
        with_memory += lengths(&problem, &params, 20).len();
        without_memory += 4 * lengths(&problem, &without, 5).len();
    }
    // Of 2000.
    assert!(with_memory >= 1990, "{with_memory}");
    assert!(without_memory <= 1200, "{without_memory}");
}
