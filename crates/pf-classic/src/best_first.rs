//! Dijkstra (1959) and A* (Hart, Nilsson, Raphael 1968): one search, with and without a heuristic.

use pf_core::{
    Claims, Context, InvalidParams, Outcome, Planner, Proof, Report, Unsupported, params,
};
use pf_grid::{ExactSearch, Found, GridProblem};

/// What a search can be asked besides a path.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SearchParams {
    /// Where there is no path, say which reachable cell is nearest the goal: the report's note
    /// `nearest` is then that cell, `x,y`. It is nearest in a straight line; ties go to the
    /// upper, then the left one.
    pub nearest: bool,
}

params!(SearchParams {
    nearest: bool = "where there is no path, name the reachable cell nearest the goal",
});

macro_rules! best_first {
    ($(#[$doc:meta])* $planner:ident, $params:ident, $name:literal, $guided:literal) => {
        $(#[$doc])*
        #[derive(Clone, Debug, Default)]
        pub struct $planner {
            params: SearchParams,
            search: ExactSearch,
        }

        #[doc = concat!("What ", $name, " can be asked.")]
        pub type $params = SearchParams;

        impl $planner {
            /// A planner that does what `params` say.
            ///
            /// # Errors
            /// None today.
            pub fn new(params: SearchParams) -> Result<Self, InvalidParams> {
                Ok(Self {
                    params,
                    search: ExactSearch::default(),
                })
            }

            /// Bytes of memory kept between calls.
            #[must_use]
            pub fn bytes(&self) -> usize {
                self.search.bytes()
            }
        }

        impl Planner<GridProblem> for $planner {
            fn name(&self) -> &'static str {
                $name
            }

            fn claims(&self) -> Claims {
                Claims::NONE.complete().optimal().deterministic()
            }

            fn plan(
                &mut self,
                problem: &GridProblem,
                cx: &mut Context<'_, GridProblem>,
            ) -> Result<Report<GridProblem>, Unsupported> {
                let hopeless = !problem.grid().is_free(problem.goal()) && !self.params.nearest;
                let found = if hopeless {
                    Found::Nothing
                } else {
                    self.search.find(problem, $guided, cx)
                };
                Ok(match found {
                    Found::Path(path) => cx.answer(problem, path, Proof::Optimal),
                    Found::Cut => cx.report(Outcome::Unknown { attempt: None }),
                    Found::Nothing => {
                        if self.params.nearest
                            && let Some(cell) = self.search.nearest(problem.goal())
                        {
                            cx.note("nearest", cell.to_string());
                        }
                        cx.report(Outcome::Infeasible)
                    }
                })
            }
        }
    };
}

best_first! {
    /// Expands cells in the order of their distance from the start.
    ///
    /// One iteration is one expansion. Memory is kept from call to call: after the first call on
    /// a grid the next allocates only the path it returns.
    ///
    /// Source: Dijkstra, *A note on two problems in connexion with graphs*, 1959; with Dial's
    /// buckets and canonical successors, see [`pf_grid::Search`].
    Dijkstra, DijkstraParams, "Dijkstra", false
}

best_first! {
    /// Expands cells in the order of the shortest way through them that is still possible.
    ///
    /// The heuristic is the octile distance (Manhattan without diagonals) times the least cost
    /// of a free cell: consistent for every move rule. One iteration is one expansion. Memory is
    /// kept from call to call: after the first call on a grid the next allocates only the path it
    /// returns.
    ///
    /// Source: Hart, Nilsson, Raphael, *A Formal Basis for the Heuristic Determination of Minimum
    /// Cost Paths*, 1968; with Dial's buckets and canonical successors, see [`pf_grid::Search`].
    ///
    /// ```
    /// use pf_core::{Context, Outcome, Planner};
    /// use pf_classic::AStar;
    /// use pf_grid::{Cell, Grid, GridCost, GridProblem};
    ///
    /// let grid = Grid::parse("
    ///     .....
    ///     .###.
    ///     .....
    /// ").unwrap();
    /// let problem = GridProblem::new(grid, Cell::new(0, 0), Cell::new(4, 2)).unwrap();
    /// let report = AStar::default().plan(&problem, &mut Context::seeded(0)).unwrap();
    /// let Outcome::Optimal(best) = report.outcome else { panic!() };
    /// assert_eq!(best.cost, GridCost::of_steps(6, 0));
    /// ```
    AStar, AStarParams, "A*", true
}
