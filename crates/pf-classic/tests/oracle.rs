//! Every answer beside the oracle's: thousands of made-up maps, tens of thousands of changes.
#![expect(clippy::unwrap_used, reason = "a test that stumbles has failed")]

use pf_classic::{AStar, Auto, DStarLite, DStarLiteParams, Dijkstra, Jps};
use pf_conformance::{
    grid::{Recipe, drawing, oracle, random_batch, random_problem},
    seeded,
};
use pf_core::{Budget, Context, Outcome, Planner, Problem, Replanner, Report};
use pf_grid::{Advance, Cell, Drive, Grid, GridChange, GridCost, GridProblem};
use rand::RngExt;
use std::{collections::BTreeMap, fmt::Arguments};

/// The proven cost, or the proof that there is none; the judge confirms it.
#[track_caller]
fn proven(problem: &GridProblem, report: &Report<GridProblem>) -> Option<GridCost> {
    match &report.outcome {
        Outcome::Optimal(best) => {
            assert_eq!(problem.judge(&best.solution), Ok(best.cost));
            Some(best.cost)
        }
        Outcome::Infeasible => None,
        other => panic!("{other:?} proves nothing on\n{}", drawing(problem)),
    }
}

/// The same, after changes; the oracle confirms it, too.
#[track_caller]
fn exact(
    problem: &GridProblem,
    changes: &[GridChange],
    report: &Report<GridProblem>,
    place: Arguments<'_>,
) -> Option<GridCost> {
    let found = proven(problem, report);
    assert_eq!(
        found,
        oracle(problem),
        "{place}: {changes:?} led to\n{}",
        drawing(problem)
    );
    found
}

/// Counts in which way an answer came.
fn count(ways: &mut BTreeMap<String, u32>, report: &Report<GridProblem>) {
    if let Some(way) = report.note("replanned") {
        *ways.entry(way.to_owned()).or_default() += 1;
    }
}

#[test]
fn searches_are_exact_on_made_up_maps() {
    let mut rng = seeded(20);
    let (mut astar, mut dijkstra) = (AStar::default(), Dijkstra::default());
    for round in 0..20_000 {
        let recipe = Recipe::any(&mut rng, 1..=if round % 20 == 0 { 60 } else { 16 });
        let problem = random_problem(&mut rng, &recipe);
        let expected = oracle(&problem);
        let planners: [&mut dyn Planner<GridProblem>; 2] = [&mut astar, &mut dijkstra];
        for planner in planners {
            let report = planner.plan(&problem, &mut Context::seeded(0)).unwrap();
            let found = proven(&problem, &report);
            let name = planner.name();
            assert_eq!(
                found,
                expected,
                "{name}, round {round}:\n{}",
                drawing(&problem)
            );
        }
    }
}

/// Plays `stories` random stories of `batches` batches each and returns how often the planner
/// answered in which way. In every other story the goal stays.
fn play(seed: u64, stories: u32, batches: u32, params: &DStarLiteParams) -> BTreeMap<String, u32> {
    let mut rng = seeded(seed);
    let mut ways = BTreeMap::new();
    for story in 0..stories {
        let recipe = Recipe::any(&mut rng, 5..=80);
        let mut problem = random_problem(&mut rng, &recipe);
        let mut planner = DStarLite::new(params.clone()).unwrap();
        let report = planner.plan(&problem, &mut Context::seeded(0)).unwrap();
        assert_eq!(proven(&problem, &report), oracle(&problem));
        for batch in 0..batches {
            if rng.random_bool(0.3) {
                let most = [1, 10, 50, u64::MAX][rng.random_range(0..4usize)];
                let budget = Budget::unlimited().iterations(most);
                planner.settle(&problem, &mut Context::seeded(0).within(budget));
            }
            let most = [1, 10, 200][rng.random_range(0..3usize)];
            let mut changes = random_batch(&mut rng, &problem, most);
            if story % 2 == 1 {
                changes.retain(|change| !matches!(change, GridChange::GoalMoved(_)));
            }
            let revision = problem.revise(&changes).unwrap();
            let report = planner.replan(&revision, &mut Context::seeded(0)).unwrap();
            count(&mut ways, &report);
            let place = format_args!("seed {seed}, story {story}, batch {batch}");
            let found = exact(&problem, &changes, &report, place);
            let revision = problem.revise(&[]).unwrap();
            let again = planner.replan(&revision, &mut Context::seeded(0)).unwrap();
            assert_eq!(proven(&problem, &again), found);
            let (first, second) = (report.stats.expanded, again.stats.expanded);
            assert!(
                second == 0 || params.eager,
                "seed {seed}, story {story}, batch {batch}: {second} after {first} for nothing; {:?}\n{}",
                report.note("replanned"),
                drawing(&problem)
            );
        }
    }
    ways
}

/// Each way of answering has to come up often for the test to say much.
fn often(ways: &BTreeMap<String, u32>, least: &[(&str, u32)]) {
    for &(way, least) in least {
        assert!(ways.get(way) > Some(&least), "too few are {way}: {ways:?}");
    }
}

#[test]
fn d_star_lite_is_exact_after_thirty_thousand_batches() {
    let ways = play(30, 300, 100, &DStarLiteParams::default());
    often(
        &ways,
        &[("kept", 2000), ("searched", 4000), ("afresh", 2000)],
    );
}

/// One planner, from map to map, each of them presumed open at first.
#[test]
fn d_star_lite_is_exact_on_drives_where_it_jumps() {
    let mut rng = seeded(34);
    let mut planner = DStarLite::default();
    let mut ways = BTreeMap::new();
    for round in 0..40 {
        let recipe = Recipe {
            terrain: false,
            ..Recipe::any(&mut rng, 40..=90)
        };
        let problem = random_problem(&mut rng, &recipe);
        let mut drive = Drive::new(&problem, 4.0).unwrap();
        let mut report = planner
            .plan(drive.known(), &mut Context::seeded(0))
            .unwrap();
        loop {
            let found = proven(drive.known(), &report);
            let known = drawing(drive.known());
            assert_eq!(found, oracle(drive.known()), "drive {round}:\n{known}");
            if rng.random_bool(0.9) {
                planner.settle(drive.known(), &mut Context::seeded(0));
            }
            let Some(best) = report.outcome.solved() else {
                break;
            };
            let Advance::Discovered(changes) = drive.advance(&best.solution) else {
                break;
            };
            let revision = drive.learn(&changes).unwrap();
            report = planner.replan(&revision, &mut Context::seeded(0)).unwrap();
            count(&mut ways, &report);
        }
    }
    often(&ways, &[("kept", 500), ("jumped", 500)]);
}

#[test]
fn d_star_lite_is_exact_when_it_repairs_first() {
    let params = DStarLiteParams {
        eager: true,
        ..DStarLiteParams::default()
    };
    let ways = play(32, 200, 100, &params);
    often(&ways, &[("repaired", 6000), ("afresh", 2000)]);
}

#[test]
fn d_star_lite_is_exact_when_it_never_gives_up() {
    let params = DStarLiteParams {
        patience: f64::INFINITY,
        eager: true,
    };
    let ways = play(31, 300, 100, &params);
    often(&ways, &[("repaired", 12_000)]);
}

/// While a map only closes, they learn; where it opens, or another goal is asked for, that holds no more.
#[test]
fn jump_points_are_exact_where_they_have_learned() {
    let mut rng = seeded(35);
    for story in 0..600 {
        let recipe = Recipe {
            terrain: false,
            ..Recipe::any(&mut rng, 5..=40)
        };
        let mut problem = random_problem(&mut rng, &recipe);
        let mut planner = Jps::default();
        planner.plan(&problem, &mut Context::seeded(0)).unwrap();
        for batch in 0..30 {
            let mut changes = random_batch(&mut rng, &problem, 8);
            let only_closes = rng.random_bool(0.7);
            changes.retain(|change| match change {
                GridChange::Blocked(_) | GridChange::StartMoved(_) => true,
                GridChange::Freed(_) | GridChange::GoalMoved(_) => !only_closes,
                GridChange::CostChanged(..) => false,
            });
            let revision = problem.revise(&changes).unwrap();
            // Now and then nobody tells it what has changed.
            let report = if rng.random_bool(0.1) {
                planner.plan(&problem, &mut Context::seeded(0))
            } else {
                planner.replan(&revision, &mut Context::seeded(0))
            };
            let report = report.unwrap();
            let place = format_args!("story {story}, batch {batch}");
            exact(&problem, &changes, &report, place);
        }
    }
}

/// While there is terrain nobody jumps, and nobody may forget what changes meanwhile.
#[test]
fn d_star_lite_is_exact_where_terrain_comes_and_goes() {
    let mut rng = seeded(36);
    let mut ways = BTreeMap::new();
    for story in 0..400 {
        let recipe = Recipe {
            terrain: false,
            ..Recipe::any(&mut rng, 30..=60)
        };
        let mut problem = random_problem(&mut rng, &recipe);
        let mut planner = DStarLite::default();
        planner.plan(&problem, &mut Context::seeded(0)).unwrap();
        let mut dear = None;
        for batch in 0..40 {
            planner.settle(&problem, &mut Context::seeded(0));
            let mut changes = random_batch(&mut rng, &problem, 6);
            changes.retain(|change| match change {
                GridChange::GoalMoved(_) | GridChange::CostChanged(..) => false,
                GridChange::Blocked(cells) => dear.is_none_or(|dear| !cells.contains(&dear)),
                _ => true,
            });
            if let Some(cell) = dear.filter(|_| batch % 4 == 0) {
                changes.push(GridChange::CostChanged(vec![cell], 1));
                dear = None;
            } else if dear.is_none() && rng.random_bool(0.3) {
                let free = problem.grid().layout().cells();
                dear = free.filter(|&cell| problem.grid().is_free(cell)).last();
                changes.retain(|change| !matches!(change, GridChange::Blocked(_)));
                changes.extend(dear.map(|cell| GridChange::CostChanged(vec![cell], 7)));
            }
            let revision = problem.revise(&changes).unwrap();
            let report = planner.replan(&revision, &mut Context::seeded(0)).unwrap();
            let place = format_args!("story {story}, batch {batch}");
            exact(&problem, &changes, &report, place);
            count(&mut ways, &report);
        }
    }
    often(&ways, &[("searched", 500), ("jumped", 200)]);
}

/// Much changes around the robot, again and again, under every move rule, with terrain and without.
#[test]
fn d_star_lite_is_exact_where_walls_close_around_the_robot() {
    let mut rng = seeded(39);
    let mut ways = BTreeMap::new();
    for round in 0..200 {
        let recipe = Recipe::any(&mut rng, 30..=90);
        let mut problem = random_problem(&mut rng, &recipe);
        let mut planner = DStarLite::default();
        planner.plan(&problem, &mut Context::seeded(0)).unwrap();
        for step in 0..6 {
            planner.settle(&problem, &mut Context::seeded(0));
            let robot = problem.start();
            let is_near = |cell: &Cell| cell.x.abs_diff(robot.x).max(cell.y.abs_diff(robot.y)) < 20;
            let cells = problem.grid().layout().cells().filter(is_near);
            let share = rng.random_range(0.2..0.6);
            let flipped = cells.filter(|&cell| cell != robot && rng.random_bool(share));
            let (blocked, freed): (Vec<_>, _) =
                flipped.partition(|&cell| problem.grid().is_free(cell));
            let changes = [GridChange::Blocked(blocked), GridChange::Freed(freed)];
            let revision = problem.revise(&changes).unwrap();
            let report = planner.replan(&revision, &mut Context::seeded(0)).unwrap();
            exact(&problem, &changes, &report, format_args!("{round}, {step}"));
            count(&mut ways, &report);
        }
    }
    often(&ways, &[("shut in", 100), ("searched", 100)]);
}

/// A goal that moves at every step, most of the steps settled, while a few cells change.
#[test]
fn d_star_lite_jumps_to_a_goal_that_moves() {
    let mut rng = seeded(38);
    let mut ways = BTreeMap::new();
    let mut expanded = [0, 0];
    for round in 0..60 {
        let recipe = Recipe {
            terrain: false,
            ..Recipe::any(&mut rng, 40..=90)
        };
        let mut problem = random_problem(&mut rng, &recipe);
        let (mut planner, mut fresh) = (DStarLite::default(), AStar::default());
        planner.plan(&problem, &mut Context::seeded(0)).unwrap();
        for step in 0..20 {
            if rng.random_bool(0.8) {
                planner.settle(&problem, &mut Context::seeded(0));
            }
            let mut changes = random_batch(&mut rng, &problem, 10);
            changes.retain(|change| !matches!(change, GridChange::GoalMoved(_)));
            let cells = problem.grid().layout().cells();
            let goal = cells.filter(|_| rng.random_bool(0.001)).last();
            changes.extend(goal.map(GridChange::GoalMoved));
            let revision = problem.revise(&changes).unwrap();
            let report = planner.replan(&revision, &mut Context::seeded(0)).unwrap();
            exact(&problem, &changes, &report, format_args!("{round}, {step}"));
            count(&mut ways, &report);
            if report.note("replanned") == Some("jumped") {
                let other = fresh.plan(&problem, &mut Context::seeded(0)).unwrap();
                expanded[0] += report.stats.expanded;
                expanded[1] += other.stats.expanded;
            }
        }
    }
    often(&ways, &[("jumped", 100)]);
    let [jumped, afresh] = expanded;
    assert!(jumped * 4 < afresh, "{jumped} of {afresh}");
}

/// A budget that a plan to where the goal moved breaks is enough for jump points, once there are bits.
#[test]
fn d_star_lite_jumps_where_a_plan_was_cut() {
    let gap = |x: u32| if x.is_multiple_of(32) { 0 } else { 255 };
    let is_wall = |cell: Cell| cell.x % 16 == 8 && cell.y != gap(cell.x - 8);
    let grid = Grid::new(256, 256, |cell| u8::from(!is_wall(cell))).unwrap();
    let mut problem = GridProblem::new(grid, Cell::new(5, 3), Cell::new(11, 3)).unwrap();
    let mut planner = DStarLite::default();
    planner.plan(&problem, &mut Context::seeded(0)).unwrap();
    planner.settle(&problem, &mut Context::seeded(0));
    let mut ask = |changes: &[GridChange]| {
        let revision = problem.revise(changes).unwrap();
        let order = || Context::seeded(0).within(Budget::unlimited().iterations(5000));
        let report = planner.replan(&revision, &mut order()).unwrap();
        planner.settle(&problem, &mut order());
        report
    };
    let cut = ask(&[GridChange::GoalMoved(Cell::new(255, 128))]);
    assert!(matches!(cut.outcome, Outcome::Unknown { .. }));
    let jumped = ask(&[GridChange::StartMoved(Cell::new(4, 3))]);
    assert_eq!(jumped.note("replanned"), Some("jumped"));
    assert_eq!(proven(&problem, &jumped), oracle(&problem));
}

/// All but a plan learn and take short cuts to the goal; the choice also joins what is left of its path.
#[test]
fn a_join_spares_expansions() {
    let mut rng = seeded(37);
    let mut expanded = [0, 0, 0];
    for _ in 0..30 {
        let recipe = Recipe {
            terrain: false,
            ..Recipe::any(&mut rng, 60..=90)
        };
        let problem = random_problem(&mut rng, &recipe);
        let mut drive = Drive::new(&problem, 4.0).unwrap();
        let (mut auto, mut jps) = (Auto::default(), Jps::default());
        let mut report = auto.plan(drive.known(), &mut Context::seeded(0)).unwrap();
        while let Some(best) = report.outcome.solved() {
            let Advance::Discovered(changes) = drive.advance(&best.solution) else {
                break;
            };
            let revision = drive.learn(&changes).unwrap();
            report = auto.replan(&revision, &mut Context::seeded(0)).unwrap();
            let other = jps.replan(&revision, &mut Context::seeded(0)).unwrap();
            let plan = Jps::default().plan(revision.problem(), &mut Context::seeded(0));
            let plan = plan.unwrap();
            let is_jump = report
                .note("search")
                .is_some_and(|text| text.starts_with("jps"));
            if is_jump {
                expanded[0] += report.stats.expanded;
                expanded[1] += other.stats.expanded;
                expanded[2] += plan.stats.expanded;
            }
        }
    }
    let [joined, cut, plan] = expanded;
    let each = format!("{joined} of {cut} of {plan}");
    assert!(joined > 1000 && joined * 10 < cut * 9, "{each}");
    assert!(cut * 10 < plan * 7, "{each}");
}

/// A robot that follows its path, and learns of walls, mostly.
#[test]
fn the_choice_is_exact_where_it_keeps_its_path() {
    let mut rng = seeded(33);
    let mut ways = BTreeMap::new();
    for story in 0..300 {
        let recipe = Recipe::any(&mut rng, 5..=60);
        let mut problem = random_problem(&mut rng, &recipe);
        let mut planner = Auto::default();
        let mut report = planner.plan(&problem, &mut Context::seeded(0)).unwrap();
        for batch in 0..20 {
            let most = [1, 3, 20][rng.random_range(0..3usize)];
            let mut changes = random_batch(&mut rng, &problem, most);
            if rng.random_bool(0.8) {
                changes.retain(|change| matches!(change, GridChange::Blocked(_)));
            }
            if let Some(best) = report.outcome.solved() {
                let step = rng.random_range(0..best.solution.len().min(4));
                changes.push(GridChange::StartMoved(best.solution[step]));
            }
            let revision = problem.revise(&changes).unwrap();
            report = planner.replan(&revision, &mut Context::seeded(0)).unwrap();
            let place = format_args!("story {story}, batch {batch}");
            exact(&problem, &changes, &report, place);
            count(&mut ways, &report);
        }
    }
    often(&ways, &[("kept", 1000), ("afresh", 1000)]);
}

/// Every other row is a wall with a gap at alternating ends.
fn serpentine(side: u32, cost: u8) -> GridProblem {
    let grid = Grid::new(side, side, |cell| {
        let gap = if cell.y % 4 == 1 { side - 1 } else { 0 };
        cost * u8::from(cell.y % 2 == 0 || cell.x == gap)
    });
    let last = Cell::new(side - 1, side - 2);
    GridProblem::new(grid.unwrap(), Cell::new(0, 0), last).unwrap()
}

/// Terrain so dear that paths are too long for 48 bits.
#[test]
fn long_paths_over_dear_terrain_are_exact() {
    let problem = serpentine(320, 200);
    let expected = oracle(&problem);
    let (mut astar, mut dijkstra) = (AStar::default(), Dijkstra::default());
    let planners: [&mut dyn Planner<GridProblem>; 2] = [&mut astar, &mut dijkstra];
    for planner in planners {
        let report = planner.plan(&problem, &mut Context::seeded(0)).unwrap();
        assert_eq!(proven(&problem, &report), expected, "{}", planner.name());
    }
    // Ten bytes a cell and no more would be 48 bits.
    assert!(astar.bytes() > 12 * 320 * 320 && dijkstra.bytes() > 12 * 320 * 320);
}

/// Paths too long for 32 bits to order: every search must notice and count wider.
#[test]
fn long_paths_are_exact() {
    let mut problem = serpentine(320, 1);
    let expected = oracle(&problem);
    assert!(expected.unwrap().value() > 50_000.0);
    let mut dstar = DStarLite::default();
    let mut planners: [Box<dyn Planner<GridProblem>>; 2] =
        [Box::new(AStar::default()), Box::new(Dijkstra::default())];
    for planner in &mut planners {
        let report = planner.plan(&problem, &mut Context::seeded(0)).unwrap();
        assert_eq!(proven(&problem, &report), expected, "{}", planner.name());
    }
    let report = dstar.plan(&problem, &mut Context::seeded(0)).unwrap();
    assert_eq!(proven(&problem, &report), expected);

    // A shortcut near the start, then a wall that makes the way long again, then terrain.
    for changes in [
        GridChange::Freed(vec![Cell::new(160, 1)]),
        GridChange::Blocked(vec![Cell::new(160, 1)]),
        GridChange::CostChanged((0..300).map(|x| Cell::new(x, 160)).collect(), 200),
        GridChange::Blocked(vec![Cell::new(7, 300)]),
    ] {
        let changes = [changes];
        let revision = problem.revise(&changes).unwrap();
        let report = dstar.replan(&revision, &mut Context::seeded(0)).unwrap();
        let expected = oracle(&problem);
        assert_eq!(proven(&problem, &report), expected, "{changes:?}");
        for planner in &mut planners {
            let report = planner.plan(&problem, &mut Context::seeded(0)).unwrap();
            assert_eq!(proven(&problem, &report), expected, "{}", planner.name());
        }
    }
}
