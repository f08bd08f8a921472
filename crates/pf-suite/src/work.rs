//! A whole suite, or a shard of it.

use crate::{
    SuiteError,
    folder::{self, Folder},
    parallel::spread,
    record::Line,
    solve::solve,
    suite::{Job, Suite},
};
use pf_core::CancelToken;
use std::{collections::BTreeMap, num::NonZeroUsize, str::FromStr};

/// One of so many parts of a suite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    part: usize,
    parts: usize,
}

impl Default for Shard {
    /// All of it.
    fn default() -> Self {
        Self { part: 1, parts: 1 }
    }
}

impl Shard {
    fn has(self, job: usize) -> bool {
        job % self.parts == self.part - 1
    }
}

impl FromStr for Shard {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let parse = || {
            let (part, parts) = text.split_once('/')?;
            let (part, parts) = (part.parse().ok()?, parts.parse().ok()?);
            (1..=parts).contains(&part).then_some(Self { part, parts })
        };
        parse().ok_or("a shard is written i/n, with i from 1 to n: 2/4")
    }
}

/// What a call of [`run`] came to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Done {
    /// The runs of the shard.
    pub asked: usize,
    /// Those that were there before.
    pub before: usize,
    /// Those that were made now.
    pub made: usize,
    /// Those among all of the shard in which a planner panicked.
    pub panicked: usize,
    /// Those whose answers did not pass the judge.
    pub refused: usize,
    /// Those in which a planner in another program did not answer as one should.
    pub failed: usize,
    /// Those that a planner declined.
    pub declined: usize,
}

impl Done {
    /// Whether nothing is left to do.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.before + self.made == self.asked
    }

    fn count(&mut self, line: &Line) {
        match line.record.outcome.as_str() {
            "panicked" => self.panicked += 1,
            "refused" => self.refused += 1,
            "declined" => self.declined += 1,
            "failed" => self.failed += 1,
            _ => {}
        }
    }
}

/// How to make the runs of a suite.
#[derive(Clone, Debug)]
pub struct Plan {
    /// How many runs are made at a time; only times depend on it.
    pub threads: NonZeroUsize,
    /// Which of them.
    pub shard: Shard,
    /// Whether to forget what the folder holds.
    pub afresh: bool,
    /// Stops; what is done is kept.
    pub cancel: CancelToken,
}

/// Makes the runs of a suite that `folder` does not hold yet. `tell` hears how many are done and how
/// many are asked for, and of each new one.
///
/// # Errors
/// [`SuiteError`] if the folder cannot be read or written, or holds results of something else.
pub fn run(
    suite: &Suite,
    folder: &std::path::Path,
    plan: &Plan,
    tell: &mut dyn FnMut(usize, usize, Option<&Line>),
) -> Result<Done, SuiteError> {
    let (mut folder, mut lines) = if plan.afresh {
        (Folder::open_afresh(folder)?, Vec::new())
    } else {
        Folder::open(folder)?
    };
    let all = suite.jobs();
    let known = places(suite, &all);
    let strange = lines.iter().filter(|line| place(&known, line).is_none());
    let strange = strange.count();
    if strange > 0 {
        return Err(SuiteError::Strange {
            runs: strange,
            of: lines.len(),
        });
    }
    let mut there = vec![false; all.len()];
    for line in &lines {
        there[place(&known, line).unwrap_or_default()] = true;
    }
    let ours = |k: &usize| plan.shard.has(*k);
    let left: Vec<usize> = (0..all.len()).filter(ours).filter(|&k| !there[k]).collect();
    let asked = (0..all.len()).filter(ours).count();
    let mut done = Done {
        asked,
        before: asked - left.len(),
        ..Done::default()
    };
    tell(done.before, asked, None);
    if !left.is_empty() {
        folder.unfinish()?;
    }
    let mut failed = None;
    let work = |k: usize| solve(suite, &all[left[k]], &plan.cancel);
    spread(plan.threads, left.len(), work, |_, line| {
        let Some(line) = line else { return false };
        // What another thread still hands over has no place after a torn line.
        if failed.is_some() {
            return false;
        }
        if let Err(error) = folder.add(&line) {
            failed = Some(error);
            return false;
        }
        done.made += 1;
        tell(done.before + done.made, asked, Some(&line));
        lines.push(line);
        !plan.cancel.is_cancelled()
    });
    if let Some(error) = failed {
        return Err(error);
    }
    for line in &lines {
        done.count(line);
    }
    if done.is_complete() {
        folder::sort(&mut lines);
        folder.finish(&lines)?;
    }
    Ok(done)
}

/// What tells a run from all others: suite, problem, planner, variant, seed and fingerprint.
type Key = [String; 6];

fn places(suite: &Suite, jobs: &[Job]) -> BTreeMap<Key, usize> {
    let key = |(k, job): (usize, &Job)| {
        let contender = &suite.contenders[job.contender];
        let key = [
            suite.name.clone(),
            suite.problems[job.problem].name.clone(),
            contender.planner.clone(),
            contender.variant.clone(),
            job.seed.to_string(),
            format!("{:016x}", job.fingerprint),
        ];
        (key, k)
    };
    jobs.iter().enumerate().map(key).collect()
}

fn place(known: &BTreeMap<Key, usize>, line: &Line) -> Option<usize> {
    let record = &line.record;
    let key = [
        record.suite.clone(),
        record.problem.clone(),
        record.planner.clone(),
        record.variant.clone(),
        record.seed.to_string(),
        record.fingerprint.clone(),
    ];
    known.get(&key).copied()
}
