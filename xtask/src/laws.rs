//! `cargo xtask laws`: the law table, printed or written to docs/.

use crate::{
    steps::Verdict,
    workspace::{self, root},
};
use anyhow::Result;

/// Where the table stands.
pub(crate) const FILE: &str = "docs/laws.md";

pub(crate) fn run(write: bool) -> Result<Verdict> {
    if write {
        workspace::write(&root().join(FILE), &page())?;
    } else {
        print!("{}", page());
    }
    Ok(Verdict::Passed)
}

/// The page as it should stand in docs/.
pub(crate) fn page() -> String {
    String::new()
}
