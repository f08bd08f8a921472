//! What happens to a map and a query, by chance but the same for all planners.
//!
//! Each event happens to the map as the file has it, to a robot that has gone some steps of its path
//! (a quarter of a path that is shorter than four times that); its new place and what changes come as
//! one batch. *Near* means in the square window around the robot that
//! reaches [`NEAR`] cells in all four directions, clipped to the map. A changed cell is flipped: a
//! free one is blocked, a blocked one freed. The cells of robot and goal never change.

use pf_classic::AStar;
use pf_core::{Context, PlanRng, Planner, Problem};
use pf_grid::{Cell, Grid, GridChange, GridProblem};
use rand::{RngExt, SeedableRng};

/// How far near is, in cells.
const NEAR: u32 = 10;
/// How many times the cells that change 1 % near the robot fit into their window.
const ROOM: u32 = 4;
/// How far a block reaches from its middle: 7 x 7 cells.
const REACH: u32 = 3;

/// A class of events.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Class {
    /// 10 cells near the robot.
    NearTen,
    /// As many cells as 1 % of the map's, in the smallest window around the robot that holds four
    /// times as many.
    NearPercent,
    /// As many cells, anywhere.
    AnywherePercent,
    /// All of a block of 7 x 7 cells is blocked whose middle lies on the robot's path, anywhere
    /// between robot and goal so that it covers neither.
    Block,
    /// The goal moves to a free cell near itself; the robot's steps come with it.
    GoalMoved,
    /// The robot is pushed to a free cell near itself.
    RobotMoved,
    /// 10 free cells near one on the robot's path are blocked.
    Blocked,
    /// 10 blocked cells near one on the robot's path are freed.
    Freed,
    /// A square on the robot's path is blocked, the smallest that makes it longer, and does not close
    /// it: of several places one where there is any.
    Longer,
}

impl Class {
    pub(crate) const ALL: [Self; 9] = [
        Self::NearTen,
        Self::NearPercent,
        Self::AnywherePercent,
        Self::Block,
        Self::GoalMoved,
        Self::RobotMoved,
        Self::Blocked,
        Self::Freed,
        Self::Longer,
    ];

    /// Its name in tables and on the command line.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::NearTen => "10-near",
            Self::NearPercent => "1%-near",
            Self::AnywherePercent => "1%-anywhere",
            Self::Block => "block-7x7",
            Self::GoalMoved => "goal-moved",
            Self::RobotMoved => "robot-moved",
            Self::Blocked => "blocked",
            Self::Freed => "freed",
            Self::Longer => "longer",
        }
    }
}

/// An event.
#[derive(Clone, Debug)]
pub(crate) struct Event {
    /// Where the robot stands before anything but its own steps happens.
    pub(crate) robot: Cell,
    /// All that happens, the robot's steps first.
    pub(crate) changes: Vec<GridChange>,
    /// What undoes it.
    pub(crate) undo: Vec<GridChange>,
}

impl Event {
    /// An event of a class, as chance has it; `path` answers the problem, and the robot has gone so
    /// many steps of it. `None` where there is no room for one.
    pub(crate) fn draw(
        class: Class,
        problem: &GridProblem,
        (path, steps): (&[Cell], usize),
        seed: u64,
    ) -> Option<Self> {
        let mut rng = PlanRng::seed_from_u64(seed);
        let (grid, goal) = (problem.grid(), problem.goal());
        let at = steps.min(path.len() / 4);
        let robot = *path.get(at)?;
        let mut changes = vec![GridChange::StartMoved(robot)];
        let mut undo = vec![GridChange::StartMoved(problem.start())];
        let kept = |cell: Cell| cell == robot || cell == goal;
        let percent = (grid.width() * grid.height()).div_ceil(100);
        let cells = match class {
            Class::NearTen => draw(&mut rng, 10, &Window::around(robot, NEAR, grid), kept),
            Class::NearPercent => {
                let window = (1..=grid.width().max(grid.height()))
                    .map(|reach| Window::around(robot, reach, grid))
                    .find(|w| w.cells() >= ROOM * percent)
                    .unwrap_or(Window::all(grid));
                draw(&mut rng, percent, &window, kept)
            }
            Class::AnywherePercent => draw(&mut rng, percent, &Window::all(grid), kept),
            Class::Block => {
                let middle = middle(&mut rng, &path[at..], REACH)?;
                let block = Window::around(middle, REACH, grid);
                block.iter().filter(|&cell| grid.is_free(cell)).collect()
            }
            Class::Blocked | Class::Freed => {
                let free = class == Class::Blocked;
                let near = pick(&mut rng, &path[at..])?;
                let other = |cell: Cell| kept(cell) || grid.is_free(cell) != free;
                draw(&mut rng, 10, &Window::around(*near, NEAR, grid), other)
            }
            Class::Longer => longer(&mut rng, problem, &path[at..])?,
            Class::GoalMoved => {
                let to = elsewhere(&mut rng, grid, goal, robot)?;
                changes.push(GridChange::GoalMoved(to));
                undo.push(GridChange::GoalMoved(goal));
                Vec::new()
            }
            Class::RobotMoved => {
                changes = vec![GridChange::StartMoved(elsewhere(
                    &mut rng, grid, robot, goal,
                )?)];
                Vec::new()
            }
        };
        let (free, blocked): (Vec<Cell>, Vec<Cell>) = cells.iter().partition(|&&c| grid.is_free(c));
        for (cells, does, undoes) in [
            (
                free,
                GridChange::Blocked as fn(_) -> _,
                GridChange::Freed as fn(_) -> _,
            ),
            (blocked, GridChange::Freed, GridChange::Blocked),
        ] {
            if !cells.is_empty() {
                changes.push(does(cells.clone()));
                undo.push(undoes(cells));
            }
        }
        Some(Self {
            robot,
            changes,
            undo,
        })
    }
}

/// Columns and rows, each from and to below.
#[derive(Clone, Copy, Debug)]
struct Window {
    columns: [u32; 2],
    rows: [u32; 2],
}

impl Window {
    fn all(grid: &Grid) -> Self {
        Self {
            columns: [0, grid.width()],
            rows: [0, grid.height()],
        }
    }

    fn around(middle: Cell, reach: u32, grid: &Grid) -> Self {
        let clipped = |at: u32, size: u32| [at.saturating_sub(reach), (at + reach + 1).min(size)];
        Self {
            columns: clipped(middle.x, grid.width()),
            rows: clipped(middle.y, grid.height()),
        }
    }

    fn cells(&self) -> u32 {
        (self.columns[1] - self.columns[0]) * (self.rows[1] - self.rows[0])
    }

    fn iter(&self) -> impl Iterator<Item = Cell> + use<> {
        let [left, right] = self.columns;
        (self.rows[0]..self.rows[1]).flat_map(move |y| (left..right).map(move |x| Cell { x, y }))
    }
}

/// Different cells of a window, or all there are.
fn draw(rng: &mut PlanRng, count: u32, window: &Window, kept: impl Fn(Cell) -> bool) -> Vec<Cell> {
    let mut cells: Vec<Cell> = window.iter().filter(|&cell| !kept(cell)).collect();
    let count = (count as usize).min(cells.len());
    for k in 0..count {
        let other = rng.random_range(k..cells.len());
        cells.swap(k, other);
    }
    cells.truncate(count);
    cells
}

/// The cells of a block on a way that makes it longer and does not close it.
fn longer(rng: &mut PlanRng, problem: &GridProblem, way: &[Cell]) -> Option<Vec<Cell>> {
    let (start, goal) = (*way.first()?, *way.last()?);
    let whole = problem.clone();
    let mut astar = AStar::default();
    let mut cost = |problem: &GridProblem| {
        let report = astar.plan(problem, &mut Context::seeded(0)).ok()?;
        report.outcome.solved().map(|best| best.cost)
    };
    let mut whole = whole;
    whole
        .apply(&[GridChange::StartMoved(start), GridChange::GoalMoved(goal)])
        .ok()?;
    let before = cost(&whole)?;
    for attempt in 0..60 {
        let reach = 1 + attempt / 5;
        let Some(middle) = middle(rng, way, reach) else {
            continue;
        };
        let block = Window::around(middle, reach, problem.grid());
        let cells: Vec<Cell> = block
            .iter()
            .filter(|&c| problem.grid().is_free(c))
            .collect();
        let mut then = whole.clone();
        then.apply(&[GridChange::Blocked(cells.clone())]).ok()?;
        if cost(&then).is_some_and(|after| after > before) {
            return Some(cells);
        }
    }
    None
}

/// A cell of a way around which a block has room, covering neither of its ends.
fn middle(rng: &mut PlanRng, way: &[Cell], reach: u32) -> Option<Cell> {
    let ends = [*way.first()?, *way.last()?];
    let apart = |a: Cell, b: Cell| a.x.abs_diff(b.x).max(a.y.abs_diff(b.y)) > reach;
    let clear = |cell: &Cell| ends.iter().all(|&end| apart(*cell, end));
    let middles: Vec<Cell> = way.iter().copied().filter(clear).collect();
    pick(rng, &middles).copied()
}

fn pick<'c, T>(rng: &mut PlanRng, from: &'c [T]) -> Option<&'c T> {
    (!from.is_empty()).then(|| &from[rng.random_range(0..from.len())])
}

/// A free cell near another, neither that one nor the other end of the way.
fn elsewhere(rng: &mut PlanRng, grid: &Grid, near: Cell, not: Cell) -> Option<Cell> {
    let window = Window::around(near, NEAR, grid);
    let free: Vec<Cell> = window
        .iter()
        .filter(|&cell| grid.is_free(cell) && cell != near && cell != not)
        .collect();
    pick(rng, &free).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn events_are_what_their_class_says_and_can_be_undone() {
        let grid = Grid::new(100, 60, |cell| u8::from(cell.x % 7 != 3 || cell.y % 5 == 2));
        let grid = grid.unwrap();
        let path: Vec<Cell> = (0..100).map(|x| Cell::new(x, 2)).collect();
        let mut problem = GridProblem::new(grid, path[0], path[99]).unwrap();
        let before = problem.clone();
        for class in Class::ALL {
            let event = Event::draw(class, &problem, (&path, 5), 7).unwrap();
            let again = Event::draw(class, &problem, (&path, 5), 7).unwrap();
            assert_eq!(event.changes, again.changes, "{}", class.name());
            assert_eq!(event.robot, Cell::new(5, 2));
            problem.apply(&event.changes).unwrap();
            let changed = problem.grid().layout().cells();
            let changed =
                changed.filter(|&c| problem.grid().is_free(c) != before.grid().is_free(c));
            let changed: Vec<Cell> = changed.collect();
            let (few, most) = match class {
                Class::NearTen | Class::Blocked | Class::Freed => (10, 10),
                Class::NearPercent | Class::AnywherePercent => (60, 60),
                Class::Block => (20, 49),
                Class::GoalMoved | Class::RobotMoved => (0, 0),
                Class::Longer => (1, 49),
            };
            assert!((few..=most).contains(&changed.len()), "{}", class.name());
            if class == Class::NearTen {
                let near = |c: &Cell| c.x <= 15 && c.y <= 12;
                assert!(changed.iter().all(near), "{changed:?}");
            }
            assert_eq!(class == Class::GoalMoved, problem.goal() != before.goal());
            assert!(problem.grid().is_free(problem.start()));
            assert!(problem.grid().is_free(problem.goal()));
            problem.apply(&event.undo).unwrap();
            assert_eq!(problem.grid(), before.grid());
            assert_eq!(
                (problem.start(), problem.goal()),
                (before.start(), before.goal())
            );
        }
    }
}
