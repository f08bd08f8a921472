use crate::Layout;

/// For each cell the weights by which a walker chooses among the eight directions.
///
/// Weights are kept summed up, so that a choice is one comparison with each of eight numbers.
#[derive(Clone, Debug, Default)]
pub struct Chances {
    rows: Vec<[f32; 8]>,
}

impl Chances {
    /// No way from anywhere.
    pub fn reset(&mut self, layout: &Layout) {
        self.rows.clear();
        self.rows.resize(layout.len(), [0.0; 8]);
    }

    /// Sets the weights of the directions from `id`: not negative, finite, 0 for never. They are
    /// scaled to the greatest, so those less than its 2^-24th are as good as none.
    pub fn set(&mut self, id: u32, weights: &[f64; 8]) {
        let most = weights.iter().copied().fold(0.0, f64::max);
        let row = &mut self.rows[id as usize];
        *row = [0.0; 8];
        if most <= 0.0 {
            return;
        }
        let scale = 1.0 / most;
        let mut sum = 0.0;
        for (sums, weight) in row.iter_mut().zip(weights) {
            #[expect(
                clippy::cast_possible_truncation,
                reason = "chances are drawn from 24 bits"
            )]
            {
                sum += (weight * scale) as f32;
            }
            *sums = sum;
        }
    }

    /// The direction that a number from 0 to 1, 1 excluded, stands for; none if all weights are 0.
    #[inline]
    #[must_use]
    pub fn pick(&self, id: u32, chance: f32) -> Option<u32> {
        let row = &self.rows[id as usize];
        // A product of a number below 1 and the total is rounded to less than the total.
        let mark = chance * row[7];
        let k: u32 = row.iter().map(|&sum| u32::from(mark >= sum)).sum();
        (k < 8).then_some(k)
    }

    /// As [`pick`](Self::pick), among the directions of a set alone.
    #[inline]
    #[must_use]
    pub fn pick_among(&self, id: u32, set: u8, chance: f32) -> Option<u32> {
        let row = &self.rows[id as usize];
        let mut weights = [0.0; 8];
        let (mut before, mut total) = (0.0, 0.0);
        for (k, sum) in row.iter().enumerate() {
            if set >> k & 1 == 1 {
                weights[k] = sum - before;
                total += weights[k];
            }
            before = *sum;
        }
        let mut left = chance * total;
        let mut last = None;
        for (k, weight) in (0..8).zip(weights) {
            if weight > 0.0 {
                last = Some(k);
                if left < weight {
                    break;
                }
                left -= weight;
            }
        }
        last
    }

    /// Bytes held.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.rows.capacity() * size_of::<[f32; 8]>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_picked_by_their_weights() {
        let mut chances = Chances::default();
        chances.reset(&Layout::new(1, 1));
        chances.set(3, &[0.0, 1.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.0]);
        let picks = |chance| chances.pick(3, chance);
        assert_eq!(picks(0.0), Some(1));
        assert_eq!(picks(0.249), Some(1));
        assert_eq!(picks(0.251), Some(3));
        assert_eq!(picks(1.0 - f32::EPSILON / 2.0), Some(3));
        assert_eq!(chances.pick(4, 0.5), None);
    }

    #[test]
    fn among_fewer_directions_the_others_do_not_count() {
        let mut chances = Chances::default();
        chances.reset(&Layout::new(1, 1));
        chances.set(3, &[4.0, 1.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.0]);
        let picks = |set, chance| chances.pick_among(3, set, chance);
        assert_eq!(picks(0b1010, 0.2), Some(1));
        assert_eq!(picks(0b1010, 0.3), Some(3));
        assert_eq!(picks(0b0101, 0.999), Some(0));
        assert_eq!(picks(0b0100, 0.5), None);
    }
}
