//! A search, and its answer.

use crate::{animate::title, args::PlannerArgs, failure::Failure, question::Question, text, view};
use pf_abc::AbcParams;
use pf_core::{CancelToken, Params};
use pf_geom::Raster;
use pf_grid::Cell;
use pf_planners::{Answer, AnyEntry, Order, Refusal, Runner, Scene};
use pf_render::{Ending, Film, Picture, Recorder, Reel};

/// Who is shown, within what, and in how many frames.
pub(crate) struct Search<'a> {
    pub(crate) entry: &'a dyn AnyEntry,
    pub(crate) planner: &'a PlannerArgs,
    pub(crate) cancel: &'a CancelToken,
    pub(crate) frames: usize,
}

/// What was seen of one call of a planner.
pub(crate) struct Seen {
    pub(crate) reel: Reel,
    pub(crate) answer: Answer,
    pub(crate) recorder: Recorder,
}

/// Plans, and shows how.
pub(crate) fn search(
    search: &Search<'_>,
    question: &Question,
    runner: &mut dyn Runner,
) -> Result<(Film, Answer), Failure> {
    let scene = &question.scene;
    let ground = view::ground(scene);
    let plan = |runner: &mut dyn Runner, order: Order<'_>| runner.plan(scene, order);
    let Seen { reel, answer, .. } = search.reel(scene, ground, search.frames, runner, plan)?;
    let words = words(search.entry, scene, &answer);
    let title = title(runner.name(), question, &words, search.planner.seed);
    Ok((Film::new(title, vec![reel]), answer))
}

impl Search<'_> {
    /// One call of the planner in so many frames.
    pub(crate) fn reel(
        &self,
        scene: &Scene,
        ground: Picture,
        frames: usize,
        runner: &mut dyn Runner,
        act: impl FnOnce(&mut dyn Runner, Order<'_>) -> Result<Answer, Refusal>,
    ) -> Result<Seen, Failure> {
        let cells = self.cells(scene)?;
        let mut recorder = Recorder::filming(frames, cells.size());
        let answer = act(runner, self.planner.order(self.cancel, Some(&mut recorder)))?;
        let line = answer
            .lines
            .first()
            .map(|line| view::on_picture(scene, line));
        let ending = Ending {
            line,
            name: runner.name().to_owned(),
            words: words(self.entry, scene, &answer),
            radius: scene.robot().radius,
            iterates: self.entry.key() == "lbfgs",
            window: self.window()?,
        };
        let ground = match &cells {
            Cells::Raster(raster) => view::rasterised(ground, raster),
            Cells::None | Cells::Grid(_) => ground,
        };
        let [from, to] = view::end_points(scene);
        let reel = Reel::of(ground).ends(from, to);
        let reel = reel.search(&recorder, frames, |cell| cells.is_free(cell), &ending);
        Ok(Seen {
            reel,
            answer,
            recorder,
        })
    }

    /// What the planner calls cells.
    fn cells<'s>(&self, scene: &'s Scene) -> Result<Cells<'s>, Failure> {
        Ok(match (self.entry.problem(), scene) {
            ("grid", Scene::Grid(scene)) => Cells::Grid(scene.inflated()),
            ("grid", Scene::World(scene)) => {
                let reach = scene.robot().reach();
                Cells::Raster(Box::new(Raster::of(scene.world(), scene.cell(), reach)?))
            }
            _ => Cells::None,
        })
    }

    /// Half the side of what the bees see.
    fn window(&self) -> Result<Option<f64>, Failure> {
        if self.entry.key() != "abc" {
            return Ok(None);
        }
        let mut params = AbcParams::default();
        for (key, value) in &self.planner.settings {
            let set = params.set(key, value);
            set.map_err(|error| Failure::usage(format!("--set: {error}")))?;
        }
        Ok(Some(params.half))
    }
}

/// The cells in which a planner searches.
enum Cells<'a> {
    None,
    Grid(&'a pf_grid::Grid),
    Raster(Box<Raster>),
}

impl Cells<'_> {
    fn grid(&self) -> Option<&pf_grid::Grid> {
        match self {
            Self::None => None,
            Self::Grid(grid) => Some(grid),
            Self::Raster(raster) => Some(raster.grid()),
        }
    }

    fn size(&self) -> [u32; 2] {
        self.grid()
            .map_or([0, 0], |grid| [grid.width(), grid.height()])
    }

    fn is_free(&self, cell: Cell) -> bool {
        self.grid().is_some_and(|grid| grid.is_free(cell))
    }
}

/// A cost or a length, as exact as a picture is.
pub(crate) fn brief(x: f64) -> String {
    text::number((x * 100.0).round() / 100.0)
}

/// So many of something.
pub(crate) fn counted(n: usize, what: &str) -> String {
    let many = if n == 1 { "" } else { "s" };
    format!("{} {what}{many}", text::count(n as u64))
}

/// How it ended, in a few words.
pub(crate) fn words(entry: &dyn AnyEntry, scene: &Scene, answer: &Answer) -> String {
    let what = match scene {
        Scene::Grid(_) if entry.problem() == "grid" => "cost",
        _ => "length",
    };
    match answer.costs.first() {
        Some(&cost) => format!("{}, {what} {}", answer.outcome, brief(cost)),
        None => answer.outcome.to_owned(),
    }
}
