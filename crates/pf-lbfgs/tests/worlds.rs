//! Our rules in worlds made up by seed. Seeds from 1 were there to tune by, those from 1001 decide.
#![expect(clippy::unwrap_used, reason = "a test that stumbles has failed")]

use pf_conformance::world::{Obstacles as Kind, oracle, waypoint_world};
use pf_core::{Context, Outcome, Planner, Problem};
use pf_geom::{Segment, WorldProblem};
use pf_lbfgs::{Lbfgs, LbfgsParams};

const WORLDS: u64 = 40;
/// How far to keep from everything.
const CLEARANCE: f64 = 0.3;

fn held_out() -> std::ops::Range<u64> {
    match std::env::var("TUNE") {
        Ok(_) => 1..1 + WORLDS,
        Err(_) => 1001..1001 + WORLDS,
    }
}

fn with_radius(problem: &WorldProblem, radius: f64) -> WorldProblem {
    let world = problem.shared_world();
    WorldProblem::new(world, radius, problem.start(), problem.goal()).unwrap()
}

#[test]
fn every_solvable_query_is_solved_at_the_asked_clearance() {
    for kind in [Kind::Rectangles, Kind::Mixed] {
        for count in [5, 10, 20, 50] {
            let (mut solvable, mut wide, mut exact, mut paper) = (0, 0, 0, 0);
            let (mut longer, mut iterations) = (0.0, 0);
            for seed in held_out() {
                let problem = waypoint_world(seed, count, kind);
                let grown = with_radius(&problem, CLEARANCE);
                let params = LbfgsParams {
                    clearance: CLEARANCE,
                    ..LbfgsParams::default()
                };
                let mut planner = Lbfgs::new(params).unwrap();
                let report = planner.plan(&problem, &mut Context::seeded(0)).unwrap();
                let shortest = oracle(&problem);
                match &report.outcome {
                    Outcome::Feasible(best) => {
                        solvable += 1;
                        assert!(shortest.is_some());
                        let cost = problem.judge(&best.solution).unwrap();
                        if let Some(guide) = oracle(&grown) {
                            grown.judge(&best.solution).unwrap();
                            wide += 1;
                            longer += cost / guide.length;
                            // The exact path itself has other points.
                            exact += usize::from(best.solution.len() != 22);
                            iterations += report.stats.iterations;
                        } else {
                            assert!(report.note("asked clearance").is_some());
                        }
                        let segments = best.solution.windows(2).map(|w| Segment::new(w[0], w[1]));
                        let nearest = segments
                            .map(|s| problem.world().clearance(&s))
                            .fold(f64::INFINITY, f64::min);
                        assert_eq!(
                            report.note("clearance"),
                            Some(format!("{nearest:.4}").as_str())
                        );
                    }
                    Outcome::Infeasible => assert!(shortest.is_none()),
                    other => panic!("seed {seed}: {other:?}"),
                }
                if kind == Kind::Rectangles {
                    let mut planner = Lbfgs::new(LbfgsParams::paper()).unwrap();
                    let report = planner.plan(&problem, &mut Context::seeded(0)).unwrap();
                    paper += usize::from(report.outcome.solved().is_some());
                }
            }
            println!(
                "{kind:?} {count}: solvable {solvable}, at the clearance {wide}, of other size {exact}, mean excess {:.4}, iterations {}, paper's {paper}",
                longer / wide as f64 - 1.0,
                iterations / wide
            );
        }
    }
}
