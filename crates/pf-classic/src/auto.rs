//! A choice between A* and jump point search.

use crate::{AStar, Jps, jps::flipped};
use pf_core::{
    Claims, Context, InvalidParams, Planner, Problem, Replanner, Report, Revision, Stamp,
    Unsupported, params,
};
use pf_grid::{Bend, Cell, Grid, GridProblem, LastPath};

/// The choice has no parameters.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct AutoParams {}

params!(AutoParams {});

/// The faster of [`AStar`] and [`Jps`] for a map, judged by what it looks like.
///
/// Jump points pay where obstacles are large: rooms, caves, mazes. Where they are single cells strewn
/// about, nearly every cell is one, and A* is faster by up to a quarter; on terrain there are none. The
/// note `search` says which of the two answered, and why. A map is surveyed at the first query, and
/// again when one cell in a hundred has changed. A replan keeps what is left of the last path, without a
/// search, where nothing happened but that the robot followed it and cells were blocked beside it, or
/// on it and it can bend ([`LastPath`]); the note `replanned` says `kept` or `afresh`. Where it breaks, a
/// search by jump points ends where it can join what is left.
///
/// One iteration is one expansion of the search chosen.
///
/// ```
/// use pf_core::{Context, Planner};
/// use pf_classic::Auto;
/// use pf_grid::{Cell, Grid, GridProblem};
///
/// let grid = Grid::parse("
///     .....
///     .@@9.
///     .....
/// ").unwrap();
/// let problem = GridProblem::new(grid, Cell::new(0, 0), Cell::new(4, 2)).unwrap();
/// let report = Auto::default().plan(&problem, &mut Context::seeded(0)).unwrap();
/// assert_eq!(report.note("search"), Some("astar: terrain"));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Auto {
    astar: AStar,
    jps: Jps,
    /// Whether obstacles are strewn about.
    strewn: Option<bool>,
    /// Of the grid that was surveyed, as it is now.
    surveyed: Option<Stamp>,
    /// How many cells changed since.
    changed: usize,
    /// Of the problem that was answered last.
    known: Option<Stamp>,
    last: LastPath,
    /// How many cells the last search expanded.
    effort: u64,
}

/// Whether obstacles are single cells strewn about, so many that runs are short: two and more for each 15 free cells,
/// and a quarter of the obstacles.
///
/// Measured on made-up maps (cells at random from 2 to 40 %, rectangles, mazes): A* is the faster one from 15 % on,
/// where nearly all obstacles are alone, and at 40 % still half of them; in a maze whose corridors are one cell wide
/// a tenth are.
fn is_strewn(grid: &Grid) -> bool {
    let free = u64::from(grid.free_cells());
    let blocked = u64::from(grid.width()) * u64::from(grid.height()) - free;
    let are_many = |count: u64| count * 15 > free * 2;
    // Where they are few in all, none is looked at.
    are_many(blocked) && {
        let lone = lone(grid);
        are_many(lone) && lone * 4 > blocked
    }
}

/// How many blocked cells touch at most one other along a side.
fn lone(grid: &Grid) -> u64 {
    let layout = grid.layout();
    let pitch = layout.pitch();
    // Those of the border, blocked as well, touch two.
    let words = (pitch..).step_by(64);
    let words = words.take_while(|&id| (id as usize) < layout.len());
    let count = words.map(|id| {
        let [a, b, c, d] = [id - 1, id + 1, id - pitch, id + pitch].map(|id| grid.free_bits(id));
        let three_free = a & b & (c | d) | c & d & (a | b);
        u64::from((three_free & !grid.free_bits(id)).count_ones())
    });
    count.sum()
}

impl Auto {
    /// A planner.
    ///
    /// # Errors
    /// None today.
    pub fn new(_: AutoParams) -> Result<Self, InvalidParams> {
        Ok(Self::default())
    }

    /// Bytes of memory kept between calls.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.astar.bytes() + self.jps.bytes() + self.last.bytes()
    }

    /// Whether obstacles are strewn about on a problem's grid; `None` if it has terrain.
    fn survey(&mut self, problem: &GridProblem) -> Option<bool> {
        let grid = problem.grid();
        if !grid.is_uniform() {
            self.surveyed = None;
            return None;
        }
        if self.surveyed != Some(grid.stamp()) {
            self.strewn = Some(is_strewn(grid));
            (self.surveyed, self.changed) = (Some(grid.stamp()), 0);
        }
        self.strewn
    }

    /// Whether jump points serve a problem's grid well. Their bits are made for it then.
    pub(crate) fn jumps(&mut self, problem: &GridProblem) -> bool {
        let Some(strewn) = self.survey(problem) else {
            return false;
        };
        self.known = Some(problem.stamp());
        if !strewn {
            self.jps.look_at(problem);
        }
        !strewn
    }

    /// Whether they would.
    pub(crate) fn would_jump(&mut self, problem: &GridProblem) -> bool {
        self.survey(problem) == Some(false)
    }

    /// Whether they served the grid that was surveyed last.
    pub(crate) fn has_jumps(&self) -> bool {
        self.strewn == Some(false)
    }

    /// Answers by jump points, and leaves the path found in the place of the last one. If it learns, it takes what it
    /// learned and what is left of the last path.
    pub(crate) fn jump(
        &mut self,
        problem: &GridProblem,
        learns: bool,
        last: &mut LastPath,
        cx: &mut Context<'_, GridProblem>,
    ) -> Result<Report<GridProblem>, Unsupported> {
        self.known = Some(problem.stamp());
        self.jps.answer(problem, learns, Some(last), cx)
    }

    /// Whether a grid was ever surveyed.
    pub(crate) fn is_in_use(&self) -> bool {
        self.strewn.is_some()
    }

    /// Follows changes with what is known of the grid.
    fn follow(&mut self, revision: &Revision<'_, GridProblem>) {
        if let Some(changes) = revision.since(self.known) {
            let (cells, opened) = flipped(changes);
            self.catch_up(revision.problem(), cells, opened);
        }
    }

    /// The same, told of the cells that changed since, and whether any of them was freed.
    pub(crate) fn catch_up(
        &mut self,
        problem: &GridProblem,
        cells: impl Iterator<Item = Cell>,
        opened: bool,
    ) {
        let grid = problem.grid();
        let jumps = self.has_jumps();
        let count = &mut self.changed;
        let cells = cells.inspect(|_| *count += 1);
        // Bits that nobody asks for are made anew, should that change.
        if jumps && self.jps.is_known(self.known) {
            self.jps.catch_up(problem, cells, opened);
        } else {
            cells.for_each(drop);
        }
        if self.surveyed.is_some() && self.changed * 100 <= grid.layout().len() {
            self.surveyed = Some(grid.stamp());
        }
        self.known = Some(problem.stamp());
    }

    /// Whether to jump, and says why.
    fn choose(&mut self, problem: &GridProblem, cx: &mut Context<'_, GridProblem>) -> bool {
        let (jumps, why) = match self.survey(problem) {
            None => (false, "astar: terrain"),
            Some(true) => (false, "astar: strewn cells"),
            Some(false) => (true, "jps: larger obstacles"),
        };
        cx.note("search", why);
        jumps
    }
}

impl Planner<GridProblem> for Auto {
    fn name(&self) -> &'static str {
        "A* or JPS"
    }

    fn claims(&self) -> Claims {
        Claims::NONE.complete().optimal().deterministic()
    }

    fn plan(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Result<Report<GridProblem>, Unsupported> {
        if self.changed > 0 {
            // The choice does not depend on what was asked before.
            self.surveyed = None;
        }
        self.answer(problem, false, cx)
    }
}

impl Auto {
    /// Answers, and learns for answers to come.
    fn answer(
        &mut self,
        problem: &GridProblem,
        learns: bool,
        cx: &mut Context<'_, GridProblem>,
    ) -> Result<Report<GridProblem>, Unsupported> {
        self.known = Some(problem.stamp());
        let before = cx.stats().expanded;
        let jumps = self.choose(problem, cx);
        let report = if jumps && learns {
            self.jps.answer(problem, true, Some(&mut self.last), cx)?
        } else {
            let report = if jumps {
                self.jps.answer(problem, false, None, cx)
            } else {
                self.astar.plan(problem, cx)
            }?;
            self.last.remember(problem, &report);
            report
        };
        self.effort = cx.stats().expanded - before;
        Ok(report)
    }
}

impl Replanner<GridProblem> for Auto {
    fn replan(
        &mut self,
        revision: &Revision<'_, GridProblem>,
        cx: &mut Context<'_, GridProblem>,
    ) -> Result<Report<GridProblem>, Unsupported> {
        let problem = revision.problem();
        self.follow(revision);
        let how = Bend::to_spare(self.effort);
        if let Some(report) = self.last.answer(revision, how, cx) {
            return Ok(report);
        }
        cx.note("replanned", "afresh");
        self.answer(problem, true, cx)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lone_cells_are_counted_wherever_words_begin() {
        for (width, height) in [(1, 1), (1, 150), (150, 1), (63, 9), (64, 9), (131, 17)] {
            let is_free = |cell: Cell| (cell.x * 7 + cell.y * 13 + cell.x * cell.y) % 5 > 1;
            let grid = Grid::new(width, height, |cell| u8::from(is_free(cell))).unwrap();
            let is_lone = |cell: &Cell| {
                let sides = [(1, 0), (0, 1), (-1, 0), (0, -1)].map(|(dx, dy)| Cell {
                    x: cell.x.wrapping_add_signed(dx),
                    y: cell.y.wrapping_add_signed(dy),
                });
                let free = sides.iter().filter(|&&side| grid.is_free(side)).count();
                !grid.is_free(*cell) && free >= 3
            };
            let count = grid.layout().cells().filter(is_lone).count() as u64;
            assert_eq!(lone(&grid), count, "{width} x {height}");
        }
    }
}
