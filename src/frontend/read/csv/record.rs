//! Columns of a table over the time in its first one.

use super::super::wanted::QuantityChoice;
use super::{Csv, TableFile};
use crate::frontend::diagnostics::Diagnostic;
use crate::units::quantities::TIME;

/// Columns over a time, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct TimeTable {
    /// The times, rising from 0 or later.
    pub times: Vec<f64>,
    /// The columns in the order in which they were named.
    pub columns: Vec<Vec<f64>>,
}

impl TableFile {
    /// Some columns over the first one, a time.
    ///
    /// # Errors
    /// The table cannot be read; there is no such column, or it has another unit; a time is not
    /// later than the one before, or below zero.
    pub fn over_time(
        &self,
        wanted: &[(&str, QuantityChoice)],
    ) -> Result<TimeTable, Vec<Diagnostic>> {
        let csv = Csv::new(&self.source.text, self.id).map_err(|fault| vec![*fault])?;
        let mut faults = Vec::new();
        let time = csv
            .columns
            .first()
            .map(|time| csv.check_unit(time, TIME.into()));
        faults.extend(time.and_then(Result::err).map(|fault| *fault));
        let mut chosen = Vec::new();
        for (name, wanted) in wanted {
            let names = [(*name).to_owned(), (*name).to_owned()];
            let found = csv.chosen_columns(Some(&names)).and_then(|[at, _]| {
                csv.check_unit(&csv.columns[at], *wanted)?;
                Ok((at, *wanted))
            });
            match found {
                Ok(found) => chosen.push(found),
                Err(fault) => faults.push(*fault),
            }
        }
        match faults.is_empty() {
            true => csv.time_table(&chosen),
            false => Err(faults),
        }
    }
}

impl Csv<'_> {
    fn time_table(&self, chosen: &[(usize, QuantityChoice)]) -> Result<TimeTable, Vec<Diagnostic>> {
        let mut found = TimeTable {
            times: Vec::new(),
            columns: vec![Vec::new(); chosen.len()],
        };
        self.each_row(&mut |cells| {
            let time = self.number(&self.columns[0], TIME.into(), &cells[0])?;
            let before = found.times.last().copied();
            found.times.push(time);
            let wrong = match before {
                Some(before) if time <= before => "this time is not later than the one before",
                None if time < 0.0 => "this time is below 0, and a run begins at 0",
                _ => "",
            };
            if !wrong.is_empty() {
                return Err(self.fault(wrong, cells[0].clone()));
            }
            for (values, (at, wanted)) in found.columns.iter_mut().zip(chosen) {
                values.push(self.number(&self.columns[*at], *wanted, &cells[*at])?);
            }
            Ok(())
        })?;
        Ok(found)
    }
}
