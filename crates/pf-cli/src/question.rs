//! From a file and options to what a planner is asked.

use crate::{args::QuestionArgs, failure::Failure, spot::Spot};
use pf_geom::{World, WorldProblem};
use pf_grid::{Grid, GridProblem};
use pf_io::{
    AnyScenario, FileKind, LoadOptions, Names, WorldFile, kind_of, load_grid, load_scenario,
    read_world,
};
use pf_planners::{Changes, GridScene, Robot, Scene, WorldScene};
use std::{path::Path, sync::Arc};

/// What a planner is asked, and where that comes from.
pub(crate) struct Question {
    /// The map's or the scenario's file.
    pub(crate) file: String,
    /// The case of a scenario or the robot of a world, if there are several.
    pub(crate) case: Option<String>,
    pub(crate) scene: Scene,
    /// What shapes are called.
    pub(crate) names: Names,
    /// What a shortest path costs, if the file says so of exactly this question.
    pub(crate) stated: Option<Stated>,
    /// After which of the events, counted from 1; 0 for the first plan.
    pub(crate) stated_after: usize,
    /// What happens later.
    pub(crate) events: Vec<Happening>,
}

/// What a file says a shortest path costs.
#[derive(Clone, Debug)]
pub(crate) struct Stated {
    pub(crate) cost: f64,
    /// How far another cost may be from it and still be the same: 0 where costs are exact.
    pub(crate) tolerance: f64,
    /// As people read it.
    pub(crate) words: String,
}

/// An event of a scenario.
#[derive(Clone, Debug)]
pub(crate) struct Happening {
    pub(crate) at: f64,
    pub(crate) name: Option<String>,
    pub(crate) changes: Changes,
}

impl Question {
    /// Just a scene.
    pub(crate) fn of(file: impl Into<String>, scene: impl Into<Scene>) -> Self {
        Self {
            file: file.into(),
            case: None,
            scene: scene.into(),
            names: Names::default(),
            stated: None,
            stated_after: 0,
            events: Vec::new(),
        }
    }
}

/// Whether it is about a world of shapes.
pub(crate) fn is_about_a_world(kind: FileKind) -> bool {
    matches!(kind, FileKind::World | FileKind::WorldScenario)
}

/// Whether it asks questions by itself.
pub(crate) fn is_scenario(kind: FileKind) -> bool {
    matches!(kind, FileKind::GridScenario | FileKind::WorldScenario)
}

/// The grid alone, for questions that stand elsewhere.
pub(crate) fn grid(file: &Path, args: &QuestionArgs) -> Result<Arc<Grid>, Failure> {
    if args.cell.is_some() {
        let message = format!("--cell: {} is a grid and has cells", file.display());
        return Err(Failure::usage(message));
    }
    let options = LoadOptions {
        unknown: args.unknown.unwrap_or_default(),
        ..LoadOptions::default()
    };
    Ok(load_grid(file, &options)?.grid)
}

/// The questions of a file: one for a grid, one per robot for a world, one per case for a
/// scenario.
pub(crate) fn read(file: &Path, args: &QuestionArgs) -> Result<Vec<Question>, Failure> {
    match kind_of(file)? {
        FileKind::Grid => on_grid(file, args).map(|question| vec![question]),
        FileKind::World => in_world(file, args),
        FileKind::GridScenario | FileKind::WorldScenario => cases(file, args, false),
    }
}

/// The only question of a file; a case that follows another begins where that one stood.
pub(crate) fn one(file: &Path, args: &QuestionArgs) -> Result<Question, Failure> {
    let mut questions = if is_scenario(kind_of(file)?) {
        cases(file, args, true)?
    } else {
        read(file, args)?
    };
    if questions.len() > 1 {
        let names: Vec<_> = questions.iter().filter_map(|q| q.case.as_deref()).collect();
        let help = format!("choose one with --case: {}", names.join(", "));
        let message = format!("{} asks several questions", file.display());
        return Err(Failure::usage(message).help(help));
    }
    let none = || Failure::usage(format!("{} asks nothing", file.display()));
    questions.pop().ok_or_else(none)
}

/// For verbs that need shapes.
pub(crate) fn no_world(file: &Path) -> Failure {
    let message = format!("{} is a grid, not a world of shapes", file.display());
    Failure::usage(message).help("on grids there is `pf drive`")
}

fn on_grid(file: &Path, args: &QuestionArgs) -> Result<Question, Failure> {
    if args.case.is_some() {
        let message = format!("--case: {} is a map, not a scenario", file.display());
        return Err(Failure::usage(message));
    }
    let grid = grid(file, args)?;
    if args.from.is_none() || args.to.is_none() {
        let (w, h) = (grid.width(), grid.height());
        let help = format!(
            "{} has {w} x {h} cells: --from 0,0 --to {},{} asks for a path from the upper left to the lower right",
            file.display(),
            w - 1,
            h - 1
        );
        return Err(missing(args).help(help));
    }
    let anywhere = pf_grid::Cell::default();
    let problem = GridProblem::new(grid, anywhere, anywhere)?;
    Ok(Question::of(
        file.display().to_string(),
        Plain::Grid(problem, 0.0).scene(args)?,
    ))
}

fn missing(args: &QuestionArgs) -> Failure {
    let missing = match (args.from, args.to) {
        (None, None) => "--from and --to are",
        (None, _) => "--from is",
        _ => "--to is",
    };
    Failure::usage(format!("where to plan? {missing} missing"))
}

/// A question per robot, or the one that the options ask.
fn in_world(file: &Path, args: &QuestionArgs) -> Result<Vec<Question>, Failure> {
    let world = read_world(file)?;
    let robots: Vec<_> = (1..)
        .zip(&world.robots)
        .map(|(k, robot)| {
            let name = robot.name.clone().unwrap_or_else(|| format!("robot {k}"));
            (name, robot)
        })
        .collect();
    let names: Vec<_> = robots.iter().map(|(name, _)| name.as_str()).collect();
    let ask = |case: Option<&str>, robot: &pf_io::Robot| {
        let problem = WorldProblem::new(
            Arc::clone(&world.world),
            robot.radius,
            robot.start,
            robot.goal,
        )?;
        let scene = Plain::World(problem).scene(args)?;
        Ok(Question {
            case: case.map(str::to_owned),
            names: world.names.clone(),
            ..Question::of(file.display().to_string(), scene)
        })
    };
    if let Some(asked) = &args.case {
        let found = robots.iter().find(|(name, _)| name == asked);
        let (name, robot) = found.ok_or_else(|| {
            let failure = Failure::usage(format!("--case: there is no robot `{asked}`"));
            match &names[..] {
                [] => failure.help(format!("{} has no robots", file.display())),
                names => failure.help(format!("the robots are {}", names.join(", "))),
            }
        })?;
        return Ok(vec![ask(Some(name), robot)?]);
    }
    if let (Some(from), Some(to)) = (args.from, args.to) {
        let bounds = world.world.bounds();
        // Whoever has no robot of its own is the only one there is.
        let radius = match &world.robots[..] {
            [only] => only.radius,
            _ => 0.0,
        };
        let robot = pf_io::Robot {
            name: None,
            radius,
            start: from.point("--from", bounds)?,
            goal: to.point("--to", bounds)?,
            speed: None,
        };
        return Ok(vec![ask(None, &robot)?]);
    }
    match &robots[..] {
        [] => Err(missing(args).help(size(file, &world))),
        [(_, only)] => Ok(vec![ask(None, only)?]),
        several => several
            .iter()
            .map(|(name, robot)| ask(Some(name), robot))
            .collect(),
    }
}

fn size(file: &Path, world: &WorldFile) -> String {
    let bounds = world.world.bounds();
    let [min, max] = [bounds.min(), bounds.max()].map(Spot::from);
    format!(
        "{} goes from {min} to {max} and has no robots that say it: --from {min} --to {max} asks for a path from the lower left to the upper right",
        file.display()
    )
}

/// What a file asks, before the options have their say.
enum Plain {
    /// A problem and a robot's radius.
    Grid(GridProblem, f64),
    World(WorldProblem),
}

impl Plain {
    /// The scene, with what the options say otherwise.
    fn scene(&self, args: &QuestionArgs) -> Result<Scene, Failure> {
        let robot = |radius| Robot {
            radius: args.radius.unwrap_or(radius),
            clearance: args.clearance.unwrap_or(0.0),
        };
        match self {
            Self::Grid(problem, radius) => {
                if args.cell.is_some() {
                    return Err(Failure::usage("--cell: a grid has cells"));
                }
                let grid = problem.shared_grid();
                let spot = |said: Option<Spot>, or| said.unwrap_or_else(|| Spot::from(or));
                let from = spot(args.from, problem.start()).cell("--from", &grid)?;
                let to = spot(args.to, problem.goal()).cell("--to", &grid)?;
                let scene = GridScene::new(grid, from, to)?
                    .with_moves(args.moves.unwrap_or(problem.moves()))
                    .with_robot(robot(*radius))?;
                Ok(scene.into())
            }
            Self::World(problem) => {
                if args.unknown.is_some() {
                    return Err(Failure::usage("--unknown: a world has no unknown cells"));
                }
                let world: Arc<World> = problem.shared_world();
                let spot = |said: Option<Spot>, or| said.unwrap_or_else(|| Spot::from(or));
                let from = spot(args.from, problem.start()).point("--from", world.bounds())?;
                let to = spot(args.to, problem.goal()).point("--to", world.bounds())?;
                let mut scene = WorldScene::new(world, robot(problem.radius()), from, to)?;
                if let Some(cell) = args.cell {
                    scene = scene.with_cell(cell)?;
                }
                if let Some(moves) = args.moves {
                    scene = scene.with_moves(moves);
                }
                Ok(scene.into())
            }
        }
    }
}

/// A case of a scenario of either sort.
struct Case {
    name: String,
    plain: Plain,
    names: Names,
    follows: Option<usize>,
    changes: Changes,
    stated: Option<Stated>,
    events: Vec<Happening>,
}

impl From<pf_io::Case> for Case {
    fn from(case: pf_io::Case) -> Self {
        let happening = |event: pf_io::Event| Happening {
            at: event.at,
            name: event.name,
            changes: Changes::Grid(event.changes),
        };
        Self {
            name: case.name,
            plain: Plain::Grid(case.problem, case.radius),
            names: Names::default(),
            follows: case.follows,
            changes: Changes::Grid(case.changes),
            // Both are the exact cost, shown as f64 in the same way.
            stated: case.expected.map(|expected| Stated {
                cost: expected.cost.value(),
                tolerance: 0.0,
                words: expected.cost.to_string(),
            }),
            events: case.events.into_iter().map(happening).collect(),
        }
    }
}

impl From<pf_io::WorldCase> for Case {
    fn from(case: pf_io::WorldCase) -> Self {
        let happening = |event: pf_io::Event<_>| Happening {
            at: event.at,
            name: event.name,
            changes: Changes::World(event.changes),
        };
        Self {
            name: case.name,
            plain: Plain::World(case.problem),
            names: case.names,
            follows: case.follows,
            changes: Changes::World(case.changes),
            stated: case.expected.map(|expected| Stated::length(expected.cost)),
            events: case.events.into_iter().map(happening).collect(),
        }
    }
}

impl Stated {
    /// To the digits given, and as planners cut arcs.
    fn length(cost: f64) -> Self {
        const ARCS: f64 = 1e-4;
        let words = cost.to_string();
        let decimals = words.split_once('.').map_or(0, |(_, digits)| digits.len());
        let last = i32::try_from(decimals).map_or(0.0, |decimals| 0.1f64.powi(decimals));
        Self {
            cost,
            tolerance: last / 2.0 + ARCS,
            words,
        }
    }
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
    played(
        &file.display().to_string(),
        load_scenario(file)?,
        args,
        in_time,
    )
}

/// The cases of a scenario that was read, under its file's name.
pub(crate) fn played(
    file: &str,
    scenario: AnyScenario,
    args: &QuestionArgs,
    in_time: bool,
) -> Result<Vec<Question>, Failure> {
    let cases: Vec<Case> = match scenario {
        AnyScenario::Grid(scenario) => scenario.cases.into_iter().map(Case::from).collect(),
        AnyScenario::World(scenario) => scenario.cases.into_iter().map(Case::from).collect(),
    };
    let as_stated = args.from.is_none()
        && args.to.is_none()
        && args.radius.is_none()
        && args.clearance.is_none()
        && args.moves.is_none();
    let ask = |case: &Case| {
        let (mut plain, mut events) = (&case.plain, case.events.clone());
        let mut stated_after = 0;
        if let (true, Some(before)) = (in_time, case.follows) {
            plain = &cases[before].plain;
            let change = Happening {
                at: 0.0,
                name: Some(case.name.clone()),
                changes: case.changes.clone(),
            };
            events.insert(0, change);
            stated_after = 1;
        }
        Ok(Question {
            file: file.to_owned(),
            case: (cases.len() > 1).then(|| case.name.clone()),
            scene: plain.scene(args)?,
            names: case.names.clone(),
            stated: case.stated.clone().filter(|_| as_stated),
            stated_after,
            events,
        })
    };
    chosen(&cases, args)?.into_iter().map(ask).collect()
}

fn chosen<'s>(cases: &'s [Case], args: &QuestionArgs) -> Result<Vec<&'s Case>, Failure> {
    let Some(name) = &args.case else {
        return Ok(cases.iter().collect());
    };
    let found = cases.iter().find(|case| case.name == *name);
    found.map(|case| vec![case]).ok_or_else(|| {
        let names: Vec<_> = cases.iter().map(|c| c.name.as_str()).collect();
        Failure::usage(format!("--case: there is no case `{name}`"))
            .help(format!("the cases are {}", names.join(", ")))
    })
}
