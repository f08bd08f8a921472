//! Queries in worlds.

use super::{Event, Expected, Maps, Query, Scenario, events};
use crate::{
    FileError, LoadOptions, Map, Place, load_map,
    toml_tree::{Table, Value, nearest},
    world::{Names, Robot, WorldFile, any_shape, inside},
};
use pf_core::{InvalidProblem, Problem};
use pf_geom::{ShapeId, Vector, WorldChange, WorldProblem};
use std::path::Path;

/// A scenario in worlds.
pub type WorldScenario = Scenario<WorldCase>;

/// A query of a [`WorldScenario`].
#[derive(Clone, Debug)]
pub struct WorldCase {
    /// Its name, unique in the file.
    pub name: String,
    /// The world, as its file shows it.
    pub map: WorldFile,
    /// What shapes are called, those that changes and events add included.
    pub names: Names,
    /// The case, by its place in the list, whose world and query this one starts from.
    pub follows: Option<usize>,
    /// What this case changes in the world, or in the case it follows.
    pub changes: Vec<WorldChange>,
    /// The question, changes included.
    pub problem: WorldProblem,
    /// How long a shortest path is, if the file says so.
    pub expected: Option<Expected<f64>>,
    /// What happens later, by ascending time.
    pub events: Vec<Event<WorldChange>>,
}

const CHANGES: [&str; 5] = ["start", "goal", "remove", "move", "add"];

impl Query for WorldCase {
    type Map = WorldFile;
    const TOP_KEYS: &'static [&'static str] = &[
        "title",
        "source",
        "provenance",
        "time",
        "world",
        "robot",
        "radius",
        "start",
        "goal",
        "expected",
        "case",
        "event",
    ];
    const CASE_KEYS: &'static [&'static str] = &[
        "name", "follows", "world", "robot", "radius", "start", "goal", "remove", "move", "add",
        "expected", "event",
    ];
    const FIXED_KEYS: &'static [&'static str] = &["world", "robot", "radius"];

    fn load(path: &Path, options: &LoadOptions) -> Result<WorldFile, FileError> {
        match load_map(path, options)? {
            Map::World(world) => Ok(world),
            Map::Grid(_) => {
                let expected = "a world: in a scenario on a grid the key is \"map\"";
                let name = path.display().to_string();
                Err(FileError::new(&name, Place::Whole, "a grid", expected))
            }
        }
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn fresh(
        top: &Table<'_>,
        table: &Table<'_>,
        name: String,
        maps: &mut Maps<'_, WorldFile>,
    ) -> Result<Self, FileError> {
        let said = |key| table.get(key).or(top.get(key));
        let file = match said("world") {
            Some(value) => value,
            None => table.needed("world", "a world's file name")?,
        };
        let map = maps.get(file.string()?)?;
        let robot = robot(said("robot"), &map)?;
        let bounds = map.world.bounds();
        let end = |key, by_robot: Option<pf_geom::Point>| match (said(key), by_robot) {
            (Some(value), _) => inside(&value, key, bounds),
            (None, Some(point)) => Ok(point),
            (None, None) => {
                let missing = table.needed(key, "a point [x, y], or \"robot\" and its name")?;
                inside(&missing, key, bounds)
            }
        };
        let start = end("start", robot.map(|robot| robot.start))?;
        let goal = end("goal", robot.map(|robot| robot.goal))?;
        let radius = match said("radius") {
            Some(value) => value.size("the robot's radius")?,
            None => robot.map_or(0.0, |robot| robot.radius),
        };
        let problem = WorldProblem::new(map.world.clone(), radius, start, goal);
        let problem = problem.map_err(|error| nonsense(table, &error))?;
        let mut now = Now {
            problem,
            names: map.names.clone(),
        };
        now.names.resize(now.problem.world().next_id());
        now.case(table, map, name, None)
    }

    fn followed(&self, place: usize, table: &Table<'_>, name: String) -> Result<Self, FileError> {
        let mut now = Now {
            problem: self.problem.clone(),
            names: self.names.clone(),
        };
        // The events of the other case have not happened.
        now.names.resize(now.problem.world().next_id());
        now.case(table, self.map.clone(), name, Some(place))
    }
}

/// The robot of a name, else the only one there is.
fn robot<'m>(name: Option<Value<'_>>, map: &'m WorldFile) -> Result<Option<&'m Robot>, FileError> {
    let Some(value) = name else {
        return Ok(match &map.robots[..] {
            [only] => Some(only),
            _ => None,
        });
    };
    let name = value.string()?;
    let mut robots = map.robots.iter();
    if let Some(robot) = robots.find(|robot| robot.name.as_deref() == Some(name)) {
        return Ok(Some(robot));
    }
    let known = map.robots.iter().filter_map(|r| r.name.as_deref());
    let names: Vec<&str> = known.collect();
    Err(value.error(match &names[..] {
        [] => "no \"robot\": the world has none with a name".to_owned(),
        names => format!("the name of a robot: one of {}", names.join(", ")),
    }))
}

fn nonsense(table: &Table<'_>, error: &InvalidProblem) -> FileError {
    table.error(error.to_string(), "a question and changes that make sense")
}

/// A world as the changes read so far leave it.
#[derive(Clone)]
struct Now {
    problem: WorldProblem,
    names: Names,
}

impl Now {
    fn case(
        &mut self,
        table: &Table<'_>,
        map: WorldFile,
        name: String,
        follows: Option<usize>,
    ) -> Result<WorldCase, FileError> {
        let mut changes = self.changes(table)?;
        if follows.is_none() {
            changes.retain(|change| {
                !matches!(
                    change,
                    WorldChange::StartMoved(_) | WorldChange::GoalMoved(_)
                )
            });
        }
        let problem = self.problem.clone();
        Ok(WorldCase {
            name,
            map,
            follows,
            changes,
            problem,
            expected: expected(table)?,
            events: events(table, &CHANGES, |table| self.changes(table))?,
            names: self.names.clone(),
        })
    }

    /// Start, goal, remove, move, add: in this order, each where the ones before have left the
    /// world.
    fn changes(&mut self, table: &Table<'_>) -> Result<Vec<WorldChange>, FileError> {
        let mut changes = Vec::new();
        let bounds = *self.problem.world().bounds();
        if let Some(value) = table.get("start") {
            let start = inside(&value, "start", &bounds)?;
            self.apply(WorldChange::StartMoved(start), table, &mut changes)?;
        }
        if let Some(value) = table.get("goal") {
            let goal = inside(&value, "goal", &bounds)?;
            self.apply(WorldChange::GoalMoved(goal), table, &mut changes)?;
        }
        if let Some(value) = table.get("remove") {
            for value in value.array("shapes' names and ids")? {
                for id in self.shapes(&value)? {
                    self.apply(WorldChange::Removed(id), table, &mut changes)?;
                }
            }
        }
        for step in table.tables("move")? {
            let step = step.with_keys(&["shape", "by"])?;
            let ids = self.shapes(&step.needed("shape", "a shape's name or id")?)?;
            let by = step.needed("by", "how far: [dx, dy]")?.point("how far")?;
            let by = Vector::new(by.x, by.y);
            for id in ids {
                self.apply(WorldChange::Moved(id, by), &step, &mut changes)?;
            }
        }
        for new in table.tables("add")? {
            let (name, shape) = any_shape(&new, self.problem.world().next_id())?;
            self.names.push(name);
            self.apply(WorldChange::Added(shape), &new, &mut changes)?;
        }
        Ok(changes)
    }

    fn apply(
        &mut self,
        change: WorldChange,
        table: &Table<'_>,
        changes: &mut Vec<WorldChange>,
    ) -> Result<(), FileError> {
        let done = self.problem.apply(std::slice::from_ref(&change));
        done.map_err(|error| nonsense(table, &error))?;
        changes.push(change);
        Ok(())
    }

    /// The shapes of a name or an id, those that are there.
    fn shapes(&self, value: &Value<'_>) -> Result<Vec<ShapeId>, FileError> {
        let world = self.problem.world();
        let here = |id: &ShapeId| world.shape(*id).is_some();
        if let Some(id) = value.index() {
            if here(&id) {
                return Ok(vec![id]);
            }
            let last = world.shapes().map(|(id, _)| id).max();
            return Err(value.error(match last {
                Some(last) => format!("the id of a shape that is there (ids go from 0 to {last})"),
                None => "the name of a shape: there are none".to_owned(),
            }));
        }
        let name = value
            .string()
            .map_err(|_| value.error("a shape's name or its id, a whole number from 0"))?;
        let ids: Vec<ShapeId> = self.names.ids(name).filter(here).collect();
        if !ids.is_empty() {
            return Ok(ids);
        }
        let there = world.shapes().filter_map(|(id, _)| self.names.of(id));
        Err(value.error(match nearest(name, there) {
            Some(near) => format!("\"{near}\""),
            None => "the name of a shape that is there".to_owned(),
        }))
    }
}

fn expected(table: &Table<'_>) -> Result<Option<Expected<f64>>, FileError> {
    let tables = table.tables("expected")?;
    let Some(expected) = tables.first() else {
        return Ok(None);
    };
    let expected = expected.with_keys(&["length", "printed"])?;
    let length = expected.needed("length", "how long a shortest path is")?;
    Ok(Some(Expected {
        cost: length.size("how long a shortest path is")?,
        printed: expected.string("printed")?.map(str::to_owned),
    }))
}
