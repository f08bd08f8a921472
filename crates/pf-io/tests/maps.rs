//! The maps and scenarios that come with the project.

use pf_core::Problem;
use pf_grid::{Cell, Grid, GridProblem, Moves};
use pf_io::{LoadOptions, Scenario, load_grid, read_scenario};
use std::{
    fs,
    path::{Path, PathBuf},
};

fn maps() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../maps")
}

fn scenario(name: &str) -> Scenario {
    read_scenario(&maps().join("scenarios").join(name)).expect("a sound scenario")
}

fn reachable(grid: &Grid, from: Cell, to: Cell) -> bool {
    let mut seen = vec![false; grid.layout().len()];
    let mut open = vec![from];
    while let Some(cell) = open.pop() {
        let id = grid.layout().id(cell) as usize;
        if !seen[id] {
            seen[id] = true;
            let steps = grid.neighbours(cell, Moves::default());
            open.extend(steps.map(|(next, _)| next));
        }
    }
    seen[grid.layout().id(to) as usize]
}

/// Whether a robot of that radius reaches the goal: at first, then after each event.
fn ways(name: &str) -> Vec<bool> {
    let scenario = scenario(name);
    let case = &scenario.cases[0];
    let mut problem = case.problem.clone();
    let way = |p: &GridProblem| reachable(&p.grid().inflated(case.radius), p.start(), p.goal());
    let mut ways = vec![way(&problem)];
    for event in &case.events {
        let before = problem.stamp();
        problem.apply(&event.changes).expect("sound changes");
        assert_ne!(problem.stamp(), before, "{:?} changes nothing", event.name);
        ways.push(way(&problem));
    }
    ways
}

#[test]
fn every_map_is_read() {
    let mut read = 0;
    for folder in ["grids", "grids/redlarski"] {
        for entry in fs::read_dir(maps().join(folder)).unwrap() {
            let path = entry.unwrap().path();
            if path.is_file() {
                load_grid(&path, &LoadOptions::default()).unwrap();
                read += 1;
            }
        }
    }
    assert_eq!(read, 11);
}

#[test]
fn the_moving_goal_can_always_be_reached() {
    assert_eq!(ways("moving-goal.toml"), [true; 6]);
}

#[test]
fn the_closing_doors_leave_no_way_for_a_while() {
    let ways = ways("closing-doors.toml");
    assert_eq!(ways, [true, true, true, true, false, true, true]);
}
