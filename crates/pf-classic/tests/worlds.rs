//! The exact shortest path beside dense roadmaps and the oracle, on made-up worlds.

use pf_classic::VisibilityGraph;
use pf_conformance::{
    seeded,
    world::{Kind, Recipe, SLACK, listing, oracle, problems, random_world, roadmap},
};
use pf_core::{Context, Outcome, Planner, Problem, Replanner};
use pf_geom::{Point, WorldChange, WorldProblem};
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

/// What is kept from query to query must not show: ends that move one after the other, or both,
/// back to where they were and into obstacles.
#[test]
fn a_kept_graph_finds_what_a_new_one_finds() {
    let (mut solved, mut refuted) = (0, 0);
    for seed in 3000..3150 {
        let mut rng = seeded(seed);
        let most = [10, 50, 200][rng.random_range(0..3usize)];
        let recipe = Recipe::any(&mut rng, 5..=most);
        let mut problem = random_world(&mut rng, &recipe);
        let mut kept = VisibilityGraph::default();
        kept.plan(&problem, &mut Context::seeded(0)).expect("any");
        let bounds = *problem.world().bounds();
        let mut places = vec![problem.start(), problem.goal()];
        for _ in 0..20 {
            let mut place = || {
                let (min, max) = (bounds.min(), bounds.max());
                let p = Point::new(
                    rng.random_range(min.x..max.x),
                    rng.random_range(min.y..max.y),
                );
                places.push(p);
                places[rng.random_range(0..places.len())]
            };
            let (goal, start) = (
                WorldChange::GoalMoved(place()),
                WorldChange::StartMoved(place()),
            );
            let changes = match rng.random_range(0..4) {
                0 => vec![goal, start],
                1 => vec![start],
                _ => vec![goal],
            };
            let revision = problem.revise(&changes).expect("both ends are within");
            let again = kept.replan(&revision, &mut Context::seeded(0));
            let fresh = VisibilityGraph::default().plan(&problem, &mut Context::seeded(0));
            let [again, fresh] = [again, fresh].map(|report| report.expect("any").outcome);
            match (&again, &fresh) {
                (Outcome::Optimal(a), Outcome::Optimal(b)) => {
                    let close = (a.cost - b.cost).abs() <= SLACK;
                    assert!(close, "seed {seed}: {} {}", a.cost, b.cost);
                    solved += 1;
                }
                (Outcome::Infeasible, Outcome::Infeasible) => refuted += 1,
                _ => panic!("seed {seed}: {again:?}, {fresh:?}\n{}", listing(&problem)),
            }
        }
    }
    assert!(solved >= 1000 && refuted >= 500, "{solved} {refuted}");
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
