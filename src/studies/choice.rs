//! The choice of a method, with its reason.

use super::settings::RunSettings;
use crate::dynamics::integrate::{Chosen, Method};
use crate::exact::{Parts, Rest};

/// The method of a run.
pub(super) struct Choice {
    /// The method.
    pub(super) method: Method,
    /// The tolerance it is given.
    pub(super) tolerance: f64,
    /// Name of the method in the figures.
    pub(super) name: String,
    /// Why this one.
    pub(super) why: String,
    /// Parts that are propagated exactly, when any are.
    pub(super) parts: Option<Parts>,
    /// Rest that is integrated beside them by the method.
    pub(super) rest: Option<Rest>,
}

impl Choice {
    /// One method for everything.
    pub(super) fn general(chosen: Chosen) -> Self {
        Self {
            method: chosen.method,
            tolerance: chosen.tolerance,
            name: chosen.method.name().to_owned(),
            why: chosen.why,
            parts: None,
            rest: None,
        }
    }

    /// One method with the tolerance of the scene.
    pub(super) fn plain(method: Method, settings: &RunSettings, why: &str) -> Self {
        Self::general(plain(method, settings, why))
    }

    /// Exact propagation of everything.
    pub(super) fn exact(parts: Parts, settings: &RunSettings, why: &str) -> Self {
        Self {
            parts: Some(parts),
            ..Self::plain(Method::Exact, settings, why)
        }
    }
}

/// A method with the tolerance of the scene.
pub(super) fn plain(method: Method, settings: &RunSettings, why: &str) -> Chosen {
    Chosen {
        method,
        tolerance: settings.tolerance,
        why: why.to_owned(),
    }
}
