//! D* Lite (Koenig and Likhachev 2002): a search from the goal that is repaired, not repeated.

mod distances;
mod glance;
mod guided;
mod jumping;

use crate::{Auto, jps::flipped};
use guided::{Found, Guided, Way};
use pf_core::{
    Claims, Context, InvalidParams, Outcome, Planner, Problem, Proof, Replanner, Report, Revision,
    Stamp, Unsupported, params,
};
use pf_grid::{Confines, GridChange, GridProblem, LastPath};

/// When to repair and when to start over.
#[derive(Clone, Debug, PartialEq)]
pub struct DStarLiteParams {
    /// A repair that has expanded this share of the cells the last plan from scratch expanded is
    /// given up for a new plan; a plan counts as 1,000 expansions at least. 0 never repairs,
    /// infinity never gives up.
    pub patience: f64,
    /// Whether every change is repaired before the answer, as published. Otherwise the answer
    /// comes first, from a search that the distances direct as they are, and they are repaired in
    /// `settle`, once such searches have cost more than a repair.
    pub eager: bool,
}

impl Default for DStarLiteParams {
    /// An expansion of a repair costs some five times one of a plan, see `cargo xtask bench replan`.
    fn default() -> Self {
        Self {
            patience: 0.1,
            eager: false,
        }
    }
}

params!(DStarLiteParams {
    patience: f64 = "share of a fresh plan's expansions after which a repair is given up",
    eager: bool = "whether every change is repaired before the answer, as published",
});

/// Replans with the distances to the goal, repaired where a change matters to the robot.
///
/// The distances are rooted at the goal, so a robot that moves and sees changes near itself costs
/// little. An answer comes in one of six ways; the note `replanned` says which: `kept`, where the
/// last path is still best; `searched`, by a search from the robot that ends where distances are
/// known; `jumped`, by jump points where such searches take long, as on a map of which little is
/// known yet or to a goal that moved; `shut in`, where much changed and a look around the robot finds no way
/// out; `repaired`, from repaired distances; `afresh`, by a search from the robot where nothing of use is known: the
/// distances are made in `settle` then. One iteration is one expansion.
///
/// Where nothing stands between start and goal, or hardly anything on the map, a plan takes no distances, nor does
/// `settle` make any as long as jumps take little: they would say no more than how far it is.
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
/// assert_eq!(report.note("replanned"), Some("searched"));
/// ```
#[derive(Clone, Debug, Default)]
pub struct DStarLite {
    params: DStarLiteParams,
    width: Width,
    /// What the changes are known up to.
    known: Option<Stamp>,
    /// Ids of cells that changed since the field was settled; they may not matter, or stand for
    /// nothing.
    pending: Vec<u32>,
    /// The first of them that the answers do not know of.
    told: usize,
    /// Expansions of the last search from scratch, from either end.
    effort: u64,
    /// Expansions of answers since the field was settled.
    debt: u64,
    /// The last answer, and to what.
    last: Option<(Stamp, Found)>,
    /// Answers by jump points where searches take long, once there was reason to make their bits.
    auto: Auto,
    /// If it knows the grid: the first of the pending cells of which it does not.
    behind: Option<usize>,
    /// Whether any of those was freed.
    opened: bool,
    /// How many cells a jump expands, most of which join the last path; 0 as long as none was made since the last plan.
    jump_effort: u64,
    /// How many more searches were given up than were not since the distances were made or repaired.
    given_up: u32,
    /// Its path, which needs none of the above while nothing but the robot's place and blocked cells
    /// change.
    last_path: LastPath,
    confines: Confines,
}

#[derive(Clone, Debug)]
enum Width {
    Narrow(Guided<u32>),
    Wide(Guided<u64>),
    Huge(Guided<u128>),
}

impl Default for Width {
    fn default() -> Self {
        Self::Narrow(Guided::default())
    }
}

/// So many times the expansions of a plan may be spent on answers before the distances are made
/// right: it takes about as long.
const DEBT: u64 = 3;

/// The same for whichever width is in use.
macro_rules! guided {
    ($width:expr, $guided:ident => $work:expr) => {
        match $width {
            Width::Narrow($guided) => $work,
            Width::Wide($guided) => $work,
            Width::Huge($guided) => $work,
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
        guided!(&self.width, guided => guided.bytes())
            + self.pending.capacity() * size_of::<u32>()
            + self.last_path.bytes()
            + self.confines.bytes()
            + self.auto.bytes()
    }

    /// Makes the distances anew, such as can be repaired if repairs are to come.
    fn refresh(
        &mut self,
        problem: &GridProblem,
        to_repair: bool,
        cx: &mut Context<'_, GridProblem>,
    ) -> Found {
        self.forget_changes();
        self.known = None;
        let before = cx.stats().expanded;
        let found = loop {
            let found = guided!(&mut self.width, guided => if to_repair {
                guided.found(problem, cx)
            } else {
                guided.plan(problem, cx)
            });
            if found != Found::TooFar {
                break found;
            }
            self.width.widen();
        };
        self.effort = cx.stats().expanded - before;
        if found != Found::Cut {
            self.known = Some(problem.stamp());
        }
        found
    }

    fn forget_changes(&mut self) {
        self.last = None;
        let is_known = self.behind == Some(self.pending.len());
        self.behind = is_known.then_some(0);
        self.pending.clear();
        self.told = 0;
        self.debt = 0;
        self.given_up = 0;
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

    /// Repairs the distances, if that is possible and worth it.
    fn repair(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Option<Found> {
        let most = self.patience();
        // Looking at a changed cell's surroundings costs no less than an expansion.
        let serves = guided!(&self.width, guided => guided.distances.serve(problem));
        if !serves || self.pending.len() as u64 > most {
            return None;
        }
        let pending = &self.pending;
        let found = guided!(
            &mut self.width,
            guided => guided.repair(problem, pending, most, cx)
        );
        self.forget_changes();
        found.filter(|&found| found != Found::TooFar)
    }

    /// Answers from what is known of the distances, and says how.
    fn answer(&mut self, problem: &GridProblem, cx: &mut Context<'_, GridProblem>) -> Found {
        let before = cx.stats().expanded;
        let changed = &self.pending[self.told..];
        let most = self.forbearance(problem);
        let (found, way) = loop {
            let answer =
                guided!(&mut self.width, guided => guided.answer(problem, changed, most, cx));
            if answer.0 != Found::TooFar {
                break answer;
            }
            self.width.widen();
        };
        let expanded = cx.stats().expanded - before;
        if way == Way::Afresh {
            self.forget_changes();
            (self.effort, self.jump_effort) = (expanded, 0);
        } else {
            self.given_up = match found {
                Found::GaveUp => self.given_up + 1,
                _ => self.given_up.saturating_sub(1),
            };
            self.told = self.pending.len();
            self.debt += expanded;
        }
        if found != Found::GaveUp {
            cx.note(
                "replanned",
                match way {
                    Way::Kept => "kept",
                    Way::Searched => "searched",
                    Way::Afresh => "afresh",
                },
            );
        }
        found
    }

    /// Whether distances to the goal are known, of this problem or of one that it came from.
    fn knows(&self, problem: &GridProblem) -> bool {
        guided!(&self.width, guided => {
            guided.knows(problem) && guided.distances.settled().is_some()
        })
    }

    /// Whether no distances are known nor anything else, as the last plan took none.
    fn is_idle(&self) -> bool {
        guided!(&self.width, guided => guided.is_idle())
    }

    /// Gives the distances up, and makes none.
    fn give_up(&mut self, problem: &GridProblem) {
        guided!(&mut self.width, guided => guided.give_up(problem));
    }

    /// Whether no way over what the answers do not know of is shorter than what is left of the last path.
    fn leave_none_shorter(&mut self, problem: &GridProblem) -> bool {
        let (changed, cost) = (&self.pending[self.told..], self.last_path.cost());
        guided!(&mut self.width, guided => guided.leave_none_shorter(problem, changed, cost))
    }

    /// A search that gave up learns what it was to find.
    fn be_told(&mut self, problem: &GridProblem, outcome: &Outcome<GridProblem>) {
        guided!(&mut self.width, guided => guided.be_told(problem, outcome));
    }

    fn report(
        &mut self,
        problem: &GridProblem,
        found: Found,
        cx: &mut Context<'_, GridProblem>,
    ) -> Report<GridProblem> {
        let report = match found {
            Found::Path => {
                let path = guided!(&self.width, guided => guided.path());
                cx.answer(problem, path, Proof::Optimal)
            }
            Found::Nothing => cx.report(Outcome::Infeasible),
            Found::Cut | Found::TooFar | Found::GaveUp => {
                cx.report(Outcome::Unknown { attempt: None })
            }
        };
        if !self.params.eager {
            self.last_path.remember(problem, &report);
        }
        report
    }
}

impl Width {
    fn widen(&mut self) {
        let narrow = matches!(self, Self::Narrow(_));
        // The old memory goes before the new comes.
        *self = Self::default();
        *self = if narrow {
            Self::Wide(Guided::default())
        } else {
            Self::Huge(Guided::default())
        };
    }
}

/// Whether no search is needed to see that there is no path.
fn is_hopeless(problem: &GridProblem) -> bool {
    let grid = problem.grid();
    !grid.is_free(problem.start()) || !grid.is_free(problem.goal())
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
        if !guided!(&self.width, guided => guided.distances.cover(problem)) {
            self.width = Width::default();
            self.auto = Auto::default();
        }
        self.behind = None;
        if is_hopeless(problem) {
            self.known = None;
            return Ok(cx.report(Outcome::Infeasible));
        }
        self.jump_effort = 0;
        if let Some(report) = self.go_without_distances(problem, cx)? {
            return Ok(report);
        }
        let found = self.refresh(problem, self.params.eager, cx);
        Ok(self.report(problem, found, cx))
    }
}

impl Replanner<GridProblem> for DStarLite {
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
        let layout = problem.grid().layout();
        let before = self.pending.len();
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
        let news = self.pending.len() - before;
        self.known = Some(problem.stamp());
        self.opened |= flipped(changes).1;
        if self.pending.len() > layout.len() {
            // More than there is to repair: only a new plan makes the distances right.
            self.pending.clear();
            self.told = 0;
            self.known = None;
            cx.note("replanned", "afresh");
            return self.plan(problem, cx);
        }
        if !self.params.eager
            && self.still_best(revision)
            && cx.proceed()
            && let Some(report) = self.last_path.keep(problem, cx)
        {
            return Ok(report);
        }
        if is_hopeless(problem) {
            return Ok(cx.report(Outcome::Infeasible));
        }
        if self.params.eager {
            let found = if let Some(found) = self.repair(problem, cx) {
                cx.note("replanned", "repaired");
                found
            } else {
                cx.note("replanned", "afresh");
                self.refresh(problem, true, cx)
            };
            return Ok(self.report(problem, found, cx));
        }
        let known = self.last.filter(|&(stamp, _)| stamp == problem.stamp());
        let found = if let Some((_, found)) = known {
            cx.note("replanned", "kept");
            found
        } else if self.is_shut_in(problem, news, cx) {
            cx.note("replanned", "shut in");
            Found::Nothing
        } else if self.jumps_at_once(problem) {
            return self.jump(problem, false, cx);
        } else {
            self.answer(problem, cx)
        };
        if found == Found::GaveUp {
            return self.jump(problem, true, cx);
        }
        self.last = (found != Found::Cut).then_some((problem.stamp(), found));
        Ok(self.report(problem, found, cx))
    }

    /// Lets a plan go on to what lies near the start, makes the bits of jump points or follows what has changed with
    /// them, if there is reason to, makes the distances after an answer of which nothing was known, unless jumps do
    /// without, and repairs them, or makes them anew, if answers have cost more than that since they were last right: in
    /// iterations, an expansion each.
    fn settle(&mut self, problem: &GridProblem, cx: &mut Context<'_, GridProblem>) {
        if self.known != Some(problem.stamp()) || !cx.proceed() {
            return;
        }
        if !self.params.eager {
            self.prepare_jumps(problem);
        }
        if self.rests_on_jumps() {
            return;
        }
        guided!(&mut self.width, guided => guided.prepare(problem, cx));
        if !cx.proceed() {
            return;
        }
        if is_hopeless(problem) {
            return;
        }
        if guided!(&self.width, guided => guided.are_due()) {
            if self.refresh(problem, false, cx) == Found::Cut {
                // Answers to come do without.
                self.known = Some(problem.stamp());
            } else {
                guided!(&mut self.width, guided => guided.prepare(problem, cx));
            }
        } else if self.debt > DEBT * self.effort.max(1000) && self.repair(problem, cx).is_none() {
            self.refresh(problem, true, cx);
        }
    }
}
