//! One seed, one trace: what each planner looks at, in which order, and what it answers.

use pf_classic::{AStar, Dijkstra};
use pf_core::{Context, Event, Planner};
use pf_grid::{Cell, Grid, GridProblem, Moves};
use pf_tests::golden;
use std::fmt::Write as _;

/// A room with a trap in it, and a swamp before the door.
const MAP: &str = "
    ............
    .....####...
    ........#...
    ..222...#...
    ..222...#...
    .....####...
    ............
";

fn problem(moves: Moves) -> GridProblem {
    let grid = Grid::parse(MAP).expect("a map");
    let problem = GridProblem::new(grid, Cell::new(0, 3), Cell::new(11, 3));
    problem.expect("cells of the map").with_moves(moves)
}

/// Everything a planner shows of one search, one event a line.
fn trace(planner: &mut dyn Planner<GridProblem>, moves: Moves) -> String {
    let mut text = format!("{}, {moves}\n{}\n\n", planner.name(), MAP.trim_end());
    let mut listen = |event: &Event<'_, GridProblem>| {
        let line = match event {
            Event::Expanded(cell) => format!("expanded {cell}"),
            Event::Improved(best) => format!("improved {}", best.cost),
            other => format!("{other:?}"),
        };
        writeln!(text, "{line}").expect("a string takes text");
    };
    let mut cx = Context::seeded(7).traced(&mut listen);
    let report = planner.plan(&problem(moves), &mut cx).expect("supported");
    write!(
        text,
        "{} in {} iterations:",
        report.outcome.word(),
        report.stats.iterations
    )
    .expect("a string takes text");
    for cell in report
        .outcome
        .solved()
        .map_or(&[][..], |best| &best.solution)
    {
        write!(text, " {cell}").expect("a string takes text");
    }
    text + "\n"
}

#[test]
fn golden_trace_of_a_star() {
    golden::check("a-star", &trace(&mut AStar::default(), Moves::default()));
    golden::check(
        "a-star-always",
        &trace(&mut AStar::default(), Moves::Always),
    );
}

#[test]
fn golden_trace_of_dijkstra() {
    golden::check(
        "dijkstra",
        &trace(&mut Dijkstra::default(), Moves::default()),
    );
}
