//! What is known of a question about a linkage of several inputs: its way, and where that leads.

use super::request::{Advance, AskedSeveral, Leg};
use crate::dynamics::model::Coordinate;
use crate::kinematics::linkage::multi::MultiMotion;
use crate::math::jet::Jet;
use crate::math::roots::{BISECTIONS, bisect};
use crate::studies::endless::DeadEnd;
use crate::units::shown;

/// Part of a way beside its ends in which singular positions are looked for.
const BESIDE: f64 = 1e-6;

impl AskedSeveral<'_> {
    /// True where every input has the speed of its way, and no acceleration.
    pub(in crate::studies) fn is_uniform(&self) -> bool {
        match &self.way {
            Advance::Time { .. } => true,
            Advance::Path { rate, legs, .. } => {
                (legs.iter()).all(|leg| leg.speed == rate * leg.slope && leg.acceleration == 0.0)
            }
        }
    }

    /// Name and SI unit of what leads from row to row.
    pub(in crate::studies) fn axis(&self) -> (&'static str, &'static str) {
        match self.way {
            Advance::Time { .. } => ("time", "s"),
            Advance::Path { along: Some(_), .. } => {
                ("input coordinate", self.first_coordinate().unit())
            }
            Advance::Path { along: None, .. } => ("path", ""),
        }
    }

    /// Name of an input.
    pub(super) fn name(&self, input: usize) -> &str {
        &self.linkage.inputs()[input].name
    }

    /// Names of the outputs.
    pub(super) fn outputs(&self) -> impl Iterator<Item = &str> {
        let outputs = self.linkage.outputs().iter();
        outputs.map(|output| output.name.as_str())
    }

    /// Whether the input along the axis, or the first, turns or slides.
    pub(super) fn first_coordinate(&self) -> Coordinate {
        match self.way {
            Advance::Path {
                along: Some(input), ..
            } => self.inputs[input],
            _ => self.inputs[0],
        }
    }

    /// First and last place on the axis.
    pub(in crate::studies) fn span(&self) -> [f64; 2] {
        match self.way {
            Advance::Time { to } => [0.0, to],
            Advance::Path { span, .. } => span,
        }
    }

    /// Places on the axis of the singular positions at which the way ends, each with a place
    /// inwards.
    pub(in crate::studies) fn dead_ends(&self) -> Vec<DeadEnd> {
        if let [(lower, _), (upper, _)] = self.limits[..] {
            return vec![DeadEnd::new([lower, upper]), DeadEnd::new([upper, lower])];
        }
        match self.way {
            Advance::Path { along, span, .. } if !self.closed => self.dead_ends_of(along, span),
            _ => Vec::new(),
        }
    }

    /// Singular positions just beyond, or just before, the ends of a range.
    fn dead_ends_of(&self, along: Option<usize>, [from, to]: [f64; 2]) -> Vec<DeadEnd> {
        let length = match along.map(|input| self.inputs[input]) {
            _ if from != to => to - from,
            Some(Coordinate::Sliding) => self.linkage.typical_length(),
            _ => 1.0,
        };
        let ends = [[from, length], [to, -length]].into_iter();
        let ends = ends.filter_map(|[place, inwards]| {
            let mut motion = MultiMotion::new(&self.linkage);
            let mut go = |part: f64| {
                motion
                    .set_inputs(&self.inputs_at(place + part * inwards))
                    .is_ok()
            };
            if !go(BESIDE) || go(-BESIDE) {
                return None;
            }
            let [last, _] = bisect([BESIDE, -BESIDE], BISECTIONS, &mut go);
            Some(DeadEnd::new([place + last * inwards, place + inwards]))
        });
        ends.collect()
    }

    /// Rate of the axis.
    pub(in crate::studies) fn axis_rate(&self) -> f64 {
        match self.way {
            Advance::Time { .. } => 1.0,
            Advance::Path { rate, .. } => rate,
        }
    }

    /// Motions of all inputs at a place of the axis.
    pub(in crate::studies) fn inputs_at(&self, place: f64) -> Vec<Jet> {
        match (&self.way, &self.trajectories) {
            (Advance::Path { legs, .. }, _) => {
                let jet = |leg: &Leg| Jet {
                    value: leg.base + leg.slope * place,
                    first: leg.speed,
                    second: leg.acceleration,
                    third: 0.0,
                };
                legs.iter().map(jet).collect()
            }
            (Advance::Time { .. }, Some(all)) => all.iter().map(|one| one.at(place)).collect(),
            // (Refused before.)
            (Advance::Time { .. }, None) => vec![Jet::UNKNOWN; self.inputs.len()],
        }
    }

    /// Motion of the inputs, in words.
    pub(in crate::studies) fn motion(&self) -> String {
        let Advance::Path { legs, along, .. } = &self.way else {
            return "by the scene's drives".to_owned();
        };
        let one = |(input, leg): (usize, &Leg)| {
            let unit = self.inputs[input].unit();
            let name = self.name(input);
            let own = |value: f64| {
                let (value, unit) = self.inputs[input].displacement_for_reading(value);
                format!("{} {unit}", shown(value, 6))
            };
            let mut words = match (leg.slope != 0.0, along) {
                (false, _) => format!("{name} at {}", own(leg.base)),
                (true, Some(_)) => name.to_owned(),
                (true, None) => {
                    format!(
                        "{name} from {} to {}",
                        own(leg.base),
                        own(leg.base + leg.slope)
                    )
                }
            };
            if leg.speed != 0.0 {
                words += &format!(" with {} {unit}/s", shown(leg.speed, 6));
            }
            if leg.acceleration != 0.0 {
                words += &format!(" and {} {unit}/s²", shown(leg.acceleration, 6));
            }
            words
        };
        let all: Vec<String> = legs.iter().enumerate().map(one).collect();
        all.join(", ")
    }
}
