//! Greedy best-first search: always on from the reached cell that looks nearest to the goal. Fast,
//! and content with any path.
//!
//! J. E. Doran, D. Michie: Experiments with the Graph Traverser program. Proceedings of the Royal
//! Society A 294, 1966.

use pf_core::{Claims, Context, Outcome, Planner, Proof, Report, Unsupported};
use pf_grid::{Cell, GridProblem};
use std::{cmp::Reverse, collections::BinaryHeap, iter};

/// Greedy best-first search on a grid. One iteration expands one cell.
#[derive(Clone, Debug, Default)]
pub struct Greedy {
    /// By id: the cell each cell was reached from. Kept from call to call for its memory alone.
    parents: Vec<Option<Cell>>,
}

impl Planner<GridProblem> for Greedy {
    fn name(&self) -> &str {
        "greedy"
    }

    /// It tries every cell it can reach before it gives up, and never rolls dice.
    fn claims(&self) -> Claims {
        Claims::NONE.complete().deterministic()
    }

    fn plan(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Result<Report<GridProblem>, Unsupported> {
        let (grid, start, goal) = (problem.grid(), problem.start(), problem.goal());
        let layout = grid.layout();
        let distance = |cell: Cell| {
            let (dx, dy) = (cell.x.abs_diff(goal.x), cell.y.abs_diff(goal.y));
            u64::from(dx).pow(2) + u64::from(dy).pow(2)
        };
        self.parents.clear();
        self.parents.resize(layout.len(), None);
        let mut open = BinaryHeap::new();
        if grid.is_free(start) {
            self.parents[layout.id(start) as usize] = Some(start);
            open.push(Reverse((distance(start), start)));
        }
        while let Some(Reverse((_, cell))) = open.pop() {
            if !cx.proceed() {
                return Ok(cx.report(Outcome::Unknown { attempt: None }));
            }
            cx.expanded(|| cell);
            if cell == goal {
                let parent = |cell: &Cell| self.parents[layout.id(*cell) as usize];
                let back = |cell: &Cell| parent(cell).filter(|parent| parent != cell);
                let mut path: Vec<Cell> = iter::successors(Some(goal), back).collect();
                path.reverse();
                return Ok(cx.answer(problem, path, Proof::None));
            }
            for (next, _) in grid.neighbours(cell, problem.moves()) {
                let parent = &mut self.parents[layout.id(next) as usize];
                if parent.is_none() {
                    *parent = Some(cell);
                    open.push(Reverse((distance(next), next)));
                }
            }
        }
        Ok(cx.report(Outcome::Infeasible))
    }
}
