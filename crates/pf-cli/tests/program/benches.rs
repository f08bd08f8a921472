//! `pf bench`: suites, in one go, in pieces, and what is said of them.

use crate::{Folder, Run, command, movingai, pf};
use std::{fs, path::Path};

/// Swarms and searches on a grid and in a world, and a team that not all plan for: 40 runs.
const SUITE: &str = r#"
title = "A little of everything"
seeds = 3
budget = { iterations = 20, evaluations = 400 }

[[problem]]
name = "hall"
file = "hall.map"
from = [0, 0]
to = [9, 4]

[[problem]]
file = "yard.toml"

[[problem]]
name = "pair"
team = "yard.toml"

[[planner]]
name = "astar"
seeds = 1
budget = {}

[[planner]]
name = "rfd-star"
set = { drops = [5, 10] }

[[planner]]
name = "pso"

[[planner]]
name = "moabc"
problems = ["pair"]
"#;

const WORLD: &str = r#"
bounds = { min = [0, 0], max = [20, 10] }

[[robot]]
name = "left"
radius = 0.5
start = [2, 5]
goal = [18, 5]

[[robot]]
name = "right"
radius = 0.5
start = [18, 4]
goal = [2, 6]

[[circle]]
centre = [10, 5]
radius = 2
"#;

const HALL: &str = "
    ..........
    .########.
    ..........
    .##.#####.
    ..........";

fn folder(suite: &str) -> Folder {
    let files: [(&str, &[u8]); 3] = [
        ("s.toml", suite.as_bytes()),
        ("hall.map", &movingai(HALL)),
        ("yard.toml", WORLD.as_bytes()),
    ];
    Folder::with(&files)
}

impl Folder {
    /// Runs the suite into a folder beside it.
    #[track_caller]
    fn bench(&self, out: &str, more: &[&str]) -> Run {
        let (suite, out) = (self.name("s.toml"), self.name(out));
        pf(&[&["bench", &suite, "-o", &out], more].concat())
    }

    fn text(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).expect("a file of results")
    }

    fn names(&self, name: &str) -> Vec<String> {
        let entries = fs::read_dir(self.path(name)).expect("a folder");
        let name = |entry: std::io::Result<fs::DirEntry>| {
            let name = entry.expect("an entry").file_name();
            name.to_string_lossy().into_owned()
        };
        let mut names: Vec<_> = entries.map(name).collect();
        names.sort();
        names
    }

    #[track_caller]
    fn same(&self, one: &str, other: &str) {
        for file in ["results.jsonl", "results.csv"] {
            let [one, other] = [one, other].map(|out| self.text(&format!("{out}/{file}")));
            assert_eq!(one, other, "{file}");
        }
    }
}

#[test]
fn threads_shards_and_merging_change_nothing() {
    let folder = folder(SUITE);
    let run = folder.bench("one", &[]).ends(0);
    assert!(run.out.contains("s: 43 runs"), "{}", run.out);
    assert_eq!(folder.text("one/results.jsonl").lines().count(), 43);
    assert_eq!(folder.text("one/times.csv").lines().count(), 44);
    folder.bench("two", &["--threads", "2"]).ends(0);
    folder.same("one", "two");
    let mut merge = vec!["bench".to_owned(), "merge".to_owned()];
    for part in 1..=4 {
        let (out, shard) = (format!("part-{part}"), format!("{part}/4"));
        folder.bench(&out, &["--shard", &shard]).ends(0);
        merge.push(folder.name(&out));
    }
    merge.extend(["-o".to_owned(), folder.name("merged")]);
    let words: Vec<&str> = merge.iter().map(String::as_str).collect();
    pf(&words).ends(0);
    folder.same("one", "merged");
    // What a folder holds is not lost to a merge of others.
    let over = [
        "bench",
        "merge",
        &folder.name("merged"),
        "-o",
        &folder.name("one"),
    ];
    pf(&over).ends(2).says(&["holds runs that are not merged"]);
    // What is merged is a folder like any other: all is there already.
    let run = folder.bench("merged", &[]).ends(0);
    assert!(run.out.contains("43 were there already"), "{}", run.out);
    folder.same("one", "merged");
}

#[test]
fn what_is_there_is_not_run_again_and_a_torn_line_is_dropped() {
    let folder = folder(SUITE);
    folder.bench("whole", &[]).ends(0);
    folder.bench("cut", &[]).ends(0);
    // As if killed while the eleventh line was written.
    let log = folder.text("cut/runs.jsonl");
    let kept: usize = log.split_inclusive('\n').take(10).map(str::len).sum();
    let cut = &log[..kept + 40];
    for name in ["results.jsonl", "results.csv", "times.csv"] {
        fs::remove_file(folder.path(&format!("cut/{name}"))).expect("it was there");
    }
    fs::write(folder.path("cut/runs.jsonl"), cut).expect("a shorter log");
    let run = folder.bench("cut", &[]).ends(0);
    assert!(run.out.contains("10 were there already"), "{}", run.out);
    let again = folder.text("cut/runs.jsonl");
    assert!(
        again.starts_with(&log[..kept]),
        "the first ten were run again"
    );
    folder.same("whole", "cut");
    // Nothing is left of the torn line.
    let run = folder.bench("cut", &[]).ends(0);
    assert!(run.out.contains("43 were there already"), "{}", run.out);
}

#[cfg(unix)]
#[test]
fn ctrl_c_keeps_what_is_done_and_the_same_command_goes_on() {
    use crate::press_ctrl_c;
    use std::process::Stdio;
    // Runs of some milliseconds, and many of them.
    let suite = SUITE
        .replace("iterations = 20, ", "iterations = 400, ")
        .replace("seeds = 3", "seeds = 12");
    let folder = folder(&suite);
    let args = ["bench", &folder.name("s.toml"), "-o", &folder.name("out")];
    let child = command(&args)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let log = folder.path("out/runs.jsonl");
    while !fs::metadata(&log).is_ok_and(|facts| facts.len() > 0) {
        std::thread::yield_now();
    }
    press_ctrl_c(&child);
    let run = Run::from(child.wait_with_output().unwrap()).ends(130);
    assert!(run.out.contains("the same command goes on"), "{}", run.out);
    assert_eq!(folder.names("out"), ["runs.jsonl"]);
    let done = folder.text("out/runs.jsonl").lines().count();
    assert!(done >= 1 && folder.text("out/runs.jsonl").ends_with('\n'));
    let run = folder.bench("out", &["--threads", "2"]).ends(0);
    let there = format!("{done} were there already");
    assert!(run.out.contains(&there), "{}", run.out);
    folder.bench("whole", &["--threads", "2"]).ends(0);
    folder.same("whole", "out");
}

#[test]
fn who_declines_is_named_and_the_run_goes_on() {
    let folder = folder(SUITE);
    let run = folder.bench("out", &[]).ends(0);
    // On the pair: A*, two kinds of rivers, and particles, which plan for one robot.
    assert!(run.out.contains("10 were declined"), "{}", run.out);
    let results = folder.text("out/results.csv");
    let line = results
        .lines()
        .find(|line| line.starts_with("s,pair,team,pso,,0,declined"));
    assert!(
        line.is_some_and(|line| line.contains("pso does not plan for teams")),
        "{results}"
    );
    let found = results
        .lines()
        .filter(|line| line.contains(",moabc,"))
        .count();
    assert_eq!(found, 3);
}

#[test]
fn results_of_something_else_are_not_mixed_in() {
    let folder = folder(SUITE);
    folder.bench("out", &[]).ends(0);
    let more = SUITE.replace("seeds = 3", "seeds = 4");
    fs::write(folder.path("s.toml"), more).unwrap();
    let run = folder.bench("out", &[]).ends(0);
    // More seeds of the same are fine: the others are there.
    assert!(
        run.out.contains("56 runs, 43 were there already"),
        "{}",
        run.out
    );
    let other = SUITE.replace("iterations = 20", "iterations = 21");
    fs::write(folder.path("s.toml"), other).unwrap();
    folder
        .bench("out", &[])
        .ends(2)
        .says(&["are of another suite, or of another version", "--fresh"]);
    folder.bench("other", &[]).ends(0);
    let (out, other, merged) = (folder.name("out"), folder.name("other"), folder.name("m"));
    pf(&["bench", "merge", &out, &other, "-o", &merged])
        .ends(2)
        .says(&[
            "results that do not go together",
            "different versions of the suite",
        ]);
    assert!(!Path::new(&merged).exists());
    folder.bench("out", &["--fresh"]).ends(0);
    folder.same("other", "out");
}

/// Checks that a suite in which something is replaced is refused in these words.
#[track_caller]
fn refused(cases: &[(&str, &str, &str)]) {
    for (from, to, words) in cases {
        assert!(SUITE.contains(from), "{from}");
        let all = if *from == "[[planner]]" { 9 } else { 1 };
        let folder = folder(&SUITE.replacen(from, to, all));
        let run = folder.bench("out", &[]).ends(3);
        assert!(run.err.contains("s.toml:"), "{}", run.err);
        run.says(&[words]);
        assert!(!folder.path("out").exists(), "{to} left a folder");
    }
}

#[test]
fn a_wrong_word_in_a_suite_is_named_with_the_near_miss() {
    refused(&[
        (
            "seeds = 3",
            "seedz = 3",
            ":3:1: found the key \"seedz\", expected \"seeds\"",
        ),
        (
            "seeds = 3",
            "seeds = 0",
            "expected how many seeds, from 1 to 1000000",
        ),
        (
            "seeds = 3",
            "seeds = [1, 2, 1]",
            "expected a seed that is not in the list yet",
        ),
        (
            "seeds = 3",
            "seeds = 99999999999999999999",
            "how many seeds",
        ),
        (
            "\"rfd-star\"",
            "\"rfd-sta\"",
            ":25:8: found \"\\\"rfd-sta\\\"\", expected \"rfd-star\"",
        ),
        (
            "\"rfd-star\"",
            "\"quux\"",
            "expected one of dijkstra, astar",
        ),
        (
            "drops =",
            "drop =",
            ":26:9: found the key \"drop\", expected \"drops\"",
        ),
        (
            "[5, 10]",
            "[5, \"many\"]",
            "found \"\\\"many\\\"\", expected a value of type usize",
        ),
        ("[5, 10]", "[]", "expected one value at least"),
    ]);
}

#[test]
fn a_wrong_value_in_a_suite_is_named_with_what_was_expected() {
    refused(&[
        (
            "iterations = 20",
            "iterations = 0",
            "expected iterations: a whole number from 1",
        ),
        ("iterations = 20", "time = \"soon\"", "a time such as"),
        (
            "\"hall.map\"",
            "\"hal.map\"",
            "expected a file that can be read",
        ),
        (
            "to = [9, 4]",
            "to = [10, 4]",
            "cells inside the map of 10 x 5",
        ),
        ("to = [9, 4]", "", "no \"to\""),
        (
            "to = [9, 4]",
            "to = [9, 4]\nmoves = \"diagonal\"",
            "one of orthogonal",
        ),
        (
            "\"pair\"\nteam",
            "\"hall\"\nteam",
            "a second problem called",
        ),
        (
            "[\"pair\"]",
            "[\"pear\"]",
            "found \"\\\"pear\\\"\", expected \"pair\"",
        ),
        (
            "file = \"yard.toml\"",
            "file = \"yard.toml\"\ncase = \"lift\"",
            "expected \"left\"",
        ),
        (
            "name = \"pso\"",
            "name = \"astar\"",
            "a \"variant\" that no other entry",
        ),
        ("[[planner]]", "[[planer]]", "expected \"planner\""),
        ("title = \"A", "title = A", "broken TOML"),
    ]);
    let folder = folder(SUITE);
    folder
        .bench("out", &["--shard", "5/4"])
        .ends(2)
        .says(&["i from 1 to n"]);
    fs::write(folder.path("file"), "").unwrap();
    folder
        .bench("file", &[])
        .ends(1)
        .says(&[&folder.name("file"), "cannot be made"]);
}

#[test]
fn a_line_that_is_no_result_is_named() {
    let folder = folder(SUITE);
    folder.bench("out", &[]).ends(0);
    let log = folder.text("out/runs.jsonl");
    let broken = log.replacen("\"seed\":", "\"sead\":", 1);
    fs::write(folder.path("out/runs.jsonl"), broken).unwrap();
    folder
        .bench("out", &[])
        .ends(3)
        .says(&["runs.jsonl:1: found a line that is no result"]);
    let (out, report) = (folder.name("out"), folder.name("report"));
    pf(&["bench", "report", &out, "-o", &report])
        .ends(3)
        .says(&["runs.jsonl:1"]);
    let none = folder.name("none");
    pf(&["bench", "report", &none, "-o", &report])
        .ends(3)
        .says(&[&none, "cannot be read"]);
    assert!(!folder.path("report").exists());
}

#[test]
fn a_report_is_a_page_tables_and_pictures() {
    let folder = folder(SUITE);
    folder.bench("out", &[]).ends(0);
    let (out, report) = (folder.name("out"), folder.name("report"));
    let run = pf(&["bench", "report", &out, "-o", &report]).ends(0);
    for words in [
        "Contenders, over all problems",
        "By problem",
        "p (Holm)",
        "rfd-star drops=10",
    ] {
        assert!(run.out.contains(words), "no {words:?} in {}", run.out);
    }
    let names = folder.names("report");
    for name in [
        "report.html",
        "success.svg",
        "ecdf-evaluations.png",
        "pairs.csv",
        "time.png",
    ] {
        assert!(
            names.iter().any(|known| known == name),
            "no {name} in {names:?}"
        );
    }
    let page = folder.text("report/report.html");
    assert!(page.starts_with("<!doctype html>") && page.ends_with("</html>\n"));
    for outside in ["<script", "src=", "href=", "url("] {
        assert!(!page.contains(outside), "the page needs {outside}");
    }
    // Twice the same, byte by byte.
    let again = folder.name("again");
    pf(&["bench", "report", &out, "-o", &again]).ends(0);
    assert_eq!(page, folder.text("again/report.html"));
}

#[test]
fn the_suites_that_come_along_are_sound() {
    let suites = fs::read_dir(crate::root().join("maps/suites")).expect("a folder of suites");
    let mut count = 0;
    for suite in suites {
        let path = suite.expect("an entry").path();
        let out = Folder::with(&[]);
        let suite = path.display().to_string();
        let run = pf(&["bench", &suite, "-o", &out.name("out"), "--shard", "1/20"]).ends(0);
        assert!(
            !run.out.contains("panicked") && !run.out.contains("judge"),
            "{}",
            run.out
        );
        let log = out.text("out/runs.jsonl");
        assert!(!log.contains("not repeatable"), "{log}");
        count += 1;
    }
    assert!(count >= 3);
}
