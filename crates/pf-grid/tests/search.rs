//! A search that goes on where it stopped.

use pf_core::{Budget, Context};
use pf_grid::{Cell, End, Grid, GridProblem, Search, Weights, Word};

/// However often it is cut short on the way.
#[test]
fn a_search_that_goes_on_knows_what_one_without_end_does() {
    let free = |cell: Cell| !(cell.x * 7 + cell.y * 11 + cell.x * cell.y).is_multiple_of(4);
    let grid = Grid::new(60, 40, |cell| u8::from(free(cell))).unwrap();
    let problem = GridProblem::new(grid, Cell::new(30, 20), Cell::new(40, 26)).unwrap();
    let (grid, goal) = (problem.grid(), problem.goal());
    let layout = grid.layout();
    let octile = |cell| Weights::of(grid).octile::<u32>(grid, problem.moves(), cell);
    let (to_goal, to_start) = (octile(goal), octile(problem.start()));
    let mut all = Search::default();
    all.run(
        &problem,
        problem.start(),
        None,
        |_| 0,
        &mut Context::seeded(0),
    );
    let mut search = Search::default();
    let (heuristic, arrive) = (
        |id| Some(to_goal(id)),
        |id, _| (id == layout.id(goal)).then_some(0),
    );
    let start = problem.start();
    let end = search.run_keeping(&problem, start, heuristic, arrive, &mut Context::seeded(0));
    let End::Goal(whole) = end else {
        panic!("{end:?}")
    };
    let mut known = whole;
    for cut in 0..60 {
        let mut exact = 0;
        for id in layout.cells().map(|cell| layout.id(cell)) {
            let left = all.weight(id).unwrap_or(u32::MAX);
            let (least, is_exact) = search.estimate(id, known, to_start(id), to_goal(id));
            assert!(
                least <= left && (!is_exact || least == left),
                "{cut}: {}",
                layout.cell(id)
            );
            let is_near = left < u32::LIMIT && left + to_goal(id) < known;
            assert!(is_exact || !is_near, "{cut}: {}", layout.cell(id));
            exact += u32::from(is_exact);
        }
        assert!(cut < 59 || exact > 1000, "{exact}");
        let budget = Budget::unlimited().iterations(if cut < 58 { cut } else { 10_000 });
        let mut cx = Context::seeded(0).within(budget);
        let until = whole + 60 * u32::STRAIGHT;
        known = search.go_on(&problem, (known, until), heuristic, &mut cx);
    }
    assert_eq!(known, whole + 60 * u32::STRAIGHT);
}
