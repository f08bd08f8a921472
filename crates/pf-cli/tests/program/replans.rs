//! `pf replan`.

use crate::{Folder, movingai, pf};
use serde_json::{Value, json};

const HALL: &str = "
    ..........
    ..........
    .....#....
    .....#....
    .....#....
    ..........
";

const SCENARIO: &[u8] = b"
map = 'm.map'
start = [0, 3]
goal = [9, 3]

[[event]]
at = 2
name = 'upper door'
blocked = [[5, 0], [5, 1]]

[[event]]
at = 3
goal = [9, 0]

[[event]]
at = 4
blocked = [[5, 5]]

[[event]]
at = 5
freed = [[5, 3, 1, 3]]
cost = { value = 9, cells = [[7, 0, 1, 6]] }
";

fn scenario() -> Folder {
    Folder::with(&[("m.map", &movingai(HALL)), ("s.toml", SCENARIO)])
}

fn replan(folder: &Folder, planner: &str, more: &[&str]) -> Vec<Value> {
    let file = folder.name("s.toml");
    let args = ["replan", &file, "--planner", planner, "--json"];
    pf(&[&args, more].concat()).ends(0).json()
}

#[test]
fn one_object_per_event() {
    let objects = replan(&scenario(), "d-star-lite", &[]);
    assert_eq!(objects.len(), 5);
    for (i, object) in objects.iter().enumerate() {
        assert_eq!(object["event"], i);
        assert_eq!(object["planner"], "d-star-lite");
        for key in ["latency_us", "upkeep_us", "at", "seed"] {
            assert!(object[key].is_number(), "{key}");
        }
        for key in [
            "stop",
            "cost",
            "length",
            "path",
            "clearance",
            "notes",
            "stats",
            "change",
        ] {
            assert!(object.get(key).is_some(), "{key}");
        }
    }
    let outcomes: Vec<_> = objects
        .iter()
        .map(|o| o["outcome"].as_str().unwrap())
        .collect();
    assert_eq!(
        outcomes,
        ["optimal", "optimal", "optimal", "infeasible", "optimal"]
    );
    assert_eq!(objects[1]["change"], "upper door: 2 cells blocked");
}

#[test]
fn a_replanner_answers_as_one_that_starts_over() {
    for more in [&[][..], &["--radius", "0.6"], &["--moves", "orthogonal"]] {
        let folder = scenario();
        let cost = |objects: Vec<Value>| -> Vec<_> {
            objects
                .iter()
                .map(|o| (o["outcome"].clone(), o["cost"].clone()))
                .collect()
        };
        let expected = cost(replan(&folder, "astar", more));
        assert_eq!(
            cost(replan(&folder, "d-star-lite", more)),
            expected,
            "{more:?}"
        );
    }
}

#[test]
fn a_robot_with_a_size_keeps_its_distance_after_changes() {
    for object in replan(&scenario(), "d-star-lite", &["--radius", "0.6"]) {
        if object["outcome"] == "optimal" {
            assert!(object["clearance"].as_f64().unwrap() >= 0.6);
        }
    }
}

#[test]
fn people_get_a_line_per_event_and_a_picture() {
    let folder = scenario();
    let (file, svg) = (folder.name("s.toml"), folder.name("s.svg"));
    let run = pf(&["replan", &file, "--svg", &svg]).ends(0);
    assert_eq!(run.out.lines().count(), 7, "{}", run.out);
    assert!(run.out.contains("upper door") && run.out.contains("D* Lite on"));
    let svg = std::fs::read_to_string(&svg).unwrap();
    assert!(svg.contains("stroke-dasharray") && svg.contains("newly blocked"));
}

#[test]
fn the_last_event_decides_how_it_ends() {
    let toml = b"map = 'm.map'\nstart = [0, 0]\ngoal = [2, 0]\n\
        [[event]]\nat = 1\nblocked = [[1, 0]]\n";
    let folder = Folder::with(&[("m.map", &movingai("...")), ("s.toml", toml)]);
    let objects = pf(&["replan", &folder.name("s.toml"), "--json"])
        .ends(4)
        .json();
    assert_eq!(
        objects[1]["notes"].as_array().unwrap().last().unwrap(),
        &json!(
            "obstacles part start and goal: no way between them under the moves no-corner-cutting"
        )
    );
}

#[test]
fn the_published_cases_are_replanned_from_the_first_table() {
    let args = ["replan", "maps/scenarios/redlarski.toml", "--json"];
    let objects = pf(&args).ends(0).json();
    // Nine maps, four further tables, a first plan before each.
    assert_eq!(objects.len(), 9 * 4 * 2);
}
