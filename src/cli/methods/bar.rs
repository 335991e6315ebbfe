//! A progress bar over the points of a study, on a terminal only.

use crate::cli::bar::Bar;
use crate::studies::methods::Now;

/// Shows which method is under way.
pub(super) struct PointBar {
    bar: Bar,
    /// Values of the axis, 1 without one.
    values: usize,
}

impl PointBar {
    /// A bar over `values` studies; silent when `quiet` or without a terminal.
    pub(super) fn new(values: usize, quiet: bool) -> Self {
        let template = "methods {bar:30} {pos}/{len} {msg} [{eta} left]";
        let bar = Bar::new(template, "", (0, Some(values as u64)), quiet);
        Self { bar, values }
    }

    /// A point of the study number `index` begins.
    pub(super) fn at(&self, index: usize, now: &Now) {
        self.bar.set_length((self.values * now.total) as u64);
        self.bar
            .tell(|_| format!("{}, {}", now.method, now.setting));
        self.bar.set((index * now.total + now.done) as u64);
    }

    /// Takes the bar away.
    pub(super) fn finish(&self) {
        self.bar.finish();
    }
}
