//! Maps of the Moving AI benchmark and the data behind `maps/`. They lie in `../shared`, beside the
//! workspace; where that is missing, these tests say so and pass.

use pf_core::Problem;
use pf_grid::{Cell, GridChange, GridCost};
use pf_io::{Scenario, read_movingai, read_scen, read_scenario};
use serde_json::Value;
use std::{
    fs,
    io::{self, Write},
    path::{Path, PathBuf},
};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn shared(what: &str) -> Option<PathBuf> {
    let path = root().join("../shared").join(what);
    if path.exists() {
        return Some(path);
    }
    // Straight to the screen: the harness hides what a passing test prints.
    writeln!(io::stderr(), "skipped: ../shared is missing").expect("a screen");
    None
}

#[test]
fn the_benchmark_is_read() {
    let Some(folder) = shared("data/movingai") else {
        return;
    };
    let mut maps = 0;
    let mut rows = 0;
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|e| e != "map") {
            continue;
        }
        let grid = read_movingai(&path).unwrap();
        let scen = read_scen(&path.with_added_extension("scen")).unwrap();
        scen.check_size(&grid).unwrap();
        for row in &scen.rows {
            assert!(
                grid.is_free(row.start) && grid.is_free(row.goal),
                "line {}",
                row.line
            );
            assert!(scen.agrees(row, row.optimum));
        }
        let passable = fs::read_to_string(&path).unwrap();
        let body = passable.split_once("map").unwrap().1;
        let free = body
            .chars()
            .filter(|c| matches!(c, '.' | 'G' | 'S'))
            .count();
        assert_eq!(grid.free_cells() as usize, free);
        maps += 1;
        rows += scen.rows.len();
    }
    assert_eq!((maps, rows > 10_000), (10, true), "{rows} rows");
}

fn redlarski() -> Scenario {
    read_scenario(&root().join("maps/scenarios/redlarski.toml")).expect("the cases")
}

fn cells(value: &Value) -> Vec<Cell> {
    let cell = |pair: &Value| Cell::new(number(&pair[0]), number(&pair[1]));
    value.as_array().expect("cells").iter().map(cell).collect()
}

fn number(value: &Value) -> u32 {
    value
        .as_u64()
        .and_then(|n| n.try_into().ok())
        .expect("a number")
}

#[test]
fn the_redlarski_cases_are_those_of_the_shared_data() {
    let Some(path) = shared("data/redlarski") else {
        return;
    };
    let text = fs::read_to_string(path.join("scenarios.json")).unwrap();
    let json: Value = serde_json::from_str(&text).unwrap();
    let scenario = redlarski();
    assert_eq!(scenario.provenance.as_deref(), json["provenance"].as_str());
    let published = json["cases"].as_array().unwrap();
    assert_eq!((scenario.cases.len(), published.len()), (45, 45));
    for (ours, theirs) in scenario.cases.iter().zip(published) {
        let map = theirs["map"].as_str().unwrap();
        assert_eq!(ours.name, format!("{map} table {}", theirs["table"]));
        let original = read_movingai(&path.join(format!("{map}.map"))).unwrap();
        assert!(*ours.map.grid == original, "{map}");

        let cell = |key: &str| cells(&Value::Array(vec![theirs[key].clone()]))[0];
        let mut problem = pf_grid::GridProblem::new(original, cell("start"), cell("goal"))
            .unwrap()
            .with_moves(pf_grid::Moves::Always);
        problem
            .apply(&[
                GridChange::Blocked(cells(&theirs["added"])),
                GridChange::Freed(cells(&theirs["removed"])),
            ])
            .unwrap();
        assert!(ours.problem.grid() == problem.grid(), "{}", ours.name);
        let query = |p: &pf_grid::GridProblem| (p.start(), p.goal(), p.moves());
        assert_eq!(query(&ours.problem), query(&problem), "{}", ours.name);

        let expected = ours.expected.as_ref().unwrap();
        let (a, b) = (number(&theirs["a"]), number(&theirs["b"]));
        assert_eq!(expected.cost, GridCost::of_steps(a.into(), b.into()));
        assert_eq!(expected.printed.as_deref(), theirs["paper_length"].as_str());
    }
}

#[test]
fn the_redlarski_digits_are_those_of_the_exact_lengths() {
    for case in redlarski().cases {
        let expected = case.expected.unwrap();
        let length = expected.cost.value();
        let printed = if case.name.ends_with('5') {
            let rounded = format!("{length:.2}");
            rounded
                .trim_end_matches('0')
                .trim_end_matches('.')
                .to_owned()
        } else {
            format!("{:.2}", (length * 100.0).floor() / 100.0)
        };
        assert_eq!(expected.printed, Some(printed), "{}", case.name);
    }
}
