#![doc = include_str!("../README.md")]

mod cells;
mod film;
mod frame;
mod page;
mod palette;
mod picture;
mod png;
mod recorder;
mod svg;
mod team;
mod world;

pub use film::{Ending, Film, Found, Gallery, Look, Reel, Shade, Shot, Thing};
pub use palette::SERIES;
pub use picture::{Line, Picture};
pub use png::{NoPicture, png_of};
pub use recorder::{Improvement, Recorder};
pub use team::TeamSheet;
