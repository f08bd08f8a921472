//! `pf demo`.

use crate::{Folder, pf};

#[test]
fn it_compares_all_planners_and_draws() {
    let folder = Folder::with(&[]);
    let out = folder.name("pictures");
    let run = pf(&["demo", "--out", &out]).ends(0);
    for words in [
        "Dijkstra",
        "A*",
        "D* Lite",
        "visibility graph",
        "yard",
        "found",
        "length",
        "% over shortest",
        "time",
        &out,
    ] {
        assert!(run.out.contains(words), "no {words:?} in {}", run.out);
    }
    let files = std::fs::read_dir(&out).unwrap();
    let names: Vec<_> = files.map(|f| f.unwrap().file_name()).collect();
    assert!(names.contains(&"maze-astar.svg".into()), "{names:?}");
    assert!(names.contains(&"maze-astar.png".into()), "{names:?}");
    for picture in [
        "yard-astar.png",
        "yard-visibility-graph.png",
        "maze-visibility-graph.png",
    ] {
        assert!(names.contains(&picture.into()), "{names:?}");
    }
}
