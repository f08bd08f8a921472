//! Drives through unknown maps: what repairs and what starts over agree at every discovery.
#![expect(clippy::unwrap_used, reason = "a test that stumbles has failed")]

use pf_classic::{AStar, Auto, DStarLite};
use pf_core::{
    Claims, Context, Outcome, Planner, Problem, Replanner, Report, Revision, Unsupported,
};
use pf_grid::{Arrival, Cell, Drive, Grid, GridCost, GridProblem, Moves};
use pf_rfd::RfdField;

/// A planner that repairs, with an A* that answers the same afresh.
#[derive(Default)]
struct Checked<T> {
    repairs: T,
    afresh: AStar,
    answers: u32,
}

fn cost(report: &Report<GridProblem>) -> Option<GridCost> {
    match &report.outcome {
        Outcome::Optimal(best) => Some(best.cost),
        Outcome::Infeasible => None,
        other => panic!("{}", other.word()),
    }
}

impl<T> Checked<T> {
    fn compare(&mut self, problem: &GridProblem, report: &Report<GridProblem>) {
        let afresh = self.afresh.plan(problem, &mut Context::seeded(0)).unwrap();
        assert_eq!(cost(report), cost(&afresh), "{}", problem.grid());
        self.answers += 1;
    }
}

impl<T: Replanner<GridProblem>> Planner<GridProblem> for Checked<T> {
    fn name(&self) -> &'static str {
        "checked"
    }

    fn claims(&self) -> Claims {
        Claims::NONE
    }

    fn plan(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Result<Report<GridProblem>, Unsupported> {
        let report = self.repairs.plan(problem, cx)?;
        self.compare(problem, &report);
        Ok(report)
    }
}

impl<T: Replanner<GridProblem>> Replanner<GridProblem> for Checked<T> {
    fn replan(
        &mut self,
        revision: &Revision<'_, GridProblem>,
        cx: &mut Context<'_, GridProblem>,
    ) -> Result<Report<GridProblem>, Unsupported> {
        let report = self.repairs.replan(revision, cx)?;
        self.compare(revision.problem(), &report);
        Ok(report)
    }

    fn settle(&mut self, problem: &GridProblem, cx: &mut Context<'_, GridProblem>) {
        self.repairs.settle(problem, cx);
    }
}

/// A map with so many blocked cells of ten, and terrain if asked for; small numbers that look like
/// chance.
fn field(side: u32, seed: u32, blocked: u32, terrain: bool) -> Grid {
    Grid::new(side, side, |cell| {
        let mut x = seed ^ cell.x.wrapping_mul(0x9e37_79b9) ^ cell.y.wrapping_mul(0x85eb_ca6b);
        x = (x ^ x >> 15).wrapping_mul(0x2c1b_3c6d);
        x = (x ^ x >> 12).wrapping_mul(0x297a_2d39);
        x ^= x >> 15;
        let corner = [0, side - 1].contains(&cell.x) && [0, side - 1].contains(&cell.y);
        match (x % 10 < blocked && !corner, terrain) {
            (true, _) => 0,
            (false, true) => 1 + (x >> 8 & 3) as u8,
            (false, false) => 1,
        }
    })
    .unwrap()
}

#[test]
fn repaired_and_fresh_plans_cost_the_same_at_every_discovery() {
    drive_them_all::<DStarLite>();
}

#[test]
fn read_off_and_fresh_plans_cost_the_same_at_every_discovery() {
    drive_them_all::<RfdField>();
}

#[test]
fn kept_and_fresh_plans_cost_the_same_at_every_discovery() {
    drive_them_all::<Auto>();
}

fn drive_them_all<T: Replanner<GridProblem> + Default>() {
    let (mut arrived, mut closed, mut answers) = (0, 0, 0);
    for seed in 0..60 {
        let (blocked, terrain) = (2 + seed % 3, seed % 4 == 3);
        let grid = field(24, seed, blocked, terrain);
        let moves = Moves::ALL[seed as usize / 3 % 4];
        let problem = GridProblem::new(grid, Cell::new(0, 0), Cell::new(23, 23));
        let problem = problem.unwrap().with_moves(moves);
        let mut drive = Drive::new(&problem, f64::from(seed % 5)).unwrap();
        let mut planner = Checked::<T>::default();
        let travel = drive.run(&mut planner, || Context::seeded(0)).unwrap();
        answers += planner.answers;
        assert_eq!(planner.answers as usize, 1 + travel.latencies.len());
        let known = AStar::default()
            .plan(&problem, &mut Context::seeded(0))
            .unwrap();
        match travel.arrival {
            Arrival::Arrived => {
                arrived += 1;
                // The judge of the true map marks the whole way, and nothing beats its optimum.
                let driven = problem.judge(&drive.trail().to_vec()).unwrap();
                assert_eq!(driven, drive.cost());
                assert!(driven >= cost(&known).unwrap());
            }
            Arrival::Closed => {
                closed += 1;
                assert_eq!(cost(&known), None);
            }
            other => panic!("{other:?}"),
        }
    }
    // The cases are those they were made to be.
    assert!(
        arrived > 20 && closed > 5 && answers > 500,
        "{arrived} {closed} {answers}"
    );
}

#[test]
fn who_knows_all_from_the_start_drives_the_shortest_way() {
    let grid = field(24, 8, 2, false);
    let problem = GridProblem::new(grid, Cell::new(0, 0), Cell::new(23, 23)).unwrap();
    let mut drive = Drive::new(&problem, 40.0).unwrap();
    let travel = drive
        .run(&mut Checked::<DStarLite>::default(), || Context::seeded(0))
        .unwrap();
    assert_eq!(
        (travel.arrival, travel.latencies.len()),
        (Arrival::Arrived, 0)
    );
    let known = AStar::default()
        .plan(&problem, &mut Context::seeded(0))
        .unwrap();
    assert_eq!(Some(drive.cost()), cost(&known));
}

#[test]
fn a_cancelled_drive_ends() {
    let problem = GridProblem::new(Grid::open(9, 9).unwrap(), Cell::new(0, 0), Cell::new(8, 8));
    let token = pf_core::CancelToken::default();
    token.cancel();
    let budget = pf_core::Budget::unlimited().cancel(&token);
    let mut drive = Drive::new(&problem.unwrap(), 3.0).unwrap();
    let order = || Context::seeded(0).within(budget.clone());
    let travel = drive.run(&mut DStarLite::default(), order).unwrap();
    assert_eq!(travel.arrival, Arrival::Cancelled);
}
