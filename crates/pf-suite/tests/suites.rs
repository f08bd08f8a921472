//! What a suite may say: every key has a meaning where it stands, or is refused.

use pf_core::CancelToken;
use pf_suite::{Plan, Shard, Suite, SuiteError, run};
use std::{fs, num::NonZeroUsize};
use tempfile::TempDir;

const FILES: [(&str, &str); 8] = [
    (
        "hall.map",
        "type octile\nheight 2\nwidth 3\nmap\n...\n...\n",
    ),
    ("hall.scen", "version 1\n0\thall.map\t3\t2\t0\t0\t2\t0\t2\n"),
    ("ros.pgm", "P2 3 2 255\n254 254 205\n254 254 254\n"),
    (
        "ros.yaml",
        "image: ros.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n",
    ),
    (
        "yard.toml",
        "bounds = { min = [0, 0], max = [9, 9] }\n\
         [[robot]]\nname = \"left\"\nstart = [1, 1]\ngoal = [8, 8]\nradius = 0.5\n\
         [[robot]]\nname = \"right\"\nstart = [8, 1]\ngoal = [1, 8]\nradius = 0.5\n",
    ),
    ("bare.toml", "bounds = { min = [0, 0], max = [9, 9] }\n"),
    (
        "way.toml",
        "world = \"yard.toml\"\nstart = [1, 1]\ngoal = [8, 8]\nradius = 0.5\n",
    ),
    (
        "case.toml",
        "map = \"hall.map\"\nstart = [0, 0]\ngoal = [2, 1]\n",
    ),
];

/// A suite of one problem, whose keys begin on line 4, and one planner.
fn folder(problem: &str, more: &str) -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, text) in FILES {
        fs::write(folder.path().join(name), text).expect("a file in it");
    }
    let suite = format!("{more}\n\n[[problem]]\n{problem}\n[[planner]]\nname = \"astar\"\n");
    fs::write(folder.path().join("s.toml"), suite).expect("a suite");
    folder
}

fn read(folder: &TempDir) -> Result<Suite, String> {
    Suite::read(&folder.path().join("s.toml")).map_err(|error| error.to_string())
}

const ON_A_GRID: &str = "file = \"hall.map\"\nfrom = [0, 0]\nto = [2, 1]\n";
const OF_A_SCEN: &str = "file = \"hall.map\"\nscen = \"hall.scen\"\n";
const IN_A_WORLD: &str = "file = \"yard.toml\"\nfrom = [1, 1]\nto = [8, 8]\n";
const OF_ROBOTS: &str = "file = \"yard.toml\"\n";
const OF_A_CASE: &str = "file = \"case.toml\"\n";
const OF_A_WAY: &str = "file = \"way.toml\"\n";
const OF_A_TEAM: &str = "team = \"yard.toml\"\n";

/// Each key, with a value that is good where the key has a meaning.
const KEYS: [&str; 13] = [
    "file = \"hall.map\"",
    "team = \"yard.toml\"",
    "scen = \"hall.scen\"",
    "rows = 1",
    "case = [\"left\"]",
    "from = [1, 1]",
    "to = [1, 1]",
    "radius = 0.25",
    "clearance = 0.25",
    "cell = 0.5",
    "moves = \"always\"",
    "unknown = \"free\"",
    "ease = 2",
];

#[test]
fn every_key_has_a_meaning_or_is_refused_by_name_and_place() {
    let forms = [
        (ON_A_GRID, "a path on a grid", "radius clearance moves"),
        (
            OF_A_SCEN,
            "rows of a .scen file",
            "rows radius clearance moves",
        ),
        (
            IN_A_WORLD,
            "a path in a world",
            "radius clearance cell moves",
        ),
        (
            OF_ROBOTS,
            "the robots of a world",
            "case radius clearance cell moves",
        ),
        (OF_A_CASE, "a scenario on grids", "radius clearance moves"),
        (
            OF_A_WAY,
            "a scenario in worlds",
            "radius clearance cell moves",
        ),
        (OF_A_TEAM, "a team", "ease"),
    ];
    for (form, what, good) in forms {
        read(&folder(form, "")).expect("the form by itself is sound");
        for line in KEYS {
            let key = line.split(' ').next().expect("a word");
            let there = form
                .lines()
                .any(|other| other.starts_with(&format!("{key} ")));
            // Together with these the table has another form.
            let another = match form {
                ON_A_GRID => matches!(key, "scen" | "team"),
                OF_A_TEAM => false,
                OF_ROBOTS => matches!(key, "team" | "from" | "to"),
                // Its one case has another name.
                OF_A_CASE | OF_A_WAY => matches!(key, "team" | "case"),
                _ => key == "team",
            };
            if there || another {
                continue;
            }
            let found = read(&folder(&format!("{form}{line}\n"), ""));
            if good.split(' ').any(|word| word == key) {
                assert!(found.is_ok(), "{line} for {what}: {found:?}");
                continue;
            }
            let row = 4 + form.lines().count();
            let error = found.expect_err(&format!("{line} for {what} was ignored"));
            let place = format!("s.toml:{row}:1: found the key \"{key}\", expected ");
            assert!(error.contains(&place), "no {place} in {error}");
        }
    }
}

#[test]
fn what_is_refused_says_what_is_possible() {
    for (problem, expected) in [
        (
            format!("{IN_A_WORLD}case = \"left\"\n"),
            "s.toml:7:1: found the key \"case\", expected for a path in a world one of name, file, \
             from, to, radius, clearance, cell, moves",
        ),
        (
            format!("{OF_A_SCEN}to = [2, 1]\n"),
            "s.toml:6:1: found the key \"to\", expected for rows of a .scen file one of name, file, \
             scen, rows, radius, clearance, moves, unknown",
        ),
        (
            format!("{ON_A_GRID}rows = 1\n"),
            "s.toml:7:1: found the key \"rows\", expected \"scen\" beside it: the file whose rows they are",
        ),
        (
            format!("{ON_A_GRID}unknown = \"free\"\n"),
            "s.toml:7:1: found the key \"unknown\", expected none: only a ROS map has unknown cells",
        ),
        (
            format!("{OF_A_TEAM}file = \"yard.toml\"\n"),
            "s.toml:5:1: found the key \"file\", expected for a team one of name, team, ease",
        ),
        (
            "file = \"bare.toml\"\ncase = \"left\"\n".to_owned(),
            "s.toml:3:1: found no \"from\", expected \"from\": a point [x, y], as the world has no robots",
        ),
        // None of a list is not all of it.
        (
            format!("{OF_ROBOTS}case = []\n"),
            "s.toml:5:8: found \"[]\", expected an array of names of cases: one at least",
        ),
        (
            format!("{OF_A_SCEN}rows = []\n"),
            "s.toml:6:8: found \"[]\", expected an array of lines of the .scen file: one at least",
        ),
    ] {
        let error = read(&folder(&problem, "")).expect_err(&problem);
        assert!(error.contains(expected), "no {expected} in {error}");
    }
}

#[test]
fn a_planner_has_a_name_and_a_problem() {
    for (line, expected) in [
        ("problems = []", "one at least"),
        ("variant = \"\"", "expected a name, not an empty string"),
    ] {
        let planner = format!("{OF_ROBOTS}[[planner]]\nname = \"dijkstra\"\n{line}");
        let error = read(&folder(&planner, "")).expect_err(line);
        assert!(error.contains("s.toml:7:"), "{error}");
        assert!(error.contains(expected), "no {expected} in {error}");
    }
}

#[test]
fn unknown_cells_are_those_of_a_ros_map() {
    let problem = "file = \"ros.yaml\"\nfrom = [0, 0]\nto = [2, 0]\nunknown = \"free\"\n";
    assert_eq!(
        read(&folder(problem, "")).map(|suite| suite.problems.len()),
        Ok(1)
    );
}

#[test]
fn times_of_other_repetitions_are_not_mixed_in() {
    let folder = folder(OF_ROBOTS, "repetitions = 1");
    let file = folder.path().join("s.toml");
    let plan = Plan {
        threads: NonZeroUsize::MIN,
        shard: Shard::default(),
        afresh: false,
        cancel: CancelToken::default(),
    };
    let bench = |plan: &Plan| {
        let suite = Suite::read(&file).expect("a suite");
        run(&suite, &folder.path().join("out"), plan, &mut |_, _, _| {})
    };
    assert_eq!(bench(&plan).expect("runs").made, 2);
    assert_eq!(bench(&plan).expect("runs").before, 2);
    let text = fs::read_to_string(&file).expect("the suite");
    fs::write(&file, text.replace("repetitions = 1", "repetitions = 3")).expect("another");
    let mixed = bench(&plan);
    assert!(
        matches!(mixed, Err(SuiteError::Strange { runs: 2, of: 2 })),
        "{mixed:?}"
    );
    let afresh = Plan {
        afresh: true,
        ..plan
    };
    assert_eq!(bench(&afresh).expect("runs").made, 2);
}
