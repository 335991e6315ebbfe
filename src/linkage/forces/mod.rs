//! Kinetostatics: reactions, driving force and friction of a linkage whose
//! motion is given.
//!
//! Free-body equations of all links, W·F = B − P − T, with two unknowns a pair
//! and the driver's force; W depends on the position alone and is factorised
//! once. Coulomb's friction in pins and in both corners of blocks; sliding
//! directions just after the position, in the direction of motion. The same
//! equations with the driver's force given and the acceleration unknown
//! ([`Kinetostatics::accelerate`]) are the motion under joint friction.
//!
//! Conventions: a pair joins link i (`on`) to link j (`link`); its reactions act
//! on j from i. The driver's force is a couple on j (opposite on i) or a force
//! on j along the guide, positive along the input coordinate.
//!
//! Source: K. Maczyński, S. Suwaj, "The influence of constructional and
//! kinematic parameters of the mechanism upon its dynamic transmission ratio"
//! (1987), the equations derived anew: printed signs are wrong in places.

mod accelerate;
mod equations;
mod external;
mod factor;
mod friction;
mod iteration;
mod positions;
mod result;
mod search;
mod sensitivity;
mod solve;
mod workspace;

#[cfg(test)]
mod tests;

pub use accelerate::{Acceleration, Outcome};
pub use iteration::{Convergence, Method};
pub use positions::{LinkPosition, PointPosition, Positions};
pub use result::{Balance, Reaction, SlidingFriction};
pub use sensitivity::Sensitivities;
pub use solve::{ForceFailure, InputMotion, Options, Solved};
pub use workspace::ForceWorkspace;

use super::spec::{LinkageSpec, PairKind};
use crate::fault::{Fault, Faults};
use friction::Law;

/// Which unknown stands in the last column of W.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Unknown {
    /// The driver's force; the motion is given.
    Drive,
    /// The acceleration of the input; the driver's force is given.
    Acceleration,
}

/// A linkage made ready for kinetostatics: immutable; what changes from
/// position to position is in a [`ForceWorkspace`].
#[derive(Clone, Debug)]
pub struct Kinetostatics {
    spec: LinkageSpec,
    /// Length scale ℓ: the greatest distance of two points of a link in use (m).
    length: f64,
    /// Length that a unit of each pair's coordinate stands for (ℓ or 1).
    units: Vec<f64>,
    /// Cosine and sine of each guide's direction in its link.
    directions: Vec<[f64; 2]>,
    /// Factors of friction of each pair that has any, without sign.
    friction_factors: Vec<Option<Law>>,
    /// Size of the inertia in the column of the acceleration (kg or kg·m).
    inertia_scale: f64,
}

impl Kinetostatics {
    /// Checks the linkage's numbers and makes it ready.
    ///
    /// # Errors
    ///
    /// Negative or non-finite masses, moments of inertia, coefficients of
    /// friction, diameters or heights; a block without length; a number of
    /// pairs other than (3n − 1)/2.
    pub fn new(spec: &LinkageSpec) -> Result<Self, Vec<Fault>> {
        check(spec)?;
        let length = length_scale(spec);
        let units = spec.pairs.iter().map(|pair| match pair.kind {
            PairKind::Revolute { .. } => length,
            PairKind::Sliding { .. } => 1.0,
        });
        let directions = spec.pairs.iter().map(|pair| match pair.kind {
            PairKind::Revolute { .. } => [1.0, 0.0],
            PairKind::Sliding { direction, .. } => [direction.cos(), direction.sin()],
        });
        let factors = spec.pairs.iter().map(|pair| {
            let law = match pair.kind {
                PairKind::Revolute { diameter } => {
                    Law::Pin(pair.friction * diameter / 2.0 / length)
                }
                PairKind::Sliding { half_height, .. } => {
                    Law::Guide([pair.friction, pair.friction * half_height / length])
                }
            };
            let active = match law {
                Law::Pin(factor) => factor > 0.0,
                Law::Guide([along, _]) => along > 0.0,
            };
            active.then_some(law)
        });
        let inertia = spec.links.iter().fold(0.0f64, |most, link| {
            most.max(link.mass * length).max(link.moment / length)
        });
        Ok(Self {
            length,
            units: units.collect(),
            directions: directions.collect(),
            friction_factors: factors.collect(),
            inertia_scale: if inertia > 0.0 { inertia } else { 1.0 },
            spec: spec.clone(),
        })
    }

    /// Memory for this linkage.
    pub fn workspace(&self) -> ForceWorkspace {
        let spec = &self.spec;
        ForceWorkspace::with_room(spec.links.len(), spec.pairs.len(), spec.forces.len())
    }

    /// The linkage in plain numbers.
    pub fn spec(&self) -> &LinkageSpec {
        &self.spec
    }

    /// The length scale ℓ (m): moments are compared with forces over it.
    pub fn length_scale(&self) -> f64 {
        self.length
    }

    /// True if any pair has friction.
    pub fn has_friction(&self) -> bool {
        self.friction_factors.iter().any(Option::is_some)
    }

    /// Number of equations.
    fn size(&self) -> usize {
        3 * self.spec.links.len()
    }

    /// Force or moment of a unit of the driver's unknown.
    fn drive_unit(&self) -> f64 {
        match self.spec.pairs[self.spec.driver].kind {
            PairKind::Revolute { .. } => self.length,
            PairKind::Sliding { .. } => 1.0,
        }
    }
}

/// The greatest distance of two points of a link that pairs use; 1 if all coincide.
fn length_scale(spec: &LinkageSpec) -> f64 {
    let ends = spec.pairs.iter().flat_map(|pair| [pair.on, pair.link]);
    let points: Vec<_> = ends.collect();
    let mut most = 0.0f64;
    for a in &points {
        for b in points.iter().filter(|b| b.link == a.link) {
            most = most.max((a.at[0] - b.at[0]).hypot(a.at[1] - b.at[1]));
        }
    }
    if most > 0.0 && most.is_finite() {
        most
    } else {
        1.0
    }
}

/// All faults of the numbers that kinetostatics needs.
fn check(spec: &LinkageSpec) -> Result<(), Vec<Fault>> {
    let mut faults = Faults::default();
    for link in &spec.links {
        let path = format!("links.{}", link.name);
        faults.not_negative(&format!("{path}.mass"), link.mass);
        faults.not_negative(&format!("{path}.moment_of_inertia"), link.moment);
        for coordinate in link.centre {
            faults.finite(&format!("{path}.centre"), coordinate);
        }
    }
    for pair in &spec.pairs {
        let path = format!("pairs.{}", pair.name);
        faults.not_negative(&format!("{path}.friction"), pair.friction);
        match pair.kind {
            PairKind::Revolute { diameter } => {
                faults.not_negative(&format!("{path}.diameter"), diameter);
            }
            PairKind::Sliding {
                corners,
                half_height,
                ..
            } => {
                faults.not_negative(&format!("{path}.height"), half_height);
                if !(corners[0] > corners[1] && corners.iter().all(|b| b.is_finite())) {
                    let message = format!(
                        "corners at {} and {} m carry no moment",
                        corners[0], corners[1]
                    );
                    faults.add(
                        format!("{path}.corners"),
                        message,
                        "the first corner lies ahead of the second along the guide",
                    );
                }
            }
        }
    }
    let (links, pairs) = (spec.links.len(), spec.pairs.len());
    if 2 * pairs + 1 != 3 * links {
        let message = format!(
            "{pairs} pairs between {links} moving links give {} equations for {} unknowns",
            3 * links,
            2 * pairs + 1
        );
        faults.add(
            "pairs",
            message,
            "one degree of freedom and statically determinate reactions need 3n = 2·pairs + 1",
        );
    } else if spec.driver >= pairs {
        faults.add("driver", "there is no such pair", "");
    }
    faults.check()
}
