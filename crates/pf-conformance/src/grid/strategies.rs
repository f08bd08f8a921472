//! Strategies for [`proptest`], which shrinks what breaks.

use pf_grid::{Cell, Grid, GridChange, GridProblem, Moves};
use proptest::{
    bool::weighted,
    collection::{SizeRange, vec},
    prelude::*,
    sample::{Index, select},
};
use std::ops::RangeInclusive;

/// Grids with a number of columns and of rows from `sizes`, with a share of blocked cells from
/// `densities` (0 to 1), and with terrain or without. They shrink towards small and open ones.
///
/// # Panics
/// If there are no such grids.
pub fn grids(
    sizes: RangeInclusive<u32>,
    densities: RangeInclusive<f64>,
    terrain: bool,
) -> impl Strategy<Value = Grid> {
    let dearest = if terrain { 254u8 } else { 1 };
    let dimensions = (sizes.clone(), sizes, densities);
    dimensions.prop_flat_map(move |(width, height, density)| {
        let cells = vec((weighted(density), 1..=dearest), (width * height) as usize);
        cells.prop_map(move |cells| {
            Grid::new(width, height, |at| {
                match cells[(at.y * width + at.x) as usize] {
                    (true, _) => 0,
                    (false, cost) => cost,
                }
            })
            .expect("a size and costs that grids may have")
        })
    })
}

/// Problems on [`grids`] of these sizes, with few obstacles or many, with terrain or without, under
/// any moves. Start and goal may be blocked, or one.
///
/// # Panics
/// If there are no such grids.
pub fn problems(sizes: RangeInclusive<u32>) -> impl Strategy<Value = GridProblem> {
    let grids = prop_oneof![
        grids(sizes.clone(), 0.0..=0.5, false),
        grids(sizes, 0.0..=0.5, true),
    ];
    let ends = any::<[Index; 2]>();
    (grids, ends, select(&Moves::ALL[..])).prop_map(|(grid, ends, moves)| {
        let [start, goal] = ends.map(|end| cell(end, grid.width(), grid.height()));
        let problem = GridProblem::new(grid, start, goal).expect("two cells of the grid");
        problem.with_moves(moves)
    })
}

/// One batch of changes that make sense for `problem` and for whatever it becomes by such changes:
/// cells blocked, freed, dearer or cheaper, up to 200 at a time, start and goal included; start
/// and goal moved; all of these mixed; or nothing at all.
pub fn changes_for(problem: &GridProblem) -> impl Strategy<Value = Vec<GridChange>> + use<> {
    batches_on(problem.grid().width(), problem.grid().height())
}

/// A problem as from [`problems`], and batches as from [`changes_for`] that happen to it one after
/// the other.
///
/// ```
/// use pf_conformance::grid::{oracle, stories};
/// use pf_core::Problem;
/// use proptest::prelude::*;
///
/// proptest!(|((mut problem, batches) in stories(1..=12, 0..6))| {
///     for batch in &batches {
///         let revision = problem.revise(batch).unwrap();
///         // … a replanner's answer to `revision`, beside the truth:
///         let _ = oracle(revision.problem());
///     }
/// });
/// ```
pub fn stories(
    sizes: RangeInclusive<u32>,
    batches: impl Into<SizeRange>,
) -> impl Strategy<Value = (GridProblem, Vec<Vec<GridChange>>)> {
    let batches = batches.into();
    problems(sizes).prop_flat_map(move |problem| {
        let story = vec(changes_for(&problem), batches.clone());
        (Just(problem), story)
    })
}

fn batches_on(width: u32, height: u32) -> impl Strategy<Value = Vec<GridChange>> {
    let one = move || any::<Index>().prop_map(move |index| cell(index, width, height));
    let some = move || {
        prop_oneof![
            3 => vec(one(), 1..10),
            1 => vec(one(), 1..=200),
        ]
    };
    let change = prop_oneof![
        3 => some().prop_map(GridChange::Blocked),
        3 => some().prop_map(GridChange::Freed),
        1 => one().prop_map(GridChange::StartMoved),
        1 => one().prop_map(GridChange::GoalMoved),
        1 => (some(), 1..=254u8).prop_map(|(cells, cost)| GridChange::CostChanged(cells, cost)),
    ];
    vec(change, 0..4)
}

fn cell(index: Index, width: u32, height: u32) -> Cell {
    let index = u32::try_from(index.index((width * height) as usize)).unwrap_or(0);
    Cell::new(index % width, index / width)
}
