//! The samples of a record: equally spaced rows, column by column.

use super::{Column, Quantity};
use crate::model::Model;
use crate::system::ObjectState;

/// Rows for which room is made at once; a longer record grows as it is filled.
const MOST_ROOM: usize = 1 << 16;

/// Rows on the way.
#[derive(Clone, Debug)]
pub(crate) struct Rows {
    times: Vec<f64>,
    columns: Vec<Column>,
    intervals: usize,
    duration: f64,
    next: usize,
}

impl Rows {
    /// Room for `intervals` + 1 rows over [0, `duration`].
    pub(crate) fn new(model: &Model, intervals: usize, duration: f64) -> Self {
        let intervals = intervals.max(1);
        let room = intervals.min(MOST_ROOM) + 1;
        let columns = model.objects.iter().flat_map(|part| {
            Quantity::ALL.map(|quantity| Column {
                object: part.id.clone(),
                quantity,
                unit: quantity.unit(part.coordinate),
                values: Vec::with_capacity(room),
            })
        });
        Self {
            columns: columns.collect(),
            times: Vec::with_capacity(room),
            intervals,
            duration,
            next: 0,
        }
    }

    /// Time of the next sample if it is not later than `until`.
    pub(crate) fn due(&self, until: f64) -> Option<f64> {
        (self.next <= self.intervals)
            .then(|| self.sample_time(self.next))
            .filter(|&time| time <= until)
    }

    /// The sample that was due; see [`Self::push`].
    pub(crate) fn sample_at(&mut self, time: f64, states: &[ObjectState]) -> bool {
        self.next += 1;
        self.push(time, states)
    }

    /// A row out of turn. False, and no row, when a value is not a finite number.
    pub(crate) fn push(&mut self, time: f64, states: &[ObjectState]) -> bool {
        if !states.iter().all(is_finite) {
            return false;
        }
        self.times.push(time);
        for (columns, state) in self.columns.chunks_mut(Quantity::ALL.len()).zip(states) {
            for (column, value) in columns.iter_mut().zip(values(state)) {
                column.values.push(value);
            }
        }
        true
    }

    /// The run ended at `time` with `last`: the sample due there may have been
    /// missed by rounding.
    pub(crate) fn finish(&mut self, time: f64, last: &[ObjectState]) {
        let slack = 1e-6 * self.duration / self.intervals as f64;
        if let Some(due) = self.due(time + slack) {
            self.sample_at(due, last);
        }
    }

    /// Times and columns.
    pub(crate) fn into_columns(self) -> (Vec<f64>, Vec<Column>) {
        (self.times, self.columns)
    }

    fn sample_time(&self, index: usize) -> f64 {
        if index == self.intervals {
            self.duration
        } else {
            self.duration * (index as f64 / self.intervals as f64)
        }
    }
}

/// True when everything that goes into figures and rows is a number.
pub(crate) fn is_finite(state: &ObjectState) -> bool {
    values(state).iter().all(|value| value.is_finite())
}

/// The quantities of a row, in the order of [`Quantity::ALL`].
fn values(state: &ObjectState) -> [f64; 6] {
    [
        state.displacement,
        state.speed,
        state.acceleration,
        state.delta,
        state.reaction,
        state.contact_force,
    ]
}

#[cfg(test)]
mod tests {
    use super::Rows;
    use crate::model::{Coordinate, Model, ObjectPart, PartInput};
    use crate::system::ObjectState;

    fn one_slider() -> Model {
        Model {
            objects: vec![ObjectPart {
                id: "slide".to_owned(),
                kind: "slider",
                coordinate: Coordinate::Sliding,
                nodes: vec![0],
                inputs: PartInput::only(None),
                combination: None,
                links: Vec::new(),
                rigid_pair: None,
            }],
            ..Model::default()
        }
    }

    #[test]
    fn both_ends_are_sampled_and_rounding_loses_none() {
        let mut rows = Rows::new(&one_slider(), 3, 0.3);
        let state = [ObjectState::default()];
        let mut time = 0.0;
        while time < 0.3 - 1e-9 {
            while let Some(due) = rows.due(time) {
                rows.sample_at(due, &state);
            }
            time += 0.05;
        }
        rows.finish(0.3 * (1.0 - 1e-15), &state);
        let (times, columns) = rows.into_columns();
        assert_eq!(times.len(), 4);
        assert_eq!((times[0], times[3]), (0.0, 0.3));
        assert_eq!((columns[1].unit, columns[4].unit), ("m/s", "N"));
        assert!(columns.iter().all(|column| column.values.len() == 4));
    }

    #[test]
    fn a_run_cut_short_has_no_samples_it_did_not_reach() {
        let mut rows = Rows::new(&one_slider(), 10, 1.0);
        rows.sample_at(0.0, &[ObjectState::default()]);
        rows.finish(0.05, &[ObjectState::default()]);
        assert_eq!(rows.into_columns().0, [0.0]);
    }

    #[test]
    fn what_is_no_number_makes_no_row() {
        let mut rows = Rows::new(&one_slider(), 10, 1.0);
        let endless = ObjectState {
            acceleration: f64::INFINITY,
            ..ObjectState::default()
        };
        assert!(rows.sample_at(0.0, &[ObjectState::default()]));
        assert!(!rows.sample_at(0.1, &[endless]));
        assert!(rows.sample_at(0.2, &[ObjectState::default()]));
        let (times, columns) = rows.into_columns();
        assert_eq!(times, [0.0, 0.2]);
        assert!(columns.iter().all(|column| column.values.len() == 2));
    }
}
