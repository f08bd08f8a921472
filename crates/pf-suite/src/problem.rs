//! The problems of a suite: from its tables and the files they name to what planners are asked.

mod said;

use crate::digest::Digest;
use pf_geom::{TeamProblem, Timing, World, WorldProblem};
use pf_grid::{Grid, GridProblem};
use pf_io::{
    AnyScenario, FileError, FileKind, GridMap, LoadOptions, Scen, Unknown, WorldFile, kind_of,
    load_grid, load_scenario, read_scen, read_world,
    toml_tree::{Table, Value},
};
use pf_planners::{Ruler, Scene};
use said::{Form, Said, nonsense};
pub(crate) use said::{KEYS, some};
use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

/// A question of a suite.
#[derive(Debug)]
pub struct SuiteProblem {
    /// Its name, unique in the suite.
    pub name: String,
    /// What is asked.
    pub ask: Ask,
    /// Shared by the problems on one map.
    pub(crate) ruler: Arc<Ruler>,
    /// Of all that makes it this problem.
    pub(crate) digest: u64,
}

/// What planners are asked.
#[derive(Debug)]
pub enum Ask {
    /// A path for one robot.
    Scene(Scene),
    /// A front of plans for several.
    Team(Box<TeamProblem>),
}

impl SuiteProblem {
    /// `grid`, `world` or `team`.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match &self.ask {
            Ask::Scene(scene) => scene.kind(),
            Ask::Team(_) => "team",
        }
    }
}

/// Reads problems; each map is read once.
pub(crate) struct Reader {
    /// Where the suite lies.
    folder: PathBuf,
    grids: Vec<(PathBuf, Unknown, Map<GridMap>)>,
    worlds: Vec<(PathBuf, Map<WorldFile>)>,
}

/// A map, its digest, and what measures lines on it.
#[derive(Clone)]
struct Map<T> {
    content: T,
    digest: u64,
    ruler: Arc<Ruler>,
}

impl Reader {
    pub(crate) fn new(suite: &Path) -> Self {
        Self {
            folder: suite.parent().unwrap_or(Path::new("")).to_owned(),
            grids: Vec::new(),
            worlds: Vec::new(),
        }
    }

    /// The problems of a `[[problem]]`.
    pub(crate) fn problems(&mut self, table: &Table<'_>) -> Result<Vec<SuiteProblem>, FileError> {
        let said = Said::read(table)?;
        if let Some(team) = table.get("team") {
            return self.team(&said, &team);
        }
        let file = table.needed("file", "a map, a world or a scenario; or \"team\"")?;
        let path = self.folder.join(file.string()?);
        let base = base_name(table, &path)?;
        // Whatever is wrong inside a file is said of that file; that it cannot be had, of the suite.
        let kind = kind_of(&path).map_err(|error| unreadable(&file, error))?;
        let mut problems = match kind {
            FileKind::Grid => self.on_grid(&said, &path, &base)?,
            FileKind::World => self.in_world(&said, &path, &base)?,
            FileKind::GridScenario | FileKind::WorldScenario => cases(&said, &path, &base)?,
        };
        if problems.is_empty() {
            return Err(file.error("a file that asks something: give \"from\" and \"to\""));
        }
        for problem in &mut problems {
            let map = problem.digest;
            problem.digest = digest(&problem.ask, map);
        }
        Ok(problems)
    }

    fn grid(&mut self, path: &Path, unknown: Unknown) -> Result<Map<GridMap>, FileError> {
        let known = |(file, sort, _): &&(PathBuf, Unknown, _)| file == path && *sort == unknown;
        if let Some((_, _, map)) = self.grids.iter().find(known) {
            return Ok(map.clone());
        }
        let options = LoadOptions {
            unknown,
            ..LoadOptions::default()
        };
        let content = load_grid(path, &options)?;
        let map = Map {
            digest: of_grid(&content.grid),
            ruler: Arc::default(),
            content,
        };
        self.grids.push((path.to_owned(), unknown, map.clone()));
        Ok(map)
    }

    fn world(&mut self, path: &Path) -> Result<Map<WorldFile>, FileError> {
        if let Some((_, map)) = self.worlds.iter().find(|(file, _)| file == path) {
            return Ok(map.clone());
        }
        let content = read_world(path)?;
        let map = Map {
            digest: of_world(&content.world),
            ruler: Arc::default(),
            content,
        };
        self.worlds.push((path.to_owned(), map.clone()));
        Ok(map)
    }

    /// The question of the table, or the rows of a `.scen` file.
    fn on_grid(
        &mut self,
        said: &Said<'_>,
        path: &Path,
        base: &str,
    ) -> Result<Vec<SuiteProblem>, FileError> {
        let table = said.table;
        let scen = table.get("scen");
        if scen.is_none() && table.get("rows").is_some() {
            return Err(table.key_error("rows", "\"scen\" beside it: the file whose rows they are"));
        }
        said.is(scen.map_or(&Form::GRID, |_| &Form::ROWS))?;
        let map = self.grid(path, said.unknown())?;
        // Only a ROS map says how it lies in the world, and only such a map has unknown cells.
        if map.content.frame.is_none() && table.get("unknown").is_some() {
            return Err(table.key_error("unknown", "none: only a ROS map has unknown cells"));
        }
        let grid = &map.content.grid;
        let size = (grid.width(), grid.height());
        let ask = |name: String, from, to| {
            let problem = GridProblem::new(Arc::clone(grid), from, to);
            let problem = problem.map_err(|error| nonsense(table, &error))?;
            let ask = said.grid(&problem, 0.0)?;
            Ok(SuiteProblem {
                name,
                ask: Ask::Scene(ask),
                ruler: Arc::clone(&map.ruler),
                digest: map.digest,
            })
        };
        let Some(scen) = scen else {
            let hint = format!("a cell [x, y] of {} x {}, or \"scen\"", size.0, size.1);
            let from = table.needed("from", &hint)?.cell(size)?;
            let to = table.needed("to", &hint)?.cell(size)?;
            return Ok(vec![ask(base.to_owned(), from, to)?]);
        };
        let rows = read_scen(&self.folder.join(scen.string()?));
        let rows = rows.map_err(|error| unreadable(&scen, error))?;
        rows.check_size(grid)?;
        let chosen = chosen_rows(table, &rows)?;
        chosen
            .into_iter()
            .map(|k| {
                let row = &rows.rows[k];
                ask(format!("{base}:{}", row.line), row.start, row.goal)
            })
            .collect()
    }

    /// A question per robot, or the one that the table asks.
    fn in_world(
        &mut self,
        said: &Said<'_>,
        path: &Path,
        base: &str,
    ) -> Result<Vec<SuiteProblem>, FileError> {
        let table = said.table;
        let map = self.world(path)?;
        let ask = |name: String, radius, from, to| {
            let world = Arc::clone(&map.content.world);
            let problem = WorldProblem::new(world, radius, from, to);
            let problem = problem.map_err(|error| nonsense(table, &error))?;
            Ok(SuiteProblem {
                name,
                ask: Ask::Scene(said.world(&problem)?),
                ruler: Arc::clone(&map.ruler),
                digest: map.digest,
            })
        };
        let robots = &map.content.robots;
        let ends = (table.get("from"), table.get("to"));
        if ends.0.is_some() || ends.1.is_some() {
            said.is(&Form::WORLD)?;
            let from = table.needed("from", "a point [x, y]")?.point("a start")?;
            let to = table.needed("to", "a point [x, y]")?.point("a goal")?;
            let radius = match &robots[..] {
                [only] => only.radius,
                _ => 0.0,
            };
            return Ok(vec![ask(base.to_owned(), radius, from, to)?]);
        }
        if robots.is_empty() {
            table.needed("from", "a point [x, y], as the world has no robots")?;
        }
        said.is(&Form::ROBOTS)?;
        let names = (1..).zip(robots).map(|(k, robot)| {
            let name = robot.name.clone();
            name.unwrap_or_else(|| format!("robot {k}"))
        });
        let names: Vec<String> = names.collect();
        let chosen = said.chosen(&names)?;
        chosen
            .into_iter()
            .map(|k| {
                let name = called(base, &names, k);
                ask(name, robots[k].radius, robots[k].start, robots[k].goal)
            })
            .collect()
    }

    /// All robots of a world at once.
    fn team(&mut self, said: &Said<'_>, file: &Value<'_>) -> Result<Vec<SuiteProblem>, FileError> {
        let table = said.table;
        said.is(&Form::TEAM)?;
        let path = self.folder.join(file.string()?);
        let map = self.world(&path).map_err(|error| unreadable(file, error))?;
        if map.content.robots.is_empty() {
            return Err(file.error("a world with [[robot]]s"));
        }
        let robots = map.content.robots.iter().map(|robot| pf_geom::Robot {
            start: robot.start,
            goal: robot.goal,
            radius: robot.radius,
            speed: robot.speed.unwrap_or(1.0),
        });
        let problem = TeamProblem::new(Arc::clone(&map.content.world), robots.collect());
        let mut problem = problem
            .map_err(|error| nonsense(table, &error))?
            .with_timing(Timing::Exact);
        if let Some(value) = table.get("ease") {
            let ease = value.size("from which clearance on nothing is dangerous")?;
            problem = problem
                .with_ease(ease)
                .map_err(|error| nonsense(table, &error))?;
        }
        let ask = Ask::Team(Box::new(problem));
        Ok(vec![SuiteProblem {
            name: base_name(table, &path)?,
            digest: digest(&ask, map.digest),
            ask,
            ruler: map.ruler,
        }])
    }
}

fn of_grid(grid: &Grid) -> u64 {
    let costs = grid.layout().cells().map(|cell| grid.cost(cell));
    let digest = Digest::default().number(grid.width().into());
    costs.fold(digest, Digest::byte).value()
}

fn of_world(world: &World) -> u64 {
    let digest = Digest::default().debug(world.bounds());
    let shapes = world.shapes();
    shapes
        .fold(digest, |digest, shape| digest.debug(&shape))
        .value()
}

/// Of a question on a map of this digest.
fn digest(ask: &Ask, map: u64) -> u64 {
    let digest = Digest::default().number(map);
    match ask {
        Ask::Scene(Scene::Grid(scene)) => digest
            .debug(&(scene.from(), scene.to(), scene.moves(), scene.robot()))
            .value(),
        Ask::Scene(Scene::World(scene)) => {
            let problem = scene.problem();
            digest
                .debug(&(problem.start(), problem.goal(), scene.robot(), scene.cell()))
                .debug(&scene.moves())
                .value()
        }
        Ask::Team(team) => digest.debug(&(team.robots(), team.ease())).value(),
    }
}

/// A question per case of a scenario; what happens later does not happen here.
fn cases(said: &Said<'_>, path: &Path, base: &str) -> Result<Vec<SuiteProblem>, FileError> {
    let ask = |names: &[String], k: usize, digest, scene| SuiteProblem {
        name: called(base, names, k),
        ask: Ask::Scene(scene),
        ruler: Arc::default(),
        digest,
    };
    match load_scenario(path)? {
        AnyScenario::Grid(scenario) => {
            said.is(&Form::GRID_CASES)?;
            let names: Vec<_> = scenario
                .cases
                .iter()
                .map(|case| case.name.clone())
                .collect();
            let one = |k: usize| {
                let case = &scenario.cases[k];
                let scene = said.grid(&case.problem, case.radius)?;
                Ok(ask(&names, k, of_grid(case.problem.grid()), scene))
            };
            said.chosen(&names)?.into_iter().map(one).collect()
        }
        AnyScenario::World(scenario) => {
            said.is(&Form::WORLD_CASES)?;
            let names: Vec<_> = scenario
                .cases
                .iter()
                .map(|case| case.name.clone())
                .collect();
            let one = |k: usize| {
                let problem = &scenario.cases[k].problem;
                let digest = of_world(problem.world());
                Ok(ask(&names, k, digest, said.world(problem)?))
            };
            said.chosen(&names)?.into_iter().map(one).collect()
        }
    }
}

/// The places of the rows that a table asks for: so many, evenly, or those of these lines.
fn chosen_rows(table: &Table<'_>, scen: &Scen) -> Result<Vec<usize>, FileError> {
    let all = scen.rows.len();
    let Some(value) = table.get("rows") else {
        return Ok((0..all).collect());
    };
    if !value.is_array() {
        let wanted = value.count("how many rows, or an array of lines")? as usize;
        if wanted == 0 || wanted > all {
            return Err(value.error(format!("how many rows: 1 to {all}")));
        }
        return Ok((0..wanted).map(|k| k * all / wanted).collect());
    }
    let lines = some(&value, "lines of the .scen file")?;
    lines
        .into_iter()
        .map(|value| {
            let line = value.count("a line of the .scen file")?;
            let found = scen.rows.iter().position(|row| row.line == line);
            found.ok_or_else(|| value.error("a line of the .scen file that holds a row"))
        })
        .collect()
}

/// The problem's name: of the file if that asks one thing, else with the case's.
fn called(base: &str, names: &[String], k: usize) -> String {
    match names {
        [_] => base.to_owned(),
        _ => format!("{base} {}", names[k]),
    }
}

fn base_name(table: &Table<'_>, path: &Path) -> Result<String, FileError> {
    let stem = || path.file_stem().unwrap_or_default().to_string_lossy();
    Ok(table.name()?.unwrap_or_else(|| stem().into_owned()))
}

/// A file that is not there is a mistake in the suite.
fn unreadable(value: &Value<'_>, error: FileError) -> FileError {
    match error.found_and_expected() {
        None => value.error(format!("a file that can be read; {error}")),
        Some(_) => error,
    }
}
