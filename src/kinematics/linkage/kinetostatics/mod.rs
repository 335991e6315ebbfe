//! Kinetostatics: reactions, driving force and friction of a linkage whose
//! motion is given.
//!
//! Free-body equations of all links, W·F = B − P − T, with two unknowns a pair, one a
//! coupling (gears, belt, rack, cam), three a weld and the driver's force; W depends on the position alone and is factorised
//! once. Coulomb's friction in pins and in both corners of blocks; sliding
//! directions just after the position, in the direction of motion. The same
//! equations with the driver's force given and the acceleration unknown
//! ([`Kinetostatics::accelerate`]) are the motion under joint friction.
//!
//! A linkage of several inputs has a driving force at each, so that their number takes the place
//! of one; time takes that of the input coordinate ([`Kinetostatics::solve_over_time`]).
//!
//! Redundant constraints leave more unknowns than equations: as many unknowns, those that the equations
//! can best do without, are zero by a further row each. That is one solution of many; which unknowns
//! all of them share is told by [`Kinetostatics::indeterminate`].
//!
//! Conventions: a pair joins link i (`on`) to link j (`link`); its reactions act
//! on j from i. The driver's force is a couple on j (opposite on i) or a force
//! on j along the guide, positive along the input coordinate.
//!
//! An iteration of friction costs some tens of nanoseconds, since it runs on a few scalars. A
//! bound on f(F₀ − K·τ) proves that the solution is the only one; if it fails, others are
//! searched for. Over time `MultiMotion` gives the positions, and the force along it is the
//! power of all drivers.
//!
//! Source: K. Maczyński, S. Suwaj, "The influence of constructional and
//! kinematic parameters of the mechanism upon its dynamic transmission ratio"
//! (1987), the equations derived anew: printed signs are wrong in places.

mod accelerate;
mod couplings;
mod equations;
mod external;
mod friction;
mod held_pairs;
mod indeterminate;
mod injective;
mod iteration;
mod multi_input;
mod multi_input_slopes;
mod multi_input_solution;
mod outputs;
mod place;
mod positions;
mod ratio;
mod resistance;
mod result;
mod reversals;
mod search;
mod sensitivity;
mod sides;
mod solve;
mod welds;
mod workspace;

pub use accelerate::{Acceleration, Outcome};
pub use couplings::CouplingForce;
pub use indeterminate::Indeterminate;
pub use iteration::{Convergence, Method};
pub use multi_input::{OutputLoads, Sliding};
pub use positions::{InputMotion, LinkPosition, PointPosition, Positions};
pub use ratio::{Convention, Transmission};
pub use resistance::{Resistance, ResistanceModel};
pub use result::{Balance, Reaction, SlidingFriction};
pub use reversals::Reversals;
pub use sensitivity::Sensitivities;
pub use solve::{BAD_CONDITION, ForceFailure, Options, SolutionQuality};
pub use welds::WeldForce;
pub use workspace::ForceWorkspace;

use super::multi::spec::{InputCoordinate, MultiSpec};
use super::spec::{LinkageSpec, PairKind, PairSpec, Redundant};
use crate::fault::{Fault, Faults};
use friction::Law;

/// Unknown in the last column of W.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Unknown {
    /// The driver's force; the motion is given.
    Drive,
    /// The acceleration of the input; the driver's force is given.
    Acceleration,
    /// Friction's share of the input's force.
    Resistance {
        /// Acceleration per unit of it (1/(kg·m) or 1/kg).
        mobility: f64,
        /// The share of it that the driver's force takes over.
        share: f64,
    },
}

/// A linkage made ready for kinetostatics: immutable; what changes from
/// position to position is in a [`ForceWorkspace`].
#[derive(Clone, Debug)]
pub struct Kinetostatics {
    spec: LinkageSpec,
    /// Where driving forces act: one, or one for each of several inputs.
    drivers: Vec<InputCoordinate>,
    /// True of a linkage of several inputs: positions are over time.
    over_time: bool,
    /// Length scale ℓ: the greatest distance of two points of a link in use (m).
    length: f64,
    /// Length that a unit of each pair's coordinate stands for (ℓ or 1).
    units: Vec<f64>,
    /// Cosine and sine of each guide's direction in its link.
    directions: Vec<[f64; 2]>,
    /// Places of each block's corners along its guide (m).
    corners: Vec<[f64; 2]>,
    /// Number of equations of constraints that are redundant.
    redundant: usize,
    /// What each coupling presses by.
    coupled: Vec<super::joints::Joint>,
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
    /// pairs and couplings with 2·pairs + couplings other than 3n − 1 (and redundant constraints).
    pub fn new(spec: &LinkageSpec) -> Result<Self, Vec<Fault>> {
        check(spec, 1)?;
        if spec.driver >= spec.pairs.len() {
            return Err(vec![Fault::new("driver", "there is no such pair", "")]);
        }
        Ok(Self::with_drivers(
            spec,
            vec![InputCoordinate::Pair(spec.driver)],
            false,
        ))
    }

    /// The same of a linkage of several inputs, for [`Self::solve_over_time`] alone.
    ///
    /// # Errors
    ///
    /// As of [`Self::new`], with 3n = 2·pairs + couplings + inputs.
    pub fn of_inputs(spec: &MultiSpec) -> Result<Self, Vec<Fault>> {
        check(&spec.linkage, spec.inputs.len())?;
        let drivers = spec.inputs.iter().map(|input| input.coordinate);
        Ok(Self::with_drivers(&spec.linkage, drivers.collect(), true))
    }

    fn with_drivers(spec: &LinkageSpec, drivers: Vec<InputCoordinate>, over_time: bool) -> Self {
        let length = length_scale(spec);
        let inertia = spec.links.iter().fold(0.0f64, |most, link| {
            most.max(link.mass * length).max(link.moment / length)
        });
        let pairs = &spec.pairs;
        Self {
            drivers,
            over_time,
            length,
            units: pairs.iter().map(|pair| unit(pair, length)).collect(),
            directions: pairs.iter().map(direction).collect(),
            corners: pairs.iter().map(|pair| corners(pair, length)).collect(),
            friction_factors: pairs.iter().map(|pair| friction(pair, length)).collect(),
            redundant: spec.redundant.iter().map(Redundant::equations).sum(),
            coupled: couplings::coupled(spec),
            inertia_scale: if inertia > 0.0 { inertia } else { 1.0 },
            spec: spec.clone(),
        }
    }

    /// Memory for this linkage.
    pub fn workspace(&self) -> ForceWorkspace {
        let spec = &self.spec;
        ForceWorkspace::with_room([
            spec.links.len(),
            spec.pairs.len(),
            spec.forces.len(),
            spec.outputs.len(),
            self.redundant,
        ])
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

    /// Number of equations: three a link, one for each unknown that is zero.
    fn equations_count(&self) -> usize {
        3 * self.spec.links.len() + self.redundant
    }

    /// True of a linkage of several inputs.
    pub fn is_over_time(&self) -> bool {
        self.over_time
    }

    /// Force or moment of a unit of the driver's unknown.
    fn drive_unit(&self) -> f64 {
        self.unit_of(self.drivers[0])
    }

    /// Force or moment of a unit of a driver's unknown.
    fn unit_of(&self, driver: InputCoordinate) -> f64 {
        match driver {
            InputCoordinate::Pair(pair) => unit(&self.spec.pairs[pair], self.length),
            InputCoordinate::X(_) | InputCoordinate::Y(_) => 1.0,
            InputCoordinate::Angle(_) => self.length,
        }
    }
}

/// Length that a unit of a pair's coordinate stands for.
fn unit(pair: &PairSpec, length: f64) -> f64 {
    if pair.slides() { 1.0 } else { length }
}

/// Cosine and sine of a guide's direction in its link.
fn direction(pair: &PairSpec) -> [f64; 2] {
    pair.direction().unwrap_or([1.0, 0.0])
}

/// A block's corners; of one without friction they may be left open, and any
/// two serve to carry force and couple.
fn corners(pair: &PairSpec, length: f64) -> [f64; 2] {
    match pair.kind {
        PairKind::Sliding {
            corners: [a, b], ..
        } if a > b => [a, b],
        _ => [0.5 * length, -0.5 * length],
    }
}

/// Factors of a pair's friction, `None` without any.
fn friction(pair: &PairSpec, length: f64) -> Option<Law> {
    let mu = pair.friction;
    match pair.kind {
        PairKind::Revolute { diameter } => {
            let factor = mu * diameter / 2.0 / length;
            (factor > 0.0).then_some(Law::Pin(factor))
        }
        PairKind::Sliding { half_height, .. } => {
            (mu > 0.0).then_some(Law::Guide([mu, mu * half_height / length]))
        }
    }
}

/// The greatest distance of two points of a link that pairs and cams use, or radius of a cam; 1 if
/// all coincide.
fn length_scale(spec: &LinkageSpec) -> f64 {
    let points: Vec<_> = spec.joints().collect();
    let mut most = spec.greatest_coupling();
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
fn check(spec: &LinkageSpec, inputs: usize) -> Result<(), Vec<Fault>> {
    let mut faults = Faults::default();
    for link in &spec.links {
        let path = format!("links.{}", link.name);
        faults.not_negative(&format!("{path}.mass"), link.mass);
        faults.not_negative(&format!("{path}.moment"), link.moment);
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
                faults.not_negative(&format!("{path}.sliding.half_height"), half_height);
                let finite = corners.iter().all(|b| b.is_finite());
                let none = corners[0] == corners[1] && pair.friction == 0.0;
                if !(finite && (none || corners[0] > corners[1])) {
                    let [forward, back] = corners;
                    faults.add(
                        format!("{path}.sliding.corners"),
                        format!("corners at {forward} m and {back} m carry no moment"),
                        "the first corner lies ahead of the second along the guide",
                    );
                }
            }
        }
    }
    let before = faults.len();
    super::couplings::check(spec, &mut faults);
    if faults.len() == before {
        count(spec, inputs, &mut faults);
    }
    faults.check()
}

/// As many equations as unknowns.
fn count(spec: &LinkageSpec, inputs: usize, faults: &mut Faults) {
    let (links, pairs) = (spec.links.len(), spec.pairs.len());
    let redundant: usize = spec.redundant.iter().map(Redundant::equations).sum();
    let unknowns = 2 * pairs + spec.couplings.len() + 3 * spec.welds.len() + inputs;
    if unknowns != 3 * links + redundant {
        let coupled = match spec.couplings.len() {
            0 => String::new(),
            couplings => format!(" and {couplings} couplings"),
        };
        let message = format!(
            "{pairs} pairs{coupled} between {links} moving links give {} equations for {unknowns} unknowns",
            3 * links,
        );
        let hint = match inputs {
            1 => {
                "one degree of freedom and statically determinate reactions need 3n = 2·pairs + couplings + 1"
            }
            _ => "statically determinate reactions need 3n = 2·pairs + couplings + inputs",
        };
        faults.add("pairs", message, hint);
    }
}
