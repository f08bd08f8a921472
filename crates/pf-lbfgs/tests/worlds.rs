//! Our rules in worlds made up by seed. Those from 1 and from 1001 on were looked at while it was
//! made; those from 2001 on decide.
#![expect(clippy::unwrap_used, reason = "a test that stumbles has failed")]

use pf_conformance::world::{Obstacles as Kind, oracle, waypoint_world};
use pf_core::{Context, Outcome, Planner, Problem};
use pf_geom::{Segment, WorldProblem};
use pf_lbfgs::{Lbfgs, LbfgsParams};

const HELD_OUT: std::ops::Range<u64> = 2001..2041;
/// How far to keep from everything.
const CLEARANCE: f64 = 0.3;

fn with_radius(problem: &WorldProblem, radius: f64) -> WorldProblem {
    let world = problem.shared_world();
    WorldProblem::new(world, radius, problem.start(), problem.goal()).unwrap()
}

#[test]
fn every_solvable_query_is_solved_at_the_asked_clearance() {
    for kind in [Kind::Rectangles, Kind::Mixed] {
        for count in [5, 10, 20, 50] {
            let (mut solvable, mut wide, mut exact, mut paper) = (0, 0u32, 0, 0);
            let (mut longer, mut iterations) = (0.0, 0);
            for seed in HELD_OUT {
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
                            exact += usize::from(report.note("fallback").is_some());
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
                "{kind:?} {count}: solvable {solvable}, at the clearance {wide}, of which the exact \
                 path {exact}; length over the exact one's {:.4}, iterations {}; the paper's rules \
                 solve {paper}",
                longer / f64::from(wide),
                iterations / u64::from(wide)
            );
        }
    }
}

fn asked(shapes: &[pf_geom::Shape], start: [f64; 2], goal: [f64; 2]) -> WorldProblem {
    let [min, max] = [-10.0, 10.0].map(|v| pf_geom::Point::new(v, v));
    let bounds = pf_geom::Rectangle::new(min, max).unwrap();
    let world = pf_geom::World::with_shapes(bounds, shapes.iter().cloned());
    let [start, goal] = [start, goal].map(|[x, y]| pf_geom::Point::new(x, y));
    WorldProblem::new(world, 0.0, start, goal).unwrap()
}

fn all_rules() -> [LbfgsParams; 4] {
    let potential = LbfgsParams {
        obstacles: pf_lbfgs::Obstacles::Potential,
        ..LbfgsParams::default()
    };
    [
        LbfgsParams::default(),
        potential,
        LbfgsParams::paper(),
        LbfgsParams::published_code(),
    ]
}

#[test]
fn odd_questions_get_honest_answers() {
    let block = |x0: f64, y0: f64, x1: f64, y1: f64| {
        let [min, max] = [pf_geom::Point::new(x0, y0), pf_geom::Point::new(x1, y1)];
        pf_geom::Shape::from(pf_geom::Rectangle::new(min, max).unwrap())
    };
    let middle = block(-1.0, -1.0, 1.0, 1.0);
    let ring = [
        block(-4.0, -4.0, 4.0, -3.0),
        block(-4.0, 3.0, 4.0, 4.0),
        block(-4.0, -3.5, -3.0, 3.5),
        block(3.0, -3.5, 4.0, 3.5),
    ];
    for params in all_rules() {
        let ours = params.rules == pf_lbfgs::Rules::Exact;
        for (points, shapes, start, goal, solvable) in [
            (20, vec![middle.clone()], [0.0, 0.0], [5.0, 5.0], false),
            (20, vec![middle.clone()], [5.0, 5.0], [0.5, 0.0], false),
            (20, ring.to_vec(), [0.0, 0.0], [8.0, 8.0], false),
            (20, vec![middle.clone()], [5.0, 5.0], [5.0, 5.0], true),
            (20, vec![], [5.0, 5.0], [-5.0, 2.0], true),
            (1, vec![middle.clone()], [-5.0, 0.0], [5.0, 0.0], true),
            (1, vec![middle.clone()], [-5.0, 0.0], [5.0, 3.0], true),
            (10_000, vec![middle.clone()], [-5.0, 0.2], [5.0, 0.0], true),
        ] {
            let problem = asked(&shapes, start, goal);
            let mut planner = Lbfgs::new(LbfgsParams {
                points,
                ..params.clone()
            })
            .unwrap();
            let report = planner.plan(&problem, &mut Context::seeded(0)).unwrap();
            let found = report.outcome.solved();
            assert!(found.is_none_or(|best| solvable && problem.judge(&best.solution).is_ok()));
            if ours {
                assert_eq!(found.is_some(), solvable, "{params:?} {report:?}");
                let refuted = matches!(report.outcome, Outcome::Infeasible);
                assert_eq!(refuted, !solvable);
            }
        }
    }
}

#[test]
fn bad_parameters_are_named_with_value_and_range() {
    let refused = |change: fn(&mut LbfgsParams)| {
        let mut params = LbfgsParams::default();
        change(&mut params);
        Lbfgs::new(params).map(|_| ()).unwrap_err().to_string()
    };
    for (said, expected) in [
        (
            refused(|p| p.points = 0),
            "parameter `points`: `0` is not a whole number from 1 to 1000000",
        ),
        (
            refused(|p| p.clearance = f64::NAN),
            "parameter `clearance`: `NaN` is not a number from 0",
        ),
        (
            refused(|p| p.hysteresis = 1.0),
            "parameter `hysteresis`: `1` is not a number from 0 to below 1",
        ),
        (
            refused(|p| p.margin = 0.0),
            "parameter `margin`: `0` is not a positive number",
        ),
        (
            refused(|p| p.armijo = -0.1),
            "parameter `armijo`: `-0.1` is not a number from 0 to below 1",
        ),
        (
            refused(|p| p.spread = f64::INFINITY),
            "parameter `spread`: `inf` is not a number from 0",
        ),
    ] {
        assert_eq!(said, expected);
    }
}

#[test]
fn the_paper_s_rules_decline_other_shapes() {
    let circle = pf_geom::Circle::new(pf_geom::Point::origin(), 1.0).unwrap();
    let problem = asked(&[circle.into()], [-5.0, 0.0], [5.0, 0.0]);
    for params in all_rules().into_iter().skip(1) {
        let mut planner = Lbfgs::new(params).unwrap();
        let answer = planner.plan(&problem, &mut Context::seeded(0));
        assert!(answer.unwrap_err().to_string().contains("rectangles only"));
    }
}
