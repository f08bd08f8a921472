//! The workspace's own commands.

mod office;

fn main() -> anyhow::Result<()> {
    office::write("maps/grids".as_ref())?;
    Ok(())
}
