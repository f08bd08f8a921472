//! What a remembered path is said to be, it is: by the judge, and by A*.

use pf_classic::AStar;
use pf_conformance::{grid::drawing, seeded};
use pf_core::{Context, PlanRng, Planner, Problem, Revision, Solved};
use pf_grid::{Bend, Cell, Grid, GridChange, GridProblem, Hold, LastPath, Moves, Weights, Word};
use rand::RngExt;

/// Some cells, each next to the path as often as not.
fn cells(rng: &mut PlanRng, problem: &GridProblem, path: &[Cell]) -> Vec<Cell> {
    let (width, height) = (problem.grid().width(), problem.grid().height());
    let count = rng.random_range(1..5);
    let cell = |_| {
        if rng.random() {
            let near = path[rng.random_range(0..path.len())];
            let mut off = |at: u32, size: u32| (at + rng.random_range(0..3)).clamp(1, size) - 1;
            return Cell::new(off(near.x, width), off(near.y, height));
        }
        Cell::new(rng.random_range(0..width), rng.random_range(0..height))
    };
    (0..count).map(cell).collect()
}

fn change(rng: &mut PlanRng, problem: &GridProblem, path: &[Cell]) -> GridChange {
    let along = path[rng.random_range(0..path.len().min(9))];
    let cells = cells(rng, problem, path);
    match rng.random_range(0..20) {
        0..9 => GridChange::StartMoved(along),
        9..15 => GridChange::Blocked(cells),
        15 => GridChange::StartMoved(cells[0]),
        16 | 17 => GridChange::Freed(cells),
        18 => GridChange::GoalMoved(path[path.len() - 1]),
        _ if rng.random() => GridChange::GoalMoved(cells[0]),
        _ => GridChange::CostChanged(cells, rng.random_range(1..4)),
    }
}

/// Joins what is left of a broken path at one end from where that is possible first on a shortest path that
/// comes from the other end: what is so found is as short. At a lower price it cannot be joined.
fn join(
    problem: &GridProblem,
    last: &mut LastPath,
    best: &Solved<GridProblem>,
    is_backward: bool,
) -> Option<Solved<GridProblem>> {
    let (grid, mut way) = (problem.grid(), Vec::new());
    let weights = Weights::of(grid);
    let mut left = weights.of_cost::<u64>(best.cost)?;
    let mut path = best.solution.clone();
    if is_backward {
        path.reverse();
    }
    for (at, &cell) in path.iter().enumerate() {
        let remnant = last.remnant::<u64>(problem, is_backward)?;
        for less in [u64::STRAIGHT, u64::DIAGONAL - u64::STRAIGHT] {
            let too_little = left.checked_sub(less);
            assert!(too_little.is_none_or(|left| remnant.join(cell, left, &mut way).is_none()));
        }
        if let Some(along) = remnant.join(cell, left, &mut way) {
            way.splice(..1, path[..=at].iter().copied());
            if is_backward {
                way.reverse();
            }
            let place = (is_backward, along);
            let cx = &mut Context::seeded(0);
            for part in [&way[1..], &way[..way.len() - 1]] {
                assert!(last.rejoin(problem, place, part, cx).is_none());
            }
            let report = last.rejoin(problem, place, &way, cx)?;
            assert!(last.remnant::<u64>(problem, is_backward).is_none());
            return report.outcome.solved().cloned();
        }
        let ids = [cell, *path.get(at + 1)?].map(|cell| grid.layout().id(cell));
        left -= weights.between::<u64>(grid, ids[0], ids[1]);
    }
    None
}

/// Follows a revision, bending far; says also whether the path holds if it bends near.
fn follow(last: &mut LastPath, revision: &Revision<'_, GridProblem>) -> (Hold, bool) {
    let mut near = last.clone();
    near.follow(revision, Bend::Near);
    let hold = last.follow(revision, Bend::Far);
    let near = near.left();
    if let Some(near) = &near {
        let cost = last.left().map_or(near.cost, |far| far.cost);
        assert_eq!(revision.problem().judge(&near.solution), Ok(cost));
    }
    (hold, near.is_some())
}

/// On open and on strewn maps, under all rules.
#[test]
fn a_path_is_kept_as_long_as_it_is_what_it_is_said_to_be_and_no_shorter() {
    let mut rng = seeded(71);
    let (mut best, mut legal, mut gone, mut broken, mut turned) = (0, 0, 0, 0, 0);
    let (mut nearer, mut farther) = (0, 0);
    let mut joined = [0, 0];
    for story in 0..6_000 {
        let (width, height) = (rng.random_range(5..90), rng.random_range(1..60));
        let (walls, dear) = (rng.random_range(0..30), rng.random_range(0..20));
        let map = Grid::new(width, height, |_| match rng.random_range(0..100) {
            n if n < walls => 0,
            n if story % 3 == 0 && n < walls + dear => rng.random_range(2..9),
            _ => 1,
        });
        let moves = Moves::ALL[story % 4];
        let ends = [Cell::new(0, 0), Cell::new(width - 1, height - 1)];
        let mut problem = GridProblem::new(map.unwrap(), ends[0], ends[1])
            .unwrap()
            .with_moves(moves);
        let mut last = LastPath::default();
        let mut astar = AStar::default();
        for step in 0..30 {
            let fresh = astar.plan(&problem, &mut Context::seeded(0)).unwrap();
            last.remember(&problem, &fresh);
            let Some(solved) = fresh.outcome.solved() else {
                break;
            };
            let mut path = solved.solution.clone();
            // The same path through several revisions.
            for _ in 0..4 {
                let changes: Vec<_> = (0..rng.random_range(1..3))
                    .map(|_| change(&mut rng, &problem, &path))
                    .collect();
                let revision = problem.revise(&changes).unwrap();
                let (hold, near) = follow(&mut last, &revision);
                farther += u32::from(!near && last.left().is_some());
                nearer += u32::from(near && last.left().is_none());
                let fresh = astar.plan(&problem, &mut Context::seeded(0)).unwrap();
                let optimum = fresh.outcome.solved().map(|solved| solved.cost);
                let what = || format!("story {story}, step {step}\n{}", drawing(&problem));
                let Some(left) = last.left() else {
                    gone += 1;
                    if hold == Hold::Broken {
                        let best = fresh.outcome.solved();
                        let is_backward = step % 2 == 0;
                        let join = |best| join(&problem, &mut last, best, is_backward);
                        if let Some(found) = best.and_then(join) {
                            assert_eq!(Some(found.cost), optimum, "{}", what());
                            assert_eq!(
                                problem.judge(&found.solution),
                                Ok(found.cost),
                                "{}",
                                what()
                            );
                            assert_eq!(last.left().unwrap().solution, found.solution, "{}", what());
                            joined[step % 2] += 1;
                        }
                    } else {
                        assert_eq!(hold, Hold::Gone, "{}", what());
                    }
                    let harmless = changes.iter().all(|change| {
                        matches!(change, GridChange::StartMoved(_) | GridChange::Blocked(_))
                    });
                    let at = path.iter().position(|&cell| cell == problem.start());
                    if let (true, Some(at)) = (harmless, at) {
                        let rest = path[at..].to_vec();
                        assert!(problem.judge(&rest).is_err(), "{}", what());
                        broken += 1;
                    }
                    break;
                };
                assert_eq!(problem.judge(&left.solution), Ok(left.cost), "{}", what());
                match hold {
                    Hold::Best => {
                        assert_eq!(Some(left.cost), optimum, "{}", what());
                        best += 1;
                    }
                    Hold::Legal => legal += 1,
                    Hold::Broken | Hold::Gone => panic!("{}", what()),
                }
                let at = path.iter().position(|&cell| cell == problem.start());
                turned += u32::from(path[at.unwrap()..] != left.solution);
                path = left.solution;
            }
        }
    }
    let [ahead, back] = joined;
    let counts = [best, legal, gone, broken, turned, farther, ahead, back];
    let least = [
        20_000,
        10_000,
        10_000,
        5_000,
        500,
        10 * nearer,
        1_000,
        1_000,
    ];
    let often = counts
        .iter()
        .zip(least)
        .all(|(&count, least)| count > least);
    assert!(often, "{counts:?}, {nearer}");
}

/// The dear cell on the path is blocked, which makes the map plain, and a cheaper way opens with it.
#[test]
fn a_path_over_dear_cells_does_not_bend() {
    let grid = Grid::parse(".5 #.").unwrap();
    let problem = GridProblem::new(grid, Cell::new(0, 0), Cell::new(1, 1));
    let mut problem = problem.unwrap().with_moves(Moves::Orthogonal);
    let mut last = LastPath::default();
    let fresh = AStar::default().plan(&problem, &mut Context::seeded(0));
    last.remember(&problem, &fresh.unwrap());
    let changes = [
        GridChange::Freed(vec![Cell::new(0, 1)]),
        GridChange::Blocked(vec![Cell::new(1, 0)]),
    ];
    assert_eq!(
        last.follow(&problem.revise(&changes).unwrap(), Bend::Far),
        Hold::Gone
    );
    assert!(last.left().is_none());
}
