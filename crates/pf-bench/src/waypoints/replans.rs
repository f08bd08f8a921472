//! Replans in a row: a goal that drifts among few and many obstacles, and obstacles that move.

use super::{Args, Row, micros, tell};
use crate::protocol::timed;
use anyhow::Result;
use pf_conformance::{
    seeded,
    world::{Kind, Obstacles, Recipe, random_world, waypoint_world},
};
use pf_core::{Context, Outcome, PlanRng, Planner, Problem, Replanner};
use pf_geom::{Vector, WorldChange, WorldProblem};
use pf_lbfgs::{Lbfgs, LbfgsParams};
use rand::RngExt;

pub(super) fn run(args: &Args) -> Result<()> {
    let mut others = None;
    for count in [10, 50, 200] {
        let recipe = Recipe {
            kind: Kind::Scattered,
            shapes: count..=count,
            radius: 0.3,
            density: 0.3,
        };
        let mut rng = seeded(9);
        let problem = random_world(&mut rng, &recipe);
        let row = drift(
            args,
            &mut rng,
            problem,
            &format!("{count} obstacles, goal drifts"),
        )?;
        let others = *others.get_or_insert(row.median_us);
        tell(args, &row.beside(others, (count == 200).then_some(5.0)))?;
    }
    for count in [20, 50] {
        tell(args, &traffic(args, count)?)?;
    }
    Ok(())
}

/// A replan in microseconds, and whether the answer is wrong.
fn replan(
    planner: &mut Lbfgs,
    problem: &mut WorldProblem,
    changes: &[WorldChange],
) -> Result<(f64, bool)> {
    let revision = problem.revise(changes)?;
    let (time, report) = timed(|| planner.replan(&revision, &mut Context::seeded(0)));
    let wrong = match report?.outcome {
        Outcome::Feasible(best) => problem.judge(&best.solution).is_err(),
        Outcome::Infeasible => false,
        Outcome::Optimal(_) | Outcome::Unknown { .. } => true,
    };
    Ok((micros(time), wrong))
}

fn drift(args: &Args, rng: &mut PlanRng, problem: WorldProblem, case: &str) -> Result<Row> {
    let mut problem = problem;
    let mut planner = Lbfgs::default();
    planner.plan(&problem, &mut Context::seeded(0))?;
    let (mut times, mut wrong) = (vec![], 0);
    for _ in 0..args.steps {
        let goal = loop {
            let mut by = || rng.random_range(-1.0..1.0);
            let goal = problem.goal() + Vector::new(by(), by());
            if problem.is_free(goal, goal) {
                break goal;
            }
        };
        let (time, bad) = replan(&mut planner, &mut problem, &[WorldChange::GoalMoved(goal)])?;
        times.push(time);
        wrong += u64::from(bad);
    }
    let mut row = Row::of(case, "lbfgs, a replan", times);
    row.mismatches = wrong;
    Ok(row)
}

/// All obstacles move at once.
fn traffic(args: &Args, count: usize) -> Result<Row> {
    let mut rng = seeded(10);
    let mut problem = waypoint_world(10, count, Obstacles::Mixed);
    let params = LbfgsParams {
        clearance: 0.2,
        ..LbfgsParams::default()
    };
    let mut planner = Lbfgs::new(params)?;
    planner.plan(&problem, &mut Context::seeded(0))?;
    let (mut times, mut wrong) = (vec![], 0);
    let mut speed = || rng.random_range(-0.3..0.3);
    let speeds: Vec<Vector> = (0..count).map(|_| Vector::new(speed(), speed())).collect();
    for step in 0..args.steps {
        // To and fro.
        let sign = if step / 20 % 2 == 0 { 1.0 } else { -1.0 };
        let moves = speeds.iter().enumerate();
        let changes: Vec<_> = moves
            .map(|(id, by)| WorldChange::Moved(id, by * sign))
            .collect();
        let (time, bad) = replan(&mut planner, &mut problem, &changes)?;
        times.push(time);
        wrong += u64::from(bad);
    }
    let mut row = Row::of(
        &format!("{count} obstacles that move"),
        "lbfgs, a replan",
        times,
    );
    row.mismatches = wrong;
    Ok(row)
}
