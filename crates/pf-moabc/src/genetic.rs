//! Operators of genetic algorithms on real numbers.

use crate::encoding::Encoding;
use pf_core::PlanRng;
use rand::RngExt;

/// Polynomial mutation (Deb and Goyal 1996): each number with a probability, more likely a little.
pub(crate) fn mutate(
    encoding: &Encoding,
    row: &mut [f64],
    probability: f64,
    index: f64,
    rng: &mut PlanRng,
) {
    let range = Encoding::range();
    for (k, gene) in row.iter_mut().enumerate() {
        if !rng.random_bool(probability) {
            continue;
        }
        let (low, u) = (encoding.least(k), rng.random::<f64>());
        let power = 1.0 / (index + 1.0);
        let below = 1.0 - ((*gene - low) / range).clamp(0.0, 1.0);
        let above = 1.0 - ((low + range - *gene) / range).clamp(0.0, 1.0);
        let delta = if u < 0.5 {
            let value = 2.0 * u + (1.0 - 2.0 * u) * libm::pow(below, index + 1.0);
            libm::pow(value, power) - 1.0
        } else {
            let value = 2.0 * (1.0 - u) + 2.0 * (u - 0.5) * libm::pow(above, index + 1.0);
            1.0 - libm::pow(value, power)
        };
        *gene += delta * range;
    }
}

/// A root, taken by square roots where they lead to it: a power takes several times as long, and an
/// index of 15 asks for the sixteenth.
#[derive(Clone, Copy, Debug)]
enum Root {
    Squares(u32),
    Power(f64),
}

impl Root {
    /// The root of this degree.
    fn new(degree: f64) -> Self {
        let exact = |&times: &u32| f64::from(1_u32 << times).total_cmp(&degree).is_eq();
        (0..=8)
            .find(exact)
            .map_or(Self::Power(1.0 / degree), Self::Squares)
    }

    #[inline]
    fn of(self, x: f64) -> f64 {
        match self {
            Self::Squares(times) => (0..times).fold(x, |x, _| x.sqrt()),
            Self::Power(power) => libm::pow(x, power),
        }
    }
}

/// Simulated binary crossover (Deb and Agrawal 1995): half the numbers of two parents become two
/// with the same mean; `row` gets those of one child, the parent's or the other's side by `second`.
pub(crate) fn cross(
    a: &[f64],
    b: &[f64],
    second: bool,
    index: f64,
    rng: &mut PlanRng,
    row: &mut [f64],
) {
    let root = Root::new(index + 1.0);
    for ((gene, &a), &b) in row.iter_mut().zip(a).zip(b) {
        let (changes, u, swaps) = (
            rng.random_bool(0.5),
            rng.random::<f64>(),
            rng.random_bool(0.5),
        );
        let side = second ^ (changes && swaps);
        *gene = if second { b } else { a };
        if !changes || (a - b).abs() < 1e-14 {
            continue;
        }
        let spread = root.of(if u <= 0.5 {
            2.0 * u
        } else {
            1.0 / (2.0 * (1.0 - u))
        });
        let (mean, half) = (f64::midpoint(a, b), (b - a) / 2.0);
        *gene = if side {
            mean + spread * half
        } else {
            mean - spread * half
        };
    }
}
