//! The colony as a planner: its walk from start to goal, and the walk that goes on.

use crate::{AbcParams, Colony};
use pf_core::{
    Claims, Context, InvalidParams, Outcome, Planner, Problem, Proof, Replanner, Report, Revision,
    Rollout, Stamp, Unsupported,
};
use pf_geom::{Point, Shape, WorldChange, WorldProblem};

/// A [`Colony`] that walks through a world to the goal; its way is the path. One iteration is one
/// step.
///
/// It proves nothing: a walk that does not arrive ends as unknown. A replan lets the walk go on
/// from where the robot is now. What it remembers is the way up to the place next to it; memory of
/// places where something changed fades when they are seen again; all is forgotten if the goal has
/// moved further than the window is wide.
#[derive(Clone, Debug)]
pub struct Abc {
    walker: Rollout<Colony>,
    last: Option<Last>,
}

/// What was answered last.
#[derive(Clone, Debug)]
struct Last {
    problem: WorldProblem,
    path: Vec<Point>,
    solved: bool,
}

impl Default for Abc {
    fn default() -> Self {
        Self::new(AbcParams::default()).expect("the default makes sense")
    }
}

impl Abc {
    /// A planner that walks as `params` say.
    ///
    /// # Errors
    /// [`InvalidParams`] with the name, the value and what would fit.
    pub fn new(params: AbcParams) -> Result<Self, InvalidParams> {
        Ok(Self {
            walker: Rollout(Colony::new(params)?),
            last: None,
        })
    }

    fn walk(
        &mut self,
        problem: &WorldProblem,
        cx: &mut Context<'_, WorldProblem>,
    ) -> Result<Report<WorldProblem>, Unsupported> {
        self.last = None;
        let report = self.walker.plan(problem, cx)?;
        let path = match &report.outcome {
            Outcome::Unknown { attempt } => attempt.as_ref(),
            other => other.solved().map(|best| &best.solution),
        };
        if !cx.stopped() {
            self.last = Some(Last {
                problem: problem.clone(),
                path: path.cloned().unwrap_or_default(),
                solved: report.outcome.solved().is_some(),
            });
        }
        Ok(report)
    }
}

impl Planner<WorldProblem> for Abc {
    fn name(&self) -> &str {
        self.walker.name()
    }

    fn claims(&self) -> Claims {
        self.walker.claims()
    }

    fn plan(
        &mut self,
        problem: &WorldProblem,
        cx: &mut Context<'_, WorldProblem>,
    ) -> Result<Report<WorldProblem>, Unsupported> {
        self.walker.0.forget();
        self.walk(problem, cx)
    }
}

impl Replanner<WorldProblem> for Abc {
    fn replan(
        &mut self,
        revision: &Revision<'_, WorldProblem>,
        cx: &mut Context<'_, WorldProblem>,
    ) -> Result<Report<WorldProblem>, Unsupported> {
        let problem = revision.problem();
        let known: Option<Stamp> = self.last.as_ref().map(|last| last.problem.stamp());
        let (Some(changes), Some(last)) = (revision.since(known), self.last.take()) else {
            return self.plan(problem, cx);
        };
        if changes.is_empty() && last.solved {
            if !cx.proceed() {
                return Ok(cx.report(Outcome::Unknown { attempt: None }));
            }
            cx.note("replanned", "kept");
            let path = last.path.clone();
            self.last = Some(last);
            return Ok(cx.answer(problem, path, Proof::None));
        }
        let colony = &mut self.walker.0;
        let far = 2.0 * colony.params().half;
        if (problem.goal() - last.problem.goal()).norm() > far {
            colony.forget();
            cx.note("replanned", "afresh");
        } else {
            let walked = walked(&last.path, problem.start());
            colony.recall(walked, &boxes(changes, &last.problem, problem));
            cx.note("replanned", format_args!("after {} steps", walked.len()));
        }
        self.walk(problem, cx)
    }
}

/// The way up to the place next to where the robot is now, without that.
fn walked(path: &[Point], now: Point) -> &[Point] {
    let apart = |p: &Point| (p - now).norm();
    let places = path.iter().map(apart).enumerate();
    let nearest = places.min_by(|a, b| a.1.total_cmp(&b.1));
    &path[..nearest.map_or(0, |(at, _)| at)]
}

/// Where obstacles were and are that changed.
fn boxes(
    changes: &[WorldChange],
    before: &WorldProblem,
    now: &WorldProblem,
) -> Vec<(Point, Point)> {
    let mut boxes = Vec::new();
    for change in changes {
        match change {
            WorldChange::Added(shape) => boxes.push(shape.bounding_box()),
            WorldChange::Removed(id) | WorldChange::Moved(id, _) => {
                let shapes = [before, now].map(|problem| problem.world().shape(*id));
                boxes.extend(shapes.into_iter().flatten().map(Shape::bounding_box));
            }
            WorldChange::StartMoved(_) | WorldChange::GoalMoved(_) => {}
        }
    }
    boxes
}
