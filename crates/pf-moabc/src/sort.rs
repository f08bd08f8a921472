//! Which is better: constrained domination, ranks and crowding.

use pf_core::Cost;
use pf_geom::{Mark, Objectives};

/// Sorts marks by constrained domination (Deb 2000: what is feasible beats what is not; of two that
/// are not, the one nearer to it; of two that are, the one that dominates), rank and crowding. Keeps
/// its lists from call to call.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sorter {
    /// By member: 0 for those that nobody beats.
    pub(crate) rank: Vec<u32>,
    /// By member: how much room it has in its front, more for a rarer one.
    pub(crate) crowding: Vec<f64>,
    /// All members, the best first.
    pub(crate) order: Vec<u32>,
    /// By front: the second and third objectives of those met so far that no other of them beats in
    /// both, by the second ascending and so by the third descending.
    stairs: Vec<Vec<[f64; 2]>>,
    group: Vec<u32>,
}

impl Sorter {
    /// Ranks members, measures their crowding and orders them by both.
    pub(crate) fn sort(&mut self, marks: &[Mark]) {
        self.rank(marks);
        self.crowd(marks);
        let Self {
            rank,
            crowding,
            order,
            ..
        } = self;
        order.sort_unstable_by(|&a, &b| {
            let (a, b) = (a as usize, b as usize);
            let by_room = || crowding[b].total_cmp(&crowding[a]);
            rank[a].cmp(&rank[b]).then_with(by_room).then(a.cmp(&b))
        });
    }

    /// Non-dominated sorting. In the order of the first objective nothing that comes later beats
    /// what came before, so two objectives are left; their stairs answer by bisection whether a
    /// front beats a newcomer, and so does bisection over the fronts, as what a front beats every
    /// front before it does (after Kung, Luccio, Preparata 1975; Zhang et al. 2015). O(n log^2 n)
    /// but for moving stairs in memory.
    #[expect(clippy::cast_possible_truncation, reason = "numbers of members")]
    fn rank(&mut self, marks: &[Mark]) {
        let Self {
            rank,
            order,
            stairs,
            ..
        } = self;
        rank.clear();
        rank.resize(marks.len(), 0);
        order.clear();
        order.extend(0..marks.len() as u32);
        order.sort_unstable_by(|&a, &b| {
            let (x, y) = (&marks[a as usize], &marks[b as usize]);
            let objectives = || lexicographic(&x.objectives, &y.objectives);
            match (x.excess > 0.0, y.excess > 0.0) {
                (false, false) => objectives().then(a.cmp(&b)),
                _ => x.excess.total_cmp(&y.excess).then(a.cmp(&b)),
            }
        });
        let mut fronts = 0;
        let mut last: Option<usize> = None;
        for &member in order.iter() {
            let (member, mark) = (member as usize, &marks[member as usize]);
            let twin = last.filter(|&last| same(&marks[last], mark));
            last = Some(member);
            if let Some(twin) = twin {
                rank[member] = rank[twin];
                continue;
            }
            if mark.excess > 0.0 {
                rank[member] = fronts as u32;
                fronts += 1;
                continue;
            }
            let [_, y, z] = mark.objectives;
            let front = stairs[..fronts].partition_point(|stairs| {
                let before = stairs.partition_point(|step| step[0] <= y);
                before > 0 && stairs[before - 1][1] <= z
            });
            if front == fronts {
                fronts += 1;
                if stairs.len() < fronts {
                    stairs.push(Vec::new());
                }
                stairs[front].clear();
            }
            let stairs = &mut stairs[front];
            let from = stairs.partition_point(|step| step[0] < y);
            let beaten = stairs[from..].partition_point(|step| step[1] >= z);
            stairs.splice(from..from + beaten, [[y, z]]);
            rank[member] = front as u32;
        }
    }

    /// Crowding (Deb et al. 2002), each objective by its range in the front (Wang et al., eq. 6, as
    /// it is meant).
    fn crowd(&mut self, marks: &[Mark]) {
        let Self {
            rank,
            crowding,
            order,
            group,
            ..
        } = self;
        crowding.clear();
        crowding.resize(marks.len(), 0.0);
        order.sort_unstable_by_key(|&member| (rank[member as usize], member));
        for front in order.chunk_by(|&a, &b| rank[a as usize] == rank[b as usize]) {
            group.clear();
            group.extend_from_slice(front);
            for k in 0..3 {
                let value = |member: u32| marks[member as usize].objectives[k];
                group.sort_unstable_by(|&a, &b| value(a).total_cmp(&value(b)).then(a.cmp(&b)));
                let (first, last) = (group[0], group[group.len() - 1]);
                let range = value(last) - value(first);
                crowding[first as usize] = f64::INFINITY;
                crowding[last as usize] = f64::INFINITY;
                if range > 0.0 {
                    for three in group.windows(3) {
                        crowding[three[1] as usize] += (value(three[2]) - value(three[0])) / range;
                    }
                }
            }
        }
    }
}

/// Constrained domination of one by another.
pub(crate) fn beats(a: &Mark, b: &Mark) -> bool {
    match (a.excess > 0.0, b.excess > 0.0) {
        (false, false) => a.objectives.beats(&b.objectives),
        (false, true) => true,
        (true, false) => false,
        (true, true) => a.excess < b.excess,
    }
}

fn lexicographic(a: &Objectives, b: &Objectives) -> std::cmp::Ordering {
    let by = |k: usize| a[k].total_cmp(&b[k]);
    by(0).then_with(|| by(1)).then_with(|| by(2))
}

/// Whether neither can beat the other for being as good.
fn same(a: &Mark, b: &Mark) -> bool {
    let equal = |x: f64, y: f64| x.total_cmp(&y).is_eq();
    if a.excess > 0.0 || b.excess > 0.0 {
        return equal(a.excess, b.excess);
    }
    (0..3).all(|k| equal(a.objectives[k], b.objectives[k]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use pf_core::PlanRng;
    use rand::{RngExt, SeedableRng};

    /// By definition: the fronts are peeled off one after the other.
    fn peeled(marks: &[Mark]) -> Vec<u32> {
        let mut rank = vec![u32::MAX; marks.len()];
        for front in 0.. {
            let left: Vec<_> = (0..marks.len()).filter(|&i| rank[i] == u32::MAX).collect();
            if left.is_empty() {
                return rank;
            }
            for &i in &left {
                if !left.iter().any(|&j| beats(&marks[j], &marks[i])) {
                    rank[i] = front;
                }
            }
        }
        rank
    }

    #[test]
    fn ranks_are_those_of_the_definition() {
        let mut rng = PlanRng::seed_from_u64(4);
        let mut sorter = Sorter::default();
        for round in 0..300 {
            // Few values, so that there are many ties and twins.
            let values = if round % 2 == 0 { 4 } else { 1000 };
            let mut value = || f64::from(rng.random_range(0..values));
            let mut marks = Vec::new();
            for i in 0..round {
                let objectives = [value(), value(), value()];
                let excess = if i % 5 == 0 { value() } else { 0.0 };
                marks.push(Mark { objectives, excess });
            }
            sorter.sort(&marks);
            assert_eq!(sorter.rank, peeled(&marks));
            let ranks: Vec<_> = sorter
                .order
                .iter()
                .map(|&i| sorter.rank[i as usize])
                .collect();
            assert!(ranks.is_sorted());
        }
    }
}
