//! `pf plan MAP --scen FILE`.

use crate::{Folder, movingai, pf, root};

const DRAWING: &str = "
    ....
    .##.
    ....
";

fn scen(rows: &[&str]) -> Vec<u8> {
    let rows: Vec<_> = rows.iter().map(|row| row.replace(' ', "\t")).collect();
    format!("version 1\n{}\n", rows.join("\n")).into_bytes()
}

#[track_caller]
fn check(rows: &[&str], more: &[&str], code: i32, expected: [u64; 3]) -> crate::Run {
    let folder = Folder::with(&[("m.map", &movingai(DRAWING)), ("m.scen", &scen(rows))]);
    let (map, rows) = (folder.name("m.map"), folder.name("m.scen"));
    let args = ["plan", &map, "--scen", &rows, "--json"];
    let run = pf(&[&args, more].concat()).ends(code);
    let objects = run.json();
    assert_eq!(objects.len(), 1);
    let counts =
        ["rows", "mismatches", "unsolved"].map(|key| objects[0][key].as_u64().expect("a count"));
    assert_eq!(counts, expected, "{}", run.err);
    assert!(objects[0]["total_us"].is_number() && objects[0]["median_us"].is_number());
    run
}

const RIGHT: &str = "0 m.map 4 3 0 0 3 0 3";
const DIAGONAL: &str = "0 m.map 4 3 0 0 3 2 5.00000";
const WRONG: &str = "0 m.map 4 3 0 0 0 2 2.41421";
const BLOCKED: &str = "0 m.map 4 3 0 0 1 1 1.41421";

#[test]
fn rows_are_compared_with_the_stated_optima() {
    check(&[RIGHT, DIAGONAL], &[], 0, [2, 0, 0]);
    check(&[RIGHT, WRONG, DIAGONAL], &["--limit", "1"], 0, [1, 0, 0]);
    let run = check(&[RIGHT, WRONG, BLOCKED], &[], 6, [3, 1, 1]);
    assert!(
        run.err
            .contains("m.scen:3: 0,0 to 0,2: found 2, the file says 2.41421"),
        "{}",
        run.err
    );
    check(&[RIGHT, BLOCKED], &[], 4, [2, 0, 1]);
    check(&[DIAGONAL], &["--iterations", "1"], 5, [1, 0, 1]);
    check(&[], &[], 0, [0, 0, 0]);
}

#[test]
fn rows_about_another_map_are_bad_input() {
    let rows = scen(&["0 m.map 5 3 0 0 3 0 3"]);
    let folder = Folder::with(&[("m.map", &movingai(DRAWING)), ("m.scen", &rows)]);
    let (map, rows) = (folder.name("m.map"), folder.name("m.scen"));
    pf(&["plan", &map, "--scen", &rows])
        .ends(3)
        .says(&["m.scen:2", "5", "4 x 3"]);
}

/// A sample of the benchmark; the whole takes minutes. Reads `../shared`.
#[test]
fn the_benchmark_agrees() {
    let folder = root().join("../shared/data/movingai");
    let Ok(files) = std::fs::read_dir(&folder) else {
        println!("skipped: ../shared is missing");
        return;
    };
    let mut maps = 0;
    for file in files {
        let map = file.unwrap().path();
        if map.extension().is_none_or(|e| e != "map") {
            continue;
        }
        maps += 1;
        let (map, rows) = (map.display().to_string(), format!("{}.scen", map.display()));
        let args = ["plan", &map, "--scen", &rows, "--limit", "100", "--json"];
        let object = &pf(&args).ends(0).json()[0];
        assert_eq!(object["mismatches"], 0);
    }
    assert_eq!(maps, 10);
}
