//! Probe
fn main() {
    pf_bench::grid::main()
}
