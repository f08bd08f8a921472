//! `pf replan` of worlds.

use crate::{
    Folder, pf,
    worlds::{ROOMS, list, number, one, plan, world},
};
use serde_json::{Value, json};
use std::fs;

/// In the rooms a crate blocks the door and is pushed aside, and the goal walks.
const SCENARIO: &[u8] = b"
world = 'w.toml'

[[event]]
at = 1
name = 'the pillar walks'
move = { shape = 'pillar', by = [1.5, -2] }

[[event]]
at = 2
goal = [17, 8]

[[event]]
at = 3
name = 'a crate'
add = { name = 'crate', min = [9.5, 6], max = [10.5, 7] }

[[event]]
at = 4
remove = ['crate']
start = [4, 2]
";

fn scenario() -> Folder {
    Folder::with(&[("w.toml", ROOMS.as_bytes()), ("s.toml", SCENARIO)])
}

fn replan(folder: &Folder, planner: &str) -> Vec<Value> {
    let file = folder.name("s.toml");
    pf(&["replan", &file, "--planner", planner, "--json"])
        .ends(0)
        .json()
}

#[test]
fn goals_and_obstacles_move_in_worlds() {
    let objects = replan(&scenario(), "visibility-graph");
    let outcomes: Vec<_> = objects.iter().map(|o| o["outcome"].clone()).collect();
    assert_eq!(
        outcomes,
        ["optimal", "optimal", "optimal", "infeasible", "optimal"]
    );
    for (k, object) in objects.iter().enumerate() {
        assert_eq!(
            (&object["event"], &object["problem"]),
            (&json!(k), &json!("world"))
        );
        for key in ["latency_us", "upkeep_us", "at", "seed"] {
            assert!(object[key].is_number(), "{key}");
        }
        if object["outcome"] == "optimal" {
            assert!(number(object, "clearance") > 0.5 - 1e-6);
        }
    }
    let changes: Vec<_> = objects[1..].iter().map(|o| o["change"].clone()).collect();
    assert_eq!(
        changes,
        [
            "the pillar walks: pillar moved by 1.5,-2",
            "goal to 17,8",
            "a crate: a rectangle added",
            "start to 4,2, crate removed"
        ]
    );
    let end = |object: &Value, last: bool| {
        let path = list(&object["path"]);
        path[if last { path.len() - 1 } else { 0 }].clone()
    };
    assert_eq!(
        (end(&objects[0], true), end(&objects[2], true)),
        (json!([18, 2]), json!([17, 8]))
    );
    assert_eq!(end(&objects[4], false), json!([4, 2]));
}

/// What is planned anew costs what is planned at once, whoever plans.
#[test]
fn replanning_in_worlds_answers_as_planning_does() {
    let folder = scenario();
    let exact = replan(&folder, "visibility-graph");
    let afresh = replan(&folder, "astar");
    for planner in ["astar", "d-star-lite", "dijkstra"] {
        for ((object, exact), afresh) in replan(&folder, planner).iter().zip(&exact).zip(&afresh) {
            assert_eq!(object["outcome"], afresh["outcome"]);
            if exact["outcome"] == "infeasible" {
                assert_eq!(object["outcome"], "unknown");
                continue;
            }
            assert_eq!(object["outcome"], "feasible");
            let (length, shortest) = (number(object, "length"), number(exact, "length"));
            assert!(
                length > shortest - 1e-3 && length < 1.2 * shortest,
                "{length} {shortest}"
            );
            assert!(number(object, "clearance") > 0.5 - 1e-6);
        }
    }
    // The last event's question, asked at once.
    let now = ROOMS.replace("centre = [5, 7.5]", "centre = [6.5, 5.5]");
    let folder = world(&now);
    let more = ["--from", "4,2", "--to", "17,8"];
    let at_once = one(&plan(&folder.name("w.toml"), &more).ends(0));
    let (a, b) = (number(&at_once, "cost"), number(&exact[4], "cost"));
    assert!((a - b).abs() < 1e-6, "{a} {b}");
}

#[test]
fn people_get_a_picture_of_what_moved() {
    let folder = scenario();
    let (file, svg) = (folder.name("s.toml"), folder.name("s.svg"));
    let run = pf(&["replan", &file, "--svg", &svg]).ends(0);
    assert_eq!(run.out.lines().count(), 7, "{}", run.out);
    let svg = fs::read_to_string(&svg).unwrap();
    for words in [
        "at first",
        "in the end",
        "was there",
        "new there",
        "stroke-dasharray",
    ] {
        assert!(svg.contains(words), "no {words:?}");
    }
}

#[test]
fn the_scenarios_here_are_played() {
    for scenario in ["moving-goal-yard", "yard-traffic"] {
        let file = format!("maps/scenarios/{scenario}.toml");
        for planner in ["visibility-graph", "d-star-lite"] {
            let objects = pf(&["replan", &file, "--planner", planner, "--json"])
                .ends(0)
                .json();
            assert!(objects.len() >= 5);
            for object in objects {
                let no_way = object["outcome"] == "infeasible" || object["outcome"] == "unknown";
                assert!(!no_way || scenario == "yard-traffic", "{object}");
                assert!(
                    no_way || number(&object, "clearance") > 0.6 - 1e-6,
                    "{object}"
                );
            }
        }
    }
}
