//! Slotted link: crank, block and slotted link on fixed pivots, driven by the
//! crank or by the block.

use super::assembly_range::{ForbiddenArcs, OutOfReach};
use super::spec::{SlottedDriver, SlottedLinkSpec, SlottedOutput};
use crate::fault::{Fault, Faults};
use crate::kinematics::linkage::closure::{TwoCircles, guide_between_pins};
use crate::kinematics::linkage::vector::Vector;
use crate::math::jet::Jet;
use crate::math::series::Series;
use std::f64::consts::{PI, TAU};

/// Below this part of the crank the block counts as lying on the pivot of the
/// slotted link, whose direction is then undetermined.
const ON_THE_PIVOT: f64 = 1e-9;

/// Crank 1 of length l about O1, slotted link 2 about O2, block 3 pinned to the
/// crank's end and sliding along the slot, whose axis passes through O2.
///
/// With D the distance of the pivots, φ1 and φ2 both measured from the direction
/// O2 → O1, and S ≥ 0 the distance of the block from O2:
///
/// S·cos φ2 = D + l·cos φ1, S·sin φ2 = l·sin φ1
///
/// The crank turns fully. With D > l the slotted link swings by ±arcsin(l/D),
/// with D < l it turns with the crank, with D = l it turns half as fast up to
/// φ1 = 180°, where the block lies on O2: there it ends.
///
/// When the block drives, S lies between |D − l| and D + l; both ends are dead
/// positions (crank and slot in line): U′ grows without bound there and U has
/// no value beyond.
///
/// It is the massless short form of a linkage ([`super::Position::as_linkage`])
/// and closes as its dyads do: driven by the crank a guide between two pins, the
/// slot passing through O2; driven by the block two circles, the slot being a
/// link of length S.
///
/// Source: D. Smirnov, *Kinematic analysis of a one-degree-of-freedom
/// slide-crank mechanism with fixed turning pairs*, 2014, its misprints put right.
#[derive(Clone, Debug, PartialEq)]
pub struct SlottedLink {
    spec: SlottedLinkSpec,
    /// The one crank angle, 180°, at which the block lies on O2.
    arcs: ForbiddenArcs,
}

impl SlottedLink {
    /// The side to which the crank turns where the block drives, +1 or −1; nothing where the crank
    /// drives: there is one assembly mode then.
    pub fn branch_of_block(&self) -> Option<f64> {
        (self.spec.driver == SlottedDriver::Block).then_some(self.spec.branch)
    }

    /// A slotted link of given dimensions.
    ///
    /// # Errors
    /// Lengths out of range, pivots that coincide while the block drives, an
    /// output that is the driver itself; paths relative to `position`.
    pub fn new(spec: &SlottedLinkSpec) -> Result<Self, Vec<Fault>> {
        let mut faults = Faults::default();
        faults.length("slotted_link.crank", spec.crank);
        faults.branch("slotted_link.branch", spec.branch);
        faults.finite("slotted_link.phase", spec.phase);
        if !(spec.frame == 0.0 && spec.driver == SlottedDriver::Crank) {
            faults.length("slotted_link.frame", spec.frame);
        }
        if spec.frame == 0.0 && spec.driver == SlottedDriver::Block {
            let message = "with both pivots in one place the block keeps its distance";
            let hint = "let the crank drive, or set the pivots apart";
            faults.add("slotted_link.driver", message, hint);
        }
        match (spec.driver, spec.output) {
            (SlottedDriver::Crank, SlottedOutput::Crank)
            | (SlottedDriver::Block, SlottedOutput::Block) => faults.add(
                "slotted_link.output",
                "the output is the driver itself",
                "take the link, or the other of crank and block",
            ),
            _ => {}
        }
        faults.check()?;
        let meets = (spec.frame - spec.crank).abs() <= ON_THE_PIVOT * spec.crank;
        Ok(Self {
            spec: *spec,
            arcs: ForbiddenArcs {
                centre: PI,
                half_widths: [meets.then_some(0.0), None],
            },
        })
    }

    /// Numbers that it was made from.
    pub fn spec(&self) -> &SlottedLinkSpec {
        &self.spec
    }

    /// Gain of U in a turn of the crank; `None` where the crank does not drive or cannot
    /// turn fully.
    pub fn gain_in_turn(&self) -> Option<f64> {
        let free = self.spec.driver == SlottedDriver::Crank && self.arcs.half_widths[0].is_none();
        let turns = self.spec.output == SlottedOutput::Link && self.spec.frame < self.spec.crank;
        free.then_some(if turns { TAU } else { 0.0 })
    }

    /// U and its derivatives at `phi`.
    pub fn jet(&self, phi: f64) -> Jet {
        let input = phi + self.spec.phase;
        match self.spec.driver {
            SlottedDriver::Crank => self.of_crank(input),
            SlottedDriver::Block => self.of_block(input),
        }
        .jet()
    }

    /// φ2 or S over φ1.
    fn of_crank(&self, angle: f64) -> Series<4> {
        let SlottedLinkSpec {
            crank: l, frame: d, ..
        } = self.spec;
        // Squares of half angles: D + l·cos φ1 and S² from terms of one sign,
        // or from the exact difference D − l.
        let (half_sin, half_cos) = Series::<4>::sin_cos(0.5 * angle, 0.5);
        let cos_square = half_cos.square();
        if self.spec.output == SlottedOutput::Block {
            let square = cos_square.scale(4.0 * d * l).shift((d - l) * (d - l));
            return guide_between_pins(square, Series::constant(0.0), 1.0).x;
        }
        // The slot passes through both pins, O2 and the crank's end: it points as
        // their line does, nothing is left to be closed.
        let sin = (half_sin * half_cos).scale(2.0);
        if d >= l {
            let along = cos_square.scale(2.0 * l).shift(d - l);
            Vector::new(along, sin.scale(l)).angle()
        } else {
            // The link turns with the crank, less than 90° behind or ahead.
            let along = cos_square.scale(2.0 * d).shift(l - d);
            let behind = Vector::new(along, -sin.scale(d)).angle();
            behind.shift(angle).tilt(1.0)
        }
    }

    /// φ1 or φ2 over S.
    fn of_block(&self, distance: f64) -> Series<4> {
        let SlottedLinkSpec {
            crank: l, frame: d, ..
        } = self.spec;
        let s = Series::<4>::variable(distance);
        let [nearest, farthest] = self.travel();
        // S² − (D − l)² and (D + l)² − S² as products of differences.
        let beyond = s.shift(-nearest) * s.shift(nearest);
        let within = (-s).shift(farthest) * s.shift(farthest);
        let factors = [within, beyond];
        if self.spec.output == SlottedOutput::Link {
            // Slot first, seen from O2 towards O1.
            let closure = TwoCircles {
                factors,
                along: s.square().shift((d - l) * (d + l)),
            };
            closure.vector_to_inner_pin(-self.spec.branch).angle()
        } else {
            // Crank first, seen from O1 towards O2, against which φ1 counts.
            let closure = TwoCircles {
                factors,
                along: (-s.square()).shift(d * d + l * l),
            };
            (-closure.vector_to_inner_pin(self.spec.branch)).angle()
        }
    }

    /// Least and greatest S of a driving block: its dead-centre positions (m).
    fn travel(&self) -> [f64; 2] {
        let SlottedLinkSpec {
            crank: l, frame: d, ..
        } = self.spec;
        [(d - l).abs(), d + l]
    }

    /// The interval around `phi` in which it can be assembled; `None`: a full turn.
    ///
    /// # Errors
    /// It cannot be assembled at `phi`.
    pub fn reach_from(&self, phi: f64) -> Result<Option<(f64, f64)>, OutOfReach> {
        let phase = self.spec.phase;
        if self.spec.driver == SlottedDriver::Crank {
            return super::shifted(self.arcs.reach_from(phi + phase), phase);
        }
        let [nearest, farthest] = self.travel();
        let interval = (nearest - phase, farthest - phase);
        if interval.0 < phi && phi < interval.1 {
            Ok(Some(interval))
        } else {
            Err(OutOfReach {
                intervals: vec![interval],
            })
        }
    }
}

#[cfg(test)]
#[path = "slotted_link_tests.rs"]
mod tests;
