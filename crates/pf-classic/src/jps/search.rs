//! A best-first search over jump points, in one word width.

use super::map::{JumpMap, Place};
use pf_core::Context;
use pf_grid::{Buckets, Cell, End, GridProblem, Layout, Moves, Weights, Word, successors};

/// What is known of a jump point.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, packed(4))]
struct Record<W> {
    /// Least weight found from the start.
    g: W,
    /// The jump point before it.
    parent: u32,
    /// The search this belongs to; others are as good as never written.
    generation: u16,
    /// The set of directions in which it was reached at weight `g`.
    arrivals: u8,
    /// Expanded at weight `g`.
    closed: bool,
}

/// The rules of a search, and where it goes.
struct Hunt<'p> {
    problem: &'p GridProblem,
    layout: Layout,
    goal: u32,
    steps: [(i32, i32); 8],
    /// The directions in which cells are looked at one by one, with scans to both sides: diagonals,
    /// or up and down where there are none.
    fans: u8,
}

/// A* whose nodes are jump points.
///
/// A straight run is scanned by words; a diagonal one is walked cell by cell, with scans to both
/// sides, and only what those find becomes a node.
#[derive(Clone, Debug, Default)]
pub(super) struct JumpSearch<W: Copy> {
    records: Vec<Record<W>>,
    generation: u16,
    open: Buckets<W>,
    layout: Option<Layout>,
    /// Something lay beyond what the word orders.
    beyond: bool,
}

/// A ring of more buckets costs more than the order within a bucket is worth.
const MOST_BUCKETS: u64 = 1 << 14;

impl<W: Word> JumpSearch<W> {
    /// Searches from start to goal, both free.
    pub(super) fn run(
        &mut self,
        problem: &GridProblem,
        map: &JumpMap,
        cx: &mut Context<'_, GridProblem>,
    ) -> End<W> {
        let grid = problem.grid();
        let weights = Weights::of(grid);
        if !weights.fit::<W>(grid, 2) {
            return End::TooFar;
        }
        let layout = *grid.layout();
        self.begin(&layout);
        let moves = problem.moves();
        let hunt = Hunt {
            problem,
            layout,
            goal: layout.id(problem.goal()),
            steps: map.steps(&layout),
            fans: if moves == Moves::Orthogonal {
                0b1010
            } else {
                0xf0
            },
        };
        let start = layout.id(problem.start());
        let octile = weights.octile::<W>(grid, moves, problem.goal());
        let first = octile(start);
        // A jump raises the key by twice its weight at most.
        let reach = W::DIAGONAL.times(2 * (layout.width() + layout.height()));
        let mut shift = weights.shift::<W>();
        while reach.bucket(shift) > MOST_BUCKETS {
            shift += 1;
        }
        self.open.reset(first, reach, shift);
        self.records[start as usize] = Record {
            generation: self.generation,
            ..Record::default()
        };
        self.open.push(first, start, W::default());
        self.search(&hunt, map, octile, cx)
    }

    fn begin(&mut self, layout: &Layout) {
        if self.layout != Some(*layout) {
            self.layout = Some(*layout);
            self.records.clear();
            self.records.resize(layout.len(), Record::default());
            self.generation = 0;
        }
        if self.generation == u16::MAX {
            self.records.fill(Record::default());
            self.generation = 0;
        }
        self.generation += 1;
    }

    fn search(
        &mut self,
        hunt: &Hunt<'_>,
        map: &JumpMap,
        octile: impl Fn(u32) -> W,
        cx: &mut Context<'_, GridProblem>,
    ) -> End<W> {
        let grid = hunt.problem.grid();
        let moves = hunt.problem.moves();
        let onward = successors(moves);
        let mut bound = W::LIMIT;
        self.beyond = false;
        while let Some((id, g)) = self.open.pop(bound) {
            let record = &mut self.records[id as usize];
            if record.closed || { record.g } != g {
                continue;
            }
            if !cx.proceed() {
                return End::Cut;
            }
            record.closed = true;
            let mut arrivals = record.arrivals;
            cx.expanded(|| hunt.layout.cell(id));
            if id == hunt.goal {
                bound = bound.min(g);
                continue;
            }
            let around = grid.around_id(id);
            let mut ways = if arrivals == 0 {
                moves.legal(around)
            } else {
                0
            };
            while arrivals != 0 {
                ways |= onward[arrivals.trailing_zeros() as usize][usize::from(around)];
                arrivals &= arrivals - 1;
            }
            let place = map.place(&hunt.layout, id);
            let mut lines = ways & !hunt.fans;
            while lines != 0 {
                let k = lines.trailing_zeros() as usize;
                lines &= lines - 1;
                if let Some((at, steps)) = hunt.run(map, place, k) {
                    self.reach(at, g + W::STRAIGHT.times(steps), k, id, bound, &octile);
                }
            }
            let mut fans = ways & hunt.fans;
            while fans != 0 {
                let k = fans.trailing_zeros() as usize;
                fans &= fans - 1;
                let weight = if k < 4 { W::STRAIGHT } else { W::DIAGONAL };
                let open = onward[k][0xff];
                let (mut from, mut from_g) = (place, g);
                loop {
                    from = from.step(hunt.steps[k]);
                    from_g = from_g + weight;
                    let ways = onward[k][usize::from(grid.around_id(from.id))];
                    if from.id == hunt.goal || ways & !open != 0 {
                        self.reach(from.id, from_g, k, id, bound, &octile);
                        break;
                    }
                    let mut lines = ways & !hunt.fans;
                    while lines != 0 {
                        let k = lines.trailing_zeros() as usize;
                        lines &= lines - 1;
                        if let Some((at, steps)) = hunt.run(map, from, k) {
                            let at_g = from_g + W::STRAIGHT.times(steps);
                            self.reach(at, at_g, k, id, bound, &octile);
                        }
                    }
                    if ways >> k & 1 == 0 {
                        break;
                    }
                }
            }
        }
        if bound < W::LIMIT {
            End::Goal(bound)
        } else if self.beyond {
            End::TooFar
        } else {
            End::Exhausted
        }
    }
    /// Takes note of a jump point reached from another in a direction.
    #[inline]
    fn reach(
        &mut self,
        at: u32,
        g: W,
        k: usize,
        parent: u32,
        bound: W,
        octile: &impl Fn(u32) -> W,
    ) {
        let generation = self.generation;
        let record = &mut self.records[at as usize];
        let arrival = 1 << k;
        let known = record.g;
        if record.generation == generation && g >= known {
            if g > known || record.arrivals & arrival != 0 {
                return;
            }
            // As good as the best, from elsewhere: other ways on may be due.
            record.arrivals |= arrival;
            if !record.closed {
                return;
            }
            record.closed = false;
        } else {
            *record = Record {
                g,
                parent,
                generation,
                arrivals: arrival,
                closed: false,
            };
        }
        let key = g + octile(at);
        if key < bound {
            self.open.push(key, at, g);
        } else {
            self.beyond = true;
        }
    }

    /// The path on which the last search reached its goal, the start first.
    pub(super) fn path(&self, problem: &GridProblem) -> Vec<Cell> {
        let layout = problem.grid().layout();
        let (mut id, start) = (layout.id(problem.goal()), layout.id(problem.start()));
        let weight = self.records[id as usize].g;
        let mut path = Vec::with_capacity(weight.over(W::STRAIGHT) + 1);
        path.push(problem.goal());
        while id != start {
            let parent = self.records[id as usize].parent;
            back(
                problem.moves(),
                layout.cell(parent),
                layout.cell(id),
                &mut path,
            );
            id = parent;
        }
        path.reverse();
        path
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        self.records.capacity() * size_of::<Record<W>>() + self.open.bytes()
    }
}

impl Hunt<'_> {
    /// The free cell at which a straight run stops, and how far it is.
    #[inline]
    fn run(&self, map: &JumpMap, from: Place, k: usize) -> Option<(u32, u32)> {
        let steps = map.scan(from, k);
        let offset = self.steps[k].0.wrapping_mul(steps.cast_signed());
        let at = from.id.wrapping_add_signed(offset);
        self.problem.grid().is_free_id(at).then_some((at, steps))
    }
}

/// Appends the cells from just before `to` back to `from`: a jump goes diagonally first, or up and
/// down first where there are no diagonals.
fn back(moves: Moves, from: Cell, to: Cell, path: &mut Vec<Cell>) {
    let mut at = to;
    while at != from {
        let (dx, dy) = (from.x.abs_diff(at.x), from.y.abs_diff(at.y));
        let (along, up) = match moves {
            Moves::Orthogonal => (dx > 0, dx == 0),
            _ => (dx >= dy, dy >= dx),
        };
        let toward = |at: u32, from: u32| if from > at { at + 1 } else { at - 1 };
        at = Cell {
            x: if along { toward(at.x, from.x) } else { at.x },
            y: if up { toward(at.y, from.y) } else { at.y },
        };
        path.push(at);
    }
}
