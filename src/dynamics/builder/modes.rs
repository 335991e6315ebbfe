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
use super::modal_output::{self, Shares};
use super::smooth::is_smooth;
use super::spec::{ChainSpec, ContactSpec, InertiaSplit, LoadLawSpec, LoadSpec, MassChoice};
use super::{ChainParameters, FREE_FALL, ModelBuilder, Place, contact};
use crate::dynamics::model::{Closure, Law, MODE, ModalReduction, Pair, PartInput};
use crate::fault::Faults;
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
    pub(super) fn damping_time(&self) -> f64 {
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

    /// An object with these modes and this rest.
    fn reduction_to_modes(&self, object: usize, modes: Shares) -> ModalReduction {
        ModalReduction {
            object,
            modes,
            output: None,
            under_acceleration: self.under_acceleration,
            offset: self.offset,
        }
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

/// An object of modes that is lowered into a model.
pub(super) struct ModalLowering<'b> {
    pub(super) into: &'b mut ModelBuilder,
    pub(super) at: &'b Place,
    pub(super) law: &'b Law,
    pub(super) spec: &'b ChainSpec,
    pub(super) pair: Pair,
    pub(super) body: Modal<'b>,
}

impl ModalLowering<'_> {
    /// Lowers it behind its law.
    pub(super) fn lower_to_nodes(mut self) {
        let Some(continuum) = self.check() else {
            return;
        };
        match self.spec.pair.contact {
            Some(contact) if self.body.modes > 0 => self.behind_contact(contact, continuum),
            _ => self.lower_held(continuum),
        }
    }

    /// Lowers it held at its driven end.
    fn lower_held(self, continuum: Continuum) {
        // Its motion and its loads are known beforehand, and nothing is driven by it.
        let still = !self.into.followed.contains(&self.at.id)
            && self.spec.loads.iter().all(is_constant)
            && is_smooth(&self.into.model, self.law);
        let reduction = continuum.reduce(self.body.modes);
        match (self.body.modes, still) {
            (0, true) => self.static_flexibility(&reduction),
            (0, false) => {
                let message = "static flexibility needs a motion that is known beforehand with a \
                               continuous acceleration, behind prescribed drives and rigid \
                               objects, constant loads, and no object driven by this one";
                let hint = "give `modes`, or `masses`";
                self.into.fault(self.at, "flexibility", message, hint);
            }
            (_, true) => self.oscillators(&reduction, None),
            (last, false) => self.oscillators(&reduction.with_residual(), Some(last)),
        }
    }

    /// An oscillator a mode and an output that sums them. `residual`: the number of the one
    /// that stands for the modes that are left out.
    fn oscillators(self, reduction: &Reduction, residual: Option<usize>) {
        let Self {
            into,
            at,
            law,
            spec,
            pair,
            body,
        } = self;
        let mut inputs = Vec::new();
        let mut shares: Shares = Vec::new();
        for (number, mode) in reduction.oscillators.iter().enumerate() {
            let name = match residual {
                Some(last) if last == number => "residual".to_owned(),
                _ => format!("mode_{}", number + 1),
            };
            let part = into.add_part(at, &name, MODE);
            let place = Place {
                id: at.path(&name),
                object: part,
                inputs: Vec::new(),
            };
            let nodes = into.masses(&place, law, &parameters(body, mode), Pair::default());
            inputs.push((name, part));
            shares.extend(nodes.first().map(|&node| (node, mode.share)));
        }
        let (part, end) = into.driven_end(at, law, reduction.driven_end * body.inertia);
        let rest = 1.0 - shares.iter().map(|(_, share)| share).sum::<f64>();
        inputs.push((crate::dynamics::model::DRIVEN_END.to_owned(), part));
        let modes = shares.clone();
        shares.push((end, rest));
        let Some(output) = modal_output::sum(into, at, &shares, pair) else {
            return;
        };
        let input = |(port, driver): (String, usize)| PartInput { port, driver };
        into.model.objects[at.object].inputs = inputs.into_iter().map(input).collect();
        let mut rest = Rest::of(reduction, body);
        for load in &spec.loads {
            let ends = [output, law.driver];
            rest.add_load(load, modal_output::load(into, at, load, &shares, ends));
        }
        into.model
            .reduced
            .push(rest.reduction_to_modes(at.object, modes));
    }

    /// An object without vibrations: a rigid one whose output gives way.
    fn static_flexibility(self, reduction: &Reduction) {
        let Self {
            into,
            at,
            law,
            spec,
            pair,
            body,
        } = self;
        let node = into.rigid(at, law.clone(), body.inertia, pair);
        into.model.objects[at.object].driven_end = Some(node);
        let mut rest = Rest::of(reduction, body).in_series_with(spec.pair.contact, body);
        for load in &spec.loads {
            into.load(at, load, &[node], law.driver);
            let constant = match load.law {
                LoadLawSpec::Constant(force) => force,
                _ => 0.0,
            };
            rest.add_load(load, constant);
        }
        into.model
            .reduced
            .push(rest.reduction_to_modes(at.object, Vec::new()));
    }

    /// Its continuum; `None`: it has faults.
    fn check(&mut self) -> Option<Continuum> {
        let (at, spec, body) = (self.at, self.spec, self.body);
        let faults = &mut self.into.faults;
        let before = faults.len();
        faults.positive(&at.path("inertia"), body.inertia);
        faults.positive(&at.path("stiffness"), body.stiffness);
        faults.not_negative(&at.path("damping_capacity"), body.damping_capacity);
        let held = spec.pair.contact.is_none() || body.modes == 0;
        if held && spec.pair.closure == Closure::Form {
            let message = "modes without a contact element need a pair that stays closed: they are \
                           those of the object held at its driven end";
            let hint = "give `masses`, or closure `bilateral` or `force`";
            faults.add(at.path(body.property()), message, hint);
        }
        if body.modes == 0 {
            contact::check_static(at, spec, faults);
        }
        for load in &spec.loads {
            check_mass(at, load, faults);
        }
        let continuum = Continuum::of(body.split);
        if continuum.is_none() {
            let message = "shares of one's own are no continuum that has modes";
            let hint = "give the split `equal` or `cubes`";
            faults.add(at.path(body.property()), message, hint);
        }
        continuum.filter(|_| faults.len() == before)
    }
}

/// The fault of a load on a mass of an object that has none.
fn check_mass(at: &Place, load: &LoadSpec, faults: &mut Faults) {
    let weight = matches!(load.law, LoadLawSpec::Weight { .. });
    let wanted = match weight {
        true => MassChoice::All,
        false => MassChoice::Last,
    };
    if load.mass != wanted {
        let message = "an object of modes has no masses: weights act on all of it, other loads on \
                       its output";
        let hint = "leave `mass` out, or give `masses` in place of `modes`";
        faults.add(at.path(&format!("loads.{}.mass", load.name)), message, hint);
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
        dampings: vec![body.damping_time() * stiffness],
        driven_end: 0.0,
    }
}
