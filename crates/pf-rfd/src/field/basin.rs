//! Two fields, what changed since they were exact, and their upkeep.

use super::{
    chain::{Chain, KEPT},
    marks::Marks,
    patch::Patch,
};
use pf_core::Context;
use pf_grid::{
    Cell, Damage, Distances, GridChange, GridProblem, Hold, LastPath, Layout, Search, Sweeper,
    Swept, Weights, Word,
};

/// What came of a question.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Found {
    /// [`Basin::take_path`] is the answer.
    Path,
    /// The last answer's path is it still.
    Held,
    /// [`Basin::way`] and the remnant of the last path at the goal, so far along; or at the start, if it is
    /// backward.
    Joined { is_backward: bool, along: usize },
    /// Proof that there is none.
    Nothing,
    /// The budget ran out.
    Cut,
    /// The word is too narrow for this map.
    TooFar,
}

/// A field, and what happened to the map since it was exact.
#[derive(Clone, Debug, Default)]
pub(super) struct Side<W: Word> {
    pub(super) field: Distances<W>,
    pub(super) damage: Damage<W>,
    /// Where in the log what happened since begins.
    pub(super) since: usize,
    /// Where what the damage does not know begins.
    noted: usize,
    /// Something was freed, or got cheaper.
    pub(super) opened: bool,
    /// Something was blocked, or got dearer.
    pub(super) closed: bool,
}

/// See [`RfdField`](super::RfdField).
#[derive(Clone, Debug)]
pub(super) struct Basin<W: Word> {
    pub(super) sides: [Side<W>; 2],
    pub(super) layout: Option<Layout>,
    sweeper: Sweeper<W>,
    pub(super) search: Search<W>,
    pub(super) marks: Marks,
    /// Ids of cells that changed since the older field was exact.
    pub(super) log: Vec<u32>,
    /// An answer's path, from the start; scratch.
    pub(super) path: Chain,
    /// A way that joins a remnant of the last path; scratch.
    pub(super) way: Vec<Cell>,
    /// Ids that a search expanded, as far as they may be raised; scratch.
    pub(super) expanded: Vec<u32>,
    /// Ends with no way between them, while nothing was opened since.
    pub(super) apart: Option<[Cell; 2]>,
    pub(super) patch: Patch<W>,
    /// Ends of the last question, and in how many questions running each was elsewhere than before.
    pub(super) ends: [Cell; 2],
    moves: [u32; 2],
    /// Expansions of the last sweep, and of answers since the fields were exact.
    effort: u64,
    pub(super) debt: u64,
}

impl<W: Word> Default for Basin<W> {
    fn default() -> Self {
        Self {
            sides: [Side::default(), Side::default()],
            layout: None,
            sweeper: Sweeper::default(),
            search: Search::default(),
            marks: Marks::default(),
            log: Vec::new(),
            path: Chain::default(),
            way: Vec::new(),
            expanded: Vec::new(),
            apart: None,
            patch: Patch::default(),
            ends: [Cell::default(); 2],
            moves: [0; 2],
            effort: 0,
            debt: 0,
        }
    }
}

/// An end that has moved in so many questions running gets no field.
const RESTLESS: u32 = 2;
/// And the other end's is repaired once answers have cost that part of a sweep.
const DEBT: u64 = 4;

impl<W: Word> Basin<W> {
    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        let sides = self.sides.iter();
        let sides = sides.map(|side| side.field.bytes() + side.damage.bytes());
        sides.sum::<usize>()
            + self.sweeper.bytes()
            + self.search.bytes()
            + self.marks.bytes()
            + self.patch.bytes()
            + self.path.bytes()
            + self.way.capacity() * size_of::<Cell>()
            + self.expanded.capacity() * size_of::<u32>()
            + self.log.capacity() * size_of::<u32>()
    }

    /// Whether it was made for grids of this shape.
    pub(super) fn covers(&self, problem: &GridProblem) -> bool {
        self.layout == Some(*problem.grid().layout())
    }

    /// The altitude of a cell above the goal, in steps.
    #[expect(clippy::cast_precision_loss, reason = "for looking at")]
    pub(super) fn altitude(&self, cell: Cell) -> Option<f64> {
        let layout = self.layout.filter(|layout| layout.contains(cell))?;
        let to_goal = |side: &&Side<W>| {
            let basis = side.field.basis();
            basis.is_some_and(|(root, _)| root == self.ends[1])
        };
        let side = self.sides.iter().find(to_goal)?;
        let (_, weights) = side.field.basis()?;
        let value = side.field.at(layout.id(cell));
        let unit = W::STRAIGHT.wide() as f64 * if weights.is_uniform() { 1.0 } else { 2.0 };
        (value < W::MAX).then(|| value.wide() as f64 / unit)
    }

    /// The path that was found, which is given away.
    pub(super) fn take_path(&mut self, problem: &GridProblem) -> Vec<Cell> {
        let cells = self.path.cells(problem.grid().layout());
        self.path.clear();
        self.path.shrink();
        cells
    }

    /// Nothing is known.
    pub(super) fn begin(&mut self, problem: &GridProblem) {
        self.layout = Some(*problem.grid().layout());
        self.sides.iter_mut().for_each(|side| side.field.forget());
        self.log.clear();
        self.debt = 0;
        self.apart = None;
        self.ends = [problem.start(), problem.goal()];
        self.moves = [0; 2];
    }

    /// Sweeps from the goal and reads the answer off.
    pub(super) fn plan(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Found {
        self.begin(problem);
        if !Distances::<W>::fit(problem) {
            return Found::TooFar;
        }
        match self.sweep(problem, 0, problem.goal(), cx) {
            Swept::Whole => {
                let none = LastPath::default();
                self.answer(problem, (&none, Hold::Gone), cx).0
            }
            Swept::TooFar => Found::TooFar,
            Swept::Cut | Swept::GaveUp => Found::Cut,
        }
    }

    fn sweep(
        &mut self,
        problem: &GridProblem,
        side: usize,
        root: Cell,
        cx: &mut Context<'_, GridProblem>,
    ) -> Swept {
        let before = cx.stats().expanded;
        let sweeper = &mut self.sweeper;
        let end = self.sides[side].field.sweep(problem, root, sweeper, cx);
        self.effort = cx.stats().expanded - before;
        self.sides[side].refresh(self.log.len());
        end
    }

    /// Takes note of what happened.
    pub(super) fn tell(&mut self, problem: &GridProblem, changes: &[GridChange]) {
        let ends = [problem.start(), problem.goal()];
        for (k, &end) in ends.iter().enumerate() {
            self.moves[k] = if end == self.ends[k] {
                0
            } else {
                self.moves[k].saturating_add(1)
            };
        }
        self.ends = ends;
        let layout = problem.grid().layout();
        for change in changes {
            let (cells, opens, closes) = match change {
                GridChange::Blocked(cells) => (cells, false, true),
                GridChange::Freed(cells) => (cells, true, false),
                GridChange::CostChanged(cells, _) => (cells, true, true),
                GridChange::StartMoved(_) | GridChange::GoalMoved(_) => continue,
            };
            if opens {
                self.apart = None;
            }
            for side in &mut self.sides {
                if opens {
                    side.field.lower();
                }
                side.opened |= opens;
                side.closed |= closes;
            }
            self.log.extend(cells.iter().map(|&cell| layout.id(cell)));
        }
        if self.log.len() > layout.len() / 2 {
            // More than a field is worth.
            self.sides.iter_mut().for_each(|side| side.field.forget());
            self.log.clear();
        }
    }

    /// Makes the fields of both ends exact, those of restless ends aside.
    pub(super) fn settle(
        &mut self,
        problem: &GridProblem,
        patience: f64,
        cx: &mut Context<'_, GridProblem>,
    ) -> Found {
        self.layout = Some(*problem.grid().layout());
        // This may be the first that a wider word hears of them.
        self.ends = [problem.start(), problem.goal()];
        if !Distances::<W>::fit(problem) {
            return Found::TooFar;
        }
        let mut wanted = Vec::with_capacity(2);
        for k in [1, 0] {
            if self.moves[k] < RESTLESS && !wanted.contains(&self.ends[k]) {
                wanted.push(self.ends[k]);
            }
        }
        let is_restless = self.moves.iter().any(|&moves| moves >= RESTLESS);
        if is_restless && self.debt < self.effort / DEBT {
            // They answer as they are for now.
            return Found::Path;
        }
        let roots = |sides: &[Side<W>; 2]| {
            [0, 1].map(|k: usize| sides[k].field.basis().map(|(root, _)| root))
        };
        for side in &mut self.sides {
            let basis = side.field.basis();
            if basis.is_some_and(|(root, _)| !wanted.contains(&root)) {
                side.field.forget();
            }
        }
        for root in wanted {
            let known = roots(&self.sides).iter().position(|&r| r == Some(root));
            let end = if let Some(side) = known {
                self.restore(problem, side, root, patience, cx)
            } else {
                let idle = roots(&self.sides).iter().position(Option::is_none);
                self.sweep(problem, idle.unwrap_or(1), root, cx)
            };
            match end {
                Swept::Whole => {}
                Swept::TooFar => return Found::TooFar,
                Swept::Cut | Swept::GaveUp => return Found::Cut,
            }
        }
        self.log.clear();
        self.log.shrink_to(KEPT);
        self.debt = 0;
        self.sides.iter_mut().for_each(|side| side.refresh(0));
        // Memory that the next answer may want.
        let layout = problem.grid().layout();
        self.search.prepare(layout);
        self.marks.prepare(layout.len());
        Found::Path
    }

    /// Repairs a field, or sweeps where that would take as long.
    #[expect(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a rough number; casts of floats saturate"
    )]
    fn restore(
        &mut self,
        problem: &GridProblem,
        side: usize,
        root: Cell,
        patience: f64,
        cx: &mut Context<'_, GridProblem>,
    ) -> Swept {
        let changed = &self.log[self.sides[side].since..];
        if changed.is_empty() {
            return Swept::Whole;
        }
        let most = (self.effort.max(200) as f64 * patience) as u64;
        if changed.len() as u64 <= most {
            let field = &mut self.sides[side].field;
            match field.repair(problem, changed, most, &mut self.sweeper, cx) {
                Swept::GaveUp => {}
                end => {
                    self.sides[side].refresh(self.log.len());
                    return end;
                }
            }
        }
        self.sweep(problem, side, root, cx)
    }
}

impl<W: Word> Side<W> {
    /// The field is exact.
    fn refresh(&mut self, now: usize) {
        self.damage.clear();
        (self.since, self.noted) = (now, now);
        (self.opened, self.closed) = (false, false);
    }

    /// Whether the damage knows of all that changed.
    pub(super) fn is_noted(&self, log: &[u32]) -> bool {
        self.noted == log.len()
    }

    /// Works out what the changes so far do to the field.
    pub(super) fn note(
        &mut self,
        problem: &GridProblem,
        log: &[u32],
        root: Cell,
        weights: Weights,
    ) {
        if self.is_noted(log) {
            return;
        }
        let octile = weights.octile::<W>(problem.grid(), problem.moves(), root);
        let field = &self.field;
        let news = &log[self.noted..];
        self.damage.add(problem, root, news, weights, |_, id| {
            (octile(id), field.at(id))
        });
        self.noted = log.len();
    }
}
