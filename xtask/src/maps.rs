//! `cargo xtask maps`: draws the maps that are made here.

use crate::{office, steps::Verdict, workspace::root};
use anyhow::Result;

pub(crate) fn run() -> Result<Verdict> {
    office::write(&root().join("maps/grids"))?;
    println!("drew maps/grids/office.yaml and office.pgm");
    Ok(Verdict::Passed)
}
