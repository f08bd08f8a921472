//! Scenario files: queries on maps or in worlds, and what happens to these in time.
#![doc = include_str!("scenario.md")]

mod grid;
mod world;

pub use grid::Case;
pub use world::{WorldCase, WorldScenario};

use crate::{
    FileError, LoadOptions, Unknown, source,
    source::Source,
    toml_tree::{File, Table},
};
use pf_grid::{GridChange, GridCost};
use std::path::Path;

/// A scenario file, checked against its maps.
#[derive(Clone, Debug)]
pub struct Scenario<C = Case> {
    /// What it shows.
    pub title: Option<String>,
    /// The publication it is taken from.
    pub source: Option<String>,
    /// How its maps and cases came to be.
    pub provenance: Option<String>,
    /// The unit of the events' times.
    pub time: TimeUnit,
    /// Its queries, at least one.
    pub cases: Vec<C>,
}

/// A scenario of either sort.
#[derive(Clone, Debug)]
pub enum AnyScenario {
    /// On grids.
    Grid(Scenario),
    /// In worlds.
    World(WorldScenario),
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

/// What a shortest path costs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expected<C = GridCost> {
    /// Exactly; in a world, to the digits given.
    pub cost: C,
    /// As a publication prints it.
    pub printed: Option<String>,
}

/// What happens at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct Event<C = GridChange> {
    /// When, in the scenario's [`TimeUnit`].
    pub at: f64,
    /// What people call it.
    pub name: Option<String>,
    /// What changes, one batch.
    pub changes: Vec<C>,
}

/// Reads a scenario file on grids and the maps it names.
///
/// # Errors
/// [`FileError`] about the scenario or one of its maps; a cell outside the map is an error, too.
pub fn read_scenario(path: &Path) -> Result<Scenario, FileError> {
    from_file(path, &source::read(path)?)
}

/// Reads a scenario file in worlds and the worlds it names.
///
/// # Errors
/// [`FileError`] about the scenario or one of its worlds; a point out of bounds is an error, too,
/// and so is a shape that is not there (any more) when something happens to it.
pub fn read_world_scenario(path: &Path) -> Result<WorldScenario, FileError> {
    from_file(path, &source::read(path)?)
}

/// Reads the content of a scenario file on grids; `load` gives the maps it names, `name` is for
/// errors.
///
/// # Errors
/// As [`read_scenario`].
pub fn parse_scenario(
    name: &str,
    bytes: &[u8],
    load: &mut dyn FnMut(&str, &LoadOptions) -> Result<crate::GridMap, FileError>,
) -> Result<Scenario, FileError> {
    parse(name, bytes, load)
}

/// Reads the content of a scenario file in worlds; `load` gives the worlds it names, `name` is for
/// errors.
///
/// # Errors
/// As [`read_world_scenario`].
pub fn parse_world_scenario(
    name: &str,
    bytes: &[u8],
    load: &mut dyn FnMut(&str, &LoadOptions) -> Result<crate::WorldFile, FileError>,
) -> Result<WorldScenario, FileError> {
    parse(name, bytes, load)
}

/// Reads a scenario of this content; the maps it names lie beside `path`.
pub(crate) fn from_file<C: Query>(path: &Path, bytes: &[u8]) -> Result<Scenario<C>, FileError> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let name = path.display().to_string();
    parse(&name, bytes, &mut |map, options| {
        C::load(&folder.join(map), options)
    })
}

/// What queries on grids and in worlds have of their own.
pub(crate) trait Query: Sized {
    type Map: Clone;
    const TOP_KEYS: &'static [&'static str];
    const CASE_KEYS: &'static [&'static str];
    /// The keys that a case which follows another has from that one.
    const FIXED_KEYS: &'static [&'static str];

    fn load(path: &Path, options: &LoadOptions) -> Result<Self::Map, FileError>;

    fn name(&self) -> &str;

    /// A query that follows none; what `table` does not say, `top` says.
    fn fresh(
        top: &Table<'_>,
        table: &Table<'_>,
        name: String,
        maps: &mut Maps<'_, Self::Map>,
    ) -> Result<Self, FileError>;

    /// A query that starts from what this one, which stands at `place`, asks.
    fn followed(&self, place: usize, table: &Table<'_>, name: String) -> Result<Self, FileError>;
}

/// Gives the map that a scenario names.
type Load<'l, M> = dyn FnMut(&str, &LoadOptions) -> Result<M, FileError> + 'l;

fn parse<C: Query>(
    name: &str,
    bytes: &[u8],
    load: &mut Load<'_, C::Map>,
) -> Result<Scenario<C>, FileError> {
    let source = Source { name, bytes };
    let file = File {
        source,
        text: source.text()?,
    };
    let root = file.parse("a scenario file")?;
    let top = Table::root(file, &root).with_keys(C::TOP_KEYS)?;
    let own = |key| Ok(top.string(key)?.map(str::to_owned));
    let units = [("steps", TimeUnit::Steps), ("seconds", TimeUnit::Seconds)];
    let mut scenario = Scenario {
        title: own("title")?,
        source: own("source")?,
        provenance: own("provenance")?,
        time: top.one_of("time", &units)?.unwrap_or_default(),
        cases: Vec::new(),
    };
    let sorts = [("blocked", Unknown::Blocked), ("free", Unknown::Free)];
    let options = LoadOptions {
        unknown: top.one_of("unknown", &sorts)?.unwrap_or_default(),
        ..LoadOptions::default()
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
        let case = C::fresh(&top, &top, case_name, &mut maps)?;
        scenario.cases.push(case);
    }
    if let (Some(odd), false) = (top.get("event").or(top.get("expected")), cases.is_empty()) {
        return Err(odd.error("events and lengths inside a [[case]], where there are cases"));
    }
    for table in cases {
        let table = table.with_keys(C::CASE_KEYS)?;
        let case = case(&top, &table, &scenario.cases, &mut maps)?;
        scenario.cases.push(case);
    }
    Ok(scenario)
}

/// The maps of a file, each loaded once.
pub(crate) struct Maps<'l, M> {
    load: &'l mut dyn FnMut(&str, &LoadOptions) -> Result<M, FileError>,
    options: LoadOptions,
    loaded: Vec<(String, M)>,
}

impl<M: Clone> Maps<'_, M> {
    fn get(&mut self, name: &str) -> Result<M, FileError> {
        if let Some((_, map)) = self.loaded.iter().find(|(known, _)| known == name) {
            return Ok(map.clone());
        }
        let map = (self.load)(name, &self.options)?;
        self.loaded.push((name.to_owned(), map.clone()));
        Ok(map)
    }
}

/// A case of a list.
fn case<C: Query>(
    top: &Table<'_>,
    table: &Table<'_>,
    before: &[C],
    maps: &mut Maps<'_, C::Map>,
) -> Result<C, FileError> {
    let value = table.needed("name", "what the case is called")?;
    let name = value.string()?;
    if before.iter().any(|case| case.name() == name) {
        return Err(value.error("a name that no other case has"));
    }
    let Some(value) = table.get("follows") else {
        return C::fresh(top, table, name.to_owned(), maps);
    };
    let followed = value.string()?;
    let follows = before.iter().position(|case| case.name() == followed);
    let follows = follows.ok_or_else(|| value.error("the name of an earlier case"))?;
    for key in C::FIXED_KEYS {
        if let Some(odd) = table.get(key) {
            let expected =
                format!("no \"{key}\" in a case that follows another: it has that one's");
            return Err(odd.error(expected));
        }
    }
    before[follows].followed(follows, table, name.to_owned())
}

/// The events of a case; `changes` reads what one of them changes.
fn events<C>(
    table: &Table<'_>,
    keys: &[&str],
    mut changes: impl FnMut(&Table<'_>) -> Result<Vec<C>, FileError>,
) -> Result<Vec<Event<C>>, FileError> {
    let mut events: Vec<Event<C>> = Vec::new();
    for table in table.tables("event")? {
        let table = table.with_keys(&[&["at", "name"], keys].concat())?;
        let at = table.needed("at", "when it happens")?;
        let event = Event {
            at: at.amount("when it happens")?,
            name: table.string("name")?.map(str::to_owned),
            changes: changes(&table)?,
        };
        if let Some(last) = events.last()
            && event.at < last.at
        {
            return Err(at.error(format!("{} or later: events are in their order", last.at)));
        }
        if event.changes.is_empty() {
            let expected = format!("one of {}", keys.join(", "));
            return Err(table.error("an event without a change", expected));
        }
        events.push(event);
    }
    Ok(events)
}
