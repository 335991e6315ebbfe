//! The axis of a course of positions: an input coordinate, time, or a path of several inputs; and
//! where a function of pieces is sampled.

use super::plot::Axis;

/// The quantity that leads from one position to the next.
#[derive(Clone, Copy, Debug)]
pub(in crate::report) struct CourseAxis {
    /// Name in words.
    pub(in crate::report) name: &'static str,
    /// SI unit.
    pub(in crate::report) si: &'static str,
}

impl CourseAxis {
    /// Unit in pictures: angles are in degrees.
    pub(in crate::report) fn unit(self) -> &'static str {
        match self.si {
            "rad" => "deg",
            unit => unit,
        }
    }

    /// A place in this unit.
    pub(in crate::report) fn in_unit(self, at: f64) -> f64 {
        match self.si {
            "rad" => at.to_degrees(),
            _ => at,
        }
    }

    /// The axis of a chart.
    pub(in crate::report) fn of_chart(self) -> Axis {
        let symbol = match self.name {
            "time" => "t",
            "path" => "path",
            _ => "q",
        };
        Axis::new(symbol, self.unit())
    }
}

/// Samples of a function of pieces: both ends of every piece and, between them, the ends of
/// `count` equal steps over the whole, which has this start and length.
pub(crate) fn samples<T>(
    pieces: impl IntoIterator<Item = [f64; 2]>,
    [start, length]: [f64; 2],
    count: usize,
    mut at: impl FnMut(usize, f64) -> T,
) -> Vec<T> {
    let count = count.max(1);
    let mut found = Vec::new();
    for (piece, [from, to]) in pieces.into_iter().enumerate() {
        let steps = (0..=count).map(|step| start + length * step as f64 / count as f64);
        let inner = steps.filter(|&place| from < place && place < to);
        let places = [from].into_iter().chain(inner).chain([to]);
        found.extend(places.map(|place| at(piece, place)));
    }
    found
}
