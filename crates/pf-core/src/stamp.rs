//! Names for contents.

use std::sync::atomic::{AtomicU64, Ordering};

/// Names one content of one value: equal stamps, equal content.
///
/// A clone keeps its stamp until it changes, so two clones that diverge never share one. Stamps
/// carry no order and no meaning beyond equality, and never reach a result.
///
/// ```
/// # use pf_core::Stamp;
/// let (a, b) = (Stamp::fresh(), Stamp::fresh());
/// assert!(a == a && a != b);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stamp(u64);

impl Stamp {
    /// A stamp nobody else has.
    #[must_use]
    pub fn fresh() -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        Self(NEXT.fetch_add(1, Ordering::Relaxed))
    }
}
