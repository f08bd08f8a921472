//! Planners on maps they were not made for.

use crate::{
    map,
    worlds::{ROOMS, complete_in, has_note, list, number, one, plan, planners_in, world},
};
use serde_json::json;

/// The rooms without their door.
fn parted() -> String {
    ROOMS.replace("7.4", "6")
}

#[test]
fn planners_on_grids_find_it_over_cells_and_prove_nothing() {
    let folder = world(ROOMS);
    let file = folder.name("w.toml");
    let shortest = number(&one(&plan(&file, &[]).ends(0)), "length");
    for (planner, _) in complete_in("grid") {
        let object = one(&plan(&file, &["--planner", &planner]).ends(0));
        assert_eq!(object["outcome"], "feasible", "{planner}");
        assert_eq!(object["problem"], "world");
        has_note(&object, "converted: ", "cells of 0.2");
        has_note(
            &object,
            "unproved: ",
            "not proved to be the best of the map",
        );
        let length = number(&object, "length");
        assert!(
            length > shortest - 1e-3 && length < 1.15 * shortest,
            "{length}"
        );
        assert!(number(&object, "clearance") > 0.5 - 1e-6);
    }
}

#[test]
fn cell_says_how_fine_a_world_is_cut() {
    let folder = world(ROOMS);
    let file = folder.name("w.toml");
    let ask = |cell| plan(&file, &["--planner", "astar", "--cell", cell]);
    // A cell is free only if the robot fits wherever in it it is: in this door none of this size.
    let coarse = one(&ask("1").ends(5));
    assert_eq!(
        (&coarse["outcome"], &coarse["stop"]),
        (&json!("unknown"), &json!("finished"))
    );
    assert_eq!(coarse["path"], json!([]));
    has_note(&coarse, "converted: ", "20 x 10 cells of 1");
    has_note(&coarse, "unproved: ", "over smaller ones (--cell)");
    let ten_times_finer = one(&ask("0.1").ends(0));
    has_note(&ten_times_finer, "converted: ", "200 x 100 cells of 0.1");
}

#[test]
fn who_proves_that_there_is_no_way_proves_it_of_its_own_problem() {
    let folder = world(&parted());
    let file = folder.name("w.toml");
    for (planner, claims) in planners_in("world") {
        let run = plan(&file, &["--planner", &planner]);
        if claims.iter().any(|claim| claim == "complete") {
            let object = one(&run.ends(4));
            assert_eq!(object["outcome"], "infeasible");
            assert_eq!(
                (&object["cost"], &object["path"]),
                (&json!(null), &json!([]))
            );
            has_note(
                &object,
                "obstacles part start and goal",
                "a robot of radius 0.5",
            );
        } else {
            assert_eq!(one(&run.ends(5))["outcome"], "unknown");
        }
    }
    for (planner, _) in complete_in("grid") {
        let object = one(&plan(&file, &["--planner", &planner]).ends(5));
        assert_eq!(object["outcome"], "unknown");
        has_note(&object, "unproved: ", "a planner in worlds can tell");
    }
    let blocked = one(&plan(&file, &["--to", "5,7"]).ends(4));
    has_note(
        &blocked,
        "the goal 5,7 lies in pillar, a circle",
        "near by it fits at",
    );
    let near = one(&plan(&file, &["--to", "5,6.25"]).ends(4));
    has_note(
        &near,
        "the goal 5,6.25 is 0.25 from pillar",
        "the robot needs 0.5",
    );
}

const HALL: &str = "
    .....#....
    .....#....
    ..........
    .....#....
    .....#....
";

#[test]
fn planners_in_worlds_go_straight_on_grids_and_prove_nothing() {
    let (hall, parted) = (map(HALL), map("...#... ...#... ...#..."));
    for (planner, claims) in complete_in("world") {
        let ends = ["--from", "0,0", "--to", "9,0", "--radius", "0.4"];
        let more = [&ends[..], &["--planner", &planner]].concat();
        let file = hall.name("m.map");
        let straight = one(&plan(&file, &more).ends(0));
        assert_eq!(
            (&straight["problem"], &straight["outcome"]),
            (&json!("grid"), &json!("feasible"))
        );
        has_note(&straight, "converted: ", "a world of 2 rectangles");
        // What was no proof in the world needs no word about the map.
        if claims.iter().any(|claim| claim == "optimal") {
            let words = "not proved to be the best of the map";
            has_note(&straight, "unproved: ", words);
        }
        let path = list(&straight["path"]);
        assert_eq!(
            (&path[0], path.last()),
            (&json!([0, 0]), Some(&json!([9, 0])))
        );
        assert!(number(&straight, "clearance") > 0.4 - 1e-6);
        let steps = one(&plan(&file, &ends).ends(0));
        assert!(number(&straight, "length") < number(&steps, "length"));

        let more = ["--from", "0,0", "--to", "6,0", "--planner", &planner];
        let object = one(&plan(&parted.name("m.map"), &more).ends(5));
        assert_eq!(object["outcome"], "unknown");
        has_note(&object, "unproved: ", "a planner on grids can tell");
    }
}

/// Who promises no path still says so honestly: a path that was marked, or none.
#[test]
fn planners_that_promise_nothing_prove_nothing() {
    let folder = world(ROOMS);
    let file = folder.name("w.toml");
    for problem in ["grid", "world"] {
        for (planner, claims) in planners_in(problem) {
            if claims.iter().any(|claim| claim == "complete") {
                continue;
            }
            let run = plan(&file, &["--planner", &planner, "--iterations", "20"]);
            let object = one(&run);
            let word = object["outcome"].as_str().expect("a word");
            assert!(["feasible", "unknown"].contains(&word), "{planner}: {word}");
            assert_eq!(run.code, if word == "feasible" { 0 } else { 5 });
        }
    }
}
