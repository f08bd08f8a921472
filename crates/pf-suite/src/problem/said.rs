//! What a `[[problem]]` says besides the file, and the scenes it makes of it.

use pf_core::InvalidProblem;
use pf_geom::WorldProblem;
use pf_grid::{GridProblem, Moves};
use pf_io::{
    FileError, Unknown,
    toml_tree::{Table, Value, nearest},
};
use pf_planners::{GridScene, Robot, Scene, WorldScene};

/// All keys of a `[[problem]]`.
pub(crate) const KEYS: [&str; 14] = [
    "name",
    "file",
    "team",
    "scen",
    "rows",
    "case",
    "from",
    "to",
    "radius",
    "clearance",
    "cell",
    "moves",
    "unknown",
    "ease",
];

/// What a `[[problem]]` may ask, and the keys that have a meaning there besides its name.
pub(super) struct Form {
    what: &'static str,
    keys: &'static [&'static str],
}

impl Form {
    pub(super) const TEAM: Self = Self {
        what: "a team",
        keys: &["team", "ease"],
    };
    pub(super) const GRID: Self = Self {
        what: "a path on a grid",
        keys: &[
            "file",
            "from",
            "to",
            "radius",
            "clearance",
            "moves",
            "unknown",
        ],
    };
    pub(super) const ROWS: Self = Self {
        what: "rows of a .scen file",
        keys: &[
            "file",
            "scen",
            "rows",
            "radius",
            "clearance",
            "moves",
            "unknown",
        ],
    };
    pub(super) const WORLD: Self = Self {
        what: "a path in a world",
        keys: &["file", "from", "to", "radius", "clearance", "cell", "moves"],
    };
    pub(super) const ROBOTS: Self = Self {
        what: "the robots of a world",
        keys: &["file", "case", "radius", "clearance", "cell", "moves"],
    };
    pub(super) const GRID_CASES: Self = Self {
        what: "a scenario on grids",
        keys: &["file", "case", "radius", "clearance", "moves"],
    };
    pub(super) const WORLD_CASES: Self = Self {
        what: "a scenario in worlds",
        keys: &["file", "case", "radius", "clearance", "cell", "moves"],
    };
}

/// What a table says besides the file.
pub(super) struct Said<'t> {
    pub(super) table: &'t Table<'t>,
    radius: Option<f64>,
    clearance: f64,
    cell: Option<f64>,
    moves: Option<Moves>,
    unknown: Option<Unknown>,
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
                let case = |value: Value<'t>| Ok((value.string()?.to_owned(), value));
                let names = some(&value, "names of cases")?.into_iter();
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

    /// What unknown cells of a grid count as.
    pub(super) fn unknown(&self) -> Unknown {
        self.unknown.unwrap_or_default()
    }

    fn robot(&self, radius: f64) -> Robot {
        Robot {
            radius: self.radius.unwrap_or(radius),
            clearance: self.clearance,
        }
    }

    /// Refuses a key that has no meaning in a table of this form.
    pub(super) fn is(&self, form: &Form) -> Result<(), FileError> {
        let keys = || ["name"].iter().chain(form.keys);
        let strange = |key: &&str| self.table.get(key).is_some() && !keys().any(|k| k == key);
        let Some(key) = KEYS.iter().find(|key| strange(key)) else {
            return Ok(());
        };
        let keys: Vec<&str> = keys().copied().collect();
        let expected = format!("for {} one of {}", form.what, keys.join(", "));
        Err(self.table.key_error(key, expected))
    }

    pub(super) fn grid(&self, problem: &GridProblem, radius: f64) -> Result<Scene, FileError> {
        let scene = GridScene::of(problem.clone())
            .with_moves(self.moves.unwrap_or(problem.moves()))
            .with_robot(self.robot(radius));
        Ok(scene.map_err(|error| nonsense(self.table, &error))?.into())
    }

    pub(super) fn world(&self, problem: &WorldProblem) -> Result<Scene, FileError> {
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

/// The members of an array that has some: none would read as all.
pub(crate) fn some<'v>(value: &Value<'v>, of: &str) -> Result<Vec<Value<'v>>, FileError> {
    let members: Vec<_> = value.array(of)?.collect();
    if members.is_empty() {
        return Err(value.error(format!("an array of {of}: one at least")));
    }
    Ok(members)
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
