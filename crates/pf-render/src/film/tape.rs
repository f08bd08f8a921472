//! What a search did, in its order: as much of it as an animation can show.

/// A few of many, evenly: every n-th that is offered, and n doubles when there is no more room.
#[derive(Clone, Debug)]
pub(crate) struct Thinned<T> {
    kept: Vec<(u64, T)>,
    seen: u64,
    stride: u64,
    room: usize,
}

impl<T> Thinned<T> {
    pub(crate) fn new(room: usize) -> Self {
        Self {
            kept: Vec::new(),
            seen: 0,
            stride: 1,
            room: room.max(2),
        }
    }

    /// Takes what happened at a time, or not; it is made only if it is taken.
    pub(crate) fn offer(&mut self, at: u64, make: impl FnOnce() -> T) {
        if self.seen.is_multiple_of(self.stride) && self.kept.len() == self.room {
            let mut odd = false;
            self.kept.retain(|_| {
                odd = !odd;
                odd
            });
            self.stride *= 2;
        }
        if self.seen.is_multiple_of(self.stride) {
            self.kept.push((at, make()));
        }
        self.seen += 1;
    }

    /// Those up to a time, that included.
    pub(crate) fn until(&self, at: u64) -> &[(u64, T)] {
        &self.kept[..self.kept.partition_point(|(when, _)| *when <= at)]
    }

    /// How many were offered up to a time, about.
    pub(crate) fn offered(&self, at: u64) -> usize {
        let kept = self.until(at).len();
        usize::try_from(self.stride * kept as u64)
            .unwrap_or(usize::MAX)
            .min(usize::try_from(self.seen).unwrap_or(usize::MAX))
    }

    pub(crate) fn all(&self) -> &[(u64, T)] {
        &self.kept
    }
}

/// A number per block of cells.
#[derive(Clone, Debug)]
pub(crate) struct Sample {
    pub(crate) name: &'static str,
    pub(crate) values: Vec<f32>,
}

/// A solution better than those before.
#[derive(Clone, Debug)]
pub(crate) struct Better {
    pub(crate) line: Vec<[f64; 2]>,
    pub(crate) cost: f64,
}

/// Everything with the time at which it happened. Time counts events.
#[derive(Clone, Debug)]
pub(crate) struct Tape {
    pub(crate) now: u64,
    /// As many as it is meant for.
    pub(crate) frames: usize,
    /// Columns and rows.
    pub(crate) size: [u32; 2],
    /// Cells per side of a block of which one is sampled.
    pub(crate) block: u32,
    /// Places are cells, told by their middles; otherwise points of a world.
    pub(crate) in_cells: bool,
    pub(crate) expanded_at: Vec<u64>,
    pub(crate) fields: Thinned<Sample>,
    pub(crate) points: Thinned<(&'static str, Vec<[f64; 2]>)>,
    pub(crate) tries: Thinned<Vec<[f64; 2]>>,
    pub(crate) better: Thinned<Better>,
}

/// Attempts that are kept per frame: what a frame shows, and some to choose from.
const TRIES: usize = 8;
/// Blocks along a side of a sampled map at most.
const FINEST: u32 = 512;

impl Tape {
    pub(crate) fn new(frames: usize, size: [u32; 2]) -> Self {
        Self {
            now: 0,
            frames,
            size,
            block: block_of(size),
            in_cells: false,
            expanded_at: Vec::new(),
            fields: Thinned::new(frames),
            points: Thinned::new(2 * frames),
            tries: Thinned::new(TRIES * frames),
            better: Thinned::new(4 * frames),
        }
    }

    /// The next moment.
    pub(crate) fn tick(&mut self) -> u64 {
        self.now += 1;
        self.now
    }

    /// The first cell of each block, row by row.
    pub(crate) fn corners(size: [u32; 2], block: u32) -> impl Iterator<Item = [u32; 2]> {
        let step = block as usize;
        (0..size[1])
            .step_by(step)
            .flat_map(move |y| (0..size[0]).step_by(step).map(move |x| [x, y]))
    }
}

/// Cells per side of the blocks in which a map of this size is animated.
pub(crate) fn block_of(size: [u32; 2]) -> u32 {
    size[0].max(size[1]).div_ceil(FINEST).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_few_of_many_are_spread_evenly() {
        let mut thinned = Thinned::new(8);
        for k in 0..100u64 {
            thinned.offer(k, || k);
        }
        let kept: Vec<u64> = thinned.all().iter().map(|(_, k)| *k).collect();
        assert_eq!(kept, [0, 16, 32, 48, 64, 80, 96]);
        assert_eq!(thinned.until(32).len(), 3);
        assert_eq!(thinned.until(31).len(), 2);
    }
}
