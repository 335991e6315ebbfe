//! A bar of progress on a terminal. Where there is none, as in a browser tab, nothing is drawn.

#[cfg(not(target_family = "wasm"))]
use crate::frontend::diagnostics::printable;
#[cfg(not(target_family = "wasm"))]
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
#[cfg(not(target_family = "wasm"))]
use std::time::{Duration, Instant};

/// Work that takes less time than this shows no bar.
#[cfg(not(target_family = "wasm"))]
const PATIENCE: Duration = Duration::from_secs(1);

/// A bar, drawn once the work has taken a second.
#[cfg(not(target_family = "wasm"))]
pub(crate) struct Bar {
    drawn: Option<ProgressBar>,
    begun: Instant,
}

/// Nothing.
#[cfg(target_family = "wasm")]
pub(crate) struct Bar;

#[cfg(not(target_family = "wasm"))]
impl Bar {
    /// A bar of `length` parts, of which `done` cost no time; silent when `quiet` or when standard
    /// error is no terminal. The template is that of `indicatif`; `label` is its `{prefix}`.
    pub(crate) fn new(
        template: &str,
        label: &str,
        (done, length): (u64, Option<u64>),
        quiet: bool,
    ) -> Self {
        use std::io::IsTerminal;
        let is_visible = !quiet && std::io::stderr().is_terminal();
        let drawn = is_visible.then(|| {
            let bar = ProgressBar::hidden();
            let style = ProgressStyle::with_template(template);
            if let Some(length) = length {
                bar.set_length(length);
            }
            bar.set_position(done);
            // The rate and the time left are those of the other parts.
            bar.reset_eta();
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar.set_prefix(printable(label));
            bar
        });
        Self {
            drawn,
            begun: Instant::now(),
        }
    }

    /// The bar itself, where it is to be seen by now.
    fn visible_bar(&self) -> Option<&ProgressBar> {
        let bar = self.drawn.as_ref()?;
        if bar.is_hidden() && self.begun.elapsed() > PATIENCE {
            bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        Some(bar)
    }

    /// So many parts are done; from any thread.
    pub(crate) fn set(&self, done: u64) {
        if let Some(bar) = self.visible_bar() {
            bar.set_position(done);
        }
    }

    /// One part more is done; from any thread.
    pub(crate) fn advance(&self) {
        if let Some(bar) = self.visible_bar() {
            bar.inc(1);
        }
    }

    /// There are so many parts.
    pub(crate) fn set_length(&self, length: u64) {
        if let Some(bar) = &self.drawn {
            bar.set_length(length);
        }
    }

    /// What stands beside the bar, from the seconds since it began; made where it is seen.
    pub(crate) fn tell(&self, words: impl FnOnce(f64) -> String) {
        if let Some(bar) = self.visible_bar() {
            bar.set_message(words(self.begun.elapsed().as_secs_f64()));
        }
    }

    /// Takes it away.
    pub(crate) fn finish(&self) {
        if let Some(bar) = &self.drawn {
            bar.finish_and_clear();
        }
    }
}

#[cfg(target_family = "wasm")]
impl Bar {
    pub(crate) fn new(_: &str, _: &str, _: (u64, Option<u64>), _: bool) -> Self {
        Self
    }

    pub(crate) fn set(&self, _: u64) {}

    pub(crate) fn advance(&self) {}

    pub(crate) fn set_length(&self, _: u64) {}

    pub(crate) fn tell(&self, _: impl FnOnce(f64) -> String) {}

    pub(crate) fn finish(&self) {}
}
