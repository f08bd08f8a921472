//! `cargo xtask bench`.

fn main() -> anyhow::Result<()> {
    pf_bench::run(None)
}
