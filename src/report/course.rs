//! What the positions of a linkage are told over: its input coordinate, time, or a path of
//! several inputs.

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
    pub(in crate::report) fn shown(self, at: f64) -> f64 {
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
