//! What a `[[problem]]` says besides the file, and the scenes it makes of it.

use pf_core::InvalidProblem;
use pf_geom::WorldProblem;
use pf_grid::{GridProblem, Moves};
use pf_io::{
    FileError, Unknown,
    toml_tree::{Table, Value, nearest},
};
use pf_planners::{GridScene, Robot, Scene, WorldScene};

/// What a table says besides the file.
pub(super) struct Said<'t> {
    pub(super) table: &'t Table<'t>,
    radius: Option<f64>,
    clearance: f64,
    cell: Option<f64>,
    moves: Option<Moves>,
    pub(super) unknown: Option<Unknown>,
    /// The names of cases to take; all if empty.
    pub(super) cases: Vec<(String, Value<'t>)>,
}

impl<'t> Said<'t> {
    pub(super) fn read(table: &'t Table<'t>) -> Result<Self, FileError> {
        let size = |key, what: &str| table.get(key).map(|value| value.size(what)).transpose();
        let moves = Moves::ALL.map(|moves| (moves.name(), moves));
        let sorts = [("blocked", Unknown::Blocked), ("free", Unknown::Free)];
        let cases = match table.get("case") {
            None => Vec::new(),
            Some(value) if value.is_array() => {
                let names = value.array("names of cases")?;
                let case = |value: Value<'t>| Ok((value.string()?.to_owned(), value));
                names.map(case).collect::<Result<_, FileError>>()?
            }
            Some(value) => vec![(value.string()?.to_owned(), value)],
        };
        Ok(Self {
            table,
            radius: size("radius", "the robot's radius")?,
            clearance: size("clearance", "how far to stay away")?.unwrap_or(0.0),
            cell: size("cell", "the side of a cell")?,
            moves: table.one_of("moves", &moves)?,
            unknown: table.one_of("unknown", &sorts)?,
            cases,
        })
    }

    fn robot(&self, radius: f64) -> Robot {
        Robot {
            radius: self.radius.unwrap_or(radius),
            clearance: self.clearance,
        }
    }

    pub(super) fn refuse(&self, key: &str, why: &str) -> Result<(), FileError> {
        let value = self.table.get(key);
        value.map_or(Ok(()), |value| {
            Err(value.error(format!("no \"{key}\": {why}")))
        })
    }

    pub(super) fn grid(&self, problem: &GridProblem, radius: f64) -> Result<Scene, FileError> {
        self.refuse("cell", "a grid has cells")?;
        let scene = GridScene::of(problem.clone())
            .with_moves(self.moves.unwrap_or(problem.moves()))
            .with_robot(self.robot(radius));
        Ok(scene.map_err(|error| nonsense(self.table, &error))?.into())
    }

    pub(super) fn world(&self, problem: &WorldProblem) -> Result<Scene, FileError> {
        for key in ["scen", "rows", "unknown"] {
            self.refuse(key, "the file is a world of shapes")?;
        }
        let make = || {
            let robot = self.robot(problem.radius());
            let ends = (problem.start(), problem.goal());
            let mut scene = WorldScene::new(problem.shared_world(), robot, ends.0, ends.1)?;
            if let Some(cell) = self.cell {
                scene = scene.with_cell(cell)?;
            }
            if let Some(moves) = self.moves {
                scene = scene.with_moves(moves);
            }
            Ok(scene.into())
        };
        make().map_err(|error| nonsense(self.table, &error))
    }

    /// The places of the cases that are asked for among these.
    pub(super) fn chosen(&self, names: &[String]) -> Result<Vec<usize>, FileError> {
        if self.cases.is_empty() {
            return Ok((0..names.len()).collect());
        }
        let place = |(name, value): &(String, Value<'_>)| {
            let found = names.iter().position(|known| known == name);
            found.ok_or_else(|| {
                let known = names.iter().map(String::as_str);
                value.error(match nearest(name, known.clone()) {
                    Some(near) => format!("\"{near}\""),
                    None => format!("one of {}", few(known)),
                })
            })
        };
        self.cases.iter().map(place).collect()
    }
}

pub(super) fn nonsense(table: &Table<'_>, error: &InvalidProblem) -> FileError {
    table.error(error.to_string(), "a question that makes sense")
}

/// The first few names.
fn few<'n>(names: impl Iterator<Item = &'n str>) -> String {
    const MOST: usize = 8;
    let names: Vec<_> = names.collect();
    let shown = names[..names.len().min(MOST)].join(", ");
    match names.len().checked_sub(MOST) {
        Some(more @ 1..) => format!("{shown} and {more} more"),
        _ => shown,
    }
}
