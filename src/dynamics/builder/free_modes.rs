//! Objects that are reduced to vibration modes behind a contact element: there they are free
//! ([`free_body`](super::free_body)).
//!
//! What the scene calls one object becomes a chain of masses that moves at the contact as the
//! free object does, and an inner part, `rocker.output`, that sums the masses' motions to
//! that of the output. Static flexibility is that of the object and of the contact in series.
//!
//! It is a chain on a contact as any other, with its point, events, statics and closed forms.
//! Its masses are no places on the object. Loads and followers act on the sum
//! (`ModalReduction::output`), and motion and deviation are read from it; in `exact` the deviation is
//! the same sum (`TreeObject::output`).

use super::continuum::Continuum;
use super::modal_output::{self, Shares};
use super::modes::ModalLowering;
use super::spec::ContactSpec;
use super::{ChainParameters, ModelBuilder, Place};
use crate::dynamics::model::{ModalReduction, NodeIndex, Pair, PartInput, SUM};

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
        let free = continuum.with_free_modes(body.modes);
        let delay = body.damping_time();
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
        into.model.reduced.push(ModalReduction {
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
    into.model.objects[part].inputs = PartInput::behind_one_driver(Some(at.object));
    into.outputs.insert(at.id.clone(), output);
    Some(output)
}
