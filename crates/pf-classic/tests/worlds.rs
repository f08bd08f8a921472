//! The exact shortest path beside dense roadmaps and the oracle, on made-up worlds.

use pf_classic::VisibilityGraph;
use pf_conformance::{
    seeded,
    world::{Kind, Recipe, SLACK, listing, oracle, problems, random_world, roadmap},
};
use pf_core::{Context, Outcome, Planner, Problem};
use pf_geom::WorldProblem;
use proptest::{prelude::*, test_runner::RngSeed};
use rand::RngExt;

const WORLDS: u64 = 500;
const NODES: usize = 2000;
/// How much shorter a roadmap's path may be: the polyline's share for its arcs.
const SHORTER: f64 = 1e-4;

#[test]
fn no_roadmap_is_shorter_in_five_hundred_worlds() {
    let (mut solved, mut refuted, mut excess) = (0, 0, vec![]);
    for seed in 0..WORLDS {
        let mut rng = seeded(seed);
        // As many small worlds as large ones.
        let most = [10, 20, 50, 100, 200][rng.random_range(0..5usize)];
        let recipe = Recipe::any(&mut rng, 10..=most);
        let problem = random_world(&mut rng, &recipe);
        let mut planner = VisibilityGraph::default();
        let report = planner.plan(&problem, &mut Context::seeded(0));
        let outcome = report.expect("any world is planned in").outcome;
        let rival = roadmap(&problem, NODES, &mut rng);
        let rival = rival.map(|path| problem.judge(&path).expect("a roadmap keeps clear"));
        let place = || format!("seed {seed}, {recipe:?}\n{}", listing(&problem));
        match outcome {
            Outcome::Optimal(best) => {
                let length = problem.judge(&best.solution);
                let length = length.unwrap_or_else(|how| panic!("path {how}: {}", place()));
                assert_ne!(recipe.kind, Kind::Closed, "{}", place());
                solved += 1;
                if let Some(rival) = rival {
                    excess.push(rival - length);
                    let shorter = rival < length - SHORTER;
                    assert!(!shorter, "{rival} beats {length}: {}", place());
                }
            }
            Outcome::Infeasible => {
                assert_eq!(rival, None, "{}", place());
                refuted += 1;
            }
            other => panic!("{other:?}: {}", place()),
        }
    }
    assert!(solved >= 300 && refuted >= 120, "{solved} {refuted}");
    // The rivals are near enough for the comparison to mean something.
    excess.sort_by(f64::total_cmp);
    let median = excess[excess.len() / 2];
    assert!(
        excess.len() >= 250 && median < 0.02,
        "{} {median}",
        excess.len()
    );
}

/// Whether the planner says what the oracle says.
fn agree(problem: &WorldProblem) -> Result<(), String> {
    let report = VisibilityGraph::default().plan(problem, &mut Context::seeded(0));
    let report = report.expect("any world is planned in");
    let found = report.outcome.solved().map(|best| best.cost);
    let best = oracle(problem).map(|best| best.length);
    let same = match (found, best) {
        (Some(found), Some(best)) => (best - 1e-6..=best + SLACK + 1e-6).contains(&found),
        (None, None) => matches!(report.outcome, Outcome::Infeasible),
        _ => false,
    };
    let how = || format!("{found:?}, expected {best:?}\n{}", listing(problem));
    if same { Ok(()) } else { Err(how()) }
}

#[test]
fn the_oracle_finds_the_same_in_a_thousand_worlds() {
    for seed in 1000..2000 {
        let mut rng = seeded(seed);
        let recipe = Recipe::any(&mut rng, 5..=20);
        let problem = random_world(&mut rng, &recipe);
        if let Err(how) = agree(&problem) {
            panic!("seed {seed}, {recipe:?}: {how}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 3000,
        rng_seed: RngSeed::Fixed(1),
        ..ProptestConfig::default()
    })]

    /// With corners in line and shapes that touch, on whole numbers.
    #[test]
    fn the_oracle_finds_the_same_among_shapes_that_touch(problem in problems(0..10)) {
        prop_assert_eq!(agree(&problem), Ok(()));
    }
}
