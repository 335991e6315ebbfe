//! Which method a run takes, and why.

use super::settings::RunSettings;
use crate::integrate::{Dynamics, Method};
use crate::system::System;

/// The method of a run.
pub(super) struct Choice {
    /// The method.
    pub(super) method: Method,
    /// Its name in the figures.
    pub(super) name: &'static str,
    /// Why this one.
    pub(super) why: String,
}

/// The method asked for, or the one that suits the system.
pub(super) fn choose_method(system: &System, settings: &RunSettings) -> Choice {
    if system.coordinates() == 0 {
        return Choice {
            method: Method::Dop853,
            name: "kinematic",
            why: "nothing is elastic: the motion follows from the drives".to_owned(),
        };
    }
    let (method, why) = match settings.method {
        Some(method) => (method, "asked for".to_owned()),
        None => (Method::Dop853, "the default, of order 8".to_owned()),
    };
    Choice {
        method,
        name: method.name(),
        why,
    }
}
