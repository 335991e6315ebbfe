//! The choice of a method, with its reason.

use super::settings::RunSettings;
use crate::dynamics::integrate::{Cause, Change, Method, MethodChoice, Reserve};
use crate::exact::{Parts, Rest};
use crate::units::shown;

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
    /// What goes on where it cannot.
    pub(super) reserve: Vec<Reserve>,
    /// Parts that are propagated exactly, when any are.
    pub(super) parts: Option<Parts>,
    /// Rest that is integrated beside them by the method.
    pub(super) rest: Option<Rest>,
}

impl Choice {
    /// One method for everything.
    pub(super) fn one_method(chosen: MethodChoice) -> Self {
        Self {
            method: chosen.method,
            tolerance: chosen.tolerance,
            name: chosen.method.name().to_owned(),
            why: chosen.why,
            reserve: chosen.reserve,
            parts: None,
            rest: None,
        }
    }

    /// Adds the changes of the method that were made on the way.
    pub(super) fn describe_changes(&mut self, changes: &[Change]) {
        for change in changes {
            let Change { time, from, to, .. } = change;
            let time = shown(*time, 6);
            let cause = match change.cause {
                Cause::Stiff => format!("the motion had become stiff for {from}"),
                Cause::GaveUp => format!("{from} came no further"),
                Cause::Floor => {
                    format!("the step of {from} had fallen below the clock's resolution")
                }
            };
            self.name = format!("{}, then {to}", self.name);
            self.why = format!("{}; {to} from t = {time} s on, as {cause}", self.why);
        }
    }

    /// One method with the tolerance of the scene.
    pub(super) fn single_method(method: Method, settings: &RunSettings, why: &str) -> Self {
        Self::one_method(single_method(method, settings, why))
    }

    /// Exact propagation of everything.
    pub(super) fn exact(parts: Parts, settings: &RunSettings, why: &str) -> Self {
        Self {
            parts: Some(parts),
            ..Self::single_method(Method::Exact, settings, why)
        }
    }
}

/// A method with the tolerance of the scene.
pub(super) fn single_method(method: Method, settings: &RunSettings, why: &str) -> MethodChoice {
    MethodChoice {
        method,
        tolerance: settings.tolerance,
        why: why.to_owned(),
        reserve: Vec::new(),
    }
}
