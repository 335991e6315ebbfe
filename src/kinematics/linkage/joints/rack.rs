//! A gear and a rack on a guide of the gear's carrier.
//!
//! The closing error is the displacement of the rack along its guide less ρ times the angle of the
//! gear, both seen from the carrier. Teeth press at the pitch point along the guide.

use super::super::elements::elements;
use super::super::spec::pair::PairSpec;
use super::carrier::{Mismatch, axis, guide, require_distinct_links};
use super::constraint::{Act, Constraint, Frames, Measure, Shape, Turns, Wrench};
use super::outline::Outline;
use super::reader::{Domain, JointReader, MissingCarrier};
#[cfg(test)]
use super::tests::Sample;
use super::wheels::{WORDS, check_ratio, circle};
use super::{CouplingKind, CouplingSpec, Declaration, Following, Joint, Kind, Words};
use crate::fault::Faults;
use crate::math::number::Number;
use crate::math::series::Series;

/// Half the length of the pitch line that is shown, in radii of the gear.
const LINE: f64 = 1.6;

/// A gear and a rack in plain numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rack {
    /// Displacement of the rack along the guide over the angle of the gear ≠ 0 (m): the radius of
    /// the pitch circle. Positive: the rack lies to the right of the gear, seen along the guide.
    pub radius: f64,
}

/// How racks are written.
pub(super) const DECLARATION: Declaration = Declaration {
    key: "rack",
    doc: "A gear and a rack, which a guide joins to their carrier.",
    read,
    #[cfg(test)]
    samples,
};

/// What is said where no link carries both.
const LACKS: MissingCarrier = MissingCarrier {
    message: "no link has a pin for the gear `{one}` and a guide for the rack `{other}`",
    hint: "join the gear to one link (or to the ground) by a pin, and the rack to it by a guide",
};

fn read(reader: &mut dyn JointReader) -> Option<CouplingSpec> {
    let carried = reader.carried(true, &LACKS);
    let doc = "Radius of the gear's pitch circle; positive: the rack lies to the right of the gear, seen along its guide, and slides forwards as the gear turns counterclockwise.";
    let radius = reader.length("radius", doc, Domain::NotZero, None)?;
    Some(carried?.coupled(CouplingKind::Rack(Rack { radius })))
}

#[cfg(test)]
fn samples() -> Vec<Sample> {
    let kind = || CouplingKind::Rack(Rack { radius: -0.07 });
    let backwards = "rack of a carrier that slides in it";
    vec![
        Sample::of_slide("rack", kind(), true),
        Sample::of_slide(backwards, kind(), false),
    ]
}

/// The gear's axis on the carrier (m), and the guide of the rack.
fn axis_and_rail<'a>(
    coupling: &CouplingSpec,
    pairs: &'a [PairSpec],
) -> Result<([f64; 2], &'a PairSpec), Mismatch> {
    require_distinct_links(coupling)?;
    let [wheel, rack, carrier] = coupling.links();
    let axis = axis(pairs, carrier, wheel).ok_or(Mismatch::no_axis(wheel))?;
    let lacking = Mismatch::Apart(rack, |rack, carrier| {
        let message = format!("no guide joins the rack {rack} to {carrier}");
        [message, "join them by a sliding pair".to_owned()]
    });
    Ok((axis, guide(pairs, carrier, rack).ok_or(lacking)?))
}

impl Kind for Rack {
    fn check(&self, path: &str, faults: &mut Faults) {
        check_ratio(self.radius, path, faults);
    }

    fn check_links(&self, coupling: &CouplingSpec, pairs: &[PairSpec]) -> Result<(), Mismatch> {
        axis_and_rail(coupling, pairs).map(|_| ())
    }

    fn to_joint(&self, coupling: &CouplingSpec, pairs: &[PairSpec]) -> Option<Joint> {
        let (axis, guide) = axis_and_rail(coupling, pairs).ok()?;
        let [on, block] = elements(guide);
        let of_carrier = on.link == coupling.carrier;
        Some(Joint::Rack(RackAndWheel {
            radius: self.radius,
            offset: coupling.offset,
            axis,
            along: on.along,
            points: [on.point, block.point],
            sides: if of_carrier { [2, 1] } else { [1, 2] },
        }))
    }

    /// The gear's pitch circle and the pitch line.
    fn outlines(&self, coupling: &CouplingSpec, pairs: &[PairSpec]) -> Vec<Outline> {
        let Ok((on_carrier, guide)) = axis_and_rail(coupling, pairs) else {
            return Vec::new();
        };
        let carrier = coupling.carrier;
        let [on, block] = elements(guide);
        let own = if on.link == carrier { on } else { block };
        let line = Outline::Line(carrier, pitch_line(on_carrier, self.radius, own.along));
        let circle = circle(coupling, pairs, 0, self.radius);
        circle.into_iter().chain([line]).collect()
    }

    fn link_following(&self) -> (&'static str, Following) {
        ("rack", Following::Slides(self.radius))
    }

    fn words(&self) -> Words {
        Words {
            drawn: "teeth act on the rack, at the pitch point",
            ..WORDS
        }
    }
}

/// The pitch point lies beside the axis, at right angles to the guide.
fn pitch_point([x, y]: [f64; 2], radius: f64, [tx, ty]: [f64; 2]) -> [f64; 2] {
    [x + radius * ty, y - radius * tx]
}

fn pitch_line(axis: [f64; 2], radius: f64, along: [f64; 2]) -> [[f64; 2]; 2] {
    let ([x, y], [tx, ty]) = (pitch_point(axis, radius, along), along);
    [-1.0, 1.0].map(|end| {
        let reach = end * LINE * radius.abs();
        [x + reach * tx, y + reach * ty]
    })
}

/// A gear and a rack made ready.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RackAndWheel {
    /// ρ (m).
    radius: f64,
    /// Displacement of the rack where the gear's angle is zero (m).
    offset: f64,
    /// The gear's axis in the frame of the carrier (m).
    axis: [f64; 2],
    /// Direction of the guide in the frame of the link that has it.
    along: [f64; 2],
    /// A point of the guide's axis, and the block's reference point (m).
    points: [[f64; 2]; 2],
    /// Which of the links has the guide, and which the block.
    sides: [usize; 2],
}

impl RackAndWheel {
    /// +1 where the guide is on the carrier.
    fn sign(&self) -> f64 {
        if self.sides[0] == 2 { 1.0 } else { -1.0 }
    }
}

impl Constraint for RackAndWheel {
    const SHAPE: Shape = Shape {
        rows: &[Measure::Length],
        links: 3,
        turning: &[0, 2],
    };

    #[inline(always)]
    fn errors<const K: usize>(&self, links: &impl Turns<K>, mut set: impl FnMut(usize, Series<K>)) {
        let (on, block) = (links.frame(self.sides[0]), links.frame(self.sides[1]));
        let along = on.direction.turn_constant(self.along);
        let gap = block.place(self.points[1]) - on.place(self.points[0]);
        let slid = along.dot(gap).scale(self.sign());
        let turned = (links.angle(0) - links.angle(2)).scale(self.radius);
        set(0, (slid - turned).shift(-self.offset));
    }

    #[inline(always)]
    fn rows<const K: usize, T: Number>(
        &self,
        links: &impl Frames<K, T>,
        mut add: impl FnMut(usize, usize, Wrench<K, T>),
    ) {
        let (on, block) = (links.frame(self.sides[0]), links.frame(self.sides[1]));
        let force = on.direction.turn_constant(self.along);
        let at = block.place(self.points[1]);
        add(0, 0, Wrench::couple(-self.radius));
        add(0, 1, Wrench::Force { at, force });
        add(0, 2, Wrench::Force { at, force: -force });
        add(0, 2, Wrench::couple(self.radius));
    }

    fn unit_force_acts(&self, links: &impl Frames<1, f64>) -> [Act; 2] {
        let along = links.frame(self.sides[0]).direction;
        let along = along.turn_constant(self.along).value();
        let axis = links.frame(2).place(self.axis).value();
        Act::opposite(pitch_point(axis, self.radius, along), along)
    }
}
