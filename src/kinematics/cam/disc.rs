//! A disc cam made ready: law and geometry together.

use super::check;
use super::contact::{self, Touch, plus, rotated, times};
use super::motion::{FollowerMotion, Piece};
use super::search::{At, extremes};
use super::spec::{CamGeometry, Contact, Guide};
use crate::fault::{Fault, Faults};
use crate::kinematics::position::Position;
use crate::math::number::{Dual, Number, atan};
use crate::units::shown;
use serde::Serialize;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

/// A disc cam with its follower.
#[derive(Clone, Debug)]
pub struct DiscCam {
    geometry: CamGeometry,
    motion: Arc<FollowerMotion>,
    start: f64,
}

/// Cam and follower at one angle of the cam.
///
/// Points and directions are in the machine's frame: origin in the cam's axis,
/// x to the right, y upwards.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CamState {
    /// The cam's angle φ (rad).
    pub phi: f64,
    /// Outward displacement from the innermost place (m or rad).
    pub lift: f64,
    /// s′.
    pub first: f64,
    /// s″.
    pub second: f64,
    /// Pressure angle: between the normal of the cam and the direction in
    /// which the follower moves outwards; positive where it hinders outward
    /// motion (rad).
    pub pressure_angle: f64,
    /// Radius of curvature of the pitch curve of a roller; positive where
    /// convex, infinite where straight (m). Of a flat face: of the profile.
    pub pitch_radius: f64,
    /// Radius of curvature of the (inner) profile (m).
    pub profile_radius: f64,
    /// Displacement along the normal by outward displacement: cos of the
    /// pressure angle, times the arm of a turning follower (1 or m/rad).
    pub lever: f64,
    /// Place where a flat face touches, from the line or axis of the follower (m).
    pub face: f64,
    /// Centre of the roller, or point of contact of a flat face (m).
    pub point: [f64; 2],
    /// Normal of the cam at the contact, away from the axis.
    pub normal: [f64; 2],
}

/// The follower where it is innermost, in the machine's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Centre of the roller, the edge; of a flat face the place from which
    /// [`CamState::face`] counts.
    pub point: [f64; 2],
    /// Direction along a flat face in which [`CamState::face`] counts.
    pub along: [f64; 2],
    /// Direction of outward motion of a translating follower.
    pub outward: [f64; 2],
    /// Axis of a turning follower; not a number of another.
    pub axis: [f64; 2],
}

impl DiscCam {
    /// A cam from the law U(φ) of its follower and the geometry.
    ///
    /// # Errors
    /// Numbers out of range, geometry that cannot be assembled (always with
    /// the interval that can), a law that does not close; paths relative to
    /// the object (`cam.base_radius`, `position`).
    pub fn new(position: &Position, geometry: &CamGeometry) -> Result<Self, Vec<Fault>> {
        let mut faults = Faults::default();
        check::check_numbers(geometry, &mut faults);
        faults.check()?;
        let motion = FollowerMotion::new(position, geometry.outward, geometry.range)?;
        Self::of(Arc::new(motion), geometry)
    }

    fn of(motion: Arc<FollowerMotion>, geometry: &CamGeometry) -> Result<Self, Vec<Fault>> {
        let mut faults = Faults::default();
        let start = contact::start(geometry);
        let start = start.unwrap_or_else(|| {
            check::refuse_start(geometry, &mut faults);
            f64::NAN
        });
        faults.check()?;
        let cam = Self {
            geometry: geometry.clone(),
            motion,
            start,
        };
        cam.check_reach(&mut faults);
        faults.check()?;
        cam.check_finite(&mut faults);
        faults.check()?;
        Ok(cam)
    }

    /// The follower and law on another prime circle; `None` where it cannot be assembled.
    pub(crate) fn with_prime_radius(&self, radius: f64) -> Option<Self> {
        let geometry = self.geometry.with_prime_radius(radius);
        Self::of(Arc::clone(&self.motion), &geometry).ok()
    }

    /// Every number of the contact exists, at all points of the search.
    fn check_finite(&self, faults: &mut Faults) {
        for piece in self.motion.pieces() {
            for step in 0..=piece.intervals {
                let phi = piece.search_place(step);
                let touch: Touch<f64> = self.touch(piece, phi);
                let sum = touch.point[0] + touch.point[1] + touch.pressure + touch.bend;
                if !(sum + touch.rate + touch.lever).is_finite() || touch.rate == 0.0 {
                    let message = format!(
                        "at φ = {} deg the follower touches no place of the cam that could be \
                         computed",
                        shown(phi.to_degrees(), 6)
                    );
                    let hint = "give a geometry of the size of the stroke";
                    return faults.add("cam", message, hint);
                }
            }
        }
    }

    /// A turning follower must stay on one side of the line of centres, and the
    /// normal of a flat face must go on turning in the cam.
    fn check_reach(&self, faults: &mut Faults) {
        let Guide::Turning { .. } = self.geometry.guide else {
            return;
        };
        let flat = self.geometry.roller().is_none();
        let (most, end) = (
            self.start + self.motion.stroke(),
            if flat { FRAC_PI_2 } else { PI },
        );
        if most >= end {
            let message = format!(
                "the follower would swing to {} deg from the line of centres, beyond {} deg",
                shown(most.to_degrees(), 6),
                end.to_degrees()
            );
            let hint = format!(
                "it starts at {} deg: the stroke may be up to {} deg; give a smaller base circle or \
                 a greater centre distance",
                shown(self.start.to_degrees(), 6),
                shown((end - self.start).to_degrees(), 6)
            );
            faults.add("cam", message, &hint);
            return;
        }
        let turning = |piece: &Piece, phi: Dual| {
            let s = self.motion.lift(piece, phi);
            contact::turning_of_normal(&self.geometry, s).unwrap_or(Dual::from(1.0))
        };
        let [least, _] = extremes(&self.motion, &turning);
        if least.value <= 1e-9 {
            let message = format!(
                "at φ = {} deg the follower turns as fast as the cam: no flat face can be driven so",
                shown(least.phi.to_degrees(), 6)
            );
            let hint = "keep |U′| below 1 where the follower turns with the cam, or let it swing against the cam";
            faults.add("cam", message, hint);
        }
    }

    /// The geometry.
    pub fn geometry(&self) -> &CamGeometry {
        &self.geometry
    }

    /// The follower's motion.
    pub fn motion(&self) -> &FollowerMotion {
        &self.motion
    }

    /// Place of the follower when it is innermost: distance from the axis along
    /// its line (m), of a turning one the angle between its arm (face) and the
    /// line of centres (rad).
    pub fn start(&self) -> f64 {
        self.start
    }

    pub(crate) fn touch<N: Number>(&self, piece: &Piece, phi: N) -> Touch<N> {
        contact::touch(&self.geometry, self.start, self.motion.lift(piece, phi))
    }

    /// Cam and follower at φ in a piece of [`Self::motion`].
    pub fn at(&self, piece: &Piece, phi: f64) -> CamState {
        let touch = self.touch(piece, phi);
        let jet = self.motion.jet(piece, phi);
        let pitch_radius = match self.geometry.roller() {
            Some(_) => 1.0 / touch.bend,
            None => touch.bend,
        };
        let flank = self.geometry.flanks()[0];
        CamState {
            phi,
            lift: jet.value,
            first: jet.first,
            second: jet.second,
            pressure_angle: atan(touch.pressure),
            pitch_radius,
            profile_radius: pitch_radius + flank,
            lever: touch.lever,
            face: touch.face,
            point: self.in_machine(touch.point),
            normal: self.in_machine(touch.normal),
        }
    }

    /// The follower where it is innermost, in the machine's frame.
    pub fn innermost(&self) -> Pose {
        let touch = contact::touch(&self.geometry, self.start, [0.0; 3]);
        let turned = |n: [f64; 2]| [n[1], -n[0]];
        match (self.geometry.guide, self.geometry.contact) {
            (Guide::Translating { .. }, contact) => {
                let along = turned(touch.normal);
                // From where a flat face touches to where its line is crossed.
                let back = match contact {
                    Contact::Flat { .. } => touch.face,
                    _ => 0.0,
                };
                let point = plus(touch.point, times(along, -back));
                Pose {
                    point: self.in_machine(point),
                    along: self.in_machine(along),
                    outward: self.in_machine([0.0, 1.0]),
                    axis: [f64::NAN; 2],
                }
            }
            (
                Guide::Turning {
                    centre_distance,
                    against,
                    ..
                },
                contact,
            ) => {
                let axis = [centre_distance, 0.0];
                let along = times(turned(touch.normal), -against);
                let point = match contact {
                    Contact::Flat { .. } => plus(touch.point, times(along, -touch.face)),
                    _ => touch.point,
                };
                Pose {
                    point: self.in_machine(point),
                    along: self.in_machine(along),
                    outward: self.in_machine(touch.normal),
                    axis: self.in_machine(axis),
                }
            }
        }
    }

    /// A vector of the standing frame of a cam that turns counter-clockwise in
    /// the machine's frame.
    pub(crate) fn in_machine(&self, vector: [f64; 2]) -> [f64; 2] {
        let (mirrored, along) = match self.geometry.guide {
            Guide::Translating { .. } => ([self.geometry.sense * vector[0], vector[1]], FRAC_PI_2),
            Guide::Turning { .. } => ([vector[0], self.geometry.sense * vector[1]], 0.0),
        };
        rotated(mirrored, self.geometry.direction - along)
    }

    /// A vector of the machine's frame in that of the cam, which lies as drawn
    /// at φ = 0.
    pub fn in_cam(&self, vector: [f64; 2], phi: f64) -> [f64; 2] {
        rotated(vector, -self.geometry.sense * phi)
    }

    /// The point at `offset` along the normal from the reference curve (pitch
    /// curve of a roller, profile of a flat face), in the cam's frame.
    pub fn curve_point(&self, piece: &Piece, phi: f64, offset: f64) -> [f64; 2] {
        let touch = self.touch(piece, phi);
        let point = plus(touch.point, times(touch.normal, offset));
        self.in_cam(self.in_machine(point), phi)
    }

    /// How the curve at `offset` runs: its length's rate by φ, negative where it
    /// runs backwards (an undercut), and |curvature|·rate².
    pub(crate) fn curve_rates<N: Number>(&self, touch: &Touch<N>, offset: f64) -> (N, N) {
        match self.geometry.roller() {
            Some(_) => {
                let share = N::from(1.0) + touch.bend.scale(offset);
                (
                    touch.rate * share,
                    touch.rate * touch.rate * touch.bend * share,
                )
            }
            None => {
                let radius = touch.bend + N::from(offset);
                (radius * touch.rate, radius * touch.rate * touch.rate)
            }
        }
    }

    /// Least and greatest pressure angle.
    pub fn pressure_angles(&self) -> [At; 2] {
        extremes(&self.motion, &|piece, phi| {
            atan(self.touch(piece, phi).pressure)
        })
    }

    /// Least and greatest place of the contact on a flat face.
    pub fn face(&self) -> [At; 2] {
        extremes(&self.motion, &|piece, phi| self.touch(piece, phi).face)
    }

    /// Least radius of curvature of the curve at `offset` where it is convex, and
    /// where it is concave (as a positive number); `None` where it nowhere is.
    /// On an undercut the radius is that of the curve which runs backwards.
    pub fn radii(&self, offset: f64) -> [Option<At>; 2] {
        // The curvature of an offset curve grows without bound at a cusp, the
        // radius of a flat face's profile at nothing: look at what stays finite.
        let radius = |sign: f64| {
            let [least, most] = self.curvature_extremes();
            match (self.geometry.roller(), sign > 0.0) {
                (Some(_), true) => (most.value > 0.0).then(|| At {
                    value: 1.0 / most.value + offset,
                    ..most
                }),
                (Some(_), false) => (least.value < 0.0).then(|| At {
                    value: -1.0 / least.value - offset,
                    ..least
                }),
                (None, true) => Some(At {
                    value: least.value + offset,
                    ..least
                }),
                (None, false) => None,
            }
        };
        [radius(1.0), radius(-1.0)]
    }

    /// Least and greatest of the quantity that says how the reference curve
    /// bends: its curvature (roller), its radius of curvature (flat face).
    pub(crate) fn curvature_extremes(&self) -> [At; 2] {
        extremes(&self.motion, &|piece, phi| self.touch(piece, phi).bend)
    }
}
