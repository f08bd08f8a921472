//! Programs that answer, and programs that do wrong. They are written in Python, and skipped visibly where
//! there is none.
#![expect(clippy::unwrap_used, reason = "a test that stumbles has failed")]

use pf_core::{Budget, CancelToken, Context, Outcome, Planner, Report, Stop};
use pf_external::{External, ExternalParams, FAULT, Fault, Introduction, Wire};
use pf_geom::{Circle, Point, Rectangle, World, WorldProblem};
use pf_grid::{Cell, Grid, GridProblem};
use std::{process::Command, thread, time::Duration};

#[expect(clippy::print_stdout, reason = "what is skipped is said")]
fn python() -> bool {
    let there = Command::new("python3").arg("--version").output().is_ok();
    if !there {
        println!("skipped: python3 is missing");
    }
    there
}

fn grid() -> GridProblem {
    let grid = Grid::parse(".@. ... .@.").unwrap();
    GridProblem::new(grid, Cell::new(0, 0), Cell::new(2, 0)).unwrap()
}

fn world() -> WorldProblem {
    let bounds = Rectangle::new(Point::origin(), Point::new(10.0, 10.0)).unwrap();
    let disc = Circle::new(Point::new(5.0, 5.0), 2.0).unwrap();
    let world = World::with_shapes(bounds, [disc.into()]);
    WorldProblem::new(world, 0.5, Point::new(1.0, 5.0), Point::new(9.0, 5.0)).unwrap()
}

/// A program that says hello and then does this to each question `q`.
fn program(problem: &str, body: &str) -> String {
    let hello = format!("print(json.dumps(dict(name='Py', problem='{problem}')), flush=True)");
    let code = format!(
        "import json, sys, time\ninput()\n{hello}\nfor line in sys.stdin:\n q = json.loads(line)\n {body}\n"
    );
    format!("python3 -c {}", shell_words::quote(&code))
}

fn answering(problem: &str, reply: &str) -> String {
    program(problem, &format!("print(json.dumps({reply}), flush=True)"))
}

fn asked<P: Wire>(command: &str, problem: &P) -> Report<P> {
    let params = ExternalParams { limit: 5.0 };
    let mut planner = External::<P>::start(command, &params).unwrap();
    planner.plan(problem, &mut Context::seeded(1)).unwrap()
}

/// What is said of a program that does this.
fn fault<P: Wire>(command: &str, problem: &P) -> String {
    let report = asked(command, problem);
    assert!(matches!(report.outcome, Outcome::Unknown { .. }));
    report.note(FAULT).unwrap().to_owned()
}

const AROUND: &str = "[[0,0],[0,1],[1,1],[2,1],[2,0]]";

#[test]
fn a_program_is_marked_like_any_planner() {
    if !python() {
        return;
    }
    let say = |rest: &str| answering("grid", &format!("dict(id=q['id'], {rest})"));
    let report = asked(
        &say(&format!(
            "outcome='feasible', path={AROUND}, cost=4, expanded=7, notes=['hm']"
        )),
        &grid(),
    );
    let Outcome::Feasible(best) = &report.outcome else {
        panic!("{report:?}")
    };
    assert!((best.cost.value() - 4.0).abs() < 1e-12);
    assert_eq!(
        (report.stats.expanded, report.note("says")),
        (7, Some("hm"))
    );
    let report = asked(&say(&format!("outcome='optimal', path={AROUND}")), &grid());
    assert!(matches!(report.outcome, Outcome::Optimal(_)));
    assert!(matches!(
        asked(&say("outcome='infeasible'"), &grid()).outcome,
        Outcome::Infeasible
    ));
    let over = "dict(id=q['id'], outcome='feasible', path=[q['start'], [5, 9], q['goal']])";
    assert!(
        asked(&answering("world", over), &world())
            .outcome
            .solved()
            .is_some()
    );
}

#[test]
fn what_a_program_does_wrong_is_said_and_not_suffered() {
    if !python() {
        return;
    }
    let say = |rest: &str| answering("grid", &format!("dict(id=q['id'], {rest})"));
    for (does, said) in [
        (
            program("grid", "sys.exit('no more memory')"),
            "crashed: exit status: 1; it said: no more memory",
        ),
        (
            program("grid", "raise ValueError(q['width'])"),
            "ValueError: 3",
        ),
        (
            program("grid", "__import__('os').close(1); time.sleep(60)"),
            "crashed: it closed its output",
        ),
        (
            program("grid", "print('Segmentation fault', flush=True)"),
            "printed `Segmentation fault`, expected",
        ),
        (
            program("grid", "print('[' * 100000, flush=True)"),
            "…`, expected",
        ),
        (
            answering("grid", "dict(outcome='feasible')"),
            "missing field `id`",
        ),
        (
            answering("grid", "dict(id=99, outcome='unknown')"),
            "expected the question's, 1",
        ),
        (say("outcome='perfect'"), "unknown variant `perfect`"),
        (say("outcome='unknown', lenght=4"), "unknown field `lenght`"),
        (say("outcome='feasible'"), "there is no `path`"),
        (say("outcome='feasible', path=[]"), "its path is none"),
        (
            say("outcome='optimal', path=[[0,0],[1,0],[2,0]]"),
            "its path is none: ",
        ),
        (
            say("outcome='optimal', path=[[0,0],[0.5,1],[2,0]]"),
            "not columns and rows",
        ),
        (
            say("outcome='optimal', path=[[0,0],[-1,1],[2,0]]"),
            "not columns and rows",
        ),
        (
            say(&format!("outcome='optimal', path={AROUND}, cost=3.9")),
            "costs 3.9, and it costs 4",
        ),
        (
            say(&format!("outcome='optimal', path={AROUND}, cost=-4")),
            "costs -4, and it costs 4",
        ),
    ] {
        let fault = fault(&does, &grid());
        assert!(fault.starts_with("Py "), "{fault}");
        assert!(fault.contains(said), "{said}: {fault}");
    }
    let through = "dict(id=q['id'], outcome='optimal', path=[q['start'], q['goal']])";
    assert!(fault(&answering("world", through), &world()).contains("its path is none"));
}

#[test]
fn one_that_hangs_is_stopped_and_the_next_question_starts_it_anew() {
    if !python() {
        return;
    }
    let params = ExternalParams { limit: 1.0 };
    let body = "print(json.dumps(dict(id=q['id'], outcome='infeasible')), flush=True) if q['id'] != 1 else time.sleep(60)";
    let mut planner = External::<GridProblem>::start(&program("grid", body), &params).unwrap();
    let report = planner.plan(&grid(), &mut Context::seeded(1)).unwrap();
    assert_eq!(
        report.note(FAULT),
        Some("Py gave no answer within 1 s, and was stopped")
    );
    for _ in 0..2 {
        let report = planner.plan(&grid(), &mut Context::seeded(1)).unwrap();
        assert!(matches!(report.outcome, Outcome::Infeasible));
    }
}

#[test]
fn a_budget_ends_a_question_and_is_no_fault() {
    if !python() {
        return;
    }
    let sleeper = program("grid", "time.sleep(60)");
    let mut planner = External::<GridProblem>::start(&sleeper, &ExternalParams::default()).unwrap();
    let budget = Budget::unlimited().time(Duration::from_millis(100));
    let report = planner
        .plan(&grid(), &mut Context::seeded(1).within(budget))
        .unwrap();
    assert_eq!((report.stop, report.note(FAULT)), (Stop::Time, None));
    let token = CancelToken::default();
    let canceller = token.clone();
    let waits = thread::spawn(move || {
        thread::sleep(Duration::from_millis(100));
        canceller.cancel();
    });
    let budget = Budget::unlimited().cancel(&token);
    let report = planner
        .plan(&grid(), &mut Context::seeded(1).within(budget))
        .unwrap();
    waits.join().unwrap();
    assert_eq!((report.stop, report.note(FAULT)), (Stop::Cancelled, None));
}

#[test]
fn one_that_never_reads_stops_nobody() {
    if !python() {
        return;
    }
    // More than a pipe holds.
    let problem = GridProblem::new(
        Grid::open(600, 600).unwrap(),
        Cell::new(0, 0),
        Cell::new(9, 9),
    )
    .unwrap();
    let code = "import time; print('{\"name\": \"Py\", \"problem\": \"grid\"}', flush=True); time.sleep(60)";
    let command = format!("python3 -c {}", shell_words::quote(code));
    let mut planner = External::start(&command, &ExternalParams { limit: 1.0 }).unwrap();
    let report = planner.plan(&problem, &mut Context::seeded(1)).unwrap();
    assert!(report.note(FAULT).unwrap().contains("within 1 s"));
}

#[test]
fn who_does_not_say_who_it_is_does_not_take_part() {
    let failed = |command: &str| Introduction::of(command).unwrap_err();
    assert!(matches!(
        failed("/no/such/program"),
        Fault::NotStarted { .. }
    ));
    assert!(matches!(failed(""), Fault::NotStarted { .. }));
    assert!(matches!(failed("a 'b"), Fault::NotStarted { .. }));
    if !python() {
        return;
    }
    assert!(matches!(failed("python3 -c 1"), Fault::Crashed { .. }));
    assert!(matches!(
        failed("python3 -c \"print('hello')\""),
        Fault::Garbage { .. }
    ));
    let on_world = answering("world", "1");
    assert_eq!(Introduction::of(&on_world).unwrap().problem, "world");
    let wrong = External::<GridProblem>::start(&on_world, &ExternalParams::default());
    assert!(matches!(wrong, Err(Fault::Garbage { .. })));
    let params = ExternalParams { limit: -1.0 };
    assert!(External::<WorldProblem>::start(&on_world, &params).is_err());
}
