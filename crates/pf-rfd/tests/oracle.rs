//! Every answer of the exact river against an oracle, and how long it takes beside a search.

use pf_conformance::{
    grid::{Kind, Recipe, oracle, random_batch, random_problem},
    seeded,
};
use pf_core::{Context, Outcome, Planner, Problem, Replanner};
use pf_grid::{GridCost, GridProblem, Moves};
use pf_rfd::RfdExact;

fn cost(outcome: &Outcome<GridProblem>) -> Option<GridCost> {
    match outcome {
        Outcome::Optimal(best) => Some(best.cost),
        Outcome::Infeasible => None,
        other => panic!("proves nothing: {}", other.word()),
    }
}

/// Mixed batches of up to 200 cells on mazes, rooms, corridors and noise, each answer optimal.
#[test]
fn every_answer_in_a_long_life_is_the_best() {
    const EVENTS: usize = 3000;
    let mut rng = seeded(5);
    let mut events = 0;
    let (mut optimal, mut infeasible) = (0, 0);
    while events < EVENTS {
        let kind = Kind::ALL[events / 25 % 4];
        let size = if events % 10 == 0 { 60..=90 } else { 20..=40 };
        let recipe = Recipe {
            kind,
            density: 0.2,
            moves: Moves::ALL[events / 100 % 4],
            ..Recipe::any(&mut rng, size)
        };
        let mut problem = random_problem(&mut rng, &recipe);
        let mut river = RfdExact::default();
        let report = river.plan(&problem, &mut Context::seeded(0)).unwrap();
        assert_eq!(cost(&report.outcome), oracle(&problem));
        for _ in 0..25 {
            let batch = random_batch(&mut rng, &problem, 200);
            let revision = problem.revise(&batch).unwrap();
            let report = river.replan(&revision, &mut Context::seeded(0)).unwrap();
            let found = cost(&report.outcome);
            assert_eq!(found, oracle(&problem), "event {events}: {batch:?}");
            match found {
                Some(_) => optimal += 1,
                None => infeasible += 1,
            }
            events += 1;
        }
    }
    assert!(
        optimal > EVENTS / 4 && infeasible > EVENTS / 20,
        "{optimal} {infeasible}"
    );
}
