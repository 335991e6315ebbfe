//! Kinetostatics of a linkage as findings, rows, document and pictures.

mod changes;
mod charts;
mod document;
mod drawing;
mod findings;
mod reactions;
mod words;

pub use charts::massless_chart;
pub use document::document;
pub use drawing::drawing;
pub use findings::{findings, rows};

use crate::report::course::CourseAxis;
use crate::report::findings::{Layout, Value};
use crate::report::quantity::{DIGITS, significant};
use crate::studies::forces::{ForceStudy, MasslessComparison, Zone};

/// Height of charts over the whole page (pixels).
const WIDE: Layout = Layout::Wide(420.0);

/// Names of the inputs of a linkage of several; else none.
fn inputs(study: &ForceStudy) -> Vec<&str> {
    let several = study.several.iter();
    let all = several.flat_map(|several| &several.spec.inputs);
    all.map(|input| input.name.as_str()).collect()
}

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
    /// Axis along which the positions follow each other.
    fn axis(&self) -> CourseAxis {
        let study = self.study;
        let timed = study.rows.iter().any(|row| row.time.is_some());
        let (name, si) = match &study.several {
            Some(several) => (several.axis, several.unit),
            None if timed => ("time", "s"),
            None => ("input coordinate", study.coordinate_unit()),
        };
        CourseAxis { name, si }
    }

    /// True of a study of one position.
    fn is_of_one_position(&self) -> bool {
        self.study.rows.len() == 1
    }

    /// A place on the course for reading.
    fn place_text(&self, at: f64) -> String {
        let axis = self.axis();
        let place = format!("{} {}", significant(axis.in_unit(at), 6), axis.unit());
        place.trim_end().to_owned()
    }
}

impl ForcesReport<'_> {
    /// What a zone is, in words, and towards where forces grow without bound.
    fn zone(&self, zone: &Zone) -> String {
        let ends = [zone.from, zone.to].into_iter().zip(zone.unbounded);
        let ends = ends.filter(|(_, unbounded)| *unbounded);
        let mut places: Vec<String> = ends.map(|(at, _)| self.place_text(at)).collect();
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
