//! `pf plan` and `pf planners`.

use crate::{Folder, map, pf};
use serde_json::json;
use std::fs;

const HALL: &str = "
    .....#....
    .....#....
    ..........
    .....#....
    .....#....
";
const PARTED: &str = "
    ...#...
    ...#...
    ...#...
";

#[test]
fn json_has_the_documented_keys() {
    let folder = map("... .#. ...");
    let file = folder.name("m.map");
    let args = [
        "plan", &file, "--from", "0,0", "--to", "2,2", "--seed", "7", "--json",
    ];
    let run = pf(&args).ends(0);
    let [object] = &run.json()[..] else {
        panic!("one line: {}", run.out)
    };
    assert_eq!(object["planner"], "astar");
    assert_eq!(object["problem"], "grid");
    assert_eq!(object["outcome"], "optimal");
    assert_eq!(object["stop"], "finished");
    assert_eq!(object["cost"], json!(4.0));
    assert_eq!(object["length"], json!(4.0));
    assert_eq!(object["clearance"], json!(0.5));
    assert_eq!(object["seed"], 7);
    assert_eq!(object["notes"], json!([]));
    let path = object["path"].as_array().unwrap();
    assert_eq!((&path[0], &path[4]), (&json!([0, 0]), &json!([2, 2])));
    for key in ["iterations", "expanded", "evaluated", "elapsed_us"] {
        assert!(object["stats"][key].is_number(), "{key}");
    }
    assert_eq!(run.err, "");
}

#[test]
fn people_read_the_same() {
    let folder = map(HALL);
    let run = pf(&[
        "plan",
        &folder.name("m.map"),
        "--from",
        "0,0",
        "--to",
        "9,0",
    ])
    .ends(0);
    for words in [
        "optimal",
        "cost",
        "length",
        "clearance",
        "expanded",
        "time",
        "A* on",
    ] {
        assert!(run.out.contains(words), "no {words:?} in {}", run.out);
    }
}

#[test]
fn what_has_no_path_ends_with_4_and_says_why() {
    let folder = map(PARTED);
    let file = folder.name("m.map");
    for planner in ["dijkstra", "astar", "d-star-lite"] {
        let ask = |to: &str, more: &[&str]| {
            let args = [
                "plan",
                &file,
                "--from",
                "0,0",
                "--to",
                to,
                "--planner",
                planner,
                "--json",
            ];
            let run = pf(&[&args, more].concat()).ends(4);
            run.json()[0].clone()
        };
        let parted = ask("6,1", &[]);
        assert_eq!(
            (&parted["outcome"], &parted["cost"]),
            (&json!("infeasible"), &json!(null))
        );
        assert_eq!(parted["path"], json!([]));
        assert!(
            parted["notes"][0]
                .as_str()
                .unwrap()
                .contains("no way between them")
        );
        let blocked = ask("3,1", &[]);
        let why = blocked["notes"][0].as_str().unwrap();
        assert_eq!(
            why,
            "the goal 3,1 is blocked; the nearest cell it fits is 2,1"
        );
        let inflated = ask("4,1", &["--radius", "1"]);
        let why = inflated["notes"][0].as_str().unwrap();
        assert!(why.starts_with("the goal 4,1 has a clearance of 0.5 cells, the robot needs 1"));
    }
}

#[test]
fn nearest_gives_the_way_to_the_nearest_cell() {
    let folder = map(PARTED);
    let file = folder.name("m.map");
    for planner in ["dijkstra", "astar", "d-star-lite"] {
        let args = [
            "plan",
            &file,
            "--from",
            "0,1",
            "--to",
            "6,1",
            "--planner",
            planner,
        ];
        let svg = folder.name("near.svg");
        let more = ["--nearest", "--json", "--svg", &svg];
        let object = &pf(&[&args[..], &more[..]].concat()).ends(4).json()[0];
        assert_eq!(object["outcome"], "infeasible");
        assert_eq!(object["nearest_path"], json!([[0, 1], [1, 1], [2, 1]]));
        let notes = object["notes"].as_array().unwrap();
        assert!(notes.contains(&json!("nearest: 2,1")), "{notes:?}");
        assert!(
            fs::read_to_string(&svg)
                .unwrap()
                .contains("stroke-dasharray")
        );
        let text = pf(&[&args[..], &["--nearest"]].concat()).ends(4).out;
        assert!(text.contains("the path to 2,1 takes 2 cells"), "{text}");
    }
}

#[test]
fn a_budget_that_runs_out_ends_with_5() {
    let folder = map(HALL);
    let file = folder.name("m.map");
    let args = [
        "plan",
        &file,
        "--from",
        "0,0",
        "--to",
        "9,0",
        "--json",
        "--iterations",
        "3",
    ];
    let object = &pf(&args).ends(5).json()[0];
    assert_eq!(
        (&object["outcome"], &object["stop"]),
        (&json!("unknown"), &json!("iterations"))
    );
    pf(&[
        "plan",
        &file,
        "--from",
        "0,0",
        "--to",
        "9,0",
        "--time",
        "1m",
        "--threads",
        "2",
    ])
    .ends(0);
}

#[test]
fn moves_and_radius_change_the_answer() {
    let folder = map(HALL);
    let file = folder.name("m.map");
    let cost = |moves: &str| {
        let args = [
            "plan", &file, "--from", "4,1", "--to", "6,1", "--json", "--moves", moves,
        ];
        let run = pf(&args).ends(0);
        run.json()[0]["cost"].as_f64().unwrap()
    };
    let rules = ["orthogonal", "always", "one-corner", "no-corner-cutting"];
    let around_the_corners = 8f64.sqrt();
    for (rule, expected) in
        rules
            .into_iter()
            .zip([4.0, around_the_corners, around_the_corners, 4.0])
    {
        assert!((cost(rule) - expected).abs() < 1e-9, "{rule}");
    }
    let door = ["plan", &file, "--from", "0,2", "--to", "9,2", "--radius"];
    pf(&[&door[..], &["0.5"]].concat()).ends(0);
    pf(&[&door[..], &["0.6"]].concat()).ends(4);
}

#[test]
fn pictures_are_drawn() {
    let folder = map(HALL);
    let (file, svg, png) = (
        folder.name("m.map"),
        folder.name("o.svg"),
        folder.name("o.png"),
    );
    let args = [
        "plan", &file, "--from", "0,2", "--to", "9,2", "--radius", "0.5",
    ];
    let more = ["--svg", &svg, "--png", &png, "--show-expanded"];
    pf(&[&args[..], &more[..]].concat()).ends(0);
    let text = fs::read_to_string(&svg).unwrap();
    assert!(text.starts_with("<svg ") && text.contains("expanded") && text.contains("goal"));
    assert!(fs::read(&png).unwrap().starts_with(b"\x89PNG"));
}

#[test]
fn the_45_published_cases_come_out_as_published() {
    for planner in ["dijkstra", "astar", "d-star-lite"] {
        let args = [
            "plan",
            "maps/scenarios/redlarski.toml",
            "--planner",
            planner,
            "--json",
        ];
        let objects = pf(&args).ends(0).json();
        assert_eq!(objects.len(), 45);
        for object in objects {
            assert!(object["case"].is_string());
            assert_eq!(object["notes"], json!(["expected: as the file says"]));
        }
    }
}

#[test]
fn a_length_that_the_file_states_wrongly_ends_with_6() {
    let toml = b"map = 'm.map'\nstart = [0, 0]\ngoal = [2, 0]\n\
        expected = { straight = 3, diagonal = 0 }\n";
    let map = crate::movingai("...");
    let folder = Folder::with(&[("m.map", &map), ("s.toml", toml)]);
    let file = folder.name("s.toml");
    let object = &pf(&["plan", &file, "--json"]).ends(6).json()[0];
    assert_eq!(object["notes"], json!(["expected: the file says 3"]));
    // Another question is another length.
    pf(&["plan", &file, "--to", "1,0"]).ends(0);
}

#[test]
fn planners_are_listed() {
    let objects = pf(&["planners", "--json"]).ends(0).json();
    let names: Vec<_> = objects
        .iter()
        .map(|o| o["name"].as_str().unwrap())
        .collect();
    assert!(names.starts_with(&["dijkstra", "astar", "d-star-lite"]));
    for object in &objects {
        let kind = match object["name"].as_str().unwrap() {
            "visibility-graph" | "pso" | "lbfgs" | "abc" => "world",
            "moabc" | "nsga2" | "moead" | "random-search" | "prioritised" => "team",
            _ => "grid",
        };
        assert_eq!(object["problem"], kind);
        assert!(object["claims"].is_array() && object["paper"].is_string());
    }
    let text = pf(&["planners"]).ends(0).out;
    assert!(names.iter().all(|name| text.contains(name)));
}

#[test]
fn help_shows_examples() {
    for verb in ["plan", "replan", "planners", "demo"] {
        let help = pf(&[verb, "--help"]).ends(0).out;
        assert!(help.contains(&format!("Examples:\n  pf {verb}")), "{help}");
    }
    assert!(pf(&["--help"]).ends(0).out.contains("Exit codes:"));
}
