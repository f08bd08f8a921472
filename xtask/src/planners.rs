//! `cargo xtask planners`: the planner table, printed or written to docs/.

use crate::{
    steps::Verdict,
    workspace::{self, root},
};
use anyhow::Result;
use pf_core::Claims;
use std::fmt::Write as _;

/// Where the table stands.
pub(crate) const FILE: &str = "docs/planners.md";

pub(crate) fn run(write: bool) -> Result<Verdict> {
    if write {
        workspace::write(&root().join(FILE), &page()?)?;
    } else {
        print!("{}", page()?);
    }
    Ok(Verdict::Passed)
}

/// The page as it should stand in docs/.
pub(crate) fn page() -> Result<String> {
    let mut page = String::from(
        "# Planners\n\n\
         Written by `cargo xtask planners --write` from the list in `crates/pf-planners`. Names are \
         those of `--planner`; what a claim binds a planner to stands in [laws.md](laws.md).\n\n\
         | name | planner | problem | claims | after a change | source |\n\
         | --- | --- | --- | --- | --- | --- |\n",
    );
    for planner in pf_planners::all() {
        writeln!(
            page,
            "| `{}` | {} | {} | {} | {} | {} |",
            planner.key(),
            planner.name(),
            planner.problem(),
            claims(planner.claims()),
            if planner.replans() {
                "repairs"
            } else {
                "starts over"
            },
            planner.source()
        )?;
    }
    page.push_str("\n## Parameters\n\nSet by `--set name=value`.\n\n");
    page.push_str("| planner | parameter | meaning |\n| --- | --- | --- |\n");
    for planner in pf_planners::all() {
        for parameter in planner.parameters() {
            let (name, about) = (parameter.name, parameter.about);
            writeln!(page, "| `{}` | `{name}` | {about} |", planner.key())?;
        }
    }
    Ok(page)
}

/// The names of the claims made.
pub(crate) fn claims(claims: Claims) -> String {
    let names = [
        ("complete", claims.complete),
        ("optimal", claims.optimal),
        ("anytime", claims.anytime),
        ("deterministic", claims.deterministic),
        ("incremental", claims.incremental),
    ];
    let made = names.iter().filter(|(_, made)| *made);
    made.map(|(name, _)| *name).collect::<Vec<_>>().join(", ")
}
