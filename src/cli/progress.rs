//! A progress bar for runs longer than a second, on a terminal only.

use super::asker::Asker;
use super::bar::Bar;
use crate::dynamics::integrate::{Modes, Sink, SwitchEvent};
use crate::math::polynomial::Step;
/// Steps between two looks at the clock.
const STRIDE: u32 = 256;

/// Listens to a run and draws how far it is.
pub(crate) struct Progress<'a> {
    bar: Bar,
    duration: f64,
    until_look: u32,
    switches: u64,
    keeping: bool,
    asker: &'a dyn Asker,
}

impl<'a> Progress<'a> {
    /// A bar for a run of `duration` seconds; silent when `quiet` or when
    /// standard error is no terminal.
    pub(crate) fn new(label: &str, duration: f64, quiet: bool, asker: &'a dyn Asker) -> Self {
        let template = "{prefix} {bar:30} {msg}";
        Self {
            bar: Bar::new(template, label, (0, Some(1000)), quiet),
            duration,
            until_look: STRIDE,
            switches: 0,
            keeping: false,
            asker,
        }
    }

    fn update_bar(&mut self, time: f64) {
        let Self {
            duration, switches, ..
        } = *self;
        self.bar.tell(|elapsed| {
            // Runs advance unevenly; the mean rate since the start is the honest guess.
            let left = elapsed * (duration / time - 1.0);
            format!("{time:.4} of {duration} s, {switches} events, {left:.0} s left")
        });
        self.bar.set((1000.0 * time / duration) as u64);
    }

    /// Takes the bar away.
    pub(crate) fn finish(&self) {
        self.bar.finish();
    }
}

impl Sink for Progress<'_> {
    fn start(&mut self, _time: f64, _y: &[f64], _modes: &Modes) {
        // From here on there is a motion to keep, to be told when the run is over too.
        if !self.keeping {
            std::mem::forget(self.asker.keep());
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
pub(crate) struct Count(Bar);

impl Count {
    /// A count of `what`; silent when `quiet` or when standard error is no terminal.
    pub(crate) fn new(label: &str, what: &str, quiet: bool) -> Self {
        let template = format!("{{prefix}} {{pos}} {what}, {{elapsed}}");
        Self(Bar::new(&template, label, (0, None), quiet))
    }

    /// So much is done; called from any thread.
    pub(crate) fn set(&self, done: usize) {
        self.0.set(done as u64);
    }

    /// Takes it away.
    pub(crate) fn finish(&self) {
        self.0.finish();
    }
}
