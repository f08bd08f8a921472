//! `pf walk` and `pf tune`.

use crate::{Folder, pf};
use serde_json::Value;

fn walked(args: &[&str], code: i32) -> Value {
    let run = pf(&[&["walk"], args, &["--json"]].concat()).ends(code);
    serde_json::from_str(&run.out).expect("one object")
}

#[test]
fn a_walk_arrives_while_things_happen() {
    let folder = Folder::with(&[]);
    let png = folder.name("walk.png");
    for seed in ["0", "1", "2", "3", "4"] {
        let scenario = "maps/scenarios/busy-square.toml";
        let walk = walked(&[scenario, "--seed", seed, "--png", &png], 0);
        assert_eq!(walk["outcome"], "feasible");
        let events = walk["events"].as_array().unwrap();
        assert!(events.len() > 5, "{events:?}");
        assert_eq!(events[0]["step"], 2);
        let path = walk["path"].as_array().unwrap();
        assert_eq!(path.last().unwrap(), &serde_json::json!([47.0, 40.0]));
        assert_eq!(
            walk,
            walked(&[scenario, "--seed", seed], 0),
            "the same again"
        );
    }
    assert!(std::fs::read(png).unwrap().starts_with(b"\x89PNG"));
}

#[test]
fn a_walk_without_memory_stays_in_the_trap() {
    let map = "maps/worlds/cabc-2.toml";
    let walk = walked(&[map, "--set", "memory=0", "--set", "steps=100"], 5);
    assert_eq!(
        (&walk["outcome"], &walk["steps"]),
        (&"unknown".into(), &100.into())
    );
    assert_eq!(walk["notes"][0], "gave up: after steps=100");
    let walk = walked(&[map, "--iterations", "7"], 5);
    assert_eq!(
        (&walk["stop"], &walk["steps"]),
        (&"iterations".into(), &7.into())
    );
}

#[test]
fn what_cannot_be_walked_is_refused() {
    let refused = |args: &[&str], words: &str| {
        let run = pf(&[&["walk"], args].concat()).ends(2);
        assert!(run.err.contains(words), "{}", run.err);
    };
    refused(
        &["maps/scenarios/yard-traffic.toml"],
        "puts the robot elsewhere",
    );
    refused(
        &["maps/worlds/cabc-1.toml", "--planner", "pso"],
        "the whole world",
    );
    refused(
        &["maps/worlds/cabc-1.toml", "--set", "half=0"],
        "`half`: `0`",
    );
    refused(
        &[
            "maps/grids/redlarski/maze-20.map",
            "--from",
            "0,0",
            "--to",
            "5,5",
        ],
        "not a world",
    );
}

#[test]
fn tuning_goes_on_from_its_file_and_threads_change_nothing() {
    let folder = Folder::with(&[]);
    let file = folder.name("books.json");
    let tune = |more: &[&str]| {
        let args = [
            "tune",
            "maps/worlds/cabc-1.toml",
            "--w1",
            "0.8:1:0.1",
            "--w2",
            "0,0.2",
            "--w3",
            "0,0.03",
            "--runs",
            "6",
            "--fresh",
            "10",
            "--set",
            "cycles=1",
            "--json",
        ];
        pf(&[&args, more].concat())
    };
    let plain = tune(&[]).ends(0).out;
    let found: Value = serde_json::from_str(&plain).unwrap();
    assert_eq!(found["points"], 12);
    assert_eq!(found["grid"]["runs"], 72);
    assert!(found["race"]["runs"].as_u64().unwrap() < 72);
    assert!(found["grid"]["out_of_sample"].is_number());
    assert_eq!(
        tune(&["--threads", "2", "--file", &file]).ends(0).out,
        plain
    );
    assert_eq!(tune(&["--file", &file]).ends(0).out, plain);
    let run = tune(&["--file", &file, "--set", "half=3"]).ends(2);
    assert!(run.err.contains("another search"), "{}", run.err);
}
