//! Figures of a study by name, as a scene's expectations address them.

use super::columns::{Inputs, headings, name};
use super::{Kinematics, KinematicsRequest, Over};
use crate::dynamics::model::Coordinate;
use crate::kinematics::linkage::spec::LinkageSpec;

/// Ends of a quantity, value and place, with their meaning.
pub(super) const ENDS: [(&str, &str); 4] = [
    ("least", "least value over the course"),
    ("greatest", "greatest value over the course"),
    (
        "least_at",
        "place of the least value: input coordinate or time",
    ),
    (
        "greatest_at",
        "place of the greatest value: input coordinate or time",
    ),
];
/// Results of a stroke, with their meaning.
pub(super) const STROKE: [(&str, &str); 4] = [
    (
        "stroke",
        "Distance between the ends of the displacement, ≥ 0",
    ),
    (
        "time_ratio",
        "Longer over shorter of the times of rise and return, ≥ 1",
    ),
    (
        "input_while_rising",
        "Motion of the input during the rise, ≥ 0",
    ),
    (
        "input_while_falling",
        "Motion of the input during the return, ≥ 0",
    ),
];
/// Ends of the range of motion, with their meaning.
pub(super) const LIMITS: [(&str, &str); 2] = [
    ("lower", "Lower end of the range of motion of the input"),
    ("upper", "Upper end of the range of motion of the input"),
];
/// Meaning of a transmission angle.
pub(super) const TRANSMISSION: &str =
    "Transmission angle at the link, in its group, between 0 and 90 deg.";

/// A figure that a study can have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedFigure {
    /// Name within the study: `ram.speed.greatest`.
    pub name: String,
    /// SI unit; empty for a plain number.
    pub unit: String,
}

impl NamedFigure {
    /// A figure of this name and SI unit.
    pub(in crate::studies) fn new(name: impl Into<String>, unit: &str) -> Self {
        let unit = if unit == "1" { "" } else { unit };
        Self {
            name: name.into(),
            unit: unit.to_owned(),
        }
    }

    /// The ends of a quantity with their places.
    pub(in crate::studies) fn ends<'a>(
        quantity: &'a str,
        unit: &'a str,
        place: &'a str,
    ) -> impl Iterator<Item = Self> + 'a {
        ENDS.into_iter().map(move |(end, _)| {
            let unit = if end.ends_with("_at") { place } else { unit };
            Self::new(format!("{quantity}.{end}"), unit)
        })
    }
}

impl KinematicsRequest<'_> {
    /// All figures that a study of this question can have.
    pub fn figures(&self) -> Vec<NamedFigure> {
        let input = self.input.unit();
        let places = Places {
            rows: self.axis_unit(),
            input,
        };
        let inputs = Inputs::One(self.input);
        figures_of(self.linkage.spec(), &inputs, &self.outputs, places)
    }

    /// SI unit of what leads from row to row.
    pub(in crate::studies) fn axis_unit(&self) -> &'static str {
        match self.over {
            Over::Time { .. } => "s",
            Over::Turn | Over::Range { .. } => self.input.unit(),
        }
    }
}

/// SI units of places.
#[derive(Clone, Copy)]
pub(super) struct Places {
    /// Of rows and extremes.
    pub(super) rows: &'static str,
    /// Of the input while something rises and falls.
    pub(super) input: &'static str,
}

/// All figures of a study of a linkage with these inputs; `outputs`: how its outputs move.
pub(super) fn figures_of(
    spec: &LinkageSpec,
    inputs: &Inputs<'_>,
    outputs: &[Coordinate],
    places: Places,
) -> Vec<NamedFigure> {
    let mut all = Vec::new();
    for heading in headings(spec, inputs, outputs) {
        let column = name(&heading.owner, heading.quantity, heading.by.as_deref());
        all.extend(NamedFigure::ends(&column, &heading.unit, places.rows));
    }
    let outputs =
        (spec.outputs.iter().zip(outputs)).map(|(one, own)| (one.name.clone(), own.unit()));
    let slides = spec.pairs.iter().filter(|pair| pair.slides());
    let slides = slides.map(|pair| (format!("pairs.{}", pair.name), "m"));
    for (owner, unit) in outputs.chain(slides) {
        let units = [unit, "", places.input, places.input];
        let strokes = STROKE.into_iter().zip(units);
        all.extend(
            strokes.map(|((what, _), unit)| NamedFigure::new(format!("{owner}.{what}"), unit)),
        );
    }
    for link in &spec.links {
        let owner = format!("transmission_angles.{}", link.name);
        all.extend(NamedFigure::ends(&owner, "rad", places.rows));
    }
    let limits = LIMITS.map(|(end, _)| format!("limits.{end}"));
    all.extend(limits.map(|name| NamedFigure::new(name, places.input)));
    all
}

impl Kinematics {
    /// A figure by its name: `ram.speed.greatest`, `ram.speed.greatest_at`,
    /// `ram.time_ratio`, `transmission_angles.rod.least`, `limits.upper`; SI
    /// units. `None` where this study has none of that name.
    ///
    /// A transmission angle is that of the first group with the link.
    pub fn figure(&self, name: &str) -> Option<f64> {
        let (owner, what) = name.rsplit_once('.')?;
        if owner == "limits" {
            let index = LIMITS.iter().position(|(end, _)| *end == what)?;
            return self.limits.get(index).map(|limit| limit.at);
        }
        if let Some(link) = owner.strip_prefix("transmission_angles.") {
            let of = |owner: &str| owner.split(" and ").any(|name| name == link);
            let angle = self.transmission.iter().find(|angle| of(&angle.owner))?;
            return end([angle.least, angle.greatest], what);
        }
        if let Some(stroke) = self.strokes.iter().find(|stroke| stroke.owner == owner) {
            let [rising, falling] = stroke.rise_and_return;
            match what {
                "stroke" => return Some(stroke.ends[1].1 - stroke.ends[0].1),
                "time_ratio" => return Some(stroke.time_ratio),
                "input_while_rising" => return Some(rising),
                "input_while_falling" => return Some(falling),
                _ => {}
            }
        }
        let index = self
            .columns
            .iter()
            .position(|column| column.name() == owner)?;
        let extremes = self.extremes.get(index)?;
        end([extremes.least, extremes.greatest], what)
    }
}

pub(in crate::studies) fn end(ends: [(f64, f64); 2], what: &str) -> Option<f64> {
    let [(least_at, least), (greatest_at, greatest)] = ends;
    let value = match what {
        "least" => least,
        "greatest" => greatest,
        "least_at" => least_at,
        "greatest_at" => greatest_at,
        _ => return None,
    };
    value.is_finite().then_some(value)
}
