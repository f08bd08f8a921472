//! `cargo xtask tidy`: checks what the compiler does not.
//!
//! Every rule is a pure function from what was read to what it found, so that its test can show it
//! bite.

mod arrows;
mod code;
mod documents;

use crate::{
    laws, planners,
    steps::Verdict,
    workspace::{self, root},
};
use anyhow::Result;
use std::fmt;

/// A place that breaks a rule.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Finding {
    pub(crate) rule: &'static str,
    pub(crate) file: String,
    /// From 1.
    pub(crate) line: usize,
    pub(crate) what: String,
    /// Said, but not a reason to fail.
    pub(crate) only_a_warning: bool,
}

impl Finding {
    fn new(rule: &'static str, file: &str, line: usize, what: impl Into<String>) -> Self {
        Self {
            rule,
            file: file.to_owned(),
            line,
            what: what.into(),
            only_a_warning: false,
        }
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kind = if self.only_a_warning {
            "warning"
        } else {
            "error"
        };
        let Self {
            rule,
            file,
            line,
            what,
            ..
        } = self;
        write!(f, "{kind}[{rule}] {file}:{line}: {what}")
    }
}

pub(crate) fn run() -> Result<Verdict> {
    let packages = workspace::packages(root())?;
    let sources = workspace::sources(root())?;
    let generated = [
        (laws::FILE, laws::page()?, "cargo xtask laws --write"),
        (
            planners::FILE,
            planners::page()?,
            "cargo xtask planners --write",
        ),
    ];
    let mut findings = arrows::check(&packages);
    findings.extend(code::check(&packages, &sources)?);
    findings.extend(documents::check(&packages, &sources));
    for (file, page, command) in generated {
        findings.extend(documents::fresh(file, &page, command, &sources));
    }
    for finding in &findings {
        println!("{finding}");
    }
    let (warnings, errors): (Vec<_>, Vec<_>) = findings.iter().partition(|f| f.only_a_warning);
    println!(
        "tidy: {} packages, {} files: {} errors, {} warnings",
        packages.len(),
        sources.len(),
        errors.len(),
        warnings.len()
    );
    Ok(Verdict::passed_if(errors.is_empty()))
}
