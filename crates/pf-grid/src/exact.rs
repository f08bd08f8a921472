use crate::{Cell, End, GridProblem, Layout, Search, U48, Weights, Word};
use pf_core::Context;

/// A [`Search`] from start to goal in the narrowest word that orders its paths exactly.
///
/// It begins in 32 bits; where a path turns out to be longer than they can order (some 47,000
/// cells, less with terrain), the query is searched again in 48, in 64, then in 128, and later
/// queries on a grid of that shape begin there. Only one width is kept in memory.
#[derive(Clone, Debug)]
pub struct ExactSearch {
    width: Width,
    layout: Option<Layout>,
}

#[derive(Clone, Debug)]
enum Width {
    Narrow(Search<u32>),
    Wide(Search<U48>),
    Wider(Search<u64>),
    Huge(Search<u128>),
}

/// What an [`ExactSearch`] found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Found {
    /// A shortest path, the start first.
    Path(Vec<Cell>),
    /// Proof that there is none.
    Nothing,
    /// The budget ran out.
    Cut,
}

impl Default for ExactSearch {
    fn default() -> Self {
        Self {
            width: Width::Narrow(Search::default()),
            layout: None,
        }
    }
}

impl ExactSearch {
    /// Finds a shortest path, with the octile heuristic if `guided`, else in the order of distance
    /// from the start.
    pub fn find(
        &mut self,
        problem: &GridProblem,
        guided: bool,
        cx: &mut Context<'_, GridProblem>,
    ) -> Found {
        let grid = problem.grid();
        if self.layout != Some(*grid.layout()) {
            self.width = Width::Narrow(Search::default());
            self.layout = Some(*grid.layout());
        }
        loop {
            let found = match &mut self.width {
                Width::Narrow(search) => find(search, problem, guided, cx),
                Width::Wide(search) => find(search, problem, guided, cx),
                Width::Wider(search) => find(search, problem, guided, cx),
                Width::Huge(search) => find(search, problem, guided, cx),
            };
            match found {
                Some(found) => return found,
                None => self.widen(),
            }
        }
    }

    /// Of the cells reachable from the start of the last problem, for which nothing was found, the
    /// one nearest `to` in a straight line; ties go to the upper, then the left one.
    #[must_use]
    pub fn nearest(&self, to: Cell) -> Option<Cell> {
        match &self.width {
            Width::Narrow(search) => search.nearest(to),
            Width::Wide(search) => search.nearest(to),
            Width::Wider(search) => search.nearest(to),
            Width::Huge(search) => search.nearest(to),
        }
    }

    /// Bytes held.
    #[must_use]
    pub fn bytes(&self) -> usize {
        match &self.width {
            Width::Narrow(search) => search.bytes(),
            Width::Wide(search) => search.bytes(),
            Width::Wider(search) => search.bytes(),
            Width::Huge(search) => search.bytes(),
        }
    }

    fn widen(&mut self) {
        // The old memory goes before the new comes, as that comes with use.
        self.width = match self.width {
            Width::Narrow(_) => Width::Wide(Search::default()),
            Width::Wide(_) => Width::Wider(Search::default()),
            Width::Wider(_) | Width::Huge(_) => Width::Huge(Search::default()),
        };
    }
}

/// `None` if the word is too narrow.
fn find<W: Word>(
    search: &mut Search<W>,
    problem: &GridProblem,
    guided: bool,
    cx: &mut Context<'_, GridProblem>,
) -> Option<Found> {
    let grid = problem.grid();
    let (start, goal) = (problem.start(), problem.goal());
    let weights = Weights::of(grid);
    if !weights.fit::<W>(grid, 1) {
        return None;
    }
    let end = if guided {
        search.find(problem, cx)
    } else {
        search.run(problem, start, Some(goal), |_| W::default(), cx)
    };
    match end {
        End::Goal(_) => Some(Found::Path(search.path(goal))),
        End::Exhausted => Some(Found::Nothing),
        End::Cut => Some(Found::Cut),
        End::TooFar => None,
    }
}
