//! The frozen system: numbers laid out for the right-hand side.
//!
//! Immutable and `Sync`. State enters as slices, results leave through
//! `&mut` slices; nothing here allocates, hashes or walks a graph once built.
//!
//! `check` and `build` make the `frozen` layout of a model. `passes`, `constraints` and
//! `links` are the equations of motion. `pairs`, `loads`, `linkages` and
//! `switches` what enters them. `balance`, `placing`, `start` and `onset` the state at t = 0.
//! `observe`, `energy` and `reduce` what is read off. `scales` and `frequencies` what the
//! methods are chosen and steered by.
//!
//! Limits: two tables of the system are made at the first request; all else never changes.

mod accelerations;
mod balance;
mod build;
mod check;
mod constraints;
pub(crate) mod dry_friction;
mod dynamics;
mod energy;
mod forest;
mod frequencies;
mod friction;
mod frozen;
mod given;
mod growth;
mod impacts;
mod kappa;
mod linearised;
mod linkages;
mod links;
mod loads;
mod masses;
mod method_estimates;
mod multi;
mod narrow;
mod observe;
mod onset;
mod output_accelerations;
mod pairs;
mod passes;
mod pattern;
mod placing;
mod points;
mod reduce;
mod reduced;
mod scales;
mod separate;
mod start;
mod start_messages;
#[cfg(test)]
mod start_tests;
mod stops;
mod switches;
mod taylor;
#[cfg(test)]
mod testing;
#[cfg(test)]
mod testing_random;
#[cfg(test)]
mod tests;
mod trains;
mod written;

pub(crate) use frequencies::MANY_COORDINATES;
pub use frequencies::VibrationMode;
pub(crate) use friction::StickSlip;
pub use linearised::Regime;
pub use reduce::ReducedRotor;

use crate::dynamics::integrate::Modes;
use crate::dynamics::model::Model;
use crate::fault::Fault;
use crate::math::number::{Dual, Duals};
use frozen::{Frozen, Step};
pub use masses::MassState;
use observe::{Body, ObjectPlace};
pub(crate) use output_accelerations::OutputAccelerations;
use passes::Work;
use reduced::Modal;
pub(crate) use scales::MotionRanges;
use std::sync::{Arc, OnceLock};
use taylor::Taylor;

/// A model frozen for integration; implements [`crate::dynamics::integrate::Dynamics`].
#[derive(Debug)]
pub struct System {
    model: Model,
    frozen: Frozen,
    /// Place of each of the model's objects in the frozen layout.
    places: Vec<ObjectPlace>,
    /// Scale of each state entry, found when first asked for.
    scales: OnceLock<Vec<f64>>,
    /// The laws along the motion of the drives, sampled for the scales.
    sampled: OnceLock<Arc<MotionRanges>>,
}

/// Working memory of one evaluation; made by
/// [`crate::dynamics::integrate::Dynamics::scratch`].
#[derive(Clone, Debug)]
pub struct Scratch {
    work: Work<f64>,
    accelerations: Vec<f64>,
    dual_work: Work<Dual>,
    dual_state: Vec<Dual>,
    dual_accelerations: Vec<Dual>,
    /// Derivatives along many directions, once they have been asked for.
    bundle: Option<Box<Bundle>>,
    /// Series of the motion, once they have been asked for.
    taylor: Option<Box<Taylor>>,
}

/// Directions that the equations are differentiated along at once.
const DIRECTIONS: usize = 8;

/// Working memory of an evaluation with its derivatives along [`DIRECTIONS`].
#[derive(Clone, Debug)]
struct Bundle {
    work: Work<Duals<DIRECTIONS>>,
    state: Vec<Duals<DIRECTIONS>>,
    accelerations: Vec<Duals<DIRECTIONS>>,
}

/// Motion and forces of an object at an instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ObjectState {
    /// φ of the last mass.
    pub displacement: f64,
    /// φ̇ of the last mass.
    pub speed: f64,
    /// φ̈ of the last mass.
    pub acceleration: f64,
    /// δ = φ_n − U(φ_driver); 0 for drives and rigid objects.
    pub delta: f64,
    /// dδ/dt.
    pub delta_speed: f64,
    /// F of link 1, the force with which the object pulls at its law (the
    /// driver receives F·U′); of a rigid object the constraint's F. For a
    /// drive: the moment that drives it (prescribed: the moment needed).
    pub reaction: f64,
    /// N ≥ 0 of the pair (force and form closures); of a rigid force-closed
    /// pair the margin, negative where it would lift off; 0 when open; NaN
    /// never. Bilateral: 0.
    pub contact_force: f64,
    /// Deformation x of link 1.
    pub deformation: f64,
    /// ẋ of link 1.
    pub deformation_speed: f64,
    /// Clearance of an open pair: distance to the nearest flank, 0 when engaged
    /// or penetrating.
    pub lift: f64,
    /// Indentation p ≥ 0 of the contact element of a pair that can open; 0 without one.
    pub indentation: f64,
    /// Hertzian pressure between a follower and its cam (Pa); 0 where they do not press on
    /// each other, and where nothing is known of their material.
    pub pressure: f64,
}

/// Powers at an instant (W).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Power {
    /// Work rate of prescribed drives on the mechanism.
    pub drives: f64,
    /// Work rate of all loads (motors and springs included).
    pub loads: f64,
    /// Dissipation in links, pairs and the dampers of linkages, ≥ 0.
    pub dissipated: f64,
    /// Friction in the joints of linkages, ≥ 0.
    pub friction: f64,
}

/// Energies at an instant (J).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// Kinetic energy of all inertias.
    pub kinetic: f64,
    /// Elastic energy of links and pairs, potential energy of linkages.
    pub elastic: f64,
}

/// State at t = 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InitialState {
    /// y = [u, u̇].
    pub y: Vec<f64>,
    /// Modes just after t = 0.
    pub modes: Modes,
    /// Things the user should know (inertia load left out, …).
    pub warnings: Vec<String>,
}

impl System {
    /// Freezes a model.
    ///
    /// # Errors
    /// Every fault that only shows in numbers.
    pub fn new(model: Model) -> Result<Self, Vec<Fault>> {
        let frozen = build::freeze(&model)?;
        let find = |part| ObjectPlace::find(&frozen, &model, part);
        let mut places: Vec<ObjectPlace> = model.objects.iter().map(find).collect();
        for reduced in &model.reduced {
            places[reduced.object].modal = Some(Modal::of(&frozen, &model, reduced));
        }
        let is_stop = |load: usize| model.loads[load].law.is_stop();
        for stop in &model.stops {
            let before = (0..stop.load).filter(|&load| is_stop(load)).count();
            places[stop.part].body = Body::Stop(before);
        }
        let mut system = Self {
            model,
            frozen,
            places,
            scales: OnceLock::new(),
            sampled: OnceLock::new(),
        };
        system.find_tangents();
        system.find_kappas()?;
        Ok(system)
    }

    /// Scale of each state entry. (Exact propagation needs none: thousands of
    /// samples of the laws are saved in a map.)
    fn scales_of_state(&self) -> &[f64] {
        self.scales
            .get_or_init(|| scales::scales(&self.frozen, self.laws_sampled()))
    }

    /// The laws along the motion of the drives.
    fn laws_sampled(&self) -> &MotionRanges {
        let sample = || Arc::new(scales::sample(&self.frozen));
        self.sampled.get_or_init(sample)
    }

    /// The samples of its laws that scales are found from, if they have been taken
    /// and follow from the laws alone: a motor's depend on its inertia and torque.
    pub(crate) fn samples_of_laws(&self) -> Option<Arc<MotionRanges>> {
        let rotor = |step: &Step| matches!(step, Step::Rotor(_));
        let taken = self.sampled.get()?;
        (!self.frozen.steps.iter().any(rotor)).then(|| taken.clone())
    }

    /// Takes over the samples of a system that moves by the same laws.
    pub(crate) fn take_samples(&self, samples: Arc<MotionRanges>) {
        // Own ones, where there are any, are the same.
        let _ = self.sampled.set(samples);
    }

    /// Lower bound of the scale δ* of an elastic object, without sampling its law; zero
    /// of anything else.
    pub(crate) fn least_deflection(&self, object: usize) -> f64 {
        let chain = self.chain(object);
        chain.map_or(0.0, |chain| scales::least_deflection(&self.frozen, chain))
    }

    /// The model it was made from.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// Coordinate index (in y) of the last mass of an object, or of a motor's
    /// rotor; `None` for prescribed drives and rigid objects.
    pub fn last_coordinate(&self, object: usize) -> Option<usize> {
        self.frozen.coordinate[self.places[object].node]
    }

    /// Coordinate index of the first mass (deformation x of link 1); `None`
    /// for drives and rigid objects.
    pub fn first_coordinate(&self, object: usize) -> Option<usize> {
        self.chain(object).map(|chain| chain.first_coordinate)
    }

    /// Component of [`Modes`] of an object's pair, when it can open.
    /// Values: 0 open, −1 engaged on the lower flank (x < 0), +1 on the upper.
    /// A stop has one too: it is a pair between its mass and the ground.
    pub fn pair_component(&self, object: usize) -> Option<usize> {
        match self.stop_of(object) {
            Some(stop) => Some(self.frozen.stops[stop].component),
            None => self.chain(object).and_then(|chain| chain.component),
        }
    }

    /// Coordinate (in y) of a node of the model that moves freely.
    pub(crate) fn coordinate_of(&self, node: usize) -> Option<usize> {
        self.frozen.coordinate[self.frozen.internal[node]]
    }

    /// κ in force in the pair of an object.
    pub(crate) fn dissipation(&self, object: usize) -> Option<f64> {
        self.chain(object).and_then(|chain| chain.contact.kappa)
    }

    /// The stop that an object part is, index into [`Frozen::stops`].
    fn stop_of(&self, part: usize) -> Option<usize> {
        match self.places[part].body {
            Body::Stop(stop) => Some(stop),
            _ => None,
        }
    }

    fn chain(&self, object: usize) -> Option<&frozen::Chain> {
        match self.places[object].body {
            Body::Chain(chain) => Some(&self.frozen.chains[chain]),
            _ => None,
        }
    }

    /// Name of a state entry: "rocker, mass 2: speed".
    fn entry_name(&self, index: usize) -> String {
        let coordinate = index % self.frozen.coordinates.max(1);
        let what = if index < self.frozen.coordinates {
            "displacement"
        } else {
            "speed"
        };
        for part in &self.model.objects {
            for (mass, &node) in part.nodes.iter().enumerate() {
                if self.frozen.coordinate[self.frozen.internal[node]] == Some(coordinate) {
                    return match part.nodes.len() {
                        1 => format!("{}: {what}", part.id),
                        _ => format!("{}, mass {}: {what}", part.id, mass + 1),
                    };
                }
            }
        }
        let chains = self.frozen.chains.iter().enumerate();
        let mut points = chains.filter(|(_, chain)| chain.point);
        match points.find(|(_, chain)| chain.first_coordinate == coordinate) {
            Some((chain, _)) => {
                let id = &self.model.objects[self.part_of_chain(chain)].id;
                format!("{id}, point of contact: {what}")
            }
            None => format!("coordinate {coordinate}: {what}"),
        }
    }
}
