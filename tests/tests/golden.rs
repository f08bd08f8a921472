//! One seed, one trace: what each planner looks at, in which order, and what it answers.

use pf_abc::{Abc, AbcParams};
use pf_aco::{Aco, AcoParams, AcoStar, AcoStarParams};
use pf_classic::{AStar, DStarLite, Dijkstra, Jps, Prepared};
use pf_core::{Context, Event, Planner, Problem, Replanner, Report};
use pf_geom::{Point, Rectangle, World, WorldProblem};
use pf_grid::{Cell, Grid, GridChange, GridProblem, Moves};
use pf_lbfgs::{Lbfgs, LbfgsParams};
use pf_pso::{Pso, PsoParams};
use pf_rfd::{Rfd, RfdExact, RfdField, RfdParams, RfdStar, RfdStarParams};
use pf_tests::golden;
use std::fmt::{self, Write as _};

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

/// Everything a planner shows while `ask` asks it, one event a line.
fn events(
    ask: impl FnOnce(&mut Context<'_, GridProblem>) -> Report<GridProblem>,
) -> Result<String, fmt::Error> {
    let mut lines = Vec::new();
    let mut listen = |event: &Event<'_, GridProblem>| {
        lines.push(match event {
            Event::Expanded(cell) => format!("expanded {cell}"),
            Event::Improved(best) => format!("improved {}", best.cost),
            Event::Candidate(path) => format!("candidate {}", cells(path)),
            Event::Field { name, value } => {
                let goal = Cell::new(10, 3);
                format!("{name} {:.9} at {goal}", value(&goal))
            }
            other => format!("{other:?}"),
        });
    };
    let report = ask(&mut Context::seeded(7).traced(&mut listen));
    let (word, n) = (report.outcome.word(), report.stats.iterations);
    let mut text = lines.join("\n");
    let solved = report.outcome.solved();
    let path = cells(solved.map_or(&[][..], |best| &best.solution));
    writeln!(text, "\n{word} in {n} iterations: {path}")?;
    Ok(text)
}

fn cells(path: &[Cell]) -> String {
    let cells: Vec<_> = path.iter().map(Cell::to_string).collect();
    cells.join(" ")
}

/// What a planner shows of a plan.
fn trace(planner: &mut dyn Planner<GridProblem>, moves: Moves) -> String {
    let head = format!("{}, {moves}\n{}\n\n", planner.name(), MAP.trim_end());
    let plan = |cx: &mut Context<'_, _>| planner.plan(&problem(moves), cx).expect("supported");
    head + &events(plan).expect("a string takes text")
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

/// The same room without the swamp: jump points need cells that all cost the same.
fn trace_without_swamp(planner: &mut dyn Planner<GridProblem>, moves: Moves) -> String {
    let map = MAP.replace('2', ".");
    let grid = Grid::parse(&map).expect("a map");
    let problem = GridProblem::new(grid, Cell::new(0, 3), Cell::new(11, 3));
    let problem = problem.expect("cells of the map").with_moves(moves);
    let head = format!("{}, {moves}\n{}\n\n", planner.name(), map.trim_end());
    let plan = |cx: &mut Context<'_, _>| planner.plan(&problem, cx).expect("supported");
    head + &events(plan).expect("a string takes text")
}

#[test]
fn golden_traces_of_jump_points() {
    for moves in [Moves::default(), Moves::Always] {
        let name = format!("jps-{}", moves.to_string().replace(' ', "-"));
        golden::check(&name, &trace_without_swamp(&mut Jps::default(), moves));
        let name = name.replace("jps", "jps-plus");
        golden::check(&name, &trace_without_swamp(&mut Prepared::default(), moves));
    }
}

#[test]
fn golden_trace_of_d_star_lite() {
    let mut planner = DStarLite::default();
    let mut text = trace(&mut planner, Moves::default());
    let changes = [
        GridChange::StartMoved(Cell::new(2, 5)),
        GridChange::Blocked(vec![Cell::new(9, 4), Cell::new(9, 5), Cell::new(9, 6)]),
    ];
    text += &trace_after(&mut planner, &changes, false);
    golden::check("d-star-lite", &text);
}

#[test]
fn golden_trace_of_the_altitude_field() {
    let mut planner = RfdField::default();
    let mut text = trace(&mut planner, Moves::default());
    for changes in [
        GridChange::Blocked(vec![Cell::new(5, 0), Cell::new(9, 0), Cell::new(9, 1)]),
        GridChange::Freed(vec![Cell::new(8, 3)]),
    ] {
        text += &trace_after(&mut planner, &[changes], true);
    }
    golden::check("rfd-field", &text);
}

/// What a planner shows of a replan after a plan, and after upkeep if asked for.
fn trace_after(
    planner: &mut dyn Replanner<GridProblem>,
    changes: &[GridChange],
    settle: bool,
) -> String {
    let mut problem = problem(Moves::default());
    let plan = planner.plan(&problem, &mut Context::seeded(7));
    plan.expect("supported");
    if settle {
        planner.settle(&problem, &mut Context::seeded(7));
    }
    let revision = problem.revise(changes).expect("they make sense");
    let replan = |cx: &mut Context<'_, _>| planner.replan(&revision, cx).expect("supported");
    let events = events(replan).expect("a string takes text");
    format!("\nafter {changes:?}\n\n{events}")
}

#[test]
fn golden_trace_of_the_exact_river() {
    golden::check(
        "rfd-exact",
        &trace(&mut RfdExact::default(), Moves::default()),
    );
}

#[test]
fn golden_traces_of_rivers() {
    let params = RfdParams {
        drops: 4,
        iterations: 5,
        climb: 0.5,
        ..RfdParams::default()
    };
    let mut rfd = Rfd::new(params).expect("sound parameters");
    golden::check("rfd", &trace(&mut rfd, Moves::default()));
    for (name, params) in [
        ("rfd-star-paper", RfdStarParams::paper()),
        ("rfd-star-authors-code", RfdStarParams::authors_code()),
        ("rfd-star-seeded", RfdStarParams::seeded()),
    ] {
        let params = RfdStarParams {
            drops: 4,
            iterations: 5,
            ..params
        };
        let mut star = RfdStar::new(params).expect("sound parameters");
        golden::check(name, &trace(&mut star, Moves::default()));
    }
}

#[test]
fn golden_traces_of_ants() {
    let params = AcoParams {
        ants: 4,
        iterations: 5,
        ..AcoParams::default()
    };
    let mut aco = Aco::new(params).expect("sound parameters");
    golden::check("aco", &trace(&mut aco, Moves::default()));
    let params = AcoStarParams {
        ants: 4,
        iterations: 5,
        tabu: true,
        limits: true,
        ..AcoStarParams::default()
    };
    let mut star = AcoStar::new(params).expect("sound parameters");
    golden::check("aco-star", &trace(&mut star, Moves::default()));
}

/// A pocket with the robot before it and the goal behind it.
fn pocket() -> WorldProblem {
    let point = |(x, y): (f64, f64)| Point::new(x, y);
    let block = |a, b| Rectangle::new(point(a), point(b)).expect("a rectangle");
    let walls = [
        block((6.0, 3.0), (9.0, 4.0)),
        block((6.0, 8.0), (9.0, 9.0)),
        block((9.0, 3.0), (10.0, 9.0)),
    ];
    let world = World::with_shapes(block((0.0, 0.0), (14.0, 12.0)), walls.map(Into::into));
    let problem = WorldProblem::new(world, 0.2, point((2.0, 6.0)), point((12.0, 6.0)));
    problem.expect("points of the world")
}

/// Every step, sample and iterate a planner shows in the pocket, and what it answers.
fn pocket_trace(name: &str, planner: &mut dyn Planner<WorldProblem>) -> String {
    let at = |p: &Point| format!("{:.9},{:.9}", p.x, p.y);
    let all = |places: &[Point]| places.iter().map(at).collect::<Vec<_>>().join(" ");
    let mut lines = vec![name.to_owned(), String::new()];
    let mut listen = |event: &Event<'_, WorldProblem>| match event {
        Event::Expanded(place) => lines.push(format!("step to {}", at(place))),
        Event::Points { name, at } => lines.push(format!("{name} {}", all(at))),
        Event::Candidate(path) => lines.push(format!("candidate {}", all(path))),
        Event::Improved(best) => lines.push(format!("improved {:.9}", best.cost)),
        _ => {}
    };
    let mut cx = Context::seeded(7).traced(&mut listen);
    let report = planner.plan(&pocket(), &mut cx).expect("supported");
    lines.push(format!(
        "{} in {} iterations, {} evaluated",
        report.outcome.word(),
        report.stats.iterations,
        report.stats.evaluated
    ));
    lines.join("\n") + "\n"
}

#[test]
fn golden_traces_of_bees() {
    for (name, params) in [
        ("abc", AbcParams::default()),
        ("abc-paper", AbcParams::paper()),
    ] {
        let params = AbcParams {
            sources: 4,
            cycles: 2,
            steps: 120,
            w2: 0.1,
            ..params
        };
        let mut planner = Abc::new(params).expect("sound parameters");
        golden::check(name, &pocket_trace(name, &mut planner));
    }
}

#[test]
fn golden_traces_of_the_swarm() {
    for (name, params) in [
        ("pso", PsoParams::default()),
        ("pso-paper", PsoParams::paper()),
    ] {
        let params = PsoParams {
            particles: 5,
            waypoints: 2,
            iterations: 12,
            ..params
        };
        let mut planner = Pso::new(params).expect("sound parameters");
        golden::check(name, &pocket_trace(name, &mut planner));
    }
}

#[test]
fn golden_traces_of_descent() {
    for (name, params) in [
        ("lbfgs", LbfgsParams::default()),
        ("lbfgs-paper", LbfgsParams::paper()),
        ("lbfgs-published-code", LbfgsParams::published_code()),
    ] {
        let params = LbfgsParams {
            points: 8,
            ..params
        };
        let mut planner = Lbfgs::new(params).expect("sound parameters");
        golden::check(name, &pocket_trace(name, &mut planner));
    }
}
