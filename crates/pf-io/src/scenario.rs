//! Scenario files: queries on maps, and what happens to the maps in time.
#![doc = include_str!("scenario.md")]

use crate::{
    FileError, GridMap, LoadOptions, Unknown, load_grid, source,
    source::Source,
    toml_tree::{File, Table},
};
use pf_core::Problem;
use pf_grid::{Grid, GridChange, GridCost, GridProblem, Moves};
use std::path::Path;

/// A scenario file, checked against its maps.
#[derive(Clone, Debug)]
pub struct Scenario {
    /// What it shows.
    pub title: Option<String>,
    /// The publication it is taken from.
    pub source: Option<String>,
    /// How its maps and cases came to be.
    pub provenance: Option<String>,
    /// The unit of the events' times.
    pub time: TimeUnit,
    /// Its queries, at least one.
    pub cases: Vec<Case>,
}

/// What an event's time counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TimeUnit {
    /// Steps: at 3 the robot has made three moves.
    #[default]
    Steps,
    /// Seconds since the robot set out.
    Seconds,
}

/// A query of a [`Scenario`].
#[derive(Clone, Debug)]
pub struct Case {
    /// Its name, unique in the file.
    pub name: String,
    /// The map, as its file shows it.
    pub map: GridMap,
    /// The robot's radius in cells; `problem` is not inflated by it.
    pub radius: f64,
    /// The case, by its place in the list, whose world and query this one starts from.
    pub follows: Option<usize>,
    /// What this case changes in the map, or in the case it follows.
    pub changes: Vec<GridChange>,
    /// The question, changes included.
    pub problem: GridProblem,
    /// What a shortest path costs, if the file says so.
    pub expected: Option<Expected>,
    /// What happens later, by ascending time.
    pub events: Vec<Event>,
}

/// What a shortest path costs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expected {
    /// Exactly.
    pub cost: GridCost,
    /// As a publication prints it.
    pub printed: Option<String>,
}

/// What happens at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// When, in the scenario's [`TimeUnit`].
    pub at: f64,
    /// What people call it.
    pub name: Option<String>,
    /// What changes, one batch.
    pub changes: Vec<GridChange>,
}

const TOP_KEYS: [&str; 13] = [
    "title",
    "source",
    "provenance",
    "time",
    "unknown",
    "map",
    "moves",
    "radius",
    "start",
    "goal",
    "expected",
    "case",
    "event",
];
const CASE_KEYS: [&str; 12] = [
    "name", "follows", "map", "moves", "radius", "start", "goal", "blocked", "freed", "cost",
    "expected", "event",
];

/// Reads a scenario file and the maps it names.
///
/// # Errors
/// [`FileError`] about the scenario or one of its maps; a cell outside the map is an error, too.
pub fn read_scenario(path: &Path) -> Result<Scenario, FileError> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let name = path.display().to_string();
    parse_scenario(&name, &source::read(path)?, &mut |map, options| {
        load_grid(&folder.join(map), options)
    })
}

/// Reads the content of a scenario file; `load` gives the maps it names, `name` is for errors.
///
/// # Errors
/// As [`read_scenario`].
pub fn parse_scenario(
    name: &str,
    bytes: &[u8],
    load: &mut dyn FnMut(&str, &LoadOptions) -> Result<GridMap, FileError>,
) -> Result<Scenario, FileError> {
    let source = Source { name, bytes };
    let file = File {
        source,
        text: source.text()?,
    };
    let root = file.parse()?;
    let top = Table::root(file, &root).with_keys(&TOP_KEYS)?;
    let own = |key| Ok(top.string(key)?.map(str::to_owned));
    let mut scenario = Scenario {
        title: own("title")?,
        source: own("source")?,
        provenance: own("provenance")?,
        time: one_of(
            &top,
            "time",
            &[("steps", TimeUnit::Steps), ("seconds", TimeUnit::Seconds)],
        )?
        .unwrap_or_default(),
        cases: Vec::new(),
    };
    let sort = [("blocked", Unknown::Blocked), ("free", Unknown::Free)];
    let options = LoadOptions {
        unknown: one_of(&top, "unknown", &sort)?.unwrap_or_default(),
    };
    let mut maps = Maps {
        load,
        options,
        loaded: Vec::new(),
    };
    let cases = top.tables("case")?;
    if cases.is_empty() {
        let stem = Path::new(name).file_stem().unwrap_or_default();
        let case_name = stem.to_string_lossy().into_owned();
        let case = fresh(&top, top, case_name, &mut maps)?;
        scenario.cases.push(case);
    }
    if let (Some(odd), false) = (top.get("event").or(top.get("expected")), cases.is_empty()) {
        return Err(odd.error("events and lengths inside a [[case]], where there are cases"));
    }
    for table in cases {
        let table = table.with_keys(&CASE_KEYS)?;
        let case = case(&top, table, &scenario.cases, &mut maps)?;
        scenario.cases.push(case);
    }
    Ok(scenario)
}

/// The maps of a file, each loaded once.
struct Maps<'l> {
    load: &'l mut dyn FnMut(&str, &LoadOptions) -> Result<GridMap, FileError>,
    options: LoadOptions,
    loaded: Vec<(String, GridMap)>,
}

impl Maps<'_> {
    fn get(&mut self, name: &str) -> Result<GridMap, FileError> {
        if let Some((_, map)) = self.loaded.iter().find(|(known, _)| known == name) {
            return Ok(map.clone());
        }
        let map = (self.load)(name, &self.options)?;
        self.loaded.push((name.to_owned(), map.clone()));
        Ok(map)
    }
}

/// A case of a list.
fn case(
    top: &Table<'_>,
    table: Table<'_>,
    before: &[Case],
    maps: &mut Maps<'_>,
) -> Result<Case, FileError> {
    let value = table.needed("name", "what the case is called")?;
    let name = value.string()?;
    if before.iter().any(|case| case.name == name) {
        return Err(value.error("a name that no other case has"));
    }
    let Some(value) = table.get("follows") else {
        return fresh(top, table, name.to_owned(), maps);
    };
    let followed = value.string()?;
    let follows = before.iter().position(|case| case.name == followed);
    let follows = follows.ok_or_else(|| value.error("the name of an earlier case"))?;
    for key in ["map", "moves", "radius"] {
        if let Some(odd) = table.get(key) {
            let expected =
                format!("no \"{key}\" in a case that follows another: it has that one's");
            return Err(odd.error(expected));
        }
    }
    let Case {
        map,
        radius,
        problem,
        ..
    } = &before[follows];
    let changes = changes(&table, &map.grid)?;
    let problem = changed(&table, problem.clone(), &changes)?;
    Ok(Case {
        name: name.to_owned(),
        map: map.clone(),
        radius: *radius,
        follows: Some(follows),
        expected: expected(&table)?,
        events: events(&table, &map.grid)?,
        changes,
        problem,
    })
}

/// A case that follows none; what it does not say, the top of the file says.
fn fresh(
    top: &Table<'_>,
    table: Table<'_>,
    name: String,
    maps: &mut Maps<'_>,
) -> Result<Case, FileError> {
    let needed = |key, what| match table.get(key).or(top.get(key)) {
        Some(value) => Ok(value),
        None => table.needed(key, what),
    };
    let map = maps.get(needed("map", "a map's file name")?.string()?)?;
    let size = (map.grid.width(), map.grid.height());
    let start = needed("start", "a cell [x, y]")?.cell(size)?;
    let goal = needed("goal", "a cell [x, y]")?.cell(size)?;
    let names = Moves::ALL.map(|moves| (moves.name(), moves));
    let moves = match one_of(&table, "moves", &names)? {
        Some(moves) => moves,
        None => one_of(top, "moves", &names)?.unwrap_or_default(),
    };
    let radius = match table.get("radius").or(top.get("radius")) {
        Some(value) => value.amount("the robot's radius in cells")?,
        None => 0.0,
    };
    let mut changes = changes(&table, &map.grid)?;
    changes.retain(|c| !matches!(c, GridChange::StartMoved(_) | GridChange::GoalMoved(_)));
    let problem = GridProblem::new(map.grid.clone(), start, goal)
        .map_err(|error| table.error(error.to_string(), "a start and a goal in the map"))?;
    let problem = changed(&table, problem.with_moves(moves), &changes)?;
    Ok(Case {
        name,
        radius,
        follows: None,
        expected: expected(&table)?,
        events: events(&table, &map.grid)?,
        map,
        changes,
        problem,
    })
}

fn changed(
    table: &Table<'_>,
    mut problem: GridProblem,
    changes: &[GridChange],
) -> Result<GridProblem, FileError> {
    let sense = |error: pf_core::InvalidProblem| table.error(error.to_string(), "sound changes");
    problem.apply(changes).map_err(sense)?;
    Ok(problem)
}

fn events(table: &Table<'_>, grid: &Grid) -> Result<Vec<Event>, FileError> {
    let mut events: Vec<Event> = Vec::new();
    for table in table.tables("event")? {
        let table =
            table.with_keys(&["at", "name", "start", "goal", "blocked", "freed", "cost"])?;
        let at = table.needed("at", "when it happens")?;
        let event = Event {
            at: at.amount("when it happens")?,
            name: table.string("name")?.map(str::to_owned),
            changes: changes(&table, grid)?,
        };
        if let Some(last) = events.last()
            && event.at < last.at
        {
            return Err(at.error(format!("{} or later: events are in their order", last.at)));
        }
        if event.changes.is_empty() {
            let expected = "one of start, goal, blocked, freed, cost";
            return Err(table.error("an event without a change", expected));
        }
        events.push(event);
    }
    Ok(events)
}

/// Start, goal, blocked, freed, cost: in this order.
fn changes(table: &Table<'_>, grid: &Grid) -> Result<Vec<GridChange>, FileError> {
    let size = (grid.width(), grid.height());
    let mut changes = Vec::new();
    if let Some(value) = table.get("start") {
        changes.push(GridChange::StartMoved(value.cell(size)?));
    }
    if let Some(value) = table.get("goal") {
        changes.push(GridChange::GoalMoved(value.cell(size)?));
    }
    if let Some(value) = table.get("blocked") {
        changes.push(GridChange::Blocked(value.cells(size)?));
    }
    if let Some(value) = table.get("freed") {
        changes.push(GridChange::Freed(value.cells(size)?));
    }
    for cost in table.tables("cost")? {
        let cost = cost.with_keys(&["value", "cells"])?;
        let value = cost.needed("value", "what the cells cost: 1 to 254")?;
        let number = u8::try_from(value.count("what the cells cost")?).unwrap_or(0);
        if !(1..=254).contains(&number) {
            return Err(value.error("what the cells cost: 1 to 254"));
        }
        let cells = cost
            .needed("cells", "the cells that cost so much")?
            .cells(size)?;
        changes.push(GridChange::CostChanged(cells, number));
    }
    Ok(changes)
}

fn expected(table: &Table<'_>) -> Result<Option<Expected>, FileError> {
    let tables = table.tables("expected")?;
    let Some(expected) = tables.first() else {
        return Ok(None);
    };
    let expected = expected.with_keys(&["straight", "diagonal", "printed"])?;
    let steps = |key| {
        let value = expected.needed(key, "so many steps of a shortest path")?;
        value.count("so many steps").map(u64::from)
    };
    Ok(Some(Expected {
        cost: GridCost::of_steps(steps("straight")?, steps("diagonal")?),
        printed: expected.string("printed")?.map(str::to_owned),
    }))
}

/// A word out of a list, if the key is there.
fn one_of<T: Copy>(
    table: &Table<'_>,
    key: &str,
    known: &[(&str, T)],
) -> Result<Option<T>, FileError> {
    let Some(value) = table.get(key) else {
        return Ok(None);
    };
    let word = value.string()?;
    if let Some((_, meaning)) = known.iter().find(|(name, _)| *name == word) {
        return Ok(Some(*meaning));
    }
    let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
    Err(value.error(format!("one of {}", names.join(", "))))
}
