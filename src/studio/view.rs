//! What a window sees besides the run: runs that it has pinned, a signal over another.
//!
//! Pins are drawn by the charts of several runs and the tables of `dam compare`. Windows that
//! see more than the run get answers of their own.

use super::limits::{NAME, PINS};
use super::pins::{KeptPin, Source};
use crate::report::live::RunExtras;
use crate::studies::run::RunResult;
use std::sync::Arc;

/// What one window sees.
#[derive(Clone, Debug, Default)]
pub(super) struct View {
    pins: Vec<Pin>,
    /// Names of two columns of the record: along and up a chart.
    pub(super) over: Option<[String; 2]>,
}

/// A run with what it is worked out again from.
#[derive(Clone, Debug)]
pub(super) struct SourcedRun {
    pub(super) source: Arc<Source>,
    pub(super) result: Arc<RunResult>,
}

/// A run that stays.
#[derive(Clone, Debug)]
struct Pin {
    name: String,
    source: Arc<Source>,
    /// `None`: it is one of an earlier program, still to be worked out again.
    result: Option<Arc<RunResult>>,
}

impl View {
    /// Runs that an earlier program kept, still to be worked out again.
    pub(super) fn from_records(kept: &[KeptPin]) -> Self {
        let mut view = Self::default();
        for pin in kept {
            let name = view.distinct_name(&pin.name, view.pins.len());
            view.pins.push(Pin {
                name,
                source: Arc::new(pin.source.clone()),
                result: None,
            });
        }
        view
    }

    /// The pinned runs as they are kept.
    pub(super) fn pin_records(&self) -> Vec<KeptPin> {
        let one = |pin: &Pin| KeptPin {
            name: pin.name.clone(),
            source: (*pin.source).clone(),
        };
        self.pins.iter().map(one).collect()
    }

    /// A pinned run that is still to be worked out again.
    pub(super) fn waiting_run(&self) -> Option<&Arc<Source>> {
        let mut waiting = self.pins.iter().filter(|pin| pin.result.is_none());
        waiting.next().map(|pin| &pin.source)
    }

    /// What was waited for was worked out, or cannot be: names of pins that go with it.
    pub(super) fn worked_out(
        &mut self,
        source: &Source,
        result: Option<&Arc<RunResult>>,
    ) -> Vec<String> {
        let is_it = |pin: &Pin| pin.result.is_none() && *pin.source == *source;
        if let Some(result) = result {
            for pin in self.pins.iter_mut().filter(|pin| is_it(pin)) {
                pin.result = Some(result.clone());
            }
        }
        let gone = self.pins.extract_if(.., |pin| is_it(pin));
        gone.map(|pin| pin.name).collect()
    }

    /// Whether there is nothing but the run.
    pub(super) fn is_plain(&self) -> bool {
        self.pins.is_empty() && self.over.is_none()
    }

    /// Names of the pinned runs.
    pub(super) fn names(&self) -> Vec<&str> {
        self.pins.iter().map(|pin| pin.name.as_str()).collect()
    }

    pub(super) fn run_extras(&self) -> RunExtras<'_> {
        let pins = self.pins.iter();
        let pins = pins.filter_map(|pin| Some((pin.name.as_str(), &**pin.result.as_ref()?)));
        RunExtras {
            pins: pins.collect(),
            over: self.over.as_ref(),
        }
    }

    /// Keeps a run.
    ///
    /// # Errors
    /// There are as many as there may be.
    pub(super) fn keep_run(&mut self, name: &str, run: &SourcedRun) -> Result<(), String> {
        if self.pins.len() >= PINS {
            return Err(format!("{PINS} runs are pinned: unpin one of them first"));
        }
        self.pins.push(Pin {
            name: self.distinct_name(name, self.pins.len()),
            source: run.source.clone(),
            result: Some(with_closeups(&run.result)),
        });
        Ok(())
    }

    /// Gives a pinned run another name.
    pub(super) fn rename(&mut self, pin: usize, name: &str) {
        let name = self.distinct_name(name, pin);
        if let Some(pin) = self.pins.get_mut(pin) {
            pin.name = name;
        }
    }

    /// Lets a pinned run go.
    pub(super) fn unpin(&mut self, pin: usize) {
        if pin < self.pins.len() {
            self.pins.remove(pin);
        }
    }

    /// A name that tells the run from the others, and is not too long for a legend.
    fn distinct_name(&self, name: &str, at: usize) -> String {
        let short: String = name.trim().chars().take(NAME).collect();
        let short = match short.is_empty() {
            true => format!("run {}", at + 1),
            false => short,
        };
        let is_taken = |tried: &str| {
            let others = self.pins.iter().enumerate();
            tried == "now"
                || others
                    .into_iter()
                    .any(|(k, pin)| k != at && pin.name == tried)
        };
        let more = (2..).map(|count| format!("{short} ({count})"));
        let mut all = std::iter::once(short.clone()).chain(more);
        all.find(|tried| !is_taken(tried)).unwrap_or(short)
    }
}

/// A run as it is shown beside others.
pub(super) fn with_closeups(result: &RunResult) -> Arc<RunResult> {
    let record = result.record.with_closeups();
    Arc::new(RunResult {
        record,
        ..result.clone()
    })
}
