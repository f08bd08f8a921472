//! Animations: still grounds, and what comes and goes over them.
//!
//! A [`Film`] is data that knows nothing of how it is played. [`Film::gif`] draws it, and
//! [`Film::html`] writes a page that does; both show the same. What lies still is drawn once; a
//! [`Shot`] says which cells change their shade and which few things are on top.

mod front;
mod gif;
mod html;
mod quantise;
mod search;
mod shade;
mod sheet;
pub(crate) mod tape;
mod team;
mod thing;

pub use front::Found;
pub use html::Gallery;
pub use search::Ending;
pub use shade::Shade;
pub use thing::{Look, Thing};

use crate::{Picture, picture::Key};
use pf_grid::Cell;

/// An animation.
///
/// ```
/// use pf_grid::{Cell, Grid};
/// use pf_render::{Film, Look, Picture, Reel, Shot, Thing};
///
/// let grid = Grid::open(8, 6).unwrap();
/// let mut reel = Reel::of(Picture::of(&grid)).ends([0.5, 0.5], [7.5, 0.5]);
/// for x in 0..7 {
///     let at = [f64::from(x) + 0.5, 0.5];
///     reel.push(Shot {
///         things: vec![Thing::Disc { at, radius: 0.4, look: Look::Robot(0) }],
///         words: format!("step {x}"),
///         ..Shot::default()
///     });
/// }
/// let film = Film::new("a robot", vec![reel]);
/// assert_eq!(film.frames(), 7);
/// assert!(film.gif([240, 180], 10.0).unwrap().starts_with(b"GIF89a"));
/// assert!(film.html([480, 360], 10.0).starts_with("<!doctype html>"));
/// ```
#[derive(Clone, Debug)]
pub struct Film {
    pub(crate) title: String,
    pub(crate) reels: Vec<Reel>,
}

/// Frames over one ground.
#[derive(Clone, Debug)]
pub struct Reel {
    pub(crate) ground: Picture,
    /// Columns and rows of blocks, and cells per side of one.
    pub(crate) blocks: [u32; 2],
    pub(crate) block: u32,
    pub(crate) shots: Vec<Shot>,
    /// What stays on top.
    pub(crate) top: Vec<Thing>,
}

/// A frame: how it differs in its cells from the one before, and what is over them.
#[derive(Clone, Debug, Default)]
pub struct Shot {
    /// Cells that take another shade; the first frame begins without any.
    pub cells: Vec<(Cell, Shade)>,
    /// What is on top in this frame, lowest first.
    pub things: Vec<Thing>,
    /// What there is to say of it.
    pub words: String,
}

impl Film {
    /// An animation of these reels, one after the other. The title should say planner, seed and
    /// cost.
    #[must_use]
    pub fn new(title: impl Into<String>, reels: Vec<Reel>) -> Self {
        Self {
            title: title.into(),
            reels,
        }
    }

    /// How many frames it has.
    #[must_use]
    pub fn frames(&self) -> usize {
        self.reels.iter().map(|reel| reel.shots.len()).sum()
    }

    /// The last frame of a reel, as a film of its own that says so in these words; `None` if there
    /// is none.
    #[must_use]
    pub fn still(&self, reel: usize, title: impl Into<String>) -> Option<Self> {
        let reel = self.reels.get(reel)?;
        let mut last = reel.shots.last()?.clone();
        last.cells = reel
            .shots
            .iter()
            .flat_map(|shot| shot.cells.iter().copied())
            .collect();
        // Of several shades of a cell the last counts.
        last.cells.reverse();
        let mut seen = std::collections::BTreeSet::new();
        last.cells.retain(|(cell, _)| seen.insert((cell.y, cell.x)));
        let still = Reel {
            shots: vec![last],
            ..reel.clone()
        };
        Some(Self::new(title, vec![still]))
    }

    /// How many reels it has.
    #[must_use]
    pub fn reels(&self) -> usize {
        self.reels.len()
    }

    /// What the colours mean, in all reels.
    pub(crate) fn legend(&self) -> Vec<(Key, String)> {
        let mut legend: Vec<(Key, String)> = Vec::new();
        for entry in self.reels.iter().flat_map(|reel| &reel.ground.legend) {
            if !legend.contains(entry) {
                legend.push(entry.clone());
            }
        }
        legend
    }
}

impl Reel {
    /// No frames yet, over a picture whose caption is not shown.
    #[must_use]
    pub fn of(ground: Picture) -> Self {
        let size = ground.lattice.size;
        let block = tape::block_of(size);
        Self {
            ground,
            blocks: size.map(|side| side.div_ceil(block)),
            block,
            shots: Vec::new(),
            top: Vec::new(),
        }
    }

    /// With start and goal, in the map's units.
    #[must_use]
    pub fn ends(mut self, start: [f64; 2], goal: [f64; 2]) -> Self {
        self.top.extend([Thing::Start(start), Thing::Goal(goal)]);
        self.key(Key::Start, "start").key(Key::Goal, "goal")
    }

    /// The next frame.
    pub fn push(&mut self, shot: Shot) {
        self.shots.push(shot);
    }

    /// The same, with something below all else in every frame.
    #[must_use]
    pub fn below(mut self, thing: &Thing) -> Self {
        for shot in &mut self.shots {
            shot.things.insert(0, thing.clone());
        }
        self
    }

    /// The same, with words before those of every frame.
    #[must_use]
    pub fn said(mut self, words: &str) -> Self {
        for shot in &mut self.shots {
            shot.words.insert_str(0, words);
        }
        self
    }

    /// A line of the legend for things that look so.
    #[must_use]
    pub fn explain(self, look: Look, words: &str) -> Self {
        self.key(look.key(), words)
    }

    /// A line of the legend for cells of a shade.
    #[must_use]
    pub fn explain_shade(self, shade: Shade, words: &str) -> Self {
        match shade.colour() {
            Some((colour, opacity)) => self.key(Key::Cells(colour, opacity), words),
            None => self,
        }
    }

    pub(crate) fn key(mut self, key: Key, words: &str) -> Self {
        self.ground = self.ground.key(key, words);
        self
    }

    /// A cell of every part of the map that has a shade of its own: all, unless the map is large.
    pub fn tiles(&self) -> impl Iterator<Item = Cell> + use<> {
        let [columns, rows] = self.blocks;
        let side = self.block;
        let cell = move |x, y| Cell::new(x * side, y * side);
        (0..rows).flat_map(move |y| (0..columns).map(move |x| cell(x, y)))
    }

    /// The number of the block in which a cell lies; `None` outside the map.
    pub(crate) fn block_of(&self, cell: Cell) -> Option<u32> {
        let (x, y) = (cell.x / self.block, cell.y / self.block);
        (x < self.blocks[0] && y < self.blocks[1]).then(|| y * self.blocks[0] + x)
    }

    /// Where cells lie in the map's units: the first corner of the first block, and a block's side.
    pub(crate) fn lattice(&self) -> ([f64; 2], f64) {
        let lattice = self.ground.lattice;
        (lattice.corner, lattice.side * f64::from(self.block))
    }
}
