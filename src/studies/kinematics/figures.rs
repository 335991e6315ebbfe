//! Figures of a study by name, as a scene's expectations address them.

use super::columns::{Heading, headings, name};
use super::{Asked, Extremes, Kinematics};
use crate::kinematics::linkage::spec::LinkageSpec;

/// Ends of a quantity: value and place.
pub(in crate::studies) const ENDS: [&str; 4] = ["least", "greatest", "least_at", "greatest_at"];
/// What is told of a stroke.
const STROKE: [&str; 4] = [
    "stroke",
    "time_ratio",
    "input_while_rising",
    "input_while_falling",
];

impl Asked<'_> {
    /// Names of all figures that a study of this question can have.
    pub fn figures(&self) -> Vec<String> {
        names_of(&headings(self), self.linkage.spec())
    }
}

/// Names of all figures of a study with these columns.
pub(super) fn names_of(headings: &[Heading], spec: &LinkageSpec) -> Vec<String> {
    let mut names = Vec::new();
    for heading in headings {
        let column = name(&heading.owner, heading.quantity, heading.by.as_deref());
        names.extend(ENDS.map(|end| format!("{column}.{end}")));
    }
    let outputs = spec.outputs.iter().map(|output| output.name.clone());
    let slides = spec.pairs.iter().filter(|pair| pair.slides());
    let slides = slides.map(|pair| format!("pairs.{}", pair.name));
    for owner in outputs.chain(slides) {
        names.extend(STROKE.map(|what| format!("{owner}.{what}")));
    }
    for link in &spec.links {
        let owner = format!("transmission_angles.{}", link.name);
        names.extend(ENDS.map(|end| format!("{owner}.{end}")));
    }
    names.extend(["limits.lower".to_owned(), "limits.upper".to_owned()]);
    names
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
            let index = ["lower", "upper"].iter().position(|end| *end == what)?;
            return self.limits.get(index).map(|limit| limit.at);
        }
        if let Some(link) = owner.strip_prefix("transmission_angles.") {
            let of = |owner: &str| owner.split(" and ").any(|name| name == link);
            let angle = self.transmission.iter().find(|angle| of(&angle.owner))?;
            return end(
                Extremes {
                    least: angle.least,
                    greatest: angle.greatest,
                },
                what,
            );
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
        end(*self.extremes.get(index)?, what)
    }
}

fn end(extremes: Extremes, what: &str) -> Option<f64> {
    let ((least_at, least), (greatest_at, greatest)) = (extremes.least, extremes.greatest);
    let value = match what {
        "least" => least,
        "greatest" => greatest,
        "least_at" => least_at,
        "greatest_at" => greatest_at,
        _ => return None,
    };
    value.is_finite().then_some(value)
}
