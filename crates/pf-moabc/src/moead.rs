//! Zhang and Li 2007: *MOEA/D: A Multiobjective Evolutionary Algorithm Based on Decomposition*, with
//! the moves of Li and Zhang 2009.

use crate::{
    dice::Dice,
    evolution::{Strategy, evolution},
    genetic::mutate,
    hive::{Hive, Rows},
    params::{Common, MoeadParams},
};
use pf_core::{Context, PlanRng};
use pf_geom::{Mark, Objectives, TeamProblem};
use rand::{RngExt, seq::SliceRandom};

evolution! {
    /// Decomposition: each member of the population has a direction of its own in the space of
    /// objectives, and learns from those with similar ones. One iteration is one child for each
    /// member; there are as many members as directions fit evenly, at most the population.
    Moead, Directions, MoeadParams
}

/// How many children are made before any of them takes a place: what threads share.
const BATCH: usize = 32;

#[derive(Clone, Debug)]
pub(crate) struct Directions {
    params: MoeadParams,
    weights: Vec<Objectives>,
    /// By member: the nearest directions, its own first.
    near: Vec<u32>,
    /// The least and the largest of each objective.
    ideal: Objectives,
    nadir: Objectives,
    pool: Vec<u32>,
}

impl Directions {
    pub(crate) fn new(params: MoeadParams) -> Self {
        let weights = lattice(params.population);
        let near = neighbours(&weights, params.neighbours);
        Self {
            params,
            weights,
            near,
            ideal: [f64::INFINITY; 3],
            nadir: [f64::INFINITY; 3],
            pool: Vec::new(),
        }
    }

    fn near(&self, i: usize) -> &[u32] {
        let count = self.params.neighbours.min(self.weights.len());
        &self.near[i * count..(i + 1) * count]
    }

    /// Whether a child of a number has all others as neighbours, and the rest of its chance.
    fn roams(&self, dice: Dice, number: usize) -> (bool, PlanRng) {
        let mut rng = dice.of(number);
        (!rng.random_bool(self.params.local), rng)
    }

    /// Differential evolution: a member moved by the difference of two others.
    fn child(&self, nest: &Rows, dice: Dice, number: usize, row: &mut [f64]) {
        let (roams, mut rng) = self.roams(dice, number);
        let near = self.near(number);
        let mut other = || {
            if roams {
                rng.random_range(0..nest.len())
            } else {
                near[rng.random_range(0..near.len())] as usize
            }
        };
        let (a, b) = (nest.row(other()), nest.row(other()));
        let own = nest.row(number);
        for (k, gene) in row.iter_mut().enumerate() {
            *gene = own[k] + self.params.scale * (a[k] - b[k]);
        }
    }

    /// Tchebycheff: the largest weighted distance to the ideal.
    fn value(&self, objectives: &Objectives, direction: usize) -> f64 {
        let weights = &self.weights[direction];
        let far = |k: usize| {
            let range = (self.nadir[k] - self.ideal[k]).max(1e-12);
            weights[k] * (objectives[k] - self.ideal[k]) / range
        };
        far(0).max(far(1)).max(far(2))
    }

    fn better(&self, a: &Mark, b: &Mark, direction: usize) -> bool {
        match (a.excess > 0.0, b.excess > 0.0) {
            (false, false) => {
                self.value(&a.objectives, direction) < self.value(&b.objectives, direction)
            }
            (false, true) => true,
            (true, false) => false,
            (true, true) => a.excess < b.excess,
        }
    }

    fn measure(&mut self, nest: &Rows) {
        self.nadir = [f64::NEG_INFINITY; 3];
        for mark in nest.marks.iter().filter(|mark| mark.excess <= 0.0) {
            for k in 0..3 {
                self.ideal[k] = self.ideal[k].min(mark.objectives[k]);
                self.nadir[k] = self.nadir[k].max(mark.objectives[k]);
            }
        }
    }

    /// Lets a child take the places of a few it is better than.
    fn place(&mut self, hive: &mut Hive, child: usize, dice: Dice) {
        let mark = hive.brood.marks[child];
        if mark.excess <= 0.0 {
            for k in 0..3 {
                self.ideal[k] = self.ideal[k].min(mark.objectives[k]);
            }
        }
        let (roams, _) = self.roams(dice, child);
        let mut pool = std::mem::take(&mut self.pool);
        pool.clear();
        if roams {
            #[expect(clippy::cast_possible_truncation, reason = "numbers of members")]
            pool.extend(0..hive.nest.len() as u32);
        } else {
            pool.extend_from_slice(self.near(child));
        }
        pool.shuffle(&mut dice.of(usize::MAX - child));
        let mut left = self.params.replaced;
        for &i in &pool {
            let i = i as usize;
            if left > 0 && self.better(&mark, &hive.nest.marks[i], i) {
                hive.nest.replace(i, &hive.brood, child);
                left -= 1;
            }
        }
        self.pool = pool;
    }
}

/// Directions spread evenly over the simplex, as many as there are in a lattice, at most `most`.
fn lattice(most: usize) -> Vec<Objectives> {
    let fits = |h: &usize| (h + 1) * (h + 2) / 2 <= most;
    let h = (1..=most).take_while(fits).last().unwrap_or(1);
    #[expect(clippy::cast_precision_loss, reason = "small numbers")]
    let part = |n: usize| (n as f64 / h as f64).max(1e-4);
    let rows = (0..=h).flat_map(|i| (0..=h - i).map(move |j| (i, j)));
    rows.map(|(i, j)| [part(i), part(j), part(h - i - j)])
        .collect()
}

#[expect(clippy::cast_possible_truncation, reason = "numbers of members")]
fn neighbours(weights: &[Objectives], count: usize) -> Vec<u32> {
    let mut near = Vec::new();
    for own in weights {
        let far = |i: u32| -> f64 {
            let other = &weights[i as usize];
            own.iter().zip(other).map(|(a, b)| (a - b) * (a - b)).sum()
        };
        let mut order: Vec<u32> = (0..weights.len() as u32).collect();
        order.sort_by(|&a, &b| far(a).total_cmp(&far(b)));
        near.extend_from_slice(&order[..count.min(order.len())]);
    }
    near
}

impl Strategy for Directions {
    fn name(&self) -> &'static str {
        "MOEA/D"
    }

    fn common(&self) -> Common {
        self.params.common()
    }

    fn size(&self) -> usize {
        self.weights.len()
    }

    /// Members take the directions they are best at, one after the other.
    fn begin(&mut self, hive: &mut Hive) {
        self.ideal = [f64::INFINITY; 3];
        self.measure(&hive.nest);
        let mut free: Vec<usize> = (0..hive.nest.len()).collect();
        let mut order = hive.nest.clone();
        for direction in 0..hive.nest.len() {
            let marks = &hive.nest.marks;
            let best = (1..free.len()).fold(0, |best, i| {
                let better = self.better(&marks[free[i]], &marks[free[best]], direction);
                if better { i } else { best }
            });
            order.replace(direction, &hive.nest, free.swap_remove(best));
        }
        hive.nest = order;
    }

    fn cycle(&mut self, hive: &mut Hive, problem: &TeamProblem, cx: &mut Context<'_, TeamProblem>) {
        let (count, encoding) = (hive.nest.len(), hive.encoding.clone());
        #[expect(clippy::cast_precision_loss, reason = "a number of numbers")]
        let one = 1.0 / hive.nest.width.max(1) as f64;
        let rate = if self.params.mutation > 0.0 {
            self.params.mutation
        } else {
            one
        };
        let (common, index) = (self.params.common(), self.params.mutation_index);
        // Without a whole population there are no neighbours.
        let mut done = if count < self.weights.len() { count } else { 0 };
        while done < count {
            let batch = BATCH.min(count - done);
            hive.breed(problem, &common, cx, batch, &|nest, dice, number, row| {
                self.child(nest, dice, number, row);
                encoding.clamp(row);
                mutate(
                    &encoding,
                    row,
                    rate,
                    index,
                    &mut dice.of(number + usize::MAX / 2),
                );
            });
            let dice = hive.dice();
            self.measure(&hive.nest);
            for child in done..hive.brood.len() {
                self.place(hive, child, dice);
            }
            done += batch;
        }
    }
}
