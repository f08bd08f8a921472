//! `pf paper`.

use crate::{Folder, pf};

#[test]
fn a_row_per_planner_and_table_with_the_papers_numbers_beside_ours() {
    let folder = Folder::with(&[]);
    let out = folder.name("report");
    let run = pf(&[
        "paper",
        "redlarski",
        "--runs",
        "2",
        "--only",
        "mosaic-20",
        "--json",
        "--report",
        &out,
    ])
    .ends(0);
    let rows: Vec<serde_json::Value> = run
        .out
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    let planners = rows.len() / 5;
    assert!(planners >= 9 && rows.len() == 5 * planners);
    let row = |planner: &str, table: u64| {
        let of = |row: &&serde_json::Value| row["planner"] == planner && row["table"] == table;
        rows.iter().find(of).unwrap()
    };
    for table in 1..=5 {
        for planner in ["dijkstra", "astar", "d-star-lite", "rfd-exact", "rfd-field"] {
            let rate = &row(planner, table)["measured"]["optimal_rate"];
            assert_eq!(rate, 1.0, "{planner} in table {table}");
        }
        assert_eq!(row("astar", table)["reproduced"], true);
        assert!(row("rfd-exact", table)["reproduced"].is_null());
    }
    let rfd = row("rfd", 1);
    // A walk with its loops is no shorter than what is left of it.
    let walks = rfd["measured"]["walk_lengths"].as_array().unwrap();
    assert!(walks.len() == 2 && walks[0].as_f64() >= rfd["measured"]["lengths"]["least"].as_f64());
    assert_eq!(
        row("astar", 1)["measured"]["walk_lengths"],
        serde_json::json!([])
    );
    assert_eq!(rfd["paper"], "redlarski");
    assert_eq!(rfd["case"], "mosaic-20");
    assert_eq!(rfd["variant"], "paper");
    assert_eq!(rfd["published"]["length"], 30.21);
    assert!(rfd["measured"]["time_us"].as_f64().unwrap() > 0.0);
    assert_eq!(row("rfd-star", 3)["published"]["says"], "optimal");
    assert!(row("rfd-star", 2)["reproduced"].is_null());

    let page = std::fs::read_to_string(format!("{out}/report.html")).unwrap();
    assert!(page.contains("Table 5") && page.contains("<svg"));
    for figure in [
        "fig1-probability",
        "fig3-maze-100",
        "fig6-alley-20",
        "altitudes-maze-50",
        "altitude-field-maze-50",
    ] {
        let png = std::fs::read(format!("{out}/{figure}.png")).unwrap();
        assert!(png.starts_with(b"\x89PNG"), "{figure}");
    }
}

#[test]
fn what_there_is_none_of_is_refused_by_name_with_what_there_is() {
    let folder = Folder::with(&[]);
    let report = folder.name("report");
    for (words, says) in [
        (
            "redlarski --only swamp",
            &["no map's name contains `swamp`", "maze-100"][..],
        ),
        (
            "redlarski --only maze-10O",
            &["did you mean `maze-100`?", "mosaic-20"],
        ),
        (
            "wang --only NONSENSE",
            &["no problem's name contains `NONSENSE`", "three-discs"],
        ),
        (
            "wang --only thre-discs",
            &["did you mean `three-discs`?", "concave"],
        ),
    ] {
        let words: Vec<&str> = words.split(' ').collect();
        pf(&[&["paper"], &words[..], &["--report", &report]].concat())
            .ends(2)
            .says(says);
        assert!(!folder.path("report").exists(), "{words:?} left a folder");
    }
}
