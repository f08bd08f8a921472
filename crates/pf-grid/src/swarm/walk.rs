use crate::{GridProblem, swarm::Unloop};
use pf_core::PlanRng;
use rand::{Rng, SeedableRng};
use std::thread;

/// How one walker went.
#[derive(Clone, Debug, Default)]
pub struct Walk {
    steps: Vec<u8>,
    end: u32,
    ended: Ended,
}

/// Why a walk ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ended {
    /// At the goal.
    Arrived,
    /// Where there was no way to go on.
    #[default]
    Stuck,
    /// After the last step allowed.
    Tired,
}

impl Walk {
    /// The directions of its steps.
    #[must_use]
    pub fn steps(&self) -> &[u8] {
        &self.steps
    }

    /// The id of the cell where it ended.
    #[must_use]
    pub fn end(&self) -> u32 {
        self.end
    }

    /// Why it ended there.
    #[must_use]
    pub fn ended(&self) -> Ended {
        self.ended
    }
}

/// The random bits of one step.
#[derive(Clone, Copy, Debug)]
pub struct Draw(u64);

impl Draw {
    /// A number from 0 to 1, 1 excluded, in 2^24 steps.
    #[inline]
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "24 bits fit")]
    pub fn chance(self) -> f32 {
        (self.0 >> 40) as f32 * (1.0 / (1u32 << 24) as f32)
    }

    /// Whether something of this probability happens, independent of [`chance`](Self::chance).
    #[inline]
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "32 bits fit")]
    pub fn happens(self, probability: f64) -> bool {
        ((self.0 & 0xffff_ffff) as f64) < probability * (1u64 << 32) as f64
    }
}

/// The cells a walker has been to, where that matters.
#[derive(Clone, Debug, Default)]
pub struct Visited {
    marks: Vec<u32>,
    mark: u32,
}

impl Visited {
    /// Whether the walker has been there.
    #[inline]
    #[must_use]
    pub fn contains(&self, id: u32) -> bool {
        self.marks[id as usize] == self.mark
    }

    fn begin(&mut self, len: usize) {
        if self.marks.len() != len || self.mark == u32::MAX {
            self.marks.clear();
            self.marks.resize(len, 0);
            self.mark = 0;
        }
        self.mark += 1;
    }
}

/// One iteration's walks: from where to where and under which seed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tour {
    pub(crate) walkers: usize,
    pub(crate) steps: usize,
    pub(crate) threads: usize,
    pub(crate) remember: bool,
    pub(crate) seed: u64,
    pub(crate) iteration: u64,
}

/// The generator of one walker: a stream of its own, whichever thread it walks on.
fn stream(tour: &Tour, walker: u64) -> PlanRng {
    let mut state = tour.seed;
    for part in [tour.iteration, walker] {
        // Steele, Lea, Flood 2014 (SplitMix64).
        state = (state ^ part).wrapping_add(0x9e37_79b9_7f4a_7c15);
        state = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        state = (state ^ (state >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        state ^= state >> 31;
    }
    PlanRng::seed_from_u64(state)
}

/// The walkers and their memory, kept from iteration to iteration.
#[derive(Clone, Debug, Default)]
pub(crate) struct Walkers {
    pub(crate) walks: Vec<Walk>,
    visited: Vec<Visited>,
    pub(crate) unloop: Unloop,
}

impl Walkers {
    /// Lets all walkers walk by `next`, which takes the id a walker is at.
    pub(crate) fn walk(
        &mut self,
        problem: &GridProblem,
        tour: &Tour,
        next: &(impl Fn(u32, Draw, &Visited) -> Option<u32> + Sync),
    ) {
        let threads = tour.threads.clamp(1, tour.walkers.max(1));
        self.walks.resize_with(tour.walkers, Walk::default);
        self.visited.resize_with(threads, Visited::default);
        let share = tour.walkers.div_ceil(threads);
        let shares = self.walks.chunks_mut(share).zip(&mut self.visited);
        let walk_all = |first: usize, walks: &mut [Walk], visited: &mut Visited| {
            for (walker, walk) in (first as u64..).zip(walks) {
                let mut rng = stream(tour, walker);
                one(walk, visited, problem, tour, &mut rng, next);
            }
        };
        if threads == 1 {
            shares.for_each(|(walks, visited)| walk_all(0, walks, visited));
            return;
        }
        thread::scope(|scope| {
            for (n, (walks, visited)) in shares.enumerate() {
                scope.spawn(move || walk_all(n * share, walks, visited));
            }
        });
    }
}

fn one(
    walk: &mut Walk,
    visited: &mut Visited,
    problem: &GridProblem,
    tour: &Tour,
    rng: &mut PlanRng,
    next: &impl Fn(u32, Draw, &Visited) -> Option<u32>,
) {
    let layout = problem.grid().layout();
    let offsets = layout.offsets();
    let goal = layout.id(problem.goal());
    let mut at = layout.id(problem.start());
    walk.steps.clear();
    if tour.remember {
        visited.begin(layout.len());
    }
    walk.ended = loop {
        if at == goal {
            break Ended::Arrived;
        }
        if walk.steps.len() >= tour.steps {
            break Ended::Tired;
        }
        if tour.remember {
            visited.marks[at as usize] = visited.mark;
        }
        let Some(k) = next(at, Draw(rng.next_u64()), visited) else {
            break Ended::Stuck;
        };
        #[expect(clippy::cast_possible_truncation, reason = "a direction is below 8")]
        walk.steps.push(k as u8);
        at = at.wrapping_add_signed(offsets[k as usize & 7]);
    };
    walk.end = at;
}
