//! This program under an allocator that counts, which stands beside it.

use std::{env, path::Path, process::Command};

const PROGRAM: &str = "pf-bench-allocations";

/// What it prints when it is run with the same arguments; `None` if it is not there or fails.
pub(crate) fn said() -> Option<String> {
    let beside = env::current_exe().ok()?.with_file_name(Path::new(PROGRAM));
    let program = beside.with_extension(env::consts::EXE_EXTENSION);
    let output = Command::new(program)
        .args(env::args_os().skip(1))
        .output()
        .ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then_some(text)
}
