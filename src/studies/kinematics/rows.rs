//! The rows of a study, one after the other, whatever leads from one to the next.

use super::columns::ColumnHeading;
use super::extremes::{Edge, extremes};
use super::{Column, Extremes};
use crate::studies::endless::{DeadEnd, places_towards_end};
use crate::units::shown;

/// Share of its own size, or of what is ordinary for it, that the error of a value may have.
const DETERMINED: f64 = 1e-3;

/// What leads a linkage from place to place on the axis, and what is known of it there.
pub(super) trait Course {
    /// Why there is nothing at a place.
    type Outside;

    /// The columns, in the order of the values.
    fn headings(&self) -> Vec<ColumnHeading>;

    /// Goes to a place; the values of all columns there.
    fn at(&mut self, place: f64, values: &mut Vec<f64>) -> Result<(), Self::Outside>;

    /// Estimated errors of the values at the place gone to last.
    fn errors(&mut self, place: f64, values: &[f64], errors: &mut Vec<f64>);

    /// Size that is ordinary for a column at a place.
    fn ordinary_size(&self, place: f64, heading: &ColumnHeading) -> f64;

    /// Notes the place gone to last as a row; the frames of all links: x, y, cos, sin.
    fn add_row(&mut self) -> Vec<[f64; 4]>;

    /// Goes on from a row noted earlier, where that makes a difference.
    fn resume(&mut self, _row: usize) {}

    /// Places of dead-centre positions at which the reach ends, as far as they are known.
    fn limits(&self) -> Vec<DeadEnd> {
        Vec::new()
    }
}

/// Places at equal distances, and one more where it is asked for; a single one where both ends
/// are the same.
pub(super) fn equally_spaced_places(
    [from, to]: [f64; 2],
    count: usize,
    also: Option<f64>,
) -> Vec<f64> {
    if from == to {
        return vec![from];
    }
    let mut places: Vec<f64> = (0..=count)
        .map(|index| from + (to - from) * index as f64 / count as f64)
        .collect();
    if let Some(also) = also {
        let sense = (to - from).signum();
        let at = places.partition_point(|place| (place - also) * sense < 0.0);
        if places.get(at) != Some(&also) {
            places.insert(at, also);
        }
    }
    places
}

/// Times of places that are passed at this rate, from the first one on; at rest as if it were 1.
pub(super) fn times_of_places(places: &[f64], rate: f64) -> Vec<f64> {
    let rate = rate.abs();
    let rate = if rate > 0.0 { rate } else { 1.0 };
    let from = places.first().copied().unwrap_or(0.0);
    let time = |place: &f64| (place - from).abs() / rate;
    places.iter().map(time).collect()
}

/// Rows under construction.
pub(super) struct Rows<C> {
    pub(super) course: C,
    errors: Vec<f64>,
    pub(super) places: Vec<f64>,
    headings: Vec<ColumnHeading>,
    pub(super) columns: Vec<Column>,
    /// Frames of all links, a row each.
    pub(super) frames: Vec<Vec<[f64; 4]>>,
}

impl<C: Course> Rows<C> {
    pub(super) fn new(course: C) -> Self {
        let headings = course.headings();
        let column = |heading: &ColumnHeading| Column {
            owner: heading.owner.clone(),
            quantity: heading.quantity,
            by: heading.by.clone(),
            unit: heading.unit.clone(),
            values: Vec::new(),
            error: 0.0,
            undetermined: 0,
            unbounded: Vec::new(),
        };
        Self {
            errors: Vec::new(),
            places: Vec::new(),
            columns: headings.iter().map(column).collect(),
            headings,
            frames: Vec::new(),
            course,
        }
    }

    /// All rows up to the end, or up to where the linkage goes no further: the last place
    /// before, the first beyond, and why.
    pub(super) fn fill(&mut self, places: &[f64]) -> Option<(f64, f64, C::Outside)> {
        let mut values = Vec::new();
        for &place in places {
            if let Err(outside) = self.row(place, &mut values) {
                let before = self.places.last().or(places.first());
                return Some((before.copied().unwrap_or(place), place, outside));
            }
        }
        None
    }

    fn row(&mut self, place: f64, values: &mut Vec<f64>) -> Result<(), C::Outside> {
        self.course.at(place, values)?;
        self.course.errors(place, values, &mut self.errors);
        let found = values.iter().zip(&self.errors);
        let columns = self.columns.iter_mut().zip(&self.headings);
        for ((column, heading), (value, error)) in columns.zip(found) {
            let ordinary = self.course.ordinary_size(place, heading).max(value.abs());
            if *error > DETERMINED * ordinary {
                let counts = value.is_finite() && !column.quantity.passes_infinity();
                column.undetermined += usize::from(counts);
                column.values.push(f64::NAN);
            } else {
                column.error = column.error.max(*error);
                column.values.push(*value);
            }
        }
        self.frames.push(self.course.add_row());
        self.places.push(place);
        Ok(())
    }

    /// The dead-centre positions at which the rows end.
    fn dead_centres_at_ends(&mut self) -> Vec<Edge> {
        let (Some(&first), Some(&last)) = (self.places.first(), self.places.last()) else {
            return Vec::new();
        };
        let mut edges = Vec::new();
        for end in self.course.limits() {
            let (row, far) = match (end.is_at(first), end.is_at(last)) {
                // All rows are there.
                (true, true) => (0, end.other),
                (true, false) => (0, last),
                (false, true) => (self.places.len() - 1, first),
                (false, false) => continue,
            };
            self.course.resume(row);
            let rows = places_towards_end(end.at, far).map(|place| self.determined(place));
            edges.push(Edge { at: end.at, rows });
        }
        edges
    }

    /// Values of all columns at a place, as far as they are determined there.
    fn determined(&mut self, place: f64) -> Vec<f64> {
        let mut values = Vec::new();
        if self.course.at(place, &mut values).is_err() {
            return vec![f64::NAN; self.columns.len()];
        }
        self.course.errors(place, &values, &mut self.errors);
        for ((value, error), column) in values.iter_mut().zip(&self.errors).zip(&self.columns) {
            // (What passes infinity has no bounds there either way.)
            if *error > DETERMINED * value.abs() || column.quantity.passes_infinity() {
                *value = f64::NAN;
            }
        }
        values
    }

    /// Least and greatest value of every column, between the rows too; infinite where it grows
    /// without bound towards an end of the rows.
    pub(super) fn extremes(&mut self) -> Vec<Extremes> {
        let edges = self.dead_centres_at_ends();
        for (index, column) in self.columns.iter_mut().enumerate() {
            let endless =
                |edge: &&Edge| [1.0, -1.0].iter().any(|&sign| edge.is_endless(index, sign));
            column.unbounded = edges.iter().filter(endless).map(|edge| edge.at).collect();
        }
        let (course, mut values) = (&mut self.course, Vec::new());
        extremes(
            &self.places,
            &self.columns,
            &edges,
            &mut |place, row, column| {
                course.resume(row);
                match course.at(place, &mut values) {
                    Ok(()) => values[column],
                    Err(_) => f64::NAN,
                }
            },
        )
    }
}

/// Quantities that are not determined somewhere, or beyond what can be written as a number.
pub(super) fn warnings(columns: &[Column], rows: usize) -> Vec<String> {
    let mut warnings = Vec::new();
    let doubtful = columns.iter().filter(|column| column.undetermined > 0);
    if let Some(names) = first_and_others(doubtful.clone()) {
        let most = doubtful.map(|column| column.undetermined).max();
        warnings.push(format!(
            "{names} are not determined at up to {} of {rows} positions: so near to a singular \
             position rounding changes them by more than {} of their size",
            most.unwrap_or(0),
            shown(DETERMINED, 1)
        ));
    }
    if let Some(names) = first_and_others(columns.iter().filter(|column| column.is_lost())) {
        warnings.push(format!(
            "{names} grow beyond all numbers: the speed is too great"
        ));
    }
    warnings
}

/// The first of several columns by its name, and how many others there are.
fn first_and_others<'c>(mut columns: impl Iterator<Item = &'c Column>) -> Option<String> {
    let first = columns.next()?.name();
    Some(match columns.count() {
        0 => format!("`{first}`"),
        1 => format!("`{first}` and another"),
        count => format!("`{first}` and {count} others"),
    })
}
