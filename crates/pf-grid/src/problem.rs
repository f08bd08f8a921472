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
        let steps = Steps::of(self);
        let (cost, all_legal) = if self.grid.is_uniform() {
            steps.cost(path, |_, _| 2)
        } else {
            steps.cost(path, |from, to| self.grid.sum_of_costs(from, to))
        };
        if all_legal {
            return Ok(cost);
        }
        let is_illegal = |pair: &[Cell]| !steps.are_legal(pair);
        let at = path.windows(2).position(is_illegal).unwrap_or_default();
        Err(if self.grid.is_free(path[at + 1]) {
            Violation::IllegalMove { at }
        } else {
            Violation::Collision { at }
        })
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
                    anything |= grid.set_free(cells, free);
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

/// The judge's view of a map. It looks at a step without a branch, and at a path to its end whatever it
/// finds, as nearly all paths are good.
#[derive(Debug)]
pub(crate) struct Steps<'g> {
    around: &'g [u8],
    pitch: u32,
    /// By the free neighbours of a cell: a bit for the place of each legal one.
    legal: &'static [u16; 256],
}

impl<'g> Steps<'g> {
    pub(crate) fn of(problem: &'g GridProblem) -> Self {
        Self {
            around: problem.grid.around(),
            pitch: problem.grid.layout().pitch(),
            legal: &LEGAL[problem.moves as usize],
        }
    }

    /// The id of a cell; of what is no cell that of another, or none.
    #[inline]
    fn id(&self, cell: Cell) -> u32 {
        let row = cell.y.wrapping_add(1).wrapping_mul(self.pitch);
        row.wrapping_add(cell.x).wrapping_add(1)
    }

    /// The legal steps from a free cell, by its id.
    #[inline]
    fn legal_at(&self, id: u32) -> u16 {
        // The border is never free, so no legal step leaves the grid.
        let around = self.around.get(id as usize).copied().unwrap_or(0);
        self.legal[usize::from(around)]
    }

    /// The legal steps from a free cell, a bit for the [`place`](Self::place) of each.
    #[inline]
    pub(crate) fn from(&self, cell: Cell) -> u16 {
        self.legal_at(self.id(cell))
    }

    /// The place of a step by so many columns and rows.
    pub(crate) fn place((dx, dy): (u32, u32)) -> u32 {
        4 * dy.wrapping_add(1) + dx.wrapping_add(1)
    }

    /// Whether a step from a free cell to one beside it is legal.
    #[inline]
    pub(crate) fn is_legal(&self, from: Cell, to: Cell) -> bool {
        let step = (to.x.wrapping_sub(from.x), to.y.wrapping_sub(from.y));
        self.from(from) >> Self::place(step) & 1 == 1
    }

    /// How many of so many steps in a direction are legal from a free cell on, and where they lead.
    #[inline]
    pub(crate) fn run(&self, from: Cell, (dx, dy): (i32, i32), count: u32) -> (u32, Cell) {
        let place = Self::place((dx.cast_unsigned(), dy.cast_unsigned()));
        let on = dx + dy * self.pitch.cast_signed();
        let (mut id, mut taken) = (self.id(from), 0);
        while taken < count && self.legal_at(id) >> place & 1 == 1 {
            (id, taken) = (id.wrapping_add_signed(on), taken + 1);
        }
        let along = |at: u32, d: i32| at.wrapping_add_signed(d.wrapping_mul(taken.cast_signed()));
        (taken, Cell::new(along(from.x, dx), along(from.y, dy)))
    }

    /// Whether all steps of a path are legal whose first cell is free.
    #[inline]
    pub(crate) fn are_legal(&self, path: &[Cell]) -> bool {
        self.cost(path, |_, _| 0).1
    }

    /// What a path costs whose first cell is free, and whether all its steps are legal.
    #[inline]
    pub(crate) fn cost(&self, path: &[Cell], cost: impl Fn(u32, u32) -> u64) -> (GridCost, bool) {
        const ONES: u64 = 1 << 32 | 1;
        // Rows in the upper half, columns in the lower one. What the lower half borrows when it falls
        // below nothing leaves it far too large.
        let packed = |cell: Cell| u64::from(cell.y) << 32 | u64::from(cell.x);
        let (mut all, mut diagonal, mut far, mut legal) = (0, 0, 0, 1);
        let Some((&first, rest)) = path.split_first() else {
            return (GridCost::ZERO, true);
        };
        let (mut from, mut from_id) = (packed(first), self.id(first));
        for &cell in rest {
            let (to, to_id) = (packed(cell), self.id(cell));
            let off = to.wrapping_add(ONES).wrapping_sub(from);
            far |= off;
            let place = (off >> 30 | off) & 15;
            legal &= self.legal_at(from_id) >> place;
            let cost = cost(from_id, to_id);
            all += cost;
            // Those in even columns and rows.
            diagonal += if place & 5 == 0 { cost } else { 0 };
            (from, from_id) = (to, to_id);
        }
        let straight = all - diagonal;
        let is_legal = legal == 1 && far & !(3 * ONES) == 0;
        (GridCost { straight, diagonal }, is_legal)
    }
}

/// By rule and free neighbours, the legal steps: bit `4 (dy + 1) + dx + 1` for each.
const LEGAL: [[u16; 256]; 4] = {
    let mut tables = [[0; 256]; 4];
    let mut at = 0;
    while at < 4 * 256 * 8 {
        let (rule, around, k) = (at / 8 / 256, at / 8 % 256, at % 8);
        #[expect(clippy::cast_possible_truncation, reason = "below 256")]
        let is_legal = Moves::ALL[rule].legal(around as u8) >> k & 1;
        let (dx, dy) = DIRECTIONS[k];
        tables[rule][around] |= (is_legal as u16) << (4 * (dy + 1) + dx + 1);
        at += 1;
    }
    tables
};

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

    /// The mark of a path, by the definition: step by step, to the first that is not among a cell's
    /// neighbours.
    fn plainly(problem: &GridProblem, path: &[Cell]) -> Result<GridCost, Violation> {
        let steps = path.windows(2).enumerate().map(|(at, pair)| {
            let mut ways = problem.grid.neighbours(pair[0], problem.moves);
            let way = ways.find(|&(cell, _)| cell == pair[1]);
            way.map(|(_, cost)| cost)
                .ok_or(if problem.grid.is_free(pair[1]) {
                    Violation::IllegalMove { at }
                } else {
                    Violation::Collision { at }
                })
        });
        steps.sum()
    }

    #[test]
    fn a_look_without_branches_sees_what_a_plain_one_does() {
        let mut random = 1u32;
        let mut below = |n: u32| {
            random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (random >> 8) % n
        };
        let (mut right, mut wrong) = (0, 0);
        for story in 0..20_000 {
            let (width, height) = (1 + below(9), 1 + below(9));
            let density = below(5);
            let costs = if story % 2 == 0 { 1 } else { 3 };
            let grid = Grid::new(width, height, |_| {
                u8::try_from(u32::from(below(10) >= density) * (1 + below(costs))).unwrap()
            });
            let mut at = Cell::new(below(width), below(height));
            let mut path = vec![at];
            for _ in 0..below(12) {
                // Once in a while to anywhere, the whole range of numbers included.
                let off = if below(20) == 0 {
                    [u32::MAX, 5, 1 << 31][below(3) as usize]
                } else {
                    1
                };
                let mut to = |at: u32| at.wrapping_add(below(3).wrapping_sub(1).wrapping_mul(off));
                at = Cell {
                    x: to(at.x),
                    y: to(at.y),
                };
                path.push(at);
            }
            let goal = Cell::new(at.x.min(width - 1), at.y.min(height - 1));
            let mut problem = GridProblem::new(grid.unwrap(), path[0], goal).unwrap();
            problem = problem.with_moves(Moves::ALL[story % 4]);
            if !problem.grid.is_free(path[0]) || at != goal {
                path.truncate(1);
                problem.goal = path[0];
                let is_free = problem.grid.is_free(path[0]);
                let mark = if is_free {
                    Ok(GridCost::ZERO)
                } else {
                    Err(Violation::WrongStart)
                };
                assert_eq!(problem.judge(&path), mark);
                continue;
            }
            let mark = plainly(&problem, &path);
            assert_eq!(problem.judge(&path), mark, "{path:?} on\n{}", problem.grid);
            if mark.is_ok() { right += 1 } else { wrong += 1 }
        }
        assert!(right > 1_000 && wrong > 2_000, "{right} {wrong}");
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
