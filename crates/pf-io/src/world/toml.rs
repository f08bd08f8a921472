//! Worlds in TOML.

use super::{
    Names, Robot, WorldFile,
    shapes::{self, Kind, found_and_expected, inside},
};
use crate::{
    FileError,
    source::Source,
    toml_tree::{File, Table},
};
use pf_geom::{Rectangle, Shape, World};

pub(crate) const KEYS: [&str; 8] = [
    "title",
    "source",
    "provenance",
    "bounds",
    "robot",
    "circle",
    "rectangle",
    "polygon",
];

/// Reads the content of a world file in TOML; `name` is for errors and becomes the world's
/// [`file`](WorldFile::file).
///
/// # Errors
/// [`FileError`] if it is not a world; a shape that is none is named with its place.
pub fn parse_world(name: &str, bytes: &[u8]) -> Result<WorldFile, FileError> {
    let source = Source { name, bytes };
    let file = File {
        source,
        text: source.text()?,
    };
    let root = file.parse("a world file")?;
    let table = Table::root(file, &root).with_keys(&KEYS)?;
    let own = |key| Ok(table.string(key)?.map(str::to_owned));
    let bounds = bounds(&table)?;
    let (names, shapes) = all_shapes(&table)?;
    let robots = table.tables("robot")?;
    let robots = robots.iter().map(|table| robot(table, &bounds));
    Ok(WorldFile {
        names,
        robots: robots.collect::<Result<_, _>>()?,
        title: own("title")?,
        source: own("source")?,
        provenance: own("provenance")?,
        file: name.into(),
        world: World::with_shapes(bounds, shapes).into(),
    })
}

fn bounds(table: &Table<'_>) -> Result<Rectangle, FileError> {
    let expected = "the region, { min = [x, y], max = [x, y] }";
    let table = table.needed("bounds", expected)?.table()?;
    let table = table.with_keys(&["min", "max"])?;
    let corner = |key, what| table.needed(key, "a point [x, y]")?.point(what);
    let min = corner("min", "the bounds' lower corner")?;
    let max = corner("max", "the bounds' upper corner")?;
    Rectangle::new(min, max).map_err(|error| {
        let (found, expected) = found_and_expected(&error);
        table.error(format!("{found} as bounds"), expected)
    })
}

/// The shapes of all kinds, in the order in which they stand in the file.
fn all_shapes(table: &Table<'_>) -> Result<(Names, Vec<Shape>), FileError> {
    let mut tables = Vec::new();
    for kind in Kind::ALL {
        let found = table.tables(kind.name())?;
        tables.extend(found.into_iter().map(|table| (kind, table)));
    }
    tables.sort_by_key(|(_, table)| table.offset());
    let mut names = Names::default();
    let mut shapes = Vec::with_capacity(tables.len());
    for (id, (kind, table)) in tables.into_iter().enumerate() {
        let (name, shape) = shapes::shape(kind, &table, id)?;
        names.push(name);
        shapes.push(shape);
    }
    Ok((names, shapes))
}

fn robot(table: &Table<'_>, bounds: &Rectangle) -> Result<Robot, FileError> {
    let table = table.with_keys(&["name", "radius", "start", "goal", "speed"])?;
    let needed = |key| table.needed(key, "a point [x, y]");
    Ok(Robot {
        name: table.name()?,
        radius: match table.get("radius") {
            Some(value) => value.size("the robot's radius")?,
            None => 0.0,
        },
        start: inside(&needed("start")?, "the robot's start", bounds)?,
        goal: inside(&needed("goal")?, "the robot's goal", bounds)?,
        speed: match table.get("speed") {
            Some(value) => {
                let speed = value.size("the robot's speed")?;
                let moves = Some(speed).filter(|&speed| speed > 0.0);
                Some(moves.ok_or_else(|| value.error("the robot's speed: above 0"))?)
            }
            None => None,
        },
    })
}
