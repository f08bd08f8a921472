//! Planners in other programs, by the name `external:COMMAND`.

use crate::{AnyEntry, Runner, Settings, entry::configured, runner::On};
use pf_core::{Claims, FromScratch, InvalidParams, Key, Params};
use pf_external::{External, ExternalParams, Fault, Introduction, Wire};
use pf_geom::WorldProblem;
use pf_grid::GridProblem;
use std::sync::{Mutex, PoisonError};

/// What such a name begins with.
pub(crate) const PREFIX: &str = "external:";

/// A program that said who it is.
#[derive(Debug)]
struct Outside {
    /// The whole name, prefix and command.
    key: &'static str,
    /// `grid` or `world`.
    problem: &'static str,
    of: Introduction,
}

/// Programs that were asked for, kept for as long as this program runs: entries live that long.
static KNOWN: Mutex<Vec<&'static Outside>> = Mutex::new(Vec::new());

/// The planner that answers to a command; starts it to let it say who it is.
pub(crate) fn find(command: &str) -> Result<&'static dyn AnyEntry, Fault> {
    let key = format!("{PREFIX}{command}");
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(one) = known.iter().find(|one| one.key == key) {
        return Ok(*one);
    }
    let of = Introduction::of(command)?;
    let known_problems = [GridProblem::KIND, WorldProblem::KIND];
    let problem = known_problems.into_iter().find(|kind| *kind == of.problem);
    let problem = problem.ok_or_else(|| Fault::Garbage {
        line: format!("\"problem\": \"{}\"", of.problem),
        expected: "\"grid\" or \"world\"".to_owned(),
    })?;
    let key = key.leak();
    let one: &'static Outside = Box::leak(Box::new(Outside { key, problem, of }));
    known.push(one);
    Ok(one)
}

impl AnyEntry for Outside {
    fn key(&self) -> &'static str {
        self.key
    }
    fn name(&self) -> String {
        self.of.name.clone()
    }
    fn problem(&self) -> &'static str {
        self.problem
    }
    fn claims(&self) -> Claims {
        self.of.claims
    }
    fn source(&self) -> &'static str {
        "another program"
    }
    fn parameters(&self) -> &'static [Key] {
        ExternalParams::KEYS
    }
    fn replans(&self) -> bool {
        false
    }
    fn runner(&self, settings: &Settings) -> Result<Box<dyn Runner>, InvalidParams> {
        let params: ExternalParams = configured(settings)?;
        let command = &self.key[PREFIX.len()..];
        let bad = |fault: Fault| {
            let expected = format!("a program that answers: it {fault}");
            InvalidParams::bad("external", command, expected)
        };
        Ok(if self.problem == GridProblem::KIND {
            let planner = External::<GridProblem>::start(command, &params).map_err(bad)?;
            Box::new(On::new(Box::new(FromScratch(planner))))
        } else {
            let planner = External::<WorldProblem>::start(command, &params).map_err(bad)?;
            Box::new(On::new(Box::new(FromScratch(planner))))
        })
    }
}
