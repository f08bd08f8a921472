//! What planners of fronts keep besides the laws.

use pf_conformance::team::{TeamRecipe, crossing};
use pf_core::{
    Budget, Context, Cost, Event, InvalidParams, Outcome, Params, Planner, Problem, Replanner, Stop,
};
use pf_geom::{Circle, Point, Rectangle, Robot, TeamChange, TeamProblem, World};
use pf_moabc::{
    Moabc, MoabcParams, Moead, MoeadParams, Nsga2, Nsga2Params, Prioritised, RandomSearch,
    RandomSearchParams,
};

const KINDS: [&str; 6] = ["ours", "paper", "classic", "nsga2", "moead", "random"];

fn with<P: Params>(mut params: P, settings: &[(&str, &str)]) -> P {
    for (key, value) in settings {
        params.set(key, value).expect("a parameter");
    }
    params
}

fn planner(kind: &str, settings: &[(&str, &str)]) -> Box<dyn Replanner<TeamProblem>> {
    match kind {
        "ours" => {
            Box::new(Moabc::new(with(MoabcParams::default(), settings)).expect("good parameters"))
        }
        "paper" => {
            Box::new(Moabc::new(with(MoabcParams::paper(), settings)).expect("good parameters"))
        }
        "classic" => {
            Box::new(Moabc::new(with(MoabcParams::classic(), settings)).expect("good parameters"))
        }
        "nsga2" => {
            Box::new(Nsga2::new(with(Nsga2Params::default(), settings)).expect("good parameters"))
        }
        "moead" => {
            Box::new(Moead::new(with(MoeadParams::default(), settings)).expect("good parameters"))
        }
        _ => Box::new(
            RandomSearch::new(with(RandomSearchParams::default(), settings))
                .expect("good parameters"),
        ),
    }
}

fn two() -> TeamProblem {
    let recipe = TeamRecipe {
        robots: 2,
        radius: 1.0,
        obstacles: 3,
        kind: None,
    };
    crossing(5, &recipe)
}

#[test]
fn threads_change_nothing() {
    for kind in KINDS {
        let [one, two, three] = ["1", "2", "3"].map(|threads| {
            // Steps so short that even a small batch is worth sharing.
            let settings = [("threads", threads), ("evaluations", "3000"), ("step", "1")];
            let mut heard = Vec::new();
            let mut listen = |event: &Event<'_, TeamProblem>| {
                if let Event::Candidate(front) = event {
                    heard.extend_from_slice(front.members());
                }
            };
            let mut cx = Context::seeded(3).traced(&mut listen);
            let report = planner(kind, &settings).plan(&two(), &mut cx).unwrap();
            let front = report.outcome.solved().map(|front| front.solution.clone());
            (heard, front)
        });
        assert!(one.0.len() > 2000, "{kind}");
        assert!(one == two, "{kind}");
        assert!(one == three, "{kind}");
    }
}

#[test]
fn a_budget_in_evaluations_is_kept_on_the_dot() {
    for kind in KINDS {
        let budget = Budget::unlimited().evaluations(777);
        let mut cx = Context::seeded(3).within(budget);
        let report = planner(kind, &[]).plan(&two(), &mut cx).unwrap();
        assert_eq!(
            (report.stats.evaluated, report.stop),
            (777, Stop::Evaluations),
            "{kind}"
        );
        let own = planner(kind, &[("evaluations", "555")]);
        let report = { own }.plan(&two(), &mut Context::seeded(3)).unwrap();
        assert_eq!(
            (report.stats.evaluated, report.stop),
            (555, Stop::Finished),
            "{kind}"
        );
    }
}

#[test]
fn after_a_change_the_population_is_a_good_beginning() {
    let budget = || Budget::unlimited().evaluations(600);
    for kind in ["ours", "nsga2", "moead"] {
        let mut problem = two();
        let mut live = planner(kind, &[]);
        live.plan(&problem, &mut Context::seeded(1)).unwrap();
        let goal = problem.robots()[1].goal + pf_geom::Vector::new(1.0, -2.0);
        let changes = [TeamChange::GoalMoved(1, goal)];
        let revision = problem.revise(&changes).unwrap();
        let kept = live
            .replan(&revision, &mut Context::seeded(1).within(budget()))
            .unwrap();
        let fresh = planner(kind, &[]).plan(&problem, &mut Context::seeded(1).within(budget()));
        let volume = |outcome: &Outcome<TeamProblem>| {
            let front = outcome
                .solved()
                .map(|s| s.cost.members().to_vec())
                .unwrap_or_default();
            pf_moabc::indicators::hypervolume(&front, &[250.0, 10.0, 12.0])
        };
        let (kept, fresh) = (volume(&kept.outcome), volume(&fresh.unwrap().outcome));
        assert!(kept > fresh, "{kind}: {kept}, afresh {fresh}");
    }
}

#[test]
fn the_baseline_answers_where_evolution_finds_nothing() {
    // A corridor too narrow for two: one has to wait in the niche.
    let bounds = Rectangle::new(Point::origin(), Point::new(40.0, 20.0)).unwrap();
    let mut world = World::new(bounds);
    for (min, max) in [
        ((0.0, 0.0), (40.0, 8.0)),
        ((0.0, 12.0), (18.0, 20.0)),
        ((22.0, 12.0), (40.0, 20.0)),
    ] {
        let wall = Rectangle::new(Point::new(min.0, min.1), Point::new(max.0, max.1)).unwrap();
        world.add(wall.into());
    }
    let (west, east) = (Point::new(3.0, 10.0), Point::new(37.0, 10.0));
    let robots = vec![
        Robot::new(west, east).with_radius(1.5),
        Robot::new(east, west).with_radius(1.5),
    ];
    let problem = TeamProblem::new(world, robots).unwrap();
    let settings = [("population", "20"), ("evaluations", "1000")];
    for kind in KINDS {
        let report = planner(kind, &settings)
            .plan(&problem, &mut Context::seeded(1))
            .unwrap();
        let front = report.outcome.solved().expect("a plan");
        assert!(problem.judge(&front.solution).is_ok());
        let note = report.note("baseline").expect("a note");
        assert!(
            note.starts_with("prioritised planning with safe intervals"),
            "{note}"
        );
    }
}

#[test]
fn ten_robots_cross_and_fifty_do() {
    for (robots, obstacles, seeds) in [(10, 20, 0..5), (50, 5, 0..1)] {
        for seed in seeds {
            let recipe = TeamRecipe {
                robots,
                radius: 1.0,
                obstacles,
                kind: None,
            };
            let problem = crossing(seed, &recipe);
            let report = Prioritised::default()
                .plan(&problem, &mut Context::seeded(seed))
                .unwrap();
            let front = report.outcome.solved().expect("a plan");
            assert!(problem.judge(&front.solution).unwrap().same_as(&front.cost));
        }
    }
}

#[test]
fn a_robot_without_a_path_is_named() {
    let bounds = Rectangle::new(Point::origin(), Point::new(20.0, 20.0)).unwrap();
    let mut world = World::new(bounds);
    let wall = Rectangle::new(Point::new(9.0, -1.0), Point::new(10.0, 21.0)).unwrap();
    world.add(wall.into());
    let robots = vec![
        Robot::new(Point::new(1.0, 1.0), Point::new(5.0, 9.0)),
        Robot::new(Point::new(2.0, 5.0), Point::new(15.0, 5.0)),
    ];
    let problem = TeamProblem::new(world, robots).unwrap();
    for kind in KINDS {
        let settings = [("evaluations", "300"), ("population", "10")];
        let report = planner(kind, &settings)
            .plan(&problem, &mut Context::seeded(1))
            .unwrap();
        assert!(matches!(report.outcome, Outcome::Infeasible), "{kind}");
        assert_eq!(
            report.note("dead end"),
            Some("robot 1 has no path even alone")
        );
    }
}

#[test]
fn goals_that_overlap_are_a_dead_end_with_numbers() {
    let bounds = Rectangle::new(Point::origin(), Point::new(20.0, 20.0)).unwrap();
    let robots = vec![
        Robot::new(Point::new(1.0, 1.0), Point::new(15.0, 9.0)).with_radius(0.5),
        Robot::new(Point::new(2.0, 5.0), Point::new(15.5, 9.0)).with_radius(0.5),
    ];
    let problem = TeamProblem::new(World::new(bounds), robots).unwrap();
    let report = Moabc::default()
        .plan(&problem, &mut Context::seeded(1))
        .unwrap();
    assert!(matches!(report.outcome, Outcome::Infeasible));
    assert_eq!(
        report.note("dead end"),
        Some("robots 0 and 1 overlap at their goals")
    );
}

#[test]
fn an_evaluation_allocates_nothing() {
    let mut world = World::new(Rectangle::new(Point::origin(), Point::new(100.0, 100.0)).unwrap());
    world.add(Circle::new(Point::new(50.0, 50.0), 5.0).unwrap().into());
    let robot = Robot::new(Point::origin(), Point::new(100.0, 100.0));
    let problem = TeamProblem::new(world, vec![robot]).unwrap();
    let allocations = |evaluations: &str| {
        let settings = [("evaluations", evaluations), ("archive", "10")];
        let mut planner = planner("random", &settings);
        let mut plan = || planner.plan(&problem, &mut Context::seeded(1)).unwrap();
        plan();
        allocation_counter::measure(|| drop(plan())).count_total
    };
    // A few lists a cycle, and none a plan.
    let (few, many) = (allocations("1000"), allocations("101000"));
    assert!(many - few < 10_000, "{few}, then {many}");
}

#[test]
fn bad_parameters_are_named_with_value_and_range() {
    let refused = |settings: &[(&str, &str)]| -> InvalidParams {
        Moabc::new(with(MoabcParams::default(), settings))
            .map(drop)
            .unwrap_err()
    };
    assert_eq!(
        refused(&[("population", "3")]).to_string(),
        "parameter `population`: `3` is not a whole number from 4 to 100000"
    );
    assert_eq!(
        refused(&[("share", "1.5")]).to_string(),
        "parameter `share`: `1.5` is not a number from 0 to 1"
    );
    assert_eq!(
        refused(&[("step", "NaN")]).to_string(),
        "parameter `step`: `NaN` is not a number from 0"
    );
    let mut params = MoabcParams::default();
    assert_eq!(
        params.set("rules", "mine").unwrap_err().to_string(),
        "parameter `rules`: `mine` is not a value of type Rules"
    );
}
