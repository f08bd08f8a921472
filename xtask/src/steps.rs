//! Named steps, one after the other, each with its time.

use crate::workspace::root;
use anyhow::{Context as _, Result};
use pf_core::Clock;
use std::{ffi::OsStr, process::Command, time::Duration};

/// Whether what was checked is as it should be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[must_use]
pub(crate) enum Verdict {
    Passed,
    Failed,
}

impl Verdict {
    pub(crate) fn passed_if(passed: bool) -> Self {
        if passed { Self::Passed } else { Self::Failed }
    }
}

/// One thing a verb does, under the name its user sees.
pub(crate) struct Step {
    pub(crate) name: &'static str,
    pub(crate) run: fn() -> Result<Verdict>,
}

/// Runs the steps in their order up to the first that fails; ends in a line that says how it went.
pub(crate) fn run_all(verb: &str, steps: &[Step]) -> Result<Verdict> {
    let clock = Clock::default();
    let began = clock.now();
    let mut times = Vec::new();
    for step in steps {
        println!("\n== {verb}: {}", step.name);
        let from = clock.now();
        let verdict = (step.run)().with_context(|| format!("{verb}: {}", step.name))?;
        times.push((step.name, clock.now().saturating_sub(from)));
        if verdict == Verdict::Failed {
            println!("\ncargo xtask {verb}: FAILED at {}", step.name);
            return Ok(Verdict::Failed);
        }
    }
    println!();
    for (name, time) in &times {
        println!("  {name:14} {:>8}", in_words(*time));
    }
    println!(
        "cargo xtask {verb}: passed, {} steps in {}",
        times.len(),
        in_words(clock.now().saturating_sub(began))
    );
    Ok(Verdict::Passed)
}

fn in_words(time: Duration) -> String {
    match time.as_secs() {
        0..60 => format!("{:.1} s", time.as_secs_f64()),
        s => format!("{} min {:02} s", s / 60, s % 60),
    }
}

/// `cargo`, the one that runs us, at the workspace's root.
pub(crate) fn cargo<S: AsRef<OsStr>>(args: impl IntoIterator<Item = S>) -> Command {
    let program = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(program);
    command.args(args).current_dir(root());
    command
}

/// Runs a command to its end, its output going where ours goes.
pub(crate) fn passes(command: &mut Command) -> Result<Verdict> {
    let status = command
        .status()
        .with_context(|| format!("cannot start {}", command.get_program().display()))?;
    Ok(Verdict::passed_if(status.success()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_failing_step_is_the_last_one_run() {
        let step = |name, run| Step { name, run };
        let passes: fn() -> Result<Verdict> = || Ok(Verdict::Passed);
        let fails: fn() -> Result<Verdict> = || Ok(Verdict::Failed);
        let never: fn() -> Result<Verdict> = || anyhow::bail!("was run");
        let verdict = run_all(
            "x",
            &[step("a", passes), step("b", fails), step("c", never)],
        );
        assert_eq!(verdict.unwrap(), Verdict::Failed);
        assert_eq!(run_all("x", &[step("a", passes)]).unwrap(), Verdict::Passed);
        assert!(run_all("x", &[step("c", never)]).is_err());
    }

    #[test]
    fn times_are_read_by_people() {
        assert_eq!(in_words(Duration::from_millis(1540)), "1.5 s");
        assert_eq!(in_words(Duration::from_secs(125)), "2 min 05 s");
    }
}
