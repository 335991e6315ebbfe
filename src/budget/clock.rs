//! The clock. A browser tab has none of the system's: the page lends its own.

#[cfg(not(target_family = "wasm"))]
pub(crate) use std::time::Instant;

#[cfg(target_family = "wasm")]
pub(crate) use lent::Instant;

#[cfg(target_family = "wasm")]
mod lent {
    use std::ops::{Add, Sub};
    use std::time::Duration;

    #[expect(unsafe_code, reason = "what a page lends is declared so")]
    #[link(wasm_import_module = "page")]
    unsafe extern "C" {
        /// Milliseconds since the page was opened; never less than before.
        safe fn milliseconds() -> f64;
    }

    /// An instant of the page's clock.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    pub(crate) struct Instant(Duration);

    impl Instant {
        pub(crate) fn now() -> Self {
            Self(Duration::from_secs_f64(1e-3 * milliseconds().max(0.0)))
        }

        pub(crate) fn elapsed(&self) -> Duration {
            Self::now() - *self
        }

        pub(crate) fn checked_add(self, time: Duration) -> Option<Self> {
            self.0.checked_add(time).map(Self)
        }
    }

    impl Add<Duration> for Instant {
        type Output = Self;

        fn add(self, time: Duration) -> Self {
            Self(self.0 + time)
        }
    }

    impl Sub for Instant {
        type Output = Duration;

        fn sub(self, before: Self) -> Duration {
            self.0.saturating_sub(before.0)
        }
    }
}
