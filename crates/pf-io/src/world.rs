//! World files: shapes in a bounded region, and the robots that move among them.
#![doc = include_str!("world.md")]

mod geojson;
mod shapes;
mod toml;
mod write;

pub use geojson::{parse_geojson, read_geojson, write_geojson};
pub use toml::parse_world;
pub use write::write_world;

pub(crate) use geojson::parse as parse_json;
pub(crate) use shapes::{any_shape, inside};
pub(crate) use toml::KEYS;
pub(crate) use write::number;

use crate::{FileError, LoadOptions, Map, load_map};
use pf_geom::{Point, ShapeId, World};
use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

/// A world and what its file says beside the shapes.
#[derive(Clone, Debug)]
pub struct WorldFile {
    /// The region and its shapes; their ids are their places in the file, from 0.
    pub world: Arc<World>,
    /// What the shapes are called.
    pub names: Names,
    /// Who moves in it.
    pub robots: Vec<Robot>,
    /// What it shows.
    pub title: Option<String>,
    /// The publication it is taken from.
    pub source: Option<String>,
    /// How it came to be.
    pub provenance: Option<String>,
    /// The file it was read from.
    pub file: PathBuf,
}

/// A round robot and its errand.
#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    /// What it is called.
    pub name: Option<String>,
    /// In the world's unit; 0 for a point.
    pub radius: f64,
    /// Where from.
    pub start: Point,
    /// Where to.
    pub goal: Point,
    /// In the world's unit per second.
    pub speed: Option<f64>,
}

/// What shapes are called, by id. Shapes that share a name belong together: what happens to the
/// name happens to all of them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names(Vec<Option<String>>);

impl Names {
    /// What a shape is called, if anything.
    #[must_use]
    pub fn of(&self, id: ShapeId) -> Option<&str> {
        self.0.get(id)?.as_deref()
    }

    /// The shapes of a name, in ascending order.
    pub fn ids(&self, name: &str) -> impl Iterator<Item = ShapeId> {
        let named = move |id: &ShapeId| self.of(*id) == Some(name);
        (0..self.0.len()).filter(named)
    }

    /// All names, some more than once.
    pub fn all(&self) -> impl Iterator<Item = &str> {
        self.0.iter().flatten().map(String::as_str)
    }

    /// Makes it the names of so many shapes; new ones have none.
    pub(crate) fn resize(&mut self, shapes: usize) {
        self.0.resize(shapes, None);
    }

    /// Says what the next shape is called.
    pub(crate) fn push(&mut self, name: Option<String>) {
        self.0.push(name);
    }
}

/// The names of shapes 0, 1, 2…
impl FromIterator<Option<String>> for Names {
    fn from_iter<I: IntoIterator<Item = Option<String>>>(names: I) -> Self {
        Self(names.into_iter().collect())
    }
}

impl WorldFile {
    /// A world of nameless shapes, without robots.
    #[must_use]
    pub fn of(world: impl Into<Arc<World>>) -> Self {
        Self {
            world: world.into(),
            names: Names::default(),
            robots: Vec::new(),
            title: None,
            source: None,
            provenance: None,
            file: PathBuf::new(),
        }
    }
}

/// Reads a world, TOML or GeoJSON.
///
/// # Errors
/// [`FileError`] if the file cannot be read or is not a world.
pub fn read_world(path: &Path) -> Result<WorldFile, FileError> {
    match load_map(path, &LoadOptions::default())? {
        Map::World(world) => Ok(world),
        Map::Grid(_) => Err(FileError::new(
            &path.display().to_string(),
            crate::Place::Whole,
            "a grid",
            "a world: TOML or GeoJSON",
        )),
    }
}
