//! `cargo xtask laws`: the law table, printed or written to docs/.

use crate::{
    steps::Verdict,
    workspace::{self, root},
};
use anyhow::Result;
use std::fmt::Write as _;

/// Where the table stands.
pub(crate) const FILE: &str = "docs/laws.md";

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
        "# Laws\n\n\
         Written by `cargo xtask laws --write` from the table in `crates/pf-conformance`, which \
         alone decides what conformance means. `cargo xtask conformance` holds every planner to \
         every law that binds it; a planner of yours is held to them by five lines, see the \
         README of `examples/third-party`. For each law there is a rogue, a planner that breaks \
         exactly this one.\n\n\
         | law | binds | says |\n\
         | --- | --- | --- |\n",
    );
    for law in pf_conformance::laws() {
        writeln!(
            page,
            "| **{}** | {} | {} |",
            law.name, law.binds.whom, law.text
        )?;
    }
    Ok(page)
}
