//! The algorithm the paper starts from (Section II): bees update sources as they go, and an external
//! archive, sorted anew after each of them, leads the onlookers.

use super::{Bees, visit};
use crate::{
    hive::{Hive, Rows},
    sort::beats,
};
use pf_core::Context;
use pf_geom::TeamProblem;
use rand::RngExt;

impl Bees {
    /// One cycle: an employed bee to each source, as many onlookers to members of the archive.
    pub(super) fn go(
        &mut self,
        hive: &mut Hive,
        problem: &TeamProblem,
        cx: &mut Context<'_, TeamProblem>,
    ) {
        let count = hive.nest.len();
        if self.elite.len() == 0 {
            self.elite.clone_from(&hive.nest);
            self.sort_elite(count);
        }
        let (common, share) = (self.params.common(), self.params.share);
        for bee in 0..2 * count {
            let source = bee % count;
            let leader = (bee >= count).then(|| {
                let chosen = hive
                    .dice()
                    .of(usize::MAX / 2 - bee)
                    .random_range(0..self.elite.len());
                self.elite.row(chosen)
            });
            hive.breed(problem, &common, cx, 1, &|nest, dice, number, row| {
                visit(nest, source, leader, share, &mut dice.of(number), row);
            });
            if hive.brood.len() <= bee {
                return;
            }
            let mark = hive.brood.marks[bee];
            if beats(&mark, &hive.nest.marks[source]) {
                hive.nest.replace(source, &hive.brood, bee);
                self.trials[source] = 0;
            } else {
                self.trials[source] += 1;
            }
            self.elite.genes.extend_from_slice(hive.brood.row(bee));
            self.elite.marks.push(mark);
            self.sort_elite(count);
        }
    }

    /// Keeps the archive's first front, at most so many, those with the most room.
    fn sort_elite(&mut self, most: usize) {
        self.sorter.sort(&self.elite.marks);
        let order = self.sorter.order.iter().map(|&i| i as usize);
        let first = order.take_while(|&i| self.sorter.rank[i] == 0).take(most);
        let mut kept = Rows::default();
        kept.clear(self.elite.width);
        for i in first {
            kept.genes.extend_from_slice(self.elite.row(i));
            kept.marks.push(self.elite.marks[i]);
        }
        self.elite = kept;
    }
}
