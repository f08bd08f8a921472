//! `pf planners`: what there is.

use crate::failure::{Failure, Status};
use comfy_table::{Table, presets};
use pf_core::Claims;
use pf_planners::{AnyEntry, all};
use serde::Serialize;
use std::{
    fmt::Write as _,
    io::{Write, stdout},
};

#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  pf planners
  pf planners --json")]
pub(crate) struct Args {
    /// One JSON object per line and planner
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Described {
    name: &'static str,
    title: String,
    problem: &'static str,
    claims: Vec<&'static str>,
    replans: &'static str,
    paper: &'static str,
    parameters: Vec<Parameter>,
}

#[derive(Serialize)]
struct Parameter {
    name: &'static str,
    about: &'static str,
}

impl Described {
    fn of(entry: &dyn AnyEntry) -> Self {
        let parameter = |key: &pf_core::Key| Parameter {
            name: key.name,
            about: key.about,
        };
        Self {
            name: entry.key(),
            title: entry.name(),
            problem: entry.problem(),
            claims: words(entry.claims()),
            replans: if entry.replans() {
                "repairs"
            } else {
                "from scratch"
            },
            paper: entry.source(),
            parameters: entry.parameters().iter().map(parameter).collect(),
        }
    }
}

fn words(claims: Claims) -> Vec<&'static str> {
    let all = [
        (claims.complete, "complete"),
        (claims.optimal, "optimal"),
        (claims.anytime, "anytime"),
        (claims.deterministic, "deterministic"),
        (claims.incremental, "incremental"),
    ];
    let made = all.into_iter().filter(|(made, _)| *made);
    made.map(|(_, word)| word).collect()
}

pub(crate) fn act(args: &Args) -> Result<Status, Failure> {
    let mut out = stdout().lock();
    let described = all().map(Described::of);
    if args.json {
        for planner in described {
            let line =
                serde_json::to_string(&planner).map_err(|e| Failure::Internal(e.to_string()))?;
            writeln!(out, "{line}")?;
        }
        return Ok(Status::Done);
    }
    let mut table = Table::new();
    table.load_style(presets::UTF8_FULL_CONDENSED).set_header([
        "name",
        "problem",
        "claims",
        "after a change",
        "paper",
    ]);
    let mut parameters = String::new();
    for planner in described {
        table.add_row([
            planner.name,
            planner.problem,
            &planner.claims.join(", "),
            planner.replans,
            planner.paper,
        ]);
        for Parameter { name, about } in planner.parameters {
            let _ = writeln!(parameters, "  {:<12} {name:<10} {about}", planner.name);
        }
    }
    writeln!(out, "{table}")?;
    writeln!(
        out,
        "Parameters (--set key=value):\n{}",
        parameters.trim_end()
    )?;
    Ok(Status::Done)
}
