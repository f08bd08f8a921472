//! Chance that does not depend on the number of threads: a generator for each number.

use pf_core::PlanRng;
use rand::SeedableRng;

/// Where the generators of one cycle come from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dice {
    pub(crate) seed: u64,
    pub(crate) cycle: u64,
}

impl Dice {
    /// The generator of one number, whoever asks for it (Steele, Lea, Flood 2014).
    pub(crate) fn of(self, number: usize) -> PlanRng {
        let mut state = self.seed;
        for part in [self.cycle, number as u64] {
            state = (state ^ part).wrapping_add(0x9e37_79b9_7f4a_7c15);
            state = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            state = (state ^ (state >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            state ^= state >> 31;
        }
        PlanRng::seed_from_u64(state)
    }
}
