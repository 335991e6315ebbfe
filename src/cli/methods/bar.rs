//! A progress bar over the points of a study, on a terminal only.

use crate::studies::methods::Now;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;

/// Shows which method is under way.
pub(super) struct PointBar {
    bar: Option<ProgressBar>,
    /// Values of the axis, 1 without one.
    values: usize,
}

impl PointBar {
    /// A bar over `values` studies; silent when `quiet` or without a terminal.
    pub(super) fn new(values: usize, quiet: bool) -> Self {
        let visible = !quiet && std::io::stderr().is_terminal();
        let style = ProgressStyle::with_template("methods {bar:30} {pos}/{len} {msg} [{eta} left]");
        let bar = visible.then(|| {
            ProgressBar::new(values as u64)
                .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
        });
        Self { bar, values }
    }

    /// A point of the study number `index` begins.
    pub(super) fn at(&self, index: usize, now: &Now) {
        if let Some(bar) = &self.bar {
            bar.set_length((self.values * now.total) as u64);
            bar.set_position((index * now.total + now.done) as u64);
            bar.set_message(format!("{}, {}", now.method, now.setting));
        }
    }

    /// Takes the bar away.
    pub(super) fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
