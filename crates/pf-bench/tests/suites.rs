//! The suites as their users see them, on a small map; what they time is no matter here.
#![expect(clippy::unwrap_used, reason = "a test that stumbles has failed")]

use pf_planners::AnyEntry;
use serde_json::Value;
use std::{
    fmt::Write as _,
    fs,
    process::{Command, Output, Stdio},
};

/// A folder with a map of 40 x 30 cells, a few walls in it, and two queries.
fn folder(first_optimum: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let mut map = "type octile\nheight 30\nwidth 40\nmap\n".to_owned();
    for y in 0..30 {
        let wall = |x| x % 9 == 5 && (y + x) % 7 != 0;
        let row: String = (0..40).map(|x| if wall(x) { '@' } else { '.' }).collect();
        writeln!(map, "{row}").unwrap();
    }
    fs::write(folder.path().join("small.map"), map).unwrap();
    let scen = format!(
        "version 1\n0\tsmall.map\t40\t30\t0\t0\t3\t0\t{first_optimum}\n\
         14\tsmall.map\t40\t30\t0\t4\t39\t25\t48.28427\n"
    );
    fs::write(folder.path().join("small.map.scen"), scen).unwrap();
    folder
}

fn command(folder: &tempfile::TempDir, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_pf-bench"));
    command.args(args).arg("--maps").arg(folder.path());
    command
}

fn bench(folder: &tempfile::TempDir, args: &[&str]) -> Output {
    command(folder, args).output().unwrap()
}

#[track_caller]
fn rows(output: &Output) -> Vec<Value> {
    let err = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{err}");
    let out = String::from_utf8_lossy(&output.stdout);
    out.lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect()
}

#[test]
fn grid_compares_with_peers_and_counts_allocations() {
    let rows = rows(&bench(&folder("3.00000"), &["grid", "--json"]));
    let of = |planner: &str| rows.iter().find(|row| row["planner"] == planner).unwrap();
    for planner in ["astar", "dijkstra", "d-star-lite"] {
        let row = of(planner);
        assert_eq!(
            (&row["queries"], &row["mismatches"]),
            (&2.into(), &0.into()),
            "{row}"
        );
        // The path alone.
        assert_eq!(row["allocations"], 1.0, "{row}");
        assert!(row["bytes_per_cell"].is_number() && row["ns_per_expansion"].is_number());
    }
    for peer in [
        "pathfinding::astar",
        "pathfinding::dijkstra",
        "petgraph::astar",
    ] {
        assert_eq!(of(peer)["mismatches"], 0);
    }
    assert_eq!(of("grid_pathfinding::jps")["case"], "small, always");
}

/// As `head` does.
#[test]
fn a_reader_may_stop_reading() {
    let folder = folder("3.00000");
    let mut command = command(&folder, &["grid", "--planner", "astar"]);
    let mut child = command
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    let err = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && err.is_empty(), "{err}");
}

#[test]
fn a_length_that_is_not_the_stated_one_makes_it_fail() {
    let folder = folder("4.00000");
    let output = bench(&folder, &["grid", "--planner", "astar"]);
    assert!(!output.status.success());
    let err = String::from_utf8_lossy(&output.stderr);
    assert!(err.contains("answers do not agree"), "{err}");
}

/// The fresh A*, then all that repair and prove.
fn repairers() -> Vec<&'static str> {
    let all = pf_planners::grid_planners().filter(|p| p.replans() && p.claims().optimal);
    let others = all.map(AnyEntry::key).filter(|&key| key != "astar");
    std::iter::once("astar").chain(others).collect()
}

#[test]
fn replan_tells_latency_and_upkeep_of_every_class() {
    let folder = folder("3.00000");
    let args = ["replan", "--json", "--moves", "orthogonal"];
    let rows = rows(&bench(&folder, &args));
    for event in [
        "10-near",
        "1%-near",
        "1%-anywhere",
        "block-7x7",
        "goal-moved",
        "robot-moved",
        "blocked",
        "freed",
    ] {
        let of: Vec<_> = rows.iter().filter(|row| row["event"] == event).collect();
        let planners: Vec<_> = of
            .iter()
            .map(|row| row["planner"].as_str().unwrap())
            .collect();
        let mut expected = repairers();
        expected.push("condor_grid::DStarLite");
        assert_eq!(planners, expected);
        for row in of {
            assert_eq!(row["mismatches"], 0, "{row}");
            let ours = row["planner"] != "condor_grid::DStarLite";
            assert_eq!(row.get("upkeep_us").is_some(), ours);
        }
    }
}

#[test]
fn drive_compares_at_every_discovery() {
    let rows = rows(&bench(
        &folder("3.00000"),
        &["drive", "--json", "--sensor", "2"],
    ));
    assert_eq!(rows.len(), repairers().len());
    for row in rows {
        assert_eq!(
            (&row["mismatches"], &row["arrived"]),
            (&0.into(), &1.into()),
            "{row}"
        );
        assert!(row["total_us"].as_f64() >= row["upkeep_us"].as_f64());
    }
}

#[test]
fn what_makes_no_sense_is_refused() {
    let folder = folder("3.00000");
    for (args, words) in [
        (&["grid", "--planner", "bstar"][..], "the contenders are"),
        (
            &["grid", "--filter", "large"],
            "no map's name contains `large`; the maps are `small`",
        ),
        // One that is there does not hide another that is not.
        (
            &["replan", "--filter", "small", "--filter", "smell"],
            "contains `smell`; did you mean `small`?",
        ),
        (&["grid", "--plot", "plot.jpg"], ".svg or .png"),
        (&["replan", "--planner", "bstar"], "known: "),
        (&["replan", "--event", "flood"], "10-near"),
        (&["drive", "--sensor=-1"], "radius"),
    ] {
        let output = bench(&folder, args);
        assert!(!output.status.success());
        let err = String::from_utf8_lossy(&output.stderr);
        assert!(err.contains(words), "{args:?}: {err}");
    }
    let empty = tempfile::tempdir().unwrap();
    let output = bench(&empty, &["grid"]);
    assert!(String::from_utf8_lossy(&output.stderr).contains("no .map file in it"));
}

#[test]
fn a_case_of_worlds_that_there_is_none_of_is_refused() {
    let words = [
        "worlds",
        "--worlds",
        "1",
        "--queries",
        "1",
        "--case",
        "goal driftz",
    ];
    let mut command = Command::new(env!("CARGO_BIN_EXE_pf-bench"));
    let output = command.args(words).output().unwrap();
    assert!(!output.status.success());
    let err = String::from_utf8_lossy(&output.stderr);
    assert!(
        err.contains("no case's name contains `goal driftz`"),
        "{err}"
    );
    assert!(err.contains("`10 shapes, goal drifts by 2`, "), "{err}");
}
