//! What planners take of memory, counted by the allocator.
#![expect(clippy::unwrap_used, reason = "a test that stumbles has failed")]

use allocation_counter::measure;
use pf_classic::{AStar, Auto, DStarLite, Dijkstra, Jps, Prepared};
use pf_core::{Context, PlanRng, Planner, Problem, Replanner, Stop};
use pf_grid::{Cell, Grid, GridChange, GridProblem};
use rand::{RngExt, SeedableRng};
use std::sync::Arc;

/// Long enough for searches to need more than 32 bits on the serpentine, as they do at 4096 x 4096.
const SIDE: u32 = 1024;

fn open() -> GridProblem {
    let last = Cell::new(SIDE - 1, SIDE - 1);
    GridProblem::new(Grid::open(SIDE, SIDE).unwrap(), Cell::new(0, 0), last).unwrap()
}

/// Every other row is a wall with a gap at alternating ends.
fn serpentine() -> GridProblem {
    let grid = Grid::new(SIDE, SIDE, |cell| {
        let gap = if cell.y % 4 == 1 { SIDE - 1 } else { 0 };
        u8::from(cell.y % 2 == 0 || cell.x == gap)
    });
    let last = Cell::new(SIDE - 1, SIDE - 2);
    GridProblem::new(grid.unwrap(), Cell::new(0, 0), last).unwrap()
}

/// The peak of what planning takes, open list and path included, in bytes a cell.
#[track_caller]
#[expect(clippy::cast_precision_loss, reason = "far below 2^53")]
fn bytes_per_cell(planner: &mut dyn Planner<GridProblem>, problem: &GridProblem) -> f64 {
    let mut length = None;
    let taken = measure(|| {
        let report = planner.plan(problem, &mut Context::seeded(0)).unwrap();
        length = report.outcome.solved().map(|best| best.solution.len());
    });
    // The path is the answer, not the planner's memory.
    let path = length.unwrap() * size_of::<Cell>();
    (taken.bytes_max as f64 - path as f64) / f64::from(SIDE * SIDE)
}

#[test]
fn searches_take_less_than_12_bytes_a_cell_and_d_star_lite_less_than_18_and_36() {
    // The serpentine's path is half its cells long, and needs more than 32 bits.
    for (problem, dstar) in [(open(), 18.0), (serpentine(), 36.0)] {
        // The grid itself takes nine bits a cell, and is not counted.
        assert!(bytes_per_cell(&mut AStar::default(), &problem) < 12.0);
        assert!(bytes_per_cell(&mut Dijkstra::default(), &problem) < 12.0);
        assert!(bytes_per_cell(&mut DStarLite::default(), &problem) < dstar);
    }
}

/// Single cells, one in five, at random: nearly every cell is a jump point.
fn strewn() -> GridProblem {
    let mut rng = PlanRng::seed_from_u64(5);
    let grid = Grid::new(SIDE, SIDE, |_| u8::from(rng.random_range(0..5) > 0));
    let problem = open();
    let ends = [problem.start(), problem.goal()];
    GridProblem::new(grid.unwrap(), ends[0], ends[1]).unwrap()
}

#[test]
fn jump_points_take_less_than_a_byte_a_cell_where_they_are_few_and_their_table_17() {
    for (problem, jumps) in [(open(), 1.0), (serpentine(), 1.0), (strewn(), 10.0)] {
        let jps = bytes_per_cell(&mut Jps::default(), &problem);
        assert!(jps < jumps, "{jps}");
        let prepared = bytes_per_cell(&mut Prepared::default(), &problem);
        assert!(prepared < 17.0, "{prepared}");
    }
}

#[test]
fn after_the_first_call_only_the_path_is_allocated() {
    let problem = serpentine();
    let short = GridProblem::new(problem.shared_grid(), Cell::new(9, 0), Cell::new(9, 8)).unwrap();
    // One that chooses says what it chose, in a list.
    let planners: [(&mut dyn Planner<GridProblem>, u64); 6] = [
        (&mut AStar::default(), 1),
        (&mut Dijkstra::default(), 1),
        (&mut DStarLite::default(), 1),
        (&mut Jps::default(), 1),
        (&mut Prepared::default(), 1),
        (&mut Auto::default(), 2),
    ];
    for (planner, allowed) in planners {
        for problem in [&problem, &short] {
            planner.plan(problem, &mut Context::seeded(0)).unwrap();
        }
        for problem in [&short, &problem] {
            let mut cx = Context::seeded(0);
            let taken = measure(|| drop(planner.plan(problem, &mut cx).unwrap()));
            assert_eq!(taken.count_total, allowed, "{}", planner.name());
        }
    }
}

#[test]
fn a_small_repair_allocates_little() {
    let mut problem = open();
    let mut planner = DStarLite::default();
    planner.plan(&problem, &mut Context::seeded(0)).unwrap();
    let mut taken = 0;
    for x in 0..50 {
        let wall = (0..5).map(|y| Cell::new(20 + x, 20 + x + y)).collect();
        let changes = [GridChange::Blocked(wall)];
        let revision = problem.revise(&changes).unwrap();
        let mut cx = Context::seeded(0);
        let counted = measure(|| drop(planner.replan(&revision, &mut cx).unwrap()));
        taken = counted.count_total;
    }
    // The path, and the note that it was repaired.
    assert!(taken <= 3, "{taken} allocations");
}

/// A revision costs what changed, not what there is: nothing of the map is copied.
#[test]
fn a_revision_allocates_nothing() {
    let mut problem = open();
    let changes = [
        GridChange::Blocked(vec![Cell::new(5, 5), Cell::new(6, 5)]),
        GridChange::StartMoved(Cell::new(1, 1)),
    ];
    let taken = measure(|| {
        let revision = problem.revise(&changes);
        assert!(revision.is_ok());
    });
    assert_eq!(taken.count_total, 0);
    // Only a clone that is still looked at makes a copy, once.
    let keep = problem.clone();
    let changes = [GridChange::Freed(vec![Cell::new(5, 5)])];
    let taken = measure(|| assert!(problem.revise(&changes).is_ok()));
    assert!(taken.count_total > 0 && !Arc::ptr_eq(&keep.shared_grid(), &problem.shared_grid()));
}

#[test]
fn a_cancelled_search_stops_at_once() {
    let token = pf_core::CancelToken::default();
    token.cancel();
    let budget = pf_core::Budget::unlimited().cancel(&token);
    let mut cx = Context::seeded(0).within(budget);
    let report = AStar::default().plan(&open(), &mut cx).unwrap();
    assert_eq!((report.stop, report.stats.expanded), (Stop::Cancelled, 0));
}
