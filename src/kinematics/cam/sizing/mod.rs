//! Sizes of a cam: the least base circle, the best offset, the greatest roller.

mod scan;

use super::disc::DiscCam;
use super::motion::Piece;
use super::search::{At, greatest};
use super::spec::{Contact, Guide, Surface};
use crate::fault::Fault;
use crate::math::optimise::golden;
use crate::units::shown;
use serde::Serialize;
use std::f64::consts::FRAC_PI_2;

/// Greatest pressure angles allowed (rad), between 0 and π/2.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PressureLimits {
    /// While the follower moves outwards, pushed by the cam.
    pub outward: f64,
    /// While it moves inwards, pushed by its closing force.
    pub inward: f64,
}

/// Base circles that keep a condition: the radius of the cam's base circle
/// from … to (m); no upper end where there is none.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct BaseRange {
    /// Least radius.
    pub from: f64,
    /// Greatest radius; null: any greater one.
    pub to: Option<f64>,
}

/// The least base circle with the offset that allows it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct BestOffset {
    /// The offset (m).
    pub offset: f64,
    /// Radius of the base circle (m).
    pub base_radius: f64,
}

/// Limits of rollers and cutters, the pitch curve being what it is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RollerLimits {
    /// Radius of the roller at which the profile first has a cusp: the least
    /// radius of curvature of the pitch curve on the roller's side, and where;
    /// null: any roller does.
    pub cusp: Option<At>,
    /// Greatest radius advised: `factor` times that.
    pub advised: Option<f64>,
    /// The factor.
    pub factor: f64,
    /// Greatest radius of a cutter or grinding wheel that reaches all of the
    /// profile, and where: its least concave radius; null: any does.
    pub cutter: Option<At>,
}

impl DiscCam {
    /// Base circles on which the pressure angle keeps within `limits`,
    /// everything else being as it is.
    ///
    /// # Errors
    /// There is none; the fault says the least greatest pressure angle that
    /// can be had, and where. A flat face has a pressure angle that hardly or not at
    /// all depends on the base circle and is judged as it is.
    pub fn base_for_pressure(&self, limits: PressureLimits) -> Result<Vec<BaseRange>, Fault> {
        check(limits)?;
        match (self.geometry().guide, self.geometry().contact) {
            (Guide::Translating { offset }, Contact::Roller { .. } | Contact::KnifeEdge) => {
                let prime = self.prime_for_pressure(limits, offset);
                Ok(vec![BaseRange {
                    from: self.base_of(prime),
                    to: None,
                }])
            }
            (Guide::Translating { .. }, Contact::Flat { inclination, .. }) => {
                let least = limits.outward.min(limits.inward);
                match inclination.abs() <= least {
                    true => Ok(vec![BaseRange {
                        from: 0.0,
                        to: None,
                    }]),
                    false => {
                        let message = format!(
                            "the pressure angle is the face's inclination, {} deg, on every base \
                             circle",
                            shown(inclination.to_degrees().abs(), 6)
                        );
                        let path = "cam.contact.flat.inclination";
                        Err(Fault::new(path, message, "incline the face less"))
                    }
                }
            }
            _ => self.base_by_scan(limits),
        }
    }

    /// The offset of a translating roller follower for which the base circle
    /// can be least within `limits`.
    ///
    /// The distance s₀(e) = max (|s′ − e|/tan α − s) is the greatest of functions
    /// convex in e, so that the prime radius √(s₀² + e²) has one minimum.
    ///
    /// # Errors
    /// Limits out of range; a follower that has no offset to choose.
    pub fn best_offset(&self, limits: PressureLimits) -> Result<BestOffset, Fault> {
        check(limits)?;
        let roller = matches!(
            self.geometry().contact,
            Contact::Roller { .. } | Contact::KnifeEdge
        );
        if !matches!(self.geometry().guide, Guide::Translating { .. }) || !roller {
            let message = "only a translating follower with roller or edge has an offset to choose";
            return Err(Fault::new("cam.offset", message, ""));
        }
        let size = self.motion().sizes()[0];
        let mut lesser = |offset: f64| -self.prime_for_pressure(limits, offset);
        let offset = golden(&mut lesser, [-size, size], 80).at;
        // A law with equal slopes both ways wants none: say 0, not its rounding.
        let offset = if offset.abs() < 1e-8 * size {
            0.0
        } else {
            offset
        };
        let prime = self.prime_for_pressure(limits, offset);
        Ok(BestOffset {
            offset,
            base_radius: self.base_of(prime),
        })
    }

    /// Radius of the base circle on a prime circle of this radius.
    fn base_of(&self, prime: f64) -> f64 {
        let base = self.geometry().with_prime_radius(prime).base_radius;
        // A disc as small as its roller has no base circle left, not 1e-18 m of it.
        if base.abs() < 1e-12 * prime {
            0.0
        } else {
            base
        }
    }

    /// Least prime radius of a translating roller follower with an offset.
    fn prime_for_pressure(&self, limits: PressureLimits, offset: f64) -> f64 {
        let motion = self.motion();
        let needed = greatest(motion, &|piece, phi| {
            let jet = motion.jet(piece, phi);
            (jet.first - offset).abs() / limits.tangent(jet.first) - jet.value
        });
        let prime = needed.value.max(0.0).hypot(offset);
        let roller = self.geometry().roller().unwrap_or(0.0);
        match self.geometry().surface {
            // The base circle of a disc is no smaller than nothing.
            Surface::Disc | Surface::Groove => prime.max(roller),
            Surface::Hollow => prime,
        }
    }

    /// Greatest |tan α| by the tangent of the limit in force, and where.
    fn pressure_share(&self, limits: PressureLimits) -> At {
        let motion = self.motion();
        greatest(motion, &|piece, phi| {
            let pressure = self.touch(piece, phi).pressure;
            pressure.abs() / limits.tangent(motion.jet(piece, phi).first)
        })
    }

    fn base_by_scan(&self, limits: PressureLimits) -> Result<Vec<BaseRange>, Fault> {
        let share = |cam: &Self| cam.pressure_share(limits).value;
        let found = self.scan(share);
        if !found.ranges.is_empty() {
            return Ok(found.ranges);
        }
        let angle = |tangent: f64| (tangent * limits.outward.tan()).atan().to_degrees();
        let message = format!(
            "no base circle keeps the pressure angle within {} deg",
            shown(limits.outward.to_degrees(), 6)
        );
        let hint = format!(
            "the least that can be had here is {} deg, on a base circle of {} m; change arm, \
             centre distance, sense of swing or the law",
            shown(angle(found.best.1), 6),
            shown(found.best.0, 6)
        );
        Err(Fault::new("cam.base_radius", message, hint))
    }

    /// Base circles on which the profile is nowhere sharper than allowed: a
    /// flat face's radius of curvature at least `radius` (m); a roller at most
    /// `factor` times the least radius of curvature of the pitch curve on its
    /// side.
    ///
    /// # Errors
    /// There is none; the fault says how near one can come.
    pub fn base_for_curvature(&self, radius: f64, factor: f64) -> Result<Vec<BaseRange>, Fault> {
        if !(radius.is_finite() && radius >= 0.0) {
            let message = format!("{radius} m is no least radius of curvature");
            return Err(Fault::new(
                "least_radius",
                message,
                "give zero or a positive length",
            ));
        }
        if !(factor.is_finite() && factor > 0.0 && factor <= 1.0) {
            let message = format!("{factor} is no share of the least radius of curvature");
            return Err(Fault::new(
                "roller_factor",
                message,
                "give a number above 0, at most 1",
            ));
        }
        if let (Guide::Translating { .. }, None) = (self.geometry().guide, self.geometry().roller())
        {
            // The radius of curvature is the base circle's plus a function of φ.
            let least = self.curvature_extremes()[0].value;
            let from = (self.geometry().base_radius + radius - least).max(0.0);
            return Ok(vec![BaseRange { from, to: None }]);
        }
        let found = self.scan(|cam| cam.smoothness_ratio(radius, factor));
        match found.ranges.is_empty() {
            false => Ok(found.ranges),
            true => {
                let message = "no base circle makes the profile smooth enough";
                let hint = format!(
                    "nearest is a base circle of {} m; change arm, centre distance or the law",
                    shown(found.best.0, 6)
                );
                Err(Fault::new("cam.base_radius", message, hint))
            }
        }
    }

    /// At most 1 where the profile is smooth enough.
    fn smoothness_ratio(&self, radius: f64, factor: f64) -> f64 {
        let [least, most] = self.curvature_extremes();
        match self.geometry().roller() {
            // Radius of curvature at least `radius`: no ratio, it may be negative.
            None => 1.0 + (radius - least.value) / self.geometry().base_radius,
            Some(roller) => {
                let sides = self.geometry().flanks().into_iter();
                let worst = sides.map(|offset| match offset <= 0.0 {
                    true => most.value,
                    false => -least.value,
                });
                worst.fold(0.0f64, f64::max) * roller / factor
            }
        }
    }

    /// Limits of rollers and cutters on this pitch curve; `None` under a flat face.
    pub fn roller_limits(&self, factor: f64) -> Option<RollerLimits> {
        let roller = self.geometry().roller()?;
        let [least, most] = self.curvature_extremes();
        let radius = |curvature: At, sign: f64| {
            let sharp = sign * curvature.value > 0.0;
            sharp.then(|| At {
                value: 1.0 / (sign * curvature.value),
                phi: curvature.phi,
            })
        };
        let (convex, concave) = (radius(most, 1.0), radius(least, -1.0));
        let (cusp, other) = match self.geometry().surface {
            Surface::Disc => (convex, concave),
            Surface::Hollow => (concave, convex),
            Surface::Groove => {
                let sharper = |a: At, b: At| if a.value <= b.value { a } else { b };
                let both = match (convex, concave) {
                    (Some(a), Some(b)) => Some(sharper(a, b)),
                    (one, other) => one.or(other),
                };
                (both, None)
            }
        };
        let cutter = match self.geometry().surface {
            // A groove is cut by a cutter no greater than the roller.
            Surface::Groove => Some(At {
                value: roller,
                phi: self.motion().range().0,
            }),
            Surface::Disc | Surface::Hollow => other.map(|at| At {
                value: at.value + roller,
                ..at
            }),
        };
        Some(RollerLimits {
            cusp,
            advised: cusp.map(|at| factor * at.value),
            factor,
            cutter,
        })
    }

    /// Width a flat face needs if it reaches as far to both sides of the
    /// follower's line (translating), or from its least to its greatest
    /// distance from the follower's axis (turning); `None` of a roller.
    pub fn needed_width(&self) -> Option<f64> {
        if self.geometry().roller().is_some() {
            return None;
        }
        let [least, most] = self.face();
        Some(match self.geometry().guide {
            Guide::Translating { .. } => 2.0 * least.value.abs().max(most.value.abs()),
            Guide::Turning { .. } => most.value - least.value,
        })
    }

    /// Where the pressure angle is beyond its limit: [`At::value`] the angle
    /// (rad) that exceeds it most, `None` where all is within.
    pub fn pressure_excess(&self, limits: PressureLimits) -> Option<At> {
        let worst = self.pressure_share(limits);
        (worst.value > 1.0 + 1e-12).then(|| {
            let (piece, phi): (&Piece, f64) = self.motion().piece_at(worst.phi);
            At {
                value: self.at(piece, phi).pressure_angle,
                phi,
            }
        })
    }
}

impl PressureLimits {
    /// tan of the limit in force at a slope s′ of the law.
    fn tangent(&self, slope: f64) -> f64 {
        if slope > 0.0 {
            self.outward.tan()
        } else if slope < 0.0 {
            self.inward.tan()
        } else {
            self.outward.max(self.inward).tan()
        }
    }
}

fn check(limits: PressureLimits) -> Result<(), Fault> {
    let ends = [
        ("pressure_angle", limits.outward),
        ("return_pressure_angle", limits.inward),
    ];
    for (path, limit) in ends {
        if !(limit > 0.0 && limit < FRAC_PI_2) {
            let message = format!("{} deg is no greatest pressure angle", limit.to_degrees());
            return Err(Fault::new(
                path,
                message,
                "give an angle above 0 and below 90 deg",
            ));
        }
    }
    Ok(())
}
