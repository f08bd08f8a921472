//! Pictures of maps, paths and searches: SVG and PNG.
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

mod cells;
mod palette;
mod picture;
mod png;
mod recorder;
mod svg;

pub use picture::{Line, Picture};
pub use png::NoPicture;
pub use recorder::Recorder;
