//! `pf animate`.

use crate::{Folder, Run, command, pf};
use gif::{ColorOutput, DecodeOptions};
use std::{fs, path::Path};

const MOSAIC: &[&str] = &[
    "maps/grids/redlarski/mosaic-50.map",
    "--from",
    "1,27",
    "--to",
    "48,27",
];
const SQUARE: &[&str] = &["maps/worlds/cabc-2.toml"];

/// Every sort of question, and who answers it.
const KINDS: &[(&[&str], &[&str])] = &[
    (MOSAIC, &["--planner", "astar"]),
    (MOSAIC, &["--planner", "rfd-star", "--iterations", "30"]),
    (MOSAIC, &["--planner", "rfd-field"]),
    (MOSAIC, &["--planner", "aco-star", "--iterations", "30"]),
    (MOSAIC, &["--planner", "lbfgs"]),
    (MOSAIC, &["--sensor", "6"]),
    (SQUARE, &["--planner", "pso"]),
    (SQUARE, &["--planner", "lbfgs"]),
    (SQUARE, &["--planner", "abc", "--seed", "3"]),
    (SQUARE, &["--planner", "astar", "--cell", "1"]),
    (SQUARE, &["--planner", "nsga2", "--set", "evaluations=500"]),
    (&["maps/scenarios/busy-square.toml"], &["--planner", "abc"]),
    (&["maps/scenarios/closing-doors.toml"], &[]),
    (&["maps/scenarios/yard-traffic.toml"], &[]),
    (
        &["maps/scenarios/three-robots.toml"],
        &["--evaluations", "500"],
    ),
];

fn animate(question: &[&str], more: &[&str], out: &str) -> Run {
    let verb: &[&str] = &["animate"];
    let how: &[&str] = &[
        "-o", out, "--frames", "12", "--size", "240x200", "--fps", "20",
    ];
    pf(&[verb, question, more, how].concat())
}

/// A frame as it is seen, and how long it stays, in hundredths of a second.
pub(crate) type Seen = (Vec<[u8; 4]>, u16);

/// Width and height, and every frame.
pub(crate) fn frames(path: &Path) -> ([u16; 2], Vec<Seen>) {
    let mut options = DecodeOptions::new();
    options.set_color_output(ColorOutput::RGBA);
    let mut decoder = options
        .read_info(fs::File::open(path).expect("a file"))
        .expect("a GIF");
    let (width, height) = (decoder.width(), decoder.height());
    let wide = usize::from(width);
    let mut seen = vec![[0; 4]; wide * usize::from(height)];
    let mut all = Vec::new();
    while let Some(frame) = decoder.read_next_frame().expect("whole frames") {
        let pixels = frame.buffer.as_chunks::<4>().0;
        for (k, pixel) in pixels.iter().enumerate() {
            let (x, y) = (k % usize::from(frame.width), k / usize::from(frame.width));
            let place = (y + usize::from(frame.top)) * wide + x + usize::from(frame.left);
            if pixel[3] > 0 {
                seen[place] = *pixel;
            }
        }
        all.push((seen.clone(), frame.delay));
    }
    ([width, height], all)
}

#[test]
fn every_sort_of_question_makes_as_many_frames_of_that_size_as_asked_for() {
    let folder = Folder::with(&[]);
    for (k, (question, more)) in KINDS.iter().enumerate() {
        let (name, file) = (
            folder.name(&format!("{k}.gif")),
            folder.path(&format!("{k}.gif")),
        );
        let run = animate(question, more, &name).ends(0);
        assert_eq!(run.out, "");
        assert!(run.err.contains("12 frames"), "{}", run.err);
        let (size, frames) = frames(&file);
        assert_eq!(
            (size, frames.len()),
            ([240, 200], 12),
            "{question:?} {more:?}"
        );
        // Twenty a second, and the last stays.
        assert!(frames[..11].iter().all(|(_, delay)| *delay == 5));
        assert_eq!(frames[11].1, 200);
        let pictures: std::collections::BTreeSet<_> = frames.iter().map(|(p, _)| p).collect();
        assert!(
            pictures.len() > 5,
            "{question:?} {more:?}: {} pictures",
            pictures.len()
        );
    }
}

#[test]
fn one_seed_one_film() {
    let folder = Folder::with(&[]);
    for name in ["ants.gif", "ants.html"] {
        let film = |seed: &str| {
            let more = [
                "--planner",
                "aco-star",
                "--iterations",
                "20",
                "--seed",
                seed,
            ];
            animate(MOSAIC, &more, &folder.name(name)).ends(0);
            fs::read(folder.path(name)).unwrap()
        };
        let [first, again, other] = ["1", "1", "2"].map(film);
        assert!(first == again, "{name}");
        assert!(first != other, "{name}");
    }
}

#[test]
fn a_page_needs_nothing_else_and_says_who_planned() {
    let folder = Folder::with(&[]);
    for (k, (question, more)) in KINDS.iter().enumerate().step_by(3) {
        let name = folder.name(&format!("{k}.html"));
        animate(question, more, &name).ends(0);
        let page = fs::read_to_string(&name).unwrap();
        needs_nothing(&page);
        for part in [
            "<!doctype html>",
            "type=\"range\"",
            "width=device-width",
            "seed ",
        ] {
            assert!(page.contains(part), "no {part} in {name}");
        }
    }
}

/// Nothing in a page is asked for from anywhere.
#[track_caller]
pub(crate) fn needs_nothing(page: &str) {
    let page = page.replace("http://www.w3.org/2000/svg", "");
    for part in ["http:", "https:", "src=", "url(", "@import", "fetch("] {
        assert!(!page.contains(part), "{part}");
    }
}

#[test]
fn what_cannot_be_written_is_named_before_anything_is_planned() {
    let folder = Folder::with(&[("file", b"")]);
    for name in ["nowhere/film.gif", "file/film.html"] {
        let out = folder.name(name);
        animate(MOSAIC, &[], &out)
            .ends(1)
            .says(&[&out, "cannot be written"]);
    }
    let out = folder.name("film.mp4");
    animate(MOSAIC, &[], &out)
        .ends(2)
        .says(&[&out, ".gif or .html"]);
}

#[test]
fn nonsense_is_refused() {
    let folder = Folder::with(&[]);
    let out = folder.name("film.gif");
    let refused = |args: &[&str], words: &[&str]| {
        let run = pf(&[&["animate"], args, &["-o", &out]].concat());
        run.ends(2).says(words);
        assert!(!folder.path("film.gif").exists());
    };
    refused(
        &["maps/scenarios/closing-doors.toml", "--frames", "3"],
        &["7 moments"],
    );
    refused(&[MOSAIC, &["--size", "9x9"]].concat(), &["480x360"]);
    refused(&[MOSAIC, &["--fps", "0"]].concat(), &["0.1 to 50"]);
    refused(
        &[MOSAIC, &["--planner", "atsar"]].concat(),
        &["did you mean `astar`"],
    );
    refused(
        &[SQUARE, &["--sensor", "5"]].concat(),
        &["a robot drives on a grid"],
    );
}

#[test]
fn a_question_without_a_path_is_shown_too() {
    let folder = crate::map("..... ..#.. .#.#. ..#..");
    let (map, out) = (folder.name("m.map"), folder.name("film.gif"));
    pf(&["animate", &map, "--from", "0,0", "--to", "2,2", "-o", &out]).ends(4);
    assert_eq!(frames(&folder.path("film.gif")).1.len(), 60);
}

#[cfg(unix)]
#[test]
fn ctrl_c_leaves_no_file() {
    use crate::press_ctrl_c;
    use std::{thread, time::Duration};
    let folder = Folder::with(&[]);
    let out = folder.name("film.gif");
    // It would go on for hours.
    let more = [
        "--planner",
        "rfd-star",
        "--set",
        "iterations=1000000000",
        "--set",
        "patience=0",
        "-o",
        &out,
    ];
    let child = command(&[&["animate"], MOSAIC, &more[..]].concat()).spawn();
    let mut child = child.unwrap();
    thread::sleep(Duration::from_millis(500));
    press_ctrl_c(&child);
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert_eq!(fs::read_dir(folder.path("")).unwrap().count(), 0);
}
