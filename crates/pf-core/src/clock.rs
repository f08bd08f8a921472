//! Time, behind one small type.

use std::{fmt, time::Duration};

/// Where a [`Context`](crate::Context) takes its time from: a function that tells how long ago
/// some fixed moment was.
///
/// The default is the system's monotonic clock. On targets without one (`wasm32-unknown-unknown`)
/// it is [`Clock::stopped`]; give the host's clock instead, or plan within iterations.
///
/// ```
/// # use {pf_core::Clock, std::time::Duration};
/// let frozen = Clock::new(|| Duration::from_secs(3));
/// assert_eq!(frozen.now(), Duration::from_secs(3));
/// ```
#[derive(Clone, Copy)]
pub struct Clock(fn() -> Duration);

impl Clock {
    /// A clock of the caller's.
    #[must_use]
    pub const fn new(now: fn() -> Duration) -> Self {
        Self(now)
    }

    /// A clock that stands still: a budget in time never runs out, elapsed times are zero.
    #[must_use]
    pub const fn stopped() -> Self {
        Self(|| Duration::ZERO)
    }

    /// Time since a fixed moment.
    #[must_use]
    pub fn now(self) -> Duration {
        (self.0)()
    }
}

impl Default for Clock {
    #[cfg(all(target_family = "wasm", target_os = "unknown"))]
    fn default() -> Self {
        Self::stopped()
    }

    #[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
    #[expect(
        clippy::disallowed_methods,
        reason = "the one place where time comes in"
    )]
    fn default() -> Self {
        use std::{sync::OnceLock, time::Instant};
        static ORIGIN: OnceLock<Instant> = OnceLock::new();
        Self(|| ORIGIN.get_or_init(Instant::now).elapsed())
    }
}

impl fmt::Debug for Clock {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Clock")
    }
}
