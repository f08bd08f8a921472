//! What the ants do, whoever counts the threads; and what is refused.
#![expect(clippy::unwrap_used, reason = "a test that stumbles has failed")]

use pf_aco::{Aco, AcoParams, AcoStar, AcoStarParams};
use pf_core::{Context, Event, Planner, Problem, Replanner};
use pf_grid::{Cell, Grid, GridChange, GridProblem, Moves};
use std::fmt::Write;

fn problem() -> GridProblem {
    let grid = Grid::parse(
        "
        ............
        .....@@@@...
        ........@...
        ..222...@...
        .....@@@@...
        ............
        ",
    );
    let problem = GridProblem::new(grid.unwrap(), Cell::new(0, 2), Cell::new(11, 2));
    problem.unwrap().with_moves(Moves::Always)
}

/// Every event of a plan and of a replan.
fn trace(planner: &mut dyn Replanner<GridProblem>) -> String {
    let mut text = String::new();
    let mut listen = |event: &Event<'_, GridProblem>| {
        writeln!(text, "{event:?}").unwrap();
        if let Event::Field { value, .. } = event {
            for cell in problem().grid().layout().cells() {
                write!(text, "{:?} ", value(&cell)).unwrap();
            }
        }
    };
    let mut problem = problem();
    planner
        .plan(&problem, &mut Context::seeded(3).traced(&mut listen))
        .unwrap();
    let changes = [
        GridChange::Freed(vec![Cell::new(8, 2)]),
        GridChange::GoalMoved(Cell::new(11, 0)),
    ];
    let revision = problem.revise(&changes).unwrap();
    planner
        .replan(&revision, &mut Context::seeded(4).traced(&mut listen))
        .unwrap();
    text
}

#[test]
fn threads_change_nothing() {
    let star = |threads, tabu| {
        let params = AcoStarParams {
            threads,
            tabu,
            iterations: 10,
            ..AcoStarParams::default()
        };
        trace(&mut AcoStar::new(params).unwrap())
    };
    for tabu in [false, true] {
        let one = star(1, tabu);
        assert!(one.lines().count() > 500);
        for threads in [2, 3, 50, 200] {
            assert!(star(threads, tabu) == one, "{threads} threads");
        }
    }
}

/// What draws an ant to the goal holds it before a wall, unless it may not step where it has been.
#[test]
fn a_tabu_list_leads_out_of_a_trap() {
    let wall = |cell: Cell| cell.x == 12 && (4..16).contains(&cell.y);
    let grid = Grid::new(20, 20, |cell| u8::from(!wall(cell))).unwrap();
    let trap = GridProblem::new(grid, Cell::new(2, 10), Cell::new(17, 10)).unwrap();
    let steps = |tabu| {
        let params = AcoStarParams {
            tabu,
            iterations: 5,
            ..AcoStarParams::default()
        };
        let mut ants = AcoStar::new(params).unwrap();
        let report = ants.plan(&trap, &mut Context::seeded(1)).unwrap();
        assert!(report.outcome.solved().is_some());
        report.stats.expanded
    };
    let (with, without) = (steps(true), steps(false));
    assert!(2 * with < without, "{with} {without}");
}

#[test]
fn bad_parameters_are_refused_with_name_value_and_range() {
    let aco = |params: AcoParams| Aco::new(params).map(|_| ()).unwrap_err().to_string();
    let fine = AcoParams::default;
    assert_eq!(
        aco(AcoParams { ants: 0, ..fine() }),
        "parameter `ants`: `0` is not a whole number from 1 to 65536"
    );
    assert_eq!(
        aco(AcoParams { rho: 1.1, ..fine() }),
        "parameter `rho`: `1.1` is not a number from 0 to 1"
    );
    let zero = AcoParams { q: 0.0, ..fine() };
    assert_eq!(aco(zero), "parameter `q`: `0` is not a positive number");
    let nan = AcoParams {
        tau0: f64::NAN,
        ..fine()
    };
    assert!(aco(nan).contains("`tau0`: `NaN`"));
    let params = AcoStarParams {
        alpha: -1.0,
        ..AcoStarParams::default()
    };
    let error = AcoStar::new(params).map(|_| ()).unwrap_err().to_string();
    assert_eq!(
        error,
        "parameter `alpha`: `-1` is not a number from 0 to 64"
    );
}
