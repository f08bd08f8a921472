#![doc = include_str!("../README.md")]
//!
//! # Formats
//!
//! | format | read | write |
//! | --- | --- | --- |
//! | any map | [`load_map`], [`kind_of`] | [`write_map`] |
//! | any grid map | [`load_grid`] | [`write_grid`] |
//! | Moving AI `.map` | [`read_movingai`] | [`write_movingai`] |
//! | Moving AI `.scen` | [`read_scen`] | [`write_scen`] |
//! | ROS `map_server` YAML with PGM or PNG | [`read_ros`] | [`write_ros`] |
//! | PNG, PGM | [`read_image`] | [`write_png`], [`write_pgm`] |
//! | any world | [`read_world`] | [`write_world`] |
//! | world TOML | [`parse_world`] | [`write_world`] |
//! | GeoJSON | [`read_geojson`] | [`write_geojson`] |
//! | any scenario | [`load_scenario`] | |
//! | scenario TOML on grids | [`read_scenario`] | |
//! | scenario TOML in worlds | [`read_world_scenario`] | |
//! | paths on grids | | [`write_path_csv`], [`write_path_json`] |
//! | paths in worlds | | [`write_polyline_csv`], [`write_polyline_json`] |

mod error;
mod load;
mod map;
mod movingai;
mod path;
mod pgm;
mod png;
mod raster;
mod ros;
mod scen;
pub mod scenario;
mod source;
pub mod toml_tree;
pub mod world;
mod write;

pub use error::{FileError, Place};
pub use load::{FileKind, Map, kind_of, load_map, load_scenario, write_grid, write_map};
pub use map::{Frame, GridMap, LoadOptions, Unknown, load_grid};
pub use movingai::{parse_movingai, read_movingai, write_movingai};
pub use path::{write_path_csv, write_path_json, write_polyline_csv, write_polyline_json};
pub use pgm::{write_gray, write_pgm};
pub use png::write_png;
pub use raster::{parse_image, read_image};
pub use ros::{RosMap, RosMode, parse_ros, read_ros, write_ros, write_ros_yaml};
pub use scen::{Scen, ScenRow, parse_scen, read_scen, write_scen};
pub use scenario::{
    AnyScenario, Case, Event, Expected, Scenario, TimeUnit, WorldCase, WorldScenario,
    parse_scenario, parse_world_scenario, read_scenario, read_world_scenario,
};
pub use world::{
    Names, Robot, WorldFile, parse_geojson, parse_world, read_geojson, read_world, write_geojson,
    write_world,
};
pub use write::{between_writes, make_folder, whole as write_whole};
