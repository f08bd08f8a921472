//! What L-BFGS remembers, and the direction it takes (two-loop recursion, Nocedal 1980).

/// Pairs of steps and changes of the gradient, the oldest first to be forgotten.
#[derive(Clone, Debug, Default)]
pub(crate) struct Memory {
    size: usize,
    capacity: usize,
    /// The pairs' steps one after the other, in a ring; their gradients' changes alike.
    steps: Vec<f64>,
    changes: Vec<f64>,
    /// One over the product of both.
    rho: Vec<f64>,
    alpha: Vec<f64>,
    pairs: usize,
    newest: usize,
}

impl Memory {
    /// Forgets everything; from now on for `size` variables and `capacity` pairs.
    pub(crate) fn reset(&mut self, size: usize, capacity: usize) {
        (self.size, self.capacity, self.pairs, self.newest) = (size, capacity, 0, 0);
        self.steps.resize(size * capacity, 0.0);
        self.changes.resize(size * capacity, 0.0);
        self.rho.resize(capacity, 0.0);
        self.alpha.resize(capacity, 0.0);
    }

    /// Keeps a pair if its product is more than 1e-10: the step that led to the path `to` from
    /// `from`, and the gradients there.
    pub(crate) fn keep(&mut self, from: &[f64], to: &[f64], before: &[f64], after: &[f64]) {
        if self.capacity == 0 {
            return;
        }
        let next = if self.pairs == 0 {
            0
        } else {
            (self.newest + 1) % self.capacity
        };
        let range = next * self.size..(next + 1) * self.size;
        // Only written where the oldest pair is forgotten anyway, or where there was none.
        let product: f64 = (0..self.size)
            .map(|k| (to[k] - from[k]) * (after[k] - before[k]))
            .sum();
        if product <= 1e-10 {
            return;
        }
        for (k, step) in self.steps[range.clone()].iter_mut().enumerate() {
            *step = to[k] - from[k];
        }
        for (k, change) in self.changes[range].iter_mut().enumerate() {
            *change = after[k] - before[k];
        }
        self.rho[next] = 1.0 / product;
        self.newest = next;
        self.pairs = (self.pairs + 1).min(self.capacity);
    }

    /// The direction for a gradient: minus the estimated inverse of the second derivatives times it.
    pub(crate) fn direction(&mut self, gradient: &[f64], direction: &mut [f64]) {
        for (d, g) in direction.iter_mut().zip(gradient) {
            *d = -g;
        }
        let (size, capacity) = (self.size, self.capacity);
        let place = |age: usize, newest: usize| (newest + capacity - age) % capacity;
        for age in 0..self.pairs {
            let at = place(age, self.newest);
            let step = &self.steps[at * size..(at + 1) * size];
            let change = &self.changes[at * size..(at + 1) * size];
            let alpha = self.rho[at] * dot(step, direction);
            self.alpha[at] = alpha;
            for (d, c) in direction.iter_mut().zip(change) {
                *d -= alpha * c;
            }
        }
        if self.pairs > 0 {
            let change = &self.changes[self.newest * size..(self.newest + 1) * size];
            let scale = 1.0 / (self.rho[self.newest] * dot(change, change));
            for d in direction.iter_mut() {
                *d *= scale;
            }
        }
        for age in (0..self.pairs).rev() {
            let at = place(age, self.newest);
            let step = &self.steps[at * size..(at + 1) * size];
            let change = &self.changes[at * size..(at + 1) * size];
            let beta = self.rho[at] * dot(change, direction);
            let by = self.alpha[at] - beta;
            for (d, s) in direction.iter_mut().zip(step) {
                *d += by * s;
            }
        }
    }
}

pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    // Four sums, which need not wait for each other.
    let mut sums = [0.0; 4];
    let (a4, b4) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = a4
        .remainder()
        .iter()
        .zip(b4.remainder())
        .map(|(a, b)| a * b)
        .sum();
    for (a, b) in a4.zip(b4) {
        for k in 0..4 {
            sums[k] += a[k] * b[k];
        }
    }
    sums.iter().sum::<f64>() + rest
}
