//! `pf drive`.

use crate::{Folder, map, movingai, pf};
use serde_json::Value;

const HALL: &str = "
    ..........
    ......#...
    ......#...
    ......#...
    ......#...
    ......#...
";

fn drive(folder: &Folder, more: &[&str]) -> Value {
    let file = folder.name("m.map");
    let args = ["drive", &file, "--sensor", "2", "--json"];
    let objects = pf(&[&args, more].concat()).ends(0).json();
    assert_eq!(objects.len(), 1);
    objects[0].clone()
}

#[test]
fn a_robot_finds_its_way_round_a_wall_it_did_not_know() {
    let there = ["--from", "0,5", "--to", "9,5"];
    for planner in ["d-star-lite", "astar", "dijkstra"] {
        let object = drive(&map(HALL), &[&there[..], &["--planner", planner]].concat());
        assert_eq!(object["planner"], planner);
        assert_eq!(
            (&object["problem"], &object["outcome"]),
            (&"grid".into(), &"feasible".into())
        );
        let path = object["path"].as_array().unwrap();
        assert_eq!(
            (&path[0], &path[path.len() - 1]),
            (&[0, 5].into(), &[9, 5].into())
        );
        // It runs up to the wall and along it.
        let (cost, known) = (object["cost"].as_f64().unwrap(), &object["known_cost"]);
        assert!(cost > known.as_f64().unwrap(), "{object}");
        assert_eq!(object["cost"], object["length"]);
        assert!(object["replans"].as_u64().unwrap() > 1);
        for key in [
            "first_us",
            "latency_us",
            "worst_us",
            "upkeep_us",
            "planning_us",
            "seed",
        ] {
            assert!(object[key].is_number(), "{key}");
        }
    }
}

#[test]
fn a_sensor_that_sees_everything_finds_the_shortest_path() {
    let far = ["--from", "0,5", "--to", "9,5", "--sensor", "20"];
    let folder = map(HALL);
    let file = folder.name("m.map");
    let object = &pf(&[&["drive", &file, "--json"], &far[..]].concat())
        .ends(0)
        .json()[0];
    assert_eq!(object["cost"], object["known_cost"]);
    assert_eq!(
        (&object["replans"], &object["seen"]),
        (&0.into(), &60.into())
    );
}

#[test]
fn a_closed_goal_is_found_out() {
    let folder = map("......#. ......#. ......#.");
    let file = folder.name("m.map");
    let args = [
        "drive", &file, "--sensor", "1", "--from", "0,0", "--to", "7,0", "--json",
    ];
    let object = &pf(&args).ends(4).json()[0];
    assert_eq!(
        (&object["outcome"], &object["known_cost"]),
        (&"infeasible".into(), &Value::Null)
    );
    assert!(object["path"].as_array().unwrap().len() > 5);
}

#[test]
fn a_budget_too_small_is_no_proof() {
    let folder = map(HALL);
    let file = folder.name("m.map");
    let args = [
        "drive", &file, "--sensor", "2", "--from", "0,5", "--to", "9,5",
    ];
    pf(&[&args[..], &["--iterations", "1"]].concat()).ends(5);
}

#[test]
fn a_robot_with_a_size_keeps_its_distance() {
    let gap = "........ ........ ........ ...#.... ...#.... ........ ...#.... ...#....";
    let there = ["--from", "0,5", "--to", "7,5"];
    let cost = |radius| {
        let object = drive(&map(gap), &[&there[..], &["--radius", radius]].concat());
        object["cost"].as_f64().unwrap()
    };
    assert!(cost("0.6") > cost("0"));
}

#[test]
fn a_row_of_a_scenario_file_says_where() {
    let scen = b"version 1\n0\tm.map\t10\t6\t0\t0\t3\t0\t3\n0\tm.map\t10\t6\t1\t5\t4\t5\t3\n";
    let folder = Folder::with(&[("m.map", &movingai(HALL)), ("m.scen", scen)]);
    let scen = folder.name("m.scen");
    let object = drive(&folder, &["--scen", &scen, "--row", "2"]);
    assert_eq!(
        (&object["path"][0], &object["cost"]),
        (&[1, 5].into(), &3.0.into())
    );
    for row in ["0", "3"] {
        let file = folder.name("m.map");
        pf(&[
            "drive", &file, "--sensor", "2", "--scen", &scen, "--row", row,
        ])
        .ends(2)
        .says(&["no such row", "1 to 2"]);
    }
}

#[test]
fn without_a_query_it_drives_across() {
    let object = drive(&map("#.... ..... ...##"), &[]);
    let path = object["path"].as_array().unwrap();
    assert_eq!(
        (&path[0], &path[path.len() - 1]),
        (&[1, 0].into(), &[2, 2].into())
    );
    let args = [
        "drive",
        "maps/grids/redlarski/maze-100.map",
        "--sensor",
        "10",
        "--json",
    ];
    assert_eq!(pf(&args).ends(0).json()[0]["outcome"], "feasible");
    // Nowhere to be is nowhere to go.
    pf(&["drive", &map("##").name("m.map"), "--sensor", "1"]).ends(4);
}

#[test]
fn people_get_a_paragraph_and_a_picture() {
    let folder = map(HALL);
    let (file, svg) = (folder.name("m.map"), folder.name("d.svg"));
    let png = folder.name("d.png");
    let args = [
        "drive", &file, "--sensor", "2", "--from", "0,5", "--to", "9,5",
    ];
    let run = pf(&[&args[..], &["--svg", &svg, "--png", &png]].concat()).ends(0);
    for words in ["arrived", "replans", "with the map known", "median"] {
        assert!(run.out.contains(words), "no {words:?} in {}", run.out);
    }
    let svg = std::fs::read_to_string(&svg).unwrap();
    assert!(svg.contains("not seen") && svg.contains("driven"));
    assert!(std::fs::read(&png).unwrap().starts_with(b"\x89PNG"));
}

#[test]
fn what_makes_no_sense_is_refused() {
    let folder = map(HALL);
    let file = folder.name("m.map");
    let there = ["--from", "0,5", "--to", "9,5"];
    for (more, words) in [
        (&["--sensor", "-1"][..], "from 0"),
        (&["--sensor", "nan"], "from 0"),
        (
            &["--sensor", "2", "--planner", "visibility-graph"],
            "no planner on grids",
        ),
        (&["--sensor", "2", "--planner", "d-star"], "d-star-lite"),
        (&["--sensor", "2", "--set", "speed=3"], "patience"),
        (&[], "--sensor"),
    ] {
        let args = [&["drive", &file], &there[..], more].concat();
        pf(&args).ends(2).says(&[words]);
    }
    pf(&["drive", &file, "--sensor", "2", "--from", "0,0"])
        .ends(2)
        .says(&["--to"]);
    pf(&[
        "drive", &file, "--sensor", "2", "--from", "0,0", "--to", "99,0",
    ])
    .ends(2)
    .says(&["outside"]);
    let world = Folder::with(&[("w.toml", b"bounds = [0, 0, 9, 9]\n")]);
    pf(&["drive", &world.name("w.toml"), "--sensor", "2"])
        .ends(2)
        .says(&["grid"]);
    pf(&["drive", "nowhere.map", "--sensor", "2"]).ends(3);
}
