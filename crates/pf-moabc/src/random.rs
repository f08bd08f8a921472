//! Plans drawn one after the other: what any algorithm must beat.

use crate::{
    evolution::{Strategy, evolution},
    hive::Hive,
    params::{Common, RandomSearchParams},
};
use pf_core::Context;
use pf_geom::TeamProblem;

evolution! {
    /// Draws plans as the others draw those they begin with. One iteration is as many as there are
    /// in a population.
    RandomSearch, Draws, RandomSearchParams
}

#[derive(Clone, Debug)]
pub(crate) struct Draws {
    params: RandomSearchParams,
}

impl Draws {
    pub(crate) fn new(params: RandomSearchParams) -> Self {
        Self { params }
    }
}

impl Strategy for Draws {
    fn name(&self) -> &'static str {
        "random search"
    }

    fn common(&self) -> Common {
        self.params.common()
    }

    fn begin(&mut self, _: &mut Hive) {}

    fn cycle(&mut self, hive: &mut Hive, problem: &TeamProblem, cx: &mut Context<'_, TeamProblem>) {
        let common = self.params.common();
        let (encoding, start) = (hive.encoding.clone(), common.start());
        hive.breed(
            problem,
            &common,
            cx,
            common.population,
            &|_, dice, number, row| {
                encoding.draw(start, &mut dice.of(number), row);
            },
        );
    }
}
