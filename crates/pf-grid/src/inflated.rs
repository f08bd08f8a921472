use crate::{Cell, Grid, GridChange};
use pf_core::InvalidProblem;

/// A grid inflated by a robot's radius that follows the changes of the grid it came from.
///
/// For each cell it counts the obstacles too near for the robot, so a changed cell costs as much
/// as the disc around it, whatever the size of the grid.
///
/// ```
/// # use pf_grid::*;
/// let source = Grid::parse("..... ..... .....").unwrap();
/// let mut inflated = Inflated::new(&source, 1.0);
/// let wall = GridChange::Blocked(vec![Cell::new(0, 1)]);
/// let changes = inflated.follow(&[wall]).unwrap();
/// assert_eq!(inflated.grid(), &Grid::parse("##... ##... ##...").unwrap());
///
/// // What to tell a problem on the inflated grid:
/// let mut problem = GridProblem::new(source, Cell::new(4, 0), Cell::new(4, 2)).unwrap();
/// pf_core::Problem::apply(&mut problem, &changes).unwrap();
/// assert_eq!(problem.grid(), inflated.grid());
/// ```
#[derive(Clone, Debug)]
pub struct Inflated {
    source: Grid,
    grid: Grid,
    /// Row by row: how many blocked cells of the source are nearer than the radius.
    near: Vec<u32>,
    /// For each row offset from 0: how far the disc reaches to either side.
    reach: Vec<u32>,
}

impl Inflated {
    /// `source` inflated by `radius` cells, as by [`Grid::inflated`].
    #[must_use]
    pub fn new(source: &Grid, radius: f64) -> Self {
        let mut inflated = Self {
            source: source.clone(),
            grid: source.clone(),
            near: vec![0; source.width() as usize * source.height() as usize],
            reach: disc(radius, source),
        };
        for cell in source.layout().cells() {
            if !source.is_free(cell) {
                inflated.count(cell, true, &mut Vec::new());
            }
        }
        inflated
    }

    /// The inflated grid as it is now.
    #[must_use]
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The grid it came from, as it is now.
    #[must_use]
    pub fn source(&self) -> &Grid {
        &self.source
    }

    /// Makes `changes` happen to the source and says what they are to the inflated grid. Moves of
    /// start and goal and new costs are passed on.
    ///
    /// # Errors
    /// [`InvalidProblem`], with nothing changed, if a change makes no sense.
    pub fn follow(&mut self, changes: &[GridChange]) -> Result<Vec<GridChange>, InvalidProblem> {
        for change in changes {
            self.source.check_change(change)?;
        }
        let mut followed = Vec::with_capacity(changes.len());
        for change in changes {
            match change {
                GridChange::Blocked(cells) | GridChange::Freed(cells) => {
                    let block = matches!(change, GridChange::Blocked(_));
                    let mut turned = Vec::new();
                    for &cell in cells {
                        if self.source.set_free(&[cell], !block) {
                            self.count(cell, block, &mut turned);
                        }
                    }
                    if !turned.is_empty() {
                        followed.push(if block {
                            GridChange::Blocked(turned)
                        } else {
                            GridChange::Freed(turned)
                        });
                    }
                }
                GridChange::CostChanged(cells, cost) => {
                    for &cell in cells {
                        self.source.set_cost(cell, *cost);
                        self.grid.set_cost(cell, *cost);
                    }
                    followed.push(change.clone());
                }
                GridChange::StartMoved(_) | GridChange::GoalMoved(_) => {
                    followed.push(change.clone());
                }
            }
        }
        Ok(followed)
    }

    /// Counts an obstacle in or out; appends the cells that turned blocked or free.
    fn count(&mut self, obstacle: Cell, block: bool, turned: &mut Vec<Cell>) {
        let (width, height) = (self.grid.width(), self.grid.height());
        let rows = u32::try_from(self.reach.len()).unwrap_or(u32::MAX) - 1;
        let last = (obstacle.y.saturating_add(rows)).min(height - 1);
        for y in obstacle.y.saturating_sub(rows)..=last {
            let reach = self.reach[y.abs_diff(obstacle.y) as usize];
            let right = obstacle.x.saturating_add(reach).min(width - 1);
            for x in obstacle.x.saturating_sub(reach)..=right {
                let near = &mut self.near[y as usize * width as usize + x as usize];
                let turns = if block {
                    *near += 1;
                    *near == 1
                } else {
                    *near -= 1;
                    *near == 0
                };
                let cell = Cell { x, y };
                if turns && self.grid.set_free(&[cell], !block) {
                    turned.push(cell);
                }
            }
        }
    }
}

/// How far the disc reaches to either side in each row, from the middle one down; no further than
/// the grid is large.
fn disc(radius: f64, grid: &Grid) -> Vec<u32> {
    let side = grid.width().max(grid.height());
    // From a cell's centre to the side of one so many cells away.
    let gap = |cells: u32| (f64::from(cells) - 0.5).max(0.0);
    let inside = |dx: u32, dy: u32| {
        let (x, y) = (2.0 * gap(dx), 2.0 * gap(dy));
        dx == 0 && dy == 0 || x * x + y * y < 4.0 * radius * radius
    };
    let rows = (0..side).take_while(|&dy| inside(0, dy));
    let mut reach = side - 1;
    rows.map(|dy| {
        while reach > 0 && !inside(reach, dy) {
            reach -= 1;
        }
        reach
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn following_changes_equals_inflating_anew() {
        let mut state = 7u64;
        let mut random = |n: u32| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            u32::try_from((state >> 33) % u64::from(n)).unwrap()
        };
        for round in 0..60 {
            let (width, height) = (1 + random(30), 1 + random(30));
            let source = Grid::new(width, height, |_| u8::from(random(10) > 0)).unwrap();
            let radius = f64::from(random(12)) * 0.37;
            let mut inflated = Inflated::new(&source, radius);
            assert_eq!(
                inflated.grid(),
                &source.inflated(radius),
                "{source}{radius}"
            );
            for _ in 0..8 {
                let kind = random(3);
                let cells = (0..random(6))
                    .map(|_| Cell::new(random(width), random(height)))
                    .collect();
                let change = match kind {
                    0 => GridChange::Blocked(cells),
                    1 => GridChange::Freed(cells),
                    _ => GridChange::CostChanged(cells, 9),
                };
                inflated.follow(&[change]).unwrap();
                let anew = inflated.source().inflated(radius);
                assert_eq!(inflated.grid(), &anew, "round {round}, radius {radius}");
            }
        }
    }

    #[test]
    fn nonsense_changes_nothing() {
        let grid = Grid::parse(".#. ...").unwrap();
        let mut inflated = Inflated::new(&grid, 1.0);
        let before = inflated.grid().clone();
        let changes = [
            GridChange::Freed(vec![Cell::new(1, 0)]),
            GridChange::Blocked(vec![Cell::new(3, 0)]),
        ];
        assert!(inflated.follow(&changes).is_err());
        assert_eq!(inflated.grid(), &before);
    }
}
