//! The problems: the paper's two experiments, and further ones on which nothing was ever tuned.

use crate::PaperError;
use pf_classic::VisibilityGraph;
use pf_conformance::{
    team::{TeamRecipe, crossing},
    world::Obstacles,
};
use pf_core::{Context, Planner};
use pf_geom::{
    Circle, Objectives, Point, Polygon, Rectangle, Robot, Shape, TeamProblem, World, WorldProblem,
};
use std::f64::consts::TAU;

/// A problem and how its objectives are scaled to be measured.
#[derive(Clone, Debug)]
pub struct Trial {
    /// Its name in tables.
    pub name: &'static str,
    /// The problem.
    pub problem: TeamProblem,
    /// What becomes 0.
    pub ideal: Objectives,
    /// What becomes 1.
    pub nadir: Objectives,
}

impl Trial {
    /// Objectives scaled so that the ideal is 0 and the nadir 1.
    #[must_use]
    pub fn scaled(&self, cost: &Objectives) -> Objectives {
        std::array::from_fn(|k| (cost[k] - self.ideal[k]) / (self.nadir[k] - self.ideal[k]))
    }
}

fn world(shapes: impl IntoIterator<Item = Shape>) -> Result<World, PaperError> {
    let bounds = Rectangle::new(Point::origin(), Point::new(100.0, 100.0)).map_err(broken)?;
    Ok(World::with_shapes(bounds, shapes))
}

fn discs(places: &[(f64, f64)]) -> Result<World, PaperError> {
    let disc = |&(x, y): &(f64, f64)| Circle::new(Point::new(x, y), 5.0);
    let shapes: Result<Vec<_>, _> = places.iter().map(disc).collect();
    world(shapes.map_err(broken)?.into_iter().map(Shape::from))
}

fn broken(error: impl std::fmt::Display) -> PaperError {
    PaperError::Data(error.to_string())
}

fn robot(from: (f64, f64), to: (f64, f64)) -> Robot {
    Robot::new(Point::new(from.0, from.1), Point::new(to.0, to.1))
}

/// Experiment I with three discs, scaled by what the literature's implementations were measured with.
///
/// # Errors
/// [`PaperError`] never, but for a fault of its own.
pub fn three_discs() -> Result<Trial, PaperError> {
    let world = discs(&[(30.0, 40.0), (50.0, 50.0), (70.0, 60.0)])?;
    let robots = vec![robot((0.0, 0.0), (100.0, 100.0))];
    Ok(Trial {
        name: "three-discs",
        problem: TeamProblem::new(world, robots).map_err(broken)?,
        ideal: [141.42, 0.0, 0.0],
        nadir: [170.0, 10.0, TAU],
    })
}

/// Experiment I with a concave obstacle of our own, as the paper's is not published.
///
/// # Errors
/// [`PaperError`] never, but for a fault of its own.
pub fn concave() -> Result<Trial, PaperError> {
    let corners = [(30, 60), (60, 60), (60, 30), (70, 30), (70, 70), (30, 70)];
    let corners = corners.map(|(x, y): (i32, i32)| Point::new(x.into(), y.into()));
    let shape = Polygon::new(corners.to_vec()).map_err(broken)?;
    let robots = vec![robot((0.0, 0.0), (100.0, 100.0))];
    let problem = TeamProblem::new(world([shape.into()])?, robots).map_err(broken)?;
    scaled("concave", problem)
}

/// Experiment II.
///
/// # Errors
/// [`PaperError`] never, but for a fault of its own.
pub fn four_discs() -> Result<Trial, PaperError> {
    let world = discs(&[(35.0, 40.0), (30.0, 70.0), (65.0, 70.0), (70.0, 40.0)])?;
    let robots = vec![
        robot((10.0, 10.0), (90.0, 90.0)),
        robot((20.0, 40.0), (85.0, 55.0)),
        robot((15.0, 90.0), (80.0, 20.0)),
    ];
    let problem = TeamProblem::new(world, robots).map_err(broken)?;
    scaled("four-discs", problem)
}

/// Problems to compare on, made up before anything was tuned and never used for it.
///
/// # Errors
/// [`PaperError`] never, but for a fault of its own.
pub fn further() -> Result<Vec<Trial>, PaperError> {
    let (rectangles, mixed) = (Some(Obstacles::Rectangles), Some(Obstacles::Mixed));
    let recipes = [
        ("eight discs", 801, 1, 0.0, 8, None),
        ("ten rectangles", 802, 1, 1.0, 10, rectangles),
        ("twelve mixed", 803, 1, 1.0, 12, mixed),
        ("two robots", 804, 2, 1.0, 6, None),
        ("two robots, mixed", 805, 2, 1.0, 8, mixed),
        ("three robots", 806, 3, 1.0, 5, rectangles),
        ("four robots", 807, 4, 0.5, 4, None),
    ];
    let trials = recipes.map(|(name, seed, robots, radius, obstacles, kind)| {
        let recipe = TeamRecipe {
            robots,
            radius,
            obstacles,
            kind,
        };
        scaled(name, crossing(seed, &recipe))
    });
    trials.into_iter().collect()
}

/// Scaled by the sum of the exact shortest paths and a fifth more, the ease, and a full turn for
/// each robot.
fn scaled(name: &'static str, problem: TeamProblem) -> Result<Trial, PaperError> {
    let mut shortest = 0.0;
    for robot in problem.robots() {
        let alone = WorldProblem::new(
            problem.shared_world(),
            robot.radius,
            robot.start,
            robot.goal,
        );
        let report = VisibilityGraph::default()
            .plan(&alone.map_err(broken)?, &mut Context::seeded(0))
            .map_err(broken)?;
        let solved = report.outcome.solved().map(|solved| solved.cost);
        shortest += solved.ok_or_else(|| broken(format!("{name} has no path")))?;
    }
    #[expect(clippy::cast_precision_loss, reason = "a number of robots")]
    let turns = TAU * problem.robots().len() as f64;
    Ok(Trial {
        name,
        ideal: [shortest, 0.0, 0.0],
        nadir: [1.2 * shortest, problem.ease(), turns],
        problem,
    })
}
