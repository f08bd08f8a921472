//! Each malformed input is refused with a message that helps, at once and without much memory.
#![expect(clippy::unwrap_used, reason = "what fails here is the test")]

#[path = "inputs/malformed.rs"]
mod inputs;
#[path = "inputs/malformed_worlds.rs"]
mod worlds;

use peak_alloc::PeakAlloc;
use pf_core::Clock;
use pf_io::{FileError, LoadOptions, load_grid, load_map, load_scenario, read_scen, read_scenario};
use std::{fs, path::Path, time::Duration};

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

const MOST_MEMORY: usize = 64_000_000;
const MOST_TIME: Duration = Duration::from_secs(1);

/// Hands a file to `read`; says what is wrong with its answer.
fn faults(
    (file, bytes): (&str, &[u8]),
    beside: &[(&'static str, Vec<u8>)],
    (guilty, words): (&str, &[&str]),
    read: impl Fn(&Path) -> Option<FileError>,
) -> Vec<String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(file);
    fs::write(&path, bytes).unwrap();
    for (name, bytes) in beside {
        fs::write(folder.path().join(name), bytes).unwrap();
    }

    let before = MEMORY.current_usage();
    MEMORY.reset_peak_usage();
    let began = Clock::default().now();
    let error = read(&path);
    let time = Clock::default().now().saturating_sub(began);
    let memory = MEMORY.peak_usage() - before;

    let Some(error) = error else {
        return vec![format!("{file} is read")];
    };
    let mut faults = Vec::new();
    let guilty = folder.path().join(guilty);
    faults.extend(fault_of_message(file, &error, &guilty, words));
    if memory > MOST_MEMORY || time > MOST_TIME {
        faults.push(format!("{file} takes {memory} bytes and {time:?}"));
    }
    faults
}

// One test, so that nothing else allocates meanwhile.
#[test]
fn malformed_inputs_are_refused_at_once_with_a_message_that_helps() {
    let (inputs, worlds) = (inputs::all(), worlds::all());
    assert!(inputs.len() >= 40 && worlds.len() >= 40);
    let mut found = Vec::new();
    for input in &inputs {
        let file = (input.file, &input.bytes[..]);
        let answer = (input.guilty, input.words);
        found.extend(faults(file, &input.beside, answer, |path| {
            match input.extension() {
                "toml" => read_scenario(path).err(),
                "scen" => read_scen(path).err(),
                _ => load_grid(path, &LoadOptions::default()).err(),
            }
        }));
    }
    for input in &worlds {
        let file = (input.file, &input.bytes[..]);
        let answer = (input.guilty, input.words);
        found.extend(faults(file, &input.beside, answer, |path| {
            if input.scenario {
                load_scenario(path).err()
            } else {
                load_map(path, &LoadOptions::default()).err()
            }
        }));
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
    println!(
        "{} malformed inputs and {} malformed worlds refused",
        inputs.len(),
        worlds.len()
    );
}

fn fault_of_message(
    file: &str,
    error: &FileError,
    guilty: &Path,
    words: &[&str],
) -> Option<String> {
    let message = error.to_string();
    let guilty = guilty.display().to_string();
    let Some(rest) = message.strip_prefix(&guilty) else {
        return Some(format!("{message} does not name {guilty}"));
    };
    if rest.len() > 300 {
        return Some(format!("{file}: {rest} is too long"));
    }
    let missing = words.iter().find(|words| !rest.contains(**words))?;
    Some(format!("{file}{rest} lacks {missing:?}"))
}
