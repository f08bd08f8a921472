//! `pf demo`.

use crate::{Folder, animations::needs_nothing, pf};
use std::fs;

#[test]
fn it_compares_all_planners_draws_and_writes_a_report() {
    let folder = Folder::with(&[]);
    let out = folder.name("pictures");
    let run = pf(&["demo", "--out", &out]).ends(0);
    for words in [
        "Dijkstra",
        "A*",
        "D* Lite",
        "visibility graph",
        "prioritised planning",
        "mosaic",
        "square",
        "three robots",
        "% over shortest",
        "5000 evaluations",
        "that they prepare are in their times",
        &out,
    ] {
        assert!(run.out.contains(words), "no {words:?} in {}", run.out);
    }
    let files = fs::read_dir(&out).unwrap();
    let names: Vec<_> = files.map(|f| f.unwrap().file_name()).collect();
    for picture in [
        "mosaic-astar.svg",
        "square-visibility-graph.svg",
        "report.html",
    ] {
        assert!(names.contains(&picture.into()), "{names:?}");
    }
    let page = fs::read_to_string(folder.path("pictures/report.html")).unwrap();
    assert!(page.len() <= 3_000_000, "{} bytes", page.len());
    needs_nothing(&page);
    assert!(page.contains("that they prepare are in their times"));
    // Every planner on both maps, a plan of the team, and two scenarios with a before and an after.
    assert_eq!(
        page.matches("<figure class=\"film\"").count(),
        2 * 21 + 1 + 2 * 3
    );
    assert_eq!(page.matches("<figure class=\"front\"").count(), 1);
}

#[test]
fn a_folder_that_cannot_be_made_is_named() {
    let folder = Folder::with(&[("file", b"")]);
    let out = folder.name("file/pictures");
    pf(&["demo", "--out", &out])
        .ends(1)
        .says(&[&out, "cannot be made"]);
}
