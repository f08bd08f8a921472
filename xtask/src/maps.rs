//! `cargo xtask maps`: draws the maps that are made here.

use crate::{office, steps::Verdict, workspace::root, yard};
use anyhow::Result;

pub(crate) fn run() -> Result<Verdict> {
    office::write(&root().join("maps/grids"))?;
    println!("drew maps/grids/office.yaml and office.pgm");
    yard::write(&root().join("maps/worlds"))?;
    println!("drew maps/worlds/yard.toml");
    Ok(Verdict::Passed)
}
