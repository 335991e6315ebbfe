//! Two gears, with external teeth or one of them with internal teeth.
//!
//! Teeth press at the pitch point along the common tangent of the pitch circles. What presses on
//! both gears alike is not counted, since the linkage does not tell it: the separating force of the
//! pressure angle.

use super::super::spec::pair::PairSpec;
use super::carrier::{Mismatch, axes};
use super::constraint::Act;
use super::outline::Outline;
use super::reader::{JointReader, Sizes};
#[cfg(test)]
use super::tests::Sample;
use super::wheels::{LACKS, TwoWheels, WORDS, check_ratio, circles, direction_and_distance, wrong};
use super::{CouplingKind, CouplingSpec, Declaration, Following, Joint, Kind, Words};
use crate::fault::Faults;

/// Two gears in plain numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gear {
    /// Angle of the second over that of the first, seen from the carrier: negative for external
    /// teeth, ≠ 0 and ≠ 1.
    pub ratio: f64,
}

/// How gears are written.
pub(super) const DECLARATION: Declaration = Declaration {
    key: "gear",
    doc: "Two gears: seen from their carrier they turn as their numbers of teeth say.",
    read,
    #[cfg(test)]
    samples,
};

fn read(reader: &mut dyn JointReader) -> Option<CouplingSpec> {
    let carried = reader.carried(false, &LACKS);
    let teeth = "Numbers of teeth of the first and the second gear.";
    let diameters = "In place of `teeth`: diameters of the pitch circles; their ratio counts.";
    let sizes = reader.sizes_as_written(
        "the sizes of the gears",
        &[
            ("teeth", teeth, Sizes::Teeth),
            ("diameters", diameters, Sizes::Diameters),
        ],
    );
    let doc = "True: one of them has internal teeth, and both turn in the same sense.";
    let internal = reader.flag("internal", doc);
    let ([one, other], internal) = (sizes?, internal?);
    let sense = if internal { 1.0 } else { -1.0 };
    let ratio = sense * one / other;
    Some(carried?.coupled(CouplingKind::Gear(Gear { ratio })))
}

#[cfg(test)]
fn samples() -> Vec<Sample> {
    let kind = CouplingKind::Gear(Gear { ratio: -1.6 });
    vec![Sample::of_wheels("gear", kind)]
}

impl Kind for Gear {
    fn check(&self, path: &str, faults: &mut Faults) {
        check_ratio(self.ratio, path, faults);
    }

    fn check_links(&self, coupling: &CouplingSpec, pairs: &[PairSpec]) -> Result<(), Mismatch> {
        axes(coupling, pairs)?;
        if self.ratio == 1.0 {
            let message = "internal gears of the same size cannot roll on each other".to_owned();
            return Err(wrong(message, "give other numbers of teeth, or a belt"));
        }
        Ok(())
    }

    fn to_joint(&self, coupling: &CouplingSpec, pairs: &[PairSpec]) -> Option<Joint> {
        TwoWheels::new(coupling, pairs, [self.ratio, 1.0], press).map(Joint::Gear)
    }

    /// Both pitch circles.
    fn outlines(&self, coupling: &CouplingSpec, pairs: &[PairSpec]) -> Vec<Outline> {
        let Ok(axes) = axes(coupling, pairs) else {
            return Vec::new();
        };
        let unit = direction_and_distance(axes).1 / (self.ratio - 1.0);
        circles(coupling, pairs, [self.ratio * unit, unit]).collect()
    }

    fn link_following(&self) -> (&'static str, Following) {
        ("gears", Following::Turns(self.ratio))
    }

    fn words(&self) -> Words {
        Words {
            drawn: "teeth act on the second gear, at the pitch point",
            ..WORDS
        }
    }
}

/// At the pitch point both gears have one velocity, seen from the carrier: it divides the distance
/// of their axes.
fn press(axes: [[f64; 2]; 2], [ratio, _]: [f64; 2]) -> [Act; 2] {
    let ([ux, uy], apart) = direction_and_distance(axes);
    let reach = apart * ratio / (ratio - 1.0);
    let at = [axes[0][0] + reach * ux, axes[0][1] + reach * uy];
    // To the left of the line of centres, or to the right: so that the second gear turns forwards.
    let sense = (ratio - 1.0).signum();
    Act::opposite(at, [-sense * uy, sense * ux])
}
