//! Contact elements between a law and what follows it.
//!
//! A contact (`pair.contact`) is lowered to one of the three forms that [`ContactElement`] lists.
//! Static flexibility has the contact in series.

use super::spec::{BodySpec, ChainSpec, ContactSpec};
use super::{ChainParameters, ModelBuilder, Place};
use crate::dynamics::laws::contact::keys;
use crate::dynamics::model::{
    Closure, ContactElement, ContactForm, ContactPartner, Law, Link, LinkBase, Node, NodeIndex,
    NodeMotion, Pair,
};
use crate::fault::Faults;
use crate::kinematics::cam::{CamGeometry, DiscCam};
use crate::kinematics::position::Position;
use std::sync::Arc;

/// What stands against static flexibility behind a contact, of these laws.
pub(crate) const STATIC_BEHIND_A_CURVE: &str = "static flexibility is that of the object and of its \
     contact in series, which needs a contact force proportional to the indentation";

/// What to give in its place.
pub(crate) fn instead_of_static() -> String {
    let laws = keys(|law| law.is_linear(), "`", "or");
    format!("the contact law {laws}, or `modes` in place of `flexibility`")
}

/// The faults of a contact element's numbers, and of what it stands in front of.
pub(super) fn check(at: &Place, spec: &ChainSpec, contact: &ContactSpec, faults: &mut Faults) {
    check_numbers(at, "pair.contact", contact, faults);
    if !spec.pair.form.is_linear() {
        let message = "a contact element has a law of its own";
        let hint = "remove `pair.law`, or `pair.contact`";
        faults.add(at.path("pair.law"), message, hint);
    }
    if spec.pair.closure == Closure::Bilateral && !contact.law.declaration().is_linear() {
        let laws = keys(|law| law.is_linear(), "", "and");
        let message = format!("a bilateral pair takes the contact laws {laws} alone");
        let hint = "give one of them, or another closure";
        faults.add(at.path("pair.contact.law"), message, hint);
    }
    let rigid = matches!(spec.body, BodySpec::Rigid { .. });
    if contact.law.is_rigid() && !rigid {
        let message = "before an elastic object an impact would set a single fragment going, \
                       the more lightly the more masses there are";
        let hint = "give `masses: 0`, or the contact a stiffness";
        faults.add(at.path("pair.contact.restitution"), message, hint);
    }
    if contact.law.is_rigid() && spec.pair.closure == Closure::Form && spec.pair.gap == 0.0 {
        let message = "without a gap a rigid contact never separates, and there are no impacts";
        let hint = "give a gap, or the closure bilateral without a contact";
        faults.add(at.path("pair.contact.restitution"), message, hint);
    }
    if let BodySpec::Rigid { inertia } = spec.body
        && inertia <= 0.0
    {
        let message = "a body on a contact element needs an inertia: nothing else carries it";
        faults.add(
            at.path("inertia"),
            message,
            "give an inertia greater than 0",
        );
    }
}

/// The faults of the numbers of a contact at a property.
pub(super) fn check_numbers(
    at: &Place,
    property: &str,
    contact: &ContactSpec,
    faults: &mut Faults,
) {
    let path = |name: &str| at.path(&format!("{property}.{name}"));
    if !contact.law.is_rigid() {
        faults.positive(&path("stiffness"), contact.stiffness);
    }
    for (parameter, value) in contact.law.parameters() {
        parameter.check(faults, &path(parameter.key), value);
    }
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

impl ModelBuilder {
    /// Tells how hard an object presses on its cam, as far as that can be built: what is
    /// wrong with it is told where cams are asked about.
    pub fn pressing(&mut self, at: &Place, spec: &ChainSpec, geometry: &CamGeometry) {
        let position = Position::new(&spec.position).ok();
        let cam = position.and_then(|position| DiscCam::new(&position, geometry).ok());
        let pressing = cam.and_then(|cam| ContactPartner::on_cam(cam, spec.lever));
        if let Some(part) = self.model.objects.get_mut(at.object) {
            part.pressing = pressing.map(Arc::new);
        }
    }

    /// Tells how hard a part presses on what it touches, where the geometry is known.
    pub(super) fn add_contact_pressure(&mut self, part: usize, contact: &ContactSpec) {
        if let Some(part) = self.model.objects.get_mut(part) {
            let pressing = contact.pressure.map(ContactPartner::Fixed);
            part.pressing = pressing.map(Arc::new);
        }
    }

    /// An object behind a contact element: a rigid body on it, or a chain of which link 1
    /// is a plain fragment.
    pub(super) fn touching(
        &mut self,
        at: &Place,
        law: &Law,
        body: &BodySpec,
        parameters: &ChainParameters,
        (pair, contact): (Pair, ContactSpec),
    ) -> Vec<NodeIndex> {
        self.add_contact_pressure(at.object, &contact);
        let stiffness = contact.stiffness;
        let plain = |compliance| Pair {
            form: contact.law.of_link(compliance).0,
            ..pair
        };
        let (parameters, pair) = match body {
            BodySpec::Rigid { inertia } => {
                let alone = ChainParameters {
                    driven_end: 0.0,
                    inertias: vec![*inertia],
                    stiffnesses: vec![stiffness],
                    dampings: vec![contact.law.of_link(0.0).1],
                };
                (alone, plain(0.0))
            }
            _ if parameters.dampings[0] == 0.0 && contact.law.is_lossless() => {
                let mut series = parameters.clone();
                let compliance = 1.0 / parameters.stiffnesses[0];
                series.stiffnesses[0] = match contact.law.form() {
                    ContactForm::Proportional(_) => 1.0 / (compliance + 1.0 / stiffness),
                    ContactForm::Power { .. } | ContactForm::Rigid { .. } => stiffness,
                };
                (series, plain(compliance))
            }
            _ => return self.behind_point(at, law, parameters, (plain(0.0), contact)),
        };
        let nodes = self.masses(at, law, &parameters, pair);
        let object = &mut self.model.objects[at.object];
        object.contact = Some(ContactElement {
            law: contact.law,
            stiffness,
            link: object.links[0],
            point: None,
        });
        nodes
    }

    /// A massless point on the contact, and the whole chain behind it.
    fn behind_point(
        &mut self,
        at: &Place,
        law: &Law,
        parameters: &ChainParameters,
        (pair, contact): (Pair, ContactSpec),
    ) -> Vec<NodeIndex> {
        let rate_dependent = !contact.law.form().is_linear();
        if parameters.dampings[0] == 0.0 && rate_dependent {
            let message = "behind a contact that loses energy by its indentation, an elastic \
                           object without damping leaves the speed of the contact undetermined \
                           where it first touches";
            let hint = "give the object a damping_capacity above 0, the contact the law \
                        kelvin_voigt or no dissipation, or the object masses: 0";
            self.fault(at, "pair.contact.dissipation", message, hint);
        }
        let motion = NodeMotion::Mass { law: law.clone() };
        let point = self.add_point(
            at,
            law,
            Node {
                inertia: 0.0,
                motion,
            },
        );
        self.model.links.push(Link {
            mass: point,
            base: LinkBase::Law { pair },
            stiffness: contact.stiffness,
            damping: contact.law.of_link(0.0).1,
        });
        self.model.objects[at.object].contact = Some(ContactElement {
            law: contact.law,
            stiffness: contact.stiffness,
            link: self.model.links.len() - 1,
            point: Some(point),
        });
        self.masses_on(at, law, parameters, LinkBase::Mass(point))
    }
}
