//! Any file: what it is, and maps and scenarios of any kind.

use crate::{
    AnyScenario, FileError, Frame, GridMap, LoadOptions, Place, WorldFile,
    error::quoted,
    map, scenario, source,
    source::Source,
    toml_tree::{File, Table},
    world,
};
use std::path::Path;

/// A map of either sort.
#[derive(Clone, Debug)]
pub enum Map {
    /// Cells.
    Grid(GridMap),
    /// Shapes.
    World(WorldFile),
}

/// What a file is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// A grid: for [`load_map`] or [`load_grid`](crate::load_grid).
    Grid,
    /// A world: for [`load_map`] or [`read_world`](crate::read_world).
    World,
    /// A scenario on grids: for [`load_scenario`] or [`read_scenario`](crate::read_scenario).
    GridScenario,
    /// A scenario in worlds: for [`load_scenario`] or
    /// [`read_world_scenario`](crate::read_world_scenario).
    WorldScenario,
}

/// What a file is: by its name where that tells, else by its content. TOML is a scenario in worlds
/// if it names a `world`, a world if it has `bounds` or shapes, else a scenario on grids.
///
/// # Errors
/// [`FileError`] if it cannot be read or is nothing that is known here.
pub fn kind_of(path: &Path) -> Result<FileKind, FileError> {
    Ok(match look(path, &source::read(path)?)? {
        Format::Grid => FileKind::Grid,
        Format::GeoJson => FileKind::World,
        Format::Toml(kind) => kind,
    })
}

/// Reads a map of any kind: what [`load_grid`](crate::load_grid) reads, world TOML, `GeoJSON`.
///
/// # Errors
/// [`FileError`] if the file cannot be read or is not a map.
pub fn load_map(path: &Path, options: &LoadOptions) -> Result<Map, FileError> {
    let name = path.display().to_string();
    let bytes = source::read(path)?;
    match look(path, &bytes)? {
        Format::Grid => map::grid(path, &bytes, options).map(Map::Grid),
        Format::GeoJson => world::parse_json(&name, &bytes, options.margin).map(Map::World),
        Format::Toml(FileKind::World) => world::parse_world(&name, &bytes).map(Map::World),
        Format::Toml(_) => {
            let expected = "a map: a grid, or a world with \"bounds\" and shapes";
            Err(FileError::new(&name, Place::Whole, "a scenario", expected))
        }
    }
}

/// Reads a scenario of either sort and the maps it names.
///
/// # Errors
/// [`FileError`] about the scenario or one of its maps.
pub fn load_scenario(path: &Path) -> Result<AnyScenario, FileError> {
    let bytes = source::read(path)?;
    match look(path, &bytes)? {
        Format::Toml(FileKind::GridScenario) => {
            scenario::from_file(path, &bytes).map(AnyScenario::Grid)
        }
        Format::Toml(FileKind::WorldScenario) => {
            scenario::from_file(path, &bytes).map(AnyScenario::World)
        }
        _ => {
            let name = path.display().to_string();
            let expected = "a scenario: TOML with a \"map\" or a \"world\", \"start\" and \"goal\"";
            Err(FileError::new(&name, Place::Whole, "a map", expected))
        }
    }
}

/// Writes a map in the format that its file's name says: `.map`, `.yaml` (with its picture beside
/// it), `.png`, `.pgm` for a grid, `.toml`, `.geojson`, `.json` for a world.
///
/// # Errors
/// [`FileError`] if the file cannot be written, or the name is none of these.
pub fn write_map(path: &Path, map: &Map) -> Result<(), FileError> {
    match map {
        Map::Grid(map) => write_grid(path, map),
        Map::World(file) => match extension(path).as_deref() {
            Some("toml") => world::write_world(path, file),
            Some("geojson" | "json") => world::write_geojson(path, file),
            _ => Err(unwritable(path, ".toml, .geojson or .json for a world")),
        },
    }
}

/// Writes a grid in the format that its file's name says: `.map`, `.yaml` (with its picture beside
/// it), `.png`, `.pgm`. Without a frame, cells of a ROS map are 1 m wide and begin at 0, 0.
///
/// # Errors
/// [`FileError`] if the file cannot be written, or the name is none of these.
pub fn write_grid(path: &Path, map: &GridMap) -> Result<(), FileError> {
    let frame = map.frame.unwrap_or(Frame {
        resolution: 1.0,
        origin: [0.0; 3],
    });
    match extension(path).as_deref() {
        Some("map") => crate::write_movingai(path, &map.grid),
        Some("yaml" | "yml") => crate::write_ros(path, &map.grid, frame),
        Some("png") => crate::write_png(path, &map.grid),
        Some("pgm") => crate::write_pgm(path, &map.grid),
        _ => Err(unwritable(path, ".map, .yaml, .png or .pgm for a grid")),
    }
}

fn unwritable(path: &Path, expected: &str) -> FileError {
    let name = path.display().to_string();
    FileError::new(&name, Place::Whole, "a name of no known format", expected)
}

/// In small letters.
fn extension(path: &Path) -> Option<String> {
    let extension = path.extension()?.to_str()?;
    Some(extension.to_ascii_lowercase())
}

enum Format {
    Grid,
    GeoJson,
    Toml(FileKind),
}

fn look(path: &Path, bytes: &[u8]) -> Result<Format, FileError> {
    let name = path.display().to_string();
    let source = Source { name: &name, bytes };
    match extension(path).as_deref() {
        Some("geojson" | "json") => return Ok(Format::GeoJson),
        Some("toml") => return toml_kind(source).map(Format::Toml),
        Some(extension) if map::is_grid_extension(extension) => return Ok(Format::Grid),
        _ => {}
    }
    if map::is_grid(&source) {
        return Ok(Format::Grid);
    }
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if text.trim_ascii_start().first() == Some(&b'{') {
        return Ok(Format::GeoJson);
    }
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(64)]);
    let first = quoted(head.lines().next().unwrap_or(""));
    let kind = if head.contains('=') || head.contains('[') || head.starts_with('#') {
        toml_kind(source).ok()
    } else {
        None
    };
    kind.map(Format::Toml).ok_or_else(|| {
        let expected = "a map: Moving AI .map, ROS .yaml, .png, .pgm, a world .toml or .geojson";
        source.error(Place::Whole, first, expected)
    })
}

fn toml_kind(source: Source<'_>) -> Result<FileKind, FileError> {
    let file = File {
        source,
        text: source.text()?,
    };
    let root = file.parse("a world or scenario file")?;
    let top = Table::root(file, &root);
    let cases = top.tables("case").unwrap_or_default();
    let mut tables = std::iter::once(&top).chain(&cases);
    let of_world = || world::KEYS.iter().skip(3).any(|key| top.get(key).is_some());
    Ok(if tables.any(|table| table.get("world").is_some()) {
        FileKind::WorldScenario
    } else if cases.is_empty() && top.get("map").is_none() && of_world() {
        FileKind::World
    } else {
        FileKind::GridScenario
    })
}
