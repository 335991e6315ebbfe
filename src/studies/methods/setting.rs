//! What each method is asked: a ladder of tolerances, or of steps.

use super::stability::Spectrum;
use crate::dynamics::integrate::Method;
use crate::units::shown;
use serde::Serialize;

/// Rungs of a ladder of steps, each half the one before.
const STEP_RUNGS: i32 = 12;

/// The first step of a ladder in shares of the stable one: the ladder begins
/// where the method fails.
const BEYOND: f64 = 1.7;

/// Least number of steps of the first rung, where stability bounds nothing.
const FEWEST: f64 = 8.0;

/// Setting of a method: how closely it is asked to follow the motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Setting {
    /// Error wanted, relative to the scales of the state.
    Tolerance(f64),
    /// Fixed step (s).
    Step(f64),
    /// Nothing to set: the method has no truncation error.
    Exact,
}

impl Setting {
    /// The tolerance, if that is what is set.
    pub fn tolerance(self) -> Option<f64> {
        match self {
            Self::Tolerance(tolerance) => Some(tolerance),
            _ => None,
        }
    }

    /// The step (s), if that is what is set.
    pub fn step(self) -> Option<f64> {
        match self {
            Self::Step(step) => Some(step),
            _ => None,
        }
    }
}

impl std::fmt::Display for Setting {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Tolerance(tolerance) => {
                write!(f, "tolerance {tolerance}", tolerance = shown(*tolerance, 1))
            }
            Self::Step(step) => write!(f, "step {step} s", step = shown(*step, 3)),
            Self::Exact => f.write_str("no setting"),
        }
    }
}

/// True for methods that take the same step throughout.
pub fn is_fixed_step(method: Method) -> bool {
    method == Method::Rk4
}

/// True for propagation without truncation error.
pub fn is_exact(method: Method) -> bool {
    method == Method::Exact
}

/// All methods, in the order they are presented.
pub fn all_methods() -> Vec<Method> {
    let integrators = Method::ALL.into_iter();
    let integrators = integrators.filter(|&method| !is_exact(method));
    std::iter::once(Method::Exact).chain(integrators).collect()
}

/// The settings a method is tried at, the coarsest first. `steps`: given by the
/// user; otherwise from just beyond the greatest stable step downwards.
pub(super) fn ladder(
    method: Method,
    tolerances: &[f64],
    steps: Option<&[f64]>,
    spectrum: &Spectrum,
    duration: f64,
) -> Vec<Setting> {
    if is_exact(method) {
        return vec![Setting::Exact];
    }
    if !is_fixed_step(method) {
        return tolerances.iter().copied().map(Setting::Tolerance).collect();
    }
    if let Some(steps) = steps {
        return steps.iter().copied().map(Setting::Step).collect();
    }
    let first = first_step(method, spectrum, duration);
    (0..STEP_RUNGS)
        .map(|rung| Setting::Step(first * 0.5f64.powi(rung)))
        .collect()
}

/// A step just beyond the stable one, or an eighth of the run (s).
pub(super) fn first_step(method: Method, spectrum: &Spectrum, duration: f64) -> f64 {
    let stable = spectrum.bound(method).map(|bound| bound.step());
    let about = stable.or((spectrum.fastest > 0.0).then(|| 2.0 / spectrum.fastest));
    let beyond = about.map_or(f64::INFINITY, |step| BEYOND * step);
    beyond.min(duration / FEWEST)
}
