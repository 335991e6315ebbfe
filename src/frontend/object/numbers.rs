//! Single numbers of an object set in place, for studies that change them
//! thousands of times.
//!
//! Only numbers that change no law of motion and on which nothing else of the
//! object hangs: inertia, stiffness and damping capacity of a body, and constant
//! loads. Everything else is read with the object.

use super::Object;
use super::body;
use super::spec::{BodySpec, ChainSpec, LoadLawSpec};
use crate::frontend::read::Node;

/// What else may say inertia, stiffness or damping of a body.
const OTHERS: [&str; 5] = ["geometry", "inertias", "stiffnesses", "dampings", "damping"];

/// Sets a number in SI units: `property` is its address within the object,
/// `written` the object's text with the number in it. False: the object must be
/// read, which says what is wrong, if anything is.
pub(crate) fn set(object: &mut dyn Object, written: &Node, property: &str, value: f64) -> bool {
    let Some(chain) = object.chain_mut().filter(|_| value.is_finite()) else {
        return false;
    };
    let load = property.strip_prefix("loads.");
    match load.and_then(|load| load.strip_suffix(".constant")) {
        Some(load) => set_load(chain, load, value),
        None => {
            let plain = OTHERS.iter().all(|name| written.get(name).is_none());
            plain && set_body(&mut chain.body, property, value)
        }
    }
}

fn set_load(chain: &mut ChainSpec, name: &str, value: f64) -> bool {
    let load = chain.loads.iter_mut().find(|load| load.name == name);
    match load.map(|load| &mut load.law) {
        Some(LoadLawSpec::Constant(force)) => {
            *force = value;
            true
        }
        _ => false,
    }
}

fn set_body(body: &mut BodySpec, property: &str, value: f64) -> bool {
    // Whether zero is allowed: a massless object is rigid.
    let (place, zero) = match (&mut *body, property) {
        (BodySpec::Rigid { inertia }, "inertia") => (inertia, true),
        (BodySpec::Uniform { inertia, .. } | BodySpec::Modes { inertia, .. }, "inertia") => {
            (inertia, false)
        }
        (BodySpec::Uniform { stiffness, .. } | BodySpec::Modes { stiffness, .. }, "stiffness") => {
            (stiffness, false)
        }
        (
            BodySpec::Uniform {
                damping_capacity, ..
            }
            | BodySpec::Modes {
                damping_capacity, ..
            },
            "damping_capacity",
        ) => (damping_capacity, true),
        _ => return false,
    };
    if value < 0.0 || (value == 0.0 && !zero) {
        return false;
    }
    *place = value;
    // What is not sound is refused by the reading, which follows.
    body::is_sound(body)
}
