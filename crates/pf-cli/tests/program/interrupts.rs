//! Ctrl-C and readers that go away.
#![cfg(unix)]

use crate::{Folder, Run, command, movingai, press_ctrl_c, whole};
use std::{
    fs,
    io::{BufRead, BufReader, Read},
    process::{ExitStatus, Stdio},
    thread,
    time::Duration,
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
    press_ctrl_c(&child);
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

/// Everything that writes and takes long, or for ever.
const LONG: &[&str] = &[
    "animate maps/grids/redlarski/mosaic-50.map --from 1,27 --to 48,27 --frames 2000 -o @out/a.gif",
    "animate maps/scenarios/yard-traffic.toml --frames 5000 -o @out/a.html",
    "animate maps/grids/redlarski/mosaic-50.map --from 1,27 --to 48,27 --planner rfd-star --set patience=0 --set iterations=1000000000 -o @out/a.gif",
    "demo --out @out",
    "paper faustino --runs 20 --report @out",
    "paper redlarski --report @out",
    "walk maps/worlds/cabc-2.toml --set memory=0 --set steps=1000000000 --svg @out/a.svg --png @out/a.png",
    "team maps/scenarios/three-robots.toml --evaluations 1000000000 --svg @out/a.svg --png @out/a.png",
];

/// When Ctrl-C is pressed, in milliseconds.
const MOMENTS: [u64; 5] = [10, 60, 150, 300, 600];

/// Starts a command and presses Ctrl-C at a moment: once, or again right after.
#[track_caller]
fn interrupted(folder: &Folder, words: &str, moment: u64, twice: bool) -> ExitStatus {
    let mut pf = folder.command(words);
    let pf = pf.stdout(Stdio::null()).stderr(Stdio::piped());
    let mut child = pf.spawn().expect("the program starts");
    thread::sleep(Duration::from_millis(moment));
    press_ctrl_c(&child);
    if twice {
        thread::sleep(Duration::from_millis(3));
        press_ctrl_c(&child);
    }
    let mut looks = 0;
    let status = loop {
        if let Some(status) = child.try_wait().expect("it can be looked at") {
            break status;
        }
        thread::sleep(Duration::from_millis(5));
        looks += 1;
        // Where a shell in the background ignores Ctrl-C, so does the program until it listens.
        if looks % 1000 == 0 {
            press_ctrl_c(&child);
        }
    };
    let mut said = String::new();
    let mut err = child.stderr.take().expect("its messages");
    err.read_to_string(&mut said).expect("text");
    assert!(!said.contains("panicked"), "{words}: {said}");
    // It may have been faster, or not yet have listened.
    let ended = matches!(status.code(), Some(130 | 0) | None);
    assert!(ended, "{words}, after {moment} ms: {status}, {said}");
    status
}

#[test]
fn ctrl_c_at_any_moment_leaves_whole_files_or_none() {
    // All at a time: the more are at work, the less is known of where they are.
    thread::scope(|scope| {
        for words in LONG {
            scope.spawn(move || {
                for (moment, twice) in MOMENTS.map(|at| [(at, false), (at, true)]).concat() {
                    let folder = whole::folder();
                    interrupted(&folder, words, moment, twice);
                    folder.is_whole(words);
                }
            });
        }
    });
}

#[test]
fn the_first_ctrl_c_ends_what_only_draws_and_writes() {
    let folder = whole::folder();
    let bench = folder.command("bench @in/suite.toml -o @in/runs").output();
    Run::from(bench.expect("the program starts")).ends(0);
    for words in [
        "bench report @in/runs -o @out",
        "paper redlarski --only mosaic-20 --runs 1 --report @out",
    ] {
        let mut pf = folder.command(words);
        let pf = pf.stdout(Stdio::piped()).stderr(Stdio::piped());
        let child = pf.spawn().expect("the program starts");
        let begun =
            || fs::read_dir(folder.path("out")).is_ok_and(|mut files| files.next().is_some());
        while !begun() {
            thread::yield_now();
        }
        press_ctrl_c(&child);
        let run = Run::from(child.wait_with_output().expect("its end")).ends(130);
        assert_eq!(run.out, "", "{words}");
        assert!(!folder.path("out/report.html").exists(), "{words} went on");
        folder.is_whole(words);
        fs::remove_dir_all(folder.path("out")).expect("a folder");
        fs::create_dir(folder.path("out")).expect("a folder");
    }
}

#[test]
fn what_is_interrupted_again_and_again_comes_to_the_same_in_the_end() {
    let folder = whole::folder();
    let last = |words: &str| {
        let output = folder.command(words).output();
        Run::from(output.expect("the program starts")).ends(0).out
    };
    let tune = "tune maps/worlds/cabc-1.toml --w1 0.5:1.2:0.1 --w3 0,0.03 --runs 6 --fresh 20";
    for words in [
        &format!("{tune} --file @out/tune.json"),
        "bench @in/suite.toml -o @out",
    ] {
        for (k, moment) in MOMENTS.into_iter().enumerate() {
            interrupted(&folder, words, moment, k % 2 == 1);
            folder.is_whole(words);
        }
    }
    assert_eq!(last(&format!("{tune} --file @out/tune.json")), last(tune));
    last("bench @in/suite.toml -o @out --threads 2");
    last("bench @in/suite.toml -o @in/whole");
    for name in ["results.jsonl", "results.csv"] {
        let [out, whole] =
            ["out", "whole"].map(|at| fs::read(folder.path(&format!("{at}/{name}"))));
        assert_eq!(out.expect("results"), whole.expect("results"), "{name}");
    }
}
