//! A belt or chain over two pulleys, open or crossed.
//!
//! The difference of the forces of both strands acts, each in its own direction. The pretension is
//! not counted, since the linkage does not tell it.

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
use crate::units::shown;

/// A belt in plain numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Belt {
    /// Radii (m): the first positive, the second negative for a crossed belt; ρ = r₁/r₂.
    pub radii: [f64; 2],
}

/// How belts are written.
pub(super) const DECLARATION: Declaration = Declaration {
    key: "belt",
    doc: "A belt or chain over two pulleys.",
    read,
    #[cfg(test)]
    samples,
};

fn read(reader: &mut dyn JointReader) -> Option<CouplingSpec> {
    let carried = reader.carried(false, &LACKS);
    let doc = "Diameters of the first and the second pulley.";
    let sizes = reader.sizes("diameters", doc, Sizes::Diameters);
    let doc = "True: the belt is crossed, and the pulleys turn against each other.";
    let crossed = reader.flag("crossed", doc);
    let ([one, other], crossed) = (sizes?, crossed?);
    let sense = if crossed { -1.0 } else { 1.0 };
    let radii = [0.5 * one, sense * 0.5 * other];
    Some(carried?.coupled(CouplingKind::Belt(Belt { radii })))
}

#[cfg(test)]
fn samples() -> Vec<Sample> {
    let radii = [0.1, -0.15];
    let kind = CouplingKind::Belt(Belt { radii });
    vec![Sample::of_wheels("belt", kind)]
}

impl Kind for Belt {
    fn check(&self, path: &str, faults: &mut Faults) {
        check_ratio(self.radii[0] / self.radii[1], path, faults);
    }

    fn check_links(&self, coupling: &CouplingSpec, pairs: &[PairSpec]) -> Result<(), Mismatch> {
        let (_, apart) = direction_and_distance(axes(coupling, pairs)?);
        let reach = (self.radii[0] - self.radii[1]).abs();
        if reach < apart {
            return Ok(());
        }
        let message = format!(
            "the pulleys touch each other: their axes are {} m apart, the radii take {} m",
            shown(apart, 6),
            shown(reach, 6)
        );
        Err(wrong(message, "give smaller diameters"))
    }

    fn to_joint(&self, coupling: &CouplingSpec, pairs: &[PairSpec]) -> Option<Joint> {
        TwoWheels::new(coupling, pairs, self.radii, press).map(Joint::Belt)
    }

    /// Both pulleys and the strands.
    fn outlines(&self, coupling: &CouplingSpec, pairs: &[PairSpec]) -> Vec<Outline> {
        let Ok(axes) = axes(coupling, pairs) else {
            return Vec::new();
        };
        let strands = strands(axes, self.radii).map(|ends| Outline::Line(coupling.carrier, ends));
        circles(coupling, pairs, self.radii)
            .chain(strands)
            .collect()
    }

    fn link_following(&self) -> (&'static str, Following) {
        let [one, other] = self.radii;
        ("belt", Following::Turns(one / other))
    }

    /// Both strands together are no single force.
    fn words(&self) -> Words {
        Words {
            drawn: "belts are left out",
            is_one_force: false,
            ..WORDS
        }
    }
}

/// The two lines that touch both pulleys: on one side, or crossing where the second radius is
/// negative.
fn strands([a, b]: [[f64; 2]; 2], [r1, r2]: [f64; 2]) -> [[[f64; 2]; 2]; 2] {
    let ([ux, uy], apart) = direction_and_distance([a, b]);
    let cos = (r1 - r2) / apart;
    // Crossed pulleys that touch or overlap have no free strands.
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    [sin, -sin].map(|sin| {
        let (nx, ny) = (cos * ux - sin * uy, cos * uy + sin * ux);
        [
            [a[0] + r1 * nx, a[1] + r1 * ny],
            [b[0] + r2 * nx, b[1] + r2 * ny],
        ]
    })
}

/// Both strands together: a couple on each pulley, and a force across the line of centres where the
/// strands are not parallel.
fn press(axes: [[f64; 2]; 2], [r1, r2]: [f64; 2]) -> [Act; 2] {
    let ([ux, uy], apart) = direction_and_distance(axes);
    let sense = r2.signum();
    let across = sense * (r1 - r2) / apart;
    let force = [-across * uy, across * ux];
    let on = |at, force, couple| Act { at, force, couple };
    [
        on(axes[0], [-force[0], -force[1]], -sense * r1),
        on(axes[1], force, sense * r2),
    ]
}
