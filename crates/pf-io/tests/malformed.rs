//! Each malformed input is refused with a message that helps, at once and without much memory.

#[path = "inputs/malformed.rs"]
mod inputs;

use inputs::Malformed;
use peak_alloc::PeakAlloc;
use pf_core::Clock;
use pf_io::{FileError, LoadOptions, load_grid, read_scen, read_scenario};
use std::{fs, path::Path, time::Duration};

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

const MOST_MEMORY: usize = 64_000_000;
const MOST_TIME: Duration = Duration::from_secs(1);

// One test, so that nothing else allocates meanwhile.
#[test]
fn malformed_inputs_are_refused_at_once_with_a_message_that_helps() {
    let inputs = inputs::all();
    assert!(inputs.len() >= 40);
    let mut faults = Vec::new();
    for input in &inputs {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(input.file);
        fs::write(&path, &input.bytes).unwrap();
        for (name, bytes) in &input.beside {
            fs::write(folder.path().join(name), bytes).unwrap();
        }

        let before = MEMORY.current_usage();
        MEMORY.reset_peak_usage();
        let began = Clock::default().now();
        let error = match input.extension() {
            "toml" => read_scenario(&path).err(),
            "scen" => read_scen(&path).err(),
            _ => load_grid(&path, &LoadOptions::default()).err(),
        };
        let time = Clock::default().now().saturating_sub(began);
        let memory = MEMORY.peak_usage() - before;

        let Some(error) = error else {
            faults.push(format!("{} is read", input.file));
            continue;
        };
        faults.extend(fault_of_message(input, &error, folder.path()));
        if memory > MOST_MEMORY || time > MOST_TIME {
            faults.push(format!("{} takes {memory} bytes and {time:?}", input.file));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    println!("{} malformed inputs refused", inputs.len());
}

fn fault_of_message(input: &Malformed, error: &FileError, folder: &Path) -> Option<String> {
    let message = error.to_string();
    let guilty = folder.join(input.guilty).display().to_string();
    let Some(rest) = message.strip_prefix(&guilty) else {
        return Some(format!("{message} does not name {guilty}"));
    };
    if rest.len() > 300 {
        return Some(format!("{}: {rest} is too long", input.file));
    }
    let missing = input.words.iter().find(|words| !rest.contains(**words))?;
    Some(format!("{}{rest} lacks {missing:?}", input.file))
}
