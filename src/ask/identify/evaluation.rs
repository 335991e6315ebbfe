//! Residuals of runs beside records.

use super::channels::values_of;
use super::records::Test;
use crate::ask::prepared::PointSource;
use crate::ask::variables::ready;
use crate::dynamics::integrate::Stop;
use crate::frontend::scene::Levels;
use crate::studies::Control;
use crate::studies::identify::FittedSignal;
use crate::studies::optimize::Variable;
use crate::studies::run::run;
use crate::studies::side_by_side::side_by_side;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Runs at rows of shares of the ranges.
pub(super) struct Evaluation<'e> {
    pub(super) variables: &'e [Variable],
    pub(super) tests: &'e [Test],
    /// As many of each test, in their order.
    pub(super) signals: &'e [FittedSignal],
    pub(super) levels: &'e Levels,
    pub(super) source: &'e PointSource<'e, 'e>,
    pub(super) control: &'e Control<'e>,
    /// Receives the number of rows that are done, from any thread.
    pub(super) heard: &'e (dyn Fn(usize) + Sync),
    /// Number of rows that are done.
    pub(super) done: AtomicUsize,
    pub(super) threads: usize,
    /// Why the first row without residuals has none.
    pub(super) cause: Mutex<Option<String>>,
}

impl Evaluation<'_> {
    /// The residuals of all rows, worked out side by side; `None`: ended from outside.
    pub(super) fn residuals(&self, rows: &[Vec<f64>]) -> Option<Vec<Option<Vec<f64>>>> {
        let found: Vec<Mutex<Option<Vec<f64>>>> = rows.iter().map(|_| Mutex::default()).collect();
        let take = |(): &mut (), at: usize| {
            let own = self.row(&rows[at]);
            if self.control.is_spent() {
                return false;
            }
            (self.heard)(self.done.fetch_add(1, Ordering::Relaxed) + 1);
            let own = own.map_err(|cause| {
                let mut first = self.cause.lock().unwrap_or_else(PoisonError::into_inner);
                first.get_or_insert(cause);
            });
            *found[at].lock().unwrap_or_else(PoisonError::into_inner) = own.ok();
            true
        };
        side_by_side(rows.len(), self.threads, || (), take);
        if self.control.is_spent() {
            return None;
        }
        let found = found.into_iter();
        Some(
            found
                .map(|one| one.into_inner().unwrap_or_else(PoisonError::into_inner))
                .collect(),
        )
    }

    /// The residuals of one row; why the scene cannot be run there.
    fn row(&self, shares: &[f64]) -> Result<Vec<f64>, String> {
        let each = self.variables.iter().zip(shares);
        let own: Vec<String> = each
            .map(|(variable, share)| variable.parameter().setting(variable.value(*share)))
            .collect();
        let channels = self.signals.len() / self.tests.len();
        let mut all = Vec::new();
        for (test, signals) in self.tests.iter().zip(self.signals.chunks(channels)) {
            self.add_residuals((test, signals), &own, &mut all)?;
        }
        Ok(all)
    }

    fn add_residuals(
        &self,
        (test, signals): (&Test, &[FittedSignal]),
        own: &[String],
        all: &mut Vec<f64>,
    ) -> Result<(), String> {
        let settings: Vec<String> = test.settings.iter().chain(own).cloned().collect();
        let reading = self
            .source
            .decode(&settings)
            .map_err(|one| one.lines().join("; "))?;
        let mut ready =
            ready(reading, self.levels, self.control).map_err(|error| error.to_string())?;
        ready.settings.switch_rows = false;
        let found = run(&ready.system, &ready.settings, self.control, &mut []);
        let found = found.map_err(|faults| ready.diagnose(&faults).to_string())?;
        if found.outcome.stop != Stop::Complete {
            return Err("the run ends before the record".to_owned());
        }
        if !found.is_trusted() {
            return Err("the run is not to be trusted".to_owned());
        }
        for signal in signals {
            let values = values_of(&found.record, &signal.address)
                .and_then(|values| test.grid.at_times(values))
                .ok_or_else(|| format!("the run has no values of `{}`", signal.address))?;
            let rows = values.iter().zip(&signal.measured);
            all.extend(rows.map(|(model, measured)| (model - measured) / signal.weight()));
        }
        Ok(())
    }
}
