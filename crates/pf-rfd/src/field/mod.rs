//! The altitude field: distances from both ends, kept whole between answers.

mod answer;
mod basin;
mod chain;
mod freed;
mod marks;
mod patch;

use basin::{Basin, Found};
use pf_core::{
    Claims, Context, InvalidParams, Outcome, Planner, Problem, Proof, Replanner, Report, Revision,
    Stamp, Unsupported, params,
};
use pf_grid::{Bend, Cell, GridProblem, Hold, LastPath, U48};

/// When an [`RfdField`] repairs and when it sweeps.
#[derive(Clone, Debug, PartialEq)]
pub struct RfdFieldParams {
    /// A repair of a field that has expanded this share of what a sweep expands is given up for a
    /// sweep. 0 never repairs, infinity never gives up.
    pub patience: f64,
}

impl Default for RfdFieldParams {
    /// An expansion of a repair costs some four times one of a sweep, and most repairs that come so
    /// far go on for long.
    fn default() -> Self {
        Self { patience: 0.2 }
    }
}

params!(RfdFieldParams {
    patience: f64 = "share of a sweep's expansions after which a repair of a field is given up",
});

/// Replans by two altitude fields, the distances to the goal and to the start: what the altitudes
/// of RFD* are after, kept exact.
///
/// The answer comes before the upkeep. Where an end moved, the field of the other end holds the
/// answer: water runs down it. Where cells were blocked, the old way may still hold, else a search
/// from the end nearer the break goes as far as an old way on is intact, or to where what is left of the last
/// path is joined; what it finds out raises the field until cells are freed. Where cells were freed, the
/// two fields tell what a way over them would cost at the least: either none beats the old one, or a
/// search that begins at the freed cells finds the best. The note `replanned` says how the answer
/// came: `kept` (what is left of the last path, or read off the fields), `patched` (over freed
/// cells), `searched` (by a search that the fields direct), or `afresh` (as A\*, for the fields say
/// nothing, as when both ends moved and cells changed).
///
/// [`settle`](Replanner::settle) makes the fields right again, by repair or sweep. An end that moves
/// time and again gets no field: it would be wrong before it was of use. Without `settle` the answers
/// are right as well, from fields that are bounds only. There is no chance in it. One iteration is
/// one expansion.
///
/// Sources: the fields and their use are ours, after Redlarski, Dabkowski, Palkowski; searches that
/// stop where an old way holds are those of Hernandez, Asin, Baier (MPAA\*, 2014) and Koenig,
/// Likhachev (Adaptive A\*, 2005); repairs are those of Ramalingam and Reps, 1996; differences of
/// distances as a heuristic are Goldberg and Harrelson's (ALT, 2005).
///
/// ```
/// use pf_core::{Context, Planner, Problem, Replanner};
/// use pf_grid::{Cell, Grid, GridChange, GridCost, GridProblem};
/// use pf_rfd::RfdField;
///
/// let grid = Grid::parse("
///     ...#.
///     .#.#.
///     .#...
/// ").unwrap();
/// let mut problem = GridProblem::new(grid, Cell::new(0, 0), Cell::new(4, 0)).unwrap();
/// let mut planner = RfdField::default();
/// planner.plan(&problem, &mut Context::seeded(0)).unwrap();
/// planner.settle(&problem, &mut Context::seeded(0));
///
/// let changes = [GridChange::Freed(vec![Cell::new(3, 0)])];
/// let revision = problem.revise(&changes).unwrap();
/// let report = planner.replan(&revision, &mut Context::seeded(0)).unwrap();
/// assert_eq!(report.outcome.solved().unwrap().cost, GridCost::of_steps(4, 0));
/// assert_eq!(report.note("replanned"), Some("patched"));
/// ```
#[derive(Clone, Debug, Default)]
pub struct RfdField {
    params: RfdFieldParams,
    width: Width,
    /// What the changes are known up to.
    known: Option<Stamp>,
    /// The last answer's path: while that holds, and nothing but the robot's place and blocked cells
    /// change, no field is asked.
    last: LastPath,
}

#[derive(Clone, Debug)]
enum Width {
    Narrow(Basin<u32>),
    Wide(Basin<U48>),
    Wider(Basin<u64>),
    Huge(Basin<u128>),
}

impl Default for Width {
    fn default() -> Self {
        Self::Narrow(Basin::default())
    }
}

/// The same for whichever width is in use.
macro_rules! basin {
    ($width:expr, $basin:ident => $work:expr) => {
        match $width {
            Width::Narrow($basin) => $work,
            Width::Wide($basin) => $work,
            Width::Wider($basin) => $work,
            Width::Huge($basin) => $work,
        }
    };
}

impl RfdField {
    /// A field that gives up repairs as `params` say.
    ///
    /// # Errors
    /// [`InvalidParams`] if the patience is negative or not a number.
    pub fn new(params: RfdFieldParams) -> Result<Self, InvalidParams> {
        if params.patience.is_nan() || params.patience < 0.0 {
            let value = params.patience.to_string();
            return Err(InvalidParams::bad("patience", &value, "a number from 0"));
        }
        Ok(Self {
            params,
            ..Self::default()
        })
    }

    /// What it was made with.
    #[must_use]
    pub fn params(&self) -> &RfdFieldParams {
        &self.params
    }

    /// The altitude of a cell: its distance to the goal, in cells, as of the last time the field was
    /// made or repaired, or a bound from below that a search has found since. `None` if there is no way
    /// from there, or no field.
    #[must_use]
    pub fn altitude(&self, cell: Cell) -> Option<f64> {
        basin!(&self.width, basin => basin.altitude(cell))
    }

    /// Bytes of memory kept between calls.
    #[must_use]
    pub fn bytes(&self) -> usize {
        basin!(&self.width, basin => basin.bytes()) + self.last.bytes()
    }

    fn report(
        &mut self,
        problem: &GridProblem,
        found: Found,
        cx: &mut Context<'_, GridProblem>,
    ) -> Report<GridProblem> {
        let report = match found {
            Found::Path => {
                let path = basin!(&mut self.width, basin => basin.take_path(problem));
                cx.answer(problem, path, Proof::Optimal)
            }
            Found::Nothing => cx.report(Outcome::Infeasible),
            Found::Held | Found::Joined { .. } | Found::Cut | Found::TooFar => {
                cx.report(Outcome::Unknown { attempt: None })
            }
        };
        self.last.remember(problem, &report);
        report
    }

    fn show(&self, cx: &mut Context<'_, GridProblem>) {
        cx.field("altitude", |&cell: &Cell| {
            self.altitude(cell).unwrap_or(f64::NAN)
        });
    }
}

impl Width {
    /// Works in the narrowest width that orders the paths there are exactly.
    fn work(&mut self, mut work: impl FnMut(&mut Self) -> Found) -> Found {
        loop {
            let found = work(self);
            if found != Found::TooFar {
                return found;
            }
            self.widen();
        }
    }

    fn widen(&mut self) {
        // The old memory goes before the new comes, as that comes with use.
        *self = match self {
            Self::Narrow(_) => Self::Wide(Basin::default()),
            Self::Wide(_) => Self::Wider(Basin::default()),
            Self::Wider(_) | Self::Huge(_) => Self::Huge(Basin::default()),
        };
    }
}

/// Whether no search is needed to see that there is no path.
fn is_hopeless(problem: &GridProblem) -> bool {
    let grid = problem.grid();
    !grid.is_free(problem.start()) || !grid.is_free(problem.goal())
}

impl Planner<GridProblem> for RfdField {
    fn name(&self) -> &'static str {
        "altitude field"
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
        if !basin!(&self.width, basin => basin.covers(problem)) {
            self.width = Width::default();
        }
        self.known = Some(problem.stamp());
        if is_hopeless(problem) {
            basin!(&mut self.width, basin => basin.begin(problem));
            return Ok(cx.report(Outcome::Infeasible));
        }
        let found = self
            .width
            .work(|width| basin!(width, basin => basin.plan(problem, cx)));
        self.show(cx);
        Ok(self.report(problem, found, cx))
    }
}

impl Replanner<GridProblem> for RfdField {
    fn replan(
        &mut self,
        revision: &Revision<'_, GridProblem>,
        cx: &mut Context<'_, GridProblem>,
    ) -> Result<Report<GridProblem>, Unsupported> {
        let problem = revision.problem();
        let Some(changes) = revision.since(self.known) else {
            cx.note("replanned", "afresh");
            return self.plan(problem, cx);
        };
        self.known = Some(problem.stamp());
        basin!(&mut self.width, basin => basin.tell(problem, changes));
        let last = self.last.follow(revision, Bend::Far);
        if is_hopeless(problem) {
            return Ok(cx.report(Outcome::Infeasible));
        }
        if !cx.proceed() {
            return Ok(cx.report(Outcome::Unknown { attempt: None }));
        }
        let mut how = "";
        let found = if last == Hold::Best {
            Found::Held
        } else {
            let last = (&self.last, last);
            self.width.work(|width| {
                let (found, way) = basin!(width, basin => basin.answer(problem, last, cx));
                how = way.name();
                found
            })
        };
        if found == Found::Held
            && let Some(report) = self.last.keep(problem, cx)
        {
            return Ok(report);
        }
        cx.note("replanned", how);
        if let Found::Joined { is_backward, along } = found {
            let way = basin!(&self.width, basin => &basin.way);
            let report = self.last.rejoin(problem, (is_backward, along), way, cx);
            debug_assert!(
                report.is_some(),
                "the judge refuses a way that was found legal"
            );
            return report.map_or_else(|| self.plan(problem, cx), Ok);
        }
        Ok(self.report(problem, found, cx))
    }

    /// Makes the fields of the ends right again: an expansion an iteration.
    fn settle(&mut self, problem: &GridProblem, cx: &mut Context<'_, GridProblem>) {
        if self.known != Some(problem.stamp()) || !cx.proceed() {
            return;
        }
        let patience = self.params.patience;
        self.width
            .work(|width| basin!(width, basin => basin.settle(problem, patience, cx)));
        self.show(cx);
    }
}
