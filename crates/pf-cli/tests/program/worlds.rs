//! `pf plan` of worlds of shapes.

use crate::{Folder, Run, malformed_worlds, pf};
use serde_json::{Value, json};
use std::fs;

/// Two rooms, joined by a door that is 1.4 wide.
pub(crate) const ROOMS: &str = "
bounds = { min = [0, 0], max = [20, 10] }
[[robot]]
name = 'courier'
radius = 0.5
start = [2, 2]
goal = [18, 2]
[[rectangle]]
name = 'wall'
min = [9, -1]
max = [11, 6]
[[rectangle]]
name = 'lintel'
min = [9, 7.4]
max = [11, 11]
[[circle]]
name = 'pillar'
centre = [5, 7.5]
radius = 1
[[polygon]]
corners = [[14, 1], [16, 1], [14, 3]]
";

pub(crate) fn world(toml: &str) -> Folder {
    Folder::with(&[("w.toml", toml.as_bytes())])
}

/// The planners of a kind of problem, and what they claim.
pub(crate) fn planners_in(problem: &str) -> Vec<(String, Vec<String>)> {
    let objects = pf(&["planners", "--json"]).ends(0).json();
    let of_kind = objects.iter().filter(|o| o["problem"] == problem);
    let text = |value: &Value| value.as_str().expect("a string").to_owned();
    let planners = of_kind.map(|object| {
        let claims = list(&object["claims"]);
        (text(&object["name"]), claims.iter().map(text).collect())
    });
    planners.collect()
}

/// Those of them that find a path wherever there is one.
pub(crate) fn complete_in(problem: &str) -> Vec<(String, Vec<String>)> {
    let mut planners = planners_in(problem);
    planners.retain(|(_, claims)| claims.iter().any(|claim| claim == "complete"));
    planners
}

pub(crate) fn plan(file: &str, more: &[&str]) -> Run {
    pf(&[&["plan", file, "--json"], more].concat())
}

#[track_caller]
pub(crate) fn one(run: &Run) -> Value {
    match &run.json()[..] {
        [object] => object.clone(),
        _ => panic!("one line: {}", run.out),
    }
}

pub(crate) fn number(object: &Value, key: &str) -> f64 {
    let value = object[key].as_f64();
    value.unwrap_or_else(|| panic!("no number {key} in {object}"))
}

pub(crate) fn list(value: &Value) -> &[Value] {
    value.as_array().expect("an array")
}

fn notes(object: &Value) -> Vec<&str> {
    let notes = list(&object["notes"]).iter();
    notes.map(|note| note.as_str().expect("a string")).collect()
}

#[track_caller]
pub(crate) fn has_note(object: &Value, beginning: &str, words: &str) {
    let mut notes = notes(object).into_iter();
    let found = notes.any(|note| note.starts_with(beginning) && note.contains(words));
    assert!(found, "no {beginning:?} with {words:?} in {object}");
}

#[test]
fn every_planner_in_worlds_finds_the_door() {
    let folder = world(ROOMS);
    let planners = complete_in("world");
    assert!(!planners.is_empty());
    // To the left corner of the wall, round it, along its top, and the same again.
    let corner = 7f64.hypot(4.0);
    let turn = (4.0 / corner).asin() + (0.5 / corner).asin();
    let shortest = 2.0 + 2.0 * ((corner * corner - 0.25).sqrt() + 0.5 * turn);
    for (planner, claims) in planners {
        let more = ["--planner", &planner, "--seed", "7"];
        let object = one(&plan(&folder.name("w.toml"), &more).ends(0));
        assert_eq!(
            (&object["planner"], &object["seed"]),
            (&json!(planner), &json!(7))
        );
        assert_eq!(object["problem"], "world");
        assert_eq!(object["stop"], "finished");
        let proves = claims.iter().any(|claim| claim == "optimal");
        let outcome = if proves { "optimal" } else { "feasible" };
        assert_eq!(object["outcome"], outcome, "{planner}");
        // Who proves it has nothing to add.
        assert!(!proves || notes(&object).is_empty(), "{object}");
        let path = list(&object["path"]);
        assert_eq!(
            (&path[0], path.last()),
            (&json!([2, 2]), Some(&json!([18, 2])))
        );
        assert!(path.iter().all(|p| list(p).len() == 2));
        let (cost, length) = (number(&object, "cost"), number(&object, "length"));
        assert!((cost - length).abs() < 1e-9, "{cost} {length}");
        assert!(length >= shortest - 1e-9, "{length} {shortest}");
        assert!(!proves || length <= shortest + 1e-4, "{length} {shortest}");
        assert!(number(&object, "clearance") > 0.5 - 1e-6);
        for key in ["iterations", "expanded", "evaluated", "elapsed_us"] {
            assert!(object["stats"][key].is_number(), "{key}");
        }
    }
}

#[test]
fn clearance_is_kept_besides_the_radius() {
    let folder = world(ROOMS);
    let file = folder.name("w.toml");
    let length = |clearance: &str, planner: &str| {
        let more = [
            "--clearance",
            clearance,
            "--planner",
            planner,
            "--cell",
            "0.05",
        ];
        let object = one(&plan(&file, &more).ends(0));
        let asked: f64 = clearance.parse().unwrap();
        assert!(
            number(&object, "clearance") > 0.5 + asked - 1e-6,
            "{object}"
        );
        if asked > 0.0 {
            let words = format!("asked for {clearance}, reached 0.");
            has_note(&object, "clearance: ", &words);
        }
        number(&object, "length")
    };
    for planner in ["visibility-graph", "astar"] {
        assert!(length("0.1", planner) > length("0", planner), "{planner}");
    }
    // The door is 1.4 wide.
    plan(&file, &["--clearance", "0.3"]).ends(4);
    plan(&file, &["--radius", "0.7", "--clearance", "0"]).ends(0);
    plan(&file, &["--radius", "0.71"]).ends(4);
}

#[test]
fn people_read_of_worlds_in_their_words() {
    let folder = world(ROOMS);
    let run = pf(&["plan", &folder.name("w.toml")]).ends(0);
    for words in [
        "4 shapes in 0,0 to 20,10, 2,2 to 18,2, radius 0.5",
        "optimal: proved",
        "besides the radius",
        "points",
    ] {
        assert!(run.out.contains(words), "no {words:?} in {}", run.out);
    }
    let run = pf(&["plan", &folder.name("w.toml"), "--planner", "astar"]).ends(0);
    for words in ["feasible", "converted", "unproved"] {
        assert!(run.out.contains(words), "no {words:?} in {}", run.out);
    }
}

#[test]
fn each_robot_of_a_world_asks_a_question() {
    let second = "[[robot]]\nstart = [2, 8]\ngoal = [7, 2]\n";
    let folder = world(&format!("{ROOMS}{second}"));
    let file = folder.name("w.toml");
    let cases = |more: &[&str]| -> Vec<Value> {
        let objects = plan(&file, more).ends(0).json();
        objects.iter().map(|o| o["case"].clone()).collect()
    };
    assert_eq!(cases(&[]), ["courier", "robot 2"]);
    assert_eq!(cases(&["--case", "robot 2"]), ["robot 2"]);
    assert_eq!(cases(&["--from", "1,1", "--to", "2,1.5"]), [json!(null)]);
    plan(&file, &["--case", "curier"])
        .ends(2)
        .says(&["no robot `curier`", "courier, robot 2"]);
    let svg = folder.name("w.svg");
    plan(&file, &["--svg", &svg])
        .ends(2)
        .says(&["--case", "courier"]);
    assert!(!folder.path("w.svg").exists());
}

#[test]
fn geojson_is_read_as_well() {
    let json = br#"{"type": "FeatureCollection", "bbox": [0, 0, 20, 10], "features": [
        {"type": "Feature", "properties": {"radius": 1}, "geometry":
            {"type": "Point", "coordinates": [10, 5]}}]}"#;
    let toml = b"bounds = { min = [0, 0], max = [20, 10] }\n\
        [[circle]]\ncentre = [10, 5]\nradius = 1\n";
    let folder = Folder::with(&[("w.geojson", json), ("w.toml", toml)]);
    let costs = ["w.geojson", "w.toml"].map(|file| {
        let more = ["--from", "1,5", "--to", "19.5,5", "--radius", "0.25"];
        number(&one(&plan(&folder.name(file), &more).ends(0)), "cost")
    });
    assert!(
        costs[0] > 18.5 && costs[0].total_cmp(&costs[1]).is_eq(),
        "{costs:?}"
    );
}

#[test]
fn worlds_are_drawn() {
    let folder = world(ROOMS);
    let (file, svg, png) = (
        folder.name("w.toml"),
        folder.name("w.svg"),
        folder.name("w.png"),
    );
    let draw = |more: &[&str]| {
        let args = ["plan", &file, "--svg", &svg, "--png", &png];
        pf(&[&args, more].concat()).ends(0);
        assert!(fs::read(&png).unwrap().starts_with(b"\x89PNG"));
        fs::read_to_string(&svg).unwrap()
    };
    let shown = draw(&["--show-graph", "--show-expanded"]);
    for words in [
        "obstacle",
        "too near for the robot",
        "known to be free",
        "expanded",
        "goal",
        "5 units",
    ] {
        assert!(shown.contains(words), "no {words:?}");
    }
    assert!(draw(&["--show-clearance"]).contains("clearance 0.5 to "));
    let cells = draw(&["--planner", "astar", "--show-expanded"]);
    for words in ["blocked cell", "expanded", "A*"] {
        assert!(cells.contains(words), "no {words:?}");
    }
    assert!(!draw(&[]).contains("known to be free"));
}

#[test]
fn usage_errors_about_worlds_end_with_2() {
    let folder = Folder::with(&[
        ("w.toml", ROOMS.as_bytes()),
        (
            "empty.toml",
            b"bounds = { min = [-1, 0], max = [3.5, 2] }\n",
        ),
        ("m.map", &crate::movingai("... ...")),
    ]);
    let file = folder.name("w.toml");
    let plan = |more: &[&str]| plan(&file, more).ends(2);
    plan(&["--to", "21,5"]).says(&["--to 21,5 lies outside the world", "0,0 to 20,10"]);
    plan(&["--from", "-1,5"]).says(&["--from -1,5 lies outside"]);
    plan(&["--nearest"]).says(&["--nearest", "only a grid"]);
    plan(&["--unknown", "free"]).says(&["--unknown", "no unknown cells"]);
    plan(&["--cell", "0"]).says(&["--cell", "positive"]);
    plan(&["--cell", "1e-9"]).says(&["the size of a cell", "at least"]);
    plan(&["--clearance", "-1"]).says(&["--clearance", "from 0"]);
    plan(&["--scen", &folder.name("m.map")]).says(&["--scen", "a grid"]);
    pf(&["plan", &folder.name("empty.toml")]).ends(2).says(&[
        "--from and --to are missing",
        "-1,0",
        "3.5,2",
    ]);
    let on_grid = [
        "plan",
        &folder.name("m.map"),
        "--from",
        "0,0",
        "--to",
        "2,1",
        "--cell",
        "1",
    ];
    pf(&on_grid).ends(2).says(&["--cell", "a grid"]);
}

#[test]
fn every_malformed_world_ends_with_3_and_names_the_file() {
    let inputs = malformed_worlds::all();
    assert!(inputs.len() >= 40);
    for input in &inputs {
        let folder = Folder::with(&[(input.file, &input.bytes)]);
        for (name, bytes) in &input.beside {
            fs::write(folder.path(name), bytes).unwrap();
        }
        let file = folder.name(input.file);
        let run = if input.scenario {
            pf(&["replan", &file, "--json"])
        } else {
            pf(&["plan", &file, "--from", "1,1", "--to", "2,2", "--json"])
        };
        let guilty = folder.name(input.guilty);
        run.ends(3).says(&[&guilty]).says(input.words);
    }
}

#[test]
fn the_worlds_here_are_planned() {
    for file in fs::read_dir(crate::root().join("maps/worlds")).unwrap() {
        let file = file.unwrap().path().display().to_string();
        for object in plan(&file, &[]).ends(0).json() {
            assert_eq!(object["outcome"], "optimal", "{file}");
        }
    }
    let kim = plan("maps/scenarios/kim.toml", &[]).ends(0).json();
    assert_eq!(kim.len(), 6);
    for object in kim {
        assert_eq!(object["notes"], json!(["expected: as the file says"]));
    }
}
