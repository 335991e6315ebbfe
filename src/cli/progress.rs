//! A progress bar for runs longer than a second, on a terminal only.

use super::asker::Asker;
use crate::dynamics::integrate::{Modes, Sink, SwitchEvent};
use crate::frontend::diagnostics::printable;
use crate::math::polynomial::Step;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::time::{Duration, Instant};

/// Work that takes less time than this shows no bar.
pub(crate) const PATIENCE: Duration = Duration::from_secs(1);
/// Steps between two looks at the clock.
const STRIDE: u32 = 256;

/// Listens to a run and draws how far it is.
pub(crate) struct Progress<'a> {
    bar: Option<ProgressBar>,
    label: String,
    duration: f64,
    begun: Instant,
    until_look: u32,
    switches: u64,
    keeping: bool,
    asker: &'a dyn Asker,
}

impl<'a> Progress<'a> {
    /// A bar for a run of `duration` seconds; silent when `quiet` or when
    /// standard error is no terminal.
    pub(crate) fn new(label: &str, duration: f64, quiet: bool, asker: &'a dyn Asker) -> Self {
        let visible = !quiet && std::io::stderr().is_terminal();
        Self {
            bar: visible.then(ProgressBar::hidden),
            label: printable(label),
            duration,
            begun: Instant::now(),
            until_look: STRIDE,
            switches: 0,
            keeping: false,
            asker,
        }
    }

    fn update_bar(&mut self, time: f64) {
        let Some(bar) = &self.bar else { return };
        if self.begun.elapsed() < PATIENCE {
            return;
        }
        if bar.is_hidden() {
            bar.set_draw_target(ProgressDrawTarget::stderr());
            bar.set_length(1000);
            bar.set_style(style());
            bar.set_prefix(self.label.clone());
        }
        bar.set_position((1000.0 * time / self.duration) as u64);
        // Runs advance unevenly; the mean rate since the start is the honest guess.
        let left = self.begun.elapsed().as_secs_f64() * (self.duration / time - 1.0);
        bar.set_message(format!(
            "{time:.4} of {} s, {} events, {left:.0} s left",
            self.duration, self.switches
        ));
    }

    /// Takes the bar away.
    pub(crate) fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

fn style() -> ProgressStyle {
    ProgressStyle::with_template("{prefix} {bar:30} {msg}")
        .unwrap_or_else(|_| ProgressStyle::default_bar())
}

impl Sink for Progress<'_> {
    fn start(&mut self, _time: f64, _y: &[f64], _modes: &Modes) {
        // From here on there is a motion to keep, to be told when the run is over too.
        if !self.keeping {
            std::mem::forget(self.asker.guard_from_interrupt());
            self.keeping = true;
        }
    }

    fn step(&mut self, step: &Step<'_>, _modes: &Modes) {
        self.until_look -= 1;
        if self.until_look == 0 {
            self.until_look = STRIDE;
            self.update_bar(step.end_time());
        }
    }

    fn switch(&mut self, event: &SwitchEvent<'_>) {
        // A break of a law is no switch of a pair; the bar need not be exact.
        self.switches += u64::from(event.watch.is_some());
    }

    fn passes(&mut self, time: f64, switches: u64) {
        self.switches = switches;
        self.until_look -= 1;
        if self.until_look == 0 {
            self.until_look = STRIDE;
            self.update_bar(time);
        }
    }

    fn reads_within_steps(&self, _until: f64) -> bool {
        false
    }
}

/// Counts what is done of work whose end nobody knows.
pub(crate) struct Count {
    bar: Option<ProgressBar>,
    begun: Instant,
}

impl Count {
    /// A count of `what`; silent when `quiet` or when standard error is no terminal.
    pub(crate) fn new(label: &str, what: &str, quiet: bool) -> Self {
        let visible = !quiet && std::io::stderr().is_terminal();
        let bar = visible.then(|| {
            let bar = ProgressBar::hidden();
            let template = format!("{{prefix}} {{pos}} {what}, {{elapsed}}");
            let style = ProgressStyle::with_template(&template);
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar.set_prefix(printable(label));
            bar
        });
        Self {
            bar,
            begun: Instant::now(),
        }
    }

    /// So much is done; called from any thread.
    pub(crate) fn set(&self, done: usize) {
        let Some(bar) = &self.bar else { return };
        if bar.is_hidden() && self.begun.elapsed() > PATIENCE {
            bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        bar.set_position(done as u64);
    }

    /// Takes it away.
    pub(crate) fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
