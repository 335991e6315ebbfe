//! Elastic objects reduced to their lowest vibration modes.
//!
//! What the scene calls one object becomes one oscillator a mode behind its law, the
//! inertia of the modes that are left out at the driven end, and a massless output that
//! sums them ([`continuum`](super::continuum)). What those modes do under slow forces is
//! read off the acceleration of the driven end where that is known and nothing else
//! depends on it; otherwise it is one more oscillator.
//!
//! Each mode is an inner part `rocker.mode_1`; the output is a constraint with several drivers.
//! The residual flexibility is read off the acceleration of the driven end (`system::reduced`)
//! if that is prescribed and continuous, nothing is driven by the output, and all loads are
//! constant. Otherwise it is the oscillator `rocker.residual`. Without modes the object is
//! rigid with an elastic output (`flexibility: "static"`).
//!
//! Limits: without a contact element, behind a closing force, the output carries the pair as
//! that of a rigid object does. The pair is taken to stay closed; the least force that this
//! needs is its margin.

use super::continuum::{Continuum, Oscillator, Reduction};
use super::spec::{ChainSpec, ContactSpec, InertiaSplit, LoadLawSpec, LoadSpec, MassChoice};
use super::{ChainParameters, FREE_FALL, ModelBuilder, Place};
use crate::dynamics::model::{Closure, Law, MODE, NodeIndex, ObjectPart, Pair, PartInput, Reduced};
use std::f64::consts::TAU;

/// A uniform elastic object and how many of its modes are kept.
#[derive(Clone, Copy, Debug)]
pub(super) struct Modal<'s> {
    pub(super) inertia: f64,
    pub(super) stiffness: f64,
    pub(super) damping_capacity: f64,
    pub(super) modes: usize,
    pub(super) split: &'s InertiaSplit,
}

impl Modal<'_> {
    /// The damping time τ = b/c.
    pub(super) fn delay(&self) -> f64 {
        self.damping_capacity / (TAU * (self.stiffness / self.inertia).sqrt())
    }

    /// The property that asks for it.
    fn property(&self) -> &'static str {
        match self.modes {
            0 => "flexibility",
            _ => "modes",
        }
    }
}

/// What the modes that are left out do under slow forces, in units of the object.
struct Rest {
    /// ρ_W.
    under_force: f64,
    /// ρ_J.
    under_acceleration: f64,
    /// How far the output gives way to constant loads.
    offset: f64,
}

impl Rest {
    fn of(reduction: &Reduction, body: Modal<'_>) -> Self {
        Self {
            under_force: reduction.under_force / body.stiffness,
            under_acceleration: reduction.under_acceleration * body.inertia / body.stiffness,
            offset: 0.0,
        }
    }

    /// With a contact in series, at the driven end.
    fn in_series_with(mut self, contact: Option<ContactSpec>, body: Modal<'_>) -> Self {
        if let Some(contact) = contact {
            self.under_force += 1.0 / contact.stiffness;
            self.under_acceleration += body.inertia / contact.stiffness;
        }
        self
    }

    /// Adds a load, of which `constant` is the force at the output.
    fn add_load(&mut self, load: &LoadSpec, constant: f64) {
        self.offset += match load.law {
            // Gravity is an acceleration of the whole.
            LoadLawSpec::Weight { inclination } => {
                -self.under_acceleration * FREE_FALL * inclination.sin()
            }
            _ => self.under_force * constant,
        };
    }
}

/// Shares of a force at the output that inner nodes get.
pub(super) type Shares = Vec<(NodeIndex, f64)>;

impl ModelBuilder {
    /// Lowers an object that is reduced to modes behind its law.
    pub(super) fn modal(
        &mut self,
        at: &Place,
        law: &Law,
        (spec, pair): (&ChainSpec, Pair),
        body: Modal<'_>,
    ) {
        let Some(continuum) = self.check_modal(at, spec, body) else {
            return;
        };
        let contact = spec.pair.contact;
        if let Some(contact) = contact.filter(|_| body.modes > 0) {
            return self.free_modes(at, law, (spec, pair, contact), (body, continuum));
        }
        let still = !self.followed.contains(&at.id)
            && spec.loads.iter().all(is_constant)
            && self.is_smooth(law);
        let reduction = continuum.reduce(body.modes);
        if body.modes == 0 {
            return self.static_flexibility(at, law, (spec, pair), (body, &reduction), still);
        }
        let (residual, reduction) = match still {
            true => (None, reduction),
            false => (Some(body.modes), reduction.with_residual()),
        };
        let mut inputs = Vec::new();
        let mut shares: Shares = Vec::new();
        for (number, mode) in reduction.oscillators.iter().enumerate() {
            let name = match residual {
                Some(last) if last == number => "residual".to_owned(),
                _ => format!("mode_{}", number + 1),
            };
            let part = self.add_part(at, &name, MODE);
            let place = Place {
                id: at.path(&name),
                object: part,
                inputs: Vec::new(),
            };
            let nodes = self.masses(&place, law, &parameters(body, mode), Pair::default());
            inputs.push((name, part));
            shares.extend(nodes.first().map(|&node| (node, mode.share)));
        }
        let (part, end) = self.driven_end(at, law, reduction.driven_end * body.inertia);
        let rest = 1.0 - shares.iter().map(|(_, share)| share).sum::<f64>();
        inputs.push((crate::dynamics::model::DRIVEN_END.to_owned(), part));
        let modes = shares.clone();
        shares.push((end, rest));
        let Some(output) = self.summed(at, &shares, pair) else {
            return;
        };
        let input = |(port, driver): (String, usize)| PartInput { port, driver };
        self.model.objects[at.object].inputs = inputs.into_iter().map(input).collect();
        let mut rest = Rest::of(&reduction, body);
        for load in &spec.loads {
            let constant = self.modal_load(at, load, &shares, output, law.driver);
            rest.add_load(load, constant);
        }
        self.model.reduced.push(Reduced {
            object: at.object,
            modes,
            output: None,
            under_acceleration: rest.under_acceleration,
            offset: rest.offset,
        });
    }

    /// An object without vibrations: a rigid one whose output gives way. `still`: its
    /// motion and its loads are known beforehand, and nothing else hangs on its output.
    fn static_flexibility(
        &mut self,
        at: &Place,
        law: &Law,
        (spec, pair): (&ChainSpec, Pair),
        (body, reduction): (Modal<'_>, &Reduction),
        still: bool,
    ) {
        if !still {
            let message = "static flexibility needs a motion that is known beforehand with a \
                           continuous acceleration, behind prescribed drives and rigid objects, \
                           constant loads, and no object that hangs on this one";
            let hint = "give `modes`, or `masses`";
            return self.fault(at, "flexibility", message, hint);
        }
        let node = self.rigid(at, law.clone(), body.inertia, pair);
        self.model.objects[at.object].driven_end = Some(node);
        let mut rest = Rest::of(reduction, body).in_series_with(spec.pair.contact, body);
        for load in &spec.loads {
            self.load(at, load, &[node], law.driver);
            let constant = match load.law {
                LoadLawSpec::Constant(force) => force,
                _ => 0.0,
            };
            rest.add_load(load, constant);
        }
        self.model.reduced.push(Reduced {
            object: at.object,
            modes: Vec::new(),
            output: None,
            under_acceleration: rest.under_acceleration,
            offset: rest.offset,
        });
    }

    /// What stands against modes; the continuum otherwise.
    fn check_modal(&mut self, at: &Place, spec: &ChainSpec, body: Modal<'_>) -> Option<Continuum> {
        let before = self.faults.len();
        self.faults.positive(&at.path("inertia"), body.inertia);
        self.faults.positive(&at.path("stiffness"), body.stiffness);
        let path = at.path("damping_capacity");
        self.faults.not_negative(&path, body.damping_capacity);
        let held = spec.pair.contact.is_none() || body.modes == 0;
        if held && spec.pair.closure == Closure::Form {
            let message = "modes without a contact element need a pair that stays closed: they are \
                           those of the object held at its driven end";
            let hint = "give `masses`, or closure `bilateral` or `force`";
            self.fault(at, body.property(), message, hint);
        }
        if body.modes == 0 {
            self.check_static_contact(at, spec);
        }
        for load in &spec.loads {
            let weight = matches!(load.law, LoadLawSpec::Weight { .. });
            let wanted = match weight {
                true => MassChoice::All,
                false => MassChoice::Last,
            };
            if load.mass != wanted {
                let message = "an object of modes has no masses: weights act on all of it, other \
                               loads on its output";
                let hint = "leave `mass` out, or give `masses` in place of `modes`";
                self.fault(at, &format!("loads.{}.mass", load.name), message, hint);
            }
        }
        let continuum = Continuum::of(body.split);
        if continuum.is_none() {
            let message = "shares of one's own are no continuum that has modes";
            let hint = "give the split `equal` or `cubes`";
            self.fault(at, body.property(), message, hint);
        }
        continuum.filter(|_| self.faults.len() == before)
    }

    /// A part of an object, driven as the object is.
    pub(super) fn add_part(&mut self, at: &Place, name: &str, kind: &'static str) -> usize {
        let own = &self.model.objects[at.object];
        let part = ObjectPart {
            id: at.path(name),
            kind,
            coordinate: own.coordinate,
            inputs: own.inputs.clone(),
            combination: own.combination,
            ..ObjectPart::default()
        };
        let index = self.model.objects.len();
        self.indices.insert(part.id.clone(), index);
        self.model.objects.push(part);
        index
    }
}

fn is_constant(load: &LoadSpec) -> bool {
    matches!(
        load.law,
        LoadLawSpec::Constant(_) | LoadLawSpec::Weight { .. }
    )
}

/// The one mass of an oscillator, its stiffness and its damping, b = τ·c.
fn parameters(body: Modal<'_>, mode: &Oscillator) -> ChainParameters {
    let square = mode.frequency * mode.frequency;
    let stiffness = mode.inertia * square * body.stiffness;
    ChainParameters {
        inertias: vec![mode.inertia * body.inertia],
        stiffnesses: vec![stiffness],
        dampings: vec![body.delay() * stiffness],
        driven_end: 0.0,
    }
}
