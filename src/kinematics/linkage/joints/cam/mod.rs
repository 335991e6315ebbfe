//! A cam of one link on which a roller (or a point) of another one runs.
//!
//! The closing error is |p| − R(angle of p), with p the roller's centre seen from the cam's own centre
//! and in the cam's frame. Its row is the normal n of the curve that goes through p, as a line through
//! the roller's centre: on the roller, and against that on the cam. The line moves along the pitch
//! curve with the roller; so the curvature counts in the accelerations, and R‴ in the second
//! derivative of the row.
//!
//! The force is that of the flank on the roller, along the common normal: positive where both press
//! on each other, negative where only a closing force that is not there would hold them together. In a
//! groove the other flank carries it then.

mod check;
mod pitch;

pub(in crate::kinematics::linkage) use pitch::PitchCurve;

use super::carrier::Mismatch;
use super::constraint::{Constraint, Frames, Measure, Shape, Turns, Wrench};
use super::outline::Outline;
use super::reader::{Domain, JointReader};
#[cfg(test)]
use super::tests::Sample;
use super::{CouplingKind, CouplingSpec, Declaration, Following, Joint, Kind, Words};
use crate::fault::Faults;
use crate::kinematics::cam::spec::Surface;
use crate::kinematics::linkage::spec::pair::{PairSpec, PointOf};
use crate::kinematics::linkage::vector::Vector;
use crate::kinematics::position::spec::PositionSpec;
use crate::math::number::Number;
use crate::math::series::Series;
use std::f64::consts::TAU;

/// Points of a flank that are drawn.
const POINTS: u32 = 180;

/// A cam of one link and a roller (or a point) of another one.
///
/// In the frame of the cam the roller's centre lies on the pitch curve, polar about `centre`:
/// R(ψ) = prime radius + lift(φ), φ = sense·(ψ − direction), ψ counterclockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct CamPairSpec {
    /// Centre of the polar form in the frame of the cam's link (m).
    pub centre: [f64; 2],
    /// The roller's centre, or the point, in the frame of its link (m).
    pub roller: [f64; 2],
    /// Radius of the roller ≥ 0 (m); 0: a point.
    pub roller_radius: f64,
    /// Radius of the profile (of a groove: of its inner flank) where the lift is zero (m), > 0.
    pub base_radius: f64,
    /// The lift over the angle φ (m over rad), which repeats after a turn; `None`: a circle.
    pub lift: Option<PositionSpec>,
    /// Direction from which φ is counted, in the frame of the cam's link (rad).
    pub direction: f64,
    /// +1: φ is counted counterclockwise; −1: clockwise.
    pub sense: f64,
    /// The side of the cam that is touched.
    pub surface: Surface,
}

impl CamPairSpec {
    /// Radius of the pitch curve where the lift is zero (m).
    pub fn prime_radius(&self) -> f64 {
        self.surface
            .prime_radius(self.base_radius, self.roller_radius)
    }
}

/// How cams are written.
pub(super) const DECLARATION: Declaration = Declaration {
    key: "cam",
    doc: "A cam of one link on which a roller or a point of another one runs.",
    read,
    #[cfg(test)]
    samples,
};

fn read(reader: &mut dyn JointReader) -> Option<CouplingSpec> {
    let doc = "The cam's centre, about which its profile is given: a point of the link (or the ground) that carries the cam.";
    let centre = reader.point("centre", doc);
    let doc = "The centre of the roller, or the point that runs on the cam: a point of another link, or of the ground.";
    let roller = reader.point("roller", doc);
    let doc = "Radius of the roller; default 0, a point";
    let roller_radius = reader.length("roller_radius", doc, Domain::NotNegative, Some(0.0));
    let doc = "Radius of the profile about the centre where the lift is zero; without a `lift` that of the whole circle";
    let base_radius = reader.length("base_radius", doc, Domain::Positive, None);
    let doc = "Lift of the roller's centre from its circle, radially, over the angle in the cam: a law that repeats after a turn; default none, a circle.";
    let lift = reader.lift("lift", doc);
    let doc =
        "Direction from which the angle of the lift is counted, in the frame of the cam's link";
    let direction = reader.angle("direction", doc);
    let doc = "Sense in which the angle of the lift is counted. A cam that turns counterclockwise brings what lies clockwise of the roller.";
    let sense = reader.sense("sense", doc);
    let surface = reader.surface("surface", "Which side of the cam is touched.");
    let (centre, roller) = (centre?, roller?);
    let cam = CamPairSpec {
        centre: centre.at,
        roller: roller.at,
        roller_radius: roller_radius?,
        base_radius: base_radius?,
        lift: lift?,
        direction: direction?,
        sense: sense?,
        surface: surface?,
    };
    Some(CouplingSpec {
        name: String::new(),
        wheels: [centre.link, roller.link],
        carrier: centre.link,
        kind: CouplingKind::Cam(Box::new(cam)),
        offset: 0.0,
    })
}

#[cfg(test)]
fn samples() -> Vec<Sample> {
    let lift = PositionSpec::Sine {
        amplitude: 0.03,
        harmonic: 2.0,
        phase: 0.4,
        offset: 0.0,
    };
    let kind = |surface| {
        CouplingKind::Cam(Box::new(CamPairSpec {
            centre: [0.02, -0.01],
            roller: [0.03, 0.04],
            roller_radius: 0.02,
            base_radius: 0.2,
            lift: Some(lift.clone()),
            direction: 0.1,
            sense: -1.0,
            surface,
        }))
    };
    vec![
        Sample::of_two("cam", kind(Surface::Disc)),
        Sample::of_two("hollow cam", kind(Surface::Hollow)),
    ]
}

impl Kind for Box<CamPairSpec> {
    fn check(&self, path: &str, faults: &mut Faults) {
        check::check(self, &format!("{path}.cam"), faults);
    }

    fn check_links(&self, coupling: &CouplingSpec, _pairs: &[PairSpec]) -> Result<(), Mismatch> {
        let [own, other] = coupling.wheels;
        match own == other {
            true => Err(Mismatch::Same(own, "name points of two different links")),
            false => Ok(()),
        }
    }

    fn to_joint(&self, _coupling: &CouplingSpec, _pairs: &[PairSpec]) -> Option<Joint> {
        Some(Joint::Cam(RollerOnCam {
            points: [self.centre, self.roller],
            hollow: self.surface == Surface::Hollow,
            curve: Box::new(PitchCurve::new(self).ok()?),
        }))
    }

    /// The flanks of the cam, or its pitch curve where a point runs on it, and the roller.
    fn outlines(&self, coupling: &CouplingSpec, _pairs: &[PairSpec]) -> Vec<Outline> {
        let Ok(curve) = PitchCurve::new(self) else {
            return Vec::new();
        };
        let [own, other] = coupling.wheels;
        let [x, y] = self.centre;
        let flank = |offset: f64| {
            let angles = (0..POINTS).map(|place| TAU * f64::from(place) / f64::from(POINTS));
            let points = angles.map(|angle| curve.equidistant_point(angle, offset));
            Outline::Flank(own, points.map(|[u, v]| [x + u, y + v]).collect())
        };
        let flanks = match self.roller_radius > 0.0 {
            true => self.surface.flanks(self.roller_radius),
            false => vec![0.0],
        };
        let roller = Outline::Roller(other, self.roller, self.roller_radius);
        flanks.into_iter().map(flank).chain([roller]).collect()
    }

    fn link_following(&self) -> (&'static str, Following) {
        let rule = "the centre of the roller lies on the pitch curve of the cam";
        ("cam", Following::InWords(rule))
    }

    fn words(&self) -> Words {
        Words {
            force: "Force of the cam",
            drawn: "cams act on the roller, at its centre",
            is_one_force: true,
            held_link: "link on a cam",
        }
    }

    fn points(&self, [own, other]: [Option<usize>; 2]) -> Vec<PointOf> {
        let point = |link, at| PointOf { link, at };
        vec![point(own, self.centre), point(other, self.roller)]
    }

    fn typical_length(&self) -> f64 {
        self.prime_radius()
    }

    fn is_one_sided(&self) -> bool {
        self.surface != Surface::Groove
    }

    fn remark(&self, name: &str) -> Option<String> {
        check::undercut(self, name)
    }
}

/// A cam made ready.
#[derive(Clone, Debug)]
pub(in crate::kinematics::linkage) struct RollerOnCam {
    /// The points about which the pitch curve is polar and of the roller's centre (m).
    points: [[f64; 2]; 2],
    hollow: bool,
    curve: Box<PitchCurve>,
}

impl Constraint for RollerOnCam {
    const SHAPE: Shape = Shape {
        rows: &[Measure::Length],
        links: 2,
        turning: &[],
    };

    #[inline(always)]
    fn errors<const K: usize>(&self, links: &impl Turns<K>, mut set: impl FnMut(usize, Series<K>)) {
        let (cam, roller) = (links.frame(0), links.frame(1));
        let gap = roller.place(self.points[1]) - cam.place(self.points[0]);
        set(
            0,
            self.curve
                .error(cam.direction.mirrored().complex_product(gap)),
        );
    }

    #[inline(always)]
    fn rows<const K: usize, T: Number>(
        &self,
        links: &impl Frames<K, T>,
        mut add: impl FnMut(usize, usize, Wrench<K, T>),
    ) {
        let (cam, roller) = (links.frame(0), links.frame(1));
        let at = roller.place(self.points[1]);
        let seen: Vector<K, T> = cam
            .direction
            .mirrored()
            .complex_product(at - cam.place(self.points[0]));
        let force = cam.direction.complex_product(self.curve.gradient(seen));
        add(0, 0, Wrench::Force { at, force: -force });
        add(0, 1, Wrench::Force { at, force });
    }

    /// Away from a disc, into a hollow cam.
    fn sign_of_force(&self) -> f64 {
        if self.hollow { -1.0 } else { 1.0 }
    }
}
