//! Pictures and films of maps, paths and searches: SVG, PNG, GIF and HTML.
//!
//! A [`Picture`] is built layer by layer, later ones over earlier ones, and knows nothing of the
//! planners whose work it shows. The SVG is written by hand as compact text: equal cells are merged
//! into rectangles, straight runs of a path into one line. The PNG is that SVG, drawn. Its text is
//! set in the `DejaVu` Sans that the program carries, so that it looks the same on a machine without
//! fonts. Colours are those of Okabe and Ito, which the colour-blind tell apart, and every marker
//! also has a shape of its own.
//!
//! ```
//! use pf_grid::{Cell, Grid};
//! use pf_render::{Line, Picture};
//!
//! let grid = Grid::parse("
//!     ....
//!     .##.
//!     ....
//! ").unwrap();
//! let path = [(0, 0), (1, 0), (2, 0), (3, 1), (3, 2)].map(|(x, y)| Cell::new(x, y));
//! let picture = Picture::of(&grid)
//!     .path("A*", Line::Solid, &path)
//!     .ends(path[0], path[4])
//!     .caption("A*: 4.41 cells");
//! assert!(picture.svg().starts_with("<svg "));
//! assert!(picture.png().unwrap().starts_with(b"\x89PNG"));
//! ```
//!
//! Which way is up is decided by what a picture is of. One of a grid ([`Picture::of`]) has cells for
//! units and y running down, as the rows of its file do; one of a world ([`Picture::of_world`]) has
//! the world's units and y running up, as in mathematics. So a path that was found in a world made
//! from a grid is drawn on the grid, and cells made from a world are drawn on the world
//! ([`Picture::rasterised`]).
//!
//! What happens in time is a [`Film`]: a few hundred frames over still grounds, as GIF or as a page with a
//! slider. [`Recorder::filming`] listens to a planner for one, [`Reel::search`] makes frames of what it
//! heard. Several films make a page by way of a [`Gallery`].

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
