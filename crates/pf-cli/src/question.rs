//! From a file and options to what a planner is asked.

use crate::{args::QuestionArgs, failure::Failure};
use pf_grid::{Cell, Grid, GridChange, GridProblem};
use pf_io::{Case, Event, Expected, LoadOptions, Scenario, load_grid, read_scenario};
use pf_planners::Scene;
use std::{path::Path, sync::Arc};

/// What a planner is asked, and where that comes from.
pub(crate) struct Question {
    /// The map's or the scenario's file.
    pub(crate) file: String,
    /// The case of a scenario, if it has several.
    pub(crate) case: Option<String>,
    pub(crate) scene: Scene,
    /// What a shortest path costs, if the file says so of exactly this question.
    pub(crate) expected: Option<Expected>,
    /// After which of the events, counted from 1; 0 for the first plan.
    pub(crate) expected_after: usize,
    /// What happens later.
    pub(crate) events: Vec<Event>,
}

impl Question {
    /// Just a scene.
    pub(crate) fn of(file: impl Into<String>, scene: Scene) -> Self {
        Self {
            file: file.into(),
            case: None,
            scene,
            expected: None,
            expected_after: 0,
            events: Vec::new(),
        }
    }
}

/// A map in any format, or a scenario that names one.
pub(crate) fn is_scenario(file: &Path) -> bool {
    file.extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("toml"))
}

/// The map alone, for questions that stand elsewhere.
pub(crate) fn map(file: &Path, args: &QuestionArgs) -> Result<Arc<Grid>, Failure> {
    let options = LoadOptions {
        unknown: args.unknown.unwrap_or_default(),
        ..LoadOptions::default()
    };
    Ok(load_grid(file, &options)?.grid)
}

/// The questions of a file, one for a map, one per case for a scenario.
pub(crate) fn read(file: &Path, args: &QuestionArgs) -> Result<Vec<Question>, Failure> {
    if is_scenario(file) {
        return cases(file, args, false);
    }
    if args.case.is_some() {
        let message = format!("--case: {} is a map, not a scenario", file.display());
        return Err(Failure::usage(message));
    }
    let grid = map(file, args)?;
    let (Some(from), Some(to)) = (args.from, args.to) else {
        return Err(missing(file, args, &grid));
    };
    let (from, to) = (inside("--from", from, &grid)?, inside("--to", to, &grid)?);
    let scene = scene(&GridProblem::new(grid, from, to)?, 0.0, args)?;
    Ok(vec![Question::of(file.display().to_string(), scene)])
}

fn missing(file: &Path, args: &QuestionArgs, grid: &Grid) -> Failure {
    let missing = match (args.from, args.to) {
        (None, None) => "--from and --to are",
        (None, _) => "--from is",
        _ => "--to is",
    };
    let (w, h) = (grid.width(), grid.height());
    let help = format!(
        "{} has {w} x {h} cells: --from 0,0 --to {},{} asks for a path from the upper left to the lower right",
        file.display(),
        w - 1,
        h - 1
    );
    Failure::usage(format!("where to plan? {missing} missing")).help(help)
}

/// The cases of a scenario; in time, each begins where the one it follows stood.
pub(crate) fn cases(
    file: &Path,
    args: &QuestionArgs,
    in_time: bool,
) -> Result<Vec<Question>, Failure> {
    if args.unknown.is_some() {
        let message = "--unknown: a scenario file says itself what unknown cells are";
        return Err(Failure::usage(message).help("write unknown = \"free\" into it"));
    }
    let scenario = read_scenario(file)?;
    let chosen = chosen(&scenario, args)?;
    let several = scenario.cases.len() > 1;
    let ask = |case: &Case| {
        let (mut problem, mut events) = (case.problem.clone(), case.events.clone());
        let mut expected_after = 0;
        if let (true, Some(before)) = (in_time, case.follows) {
            problem = scenario.cases[before].problem.clone();
            let change = Event {
                at: 0.0,
                name: Some(case.name.clone()),
                changes: case.changes.clone(),
            };
            events.insert(0, change);
            expected_after = 1;
        }
        let as_stated = args.from.is_none()
            && args.to.is_none()
            && args.radius.is_none()
            && args.moves.is_none();
        let question = Question {
            file: file.display().to_string(),
            case: several.then(|| case.name.clone()),
            scene: scene(&problem, case.radius, args)?,
            expected: case.expected.clone().filter(|_| as_stated),
            expected_after,
            events,
        };
        Ok(question)
    };
    chosen.into_iter().map(ask).collect()
}

fn chosen<'s>(scenario: &'s Scenario, args: &QuestionArgs) -> Result<Vec<&'s Case>, Failure> {
    let Some(name) = &args.case else {
        return Ok(scenario.cases.iter().collect());
    };
    let found = scenario.cases.iter().find(|case| case.name == *name);
    found.map(|case| vec![case]).ok_or_else(|| {
        let names: Vec<_> = scenario.cases.iter().map(|c| c.name.as_str()).collect();
        Failure::usage(format!("--case: there is no case `{name}`"))
            .help(format!("the cases are {}", names.join(", ")))
    })
}

/// The scene of a problem, with what the options say otherwise.
fn scene(problem: &GridProblem, radius: f64, args: &QuestionArgs) -> Result<Scene, Failure> {
    let grid = problem.shared_grid();
    let from = inside("--from", args.from.unwrap_or(problem.start()), &grid)?;
    let to = inside("--to", args.to.unwrap_or(problem.goal()), &grid)?;
    let moves = args.moves.unwrap_or(problem.moves());
    Ok(Scene::new(grid, from, to)?
        .with_moves(moves)
        .with_radius(args.radius.unwrap_or(radius))?)
}

fn inside(option: &str, cell: Cell, grid: &Grid) -> Result<Cell, Failure> {
    let (w, h) = (grid.width(), grid.height());
    if grid.layout().contains(cell) {
        return Ok(cell);
    }
    let message = format!("{option} {cell} lies outside the map, which has {w} x {h} cells");
    Err(Failure::usage(message).help(format!("cells go from 0,0 to {},{}", w - 1, h - 1)))
}

/// What a batch of changes does, in a few words.
pub(crate) fn words(changes: &[GridChange]) -> String {
    let count = |cells: &[Cell]| match cells {
        [one] => format!("{one}"),
        many => format!("{} cells", many.len()),
    };
    let words: Vec<_> = changes
        .iter()
        .map(|change| match change {
            GridChange::StartMoved(cell) => format!("start to {cell}"),
            GridChange::GoalMoved(cell) => format!("goal to {cell}"),
            GridChange::Blocked(cells) => format!("{} blocked", count(cells)),
            GridChange::Freed(cells) => format!("{} freed", count(cells)),
            GridChange::CostChanged(cells, cost) => format!("{} cost {cost}", count(cells)),
        })
        .collect();
    words.join(", ")
}
