//! The same under an allocator that counts; `pf-bench` asks it where allocations are told.

use allocation_counter::measure;
use pf_bench::Counted;

fn main() -> anyhow::Result<()> {
    pf_bench::run(Some(|work| {
        let taken = measure(work);
        Counted {
            allocations: taken.count_total,
            peak: taken.bytes_max,
        }
    }))
}
