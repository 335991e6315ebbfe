//! Forces of couplings on the links that they couple.
//!
//! One unknown a coupling: its force, such as the circumferential force of gears, which acts on the
//! second wheel so that its coordinate, seen from the carrier, would grow; or the force of a cam's
//! flank. What a unit of it does is said by the joint ([`Joint::acts`](Joint)).

use super::Kinetostatics;
use super::place::frame;
use super::positions::{LinkPosition, PointPosition};
use super::workspace::ForceWorkspace;
use crate::kinematics::linkage::elements::Frame;
use crate::kinematics::linkage::joints::{Act, Frames, Joint};
use crate::kinematics::linkage::spec::LinkageSpec;
use crate::kinematics::linkage::vector::Vector;

/// Force of a coupling on its second wheel, rack or roller.
#[derive(Clone, Copy, Debug)]
pub struct CouplingForce {
    /// The circumferential force (N): positive drives what it acts on forwards along its coordinate,
    /// as seen from the carrier. Of a cam the force on the roller: positive presses.
    pub size: f64,
    /// The same as a vector (N), without what it does as a couple.
    pub force: [f64; 2],
    /// Where it acts (m): the pitch point, the axis of the second pulley, the roller's centre.
    pub point: [f64; 2],
}

/// The links of a coupling where they are.
struct PlacedCoupling<'a> {
    of: [Option<usize>; 3],
    links: &'a [LinkPosition],
}

impl Frames<1, f64> for PlacedCoupling<'_> {
    #[inline]
    fn frame(&self, link: usize) -> Frame<1> {
        let own = frame(self.links, self.of[link]);
        Frame {
            at: Vector::constant(own.origin),
            direction: Vector::constant([own.cos, own.sin]),
        }
    }
}

impl Kinetostatics {
    /// The force of a coupling at the position solved last.
    pub fn coupling_force(&self, coupling: usize, w: &ForceWorkspace) -> CouplingForce {
        let size = self.coupling_size(coupling, w);
        let [_, (_, second)] = self.unit_force_acts(coupling, &w.links);
        CouplingForce {
            size,
            force: second.force.map(|part| size * part),
            point: second.at,
        }
    }

    fn coupling_size(&self, coupling: usize, w: &ForceWorkspace) -> f64 {
        w.unknowns[2 * self.spec.pairs.len() + coupling]
    }

    /// Rows of a unit of a coupling's force.
    pub(super) fn each_coupling_row(
        &self,
        coupling: usize,
        (links, centres): (&[LinkPosition], &[PointPosition]),
        mut add: impl FnMut(usize, f64),
    ) {
        for (link, act) in self.unit_force_acts(coupling, links) {
            self.each_row_on(link, &act, centres, &mut add);
        }
    }

    /// Adds the forces of couplings on what is fixed to the ground: force (N) and moment about
    /// the ground's origin (N·m).
    pub(super) fn add_couplings_on_frame(&self, w: &ForceWorkspace, sum: &mut [f64; 3]) {
        for coupling in 0..self.spec.couplings.len() {
            let size = self.coupling_size(coupling, w);
            let acts = self.unit_force_acts(coupling, &w.links);
            for (_, act) in acts.iter().filter(|(link, _)| link.is_none()) {
                add_on_frame(act, size, sum);
            }
        }
    }

    /// What a unit of a coupling's force does to its two links.
    fn unit_force_acts(
        &self,
        coupling: usize,
        links: &[LinkPosition],
    ) -> [(Option<usize>, Act); 2] {
        let spec = &self.spec.couplings[coupling];
        let of = spec.links();
        let acts = self.coupled[coupling].acts(&PlacedCoupling { of, links });
        [0, 1].map(|side| (spec.wheels[side], acts[side]))
    }
}

/// Adds so many times of what acts on the ground: force, and moment about its origin.
pub(super) fn add_on_frame(act: &Act, times: f64, sum: &mut [f64; 3]) {
    for (sum, part) in sum.iter_mut().zip(act.moment_and_force_about([0.0; 2])) {
        *sum += times * part;
    }
}

/// The couplings made ready, having been checked.
pub(super) fn coupled(spec: &LinkageSpec) -> Vec<Joint> {
    let all = spec.couplings.iter();
    all.filter_map(|coupling| coupling.to_joint(&spec.pairs))
        .collect()
}
