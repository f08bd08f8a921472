use crate::{Changes, Conversion, Found, FromScene, Line, Posed, Scene};
use pf_core::{
    Budget, Claims, Clock, Context, Cost, InvalidProblem, Note, Outcome, Problem, Replanner,
    Report, Solved, Stats, Stop, Text, Trace, Unsupported,
};
use pf_geom::Raster;
use pf_render::Recorder;
use std::time::Duration;

/// Within what a planner is to answer, and who listens.
#[derive(Debug)]
pub struct Order<'a> {
    /// The seed.
    pub seed: u64,
    /// The budget.
    pub budget: Budget,
    /// What keeps the search for a picture.
    pub recorder: Option<&'a mut Recorder>,
}

impl Order<'_> {
    /// Without limits, unheard.
    #[must_use]
    pub fn seeded(seed: u64) -> Self {
        Self {
            seed,
            budget: Budget::unlimited(),
            recorder: None,
        }
    }
}

/// What a planner answered, whatever its problem.
#[derive(Clone, Debug)]
pub struct Answer {
    /// `optimal`, `feasible`, `infeasible` or `unknown`.
    pub outcome: &'static str,
    /// Why it is the last word.
    pub stop: Stop,
    /// What it took.
    pub stats: Stats,
    /// What else there is to say.
    pub notes: Vec<Note>,
    /// The cost of the solution, a number per objective; empty without a solution.
    pub costs: Vec<f64>,
    /// The solution, a line per robot or alternative; empty without a solution.
    pub lines: Vec<Line>,
    /// From the call to the answer, a conversion or change of the planner's own map included.
    pub latency: Duration,
}

/// What went wrong before a planner could answer.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Refusal {
    /// The question makes no sense.
    #[error(transparent)]
    Invalid(#[from] InvalidProblem),
    /// The planner is not defined for it.
    #[error(transparent)]
    Unsupported(#[from] Unsupported),
    /// There is nothing yet to plan anew.
    #[error("a scene must be planned before it can be planned anew")]
    NothingPlanned,
}

/// A planner that hides which problem it solves.
pub trait Runner {
    /// The name the literature uses.
    fn name(&self) -> &str;

    /// What it promises.
    fn claims(&self) -> Claims;

    /// Answers a scene from scratch.
    ///
    /// # Errors
    /// [`Refusal`] if the scene makes no sense to the planner.
    fn plan(&mut self, scene: &Scene, order: Order<'_>) -> Result<Answer, Refusal>;

    /// Answers the scene it was given last after these changes, as
    /// [`Scene::change`] returned them; `scene` is as they left it.
    ///
    /// # Errors
    /// [`Refusal`] if nothing was planned before, or as [`plan`](Self::plan).
    fn replan(
        &mut self,
        scene: &Scene,
        changes: &Changes,
        order: Order<'_>,
    ) -> Result<Answer, Refusal>;

    /// The cells that the last scene was cut into, if it is a world and the planner wants a grid.
    fn raster(&self) -> Option<&Raster>;

    /// Does the upkeep that could wait until the answer was out; says how long it took.
    fn settle(&mut self, order: Order<'_>) -> Duration;
}

/// A planner on the problem `P`, and the problem as it knows it.
pub(crate) struct On<P: Problem> {
    planner: Box<dyn Replanner<P>>,
    posed: Option<Posed<P>>,
}

impl<P: FromScene> On<P> {
    pub(crate) fn new(planner: Box<dyn Replanner<P>>) -> Self {
        Self {
            planner,
            posed: None,
        }
    }
}

fn context<P: Problem>(order: Order<'_>) -> Context<'_, P>
where
    Recorder: Trace<P>,
{
    let cx = Context::seeded(order.seed).within(order.budget);
    match order.recorder {
        Some(recorder) => cx.traced(recorder),
        None => cx,
    }
}

/// What is wrong with a solution, whatever its planner says of it.
fn lie<P: Problem>(problem: &P, solved: &Solved<P>) -> Option<String> {
    match problem.judge(&solved.solution) {
        Err(violation) => Some(format!("the planner's answer: {violation}")),
        Ok(cost) if cost.same_as(&solved.cost) => None,
        Ok(cost) => Some(format!(
            "the planner says that its answer costs {:?}, the judge says {cost:?}",
            solved.cost
        )),
    }
}

/// What a report says of the scene.
fn answer<P: FromScene>(posed: &Posed<P>, scene: &Scene, report: Report<P>) -> Answer {
    let mut notes: Vec<Note> = Vec::new();
    let mut say = |key, text: String| {
        let text = Text::of(text);
        notes.push(Note { key, text });
    };
    if let Some(conversion) = &posed.conversion {
        say("converted", conversion.words(scene));
        match &report.outcome {
            Outcome::Infeasible => say("unproved", conversion.dead_end()),
            Outcome::Optimal(_) => {
                let text =
                    "the best of the converted map, not proved to be the best of the map itself";
                say("unproved", text.to_owned());
            }
            Outcome::Feasible(_) | Outcome::Unknown { .. } => {}
        }
    }
    let (mut outcome, mut found) = (report.outcome, None);
    if posed.conversion.is_some() {
        outcome = outcome.converted();
    }
    if let Some(solved) = outcome.solved() {
        match lie(&posed.problem, solved) {
            None => {
                found = P::read(posed, scene, solved);
                if found.is_none() {
                    let text = "the planner's path does not pass the judge of the map that was asked about";
                    say("refused", text.to_owned());
                }
            }
            Some(lie) => say("refused", lie),
        }
        if found.is_none() {
            outcome = Outcome::Unknown { attempt: None };
        }
    }
    notes.extend(report.notes.into_iter().map(|note| P::reword(posed, note)));
    let Found { costs, lines } = found.unwrap_or(Found {
        costs: Vec::new(),
        lines: Vec::new(),
    });
    Answer {
        outcome: outcome.word(),
        stop: report.stop,
        stats: report.stats,
        notes,
        costs,
        lines,
        latency: Duration::ZERO,
    }
}

impl Conversion {
    fn words(&self, scene: &Scene) -> String {
        match (self, scene) {
            (Self::Cells(raster), _) => {
                let (w, h) = (raster.grid().width(), raster.grid().height());
                format!(
                    "the world was cut into {w} x {h} cells of {}, free where the robot fits \
                     wherever in them it is",
                    raster.cell_size()
                )
            }
            (Self::Shapes(count), Scene::Grid(scene)) if !scene.map().is_uniform() => format!(
                "the grid became a world of {count} rectangles: straight ways in all directions in \
                 place of moves from cell to cell, and what cells cost is not heeded"
            ),
            (Self::Shapes(count), _) => format!(
                "the grid became a world of {count} rectangles: straight ways in all directions in \
                 place of moves from cell to cell"
            ),
        }
    }

    /// What it means that there is no way.
    fn dead_end(&self) -> String {
        match self {
            Self::Cells(_) => "there is no way over these cells; over smaller ones (--cell) there \
                               may be one, and a planner in worlds can tell"
                .to_owned(),
            Self::Shapes(_) => {
                "there is no way between the rectangles; a planner on grids can tell of the grid"
                    .to_owned()
            }
        }
    }
}

impl<P: FromScene> Runner for On<P>
where
    Recorder: Trace<P>,
{
    fn name(&self) -> &str {
        self.planner.name()
    }

    fn claims(&self) -> Claims {
        self.planner.claims()
    }

    fn plan(&mut self, scene: &Scene, order: Order<'_>) -> Result<Answer, Refusal> {
        let watch = Watch::start();
        let posed = P::pose(scene)?;
        let report = self.planner.plan(&posed.problem, &mut context(order))?;
        let mut answer = answer(&posed, scene, report);
        answer.latency = watch.elapsed();
        self.posed = Some(posed);
        Ok(answer)
    }

    fn replan(
        &mut self,
        scene: &Scene,
        changes: &Changes,
        order: Order<'_>,
    ) -> Result<Answer, Refusal> {
        let watch = Watch::start();
        let posed = self.posed.as_mut().ok_or(Refusal::NothingPlanned)?;
        let changes = P::follow(posed, scene, changes)?;
        let mut cx = context(order);
        let revision = posed.problem.revise(&changes)?;
        let report = self.planner.replan(&revision, &mut cx)?;
        let mut answer = answer(posed, scene, report);
        answer.latency = watch.elapsed();
        Ok(answer)
    }

    fn raster(&self) -> Option<&Raster> {
        match self.posed.as_ref()?.conversion.as_ref()? {
            Conversion::Cells(raster) => Some(raster),
            Conversion::Shapes(_) => None,
        }
    }

    fn settle(&mut self, order: Order<'_>) -> Duration {
        let Some(posed) = &self.posed else {
            return Duration::ZERO;
        };
        let mut cx = context(order);
        self.planner.settle(&posed.problem, &mut cx);
        cx.elapsed()
    }
}

/// How long it has been.
struct Watch {
    clock: Clock,
    began: Duration,
}

impl Watch {
    fn start() -> Self {
        let clock = Clock::default();
        let began = clock.now();
        Self { clock, began }
    }

    fn elapsed(&self) -> Duration {
        self.clock.now().saturating_sub(self.began)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::GridScene;
    use pf_core::{FromScratch, Planner};
    use pf_grid::{Cell, Grid, GridCost, GridProblem};

    /// Says of a path that it is the best and costs so many straight steps, whatever it is.
    struct Liar {
        path: Vec<Cell>,
        steps: u64,
    }

    impl Planner<GridProblem> for Liar {
        fn name(&self) -> &'static str {
            "liar"
        }

        fn claims(&self) -> Claims {
            Claims::NONE
        }

        fn plan(
            &mut self,
            _problem: &GridProblem,
            cx: &mut Context<'_, GridProblem>,
        ) -> Result<Report<GridProblem>, Unsupported> {
            Ok(cx.report(Outcome::Optimal(Solved {
                solution: self.path.clone(),
                cost: GridCost::of_steps(self.steps, 0),
            })))
        }
    }

    fn told(path: &[(u32, u32)], steps: u64) -> (&'static str, Vec<String>) {
        let grid = Grid::parse("... .#. ...").unwrap();
        let scene = GridScene::new(grid, Cell::new(0, 1), Cell::new(2, 1)).unwrap();
        let path = path.iter().map(|&(x, y)| Cell::new(x, y)).collect();
        let mut runner = On::new(Box::new(FromScratch(Liar { path, steps })));
        let answer = runner.plan(&scene.into(), Order::seeded(0)).unwrap();
        assert_eq!(answer.costs.is_empty(), answer.outcome == "unknown");
        let notes = answer.notes.iter().map(ToString::to_string);
        (answer.outcome, notes.collect())
    }

    #[test]
    fn a_lie_is_told_and_not_believed() {
        let around = [(0, 1), (0, 0), (1, 0), (2, 0), (2, 1)];
        assert_eq!(told(&around, 4), ("optimal", vec![]));
        let (outcome, notes) = told(&[(0, 1), (1, 1), (2, 1)], 2);
        assert_eq!(outcome, "unknown");
        assert_eq!(notes, ["refused: the planner's answer: move 0 collides"]);
        let (outcome, notes) = told(&around, 3);
        assert_eq!(outcome, "unknown");
        assert!(
            notes[0].starts_with("refused: the planner says"),
            "{notes:?}"
        );
    }
}
