//! All that is found of a cam, ready to be told.

use super::force::{CamForce, ForceFigures, Reserve};
use crate::fault::Fault;
use crate::kinematics::cam::search::greatest;
use crate::kinematics::cam::sizing::{BaseRange, BestOffset, PressureLimits, RollerLimits};
use crate::kinematics::cam::{At, Contact, DiscCam, Finding, Guide};
use crate::studies::judgement::Judgement;
use crate::studies::rigid::Rigid;
use serde::Serialize;

/// Question about a cam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Question {
    /// Greatest pressure angles.
    pub pressure: PressureLimits,
    /// Greatest share of the least radius of curvature of the pitch curve that
    /// a roller may have.
    pub roller_factor: f64,
    /// Least radius of curvature of a profile under a flat face (m).
    pub least_radius: f64,
    /// Reserve to be left in contact.
    pub reserve: Reserve,
}

/// An answer, or why there is none.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Answer<T> {
    /// The answer.
    pub found: Option<T>,
    /// Why there is none.
    pub why_not: Option<String>,
}

impl<T> From<Result<T, Fault>> for Answer<T> {
    fn from(result: Result<T, Fault>) -> Self {
        match result {
            Ok(found) => Self {
                found: Some(found),
                why_not: None,
            },
            Err(fault) => Self {
                found: None,
                why_not: Some(match fault.hint.as_str() {
                    "" => fault.message,
                    hint => format!("{}; {hint}", fault.message),
                }),
            },
        }
    }
}

/// Least radii of curvature; null where the curve is nowhere so.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Radii {
    /// Least radius of curvature where it is convex (m).
    pub convex: Option<At>,
    /// Least radius of curvature where it is concave, as a positive number (m).
    pub concave: Option<At>,
}

/// The flat face.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FaceFigures {
    /// Least place of the contact, from the follower's line or axis (m).
    pub least: At,
    /// Greatest place.
    pub greatest: At,
    /// Width needed (m).
    pub needed_width: f64,
    /// Width it has; null: not given.
    pub width: Option<f64>,
}

/// All that is found of a cam.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CamFigures {
    /// Unit of the follower's displacement against the cam: m or rad.
    pub unit: &'static str,
    /// Stroke (m or rad).
    pub stroke: f64,
    /// Radius of the base circle (m).
    pub base_radius: f64,
    /// Radius of the prime circle: of the roller's centre when innermost (m).
    pub prime_radius: f64,
    /// Place of the follower when innermost: distance along its line (m), angle
    /// between arm or face and the line of centres (rad).
    pub start: f64,
    /// Greatest and least U′ (outwards positive) by the cam's angle.
    pub speed: [At; 2],
    /// Greatest and least U″.
    pub acceleration: [At; 2],
    /// Least and greatest pressure angle (rad).
    pub pressure: [At; 2],
    /// Greatest pressure angles asked for.
    pub limits: PressureLimits,
    /// Where they are exceeded most; null: nowhere.
    pub excess: Option<At>,
    /// Of the pitch curve; null under a flat face.
    pub pitch: Option<Radii>,
    /// Of each profile: one, two of a groove.
    pub profiles: Vec<Radii>,
    /// Limits of roller and cutter; null under a flat face.
    pub roller: Option<RollerLimits>,
    /// The flat face; null without one.
    pub face: Option<FaceFigures>,
    /// Undercuts, crossings, corners, shocks.
    pub findings: Vec<Finding>,
    /// Base circles that keep the pressure angle.
    pub base_for_pressure: Answer<Vec<BaseRange>>,
    /// Base circles that keep the curvature.
    pub base_for_curvature: Answer<Vec<BaseRange>>,
    /// The offset that allows the least base circle; only of translating
    /// followers with roller or edge.
    pub best_offset: Option<BestOffset>,
    /// The contact at constant speed.
    pub force: Option<ForceFigures>,
    /// Why there is none.
    pub force_missing: Option<String>,
}

impl CamFigures {
    /// The verdict on a cam whose shape is sound: its contact decides.
    pub fn contact(&self) -> Judgement {
        let force = self.force.as_ref();
        force.map_or(Judgement::NotJudged, ForceFigures::contact_verdict)
    }

    /// The label of the forces, where objects of the scene are elastic.
    pub fn rigid(&self) -> Option<&Rigid> {
        self.force.as_ref()?.rigid.as_ref()
    }
}

/// Works out everything that is asked of a cam.
///
/// # Errors
/// Limits out of range.
pub fn figures(
    cam: &DiscCam,
    question: &Question,
    force: Result<&CamForce<'_>, &str>,
) -> Result<CamFigures, Vec<Fault>> {
    let geometry = cam.geometry();
    let curvature = cam.base_for_curvature(question.least_radius, question.roller_factor);
    let pressure = cam.base_for_pressure(question.pressure);
    let mut faults: Vec<Fault> = Vec::new();
    for found in [pressure.as_ref().err(), curvature.as_ref().err()] {
        // A wrong question, not a cam that cannot be.
        faults.extend(
            found
                .filter(|fault| !fault.path.starts_with("cam."))
                .cloned(),
        );
    }
    if !faults.is_empty() {
        return Err(faults);
    }
    let force = force.map(|force| force.figures(question.reserve));
    let force = match force {
        Ok(found) if !found.is_finite() => Err("the forces are no numbers any more"),
        other => other,
    };
    Ok(CamFigures {
        unit: match geometry.guide {
            Guide::Translating { .. } => "m",
            Guide::Turning { .. } => "rad",
        },
        stroke: cam.motion().stroke(),
        base_radius: geometry.base_radius,
        prime_radius: geometry.prime_radius(),
        start: cam.start(),
        speed: greatest_and_least(cam, |jet| jet.first),
        acceleration: greatest_and_least(cam, |jet| jet.second),
        pressure: cam.pressure_angles(),
        limits: question.pressure,
        excess: cam.pressure_excess(question.pressure),
        pitch: geometry.roller().map(|_| cam.radii(0.0)).map(Radii::from),
        profiles: geometry
            .flanks()
            .into_iter()
            .map(|offset| Radii::from(cam.radii(offset)))
            .collect(),
        roller: cam.roller_limits(question.roller_factor),
        face: face(cam),
        findings: cam.findings(),
        base_for_pressure: pressure.into(),
        base_for_curvature: curvature.into(),
        best_offset: cam.best_offset(question.pressure).ok(),
        force_missing: force.as_ref().err().map(|why| (*why).to_owned()),
        force: force.ok(),
    })
}

impl From<[Option<At>; 2]> for Radii {
    fn from([convex, concave]: [Option<At>; 2]) -> Self {
        Self { convex, concave }
    }
}

/// Greatest and least of a derivative of the motion.
fn greatest_and_least(cam: &DiscCam, f: impl Fn(crate::math::jet::Jet) -> f64) -> [At; 2] {
    let motion = cam.motion();
    let one = |sign: f64| {
        let found = greatest(motion, &|piece, phi| sign * f(motion.jet(piece, phi)));
        At {
            value: 0.0 + sign * found.value,
            ..found
        }
    };
    [one(1.0), one(-1.0)]
}

fn face(cam: &DiscCam) -> Option<FaceFigures> {
    let Contact::Flat { width, .. } = cam.geometry().contact else {
        return None;
    };
    let [least, greatest] = cam.face();
    Some(FaceFigures {
        least,
        greatest,
        needed_width: cam.needed_width()?,
        width,
    })
}
