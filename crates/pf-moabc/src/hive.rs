//! What all algorithms here share: rows of numbers, their evaluation over threads, the front.

use crate::{
    archive::Archive,
    dice::Dice,
    encoding::{Encoding, Scratch, Start},
    params::Common,
    sort::Sorter,
    workers::Workers,
};
use pf_core::{Context, Front, Solved};
use pf_geom::{Mark, Objectives, TeamPlan, TeamProblem};

/// Rows of numbers with their marks, in flat arrays.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rows {
    pub(crate) width: usize,
    pub(crate) genes: Vec<f64>,
    pub(crate) marks: Vec<Mark>,
}

impl Rows {
    pub(crate) fn len(&self) -> usize {
        self.marks.len()
    }

    pub(crate) fn row(&self, i: usize) -> &[f64] {
        &self.genes[i * self.width..(i + 1) * self.width]
    }

    pub(crate) fn clear(&mut self, width: usize) {
        self.width = width;
        self.genes.clear();
        self.marks.clear();
    }

    pub(crate) fn append(&mut self, others: &Self) {
        self.genes.extend_from_slice(&others.genes);
        self.marks.extend_from_slice(&others.marks);
    }

    /// Puts row `j` of others in the place of row `i`.
    pub(crate) fn replace(&mut self, i: usize, others: &Self, j: usize) {
        self.genes[i * self.width..(i + 1) * self.width].copy_from_slice(others.row(j));
        self.marks[i] = others.marks[j];
    }
}

/// A population, its children, and the best there was.
#[derive(Clone, Debug, Default)]
pub(crate) struct Hive {
    pub(crate) encoding: Encoding,
    /// The population.
    pub(crate) nest: Rows,
    /// Children of this cycle.
    pub(crate) brood: Rows,
    pub(crate) sorter: Sorter,
    pub(crate) archive: Archive,
    /// A plan of the baseline.
    pub(crate) baseline: Option<(TeamPlan, Objectives)>,
    pub(crate) dice: Option<Dice>,
    /// Whether the front changed since it was announced last.
    pub(crate) news: bool,
    /// Evaluations so far, and how many there may be.
    pub(crate) evaluated: u64,
    kept: Rows,
    scratch: Vec<Scratch>,
    workers: Workers,
}

/// So many nanoseconds of work are worth waking a thread for, which takes 10,000 and more.
const WORTH_A_THREAD: usize = 60_000;

/// About how many nanoseconds of an evaluation there are for each number of a row: measured with 1, 3
/// and 5 robots among 3, 4 and 20 discs.
fn nanoseconds(problem: &TeamProblem) -> usize {
    let others = problem.robots().len() + problem.world().shapes().take(50).count();
    25 + 2 * others
}

/// Some rows and their marks.
type Share<'a> = (&'a mut [f64], &'a mut [Mark]);

type Cx<'a> = Context<'a, TeamProblem>;

impl Hive {
    /// Empties everything, for rows of an encoding.
    pub(crate) fn open(&mut self, encoding: Encoding, common: &Common, seed: u64) {
        let width = encoding.width();
        self.nest.clear(width);
        self.brood.clear(width);
        self.archive.clear(width, common.archive);
        self.encoding = encoding;
        self.baseline = None;
        self.dice = Some(Dice { seed, cycle: 0 });
        self.news = false;
        self.evaluated = 0;
    }

    /// This cycle's dice.
    pub(crate) fn dice(&self) -> Dice {
        self.dice.unwrap_or(Dice { seed: 0, cycle: 0 })
    }

    /// How many of so many children the budget allows.
    fn allowed(&self, count: usize, common: &Common, cx: &Cx<'_>) -> usize {
        let left = common.evaluations.saturating_sub(self.evaluated);
        let left = left.min(cx.evaluations_left());
        usize::try_from(left).map_or(count, |left| count.min(left))
    }

    /// Adds children to the brood, as many of `count` as the budget allows, each made by `make`
    /// from the population, the dice and its number, and marks them; the good ones are offered to
    /// the front. What `make` leaves out of bounds is put on them.
    pub(crate) fn breed(
        &mut self,
        problem: &TeamProblem,
        common: &Common,
        cx: &mut Cx<'_>,
        count: usize,
        make: &(impl Fn(&Rows, Dice, usize, &mut [f64]) + Sync),
    ) {
        let count = self.allowed(count, common, cx);
        let (first, width, dice) = (self.brood.len(), self.nest.width, self.dice());
        self.brood.width = width;
        self.brood.genes.resize((first + count) * width, 0.0);
        self.brood.marks.resize(first + count, Mark::default());
        let worth = count * width * nanoseconds(problem) / WORTH_A_THREAD;
        let threads = common.threads.min(worth).max(1);
        self.scratch
            .resize_with(threads.max(self.scratch.len()), Scratch::default);
        let share = count.div_ceil(threads).max(1);
        let (nest, encoding) = (&self.nest, &self.encoding);
        let genes = self.brood.genes[first * width..].chunks_mut(share * width);
        let marks = self.brood.marks[first..].chunks_mut(share);
        let shares = (first..).step_by(share).zip(genes.zip(marks));
        let work = |((number, (genes, marks)), own): ((usize, Share<'_>), &mut Scratch)| {
            let rows = genes.chunks_exact_mut(width).zip(marks);
            for (number, (row, mark)) in (number..).zip(rows) {
                make(nest, dice, number, row);
                encoding.clamp(row);
                *mark = encoding.mark(problem, row, own);
            }
        };
        let pieces = shares.zip(&mut self.scratch);
        self.workers.share(threads, pieces, work);
        self.take_in(first, problem, cx);
    }

    /// Counts the brood's newest and offers them to the front, in their order.
    fn take_in(&mut self, first: usize, problem: &TeamProblem, cx: &mut Cx<'_>) {
        self.evaluated += (self.brood.len() - first) as u64;
        for child in first..self.brood.len() {
            let (row, mark) = (self.brood.row(child), self.brood.marks[child]);
            cx.candidate(|| Front::unchecked(vec![self.encoding.plan(problem, row)]));
            if mark.excess <= 0.0 {
                self.news |= self.archive.offer(&mark.objectives, row);
            }
        }
    }

    /// Fills the population up to `count` with rows to begin with.
    pub(crate) fn settle(
        &mut self,
        problem: &TeamProblem,
        common: &Common,
        cx: &mut Cx<'_>,
        count: usize,
    ) {
        self.brood.clear(self.nest.width);
        let (encoding, start) = (self.encoding.clone(), common.start());
        let missing = count.saturating_sub(self.nest.len());
        self.breed(problem, common, cx, missing, &|_, dice, number, row| {
            encoding.draw(start, &mut dice.of(number), row);
        });
        self.nest.append(&self.brood);
    }

    /// Joins the brood to the population and keeps the best; afterwards the sorter's order tells
    /// where they were, and its ranks are by place before.
    pub(crate) fn keep_best(&mut self, count: usize) {
        self.nest.append(&self.brood);
        self.sorter.sort(&self.nest.marks);
        let count = count.min(self.nest.len());
        self.kept.clear(self.nest.width);
        for &i in &self.sorter.order[..count] {
            self.kept.genes.extend_from_slice(self.nest.row(i as usize));
            self.kept.marks.push(self.nest.marks[i as usize]);
        }
        std::mem::swap(&mut self.kept, &mut self.nest);
    }

    /// The front as it is, the shortest plan first; `None` if there is none.
    pub(crate) fn front(&self, problem: &TeamProblem) -> Option<Solved<TeamProblem>> {
        let plans = self.archive.members();
        let mut all: Vec<(Objectives, TeamPlan)> = plans
            .map(|(cost, row)| (*cost, self.encoding.plan(problem, row)))
            .collect();
        if let Some((plan, cost)) = &self.baseline {
            use pf_core::Cost;
            if !all.iter().any(|(other, _)| other.no_worse_than(cost)) {
                all.retain(|(other, _)| !cost.no_worse_than(other));
                all.push((*cost, plan.clone()));
            }
        }
        all.sort_by(|(a, _), (b, _)| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        let (costs, plans): (Vec<_>, Vec<_>) = all.into_iter().unzip();
        (!plans.is_empty()).then(|| Solved {
            solution: Front::unchecked(plans),
            cost: Front::unchecked(costs),
        })
    }

    /// Tells a listener of the front if it changed.
    pub(crate) fn announce(&mut self, problem: &TeamProblem, cx: &mut Cx<'_>) {
        if !self.news {
            return;
        }
        self.news = false;
        cx.improved(|| {
            self.front(problem).unwrap_or_else(|| Solved {
                solution: Front::default(),
                cost: Front::default(),
            })
        });
    }
}

impl Common {
    /// How rows begin.
    pub(crate) fn start(&self) -> Start {
        if self.fan > 0.0 {
            Start::Fan(self.fan, self.noise)
        } else {
            Start::Uniform
        }
    }
}
