//! What a window sees besides the run: runs that it has pinned, a signal over another.

use super::limits::{NAME, PINS};
use crate::report::live::Beside;
use crate::studies::run::RunResult;
use std::sync::Arc;

/// What one window sees.
#[derive(Clone, Debug, Default)]
pub(super) struct View {
    pins: Vec<Pin>,
    /// Names of two columns of the record: along and up a chart.
    pub(super) over: Option<[String; 2]>,
}

/// A run that stays.
#[derive(Clone, Debug)]
struct Pin {
    name: String,
    result: Arc<RunResult>,
}

impl View {
    /// Whether there is nothing but the run.
    pub(super) fn is_plain(&self) -> bool {
        self.pins.is_empty() && self.over.is_none()
    }

    /// Names of the pinned runs.
    pub(super) fn names(&self) -> Vec<&str> {
        self.pins.iter().map(|pin| pin.name.as_str()).collect()
    }

    pub(super) fn beside(&self) -> Beside<'_> {
        let pins = self.pins.iter();
        Beside {
            pins: pins.map(|pin| (pin.name.as_str(), &*pin.result)).collect(),
            over: self.over.as_ref(),
        }
    }

    /// Keeps a run.
    ///
    /// # Errors
    /// There are as many as there may be.
    pub(super) fn pin(&mut self, name: &str, result: &RunResult) -> Result<(), String> {
        if self.pins.len() >= PINS {
            return Err(format!("{PINS} runs are pinned: unpin one of them first"));
        }
        let record = result.record.merged();
        let result = RunResult {
            record,
            ..result.clone()
        };
        self.pins.push(Pin {
            name: self.named(name, self.pins.len()),
            result: Arc::new(result),
        });
        Ok(())
    }

    /// Gives a pinned run another name.
    pub(super) fn rename(&mut self, pin: usize, name: &str) {
        let name = self.named(name, pin);
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
    fn named(&self, name: &str, at: usize) -> String {
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
