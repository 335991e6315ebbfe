//! The samples of a record: equally spaced rows, column by column.

use super::closeups::{Groups, Table};
use super::{Closeups, Column, Quantity};
use crate::dynamics::model::ObjectPart;
use crate::dynamics::system::{MassState, ObjectState, System};

/// Columns of every object, and of every mass.
const OF_AN_OBJECT: usize = Quantity::ALL.len();
const OF_A_MASS: usize = Quantity::of_mass(1).len();

/// Rows for which room is made at once; a longer record grows as it is filled.
const MOST_ROOM: usize = 1 << 16;

/// Rows and what they are rows of.
#[derive(Clone, Debug)]
pub(crate) struct Rows {
    /// Columns without values.
    columns: Vec<Column>,
    /// Objects whose contact pressure is known.
    pressed: Vec<usize>,
    /// Objects whose columns are those of another one.
    unreported: Vec<String>,
    rows: Table,
    /// Rows between the equal intervals.
    closeups: Groups,
    /// Greatest magnitude in every column, where closeups are taken.
    greatest: Option<Vec<f64>>,
    /// Values of the row at hand.
    row: Vec<f64>,
    intervals: usize,
    duration: f64,
    next: usize,
}

impl Rows {
    /// Room for `intervals` + 1 rows over [0, `duration`], of all objects and, with
    /// `masses`, of all masses and links of the elastic ones; none without intervals.
    pub(crate) fn new(system: &System, masses: bool, intervals: usize, duration: f64) -> Self {
        let wanted = intervals > 0;
        let objects = system.model().objects.iter().enumerate();
        let pressed = objects.filter(|(_, part)| wanted && part.pressing.is_some());
        let pressed: Vec<usize> = pressed.map(|(object, _)| object).collect();
        let columns = match wanted {
            true => columns(system, &pressed, masses),
            false => Vec::new(),
        };
        let room = if wanted {
            intervals.min(MOST_ROOM) + 1
        } else {
            0
        };
        let width = columns.len();
        Self {
            rows: Table::new(width, room),
            closeups: Groups::new(width),
            greatest: None,
            row: vec![0.0; width],
            columns,
            pressed,
            unreported: unreported(system),
            intervals,
            duration,
            next: if wanted { 0 } else { 1 },
        }
    }

    /// With what [`Self::is_straight`] needs.
    pub(crate) fn with_closeups(self, wanted: bool) -> Self {
        Self {
            greatest: wanted.then(|| vec![0.0; self.columns.len()]),
            ..self
        }
    }

    /// False where no rows are wanted.
    pub(crate) fn is_wanted(&self) -> bool {
        self.intervals > 0
    }

    /// Time of the next sample if it is not later than `until`.
    pub(crate) fn next_sample_until(&self, until: f64) -> Option<f64> {
        (self.next <= self.intervals)
            .then(|| self.sample_time(self.next))
            .filter(|&time| time <= until)
    }

    /// True when a sample is due within rounding of a time.
    pub(crate) fn nearly_due(&self, time: f64) -> bool {
        self.next_sample_until(time + self.slack()).is_some()
    }

    fn slack(&self) -> f64 {
        1e-6 * self.duration / self.intervals.max(1) as f64
    }

    /// The sample that was due; see [`Self::push`].
    pub(crate) fn sample_at(&mut self, time: f64, seen: SystemView<'_>) -> bool {
        self.next += 1;
        self.push(time, seen)
    }

    /// A row out of turn. False, and no row, when a value is not a finite number.
    pub(crate) fn push(&mut self, time: f64, seen: SystemView<'_>) -> bool {
        let good = self.read(seen);
        if good {
            self.rows.push(time, &self.row);
        }
        good
    }

    /// The values of a row, if all are finite numbers.
    pub(crate) fn values(&mut self, seen: SystemView<'_>) -> Option<&[f64]> {
        self.read(seen).then_some(&self.row)
    }

    /// A row between those that are due, of values that [`Self::values`] gave.
    pub(crate) fn push_closeup(&mut self, time: f64, values: &[f64]) {
        self.closeups.table.push(time, values);
    }

    /// Hears of a switch: true where closeups are to follow it.
    pub(crate) fn follow_switch(&mut self) -> bool {
        self.greatest.is_some() && self.closeups.begin_after_switch()
    }

    /// True when a row in the middle between two others lies on the straight line
    /// between them, in shares of the greatest values so far.
    pub(crate) fn is_straight(&self, [a, middle, b]: [&[f64]; 3], share: f64) -> bool {
        let ends = a.iter().zip(b);
        let mut all = ends.zip(middle).zip(self.greatest.iter().flatten());
        all.all(|(((a, b), middle), greatest)| (0.5 * (a + b) - middle).abs() <= share * greatest)
    }

    fn read(&mut self, seen: SystemView<'_>) -> bool {
        let (objects, others) = self.row.split_at_mut(OF_AN_OBJECT * seen.states.len());
        let (pressures, masses) = others.split_at_mut(self.pressed.len());
        for (out, state) in objects.chunks_exact_mut(OF_AN_OBJECT).zip(seen.states) {
            out.copy_from_slice(&values(state));
        }
        for (out, mass) in masses.chunks_exact_mut(OF_A_MASS).zip(seen.masses) {
            out.copy_from_slice(&[mass.displacement, mass.speed, mass.force]);
        }
        for (out, &object) in pressures.iter_mut().zip(&self.pressed) {
            *out = seen.states[object].pressure;
        }
        // (On an edge the pressure knows no bounds, and the motion goes on.)
        let good = are_finite(objects) && are_finite(masses);
        if let (true, Some(greatest)) = (good, &mut self.greatest) {
            for (greatest, value) in greatest.iter_mut().zip(&self.row) {
                *greatest = greatest.max(value.abs());
            }
        }
        good
    }

    /// The run ended at `time` with `last`: the sample due there may have been
    /// missed by rounding.
    pub(crate) fn finish(&mut self, time: f64, last: SystemView<'_>) {
        if !self.is_wanted() {
            return;
        }
        if let Some(due) = self.next_sample_until(time + self.slack()) {
            self.sample_at(due, last);
        }
    }

    /// Times and columns, those of an object side by side; and the closeups.
    pub(crate) fn into_columns(mut self) -> (Vec<f64>, Vec<Column>, Closeups) {
        let (rows, closeups) = (&mut self.rows.columns, &mut self.closeups.table.columns);
        // Where a pressure has no bounds there is no figure of it either.
        let known = |index: usize| {
            let mut values = rows[index].iter().chain(&closeups[index]);
            self.columns[index].quantity != Quantity::ContactPressure
                || values.all(|pressure| pressure.is_finite())
        };
        let reported = |index: usize| !self.unreported.contains(&self.columns[index].object);
        let all = 0..self.columns.len();
        let mut order: Vec<usize> = all.filter(|&k| known(k) && reported(k)).collect();
        // The masses of an object come behind the object.
        let mut ids: Vec<&str> = Vec::new();
        for column in &self.columns {
            if ids.last() != Some(&column.object.as_str()) && !ids.contains(&&column.object[..]) {
                ids.push(&column.object);
            }
        }
        order.sort_by_key(|&index| ids.iter().position(|id| *id == self.columns[index].object));
        let column = |&index: &usize| Column {
            values: std::mem::take(&mut rows[index]),
            ..self.columns[index].clone()
        };
        let columns = order.iter().map(column).collect();
        let close = |&index: &usize| std::mem::take(&mut closeups[index]);
        let closeups = Closeups {
            columns: order.iter().map(close).collect(),
            times: self.closeups.table.times,
            every: match self.greatest {
                Some(_) => self.closeups.every,
                None => 0,
            },
        };
        (self.rows.times, columns, closeups)
    }

    fn sample_time(&self, index: usize) -> f64 {
        if index == self.intervals {
            self.duration
        } else {
            self.duration * (index as f64 / self.intervals as f64)
        }
    }
}

/// View of a system at an instant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SystemView<'s> {
    pub(crate) states: &'s [ObjectState],
    /// All masses of all elastic objects, or none.
    pub(crate) masses: &'s [MassState],
}

/// True when all are finite numbers. (Without a way out: mostly all are.)
fn are_finite(values: &[f64]) -> bool {
    let good = |all: bool, value: &f64| all & value.is_finite();
    values.iter().fold(true, good)
}

/// Ids of the objects that stand for others.
fn unreported(system: &System) -> Vec<String> {
    let objects = system.model().objects.iter();
    let others = objects.filter(|part| !part.is_reported());
    others.map(|part| part.id.clone()).collect()
}

/// Columns without values: of all objects, of contact pressures, of all masses.
fn columns(system: &System, pressed: &[usize], masses: bool) -> Vec<Column> {
    let objects = &system.model().objects;
    let column = |part: &ObjectPart, quantity: Quantity| Column {
        object: part.id.clone(),
        quantity,
        unit: quantity.unit(part.coordinate),
        values: Vec::new(),
    };
    let mut columns = Vec::new();
    for part in objects {
        columns.extend(Quantity::ALL.map(|quantity| column(part, quantity)));
    }
    let pressures = pressed
        .iter()
        .map(|&object| column(&objects[object], Quantity::ContactPressure));
    columns.extend(pressures);
    for (object, part) in objects.iter().enumerate().filter(|_| masses) {
        for mass in 1..=system.masses(object) {
            columns.extend(Quantity::of_mass(mass).map(|quantity| column(part, quantity)));
        }
    }
    columns
}

/// True when everything that goes into figures and rows is a number.
pub(crate) fn is_finite(state: &ObjectState) -> bool {
    are_finite(&values(state))
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
    use super::{Rows, SystemView};
    use crate::dynamics::system::{MassState, ObjectState, System};
    use crate::frontend::lower::lower;
    use crate::frontend::scene::{BuiltIn, Document, Overrides};

    const TWO_MASSES: &[u8] = include_bytes!("../../../scenarios/rocker/two_masses.json");

    /// A drive and a lever of two masses.
    fn lever() -> System {
        let document = Document::parse("two_masses.json", TWO_MASSES).unwrap();
        let reading = document.scene(&BuiltIn, &Overrides::none()).unwrap();
        System::new(lower(&reading.scene).unwrap()).unwrap()
    }

    const REST: [ObjectState; 2] = [ObjectState {
        displacement: 0.0,
        speed: 0.0,
        acceleration: 0.0,
        delta: 0.0,
        delta_speed: 0.0,
        reaction: 0.0,
        contact_force: 0.0,
        deformation: 0.0,
        deformation_speed: 0.0,
        lift: 0.0,
        indentation: 0.0,
        pressure: 0.0,
    }; 2];

    fn seen(states: &[ObjectState]) -> SystemView<'_> {
        SystemView {
            states,
            masses: &[],
        }
    }

    #[test]
    fn both_ends_are_sampled_and_rounding_loses_none() {
        let mut rows = Rows::new(&lever(), false, 3, 0.3);
        let mut time = 0.0;
        while time < 0.3 - 1e-9 {
            while let Some(due) = rows.next_sample_until(time) {
                rows.sample_at(due, seen(&REST));
            }
            time += 0.05;
        }
        rows.finish(0.3 * (1.0 - 1e-15), seen(&REST));
        let (times, columns, _) = rows.into_columns();
        assert_eq!(times.len(), 4);
        assert_eq!((times[0], times[3]), (0.0, 0.3));
        assert_eq!((columns[1].unit, columns[4].unit), ("rad/s", "N m"));
        assert!(columns.iter().all(|column| column.values.len() == 4));
    }

    #[test]
    fn a_run_cut_short_has_no_samples_it_did_not_reach() {
        let mut rows = Rows::new(&lever(), false, 10, 1.0);
        rows.sample_at(0.0, seen(&REST));
        rows.finish(0.05, seen(&REST));
        assert_eq!(rows.into_columns().0, [0.0]);
    }

    #[test]
    fn what_is_no_number_makes_no_row() {
        let mut rows = Rows::new(&lever(), false, 10, 1.0);
        let mut endless = REST;
        endless[1].acceleration = f64::INFINITY;
        assert!(rows.sample_at(0.0, seen(&REST)));
        assert!(!rows.sample_at(0.1, seen(&endless)));
        assert!(rows.sample_at(0.2, seen(&REST)));
        let (times, columns, _) = rows.into_columns();
        assert_eq!(times, [0.0, 0.2]);
        assert!(columns.iter().all(|column| column.values.len() == 2));
    }

    #[test]
    fn masses_stand_behind_their_object() {
        let system = lever();
        let mut rows = Rows::new(&system, true, 1, 1.0).with_closeups(true);
        let masses = [1.0, 2.0].map(|force| MassState {
            force,
            ..MassState::default()
        });
        let all = SystemView {
            states: &REST,
            masses: &masses,
        };
        assert!(rows.sample_at(0.0, all));
        let values = rows.values(all).unwrap().to_vec();
        rows.push_closeup(0.5, &values);
        assert!(rows.is_straight([&values[..]; 3], 0.0));
        let (_, columns, closeups) = rows.into_columns();
        let names: Vec<String> = columns
            .iter()
            .map(|column| format!("{}.{}", column.object, column.quantity))
            .collect();
        let rocker = names.iter().position(|name| name == "rocker.displacement");
        let rocker = rocker.unwrap();
        assert_eq!(names[rocker + 6], "rocker.mass_1.displacement");
        assert_eq!(names[rocker + 11], "rocker.link_2.force");
        assert_eq!((columns.len(), closeups.columns.len()), (18, 18));
        assert_eq!(
            (columns[rocker + 11].values[0], closeups.times[0]),
            (2.0, 0.5)
        );
        assert_eq!(closeups.columns[rocker + 8], [1.0]);
    }
}
