//! A robot with a sensor in a map that it does not know.

use crate::{Cell, Grid, GridChange, GridCost, GridProblem};
use pf_core::{
    Clock, Context, InvalidProblem, Outcome, Problem, Replanner, Report, Revision, Stop,
    Unsupported,
};
use std::time::Duration;

/// A drive through an unknown map: what the robot knows, and where it has been.
///
/// The sensor sees all cells whose middles lie within a radius of the robot's, walls or not: there is
/// no occlusion, so that what is seen depends on the place alone and not on a model of light. The
/// eight cells around the robot are seen whatever the radius. What was not seen yet is presumed free
/// and to cost 1, the *freespace assumption* under which D* Lite was published. The map does not
/// change meanwhile, so what was seen stays true.
///
/// [`run`](Self::run) drives to the end; [`advance`](Self::advance) and [`learn`](Self::learn) go from
/// discovery to discovery.
///
/// ```
/// use pf_core::Problem;
/// use pf_grid::{Advance, Cell, Drive, Grid, GridProblem};
///
/// let map = Grid::parse("
///     ........
///     .....@..
///     .....@..
/// ").unwrap();
/// let problem = GridProblem::new(map, Cell::new(0, 2), Cell::new(7, 2)).unwrap();
/// let mut drive = Drive::new(&problem, 3.0).unwrap();
/// assert!(drive.known().grid().is_free(Cell::new(5, 2)));
///
/// let ahead: Vec<Cell> = (0..8).map(|x| Cell::new(x, 2)).collect();
/// let Advance::Discovered(changes) = drive.advance(&ahead) else { panic!() };
/// assert_eq!(drive.robot(), Cell::new(2, 2));
/// let revision = drive.learn(&changes).unwrap();
/// assert!(!revision.problem().grid().is_free(Cell::new(5, 2)));
/// ```
#[derive(Clone, Debug)]
pub struct Drive {
    /// The map as it is.
    truth: GridProblem,
    /// The map as the robot knows it, and where it stands.
    known: GridProblem,
    /// Per id: seen.
    seen: Vec<bool>,
    /// How many columns to either side the sensor sees, per rows up or down.
    disc: Vec<u32>,
    trail: Vec<Cell>,
    cost: GridCost,
}

/// Where following a path led.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Advance {
    /// To the goal.
    Arrived,
    /// To something that is not as was presumed: where the robot is now, and what cells are.
    Discovered(Vec<GridChange>),
    /// To a step that cannot be made, or the end of a path that does not lead to the goal.
    Refused,
}

/// How a [`Drive`] ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arrival {
    /// At the goal.
    Arrived,
    /// With the proof that there is no way to it.
    Closed,
    /// Without a path, and without a proof.
    GaveUp,
    /// Because somebody cancelled.
    Cancelled,
    /// At a step of the planner's path that cannot be made.
    Refused,
}

/// What a drive took.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Travel {
    /// How it ended.
    pub arrival: Arrival,
    /// The first plan's time, with what was seen from the start.
    pub first: Duration,
    /// From each discovery to the answer, the change of the known map included, in their order.
    pub latencies: Vec<Duration>,
    /// All upkeep.
    pub upkeep: Duration,
    /// Expansions of all plans.
    pub expanded: u64,
}

impl Travel {
    /// The planner's time in all, upkeep included.
    #[must_use]
    pub fn planning(&self) -> Duration {
        self.first + self.latencies.iter().sum::<Duration>() + self.upkeep
    }
}

impl Drive {
    /// Puts a robot with a sensor of this radius, in cells, at the start of a problem whose map it
    /// does not know, and lets it look around.
    ///
    /// # Errors
    /// [`InvalidProblem::BadValue`] if the radius is negative or no number.
    pub fn new(truth: &GridProblem, radius: f64) -> Result<Self, InvalidProblem> {
        if !(radius >= 0.0 && radius.is_finite()) {
            return Err(InvalidProblem::BadValue {
                what: "the sensor's radius".into(),
                found: radius.to_string(),
                expected: "a number from 0, in cells".into(),
            });
        }
        let grid = truth.grid();
        let presumed = Grid::open(grid.width(), grid.height())?;
        let known = GridProblem::new(presumed, truth.start(), truth.goal())?;
        let mut drive = Self {
            known: known.with_moves(truth.moves()),
            seen: vec![false; grid.layout().len()],
            disc: disc(radius, grid),
            trail: vec![truth.start()],
            cost: GridCost::ZERO,
            truth: truth.clone(),
        };
        let around = drive.look();
        drive.known.apply(&around)?;
        Ok(drive)
    }

    /// The problem as the robot knows it now: from where it stands, over what it has seen, the rest
    /// presumed free.
    #[must_use]
    pub fn known(&self) -> &GridProblem {
        &self.known
    }

    /// Whether the robot has seen a cell.
    #[must_use]
    pub fn has_seen(&self, cell: Cell) -> bool {
        let layout = self.truth.grid().layout();
        layout.contains(cell) && self.seen[layout.id(cell) as usize]
    }

    /// Where the robot stands.
    #[must_use]
    pub fn robot(&self) -> Cell {
        self.trail[self.trail.len() - 1]
    }

    /// The cells the robot has been in, the start first.
    #[must_use]
    pub fn trail(&self) -> &[Cell] {
        &self.trail
    }

    /// What the way so far has cost.
    #[must_use]
    pub fn cost(&self) -> GridCost {
        self.cost
    }

    /// Follows a path, the robot's cell first, until something is seen that is not as presumed, or
    /// to its end.
    pub fn advance(&mut self, path: &[Cell]) -> Advance {
        if path.first() != Some(&self.robot()) {
            return Advance::Refused;
        }
        for &next in &path[1..] {
            let at = self.robot();
            let grid = self.truth.grid();
            let mut steps = grid.neighbours(at, self.truth.moves());
            let Some((_, cost)) = steps.find(|&(cell, _)| cell == next) else {
                return Advance::Refused;
            };
            drop(steps);
            self.trail.push(next);
            self.cost = self.cost + cost;
            let mut news = self.look();
            if !news.is_empty() {
                news.insert(0, GridChange::StartMoved(next));
                return Advance::Discovered(news);
            }
        }
        if self.robot() == self.truth.goal() {
            Advance::Arrived
        } else {
            Advance::Refused
        }
    }

    /// Writes a discovery into the known map, for [`Replanner::replan`].
    ///
    /// # Errors
    /// [`InvalidProblem`] if the changes are not those of a discovery in this map.
    pub fn learn<'a>(
        &'a mut self,
        changes: &'a [GridChange],
    ) -> Result<Revision<'a, GridProblem>, InvalidProblem> {
        self.known.revise(changes)
    }

    /// Drives until there is no more to do, planning anew at every discovery. `order` gives each
    /// call of the planner its context: seed and budget.
    ///
    /// # Errors
    /// [`Unsupported`] if the planner is not defined for the map.
    pub fn run(
        &mut self,
        planner: &mut dyn Replanner<GridProblem>,
        mut order: impl FnMut() -> Context<'static, GridProblem>,
    ) -> Result<Travel, Unsupported> {
        let clock = Clock::default();
        let mut began = clock.now();
        let mut report = planner.plan(&self.known, &mut order())?;
        let mut travel = Travel {
            arrival: Arrival::Arrived,
            first: clock.now().saturating_sub(began),
            latencies: Vec::new(),
            upkeep: Duration::ZERO,
            expanded: report.stats.expanded,
        };
        loop {
            began = clock.now();
            planner.settle(&self.known, &mut order());
            travel.upkeep += clock.now().saturating_sub(began);
            let changes = match self.obey(&report) {
                Ok(changes) => changes,
                Err(arrival) => {
                    travel.arrival = arrival;
                    return Ok(travel);
                }
            };
            began = clock.now();
            let Ok(revision) = self.known.revise(&changes) else {
                unreachable!("what is seen lies within the map")
            };
            report = planner.replan(&revision, &mut order())?;
            travel.latencies.push(clock.now().saturating_sub(began));
            travel.expanded += report.stats.expanded;
        }
    }

    /// Goes where an answer leads: to the next discovery, or the end.
    fn obey(&mut self, report: &Report<GridProblem>) -> Result<Vec<GridChange>, Arrival> {
        match &report.outcome {
            _ if report.stop == Stop::Cancelled => Err(Arrival::Cancelled),
            Outcome::Infeasible => Err(Arrival::Closed),
            Outcome::Unknown { .. } => Err(Arrival::GaveUp),
            Outcome::Optimal(best) | Outcome::Feasible(best) => {
                match self.advance(&best.solution) {
                    Advance::Arrived => Err(Arrival::Arrived),
                    Advance::Refused => Err(Arrival::Refused),
                    Advance::Discovered(changes) => Ok(changes),
                }
            }
        }
    }

    /// Looks around; says what is not as presumed.
    fn look(&mut self) -> Vec<GridChange> {
        let at = self.robot();
        let grid = self.truth.grid();
        let layout = grid.layout();
        let mut blocked = Vec::new();
        let mut dear: Vec<(u8, Cell)> = Vec::new();
        let rows = u32::try_from(self.disc.len()).unwrap_or(u32::MAX);
        let within = |at: u32, reach: u32, size: u32| {
            at.saturating_sub(reach)..at.saturating_add(reach + 1).min(size)
        };
        let cells = within(at.y, rows - 1, grid.height()).flat_map(|y| {
            let columns = self.disc[at.y.abs_diff(y) as usize];
            within(at.x, columns, grid.width()).map(move |x| Cell { x, y })
        });
        for cell in cells {
            let seen = &mut self.seen[layout.id(cell) as usize];
            if std::mem::replace(seen, true) {
                continue;
            }
            if !grid.is_free(cell) {
                blocked.push(cell);
            } else if grid.cost(cell) != 1 {
                dear.push((grid.cost(cell), cell));
            }
        }
        let mut news = Vec::new();
        if !blocked.is_empty() {
            news.push(GridChange::Blocked(blocked));
        }
        dear.sort_unstable();
        for same in dear.chunk_by(|a, b| a.0 == b.0) {
            let cells = same.iter().map(|&(_, cell)| cell).collect();
            news.push(GridChange::CostChanged(cells, same[0].0));
        }
        news
    }
}

/// How many columns to either side lie within a radius, per rows up or down: one at least, so that
/// the eight neighbours do, and no more than reach all of a grid.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "from 0, and clamped to the grid's sides"
)]
fn disc(radius: f64, grid: &Grid) -> Vec<u32> {
    let within = |reach: f64, side: u32| reach.min(f64::from(side)) as u32;
    let columns = |row: u32| {
        let off = f64::from(row);
        let reach = (radius * radius - off * off).max(0.0).sqrt();
        within(reach, grid.width()).max(u32::from(row <= 1))
    };
    (0..=within(radius, grid.height()).max(1))
        .map(columns)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Moves;

    fn drive(drawing: &str, to: (u32, u32), radius: f64) -> Drive {
        let problem = GridProblem::new(
            Grid::parse(drawing).unwrap(),
            Cell::new(0, 0),
            Cell::new(to.0, to.1),
        );
        Drive::new(&problem.unwrap(), radius).unwrap()
    }

    fn east(to: u32) -> Vec<Cell> {
        (0..=to).map(|x| Cell::new(x, 0)).collect()
    }

    #[test]
    fn the_sensor_is_a_disc_and_sees_the_neighbours_at_least() {
        let count = |radius| {
            let mut drive = drive(&["......."; 7].join(" "), (6, 6), radius);
            drive.trail = vec![Cell::new(3, 3)];
            drive.seen.fill(false);
            drive.look();
            drive.seen.iter().filter(|&&seen| seen).count()
        };
        assert_eq!([0.0, 1.0, 2.0, 2.3, 3.0].map(count), [9, 9, 13, 21, 29]);
        assert_eq!(count(1e300), 49);
    }

    #[test]
    fn only_what_is_not_as_presumed_is_a_discovery() {
        let mut drive = drive("......#.", (5, 0), 2.0);
        let news = Advance::Discovered(vec![
            GridChange::StartMoved(Cell::new(4, 0)),
            GridChange::Blocked(vec![Cell::new(6, 0)]),
        ]);
        assert_eq!(drive.advance(&east(5)), news);
        assert_eq!(drive.advance(&east(5)[4..]), Advance::Arrived);
        assert_eq!(drive.cost(), GridCost::of_steps(5, 0));
        assert_eq!(drive.trail(), east(5));
        assert!(drive.has_seen(Cell::new(7, 0)) && !drive.has_seen(Cell::new(8, 0)));
    }

    #[test]
    fn terrain_is_discovered_too() {
        let mut drive = drive("...57.", (5, 0), 1.0);
        let Advance::Discovered(news) = drive.advance(&east(5)) else {
            panic!()
        };
        assert_eq!(
            news[1..],
            [GridChange::CostChanged(vec![Cell::new(3, 0)], 5)]
        );
        drive.learn(&news).unwrap();
        assert_eq!(drive.known().grid().cost(Cell::new(3, 0)), 5);
        assert_eq!(drive.known().grid().cost(Cell::new(4, 0)), 1);
    }

    #[test]
    fn steps_that_cannot_be_made_are_refused() {
        let mut drive = drive("...#. .....", (4, 0), 9.0);
        assert_eq!(drive.advance(&east(4)), Advance::Refused);
        assert_eq!(drive.robot(), Cell::new(2, 0));
        assert_eq!(drive.advance(&east(4)), Advance::Refused);
        assert_eq!(drive.advance(&[]), Advance::Refused);
        assert_eq!(drive.advance(&[Cell::new(2, 0)]), Advance::Refused);
    }

    #[test]
    fn the_moves_are_those_of_the_problem() {
        let grid = Grid::parse(".. ..").unwrap();
        let problem = GridProblem::new(grid, Cell::new(0, 0), Cell::new(1, 1)).unwrap();
        let across = [Cell::new(0, 0), Cell::new(1, 1)];
        for (moves, ends) in [
            (Moves::Always, Advance::Arrived),
            (Moves::Orthogonal, Advance::Refused),
        ] {
            let mut drive = Drive::new(&problem.clone().with_moves(moves), 1.0).unwrap();
            assert_eq!(drive.advance(&across), ends);
        }
    }

    #[test]
    fn a_sensor_has_a_radius() {
        let problem = GridProblem::new(Grid::open(2, 2).unwrap(), Cell::default(), Cell::default());
        let problem = problem.unwrap();
        for radius in [-1.0, f64::NAN, f64::INFINITY] {
            assert!(Drive::new(&problem, radius).is_err());
        }
    }
}
