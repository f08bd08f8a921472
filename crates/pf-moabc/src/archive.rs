//! The front that is reported: apart from the population, so that it only gets better.

use pf_core::Cost;
use pf_geom::Objectives;

/// Plans none of which dominates another, with the rows they come from.
#[derive(Clone, Debug, Default)]
pub(crate) struct Archive {
    width: usize,
    most: usize,
    genes: Vec<f64>,
    objectives: Vec<Objectives>,
    /// The member that turned away the last plan: it probably turns away the next.
    gate: usize,
}

impl Archive {
    /// Empties it, for rows of a width, `most` at most.
    pub(crate) fn clear(&mut self, width: usize, most: usize) {
        self.width = width;
        self.most = most;
        self.genes.clear();
        self.objectives.clear();
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.objectives.is_empty()
    }

    /// Members with their rows.
    pub(crate) fn members(&self) -> impl Iterator<Item = (&Objectives, &[f64])> {
        self.objectives
            .iter()
            .zip(self.genes.chunks_exact(self.width.max(1)))
    }

    /// Whether a plan like this would be let in: nobody is as good, and there is room or it takes
    /// the place of others.
    fn lets_in(&mut self, objectives: &Objectives) -> bool {
        if let Some(gate) = self.objectives.get(self.gate)
            && gate.no_worse_than(objectives)
        {
            return false;
        }
        let as_good = self
            .objectives
            .iter()
            .position(|member| member.no_worse_than(objectives));
        if let Some(as_good) = as_good {
            self.gate = as_good;
            return false;
        }
        true
    }

    /// Lets a plan in unless one that is there is as good, and turns out those it dominates. Once it
    /// is full only plans that dominate one are let in: a member never goes for less than a better
    /// one. Says whether it was let in.
    pub(crate) fn offer(&mut self, objectives: &Objectives, genes: &[f64]) -> bool {
        if !self.lets_in(objectives) {
            return false;
        }
        let before = self.objectives.len();
        let mut i = 0;
        while i < self.objectives.len() {
            if objectives.no_worse_than(&self.objectives[i]) {
                self.drop(i);
            } else {
                i += 1;
            }
        }
        if before >= self.most && self.objectives.len() == before {
            return false;
        }
        self.objectives.push(*objectives);
        self.genes.extend_from_slice(genes);
        true
    }

    /// The last member takes the place of this one.
    fn drop(&mut self, i: usize) {
        let last = self.objectives.len() - 1;
        self.objectives.swap_remove(i);
        let from = last * self.width;
        self.genes
            .copy_within(from..from + self.width, i * self.width);
        self.genes.truncate(from);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pf_core::{Front, PlanRng};
    use rand::{RngExt, SeedableRng};

    #[test]
    fn it_only_gets_better_and_keeps_rows_with_their_objectives() {
        let mut rng = PlanRng::seed_from_u64(2);
        let mut archive = Archive::default();
        for most in [1, 5, 1000] {
            archive.clear(3, most);
            let mut before: Front<Objectives> = Front::default();
            let mut all = before.clone();
            for _ in 0..2000 {
                let one: Objectives = std::array::from_fn(|_| rng.random_range(0..60).into());
                archive.offer(&one, &one);
                all.offer(one, Objectives::clone);
                let now: Vec<_> = archive.members().map(|(o, _)| *o).collect();
                assert!(archive.members().all(|(o, row)| o.as_slice() == row));
                assert!(now.len() <= most);
                let now = Front::unchecked(now);
                assert!(now.no_worse_than(&before));
                before = now;
            }
            let undominated: Front<Objectives> = before.members().iter().copied().collect();
            assert_eq!(undominated.members().len(), before.members().len());
            if most == 1000 {
                assert!(before.same_as(&all));
            }
        }
    }
}
