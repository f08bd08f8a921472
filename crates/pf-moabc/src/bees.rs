//! Wang, Li, Dou, Li, Zhao, Li: *A Novel Multi-objective Artificial Bee Colony Algorithm for
//! Multi-robot Path Planning*.

mod classic;

use crate::{
    evolution::{Strategy, evolution},
    hive::{Hive, Rows},
    params::{Common, MoabcParams, Rules},
    sort::Sorter,
};
use pf_core::{Context, PlanRng};
use pf_geom::TeamProblem;
use rand::RngExt;

evolution! {
    /// Bees: sources of food are plans. In each cycle sources that failed too often go to scouts;
    /// one employed bee a source and as many onlookers, who prefer better ones, try a plan near by;
    /// then the best of all three are kept. One iteration is one cycle: two evaluations for each
    /// source.
    Moabc, Bees, MoabcParams
}

#[derive(Clone, Debug)]
pub(crate) struct Bees {
    params: MoabcParams,
    /// By source: how often nothing better was found near it.
    trials: Vec<u32>,
    /// By source: its front, and the sum of the onlookers' chances up to it.
    ranks: Vec<u32>,
    chances: Vec<f64>,
    /// By bee: its source.
    sources: Vec<u32>,
    fruitful: Vec<bool>,
    before: Vec<u32>,
    /// The external archive of the classic rules.
    elite: Rows,
    sorter: Sorter,
}

impl Bees {
    pub(crate) fn new(params: MoabcParams) -> Self {
        Self {
            params,
            trials: Vec::new(),
            ranks: Vec::new(),
            chances: Vec::new(),
            sources: Vec::new(),
            fruitful: Vec::new(),
            before: Vec::new(),
            elite: Rows::default(),
            sorter: Sorter::default(),
        }
    }

    /// Takes note of the ranks of what was kept.
    fn note_ranks(&mut self, hive: &Hive) {
        let kept = &hive.sorter.order[..hive.nest.len()];
        self.ranks.clear();
        self.ranks
            .extend(kept.iter().map(|&i| hive.sorter.rank[i as usize]));
        let mut sum = 0.0;
        self.chances.clear();
        self.chances.extend(self.ranks.iter().map(|&rank| {
            sum += 1.0 / (1.0 + f64::from(rank));
            sum
        }));
    }

    /// Sources that failed too often are looked for anew.
    fn scout(&mut self, hive: &mut Hive, problem: &TeamProblem, cx: &mut Context<'_, TeamProblem>) {
        let spares_first = self.params.rules == Rules::Ours;
        let given_up: Vec<usize> = (0..hive.nest.len())
            .filter(|&i| self.trials[i] > self.params.limit)
            .filter(|&i| !spares_first || self.ranks[i] > 0)
            .collect();
        if given_up.is_empty() {
            return;
        }
        let common = self.params.common();
        let (encoding, start) = (hive.encoding.clone(), common.start());
        hive.breed(
            problem,
            &common,
            cx,
            given_up.len(),
            &|_, dice, number, row| {
                // Numbers that no bee has.
                encoding.draw(start, &mut dice.of(usize::MAX - number), row);
            },
        );
        for (child, &source) in given_up[..hive.brood.len()].iter().enumerate() {
            hive.nest.replace(source, &hive.brood, child);
            self.trials[source] = 0;
        }
        hive.brood.clear(hive.nest.width);
    }

    /// Sends every bee to a source: an employed one to each, onlookers by chance, of two the one
    /// with more room around it.
    fn assign(&mut self, hive: &Hive) {
        let count = hive.nest.len();
        let mut rng = hive.dice().of(usize::MAX / 2);
        let total = self.chances.last().copied().unwrap_or(1.0);
        self.sources.clear();
        #[expect(clippy::cast_possible_truncation, reason = "numbers of sources")]
        self.sources.extend(0..count as u32);
        for _ in 0..count {
            let spin = rng.random_range(0.0..total);
            let source = self.chances.partition_point(|&sum| sum <= spin);
            #[expect(clippy::cast_possible_truncation, reason = "numbers of sources")]
            self.sources.push(source.min(count - 1) as u32);
        }
    }
}

/// A plan near a source: on a share of the numbers a step towards another one or away from it
/// (eq. 3). Onlookers of the classic rules are led by a plan in place of their source.
fn visit(
    nest: &Rows,
    source: usize,
    leader: Option<&[f64]>,
    share: f64,
    rng: &mut PlanRng,
    row: &mut [f64],
) {
    row.copy_from_slice(leader.unwrap_or_else(|| nest.row(source)));
    let mut other = rng.random_range(0..nest.len() - 1);
    other += usize::from(other >= source);
    let other = nest.row(other);
    let certain = rng.random_range(0..row.len());
    for (k, (gene, theirs)) in row.iter_mut().zip(other).enumerate() {
        if k == certain || rng.random_bool(share) {
            *gene += rng.random_range(-1.0..=1.0) * (*gene - theirs);
        }
    }
}

impl Strategy for Bees {
    fn name(&self) -> &'static str {
        "MOABC"
    }

    fn common(&self) -> Common {
        self.params.common()
    }

    fn begin(&mut self, hive: &mut Hive) {
        let count = hive.nest.len();
        hive.keep_best(count);
        self.elite.clear(hive.nest.width);
        self.trials.clear();
        self.trials.resize(count, 0);
        self.note_ranks(hive);
    }

    fn cycle(&mut self, hive: &mut Hive, problem: &TeamProblem, cx: &mut Context<'_, TeamProblem>) {
        let count = hive.nest.len();
        if count < 2 {
            return;
        }
        self.scout(hive, problem, cx);
        if self.params.rules == Rules::Classic {
            self.go(hive, problem, cx);
            return;
        }
        self.assign(hive);
        let (sources, share) = (&self.sources, self.params.share);
        // Ours: every other bee of a team changes the way of one robot only.
        let single = self.params.rules == Rules::Ours && hive.encoding.robots() > 1;
        let (encoding, mending) = (hive.encoding.clone(), self.params.mending);
        hive.breed(
            problem,
            &self.params.common(),
            cx,
            2 * count,
            &|nest, dice, bee, row| {
                let source = sources[bee] as usize;
                let rng = &mut dice.of(bee);
                visit(nest, source, None, share, rng, row);
                if single && rng.random_bool(0.5) {
                    encoding.keep_one(rng, nest.row(source), row);
                }
                if mending > 0.0 && rng.random_bool(mending) {
                    encoding.straighten(rng, row);
                }
            },
        );
        hive.keep_best(count);
        self.fruitful.clear();
        self.fruitful.resize(count, false);
        let kept = &hive.sorter.order[..count];
        for bee in kept.iter().filter_map(|&i| (i as usize).checked_sub(count)) {
            self.fruitful[self.sources[bee] as usize] = true;
        }
        std::mem::swap(&mut self.trials, &mut self.before);
        self.trials.clear();
        for &i in kept {
            let i = i as usize;
            let old = i < count && !self.fruitful[i];
            self.trials.push(if old { self.before[i] + 1 } else { 0 });
        }
        self.note_ranks(hive);
    }
}
