//! What goes wrong, and how it is told.

use crate::{Folder, malformed, map, pf};
use std::fs;

#[test]
fn usage_errors_end_with_2_and_say_what_would_be_right() {
    let folder = map("... ...");
    let file = folder.name("m.map");
    let plan = |more: &[&str]| pf(&[&["plan", &file], more].concat()).ends(2);
    let ends = ["--from", "0,0", "--to", "2,1"];
    let with = |more: &[&str]| plan(&[&ends, more].concat());
    plan(&[]).says(&["--from and --to are missing", "3 x 2 cells"]);
    plan(&["--from", "0,0"]).says(&["--to is missing"]);
    plan(&["--from", "0,0", "--to", "3,1"]).says(&["--to 3,1 lies outside", "3 x 2 cells"]);
    plan(&["--from", "0", "--to", "2,1"]).says(&["--from", "a cell is written x,y"]);
    with(&["--planner", "a-star"]).says(&["`a-star`", "did you mean `astar`?", "d-star-lite"]);
    with(&["--planner", "xyzzy"]).says(&["`xyzzy`", "dijkstra, astar, d-star-lite"]);
    with(&["--set", "neerest=true"]).says(&["`neerest`", "known: nearest"]);
    with(&["--set", "nearest=7"]).says(&["`nearest`", "`7`", "bool"]);
    with(&["--set", "nearest"]).says(&["key=value"]);
    with(&["--moves", "sideways"]).says(&["no-corner-cutting"]);
    with(&["--radius", "-1"]).says(&["radius"]);
    with(&["--time", "soon"]).says(&["--time"]);
    with(&["--unknown", "maybe"]).says(&["free or blocked"]);
    with(&["--threads", "0"]).says(&["--threads"]);
    with(&["--case", "a"]).says(&["not a scenario"]);
    with(&["--scen", &file]).says(&["--scen", "cannot be used with"]);
    plan(&["--limit", "3"]).says(&["--scen"]);
    pf(&["replan", &file])
        .ends(2)
        .says(&["no scenario", "pf plan"]);
    pf(&["fly"]).ends(2).says(&["fly"]);
}

#[test]
fn cases_are_chosen_by_name() {
    let file = "maps/scenarios/redlarski.toml";
    let one = ["plan", file, "--case", "maze-20 table 1", "--json"];
    assert_eq!(pf(&one).ends(0).json().len(), 1);
    let wrong = ["plan", file, "--case", "maze-20"];
    pf(&wrong)
        .ends(2)
        .says(&["no case `maze-20`", "maze-20 table 1"]);
    let folder = Folder::with(&[]);
    let svg = folder.name("a.svg");
    pf(&["plan", file, "--svg", &svg]).ends(2).says(&["--case"]);
    assert!(!folder.path("a.svg").exists());
}

#[test]
fn a_missing_file_is_named() {
    let args = ["plan", "no/such.map", "--from", "0,0", "--to", "1,1"];
    pf(&args).ends(3).says(&["no/such.map", "No such file"]);
    pf(&["replan", "no/such.toml"])
        .ends(3)
        .says(&["no/such.toml"]);
}

#[test]
fn the_faulty_line_is_shown() {
    let map = b"type octile\nheigth 2\nwidth 3\nmap\n...\n...\n";
    let folder = Folder::with(&[("m.map", map)]);
    let file = folder.name("m.map");
    let run = pf(&["plan", &file, "--from", "0,0", "--to", "1,1"]).ends(3);
    run.says(&[&format!("{file}:2:1"), "heigth 2", "height"]);
}

#[test]
fn every_malformed_input_ends_with_3_and_names_the_file() {
    let inputs = malformed::all();
    assert!(inputs.len() >= 40);
    let sound = crate::movingai(".... .... ....");
    for input in &inputs {
        let folder = Folder::with(&[("sound.map", &sound), (input.file, &input.bytes)]);
        for (name, bytes) in &input.beside {
            fs::write(folder.path(name), bytes).unwrap();
        }
        let file = folder.name(input.file);
        let sound = folder.name("sound.map");
        let run = match input.extension() {
            "toml" => pf(&["replan", &file, "--json"]),
            "scen" => pf(&["plan", &sound, "--scen", &file, "--json"]),
            _ => pf(&["plan", &file, "--from", "0,0", "--to", "0,0", "--json"]),
        };
        let guilty = folder.name(input.guilty);
        run.ends(3).says(&[&guilty]).says(input.words);
    }
}

#[test]
fn what_cannot_be_written_leaves_nothing_behind() {
    let folder = map("... ...");
    let file = folder.name("m.map");
    let svg = folder.name("no/such/folder.svg");
    let args = ["plan", &file, "--from", "0,0", "--to", "2,1", "--svg", &svg];
    let run = pf(&args).ends(1);
    assert!(run.err.contains("folder.svg"), "{}", run.err);
    assert_eq!(fs::read_dir(folder.0.path()).unwrap().count(), 1);
}
