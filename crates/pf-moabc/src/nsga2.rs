//! Deb, Pratap, Agarwal, Meyarivan 2002: *A fast and elitist multiobjective genetic algorithm*.

use crate::{
    dice::Dice,
    evolution::{Strategy, evolution},
    genetic::{cross, mutate},
    hive::Hive,
    params::{Common, Nsga2Params},
};
use pf_core::{Context, PlanRng};
use pf_geom::TeamProblem;
use rand::RngExt;

evolution! {
    /// The genetic algorithm that most others are compared with. One iteration is one generation:
    /// an evaluation for each member of the population.
    Nsga2, Genes, Nsga2Params
}

#[derive(Clone, Debug)]
pub(crate) struct Genes {
    params: Nsga2Params,
}

impl Genes {
    pub(crate) fn new(params: Nsga2Params) -> Self {
        Self { params }
    }
}

/// The generator that the two children of a pair share.
fn of_pair(dice: Dice, number: usize) -> PlanRng {
    dice.of(usize::MAX - number / 2)
}

/// The better of two: members are in the order of their ranks and crowding.
fn tournament(count: usize, rng: &mut PlanRng) -> usize {
    rng.random_range(0..count).min(rng.random_range(0..count))
}

impl Strategy for Genes {
    fn name(&self) -> &'static str {
        "NSGA-II"
    }

    fn common(&self) -> Common {
        self.params.common()
    }

    fn begin(&mut self, hive: &mut Hive) {
        hive.keep_best(hive.nest.len());
    }

    fn cycle(&mut self, hive: &mut Hive, problem: &TeamProblem, cx: &mut Context<'_, TeamProblem>) {
        let (count, encoding) = (hive.nest.len(), hive.encoding.clone());
        if count == 0 {
            return;
        }
        let params = &self.params;
        #[expect(clippy::cast_precision_loss, reason = "a number of numbers")]
        let one = 1.0 / hive.nest.width.max(1) as f64;
        let rate = if params.mutation > 0.0 {
            params.mutation
        } else {
            one
        };
        hive.breed(
            problem,
            &params.common(),
            cx,
            count,
            &|nest, dice, number, row| {
                let pair = &mut of_pair(dice, number);
                let (a, b) = (tournament(count, pair), tournament(count, pair));
                let (a, b, second) = (nest.row(a), nest.row(b), number % 2 == 1);
                if pair.random_bool(params.crossover) {
                    cross(a, b, second, params.crossover_index, pair, row);
                } else {
                    row.copy_from_slice(if second { b } else { a });
                }
                encoding.clamp(row);
                mutate(
                    &encoding,
                    row,
                    rate,
                    params.mutation_index,
                    &mut dice.of(number),
                );
            },
        );
        hive.keep_best(count);
    }
}
