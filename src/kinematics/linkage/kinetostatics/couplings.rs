//! Forces of gears, belts, racks and cams on the links that they couple.
//!
//! One unknown a coupling: the circumferential force, which acts on the second wheel (or rack) so
//! that its coordinate, seen from the carrier, would grow. Teeth press at the pitch point along the
//! common tangent of the pitch circles; of a belt the difference of both strands acts, each in its
//! own direction. What presses on both wheels alike is not counted, since the linkage does not tell
//! it: the separating force of the pressure angle, the pretension of a belt.
//!
//! Of a cam it is the force of the flank on the roller, along the common normal, which goes through
//! the roller's centre: positive where both press on each other, negative where only a closing force
//! that is not there would hold them together. In a groove the other flank carries it then.

use super::Kinetostatics;
use super::place::frame;
use super::positions::{LinkPosition, PointPosition};
use super::workspace::{ForceWorkspace, PairPlace};
use crate::kinematics::cam::spec::Surface;
use crate::kinematics::linkage::couplings::{Meeting, PitchCurve};
use crate::kinematics::linkage::spec::{CamPairSpec, CouplingKind, CouplingSpec, LinkageSpec};

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

/// What a coupling presses by.
#[derive(Clone, Debug)]
pub(super) enum CouplingReaction {
    /// Wheels, whose axes lie so.
    Wheels(Meeting),
    /// A cam with its pitch curve.
    Cam(Box<CamPairSpec>, PitchCurve),
}

/// What a unit of a coupling's force does to one of the wheels.
#[derive(Clone, Copy, Debug)]
struct OnWheel {
    /// The link; `None`: the ground.
    link: Option<usize>,
    at: [f64; 2],
    force: [f64; 2],
    couple: f64,
}

impl Kinetostatics {
    /// The force of a coupling at the position solved last.
    pub fn coupling_force(&self, coupling: usize, w: &ForceWorkspace) -> CouplingForce {
        let size = self.coupling_size(coupling, w);
        let [_, second] = self.on_wheels(coupling, &w.links, &w.pairs);
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
        (pairs, links, centres): (&[PairPlace], &[LinkPosition], &[PointPosition]),
        mut add: impl FnMut(usize, f64),
    ) {
        for wheel in self.on_wheels(coupling, links, pairs) {
            let Some(link) = wheel.link else { continue };
            let ([fx, fy], [cx, cy]) = (wheel.force, centres[link].place);
            let arm = [wheel.at[0] - cx, wheel.at[1] - cy];
            let moment = arm[0] * fy - arm[1] * fx + wheel.couple;
            add(3 * link, fx);
            add(3 * link + 1, fy);
            add(3 * link + 2, moment / self.length);
        }
    }

    /// Adds the forces of couplings on what is fixed to the ground: force (N) and moment about
    /// the ground's origin (N·m).
    pub(super) fn add_couplings_on_frame(&self, w: &ForceWorkspace, sum: &mut [f64; 3]) {
        for coupling in 0..self.spec.couplings.len() {
            let size = self.coupling_size(coupling, w);
            let wheels = self.on_wheels(coupling, &w.links, &w.pairs);
            for wheel in wheels.iter().filter(|wheel| wheel.link.is_none()) {
                let ([x, y], [fx, fy]) = (wheel.at, wheel.force);
                sum[0] += size * fx;
                sum[1] += size * fy;
                sum[2] += size * (x * fy - y * fx + wheel.couple);
            }
        }
    }

    fn on_wheels(
        &self,
        coupling: usize,
        links: &[LinkPosition],
        pairs: &[PairPlace],
    ) -> [OnWheel; 2] {
        let spec = &self.spec.couplings[coupling];
        let meeting = match &self.coupled[coupling] {
            CouplingReaction::Wheels(meeting) => meeting,
            CouplingReaction::Cam(cam, curve) => return on_cam(spec.wheels, cam, curve, links),
        };
        let axes = meeting
            .axes
            .map(|at| frame(links, spec.carrier).point(at).place);
        match (&spec.kind, meeting.guide) {
            (CouplingKind::Gear { ratio }, _) => gears(spec.wheels, *ratio, axes),
            (CouplingKind::Belt { radii }, _) => belt(spec.wheels, *radii, axes),
            (CouplingKind::Cam(_), _) => opposite(spec.wheels, axes[0], [0.0; 2]),
            (CouplingKind::Rack { radius }, guide) => {
                let along = guide.map_or([1.0, 0.0], |(pair, _)| pairs[pair].tangent);
                rack(spec.wheels, *radius, axes[0], along)
            }
        }
    }
}

/// Direction from one point to another, and their distance.
fn towards([one, other]: [[f64; 2]; 2]) -> ([f64; 2], f64) {
    let [x, y] = [other[0] - one[0], other[1] - one[1]];
    let apart = x.hypot(y);
    ([x / apart, y / apart], apart)
}

/// At the pitch point both gears have one velocity, seen from the carrier: it divides the
/// distance of their axes.
fn gears(wheels: [Option<usize>; 2], ratio: f64, axes: [[f64; 2]; 2]) -> [OnWheel; 2] {
    let ([ux, uy], apart) = towards(axes);
    let reach = apart * ratio / (ratio - 1.0);
    let at = [axes[0][0] + reach * ux, axes[0][1] + reach * uy];
    // To the left of the line of centres, or to the right: so that the second gear turns forwards.
    let sense = (ratio - 1.0).signum();
    opposite(wheels, at, [-sense * uy, sense * ux])
}

/// The pitch point lies beside the axis, at right angles to the guide.
fn rack(wheels: [Option<usize>; 2], radius: f64, axis: [f64; 2], along: [f64; 2]) -> [OnWheel; 2] {
    let [tx, ty] = along;
    let at = [axis[0] + radius * ty, axis[1] - radius * tx];
    opposite(wheels, at, along)
}

/// A force on the second wheel, its reaction on the first.
fn opposite([one, other]: [Option<usize>; 2], at: [f64; 2], [fx, fy]: [f64; 2]) -> [OnWheel; 2] {
    let on = |link, force| OnWheel {
        link,
        at,
        force,
        couple: 0.0,
    };
    [on(one, [-fx, -fy]), on(other, [fx, fy])]
}

/// Both strands together: a couple on each pulley, and a force across the line of centres where
/// the strands are not parallel.
fn belt([one, other]: [Option<usize>; 2], [r1, r2]: [f64; 2], axes: [[f64; 2]; 2]) -> [OnWheel; 2] {
    let ([ux, uy], apart) = towards(axes);
    let sense = r2.signum();
    let across = sense * (r1 - r2) / apart;
    let force = [-across * uy, across * ux];
    let on = |link, at, force, couple| OnWheel {
        link,
        at,
        force,
        couple,
    };
    [
        on(one, axes[0], [-force[0], -force[1]], -sense * r1),
        on(other, axes[1], force, sense * r2),
    ]
}

/// At the roller's centre along the common normal: away from a disc, into a hollow cam.
fn on_cam(
    wheels: [Option<usize>; 2],
    cam: &CamPairSpec,
    curve: &PitchCurve,
    links: &[LinkPosition],
) -> [OnWheel; 2] {
    let own = frame(links, wheels[0]);
    let (centre, roller) = (
        own.point(cam.centre),
        frame(links, wheels[1]).point(cam.roller),
    );
    let [x, y] = [0, 1].map(|axis| roller.place[axis] - centre.place[axis]);
    let seen = [own.cos * x + own.sin * y, own.cos * y - own.sin * x];
    let [x, y] = own.turned(curve.gradient(seen));
    let size = match cam.surface {
        Surface::Disc | Surface::Groove => x.hypot(y),
        Surface::Hollow => -x.hypot(y),
    };
    opposite(wheels, roller.place, [x / size, y / size])
}

/// What every coupling presses by, the couplings having been checked.
pub(super) fn coupled(spec: &LinkageSpec) -> Vec<CouplingReaction> {
    let coupled = |coupling: &CouplingSpec| match &coupling.kind {
        CouplingKind::Cam(cam) => {
            let curve = PitchCurve::new(cam).ok()?;
            Some(CouplingReaction::Cam(cam.clone(), curve))
        }
        _ => coupling
            .axis_positions(&spec.pairs)
            .ok()
            .map(CouplingReaction::Wheels),
    };
    spec.couplings.iter().filter_map(coupled).collect()
}
