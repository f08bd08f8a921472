use pf_geom::{DANGER, LENGTH, Objectives, TURNING};
use std::{fmt, str::FromStr};

/// Which member of a front somebody wants.
///
/// ```
/// use pf_moabc::Preference;
/// let front = [[142.0, 9.0, 1.0], [150.0, 2.0, 1.5], [170.0, 0.0, 6.0]];
/// assert_eq!(Preference::Length.choose(&front), Some(0));
/// assert_eq!(Preference::Knee.choose(&front), Some(1));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Preference {
    /// The shortest.
    Length,
    /// The one with the most clearance.
    Safety,
    /// The one that turns least.
    Smooth,
    /// The one nearest to the best of each, every objective by its range in the front.
    #[default]
    Knee,
}

impl Preference {
    /// All there are.
    pub const ALL: [Self; 4] = [Self::Length, Self::Safety, Self::Smooth, Self::Knee];

    /// The place of the member it is for; of several as good, of the shortest, safest, smoothest.
    /// None in an empty front.
    #[must_use]
    pub fn choose(self, front: &[Objectives]) -> Option<usize> {
        let least = |k: usize| front.iter().map(|c| c[k]).fold(f64::INFINITY, f64::min);
        let most = |k: usize| front.iter().map(|c| c[k]).fold(f64::NEG_INFINITY, f64::max);
        let scales: Vec<(f64, f64)> = (0..3)
            .map(|k| (least(k), (most(k) - least(k)).max(f64::MIN_POSITIVE)))
            .collect();
        let far = |cost: &Objectives| -> f64 {
            let parts = cost
                .iter()
                .zip(&scales)
                .map(|(c, (least, range))| (c - least) / range);
            parts.map(|part| part * part).sum()
        };
        let value = |cost: &Objectives| match self {
            Self::Length => cost[LENGTH],
            Self::Safety => cost[DANGER],
            Self::Smooth => cost[TURNING],
            Self::Knee => far(cost),
        };
        let members = front.iter().enumerate();
        let best = members.min_by(|(_, a), (_, b)| {
            let rest = || {
                (0..3)
                    .map(|k| a[k].total_cmp(&b[k]))
                    .find(|order| order.is_ne())
            };
            let first = value(a).total_cmp(&value(b));
            if first.is_ne() {
                first
            } else {
                rest().unwrap_or(first)
            }
        });
        best.map(|(place, _)| place)
    }

    /// The word for it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Length => "length",
            Self::Safety => "safety",
            Self::Smooth => "smooth",
            Self::Knee => "knee",
        }
    }
}

impl fmt::Display for Preference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

impl FromStr for Preference {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let known = Self::ALL
            .into_iter()
            .find(|preference| preference.word() == text);
        known.ok_or_else(|| "expected length, safety, smooth or knee".to_owned())
    }
}
