use pf_core::{Event, Trace};
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
}

impl Recorder {
    /// The cells in the order they were expanded; a cell that was expanded twice is there twice.
    #[must_use]
    pub fn expanded(&self) -> &[Cell] {
        &self.expanded
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        self.expanded.clear();
    }
}

impl Trace<GridProblem> for Recorder {
    fn event(&mut self, event: &Event<'_, GridProblem>) {
        if let &Event::Expanded(&cell) = event {
            self.expanded.push(cell);
        }
    }
}
