//! Objects that are reduced to vibration modes behind a contact element: there they are free
//! ([`free_body`](super::free_body)).
//!
//! What the scene calls one object becomes a chain of masses that moves at the contact as the
//! free object does, and an inner part, `rocker.output`, that sums the masses' motions to
//! that of the output. Static flexibility is that of the object and of the contact in series.
//!
//! It is a chain on a contact as any other, with its point, events, statics and closed forms.
//! Its masses are no places on the object. Loads and followers act on the sum
//! (`Reduced::output`), and motion and deviation are read from it; in `exact` the deviation is
//! the same sum (`TreeObject::output`).

use super::continuum::Continuum;
use super::modes::{Modal, Shares};
use super::spec::{ChainSpec, ContactSpec};
use super::{ChainParameters, ModelBuilder, Place};
use crate::dynamics::laws::contact::keys;
use crate::dynamics::model::{Law, NodeIndex, Pair, PartInput, Reduced, SUM};

/// What stands against static flexibility behind a contact, of these laws.
pub(crate) const STATIC_BEHIND_A_CURVE: &str = "static flexibility is that of the object and of its \
     contact in series, which needs a contact force proportional to the indentation";

/// What to give in its place.
pub(crate) fn instead_of_static() -> String {
    let laws = keys(|law| law.is_linear(), "`", "or");
    format!("the contact law {laws}, or `modes` in place of `flexibility`")
}

impl ModelBuilder {
    /// Lowers an object that is reduced to its free modes behind a contact element.
    pub(super) fn free_modes(
        &mut self,
        at: &Place,
        law: &Law,
        (spec, pair, contact): (&ChainSpec, Pair, ContactSpec),
        (body, continuum): (Modal<'_>, Continuum),
    ) {
        let free = continuum.free(body.modes);
        let delay = body.delay();
        let stiffnesses = free.stiffnesses.iter().map(|share| share * body.stiffness);
        let stiffnesses: Vec<f64> = stiffnesses.collect();
        let parameters = ChainParameters {
            inertias: (free.inertias.iter().map(|share| share * body.inertia)).collect(),
            dampings: stiffnesses.iter().map(|c| delay * c).collect(),
            stiffnesses,
            driven_end: 0.0,
        };
        let masses = self.touching(at, law, &spec.body, &parameters, (pair, contact));
        let shares: Shares = masses.into_iter().zip(free.shares).collect();
        let Some(output) = self.output_of_masses(at, &shares) else {
            return;
        };
        for load in &spec.loads {
            self.modal_load(at, load, &shares, output, law.driver);
        }
        self.model.reduced.push(Reduced {
            object: at.object,
            modes: shares,
            output: Some(output),
            under_acceleration: 0.0,
            offset: 0.0,
        });
    }

    /// The inner part that the output of an object is, as the sum of its masses: what hangs on
    /// the object hangs on this.
    fn output_of_masses(&mut self, at: &Place, shares: &Shares) -> Option<NodeIndex> {
        let part = self.add_part(at, "output", SUM);
        let place = Place {
            id: at.path("output"),
            object: part,
            inputs: Vec::new(),
        };
        let output = self.summed(&place, shares, Pair::default())?;
        self.model.objects[part].inputs = PartInput::only(Some(at.object));
        self.outputs.insert(at.id.clone(), output);
        Some(output)
    }

    /// What stands against static flexibility behind a contact.
    pub(super) fn check_static_contact(&mut self, at: &Place, spec: &ChainSpec) {
        let law = spec.pair.contact.map(|contact| contact.law);
        if law.is_some_and(|law| !law.declaration().is_linear() && !law.is_rigid()) {
            self.fault(
                at,
                "flexibility",
                STATIC_BEHIND_A_CURVE,
                &instead_of_static(),
            );
        }
    }
}
