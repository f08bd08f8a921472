//! Full disks and folders that cannot be written.
#![cfg(target_os = "linux")]

use crate::{
    Folder, Run,
    whole::{self, OLD},
};
use std::{fs, process::Command};

const MAP: &str = "maps/grids/redlarski/mosaic-50.map --from 1,27 --to 48,27";

/// Everything that writes: the words, in which `MAP` is a question, and files that it cannot write
/// where there is little room.
const WRITERS: &[(&str, &[&str])] = &[
    ("plan MAP --svg @out/a.svg", &["a.svg"]),
    ("plan MAP --png @out/a.png", &["a.png"]),
    (
        "replan maps/scenarios/closing-doors.toml --svg @out/a.svg",
        &["a.svg"],
    ),
    ("drive MAP --sensor 6 --png @out/a.png", &["a.png"]),
    ("walk maps/worlds/cabc-2.toml --svg @out/a.svg", &["a.svg"]),
    (
        "team maps/scenarios/three-robots.toml --evaluations 500 --svg @out/a.svg",
        &["a.svg"],
    ),
    (
        "team maps/scenarios/three-robots.toml --evaluations 500 --png @out/a.png",
        &["a.png"],
    ),
    (
        "animate MAP --frames 5 --size 240x200 -o @out/a.gif",
        &["a.gif"],
    ),
    (
        "animate MAP --frames 5 --size 240x200 -o @out/a.html",
        &["a.html"],
    ),
    ("demo --out @out", &["mosaic-dijkstra.svg", "report.html"]),
    ("bench @in/suite.toml -o @out", &[]),
    ("bench merge @in/runs -o @out", &[]),
    ("bench report @in/runs -o @out", &["report.html"]),
    ("paper faustino --runs 1 --report @out", &["report.html"]),
    (
        "tune maps/worlds/cabc-1.toml --w1 0.5,0.7 --w2 0,0.1,0.2 --w3 0,0.01 --runs 2 --fresh 2 --file @out/a.json",
        &[],
    ),
    ("man @out", &["pf.1", "pf-plan.1"]),
];

impl Folder {
    fn put(&self, words: &str) -> Run {
        let words = words.replace("MAP", MAP);
        Run::from(self.command(&words).output().expect("the program starts"))
    }
}

/// A disk that takes a block of each file and no more: an error amid a write, as on a full disk.
fn with_little_room(folder: &Folder, words: &str) -> Run {
    let limit = "trap '' XFSZ; ulimit -f 1; exec \"$0\" \"$@\"";
    let mut shell = Command::new("sh");
    shell.args(["-c", limit, env!("CARGO_BIN_EXE_pf")]);
    shell.args(folder.words(&words.replace("MAP", MAP)));
    let output = shell.current_dir(crate::root()).output();
    Run::from(output.expect("a shell starts"))
}

#[test]
fn a_full_disk_is_an_error_with_the_path_and_what_was_there_stays() {
    for (words, names) in WRITERS {
        let folder = whole::folder();
        if words.contains("@in/runs") {
            folder.put("bench @in/suite.toml -o @in/runs").ends(0);
        }
        for name in *names {
            fs::write(folder.path(&format!("out/{name}")), OLD).expect("a file");
        }
        let run = with_little_room(&folder, words).ends(1);
        let file = run.err.find(&folder.name("out")).map(|at| &run.err[at..]);
        let file = file.unwrap_or_else(|| panic!("{words}: no path in {}", run.err));
        assert!(
            file.contains("cannot be written: File too large"),
            "{words}: {file}"
        );
        folder.is_whole(words);
        for name in *names {
            let now = fs::read(folder.path(&format!("out/{name}"))).expect("it was there");
            assert_eq!(now, OLD.as_bytes(), "{words}: {name}");
        }
    }
}

/// Whatever a folder holds, by name.
fn content(folder: &Folder, name: &str) -> Vec<(std::ffi::OsString, Vec<u8>)> {
    let entries = fs::read_dir(folder.path(name)).expect("a folder");
    let mut all: Vec<_> = entries
        .map(|entry| entry.expect("an entry"))
        .map(|entry| (entry.file_name(), fs::read(entry.path()).expect("a file")))
        .collect();
    all.sort();
    all
}

#[test]
fn what_was_done_before_the_disk_was_full_is_not_done_again() {
    let folder = whole::folder();
    with_little_room(&folder, "bench @in/suite.toml -o @out").ends(1);
    let done = content(&folder, "out");
    let [(name, log)] = &done[..] else {
        panic!("{done:?}")
    };
    assert_eq!(name, "runs.jsonl");
    let lines = String::from_utf8_lossy(log).lines().count();
    assert!(lines > 0, "a block holds a run");
    let run = folder.put("bench @in/suite.toml -o @out").ends(0);
    assert!(
        run.out.contains(&format!("{lines} were there already")),
        "{}",
        run.out
    );
    folder.put("bench @in/suite.toml -o @in/whole").ends(0);
    let results = |name: &str| fs::read(folder.path(&format!("{name}/results.jsonl")));
    assert_eq!(
        results("out").expect("results"),
        results("whole").expect("results")
    );
}

#[test]
fn a_merge_that_finds_no_room_changes_and_leaves_nothing() {
    let folder = whole::folder();
    folder
        .put("bench @in/suite.toml -o @in/first --shard 1/2")
        .ends(0);
    folder
        .put("bench @in/suite.toml -o @in/second --shard 2/2")
        .ends(0);
    let before = content(&folder, "second");
    with_little_room(&folder, "bench merge @in/first @in/second -o @in/second").ends(1);
    assert!(content(&folder, "second") == before);
    with_little_room(&folder, "bench merge @in/first @in/second -o @out").ends(1);
    assert_eq!(content(&folder, "out"), []);
}

#[test]
fn a_folder_that_cannot_be_written_is_named() {
    for (words, _) in WRITERS {
        let folder = whole::folder();
        if words.contains("@in/runs") {
            folder.put("bench @in/suite.toml -o @in/runs").ends(0);
        }
        // No permission keeps the superuser out, but in a file nobody can write files.
        let run = folder.put(&words.replace("@out", "@in/file/out")).ends(1);
        let place = folder.name("file/out");
        assert!(
            run.err.contains(&place),
            "{words}: no {place} in {}",
            run.err
        );
        assert!(run.err.contains("cannot be"), "{words}: {}", run.err);
        assert_eq!(fs::read(folder.path("file")).expect("a file"), b"");
    }
}

#[test]
fn a_full_disk_under_standard_output_is_an_error() {
    let folder = whole::folder();
    folder.put("bench @in/suite.toml -o @in/runs").ends(0);
    let rows = b"version 1\n0\tm.map\t3\t2\t0\t0\t2\t0\t2\n";
    fs::write(folder.path("m.map"), crate::movingai("... ...")).expect("a file");
    fs::write(folder.path("m.scen"), rows).expect("a file");
    for words in [
        "--help",
        "--version",
        "help plan",
        "plan MAP",
        "plan MAP --json",
        "plan @in/m.map --scen @in/m.scen",
        "plan @in/m.map --scen @in/m.scen --json",
        "replan maps/scenarios/closing-doors.toml",
        "drive MAP --sensor 6",
        "walk maps/worlds/cabc-2.toml",
        "team maps/scenarios/three-robots.toml --evaluations 500",
        "team maps/scenarios/three-robots.toml --evaluations 500 --json",
        "demo --out @out",
        "bench @in/suite.toml -o @in/runs",
        "bench merge @in/runs -o @out",
        "bench report @in/runs -o @out",
        "paper faustino --runs 1",
        "paper faustino --runs 1 --json",
        "tune maps/worlds/cabc-1.toml --w1 0.5 --w2 0 --w3 0 --runs 1 --fresh 1",
        "tune maps/worlds/cabc-1.toml --w1 0.5 --w2 0 --w3 0 --runs 1 --fresh 1 --json",
        "planners",
        "planners --json",
        "completions bash",
        "man @out",
    ] {
        let full = fs::File::options().write(true).open("/dev/full");
        let mut pf = folder.command(&words.replace("MAP", MAP));
        pf.stdout(full.expect("a full disk"));
        let run = Run::from(pf.output().expect("the program starts"));
        assert_eq!(run.code, 1, "{words}: {}", run.err);
        assert!(
            run.err.contains("standard output: No space left"),
            "{words}: {}",
            run.err
        );
        folder.is_whole(words);
    }
}
