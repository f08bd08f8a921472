//! Jump point search (Harabor and Grastien 2011, 2014) by scans of whole words.

mod map;
mod search;

use map::JumpMap;
use pf_core::{
    Claims, Context, InvalidParams, Outcome, Planner, Problem, Proof, Replanner, Report, Revision,
    Stamp, Unsupported, params,
};
use pf_grid::{End, Found, GridChange, GridProblem, Layout, Word};
use search::JumpSearch;

/// Jump point search has no parameters.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct JpsParams {}

params!(JpsParams {});

/// A* that goes from one jump point to the next: cells where a shortest path may have to turn.
///
/// What lies between is scanned 64 cells at a time, in bits that say where a scan in a straight
/// direction stops. They are made at the first query on a grid, in a nanosecond or two a cell, and
/// follow its changes. One iteration is one jump point expanded. After the first call on a grid the
/// next allocates only the path it returns.
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
    width: Width,
    layout: Option<Layout>,
    /// The problem whose grid the map is known to be that of.
    known: Option<Stamp>,
}

#[derive(Clone, Debug)]
enum Width {
    Narrow(JumpSearch<u32>),
    Wide(JumpSearch<u64>),
    Huge(JumpSearch<u128>),
}

impl Default for Width {
    fn default() -> Self {
        Self::Narrow(JumpSearch::default())
    }
}

impl Jps {
    /// A planner.
    ///
    /// # Errors
    /// None today.
    pub fn new(_: JpsParams) -> Result<Self, InvalidParams> {
        Ok(Self::default())
    }

    /// Bytes of memory kept between calls.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.map.bytes()
            + match &self.width {
                Width::Narrow(search) => search.bytes(),
                Width::Wide(search) => search.bytes(),
                Width::Huge(search) => search.bytes(),
            }
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
        let grid = problem.grid();
        if !grid.is_uniform() {
            return Err(Unsupported::new(
                self.name(),
                "it needs cells that all cost the same",
            ));
        }
        if !grid.is_free(problem.start()) || !grid.is_free(problem.goal()) {
            return Ok(cx.report(Outcome::Infeasible));
        }
        if !self.map.is_of(grid, problem.moves()) {
            self.map.make(grid, problem.moves());
        }
        self.known = Some(problem.stamp());
        if self.layout != Some(*grid.layout()) {
            self.layout = Some(*grid.layout());
            self.width = Width::default();
        }
        let goal = self.map.mark(problem.goal());
        let found = loop {
            let found = match &mut self.width {
                Width::Narrow(search) => find(search, problem, &self.map, cx),
                Width::Wide(search) => find(search, problem, &self.map, cx),
                Width::Huge(search) => find(search, problem, &self.map, cx),
            };
            match found {
                Some(found) => break found,
                None => self.width.widen(),
            }
        };
        self.map.restore(goal);
        Ok(match found {
            Found::Path(path) => cx.answer(problem, path, Proof::Optimal),
            Found::Nothing => cx.report(Outcome::Infeasible),
            Found::Cut => cx.report(Outcome::Unknown { attempt: None }),
        })
    }
}

/// `None` if the word is too narrow.
fn find<W: Word>(
    search: &mut JumpSearch<W>,
    problem: &GridProblem,
    map: &JumpMap,
    cx: &mut Context<'_, GridProblem>,
) -> Option<Found> {
    match search.run(problem, map, cx) {
        End::Goal(_) => Some(Found::Path(search.path(problem))),
        End::Exhausted => Some(Found::Nothing),
        End::Cut => Some(Found::Cut),
        End::TooFar => None,
    }
}

impl Width {
    fn widen(&mut self) {
        let narrow = matches!(self, Self::Narrow(_));
        // The old memory goes before the new comes.
        *self = Self::default();
        *self = if narrow {
            Self::Wide(JumpSearch::default())
        } else {
            Self::Huge(JumpSearch::default())
        };
    }
}

impl Replanner<GridProblem> for Jps {
    /// Follows the changes with its bits, and searches again.
    fn replan(
        &mut self,
        revision: &Revision<'_, GridProblem>,
        cx: &mut Context<'_, GridProblem>,
    ) -> Result<Report<GridProblem>, Unsupported> {
        let problem = revision.problem();
        if let Some(changes) = revision.since(self.known) {
            let cells = changes.iter().flat_map(|change| match change {
                GridChange::Blocked(cells) | GridChange::Freed(cells) => &cells[..],
                _ => &[],
            });
            self.map.follow(problem.grid(), cells.copied());
            self.known = Some(problem.stamp());
        }
        self.plan(problem, cx)
    }
}
