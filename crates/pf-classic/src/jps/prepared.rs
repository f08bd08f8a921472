//! Jump point search with the lengths of all jumps made beforehand.

use super::{
    report,
    search::ExactJumps,
    table::{JumpTable, Lookups},
};
use crate::Auto;
use pf_core::{
    Claims, Context, InvalidParams, Outcome, Planner, Problem, Replanner, Report, Revision, Stamp,
    Unsupported, params,
};
use pf_grid::GridProblem;

/// A prepared search has no parameters.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PreparedParams {}

params!(PreparedParams {});

/// Jump point search on a map that is asked often: the length of every jump from every cell is looked
/// up.
///
/// The first query on a grid makes the table: 16 bytes a cell, in some tens of nanoseconds a cell. A
/// change of the map makes it worthless; then [`Auto`] answers, until `settle` makes a new one. It also
/// answers where a table is of no use: on terrain, among strewn obstacles, and on maps of over 32,767
/// cells in a row; the note `search` says so. One iteration is one jump point expanded.
///
/// Source: Harabor and Grastien, *Improving Jump Point Search*, 2014 (JPS+).
///
/// ```
/// use pf_core::{Context, Outcome, Planner};
/// use pf_classic::Prepared;
/// use pf_grid::{Cell, Grid, GridCost, GridProblem};
///
/// let grid = Grid::parse("
///     .....
///     .@@@.
///     .....
/// ").unwrap();
/// let problem = GridProblem::new(grid, Cell::new(0, 0), Cell::new(4, 2)).unwrap();
/// let report = Prepared::default().plan(&problem, &mut Context::seeded(0)).unwrap();
/// let Outcome::Optimal(best) = report.outcome else { panic!() };
/// assert_eq!(best.cost, GridCost::of_steps(6, 0));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Prepared {
    table: JumpTable,
    search: ExactJumps,
    auto: Auto,
    /// Of the problem that was answered last.
    known: Option<Stamp>,
}

impl Prepared {
    /// A planner.
    ///
    /// # Errors
    /// None today.
    pub fn new(_: PreparedParams) -> Result<Self, InvalidParams> {
        Ok(Self::default())
    }

    /// Makes the table for a problem's grid, unless it has it: what the first query does otherwise.
    /// Says whether a table is of use there.
    pub fn prepare(&mut self, problem: &GridProblem) -> bool {
        let (grid, moves) = (problem.grid(), problem.moves());
        if self.table.is_of(grid, moves) {
            return true;
        }
        let can = JumpTable::fits(grid) && self.auto.would_jump(problem);
        if can {
            self.table.make(grid, moves);
        }
        can
    }

    /// Bytes of memory kept between calls.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.table.bytes() + self.search.bytes() + self.auto.bytes()
    }
}

impl Planner<GridProblem> for Prepared {
    fn name(&self) -> &'static str {
        "JPS+"
    }

    fn claims(&self) -> Claims {
        Claims::NONE.complete().optimal().deterministic()
    }

    fn plan(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Result<Report<GridProblem>, Unsupported> {
        self.known = Some(problem.stamp());
        if !self.prepare(problem) {
            return self.auto.plan(problem, cx);
        }
        let grid = problem.grid();
        if !grid.is_free(problem.start()) || !grid.is_free(problem.goal()) {
            return Ok(cx.report(Outcome::Infeasible));
        }
        let jumps = Lookups::of(problem, &self.table);
        let found = self.search.find(problem, &jumps, false, None, cx);
        Ok(report(problem, found, cx))
    }
}

impl Replanner<GridProblem> for Prepared {
    /// By the table, if it still holds; else as [`Auto`] does.
    fn replan(
        &mut self,
        revision: &Revision<'_, GridProblem>,
        cx: &mut Context<'_, GridProblem>,
    ) -> Result<Report<GridProblem>, Unsupported> {
        let problem = revision.problem();
        if self.table.is_of(problem.grid(), problem.moves()) {
            return self.plan(problem, cx);
        }
        self.known = Some(problem.stamp());
        self.auto.replan(revision, cx)
    }

    /// Makes the table anew if the map changed: in the time of a hundred searches or so.
    fn settle(&mut self, problem: &GridProblem, cx: &mut Context<'_, GridProblem>) {
        let stale = !self.table.is_of(problem.grid(), problem.moves());
        if stale && self.known == Some(problem.stamp()) && cx.proceed() {
            self.prepare(problem);
        }
    }
}
