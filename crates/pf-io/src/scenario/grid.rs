//! Queries on grids.

use super::{Event, Expected, Maps, Query, events};
use crate::{FileError, GridMap, LoadOptions, load_grid, toml_tree::Table};
use pf_core::Problem;
use pf_grid::{Grid, GridChange, GridCost, GridProblem, Moves};
use std::path::Path;

/// A query of a [`Scenario`](super::Scenario) on grids.
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

const CHANGES: [&str; 5] = ["start", "goal", "blocked", "freed", "cost"];

impl Query for Case {
    type Map = GridMap;
    const TOP_KEYS: &'static [&'static str] = &[
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
    const CASE_KEYS: &'static [&'static str] = &[
        "name", "follows", "map", "moves", "radius", "start", "goal", "blocked", "freed", "cost",
        "expected", "event",
    ];
    const FIXED_KEYS: &'static [&'static str] = &["map", "moves", "radius"];

    fn load(path: &Path, options: &LoadOptions) -> Result<GridMap, FileError> {
        load_grid(path, options)
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn fresh(
        top: &Table<'_>,
        table: &Table<'_>,
        name: String,
        maps: &mut Maps<'_, GridMap>,
    ) -> Result<Self, FileError> {
        let needed = |key, what| match table.get(key).or(top.get(key)) {
            Some(value) => Ok(value),
            None => table.needed(key, what),
        };
        let map = maps.get(needed("map", "a map's file name")?.string()?)?;
        let size = (map.grid.width(), map.grid.height());
        let start = needed("start", "a cell [x, y]")?.cell(size)?;
        let goal = needed("goal", "a cell [x, y]")?.cell(size)?;
        let names = Moves::ALL.map(|moves| (moves.name(), moves));
        let moves = match table.one_of("moves", &names)? {
            Some(moves) => moves,
            None => top.one_of("moves", &names)?.unwrap_or_default(),
        };
        let radius = match table.get("radius").or(top.get("radius")) {
            Some(value) => value.amount("the robot's radius in cells")?,
            None => 0.0,
        };
        let mut changes = changes(table, &map.grid)?;
        changes.retain(|c| !matches!(c, GridChange::StartMoved(_) | GridChange::GoalMoved(_)));
        let problem = GridProblem::new(map.grid.clone(), start, goal)
            .map_err(|error| table.error(error.to_string(), "a start and a goal in the map"))?;
        let problem = changed(table, problem.with_moves(moves), &changes)?;
        Ok(Self {
            name,
            radius,
            follows: None,
            expected: expected(table)?,
            events: grid_events(table, &map.grid)?,
            map,
            changes,
            problem,
        })
    }

    fn followed(&self, place: usize, table: &Table<'_>, name: String) -> Result<Self, FileError> {
        let changes = changes(table, &self.map.grid)?;
        let problem = changed(table, self.problem.clone(), &changes)?;
        Ok(Self {
            name,
            map: self.map.clone(),
            radius: self.radius,
            follows: Some(place),
            expected: expected(table)?,
            events: grid_events(table, &self.map.grid)?,
            changes,
            problem,
        })
    }
}

fn grid_events(table: &Table<'_>, grid: &Grid) -> Result<Vec<Event>, FileError> {
    events(table, &CHANGES, |table| changes(table, grid))
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
