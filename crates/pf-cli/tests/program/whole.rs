//! Commands that write, and whether what they wrote is whole.
#![cfg(unix)]

use crate::{Folder, animations::frames, command};
use serde_json::Value;
use std::{fs, path::Path, process::Command};

/// What is in a file before the program writes it.
pub(crate) const OLD: &str = "old";

/// A suite whose log is longer than a disk that is nearly full.
const SUITE: &str = r#"
title = "Swarms and searches"
seeds = 6
budget = { iterations = 60, evaluations = 4000 }

[[problem]]
file = "world.toml"

[[planner]]
name = "lbfgs"

[[planner]]
name = "pso"

[[planner]]
name = "aco-star"
"#;

const WORLD: &str = r#"
bounds = { min = [0, 0], max = [20, 10] }

[[robot]]
name = "one"
radius = 0.5
start = [2, 5]
goal = [18, 5]

[[circle]]
centre = [10, 5]
radius = 2
"#;

/// A folder with what commands read, and an empty one in it, `out`.
pub(crate) fn folder() -> Folder {
    let files: [(&str, &[u8]); 3] = [
        ("suite.toml", SUITE.as_bytes()),
        ("world.toml", WORLD.as_bytes()),
        ("file", b""),
    ];
    let folder = Folder::with(&files);
    fs::create_dir(folder.path("out")).expect("a folder in it");
    folder
}

impl Folder {
    /// The words of a command in which `@in` is this folder, and `@out` the one in it.
    pub(crate) fn words(&self, words: &str) -> Vec<String> {
        let word = |word: &str| {
            let word = word.replace("@out", &self.name("out"));
            word.replace("@in", &self.0.path().display().to_string())
        };
        words.split_whitespace().map(word).collect()
    }

    /// That command.
    pub(crate) fn command(&self, words: &str) -> Command {
        let words = self.words(words);
        command(&words.iter().map(String::as_str).collect::<Vec<_>>())
    }

    /// Checks that whatever is in `out` is whole, or as it was, and no temporary file.
    #[track_caller]
    pub(crate) fn is_whole(&self, words: &str) {
        for entry in fs::read_dir(self.path("out")).expect("a folder") {
            let path = entry.expect("an entry").path();
            assert!(is_whole(&path), "{words} left {}", path.display());
        }
    }
}

fn is_whole(path: &Path) -> bool {
    let bytes = fs::read(path).expect("a file");
    let text = || String::from_utf8_lossy(&bytes);
    let is_json = |line: &str| serde_json::from_str::<Value>(line).is_ok();
    if bytes == OLD.as_bytes() {
        return true;
    }
    match path.extension().and_then(|ending| ending.to_str()) {
        Some("svg") => text().starts_with("<svg ") && text().trim_end().ends_with("</svg>"),
        Some("png") => pf_io::parse_image("picture", &bytes).is_ok(),
        Some("gif") => bytes.ends_with(&[0x3B]) && !frames(path).1.is_empty(),
        Some("html") => text().trim_end().ends_with("</html>"),
        Some("json") => is_json(&text()),
        Some("jsonl") => {
            text().lines().all(is_json) && (bytes.is_empty() || bytes.ends_with(b"\n"))
        }
        Some("csv" | "1") => bytes.ends_with(b"\n"),
        _ => false,
    }
}
