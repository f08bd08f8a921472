//! Scenes as teams of one robot.

use crate::{Changes, Found, FromScene, Posed, Scene};
use pf_core::{InvalidProblem, Solved};
use pf_geom::{LENGTH, Point, Robot, TeamChange, TeamProblem, WorldChange, WorldProblem};

impl FromScene for TeamProblem {
    const KIND: &'static str = "team";

    fn pose(scene: &Scene) -> Result<Posed<Self>, InvalidProblem> {
        let alone = WorldProblem::pose(scene)?;
        let robot = Robot::new(alone.problem.start(), alone.problem.goal())
            .with_radius(alone.problem.radius());
        Ok(Posed {
            problem: Self::new(alone.problem.shared_world(), vec![robot])?,
            conversion: alone.conversion,
        })
    }

    fn follow(
        posed: &mut Posed<Self>,
        scene: &Scene,
        changes: &Changes,
    ) -> Result<Vec<TeamChange>, InvalidProblem> {
        let robot = posed.problem.robots()[0];
        let world = posed.problem.shared_world();
        let mut alone = Posed {
            problem: WorldProblem::new(world, robot.radius, robot.start, robot.goal)?,
            conversion: posed.conversion.take(),
        };
        let changes = WorldProblem::follow(&mut alone, scene, changes)?;
        posed.conversion = alone.conversion;
        Ok(changes.into_iter().map(of_one).collect())
    }

    /// The shortest plan of the front.
    fn read(posed: &Posed<Self>, _scene: &Scene, solved: &Solved<Self>) -> Option<Found> {
        let plans = solved.cost.members().iter().zip(solved.solution.members());
        let (cost, plan) = plans.min_by(|a, b| a.0[LENGTH].total_cmp(&b.0[LENGTH]))?;
        // On a grid the middle of a cell is where its column and row say.
        let shift = if posed.conversion.is_some() { 0.5 } else { 0.0 };
        let point = |p: Point| [p.x - shift, p.y - shift];
        let line = |path: &pf_geom::TimedPath| path.iter().map(|p| point(p.at)).collect();
        Some(Found {
            costs: vec![cost[LENGTH]],
            lines: plan.paths.iter().map(line).collect(),
        })
    }
}

/// What happens to a world, as it happens to a team of one in it.
fn of_one(change: WorldChange) -> TeamChange {
    match change {
        WorldChange::StartMoved(to) => TeamChange::StartMoved(0, to),
        WorldChange::GoalMoved(to) => TeamChange::GoalMoved(0, to),
        WorldChange::Added(shape) => TeamChange::Added(shape),
        WorldChange::Removed(id) => TeamChange::Removed(id),
        WorldChange::Moved(id, by) => TeamChange::Moved(id, by),
    }
}
