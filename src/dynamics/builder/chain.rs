//! Chains of masses, and rigid objects.

use super::driven_end::{balanced_shares, loaded};
use super::modes::{Modal, ModalLowering};
use super::spec::{BodySpec, ChainSpec, InertiaSplit, Level, Lumping, PairSpec};
use super::{InputConnection, ModelBuilder, Place, contact, driven_end, stop};
use crate::dynamics::laws::contact::law_of_link;
use crate::dynamics::model::{Closure, Coordinate, Law, Loss, NodeIndex, Pair};
use crate::dynamics::stated::StatedPosition;
use crate::fault::{Fault, Faults};
use crate::kinematics::position::{Position, PositionSpec};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Inertia, stiffness and damping of every mass and link of a chain, link m
/// before mass m; lists of length n, empty for a rigid object.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ChainParameters {
    /// J_m (kg·m² or kg).
    pub inertias: Vec<f64>,
    /// c_m (N·m/rad or N/m).
    pub stiffnesses: Vec<f64>,
    /// b_m (N·m·s/rad or N·s/m).
    pub dampings: Vec<f64>,
    /// Inertia at the driven end, which moves with the law (kg·m² or kg).
    pub driven_end: f64,
}

/// What an object stands for as long as its level is open.
const PROVISIONAL: Level = Level::Masses {
    count: 1,
    lumping: Lumping::Ends,
};

impl ChainParameters {
    /// The parameters of a body.
    ///
    /// From few data: J_m by the split; c_m = n·c, so that the series
    /// stiffness is c; b_m = ψ·c_m/(2π·ω₀) with ω₀ = √(c/J), so that the
    /// series damper is ψ·√(cJ)/(2π), for every n. Balanced, the inertia of each cell is
    /// split over its two ends.
    ///
    /// # Errors
    /// Numbers out of range and lists that do not match; paths relative to
    /// the object.
    pub fn new(body: &BodySpec) -> Result<Self, Vec<Fault>> {
        let mut faults = Faults::default();
        let parameters = match body {
            BodySpec::Rigid { inertia } => {
                faults.not_negative("inertia", *inertia);
                Self::default()
            }
            BodySpec::Uniform {
                inertia,
                stiffness,
                damping_capacity,
                masses,
                split,
                lumping,
            } => {
                faults.positive("inertia", *inertia);
                faults.positive("stiffness", *stiffness);
                faults.not_negative("damping_capacity", *damping_capacity);
                if *masses == 0 {
                    faults.add("masses", "an elastic object has masses", "give at least 1");
                }
                let (end, shares) = match lumping {
                    Lumping::Ends => (0.0, shares(&mut faults, split, *masses)),
                    Lumping::Balanced => balanced(&mut faults, split, *masses),
                };
                let chain_stiffness = *masses as f64 * stiffness;
                let base_frequency = (stiffness / inertia).sqrt();
                let damping = damping_capacity * chain_stiffness / (TAU * base_frequency);
                Self {
                    inertias: shares.iter().map(|share| share * inertia).collect(),
                    stiffnesses: vec![chain_stiffness; *masses],
                    dampings: vec![damping; *masses],
                    driven_end: end * inertia,
                }
            }
            // Its oscillators have parameters of their own.
            BodySpec::Modes { .. } => Self::default(),
            BodySpec::Open(uniform) => return Self::new(&uniform.at(PROVISIONAL)),
            BodySpec::Lists {
                inertias,
                stiffnesses,
                dampings,
            } => Self {
                inertias: inertias.clone(),
                stiffnesses: stiffnesses.clone(),
                dampings: dampings.clone(),
                driven_end: 0.0,
            },
        };
        faults.check()?;
        if !matches!(body, BodySpec::Rigid { .. } | BodySpec::Modes { .. }) {
            parameters.check(&mut faults);
        }
        faults.check()?;
        Ok(parameters)
    }

    fn check(&self, faults: &mut Faults) {
        let masses = self.inertias.len();
        if masses == 0 {
            faults.add("inertias", "the list is empty", "give one inertia a mass");
        }
        for (name, list) in [
            ("stiffnesses", &self.stiffnesses),
            ("dampings", &self.dampings),
        ] {
            if list.len() != masses {
                let message = format!("{} values for {masses} masses", list.len());
                faults.add(name, message, "give one value a mass");
            }
        }
        for (index, &inertia) in self.inertias.iter().enumerate() {
            faults.positive(&format!("inertias[{index}]"), inertia);
        }
        for (index, &stiffness) in self.stiffnesses.iter().enumerate() {
            faults.positive(&format!("stiffnesses[{index}]"), stiffness);
        }
        for (index, &damping) in self.dampings.iter().enumerate() {
            faults.not_negative(&format!("dampings[{index}]"), damping);
        }
    }
}

/// Share of the inertia at the driven end and at each mass of a balanced chain.
fn balanced(faults: &mut Faults, split: &InertiaSplit, masses: usize) -> (f64, Vec<f64>) {
    if let Some(found) = balanced_shares(split, masses) {
        return found;
    }
    let message = "shares of one's own are no continuum that could be balanced";
    faults.add(
        "lumping",
        message,
        "give `ends`, or the split `equal` or `cubes`",
    );
    (0.0, shares(faults, split, masses))
}

/// Share of the inertia in each fragment.
fn shares(faults: &mut Faults, split: &InertiaSplit, masses: usize) -> Vec<f64> {
    let count = masses as f64;
    match split {
        InertiaSplit::Equal => vec![1.0 / count; masses],
        // m³ − (m−1)³ = 3m(m−1) + 1, whole numbers without rounding.
        InertiaSplit::Cubes => (1..=masses)
            .map(|m| (3.0 * m as f64 * (m as f64 - 1.0) + 1.0) / (count * count * count))
            .collect(),
        InertiaSplit::Shares(shares) => {
            if shares.len() != masses {
                let message = format!("{} shares for {masses} masses", shares.len());
                faults.add("split", message, "give one share a mass");
            }
            for (index, &share) in shares.iter().enumerate() {
                faults.positive(&format!("split[{index}]"), share);
            }
            let sum: f64 = shares.iter().sum();
            if (sum - 1.0).abs() > 1e-6 {
                let message = format!("the shares make {sum}, not 1");
                faults.add("split", message, "give shares that sum to 1");
            }
            shares.clone()
        }
    }
}

impl ModelBuilder {
    /// Lowers a chain of masses, or a rigid object, behind what an input hangs on, to
    /// its nodes, links and loads. `input`: `None` where that has faults of its own.
    pub fn chain(&mut self, at: &Place, input: Option<&InputConnection>, spec: &ChainSpec) {
        let law = self.law_of(at, input, spec);
        let parameters = ChainParameters::new(&spec.body);
        let pair = self.pair(at, spec);
        let (law, parameters) = match (law, parameters) {
            (Some(law), Ok(parameters)) => (law, parameters),
            (_, Err(faults)) => return self.faults(at, "", faults),
            _ => return,
        };
        let parameters = match spec.pair.contact {
            Some(_) => parameters.with_far_first_cell(),
            None => parameters,
        };
        let driver = law.driver;
        let before = self.model.nodes.len();
        self.lower_chain(at, (&law, pair), spec, &parameters);
        self.state_positions(before, driver, &spec.position);
    }

    /// Notes what the scene states of the law of the nodes added since there were so many.
    fn state_positions(&mut self, before: usize, driver: NodeIndex, position: &PositionSpec) {
        let stated = Arc::new(StatedPosition::new(position));
        for (node, added) in self.model.nodes.iter().enumerate().skip(before) {
            if added.motion.law().is_some_and(|law| law.driver == driver) {
                self.model.stated.positions.insert(node, stated.clone());
            }
        }
    }

    fn lower_chain(
        &mut self,
        at: &Place,
        (law, pair): (&Law, Pair),
        spec: &ChainSpec,
        parameters: &ChainParameters,
    ) {
        let driver = law.driver;
        if let BodySpec::Modes {
            inertia,
            stiffness,
            damping_capacity,
            modes,
            ref split,
        } = spec.body
        {
            let body = Modal {
                inertia,
                stiffness,
                damping_capacity,
                modes,
                split,
            };
            stop::check(at, spec, &self.indices, &mut self.faults);
            let object = ModalLowering {
                into: self,
                at,
                law,
                spec,
                pair,
                body,
            };
            return object.lower_to_nodes();
        }
        let nodes = match (&spec.body, &spec.pair.contact) {
            (_, Some(contact)) => self.touching(at, law, &spec.body, parameters, (pair, *contact)),
            (BodySpec::Rigid { inertia }, None) => {
                vec![self.rigid(at, law.clone(), *inertia, pair)]
            }
            _ => self.masses(at, law, parameters, pair),
        };
        driven_end::check(at, spec, &mut self.faults);
        let end = match spec.has_driven_end() {
            true => Some(self.driven_end(at, law, parameters.driven_end).1),
            false => None,
        };
        for load in &spec.loads {
            self.load(at, load, &loaded(load, &nodes, end), driver);
        }
        self.stops(at, spec, &nodes);
    }

    /// The law that the driver asks for.
    fn law_of(
        &mut self,
        at: &Place,
        input: Option<&InputConnection>,
        spec: &ChainSpec,
    ) -> Option<Law> {
        if !spec.lever.is_finite() || spec.lever == 0.0 {
            let message = format!("{} is no lever", spec.lever);
            let hint = "give a number other than zero";
            let property = match spec.coordinate {
                Coordinate::Turning => "lever_ratio",
                Coordinate::Sliding => "lever_arm",
            };
            self.fault(at, property, message, hint);
        }
        match Position::new(&spec.position) {
            Ok(position) => self.law(at, "position", input?, position, spec.lever),
            Err(faults) => {
                self.faults(at, "position", faults);
                None
            }
        }
    }

    fn pair(&mut self, at: &Place, spec: &ChainSpec) -> Pair {
        let PairSpec {
            closure,
            gap,
            opens,
            form,
            contact,
        } = spec.pair;
        self.faults.not_negative(&at.path("pair.gap"), gap);
        if gap > 0.0 && matches!(spec.body, BodySpec::Rigid { .. }) && contact.is_none() {
            let message = "a rigid object cannot have a gap: nothing would hold it in between";
            let hint = "give it at least one mass, or no gap";
            self.fault(at, "pair.gap", message, hint);
        }
        if gap > 0.0 && closure != Closure::Form {
            let message = "only a form-closed pair has a gap";
            self.fault(at, "pair.gap", message, "set `closure` to `form`");
        }
        if opens != 1.0 && opens != -1.0 {
            let message = format!("{opens} is no side");
            self.fault(at, "pair.opens", message, "give + or -");
        }
        if let Some(loss @ Loss::Factor(kappa)) = form.loss() {
            let key = law_of_link(loss).key;
            let path = at.path(&format!("pair.law.{key}.kappa"));
            self.faults.not_negative(&path, kappa);
        }
        if let Some(contact) = contact {
            contact::check(at, spec, &contact, &mut self.faults);
        }
        Pair {
            closure,
            gap,
            opens,
            form,
        }
    }
}

#[cfg(test)]
#[path = "chain_tests.rs"]
mod tests;
