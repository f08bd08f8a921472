use crate::{Cell, DIRECTIONS, Grid, GridCost, Moves};
use pf_core::{InvalidProblem, Problem, Stamp, Violation};
use std::sync::Arc;

/// From one cell to another.
///
/// The map is shared between clones until one of them changes it, so a clone is cheap.
#[derive(Clone, Debug)]
pub struct GridProblem {
    grid: Arc<Grid>,
    moves: Moves,
    start: Cell,
    goal: Cell,
    stamp: Stamp,
}

/// What may happen on a grid.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum GridChange {
    /// The robot is elsewhere.
    StartMoved(Cell),
    /// The target is elsewhere.
    GoalMoved(Cell),
    /// These cells became obstacles; those that are stay so.
    Blocked(Vec<Cell>),
    /// These cells became free; those that are stay so. Each costs what it cost before.
    Freed(Vec<Cell>),
    /// These cells cost something else now: 1 to 254.
    CostChanged(Vec<Cell>, u8),
}

impl GridProblem {
    /// A problem on `grid` under the default [`Moves`]. A blocked start or goal is a fair question
    /// with a sad answer.
    ///
    /// # Errors
    /// [`InvalidProblem::OutOfBounds`] if either cell lies outside the grid.
    pub fn new(
        grid: impl Into<Arc<Grid>>,
        start: Cell,
        goal: Cell,
    ) -> Result<Self, InvalidProblem> {
        let problem = Self {
            grid: grid.into(),
            moves: Moves::default(),
            start,
            goal,
            stamp: Stamp::fresh(),
        };
        problem.grid.check_cell("start", start)?;
        problem.grid.check_cell("goal", goal)?;
        Ok(problem)
    }

    /// The same under other moves.
    #[must_use]
    pub fn with_moves(mut self, moves: Moves) -> Self {
        self.moves = moves;
        self.stamp = Stamp::fresh();
        self
    }

    /// The map.
    #[must_use]
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The map, to share with another problem.
    #[must_use]
    pub fn shared_grid(&self) -> Arc<Grid> {
        Arc::clone(&self.grid)
    }

    /// Which steps are allowed.
    #[must_use]
    pub fn moves(&self) -> Moves {
        self.moves
    }

    /// Where from.
    #[must_use]
    pub fn start(&self) -> Cell {
        self.start
    }

    /// Where to.
    #[must_use]
    pub fn goal(&self) -> Cell {
        self.goal
    }
}

impl Problem for GridProblem {
    type State = Cell;
    /// Every cell of the path, start and goal included.
    type Solution = Vec<Cell>;
    type Cost = GridCost;
    type Change = GridChange;

    fn judge(&self, path: &Vec<Cell>) -> Result<GridCost, Violation> {
        let (Some(&first), Some(&last)) = (path.first(), path.last()) else {
            return Err(Violation::Empty);
        };
        if first != self.start || !self.grid.is_free(first) {
            return Err(Violation::WrongStart);
        }
        if last != self.goal {
            return Err(Violation::WrongGoal);
        }
        let (layout, uniform) = (self.grid.layout(), self.grid.is_uniform());
        let (mut straight, mut diagonal) = (0, 0);
        let mut id = layout.id(first);
        for (at, pair) in path.windows(2).enumerate() {
            let (from, to) = (pair[0], pair[1]);
            let k = direction(from, to);
            let legal = self.moves.legal(self.grid.around_id(id));
            // The border is never free, so no legal step leaves the grid.
            if u32::from(legal) >> k & 1 == 0 {
                return Err(if self.grid.is_free(to) {
                    Violation::IllegalMove { at }
                } else {
                    Violation::Collision { at }
                });
            }
            let next = layout.id(to);
            let cost = if uniform {
                2
            } else {
                u64::from(self.grid.cost_id(id)) + u64::from(self.grid.cost_id(next))
            };
            if k < 4 {
                straight += cost;
            } else {
                diagonal += cost;
            }
            id = next;
        }
        let cost = GridCost { straight, diagonal };
        Ok(cost)
    }

    fn apply(&mut self, changes: &[GridChange]) -> Result<(), InvalidProblem> {
        use GridChange::{Blocked, CostChanged, Freed, GoalMoved, StartMoved};
        for change in changes {
            self.grid.check_change(change)?;
        }
        let mut anything = false;
        for change in changes {
            match change {
                StartMoved(cell) => {
                    anything |= *cell != self.start;
                    self.start = *cell;
                }
                GoalMoved(cell) => {
                    anything |= *cell != self.goal;
                    self.goal = *cell;
                }
                Blocked(cells) | Freed(cells) => {
                    let free = matches!(change, Freed(_));
                    let grid = Arc::make_mut(&mut self.grid);
                    for &cell in cells {
                        anything |= grid.set_free(cell, free);
                    }
                }
                CostChanged(cells, cost) => {
                    let grid = Arc::make_mut(&mut self.grid);
                    for &cell in cells {
                        anything |= grid.set_cost(cell, *cost);
                    }
                }
            }
        }
        if anything {
            self.stamp = Stamp::fresh();
        }
        Ok(())
    }

    fn stamp(&self) -> Stamp {
        self.stamp
    }
}

/// In which of the [`DIRECTIONS`] the step goes; 8 if it is no step to a neighbour.
#[inline]
fn direction(from: Cell, to: Cell) -> u32 {
    const STEPS: [u32; 9] = {
        let mut steps = [8; 9];
        let mut k = 0;
        while k < 8 {
            let (dx, dy) = DIRECTIONS[k as usize];
            #[expect(clippy::cast_sign_loss, reason = "0 to 8")]
            let place = (3 * (dy + 1) + dx + 1) as usize;
            steps[place] = k;
            k += 1;
        }
        steps
    };
    let dx = to.x.wrapping_sub(from.x).wrapping_add(1);
    let dy = to.y.wrapping_sub(from.y).wrapping_add(1);
    if dx > 2 || dy > 2 {
        return 8;
    }
    STEPS[(3 * dy + dx) as usize]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn problem(drawing: &str, moves: Moves) -> GridProblem {
        let grid = Grid::parse(drawing).unwrap();
        let goal = Cell::new(grid.width() - 1, grid.height() - 1);
        GridProblem::new(grid, Cell::new(0, 0), goal)
            .unwrap()
            .with_moves(moves)
    }

    fn path(cells: &[(u32, u32)]) -> Vec<Cell> {
        cells.iter().map(|&(x, y)| Cell { x, y }).collect()
    }

    #[test]
    fn the_judge_knows_every_rule() {
        let across = path(&[(0, 0), (1, 1)]);
        let marks = |drawing| Moves::ALL.map(|m| problem(drawing, m).judge(&across).is_ok());
        assert_eq!(marks(".. .."), [false, true, true, true]);
        assert_eq!(marks(".# .."), [false, true, true, false]);
        assert_eq!(marks(".# #."), [false, true, false, false]);
        assert_eq!(marks(".. .#"), [false, false, false, false]);
    }

    #[test]
    fn the_judge_names_what_is_wrong() {
        let p = problem("... .#. ...", Moves::default());
        let judge = |cells| p.judge(&path(cells)).unwrap_err();
        assert_eq!(judge(&[]), Violation::Empty);
        assert_eq!(judge(&[(0, 1), (2, 2)]), Violation::WrongStart);
        assert_eq!(judge(&[(0, 0), (0, 1)]), Violation::WrongGoal);
        assert_eq!(
            judge(&[(0, 0), (1, 1), (2, 2)]),
            Violation::Collision { at: 0 }
        );
        assert_eq!(
            judge(&[(0, 0), (0, 1), (2, 2)]),
            Violation::IllegalMove { at: 1 }
        );
        assert_eq!(
            judge(&[(0, 0), (u32::MAX, 0), (2, 2)]),
            Violation::Collision { at: 0 }
        );
    }

    #[test]
    fn changes_happen_all_or_not_at_all() {
        let mut p = problem("... ...", Moves::default());
        let (before, stamp) = (p.clone(), p.stamp());
        let inside = GridChange::Blocked(path(&[(1, 0)]));
        for nonsense in [
            GridChange::Freed(path(&[(3, 0)])),
            GridChange::GoalMoved(Cell::new(0, 2)),
            GridChange::CostChanged(path(&[(0, 0)]), 0),
            GridChange::CostChanged(path(&[(0, 0)]), 255),
        ] {
            assert!(p.apply(&[inside.clone(), nonsense]).is_err());
            assert_eq!((p.grid(), p.stamp()), (before.grid(), stamp));
        }
        p.apply(&[inside]).unwrap();
        assert!(!p.grid().is_free(Cell::new(1, 0)) && before.grid().is_free(Cell::new(1, 0)));
        assert_ne!(p.stamp(), stamp);
    }

    #[test]
    fn nothing_to_do_keeps_the_stamp() {
        let mut p = problem("... ...", Moves::default());
        let stamp = p.stamp();
        p.apply(&[
            GridChange::Freed(path(&[(1, 0)])),
            GridChange::StartMoved(Cell::new(0, 0)),
        ])
        .unwrap();
        assert_eq!(p.stamp(), stamp);
    }
}
