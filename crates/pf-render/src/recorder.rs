use pf_core::{Event, Trace};
use pf_geom::{Point, TeamProblem, WorldProblem};
use pf_grid::{Cell, GridProblem};

/// Listens to a search and keeps what a picture can show of it.
///
/// ```
/// use pf_core::Context;
/// use pf_grid::{Cell, GridProblem};
/// use pf_render::Recorder;
///
/// let mut recorder = Recorder::default();
/// let mut cx: Context<'_, GridProblem> = Context::seeded(0).traced(&mut recorder);
/// cx.expanded(|| Cell::new(2, 1));
/// assert_eq!(recorder.expanded(), [Cell::new(2, 1)]);
/// ```
#[derive(Clone, Debug, Default)]
pub struct Recorder {
    expanded: Vec<Cell>,
    reached: Vec<[f64; 2]>,
    pieces: Vec<[[f64; 2]; 2]>,
}

impl Recorder {
    /// The cells in the order they were expanded; a cell that was expanded twice is there twice.
    #[must_use]
    pub fn expanded(&self) -> &[Cell] {
        &self.expanded
    }

    /// The points of a world in the order they were expanded.
    #[must_use]
    pub fn reached(&self) -> &[[f64; 2]] {
        &self.reached
    }

    /// The straight pieces of a world that a planner knows to be free: what it shows as two points
    /// called `free piece`.
    #[must_use]
    pub fn pieces(&self) -> &[[[f64; 2]; 2]] {
        &self.pieces
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        self.expanded.clear();
        self.reached.clear();
        self.pieces.clear();
    }
}

impl Trace<GridProblem> for Recorder {
    fn event(&mut self, event: &Event<'_, GridProblem>) {
        if let &Event::Expanded(&cell) = event {
            self.expanded.push(cell);
        }
    }
}

impl Trace<WorldProblem> for Recorder {
    fn event(&mut self, event: &Event<'_, WorldProblem>) {
        let pair = |p: &Point| [p.x, p.y];
        match event {
            Event::Expanded(point) => self.reached.push(pair(point)),
            Event::Points {
                name: "free piece",
                at: [a, b],
            } => self.pieces.push([pair(a), pair(b)]),
            _ => {}
        }
    }
}

/// Where robots of the population are, the last that was shown.
impl Trace<TeamProblem> for Recorder {
    fn event(&mut self, event: &Event<'_, TeamProblem>) {
        if let Event::Points { at, .. } = event {
            self.reached.clear();
            self.reached.extend(at.iter().flatten().map(|p| [p.x, p.y]));
        }
    }
}
