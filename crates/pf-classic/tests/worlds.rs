//! The exact shortest path beside dense roadmaps and the oracle, on made-up worlds.

use pf_classic::VisibilityGraph;
use pf_conformance::{
    seeded,
    world::{Kind, Recipe, SLACK, listing, oracle, random_world, roadmap},
};
use pf_core::{Context, Outcome, Planner, Problem};
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
    assert!(excess.len() >= 250 && median < 0.02, "{} {median}", excess.len());
}

#[test]
fn the_oracle_finds_the_same_in_a_thousand_worlds() {
    for seed in 1000..2000 {
        let mut rng = seeded(seed);
        let recipe = Recipe::any(&mut rng, 5..=20);
        let problem = random_world(&mut rng, &recipe);
        let report = VisibilityGraph::default().plan(&problem, &mut Context::seeded(0));
        let report = report.expect("any world is planned in");
        let found = report.outcome.solved().map(|best| best.cost);
        let same = match (found, oracle(&problem)) {
            (Some(found), Some(best)) => {
                (best.length - 1e-6..=best.length + SLACK + 1e-6).contains(&found)
            }
            (None, None) => matches!(report.outcome, Outcome::Infeasible),
            _ => false,
        };
        assert!(same, "seed {seed}: {found:?}, {recipe:?}\n{}", listing(&problem));
    }
}
