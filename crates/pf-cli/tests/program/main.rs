//! The program as its users see it: what it prints, what it writes, how it ends.

mod animations;
mod answers;
mod benches;
mod conversions;
mod demo;
mod disks;
mod drives;
mod externals;
mod faults;
mod interrupts;
#[path = "../../../pf-io/tests/inputs/malformed.rs"]
mod malformed;
#[path = "../../../pf-io/tests/inputs/malformed_worlds.rs"]
mod malformed_worlds;
mod papers;
mod replans;
mod scens;
mod shells;
mod teams;
mod walks;
mod whole;
mod worlds;
mod worlds_in_time;

use serde_json::Value;
use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Output, Stdio},
};

/// The workspace's root: the program is run there.
fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

fn command(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_pf"));
    command.current_dir(root()).args(args).stdin(Stdio::null());
    command
}

/// Presses Ctrl-C, also of a program that has just ended.
#[cfg(unix)]
#[track_caller]
fn press_ctrl_c(child: &std::process::Child) {
    use rustix::process::{Pid, Signal, kill_process};
    kill_process(Pid::from_child(child), Signal::INT).expect("nobody has waited for it");
}

/// What a run of the program left.
struct Run {
    code: i32,
    out: String,
    err: String,
}

#[track_caller]
fn pf(args: &[&str]) -> Run {
    let output = command(args).output().expect("the program starts");
    Run::from(output)
}

impl From<Output> for Run {
    #[track_caller]
    fn from(output: Output) -> Self {
        let text = |bytes| String::from_utf8(bytes).expect("output is text");
        let run = Self {
            code: output.status.code().expect("no signal ends the program"),
            out: text(output.stdout),
            err: text(output.stderr),
        };
        assert!(!run.err.contains("panicked"), "{}", run.err);
        run
    }
}

impl Run {
    /// Checks how it ended; shows what it said if it ended otherwise.
    #[track_caller]
    fn ends(self, code: i32) -> Self {
        assert_eq!(self.code, code, "{}{}", self.out, self.err);
        self
    }

    /// Checks that it complains in these words, and that nothing else comes out.
    #[track_caller]
    fn says(self, words: &[&str]) -> Self {
        for words in words {
            assert!(self.err.contains(words), "no {words:?} in {}", self.err);
        }
        assert_eq!(self.out, "");
        self
    }

    /// The objects it printed.
    #[track_caller]
    fn json(&self) -> Vec<Value> {
        let object = |line| serde_json::from_str(line).expect("one object on one line");
        self.out.lines().map(object).collect()
    }
}

/// A folder of its own for a test, with a few files.
struct Folder(tempfile::TempDir);

impl Folder {
    fn with(files: &[(&str, &[u8])]) -> Self {
        let folder = Self(tempfile::tempdir().expect("a temporary folder"));
        for (name, bytes) in files {
            fs::write(folder.path(name), bytes).expect("a file in it");
        }
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn name(&self, name: &str) -> String {
        self.path(name).display().to_string()
    }
}

/// A Moving AI map as tests draw it.
fn movingai(drawing: &str) -> Vec<u8> {
    let rows: Vec<_> = drawing.split_whitespace().collect();
    let (width, height) = (rows[0].len(), rows.len());
    let rows = rows.join("\n").replace('#', "@");
    format!("type octile\nheight {height}\nwidth {width}\nmap\n{rows}\n").into_bytes()
}

fn map(drawing: &str) -> Folder {
    Folder::with(&[("m.map", &movingai(drawing))])
}
