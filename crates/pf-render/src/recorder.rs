use crate::film::tape::{Better, Sample, Tape};
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
    tape: Option<Tape>,
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

    /// One that keeps besides what an animation of so many frames can show: when what was
    /// expanded, numbers per cell, swarms, attempts, and what was better than all before. Of what
    /// happens more often than there are frames it keeps a few, spread evenly. `size` is columns and
    /// rows of the map on which numbers per cell are sampled.
    #[must_use]
    pub fn filming(frames: usize, size: [u32; 2]) -> Self {
        Self {
            tape: Some(Tape::new(frames, size)),
            ..Self::default()
        }
    }

    pub(crate) fn tape(&self) -> Option<&Tape> {
        self.tape.as_ref()
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        self.expanded.clear();
        self.reached.clear();
        self.pieces.clear();
        self.improvements.clear();
        if let Some(tape) = &mut self.tape {
            *tape = Tape::new(tape.frames, tape.size);
        }
    }
}

impl Trace<GridProblem> for Recorder {
    fn event(&mut self, event: &Event<'_, GridProblem>) {
        match event {
            &Event::Expanded(&cell) if !self.only_improvements => self.expanded.push(cell),
            Event::Improved(best) => self.improved(best.cost.value()),
            _ => {}
        }
        let Some(tape) = &mut self.tape else { return };
        let now = tape.tick();
        tape.in_cells = true;
        let middle = |c: &Cell| [f64::from(c.x) + 0.5, f64::from(c.y) + 0.5];
        let line = |cells: &[Cell]| cells.iter().map(middle).collect();
        match event {
            Event::Expanded(_) => tape.expanded_at.push(now),
            Event::Candidate(path) => tape.tries.offer(now, || line(path)),
            Event::Improved(best) => tape.better.offer(now, || Better {
                line: line(&best.solution),
                cost: best.cost.value(),
            }),
            Event::Field { name, value } => {
                let (size, block) = (tape.size, tape.block);
                #[expect(clippy::cast_possible_truncation, reason = "a shade needs no more")]
                let value = |[x, y]: [u32; 2]| value(&Cell { x, y }) as f32;
                tape.fields.offer(now, || Sample {
                    name,
                    values: Tape::corners(size, block).map(value).collect(),
                });
            }
            Event::Points { name, at } => tape.points.offer(now, || (name, few(line(at)))),
            _ => {}
        }
    }

    fn spent(&mut self, stats: &Stats) {
        self.spent = *stats;
    }
}

/// Points that a frame shows at most.
const DOTS: usize = 100;

/// Some of many points, evenly.
fn few(points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let step = points.len().div_ceil(DOTS).max(1);
    points.into_iter().step_by(step).collect()
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
            } => {
                self.pieces.push([pair(a), pair(b)]);
                return;
            }
            _ => {}
        }
        let Some(tape) = &mut self.tape else { return };
        let now = tape.tick();
        let line = |points: &[Point]| points.iter().map(pair).collect();
        match event {
            Event::Expanded(_) => tape.expanded_at.push(now),
            Event::Candidate(path) => tape.tries.offer(now, || line(path)),
            Event::Improved(best) => tape.better.offer(now, || Better {
                line: line(&best.solution),
                cost: best.cost,
            }),
            Event::Points { name, at } => tape.points.offer(now, || (name, few(line(at)))),
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
            Event::Points { at, .. } if !self.only_improvements && self.tape.is_none() => {
                self.reached.clear();
                self.reached.extend(at.iter().flatten().map(|p| [p.x, p.y]));
            }
            _ => {}
        }
        let places = |at: &[Vec<Point>]| at.iter().flatten().map(|p| [p.x, p.y]).collect();
        let Some(tape) = &mut self.tape else { return };
        let now = tape.tick();
        match event {
            Event::Points { name, at } => tape.points.offer(now, || (name, few(places(at)))),
            Event::Improved(best) => tape.better.offer(now, || {
                let shortest = best.solution.members().first();
                let path = shortest.and_then(|plan| plan.paths.first());
                Better {
                    line: path.map_or(Vec::new(), |path| {
                        path.iter().map(|p| [p.at.x, p.at.y]).collect()
                    }),
                    cost: best.cost.members().first().map_or(f64::NAN, |cost| cost[0]),
                }
            }),
            _ => {}
        }
    }

    fn spent(&mut self, stats: &Stats) {
        self.spent = *stats;
    }
}
