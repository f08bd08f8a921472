//! D* Lite (Koenig and Likhachev 2002): a search from the goal that is repaired, not repeated.

mod field;

use field::{End, Field};
use pf_core::{
    Claims, Context, InvalidParams, Outcome, Planner, Problem, Proof, Replanner, Report, Revision,
    Stamp, Unsupported, params,
};
use pf_grid::{GridChange, GridProblem, Word};

/// When to repair and when to start over.
#[derive(Clone, Debug, PartialEq)]
pub struct DStarLiteParams {
    /// A repair that has expanded this share of the cells the last plan from scratch expanded is
    /// given up for a new plan; a plan counts as 1,000 expansions at least. 0 never repairs,
    /// infinity never gives up.
    pub patience: f64,
}

impl Default for DStarLiteParams {
    /// An expansion of a repair costs some five times one of a plan, see `cargo xtask bench replan`.
    fn default() -> Self {
        Self { patience: 0.1 }
    }
}

params!(DStarLiteParams {
    patience: f64 = "share of a fresh plan's expansions after which a repair is given up",
});

/// Replans by repairing the distances to the goal where the change matters to the robot.
///
/// The distances are rooted at the goal, so a robot that moves and sees changes near itself costs
/// little. A moved goal has no use for them and is planned afresh, and so is a change so large that
/// repairing it would take longer. The note `replanned` says which it was: `repaired` or `afresh`.
/// One iteration is one expansion.
///
/// ```
/// use pf_core::{Context, Planner, Problem, Replanner};
/// use pf_classic::DStarLite;
/// use pf_grid::{Cell, Grid, GridChange, GridCost, GridProblem};
///
/// let grid = Grid::parse("
///     ...#.
///     .#.#.
///     .#...
/// ").unwrap();
/// let mut problem = GridProblem::new(grid, Cell::new(0, 0), Cell::new(4, 0)).unwrap();
/// let mut planner = DStarLite::default();
/// planner.plan(&problem, &mut Context::seeded(0)).unwrap();
///
/// let changes = [GridChange::StartMoved(Cell::new(1, 0)), GridChange::Freed(vec![Cell::new(3, 0)])];
/// let revision = problem.revise(&changes).unwrap();
/// let report = planner.replan(&revision, &mut Context::seeded(0)).unwrap();
/// assert_eq!(report.outcome.solved().unwrap().cost, GridCost::of_steps(3, 0));
/// assert_eq!(report.note("replanned"), Some("repaired"));
/// ```
#[derive(Clone, Debug, Default)]
pub struct DStarLite {
    params: DStarLiteParams,
    width: Width,
    /// What the field was last brought up to, but for `pending`.
    known: Option<Stamp>,
    /// Ids of cells that changed since; they may not matter, or stand for nothing.
    pending: Vec<u32>,
    /// Expansions of the last plan from scratch.
    effort: u64,
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

impl DStarLite {
    /// A planner that gives up repairs as `params` say.
    ///
    /// # Errors
    /// [`InvalidParams`] if the patience is negative or not a number.
    pub fn new(params: DStarLiteParams) -> Result<Self, InvalidParams> {
        if params.patience.is_nan() || params.patience < 0.0 {
            let value = params.patience.to_string();
            return Err(InvalidParams::bad("patience", &value, "a number from 0"));
        }
        Ok(Self {
            params,
            ..Self::default()
        })
    }

    /// Bytes of memory kept between calls.
    #[must_use]
    pub fn bytes(&self) -> usize {
        field!(&self.width, field => field.bytes()) + self.pending.capacity() * size_of::<u32>()
    }

    fn afresh(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Report<GridProblem> {
        self.known = None;
        self.pending.clear();
        if is_hopeless(problem) {
            return cx.report(Outcome::Infeasible);
        }
        let before = cx.stats().expanded;
        let end = self.plan_in_width(problem, cx);
        self.effort = cx.stats().expanded - before;
        if end == End::Settled {
            self.known = Some(problem.stamp());
        }
        self.read_off(problem, end, cx)
    }

    /// Plans in the narrowest width that orders the paths there are exactly.
    fn plan_in_width(&mut self, problem: &GridProblem, cx: &mut Context<'_, GridProblem>) -> End {
        if !field!(&self.width, field => field.covers(problem)) {
            self.width = Width::default();
        }
        loop {
            let end = field!(&mut self.width, field => plan_if_wide_enough(field, problem, cx));
            match end {
                Some(end) => return end,
                None => self.widen(),
            }
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

    /// How many expansions a repair is worth.
    #[expect(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a rough number; casts of floats saturate"
    )]
    fn patience(&self) -> u64 {
        (self.effort.max(1000) as f64 * self.params.patience) as u64
    }

    /// Repairs the field, if that is possible and worth it.
    fn repair(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Option<Report<GridProblem>> {
        let most = self.patience();
        // Looking at a changed cell's surroundings costs no less than an expansion.
        let serves = field!(&self.width, field => field.serves(problem));
        if !serves || self.pending.len() as u64 > most {
            return None;
        }
        let pending = &self.pending;
        let end = field!(&mut self.width, field => field.repair(problem, pending, most, cx));
        self.pending.clear();
        let narrow = field!(&self.width, field => field.is_too_narrow(problem.start()));
        if end == End::GaveUp || narrow && end == End::Settled {
            return None;
        }
        cx.note("replanned", "repaired");
        Some(self.read_off(problem, end, cx))
    }

    fn read_off(
        &self,
        problem: &GridProblem,
        end: End,
        cx: &mut Context<'_, GridProblem>,
    ) -> Report<GridProblem> {
        if end != End::Settled {
            return cx.report(Outcome::Unknown { attempt: None });
        }
        let path = field!(&self.width, field => field.path(problem));
        match path {
            Some(path) => cx.answer(problem, path, Proof::Optimal),
            None => cx.report(Outcome::Infeasible),
        }
    }
}

/// Whether no search is needed to see that there is no path.
fn is_hopeless(problem: &GridProblem) -> bool {
    let grid = problem.grid();
    !grid.is_free(problem.start()) || !grid.is_free(problem.goal())
}

fn plan_if_wide_enough<W: Word>(
    field: &mut Field<W>,
    problem: &GridProblem,
    cx: &mut Context<'_, GridProblem>,
) -> Option<End> {
    if !Field::<W>::fits(problem) {
        return None;
    }
    let end = field.plan(problem, cx);
    let narrow = end == End::Settled && field.is_too_narrow(problem.start());
    (!narrow).then_some(end)
}

impl Planner<GridProblem> for DStarLite {
    fn name(&self) -> &'static str {
        "D* Lite"
    }

    fn claims(&self) -> Claims {
        Claims::NONE
            .complete()
            .optimal()
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

impl Replanner<GridProblem> for DStarLite {
    fn replan(
        &mut self,
        revision: &Revision<'_, GridProblem>,
        cx: &mut Context<'_, GridProblem>,
    ) -> Result<Report<GridProblem>, Unsupported> {
        let problem = revision.problem();
        if let Some(changes) = revision.since(self.known) {
            let layout = problem.grid().layout();
            for change in changes {
                match change {
                    GridChange::Blocked(cells)
                    | GridChange::Freed(cells)
                    | GridChange::CostChanged(cells, _) => {
                        self.pending
                            .extend(cells.iter().map(|&cell| layout.id(cell)));
                    }
                    GridChange::StartMoved(_) | GridChange::GoalMoved(_) => {}
                }
            }
            self.known = Some(problem.stamp());
            if is_hopeless(problem) {
                // What changed waits until there is something to find.
                if self.pending.len() as u64 > self.patience() {
                    self.known = None;
                }
                return Ok(cx.report(Outcome::Infeasible));
            }
            if let Some(report) = self.repair(problem, cx) {
                return Ok(report);
            }
        }
        cx.note("replanned", "afresh");
        Ok(self.afresh(problem, cx))
    }

    /// Turns the open list of a plan into that of repairs: one iteration.
    fn settle(&mut self, problem: &GridProblem, cx: &mut Context<'_, GridProblem>) {
        if self.known == Some(problem.stamp()) && cx.proceed() {
            field!(&mut self.width, field => field.prepare(problem));
        }
    }
}
