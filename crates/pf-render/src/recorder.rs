use pf_core::{Event, Stats, Trace};
use pf_geom::{LENGTH, Point, TeamProblem, WorldProblem};
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
    improvements: Vec<Improvement>,
    only_improvements: bool,
    spent: Stats,
}

/// A solution better than all before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Improvement {
    /// Evaluations until then.
    pub evaluated: u64,
    /// Expansions until then.
    pub expanded: u64,
    /// Its cost; of a front, the least length.
    pub cost: f64,
}

impl Recorder {
    /// Keeps only what [`improvements`](Self::improvements) returns, however long the search.
    #[must_use]
    pub fn of_improvements() -> Self {
        Self {
            only_improvements: true,
            ..Self::default()
        }
    }

    /// The improvements in the order they were made, costs in the units of the planner's own problem.
    #[must_use]
    pub fn improvements(&self) -> &[Improvement] {
        &self.improvements
    }

    fn improved(&mut self, cost: f64) {
        self.improvements.push(Improvement {
            evaluated: self.spent.evaluated,
            expanded: self.spent.expanded,
            cost,
        });
    }

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
        self.improvements.clear();
    }
}

impl Trace<GridProblem> for Recorder {
    fn event(&mut self, event: &Event<'_, GridProblem>) {
        match event {
            &Event::Expanded(&cell) if !self.only_improvements => self.expanded.push(cell),
            Event::Improved(best) => self.improved(best.cost.value()),
            _ => {}
        }
    }

    fn spent(&mut self, stats: &Stats) {
        self.spent = *stats;
    }
}

impl Trace<WorldProblem> for Recorder {
    fn event(&mut self, event: &Event<'_, WorldProblem>) {
        let pair = |p: &Point| [p.x, p.y];
        match event {
            Event::Improved(best) => self.improved(best.cost),
            _ if self.only_improvements => {}
            Event::Expanded(point) => self.reached.push(pair(point)),
            Event::Points {
                name: "free piece",
                at: [a, b],
            } => self.pieces.push([pair(a), pair(b)]),
            _ => {}
        }
    }

    fn spent(&mut self, stats: &Stats) {
        self.spent = *stats;
    }
}

/// Where robots of the population are, the last that was shown.
impl Trace<TeamProblem> for Recorder {
    fn event(&mut self, event: &Event<'_, TeamProblem>) {
        match event {
            Event::Improved(best) => {
                let lengths = best.cost.members().iter().map(|cost| cost[LENGTH]);
                self.improved(lengths.fold(f64::INFINITY, f64::min));
            }
            Event::Points { at, .. } if !self.only_improvements => {
                self.reached.clear();
                self.reached.extend(at.iter().flatten().map(|p| [p.x, p.y]));
            }
            _ => {}
        }
    }

    fn spent(&mut self, stats: &Stats) {
        self.spent = *stats;
    }
}
