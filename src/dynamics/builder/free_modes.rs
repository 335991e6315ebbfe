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
use super::modes::{ModalLowering, Shares};
use super::spec::{ChainSpec, ContactSpec};
use super::{ChainParameters, ModelBuilder, Place, modal_output};
use crate::dynamics::laws::contact::keys;
use crate::dynamics::model::{NodeIndex, Pair, PartInput, Reduced, SUM};
use crate::fault::Faults;

/// What stands against static flexibility behind a contact, of these laws.
pub(crate) const STATIC_BEHIND_A_CURVE: &str = "static flexibility is that of the object and of its \
     contact in series, which needs a contact force proportional to the indentation";

/// What to give in its place.
pub(crate) fn instead_of_static() -> String {
    let laws = keys(|law| law.is_linear(), "`", "or");
    format!("the contact law {laws}, or `modes` in place of `flexibility`")
}

impl ModalLowering<'_> {
    /// Lowers the object free of its driver, behind a contact element.
    pub(super) fn behind_contact(self, contact: ContactSpec, continuum: Continuum) {
        let Self {
            into,
            at,
            law,
            spec,
            pair,
            body,
        } = self;
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
        let masses = into.touching(at, law, &spec.body, &parameters, (pair, contact));
        let shares: Shares = masses.into_iter().zip(free.shares).collect();
        let Some(output) = output_of_masses(into, at, &shares) else {
            return;
        };
        for load in &spec.loads {
            modal_output::load(into, at, load, &shares, [output, law.driver]);
        }
        into.model.reduced.push(Reduced {
            object: at.object,
            modes: shares,
            output: Some(output),
            under_acceleration: 0.0,
            offset: 0.0,
        });
    }
}

/// The inner part that the output of an object is, as the sum of its masses: what is driven by
/// the object is driven by this.
fn output_of_masses(into: &mut ModelBuilder, at: &Place, shares: &Shares) -> Option<NodeIndex> {
    let part = into.add_part(at, "output", SUM);
    let place = Place {
        id: at.path("output"),
        object: part,
        inputs: Vec::new(),
    };
    let output = modal_output::sum(into, &place, shares, Pair::default())?;
    into.model.objects[part].inputs = PartInput::only(Some(at.object));
    into.outputs.insert(at.id.clone(), output);
    Some(output)
}

/// The fault of static flexibility behind a contact.
pub(super) fn check_static(at: &Place, spec: &ChainSpec, faults: &mut Faults) {
    let law = spec.pair.contact.map(|contact| contact.law);
    if law.is_some_and(|law| !law.declaration().is_linear() && !law.is_rigid()) {
        faults.add(
            at.path("flexibility"),
            STATIC_BEHIND_A_CURVE,
            &instead_of_static(),
        );
    }
}
