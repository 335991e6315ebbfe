//! Kinetostatics of a linkage as findings, rows, document and pictures.

mod changes;
mod charts;
mod document;
mod drawing;
mod findings;

pub use charts::massless_chart;
pub use document::document;
pub use drawing::drawing;
pub use findings::{findings, rows};

use crate::report::findings::{Layout, Value};
use crate::report::quantity::{DIGITS, significant};
use crate::studies::forces::{ForceStudy, MasslessComparison, Zone};

/// Height of charts over the whole page (pixels).
const WIDE: Layout = Layout::Wide(420.0);

/// A quantity of the study.
fn value(value: f64, unit: &str) -> Value {
    Value::new(value, unit, DIGITS)
}

/// Everything that is told of a study.
#[derive(Clone, Copy, Debug)]
pub struct ForcesReport<'a> {
    /// Study that is reported.
    pub study: &'a ForceStudy,
    /// Warnings beside the figures.
    pub warnings: &'a [String],
    /// The comparison of the massless with the full model, where it was asked for.
    pub massless: Option<&'a MasslessComparison>,
    /// The linkage's id.
    pub object: &'a str,
    /// Motion of the input, in words.
    pub motion: &'a str,
    /// Name of the scene.
    pub name: &'a str,
    /// SHA-256 of the canonical scene.
    pub hash: &'a str,
}

impl ForcesReport<'_> {
    /// True when the course runs over time.
    fn over_time(&self) -> bool {
        let several = self.study.several.as_ref();
        self.study.rows.iter().any(|row| row.time.is_some())
            || several.is_some_and(|several| several.unit == "s")
    }

    /// Name of the course's parameter.
    fn axis_name(&self) -> &'static str {
        match (&self.study.several, self.over_time()) {
            (Some(several), _) => several.axis,
            (None, true) => "time",
            (None, false) => "input coordinate",
        }
    }

    /// Its symbol in charts.
    fn axis_symbol(&self) -> &'static str {
        match self.axis_name() {
            "time" => "t",
            "path" => "path",
            _ => "q",
        }
    }

    /// Unit of the course's parameter, angles in degrees.
    fn axis_unit(&self) -> &'static str {
        match (self.over_time(), self.study.coordinate_unit()) {
            (true, _) => "s",
            (false, "rad") => "deg",
            (false, unit) => unit,
        }
    }

    /// A value of the course's parameter as it is shown.
    fn axis_value(&self, at: f64) -> f64 {
        match self.axis_unit() {
            "deg" => at.to_degrees(),
            _ => at,
        }
    }

    /// A place on the course for reading.
    fn place(&self, at: f64) -> String {
        let place = format!(
            "{} {}",
            significant(self.axis_value(at), 6),
            self.axis_unit()
        );
        place.trim_end().to_owned()
    }
}

impl ForcesReport<'_> {
    /// What a zone is, in words, and towards where forces grow without bound.
    fn zone(&self, zone: &Zone) -> String {
        let ends = [zone.from, zone.to].into_iter().zip(zone.unbounded);
        let ends = ends.filter(|(_, unbounded)| *unbounded);
        let mut places: Vec<String> = ends.map(|(at, _)| self.place(at)).collect();
        places.dedup();
        match places.is_empty() {
            true => zone.kind.words().to_owned(),
            false => format!(
                "{}; forces unbounded towards {}",
                zone.kind.words(),
                places.join(" and ")
            ),
        }
    }
}
