//! RFD made exact: altitudes that are lower bounds, drops that prove a path.

mod field;

use field::{End, Field};
use pf_core::{
    Claims, Context, InvalidParams, Outcome, Planner, Problem, Proof, Replanner, Report, Revision,
    Stamp, Unsupported, params,
};
use pf_grid::{Cell, GridChange, GridProblem, Word};

/// How an [`RfdExact`] fills pools.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RfdExactParams {
    /// Cells of the first pool; each holds twice as many as the one before.
    pub pool: usize,
}

impl Default for RfdExactParams {
    fn default() -> Self {
        Self { pool: 16 }
    }
}

params!(RfdExactParams {
    pool: usize = "cells of the first pool; each holds twice as many as the one before",
});

/// River Formation Dynamics made exact: the best path, proven.
///
/// The bed begins as the octile distance to the goal, a lower bound. A drop goes to the neighbour with
/// the least step and altitude; where a cell lies lower than that, the drop is caught in a pool, and
/// sediment fills the pool up to its lowest outlet. When a drop has arrived a backward pass follows its
/// way. Altitudes stay lower bounds, so a drop that changes nothing has gone a shortest way, and a pool
/// without an outlet proves that there is none.
///
/// Each drop that arrives is a solution: it may be stopped at any time. One iteration is one step of a
/// drop or one cell of a pool. After a change the bed is kept: where cells were freed it sinks until it
/// is a lower bound again, and for a moved goal it is lowered by the distance between the two. The note
/// `replanned` says `kept` or `afresh`.
///
/// In the words of heuristic search the drops are LRTA* (Korf, *Real-Time Heuristic Search*, 1990), the
/// pools are those of RTAA* (Koenig, Likhachev, *Real-Time Adaptive A\**, 2006), and the lowering for
/// a moved goal is that of Koenig, Likhachev, Sun, *Speeding up Moving-Target Search*, 2007.
///
/// ```
/// use pf_core::{Context, Planner, Problem, Replanner};
/// use pf_grid::{Cell, Grid, GridChange, GridCost, GridProblem};
/// use pf_rfd::RfdExact;
///
/// let grid = Grid::parse("
///     ...#.
///     .#.#.
///     .#...
/// ").unwrap();
/// let mut problem = GridProblem::new(grid, Cell::new(0, 0), Cell::new(4, 0)).unwrap();
/// let mut planner = RfdExact::default();
/// planner.plan(&problem, &mut Context::seeded(0)).unwrap();
///
/// let changes = [GridChange::Freed(vec![Cell::new(3, 0)])];
/// let revision = problem.revise(&changes).unwrap();
/// let report = planner.replan(&revision, &mut Context::seeded(0)).unwrap();
/// assert_eq!(report.outcome.solved().unwrap().cost, GridCost::of_steps(4, 0));
/// assert_eq!(report.note("replanned"), Some("kept"));
/// ```
#[derive(Clone, Debug, Default)]
pub struct RfdExact {
    params: RfdExactParams,
    width: Width,
    /// What the altitudes are bounds for.
    known: Option<Stamp>,
    /// There was no path.
    closed: bool,
    /// The path proven best, if one was.
    best: Vec<Cell>,
}

#[derive(Clone, Debug)]
enum Width {
    Narrow(Field<u32>),
    Wide(Field<u64>),
    Huge(Field<u128>),
}

impl Default for Width {
    fn default() -> Self {
        Self::Narrow(Field::default())
    }
}

/// The same for whichever width is in use.
macro_rules! field {
    ($width:expr, $field:ident => $work:expr) => {
        match $width {
            Width::Narrow($field) => $work,
            Width::Wide($field) => $work,
            Width::Huge($field) => $work,
        }
    };
}

impl RfdExact {
    /// A river that fills pools as `params` say.
    ///
    /// # Errors
    /// [`InvalidParams`] if a pool holds nothing.
    pub fn new(params: RfdExactParams) -> Result<Self, InvalidParams> {
        if params.pool == 0 {
            return Err(InvalidParams::bad("pool", "0", "a whole number from 1"));
        }
        Ok(Self {
            params,
            ..Self::default()
        })
    }

    /// What it was made with.
    #[must_use]
    pub fn params(&self) -> &RfdExactParams {
        &self.params
    }

    /// The altitude of a cell after the last answer: a lower bound on its distance to the goal, in
    /// cells. 0 if there is no such cell.
    #[must_use]
    pub fn altitude(&self, cell: Cell) -> f64 {
        field!(&self.width, field => field.altitude(cell))
    }

    /// Bytes of memory kept between calls.
    #[must_use]
    pub fn bytes(&self) -> usize {
        field!(&self.width, field => field.bytes())
    }

    fn afresh(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Report<GridProblem> {
        self.forget_answer();
        if is_hopeless(problem) {
            return cx.report(Outcome::Infeasible);
        }
        if !field!(&self.width, field => field.covers(problem)) {
            self.width = Width::default();
        }
        let first = self.params.pool;
        loop {
            let end = field!(&mut self.width, field => begin_and_run(field, problem, first, cx));
            if end != End::TooFar {
                return self.read_off(problem, end, cx);
            }
            self.widen();
        }
    }

    fn widen(&mut self) {
        // The old memory goes before the new comes.
        let narrow = matches!(self.width, Width::Narrow(_));
        self.width = Width::default();
        self.width = if narrow {
            Width::Wide(Field::default())
        } else {
            Width::Huge(Field::default())
        };
    }

    fn read_off(
        &mut self,
        problem: &GridProblem,
        end: End,
        cx: &mut Context<'_, GridProblem>,
    ) -> Report<GridProblem> {
        // Cut short, the altitudes are bounds all the same.
        self.known = Some(problem.stamp());
        self.closed = end == End::Closed;
        if self.closed {
            return cx.report(Outcome::Infeasible);
        }
        let path = field!(&self.width, field => field.path());
        if path.is_empty() {
            return cx.report(Outcome::Unknown { attempt: None });
        }
        if end == End::Proved {
            self.best.clone_from(&path);
        }
        cx.answer(problem, path, Proof::Optimal)
    }

    fn forget_answer(&mut self) {
        self.known = None;
        self.closed = false;
        self.best.clear();
    }

    /// The last answer, if no drop is needed to see that it still holds: blocked cells open no way
    /// and make none shorter, and the rest of a shortest path is one.
    fn unmoved(
        &mut self,
        problem: &GridProblem,
        changes: &[GridChange],
        cx: &mut Context<'_, GridProblem>,
    ) -> Option<Report<GridProblem>> {
        let all = |fine: fn(&GridChange) -> bool| changes.iter().all(fine);
        if self.closed && all(|change| matches!(change, GridChange::Blocked(_))) {
            self.known = Some(problem.stamp());
            return Some(cx.report(Outcome::Infeasible));
        }
        let harmless =
            |change: &_| matches!(change, GridChange::Blocked(_) | GridChange::StartMoved(_));
        if !all(harmless) {
            return None;
        }
        let at = self.best.iter().position(|&cell| cell == problem.start())?;
        if problem.judge(&self.best[at..].to_vec()).is_err() {
            return None;
        }
        self.best.drain(..at);
        self.known = Some(problem.stamp());
        if !cx.proceed() {
            return Some(cx.report(Outcome::Unknown { attempt: None }));
        }
        cx.note("replanned", "kept");
        Some(cx.answer(problem, self.best.clone(), Proof::Optimal))
    }
}

/// Whether no drop is needed to see that there is no path.
fn is_hopeless(problem: &GridProblem) -> bool {
    let grid = problem.grid();
    !grid.is_free(problem.start()) || !grid.is_free(problem.goal())
}

fn begin_and_run<W: Word>(
    field: &mut Field<W>,
    problem: &GridProblem,
    first: usize,
    cx: &mut Context<'_, GridProblem>,
) -> End {
    if !Field::<W>::fits(problem) {
        return End::TooFar;
    }
    field.begin(problem);
    field.run(problem, first, cx)
}

impl Planner<GridProblem> for RfdExact {
    fn name(&self) -> &'static str {
        "exact RFD"
    }

    fn claims(&self) -> Claims {
        Claims::NONE
            .complete()
            .optimal()
            .anytime()
            .deterministic()
            .incremental()
    }

    fn plan(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Result<Report<GridProblem>, Unsupported> {
        Ok(self.afresh(problem, cx))
    }
}

impl Replanner<GridProblem> for RfdExact {
    fn replan(
        &mut self,
        revision: &Revision<'_, GridProblem>,
        cx: &mut Context<'_, GridProblem>,
    ) -> Result<Report<GridProblem>, Unsupported> {
        let problem = revision.problem();
        if let Some(changes) = revision.since(self.known) {
            if let Some(report) = self.unmoved(problem, changes, cx) {
                return Ok(report);
            }
            self.forget_answer();
            let kept = field!(&mut self.width, field => field.follow(problem, changes, cx));
            if cx.stopped() {
                return Ok(cx.report(Outcome::Unknown { attempt: None }));
            }
            if kept.is_some() {
                if is_hopeless(problem) {
                    self.known = Some(problem.stamp());
                    return Ok(cx.report(Outcome::Infeasible));
                }
                let first = self.params.pool;
                let end = field!(&mut self.width, field => field.run(problem, first, cx));
                if end != End::TooFar {
                    cx.note("replanned", "kept");
                    return Ok(self.read_off(problem, end, cx));
                }
            }
        }
        cx.note("replanned", "afresh");
        Ok(self.afresh(problem, cx))
    }
}
