//! Distances from one cell to all others, kept whole.

use crate::{Buckets, Cell, Downhill, GridProblem, Layout, Weights, Word, downhill::Steps};
use pf_core::Context;
use std::{cmp::Reverse, collections::BinaryHeap};

/// The distance from every cell to one, the root; [`Word::MAX`] where there is no way.
///
/// Unlike a [`DistanceField`](crate::DistanceField), which knows what one start needs, they are
/// exact everywhere once made, and stay so through [`repair`](Self::repair); in between some may be
/// [raised](Self::raise). Four bytes a cell in
/// 32 bits, six in [`U48`](crate::U48). The root's distance is 0 even where the root is blocked; nothing leads on from it then.
#[derive(Clone, Debug, Default)]
pub struct Distances<W: Word> {
    values: Vec<W::Kept>,
    layout: Option<Layout>,
    basis: Option<(Cell, Weights)>,
    /// Ids that were raised, and what they said before.
    raised: Vec<(u32, W::Kept)>,
}

/// How work on [`Distances`] ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Swept {
    /// They are exact.
    Whole,
    /// The budget ran out; they are forgotten.
    Cut,
    /// Repairing has taken as much as it may; they are forgotten.
    GaveUp,
    /// Some way weighs more than the word orders exactly; they are forgotten.
    TooFar,
}

/// Entries of scratch memory that are kept from one repair to the next.
const KEPT: usize = 1 << 14;

/// Memory that sweeps and repairs of any number of [`Distances`] share.
#[derive(Clone, Debug, Default)]
pub struct Sweeper<W: Copy + Ord> {
    open: Buckets<W>,
    queue: BinaryHeap<Reverse<(W, u32)>>,
    /// Ids that have lost their way.
    cut: Vec<u32>,
}

impl<W: Word> Sweeper<W> {
    /// Empties it, and gives back what takes longer to fill than to ask for again.
    fn shrink(&mut self) {
        self.queue.clear();
        self.queue.shrink_to(KEPT);
        self.cut.clear();
        self.cut.shrink_to(KEPT);
    }

    /// Bytes held.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.open.bytes()
            + self.queue.capacity() * size_of::<Reverse<(W, u32)>>()
            + self.cut.capacity() * size_of::<u32>()
    }
}

impl<W: Word> Distances<W> {
    /// Whether distances on this grid fit the word.
    #[must_use]
    pub fn fit(problem: &GridProblem) -> bool {
        Weights::of(problem.grid()).fit::<W>(problem.grid(), 2)
    }

    /// The root and the weights that the distances were made for, if they were.
    #[must_use]
    pub fn basis(&self) -> Option<(Cell, Weights)> {
        self.basis
    }

    /// The distance of an id; [`Word::MAX`] if there is no way.
    #[inline]
    #[must_use]
    pub fn at(&self, id: u32) -> W {
        W::of(self.values[id as usize])
    }

    /// How many more ids may be [raised](Self::raise): of all a sixteenth in 32 bits, a sixty-fourth in 48,
    /// half a byte a cell at the most.
    #[must_use]
    pub fn room(&self) -> usize {
        (self.values.len() >> size_of::<W::Kept>()).saturating_sub(self.raised.len())
    }

    /// Puts more where `least` says more than they do: bounds of the distances as they are now, from below,
    /// after cells were blocked. As before, a way down is one of which there is none shorter. Repairs
    /// [lower](Self::lower) them first, and so must the caller before a map opens.
    ///
    /// Source: Koenig and Likhachev, *Adaptive A\**, 2005.
    pub fn raise(&mut self, ids: &[u32], least: impl Fn(u32) -> W) {
        // All at once: a vector that grows by itself takes up to twice as much.
        self.raised.reserve_exact(self.room());
        for &id in ids {
            let (was, least) = (self.at(id), least(id));
            if least > was {
                self.raised.push((id, was.keep()));
                self.values[id as usize] = least.keep();
            }
        }
    }

    /// Says again what they said when they were exact.
    pub fn lower(&mut self) {
        for (id, was) in self.raised.drain(..).rev() {
            self.values[id as usize] = was;
        }
    }

    /// Gives them up; the memory stays.
    pub fn forget(&mut self) {
        self.basis = None;
        self.raised.clear();
    }

    /// Bytes held.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.values.capacity() * size_of::<W::Kept>()
            + self.raised.capacity() * size_of::<(u32, W::Kept)>()
    }

    /// Makes them anew: one expansion for every cell that the root can be reached from.
    ///
    /// Source: Dijkstra, *A note on two problems in connexion with graphs*, 1959, with Dial's
    /// buckets. A bucket is narrower than the cheapest step, so no cell is expanded twice.
    pub fn sweep(
        &mut self,
        problem: &GridProblem,
        root: Cell,
        sweeper: &mut Sweeper<W>,
        cx: &mut Context<'_, GridProblem>,
    ) -> Swept {
        let grid = problem.grid();
        let layout = *grid.layout();
        self.layout = Some(layout);
        self.forget();
        self.values.clear();
        self.values.resize(layout.len(), W::MAX.keep());
        let weights = Weights::of(grid);
        let id = layout.id(root);
        self.values[id as usize] = W::default().keep();
        let open = &mut sweeper.open;
        open.reset(W::default(), weights.reach(), weights.shift::<W>());
        if grid.is_free(root) {
            open.push(W::default(), id, W::default());
        }
        let end = if weights.is_uniform() {
            let weigh = |_, _, k| {
                if k < 4 { W::STRAIGHT } else { W::DIAGONAL }
            };
            spread::<W>(&mut self.values, problem, open, weigh, cx)
        } else {
            let weigh = |from, to, k| weights.step(grid, from, to, k);
            spread::<W>(&mut self.values, problem, open, weigh, cx)
        };
        if end == Swept::Whole {
            self.basis = Some((root, weights));
        }
        end
    }

    /// Repairs them after the map changed at `changed`, at a cost in the cells whose distance that
    /// changes, of which there may be `most`.
    ///
    /// Source: Ramalingam and Reps, *An incremental algorithm for a generalization of the
    /// shortest-path problem*, 1996: first every cell that has lost its way is found, in the order
    /// of the old distances, then distances spread again.
    pub fn repair(
        &mut self,
        problem: &GridProblem,
        changed: &[u32],
        most: u64,
        sweeper: &mut Sweeper<W>,
        cx: &mut Context<'_, GridProblem>,
    ) -> Swept {
        self.lower();
        let now = Weights::of(problem.grid());
        let Some((root, weights)) = self.basis.take() else {
            return Swept::GaveUp;
        };
        if self.layout != Some(*problem.grid().layout()) || !weights.hold_under(now) {
            return Swept::GaveUp;
        }
        let steps = Steps::of(problem, weights);
        let end = self.mend(&steps, root, changed, most, sweeper, cx);
        sweeper.shrink();
        if end == Swept::Whole {
            self.basis = Some((root, weights));
        }
        end
    }

    fn mend(
        &mut self,
        steps: &Steps<'_>,
        root: Cell,
        changed: &[u32],
        most: u64,
        sweeper: &mut Sweeper<W>,
        cx: &mut Context<'_, GridProblem>,
    ) -> Swept {
        let (queue, cut) = (&mut sweeper.queue, &mut sweeper.cut);
        let root = steps.layout.id(root);
        let values = &mut self.values;
        let near = || {
            let around = |&id: &u32| steps.offsets.map(|offset| id.wrapping_add_signed(offset));
            let around = changed.iter().flat_map(around);
            around.chain(changed.iter().copied())
        };
        queue.clear();
        cut.clear();
        let known = near().map(|id| (W::of(values[id as usize]), id));
        queue.extend(known.filter(|&(value, _)| value < W::MAX).map(Reverse));
        let mut expanded = 0;
        while let Some(Reverse((value, id))) = queue.pop() {
            if id == root || W::of(values[id as usize]) == W::MAX {
                continue;
            }
            let leads = |(next, weight)| {
                let rest = W::of(values[next as usize]);
                rest < value && rest + weight <= value
            };
            if steps.from(id).any(leads) {
                continue;
            }
            expanded += 1;
            if expanded > most {
                return Swept::GaveUp;
            }
            if !cx.proceed() {
                return Swept::Cut;
            }
            cx.expanded(|| steps.layout.cell(id));
            values[id as usize] = W::MAX.keep();
            cut.push(id);
            // Whose step was legal and is not, or weighs something else, is near a change.
            for (next, weight) in steps.from::<W>(id) {
                let theirs = W::of(values[next as usize]);
                if theirs < W::MAX && theirs == value + weight {
                    queue.push(Reverse((theirs, next)));
                }
            }
        }
        for id in near().chain(cut.iter().copied()) {
            let over = steps.from::<W>(id).filter_map(|(next, weight)| {
                let rest = W::of(values[next as usize]);
                (rest < W::MAX).then(|| rest + weight)
            });
            if let Some(least) = over.min()
                && least < W::of(values[id as usize])
                && id != root
            {
                values[id as usize] = least.keep();
                queue.push(Reverse((least, id)));
            }
        }
        while let Some(Reverse((value, id))) = queue.pop() {
            if W::of(values[id as usize]) != value {
                continue;
            }
            expanded += 1;
            if expanded > most {
                return Swept::GaveUp;
            }
            if !cx.proceed() {
                return Swept::Cut;
            }
            cx.expanded(|| steps.layout.cell(id));
            if value >= W::LIMIT {
                return Swept::TooFar;
            }
            for (next, weight) in steps.from::<W>(id) {
                let through = value + weight;
                if through < W::of(values[next as usize]) {
                    values[next as usize] = through.keep();
                    queue.push(Reverse((through, next)));
                }
            }
        }
        Swept::Whole
    }

    /// The ways down to the root by steps that are legal in `problem` and weigh there what the
    /// distances say: who arrives has gone as far as they say.
    #[must_use]
    pub fn downhill<'d>(&'d self, problem: &'d GridProblem) -> Downhill<'d, W> {
        let grid = problem.grid();
        let weights = self
            .basis
            .map_or_else(|| Weights::of(grid), |(_, weights)| weights);
        Downhill::of(&self.values, Steps::of(problem, weights))
    }
}

/// Spreads distances from what is open.
#[inline]
fn spread<W: Word>(
    values: &mut [W::Kept],
    problem: &GridProblem,
    open: &mut Buckets<W>,
    weigh: impl Fn(u32, u32, u32) -> W,
    cx: &mut Context<'_, GridProblem>,
) -> Swept {
    let grid = problem.grid();
    let (layout, moves) = (*grid.layout(), problem.moves());
    let offsets = layout.offsets();
    while let Some((id, value)) = open.pop(W::MAX) {
        if W::of(values[id as usize]) != value {
            continue;
        }
        if !cx.proceed() {
            return Swept::Cut;
        }
        cx.expanded(|| layout.cell(id));
        if value >= W::LIMIT {
            return Swept::TooFar;
        }
        let mut legal = moves.legal(grid.around_id(id));
        while legal != 0 {
            let k = legal.trailing_zeros();
            legal &= legal - 1;
            let next = id.wrapping_add_signed(offsets[k as usize]);
            let through = value + weigh(id, next, k);
            if through < W::of(values[next as usize]) {
                values[next as usize] = through.keep();
                open.push(through, next, through);
            }
        }
    }
    Swept::Whole
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Grid, GridChange, Moves};
    use pf_core::Problem;

    /// Small numbers that look like chance.
    fn noise(seed: &mut u32) -> u32 {
        *seed ^= *seed << 13;
        *seed ^= *seed >> 17;
        *seed ^= *seed << 5;
        *seed
    }

    fn swept(problem: &GridProblem, root: Cell) -> Vec<u32> {
        let mut fresh = Distances::<u32>::default();
        let cx = &mut Context::seeded(0);
        let end = fresh.sweep(problem, root, &mut Sweeper::default(), cx);
        assert_eq!(end, Swept::Whole);
        fresh.values
    }

    #[test]
    fn repaired_distances_are_those_of_a_sweep() {
        let mut seed = 7;
        for moves in Moves::ALL {
            for terrain in [false, true] {
                let grid = Grid::new(30, 20, |_| match noise(&mut seed) % 10 {
                    0..3 => 0,
                    n if terrain => u8::try_from(n).unwrap(),
                    _ => 1,
                });
                let root = Cell::new(noise(&mut seed) % 30, noise(&mut seed) % 20);
                let problem = GridProblem::new(grid.unwrap(), root, root).unwrap();
                let mut problem = problem.with_moves(moves);
                let mut kept = Distances::<u32>::default();
                let mut sweeper = Sweeper::default();
                let cx = &mut Context::seeded(0);
                kept.sweep(&problem, root, &mut sweeper, cx);
                for round in 0..60 {
                    let mut cells = || {
                        let cell = |seed: &mut u32| Cell::new(noise(seed) % 30, noise(seed) % 20);
                        (0..=round % 9).map(|_| cell(&mut seed)).collect::<Vec<_>>()
                    };
                    let changes = [
                        GridChange::Blocked(cells()),
                        GridChange::Freed(cells()),
                        GridChange::CostChanged(cells(), if terrain { 5 } else { 1 }),
                    ];
                    problem.apply(&changes).unwrap();
                    let layout = *problem.grid().layout();
                    let touched = changes.iter().flat_map(|change| match change {
                        GridChange::Blocked(cells)
                        | GridChange::Freed(cells)
                        | GridChange::CostChanged(cells, _) => cells.clone(),
                        _ => Vec::new(),
                    });
                    let ids: Vec<_> = touched.map(|cell| layout.id(cell)).collect();
                    let end = kept.repair(&problem, &ids, u64::MAX, &mut sweeper, cx);
                    if end == Swept::GaveUp {
                        kept.sweep(&problem, root, &mut sweeper, cx);
                    }
                    assert_eq!(kept.values, swept(&problem, root), "{moves}, round {round}");
                }
            }
        }
    }

    #[test]
    fn what_was_raised_bounds_until_it_is_lowered_or_repaired() {
        let grid =
            Grid::parse("......... .#######. ......... ......... ......... .........").unwrap();
        let (root, wall) = (Cell::new(8, 1), Cell::new(8, 0));
        let mut problem = GridProblem::new(grid, Cell::new(0, 1), root).unwrap();
        let (mut field, mut sweeper) = (Distances::<u32>::default(), Sweeper::default());
        let cx = &mut Context::seeded(0);
        field.sweep(&problem, root, &mut sweeper, cx);
        problem.apply(&[GridChange::Blocked(vec![wall])]).unwrap();
        let (before, after) = (field.values.clone(), swept(&problem, root));
        let layout = *problem.grid().layout();
        let row: Vec<_> = (0..8).map(|x| layout.id(Cell::new(x, 0))).collect();
        let after = |id: u32| after[id as usize];
        let most = field.room();
        assert_eq!(most, before.len() / 16);
        field.raise(&row[..3], after);
        field.raise(&row[..1], |_| 1);
        field.raise(&row[2..3], |id| after(id) + 1);
        let now = [after(row[0]), after(row[1]), after(row[2]) + 1];
        assert_eq!([field.at(row[0]), field.at(row[1]), field.at(row[2])], now);
        // Twice the third.
        assert_eq!(field.room() + 4, most);
        field.lower();
        assert_eq!((&field.values, field.room()), (&before, most));
        field.raise(&row, |id| after(id) - 1);
        let ids = [layout.id(wall)];
        let end = field.repair(&problem, &ids, u64::MAX, &mut sweeper, cx);
        assert_eq!(end, Swept::Whole);
        assert_eq!(field.values, swept(&problem, root));
    }

    #[test]
    fn the_way_down_ends_at_the_root_or_where_it_is_blocked() {
        let grid = Grid::parse("....... .#####. .......").unwrap();
        let (root, from) = (Cell::new(0, 1), Cell::new(6, 1));
        let mut problem = GridProblem::new(grid, from, root).unwrap();
        let mut field = Distances::<u32>::default();
        let cx = &mut Context::seeded(0);
        field.sweep(&problem, root, &mut Sweeper::default(), cx);
        let layout = *problem.grid().layout();
        let mut way = vec![from];
        let mut at = layout.id(from);
        let downhill = field.downhill(&problem);
        let end = downhill.go(at, |k| {
            at = downhill.along(at, k);
            way.push(layout.cell(at));
        });
        assert_eq!((layout.cell(end), way.len()), (root, 9));
        assert!(problem.judge(&way).is_ok());
        problem.apply(&[GridChange::Blocked(vec![way[3]])]).unwrap();
        let end = field.downhill(&problem).go(layout.id(from), |_| {});
        assert_eq!(layout.cell(end), way[2]);
    }

    #[test]
    fn a_blocked_root_is_alone() {
        let problem =
            GridProblem::new(Grid::parse("#.").unwrap(), Cell::new(0, 0), Cell::new(1, 0));
        let problem = problem.unwrap();
        let values = swept(&problem, Cell::new(0, 0));
        let layout = problem.grid().layout();
        assert_eq!(values[layout.id(Cell::new(0, 0)) as usize], 0);
        assert_eq!(values[layout.id(Cell::new(1, 0)) as usize], u32::MAX);
    }
}
