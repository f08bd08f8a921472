//! Robots of a team in time.

use crate::{
    Picture,
    film::{Look, Reel, Shot, Thing},
};
use pf_geom::{TeamPlan, TeamProblem};

impl Reel {
    /// A plan from its beginning to its end in as many frames: discs where the robots are, and the
    /// ways they have come; thin the ways they will go.
    #[must_use]
    pub fn team(problem: &TeamProblem, plan: &TeamPlan, frames: usize) -> Self {
        let mut reel = Self::of(Picture::of_world(problem.world(), 0.0));
        for (k, robot) in problem.robots().iter().enumerate() {
            reel.top
                .push(Thing::GoalOf(k, [robot.goal.x, robot.goal.y]));
            reel = reel.explain(Look::Robot(k), &format!("robot {}", k + 1));
        }
        let mut ways: Vec<Thing> = plan
            .paths
            .iter()
            .map(|path| Thing::Line {
                points: path.iter().map(|p| [p.at.x, p.at.y]).collect(),
                look: Look::Try,
            })
            .collect();
        for (k, robot) in problem.robots().iter().enumerate() {
            let at = [robot.start.x, robot.start.y];
            let (radius, look) = (robot.radius, Look::Robot(k));
            ways.push(Thing::Ring { at, radius, look });
        }
        let duration = plan.duration();
        for k in 0..frames {
            #[expect(clippy::cast_precision_loss, reason = "a number of frames")]
            let time = duration * (k as f64 / (frames - 1).max(1) as f64);
            let mut things = ways.clone();
            let positions = plan.positions(time);
            for (robot, (at, path)) in positions.iter().zip(&plan.paths).enumerate() {
                let been = path.iter().take_while(|p| p.time < time).map(|p| p.at);
                let points = been.chain([*at]).map(|p| [p.x, p.y]).collect();
                let look = Look::Robot(robot);
                things.push(Thing::Line { points, look });
            }
            for (robot, at) in positions.iter().enumerate() {
                things.push(Thing::Disc {
                    at: [at.x, at.y],
                    radius: problem.robots()[robot].radius,
                    look: Look::Robot(robot),
                });
            }
            reel.push(Shot {
                cells: Vec::new(),
                things,
                words: format!("{time:.1} of {duration:.1} s"),
            });
        }
        reel
    }
}
