//! Every answer of the altitude field against an oracle, settled and not.
#![expect(clippy::unwrap_used, reason = "a test that stumbles has failed")]

use pf_conformance::{
    grid::{Kind, Recipe, drawing, oracle, random_batch, random_problem},
    seeded,
};
use pf_core::{Context, Outcome, PlanRng, Planner, Problem, Replanner, Report};
use pf_grid::{Cell, Grid, GridChange, GridCost, GridProblem, Moves};
use pf_rfd::{RfdField, RfdFieldParams};
use rand::RngExt;
use std::collections::BTreeMap;

#[track_caller]
fn proven(problem: &GridProblem, report: &Report<GridProblem>) -> Option<GridCost> {
    match &report.outcome {
        Outcome::Optimal(best) => {
            assert_eq!(problem.judge(&best.solution), Ok(best.cost));
            Some(best.cost)
        }
        Outcome::Infeasible => None,
        other => panic!("{} proves nothing", other.word()),
    }
}

/// Square blocks, strewn.
fn mosaic(rng: &mut PlanRng, size: u32, dearest: u8) -> Grid {
    let tile = (size / 10).max(1);
    let seed: Vec<bool> = (0..400).map(|_| rng.random_bool(0.3)).collect();
    let at = |cell: Cell| seed[((cell.y / tile % 20) * 20 + cell.x / tile % 20) as usize];
    Grid::new(size, size, |cell| {
        if at(cell) {
            0
        } else {
            rng.random_range(1..=dearest)
        }
    })
    .unwrap()
}

/// Walls from side to side, each with a gap at alternate ends.
fn alley(rng: &mut PlanRng, size: u32, dearest: u8) -> Grid {
    let apart = rng.random_range(3..=(size / 3).max(3));
    let gap = rng.random_range(1..=size / 4);
    Grid::new(size, size, |cell| {
        let along = match cell.x / apart % 2 {
            0 => cell.y,
            _ => size - 1 - cell.y,
        };
        if cell.x % apart == apart - 1 && along >= gap {
            0
        } else {
            rng.random_range(1..=dearest)
        }
    })
    .unwrap()
}

fn any_cell(rng: &mut PlanRng, grid: &Grid) -> Cell {
    Cell::new(
        rng.random_range(0..grid.width()),
        rng.random_range(0..grid.height()),
    )
}

fn free_cell(rng: &mut PlanRng, grid: &Grid) -> Cell {
    (0..99)
        .map(|_| any_cell(rng, grid))
        .find(|&cell| grid.is_free(cell))
        .unwrap_or_default()
}

fn some_problem(rng: &mut PlanRng, story: u32) -> GridProblem {
    let moves = Moves::ALL[story as usize / 4 % 4];
    let size = match story % 40 {
        7 | 18 | 29 => 150..=200,
        n if n % 5 == 0 => 60..=100,
        _ => 20..=40,
    };
    let terrain = story % 3 == 2;
    let kind = match story % 4 {
        0 => Kind::Noise,
        1 => Kind::Maze,
        kind => {
            let size = rng.random_range(size);
            // The dearest alleys take more than 32 bits.
            let dearest = match story % 6 {
                2 => 4,
                5 => 254,
                _ => 1,
            };
            let grid = if kind == 2 { mosaic } else { alley }(rng, size, dearest);
            let (start, goal) = (free_cell(rng, &grid), free_cell(rng, &grid));
            return GridProblem::new(grid, start, goal)
                .unwrap()
                .with_moves(moves);
        }
    };
    let density = rng.random_range(0.05..0.35);
    random_problem(
        rng,
        &Recipe {
            kind,
            size,
            density,
            terrain,
            moves,
        },
    )
}

/// So many cells around one, or anywhere.
fn cells(rng: &mut PlanRng, grid: &Grid, count: u32) -> Vec<Cell> {
    let middle = any_cell(rng, grid);
    let reach = [2, 6, 400][rng.random_range(0..3usize)];
    (0..count)
        .map(|_| {
            let off = |rng: &mut PlanRng, at: u32, size: u32| {
                let least = at.saturating_sub(reach);
                rng.random_range(least..=(at + reach).min(size - 1))
            };
            let x = off(rng, middle.x, grid.width());
            Cell::new(x, off(rng, middle.y, grid.height()))
        })
        .collect()
}

/// Some cells the other way round: what was free is blocked, or not, and what was blocked is freed, or not.
fn turned(rng: &mut PlanRng, grid: &Grid, count: u32) -> Vec<GridChange> {
    let share = rng.random_range(0.0..1.0);
    let (free, walls): (Vec<Cell>, Vec<Cell>) = cells(rng, grid, count)
        .into_iter()
        .partition(|&cell| grid.is_free(cell));
    let mut some = |cells: Vec<Cell>, share: f64| -> Vec<Cell> {
        let keep = |_: &Cell| rng.random_bool(share);
        cells.into_iter().filter(keep).collect()
    };
    let blocked = GridChange::Blocked(some(free, share));
    vec![blocked, GridChange::Freed(some(walls, 1.0 - share))]
}

/// One kind of thing that happens, or many at once.
fn some_event(rng: &mut PlanRng, problem: &GridProblem, path: &[Cell]) -> Vec<GridChange> {
    let grid = problem.grid();
    let count = [1, 3, 10, 40, 200][rng.random_range(0..5usize)];
    match rng.random_range(0..18) {
        0 => vec![GridChange::GoalMoved(free_cell(rng, grid))],
        1 => vec![GridChange::StartMoved(free_cell(rng, grid))],
        2 => vec![
            GridChange::StartMoved(free_cell(rng, grid)),
            GridChange::GoalMoved(free_cell(rng, grid)),
        ],
        3 | 4 => vec![GridChange::Blocked(cells(rng, grid, count))],
        5 if path.len() > 2 => {
            let at = rng.random_range(1..path.len() - 1);
            vec![GridChange::Blocked(path[at..=at].to_vec())]
        }
        6 | 7 => vec![GridChange::Freed(cells(rng, grid, count))],
        10 | 11 => vec![GridChange::Freed(cells(rng, grid, count.min(40)))],
        8 if !grid.is_uniform() => vec![GridChange::CostChanged(cells(rng, grid, count), 3)],
        9 if path.len() > 5 => vec![
            GridChange::StartMoved(path[path.len() / 5]),
            GridChange::Blocked(cells(rng, grid, count.min(40))),
        ],
        14.. => turned(rng, grid, count),
        _ => random_batch(rng, problem, 200),
    }
}

/// Plays events and counts how the answers came; settles before an event as often as `settle` says.
fn play(seed: u64, events: u32, settle: f64) -> BTreeMap<String, u32> {
    let mut rng = seeded(seed);
    let mut ways = BTreeMap::new();
    for story in 0..events / 25 {
        let mut problem = some_problem(&mut rng, story);
        let params = RfdFieldParams {
            patience: [0.2, 0.0, f64::INFINITY][story as usize % 3],
        };
        let mut planner = RfdField::new(params).unwrap();
        let report = planner.plan(&problem, &mut Context::seeded(0)).unwrap();
        assert_eq!(proven(&problem, &report), oracle(&problem));
        let mut path = Vec::new();
        for event in 0..25 {
            if rng.random_bool(settle) {
                planner.settle(&problem, &mut Context::seeded(0));
            }
            let before = drawing(&problem);
            let changes = some_event(&mut rng, &problem, &path);
            let revision = problem.revise(&changes).unwrap();
            let report = planner.replan(&revision, &mut Context::seeded(0)).unwrap();
            let way = report.note("replanned").unwrap_or("hopeless");
            *ways.entry(way.to_owned()).or_default() += 1;
            assert_eq!(
                proven(&problem, &report),
                oracle(&problem),
                "seed {seed}, story {story}, event {event}, {way}: {changes:?} led from\n{before} to\n{}",
                drawing(&problem)
            );
            path = report
                .outcome
                .solved()
                .map_or_else(Vec::new, |best| best.solution.clone());
        }
    }
    ways
}

/// Each way of answering has to come up often for a test to say much.
#[track_caller]
fn often(ways: &BTreeMap<String, u32>, least: &[(&str, u32)]) {
    for &(way, least) in least {
        assert!(ways.get(way) > Some(&least), "too few are {way}: {ways:?}");
    }
}

#[test]
fn ten_thousand_answers_of_settled_fields_are_the_best() {
    let ways = play(50, 10_000, 1.0);
    often(
        &ways,
        &[
            ("kept", 4000),
            ("patched", 120),
            ("searched", 1500),
            ("afresh", 100),
        ],
    );
}

#[test]
fn ten_thousand_answers_of_fields_settled_now_and_then_or_never_are_the_best() {
    let ways = play(51, 5000, 0.3);
    often(
        &ways,
        &[
            ("kept", 1000),
            ("patched", 20),
            ("searched", 300),
            ("afresh", 100),
        ],
    );
    let ways = play(52, 5000, 0.0);
    often(&ways, &[("kept", 500), ("searched", 200), ("afresh", 1000)]);
}

/// A drawn problem without diagonal steps, and a field that knows it.
fn settled(drawing: &str, start: Cell, goal: Cell) -> (GridProblem, RfdField) {
    let problem = GridProblem::new(Grid::parse(drawing).unwrap(), start, goal);
    let problem = problem.unwrap().with_moves(Moves::Orthogonal);
    let mut planner = RfdField::default();
    planner.plan(&problem, &mut Context::seeded(0)).unwrap();
    planner.settle(&problem, &mut Context::seeded(0));
    (problem, planner)
}

/// Replans after these changes; the answer is proven to take so many steps.
#[track_caller]
fn replans(problem: &mut GridProblem, planner: &mut RfdField, changes: &[GridChange], steps: u64) {
    let revision = problem.revise(changes).unwrap();
    let report = planner.replan(&revision, &mut Context::seeded(0)).unwrap();
    let expected = GridCost::of_steps(steps, 0);
    assert_eq!(proven(problem, &report), Some(expected));
}

/// A door between two halls as far from the goal helps nobody, until a wall further on has a door, too.
#[test]
fn a_useless_door_leads_to_a_useful_one() {
    let drawing = "
        ...........
        .....@.....
        .....@.....
        @@@@@@@@@@.
        .....@.....
        .....@.....
        ...........
    ";
    let (start, goal) = (Cell::new(1, 2), Cell::new(10, 3));
    let (mut problem, mut planner) = settled(drawing, start, goal);
    let doors = [Cell::new(2, 3), Cell::new(5, 4)];
    for (freed, steps) in [(&doors[..1], 14), (&doors[1..], 14), (&doors[..], 12)] {
        planner.settle(&problem, &mut Context::seeded(0));
        let changes = [GridChange::Freed(freed.to_vec())];
        replans(&mut problem, &mut planner, &changes, steps);
        problem
            .apply(&[GridChange::Blocked(freed.to_vec())])
            .unwrap();
        planner.plan(&problem, &mut Context::seeded(0)).unwrap();
    }
}

/// The old way beyond the useful cell is cut, and the way on leads over one that helps nobody by itself.
#[test]
fn a_useless_door_after_a_useful_one() {
    let drawing = "
        .............
        @@@@@@@@@@@@.
        .............
        .....@.......
    ";
    let (start, goal) = (Cell::new(2, 0), Cell::new(10, 2));
    let (mut problem, mut planner) = settled(drawing, start, goal);
    let changes = [
        GridChange::Blocked(vec![Cell::new(5, 2)]),
        GridChange::Freed(vec![Cell::new(2, 1), Cell::new(5, 3)]),
    ];
    replans(&mut problem, &mut planner, &changes, 12);
}

/// A way that the fields know was cut when the last path was found. That path still goes, and opening the
/// way again makes nothing better than the fields ever said.
#[test]
fn a_way_that_opens_again_is_not_news_and_yet_the_best() {
    let drawing = "
        .....
        .@@@.
        .....
    ";
    let (start, goal) = (Cell::new(0, 0), Cell::new(4, 0));
    let (mut problem, mut planner) = settled(drawing, start, goal);
    let door = vec![Cell::new(2, 0)];
    for (change, steps) in [
        (GridChange::Blocked(door.clone()), 8),
        (GridChange::Freed(door), 4),
    ] {
        replans(&mut problem, &mut planner, &[change], steps);
    }
}

/// Either half of a way is short enough for 32 bits, and the whole is not.
#[test]
fn two_halves_that_are_joined_may_need_a_wider_word() {
    let gap = Cell::new(399, 201);
    let end = Cell::new(399, 398);
    let mut problem = serpentine(400, 1);
    problem
        .apply(&[GridChange::GoalMoved(end), GridChange::Blocked(vec![gap])])
        .unwrap();
    let mut planner = RfdField::default();
    let report = planner.plan(&problem, &mut Context::seeded(0)).unwrap();
    assert_eq!(proven(&problem, &report), None);
    planner.settle(&problem, &mut Context::seeded(0));
    let changes = [GridChange::Freed(vec![gap])];
    let revision = problem.revise(&changes).unwrap();
    let report = planner.replan(&revision, &mut Context::seeded(0)).unwrap();
    assert!(oracle(&problem).is_some());
    assert_eq!(proven(&problem, &report), oracle(&problem));
}

/// Altitudes are above the goal in every word.
#[test]
fn altitudes_stay_right_when_the_word_widens() {
    let mut problem = serpentine(400, 1);
    let (start, goal) = (Cell::new(399, 398), Cell::new(0, 200));
    let changes = [GridChange::StartMoved(start), GridChange::GoalMoved(goal)];
    problem.apply(&changes).unwrap();
    let mut planner = RfdField::default();
    planner.plan(&problem, &mut Context::seeded(0)).unwrap();
    planner.settle(&problem, &mut Context::seeded(0));
    assert_eq!(planner.altitude(goal), Some(0.0));
}

/// A hundredth of a wide map changes anywhere: many ways down are as long as each other, and some of
/// them are cut further on.
#[test]
fn answers_on_wide_maps_that_change_all_over_are_the_best() {
    let mut rng = seeded(53);
    let mut ways = BTreeMap::new();
    for story in 0..140 {
        let size = rng.random_range(120..=200);
        let grid = mosaic(&mut rng, size, 1);
        let (start, goal) = (free_cell(&mut rng, &grid), free_cell(&mut rng, &grid));
        let moves = Moves::ALL[story % 4];
        let problem = GridProblem::new(grid, start, goal).unwrap();
        let mut problem = problem.with_moves(moves);
        let mut planner = RfdField::default();
        planner.plan(&problem, &mut Context::seeded(0)).unwrap();
        for event in 0..8 {
            planner.settle(&problem, &mut Context::seeded(0));
            let (mut free, mut blocked) = (vec![], vec![]);
            for _ in 0..size * size / 100 {
                let cell = any_cell(&mut rng, problem.grid());
                if problem.grid().is_free(cell) {
                    free.push(cell);
                } else if rng.random_bool(0.3) {
                    blocked.push(cell);
                }
            }
            let changes = [GridChange::Blocked(free), GridChange::Freed(blocked)];
            let revision = problem.revise(&changes).unwrap();
            let report = planner.replan(&revision, &mut Context::seeded(0)).unwrap();
            let way = report.note("replanned").unwrap_or("hopeless");
            *ways.entry(way.to_owned()).or_default() += 1;
            let expected = oracle(&problem);
            assert_eq!(
                proven(&problem, &report),
                expected,
                "{story}, {event}, {way}"
            );
        }
    }
    often(&ways, &[("searched", 300)]);
}

/// Every other row is a wall with a gap at alternate ends: from corner to corner through half the
/// cells, each of which costs so much.
fn serpentine(side: u32, cost: u8) -> GridProblem {
    let grid = Grid::new(side, side, |cell| {
        let gap = if cell.y % 4 == 1 { side - 1 } else { 0 };
        cost * u8::from(cell.y % 2 == 0 || cell.x == gap)
    });
    let last = Cell::new(side - 1, side - 2);
    GridProblem::new(grid.unwrap(), Cell::new(0, 0), last).unwrap()
}

/// The most bytes a cell that it holds between calls, where it settles before each event.
#[expect(clippy::cast_precision_loss, reason = "far below 2^53")]
fn bytes_a_cell(problem: &mut GridProblem, events: &[GridChange]) -> f64 {
    let mut planner = RfdField::default();
    let report = planner.plan(problem, &mut Context::seeded(0)).unwrap();
    assert_eq!(proven(problem, &report), oracle(problem));
    let mut most = planner.bytes();
    for event in events {
        planner.settle(problem, &mut Context::seeded(0));
        most = planner.bytes().max(most);
        let revision = problem.revise(std::slice::from_ref(event)).unwrap();
        let report = planner.replan(&revision, &mut Context::seeded(0)).unwrap();
        assert_eq!(proven(problem, &report), oracle(problem));
        most = planner.bytes().max(most);
    }
    most as f64 / f64::from(problem.grid().width() * problem.grid().height())
}

#[test]
fn it_takes_less_than_18_and_24_bytes_a_cell() {
    let open = Grid::open(1024, 1024).unwrap();
    let ends = [Cell::new(3, 3), Cell::new(1000, 980)];
    let events = [
        GridChange::Blocked((0..900).map(|y| Cell::new(500, 50 + y)).collect()),
        GridChange::Freed((0..100).map(|y| Cell::new(500, 100 + y)).collect()),
        GridChange::StartMoved(Cell::new(9, 300)),
    ];
    let mut open = GridProblem::new(open, ends[0], ends[1]).unwrap();
    let bytes = bytes_a_cell(&mut open, &events);
    assert!(bytes < 18.0, "{bytes}");
    // The path is half a million cells long, and needs more than 32 bits.
    let events = [
        GridChange::Freed(vec![Cell::new(500, 1)]),
        GridChange::Blocked(vec![Cell::new(500, 1)]),
        GridChange::Freed((0..40).map(|x| Cell::new(500 + x, 501)).collect()),
        GridChange::Blocked((0..40).map(|x| Cell::new(500 + x, 501)).collect()),
        GridChange::StartMoved(Cell::new(500, 500)),
        GridChange::Blocked(vec![Cell::new(7, 900)]),
        GridChange::Freed(vec![Cell::new(7, 900)]),
    ];
    let bytes = bytes_a_cell(&mut serpentine(1024, 1), &events);
    assert!((23.0..24.0).contains(&bytes), "{bytes}");
}

/// Paths too long for 32 bits to order, and with terrain for 48.
#[test]
#[expect(clippy::cast_precision_loss, reason = "far below 2^53")]
fn long_paths_are_exact() {
    for (cost, bytes) in [(1, 23.0..25.0), (200, 29.0..31.0)] {
        let mut problem = serpentine(320, cost);
        let mut planner = RfdField::default();
        let report = planner.plan(&problem, &mut Context::seeded(0)).unwrap();
        assert_eq!(proven(&problem, &report), oracle(&problem));
        planner.settle(&problem, &mut Context::seeded(0));
        // Which says how wide the word is.
        let bytes_a_cell = planner.bytes() as f64 / 320.0 / 320.0;
        assert!(bytes.contains(&bytes_a_cell), "{bytes_a_cell}");
        for changes in [
            GridChange::Freed(vec![Cell::new(160, 1)]),
            GridChange::Blocked(vec![Cell::new(160, 1)]),
            GridChange::CostChanged((0..300).map(|x| Cell::new(x, 160)).collect(), 200),
            GridChange::Blocked(vec![Cell::new(7, 300)]),
        ] {
            planner.settle(&problem, &mut Context::seeded(0));
            let changes = [changes];
            let revision = problem.revise(&changes).unwrap();
            let report = planner.replan(&revision, &mut Context::seeded(0)).unwrap();
            assert_eq!(proven(&problem, &report), oracle(&problem));
        }
    }
}
