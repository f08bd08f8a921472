//! Ctrl-C and readers that go away.
#![cfg(unix)]

use crate::{Folder, Run, command, movingai};
use std::{
    io::{BufRead, BufReader, Read},
    process::{Command, Stdio},
};

#[test]
fn ctrl_c_reports_what_there_is_and_ends_with_130() {
    let row = ".".repeat(300);
    let drawing = vec![row.as_str(); 300].join("\n");
    // The first row is wrong, so that the program speaks up once it is at work.
    let mut rows = "version 1\n0\tm.map\t300\t300\t0\t0\t0\t1\t7\n".to_owned();
    rows.push_str(&"0\tm.map\t300\t300\t0\t0\t299\t299\t422.84992\n".repeat(100_000));
    let folder = Folder::with(&[("m.map", &movingai(&drawing)), ("m.scen", rows.as_bytes())]);
    let (map, rows) = (folder.name("m.map"), folder.name("m.scen"));
    let args = [
        "plan",
        &map,
        "--scen",
        &rows,
        "--planner",
        "dijkstra",
        "--json",
    ];
    let mut child = command(&args)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut err = BufReader::new(child.stderr.take().unwrap());
    let mut line = String::new();
    err.read_line(&mut line).unwrap();
    assert!(line.contains("the file says 7"), "{line}");
    let kill = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(kill.unwrap().success());
    err.read_to_string(&mut line).unwrap();
    let run = Run::from(child.wait_with_output().unwrap()).ends(130);
    let done = run.json()[0]["rows"].as_u64().unwrap();
    assert!((1..100_000).contains(&done), "{done}");
}

#[test]
fn a_reader_that_goes_away_is_no_fault() {
    let mut child = command(&["plan", "maps/scenarios/redlarski.toml", "--json"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let run = Run::from(child.wait_with_output().unwrap()).ends(0);
    assert_eq!(run.err, "");
}
