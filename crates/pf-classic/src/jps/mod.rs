//! Jump point search (Harabor and Grastien 2011, 2014) by scans of whole words.

mod jumps;
mod map;
mod nodes;
mod open;
mod patch;
mod prepared;
mod search;
mod table;
mod turns;

pub use prepared::{Prepared, PreparedParams};

use jumps::Scans;
use map::JumpMap;
use pf_core::{
    Claims, Context, InvalidParams, Outcome, Planner, Problem, Proof, Replanner, Report, Revision,
    Stamp, Unsupported, params,
};
use pf_grid::{Cell, GridChange, GridProblem, LastPath};
use search::{ExactJumps, Found};

/// Jump point search has no parameters.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct JpsParams {}

params!(JpsParams {});

/// A* that goes from one jump point to the next: cells where a shortest path may have to turn.
///
/// What lies between is scanned 64 cells at a time, in bits that say where a scan in a straight
/// direction stops. They are made at the first query on a grid, in a nanosecond or two a cell, and
/// follow its changes. One iteration is one jump point expanded. After a call the next allocates
/// only the path it returns, unless it reaches more. A replan learns what is left from where it was, for the next
/// one to the same goal, until a cell is freed (Koenig and Likhachev, *Adaptive A\**, 2005).
///
/// Any move rule; no terrain ([`Unsupported`]).
///
/// ```
/// use pf_core::{Context, Outcome, Planner};
/// use pf_classic::Jps;
/// use pf_grid::{Cell, Grid, GridCost, GridProblem};
///
/// let grid = Grid::parse("
///     .....
///     .@@@.
///     .....
/// ").unwrap();
/// let problem = GridProblem::new(grid, Cell::new(0, 0), Cell::new(4, 2)).unwrap();
/// let report = Jps::default().plan(&problem, &mut Context::seeded(0)).unwrap();
/// let Outcome::Optimal(best) = report.outcome else { panic!() };
/// assert_eq!(best.cost, GridCost::of_steps(6, 0));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Jps {
    map: JumpMap,
    search: ExactJumps,
    /// The problem whose grid the map is known to be that of.
    known: Option<Stamp>,
}

impl Jps {
    /// A planner.
    ///
    /// # Errors
    /// None today.
    pub fn new(_: JpsParams) -> Result<Self, InvalidParams> {
        Ok(Self::default())
    }

    /// Makes its bits for a problem's grid, unless they are of that.
    pub(crate) fn look_at(&mut self, problem: &GridProblem) {
        if !self.map.is_of(problem.grid(), problem.moves()) {
            self.map.make(problem.grid(), problem.moves());
            self.search.forget();
        }
        self.known = Some(problem.stamp());
    }

    /// Follows changes with its bits.
    fn follow(&mut self, revision: &Revision<'_, GridProblem>) {
        if let Some(changes) = revision.since(self.known) {
            let (cells, opened) = flipped(changes);
            self.catch_up(revision.problem(), cells, opened);
        }
    }

    /// Whether it knows of all that changed up to there.
    pub(crate) fn is_known(&self, stamp: Option<Stamp>) -> bool {
        self.known == stamp
    }

    /// The same, told of the cells that changed since, and whether any of them was freed.
    pub(crate) fn catch_up(
        &mut self,
        problem: &GridProblem,
        cells: impl Iterator<Item = Cell>,
        opened: bool,
    ) {
        self.map.follow(problem.grid(), cells);
        if opened {
            self.search.forget();
        }
        self.known = Some(problem.stamp());
    }

    /// Bytes of memory kept between calls.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.map.bytes() + self.search.bytes()
    }
}

impl Planner<GridProblem> for Jps {
    fn name(&self) -> &'static str {
        "JPS"
    }

    fn claims(&self) -> Claims {
        Claims::NONE.complete().optimal().deterministic()
    }

    fn plan(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Result<Report<GridProblem>, Unsupported> {
        self.answer(problem, false, None, cx)
    }
}

impl Jps {
    /// Answers. If it learns, answers to come take less. Where a last path is given, it ends where it can join what is
    /// left of that, and leaves the path it found in its place.
    pub(crate) fn answer(
        &mut self,
        problem: &GridProblem,
        learns: bool,
        mut last: Option<&mut LastPath>,
        cx: &mut Context<'_, GridProblem>,
    ) -> Result<Report<GridProblem>, Unsupported> {
        let grid = problem.grid();
        if !grid.is_uniform() {
            let reason = "it needs cells that all cost the same";
            return Err(Unsupported::new(self.name(), reason));
        }
        if !grid.is_free(problem.start()) || !grid.is_free(problem.goal()) {
            return Ok(cx.report(Outcome::Infeasible));
        }
        self.look_at(problem);
        self.map.mark(problem.goal());
        let jumps = Scans::of(problem, &self.map);
        let found = self
            .search
            .find(problem, &jumps, learns, last.as_deref(), cx);
        if let (Found::Joined(way, along), Some(last)) = (&found, &mut last) {
            let report = last.rejoin(problem, (false, *along), way, cx);
            debug_assert!(
                report.is_some(),
                "the judge refuses a way that was found legal"
            );
            return report.map_or_else(|| self.answer(problem, learns, None, cx), Ok);
        }
        let report = report(problem, found, cx);
        if let Some(last) = last {
            last.remember(problem, &report);
        }
        Ok(report)
    }
}

/// The cells that changes block or free, and whether they free any.
pub(crate) fn flipped(changes: &[GridChange]) -> (impl Iterator<Item = Cell>, bool) {
    let cells = changes.iter().flat_map(|change| match change {
        GridChange::Blocked(cells) | GridChange::Freed(cells) => &cells[..],
        _ => &[],
    });
    let opened = changes.iter().any(|it| matches!(it, GridChange::Freed(_)));
    (cells.copied(), opened)
}

fn report(
    problem: &GridProblem,
    found: Found,
    cx: &mut Context<'_, GridProblem>,
) -> Report<GridProblem> {
    match found {
        Found::Path(path) => cx.answer(problem, path, Proof::Optimal),
        Found::Nothing => cx.report(Outcome::Infeasible),
        Found::Cut | Found::Joined(..) => cx.report(Outcome::Unknown { attempt: None }),
    }
}

impl Replanner<GridProblem> for Jps {
    /// Follows the changes with its bits, and searches again.
    fn replan(
        &mut self,
        revision: &Revision<'_, GridProblem>,
        cx: &mut Context<'_, GridProblem>,
    ) -> Result<Report<GridProblem>, Unsupported> {
        self.follow(revision);
        self.answer(revision.problem(), true, None, cx)
    }
}
