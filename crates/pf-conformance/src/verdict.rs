//! What comes out of an examination.

use crate::law::Law;
use std::fmt;

/// What one law says of one planner.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// The planner's name.
    pub planner: String,
    /// The law.
    pub law: Law,
    /// How many cases or stories it was checked on. A case the planner declines is none.
    pub cases: usize,
    /// The first breach of it, if there was one.
    pub result: Result<(), Breach>,
}

/// How a law was broken.
#[derive(Clone, Debug)]
pub struct Breach {
    /// On how many cases or stories it was.
    pub times: usize,
    /// The first of them.
    pub case: String,
    /// How.
    pub how: String,
    /// A picture of the problem, if it is small.
    pub drawing: Option<String>,
}

impl Verdict {
    /// Whether the law was kept.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.result.is_ok()
    }
}

/// One line, and where a law is broken some more: how, where, and the picture.
impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            planner,
            law,
            cases,
            result,
        } = self;
        let word = if result.is_ok() { "ok" } else { "BROKEN" };
        write!(f, "{planner:<16} {:<20} {cases:>5} cases  {word}", law.name)?;
        if let Err(breach) = result {
            write!(f, "\n{breach}")?;
        }
        Ok(())
    }
}

impl fmt::Display for Breach {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "    on `{}`: {}", self.case, self.how)?;
        if self.times > 1 {
            write!(f, "\n    ({} such in all)", self.times)?;
        }
        for row in self.drawing.iter().flat_map(|drawing| drawing.lines()) {
            write!(f, "\n        {row}")?;
        }
        Ok(())
    }
}

/// Panics if a law was broken, with the verdicts that say so.
#[track_caller]
pub(crate) fn expect_all(verdicts: &[Verdict]) {
    let broken = verdicts.iter().filter(|verdict| !verdict.passed());
    let broken: Vec<_> = broken
        .map(|verdict| format!("{verdict}\n    The law: {}", verdict.law.text))
        .collect();
    assert!(
        broken.is_empty(),
        "{} of {} laws broken:\n{}",
        broken.len(),
        verdicts.len(),
        broken.join("\n")
    );
}
