//! Is the reference itself wrong? Two methods that agree with each other at several
//! settings, and not with the reference, are the better witnesses.
//!
//! The exact method shares nothing with the integrators, so that it is a good reference,
//! and one whose errors no integrator repeats. The same question is asked of a reference that
//! is a pair of methods: another pair may be nearer to each other.

use super::attempt::Attempt;
use super::setting::Setting;
use crate::dynamics::integrate::Method;
use crate::units::shown;
use serde::Serialize;

/// Two methods agree when their deviations differ by no more than this share.
pub const AGREE: f64 = 1e-3;

/// So many of the finest settings of each method are compared.
const SETTINGS: usize = 3;

/// Fewer settings of a method show no agreement.
const FEWEST: usize = 2;

/// The reference is so many times farther away than the two methods are from each other.
const FAR: f64 = 10.0;

/// No doubt comes from a distance below this.
const LEAST: f64 = 1e-9;

/// Doubt about a reference: two methods agree with each other and not with it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Doubt {
    /// The reference, with its setting.
    pub reference: String,
    /// The two methods.
    pub methods: [Method; 2],
    /// Settings of each that were compared.
    pub settings: usize,
    /// Greatest distance between the two methods, over all these settings.
    pub between: f64,
    /// Least distance from the reference, over all these settings.
    pub from_reference: f64,
}

impl Doubt {
    /// Doubt as a sentence.
    pub fn sentence(&self) -> String {
        let [one, other] = self.methods;
        format!(
            "the reference {} is in doubt: {one} and {other} agree to {} at their {} finest \
             settings, and differ from it by {}",
            self.reference,
            shown(self.between, 2),
            self.settings,
            shown(self.from_reference, 2)
        )
    }
}

/// A run that is compared.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Witness {
    pub(super) method: Method,
    pub(super) tolerance: Option<f64>,
}

impl Witness {
    pub(super) fn of(attempt: &Attempt) -> Option<Self> {
        attempt.has_ended_well().then_some(Self {
            method: attempt.method,
            tolerance: match attempt.setting {
                Setting::Tolerance(tolerance) => Some(tolerance),
                Setting::Step(_) | Setting::Exact => None,
            },
        })
    }
}

/// Doubt about the reference of this index: of all pairs of other methods the one that is
/// nearest to each other. Runs of a method stand together, the coarsest first; `None` among
/// them: the run did not end well. `distance` is relative to the size of the motion;
/// what is below `resolution` cannot be told from nothing.
pub(super) fn doubt_about_reference(
    witnesses: &[Option<Witness>],
    reference: (usize, &str),
    resolution: f64,
    distance: impl Fn(usize, usize) -> Option<f64>,
) -> Option<Doubt> {
    let (index, name) = reference;
    let own = witnesses.get(index)?.as_ref()?.method;
    let finest = finest(witnesses, own);
    let mut best: Option<Doubt> = None;
    for (k, one) in finest.iter().enumerate() {
        for other in &finest[k + 1..] {
            let Some(found) = compare(witnesses, (index, name), [one, other], &distance) else {
                continue;
            };
            let loosest = loosest(witnesses, one).max(loosest(witnesses, other));
            let near = found.between.max(resolution).max(loosest);
            let is_doubt = found.between <= AGREE && found.from_reference > FAR * near;
            let nearer = best
                .as_ref()
                .is_none_or(|best| found.between < best.between);
            if is_doubt && nearer && found.from_reference > LEAST {
                best = Some(found);
            }
        }
    }
    best
}

/// The finest settings of every method but one.
fn finest(witnesses: &[Option<Witness>], but: Method) -> Vec<Vec<usize>> {
    let mut methods: Vec<Vec<usize>> = Vec::new();
    let mut last = None;
    for (index, witness) in witnesses.iter().enumerate() {
        let Some(witness) = witness.as_ref().filter(|own| own.method != but) else {
            continue;
        };
        match methods.last_mut().filter(|_| last == Some(witness.method)) {
            Some(line) => line.push(index),
            None => methods.push(vec![index]),
        }
        last = Some(witness.method);
    }
    methods.retain(|line| line.len() >= FEWEST);
    for line in &mut methods {
        line.drain(..line.len().saturating_sub(SETTINGS));
    }
    methods
}

/// The coarsest tolerance of some runs; 0 of those without one.
fn loosest(witnesses: &[Option<Witness>], line: &[usize]) -> f64 {
    let own = line
        .iter()
        .filter_map(|&k| witnesses[k].as_ref()?.tolerance);
    own.fold(0.0, f64::max)
}

/// How far two methods are from each other at most, and from the reference at least.
fn compare(
    witnesses: &[Option<Witness>],
    (reference, name): (usize, &str),
    [one, other]: [&Vec<usize>; 2],
    distance: &impl Fn(usize, usize) -> Option<f64>,
) -> Option<Doubt> {
    let mut between = 0.0f64;
    for &a in one {
        for &b in other {
            between = between.max(distance(a, b)?);
        }
    }
    let mut from_reference = f64::INFINITY;
    for &k in one.iter().chain(other) {
        from_reference = from_reference.min(distance(k, reference)?);
    }
    let method = |line: &[usize]| Some(witnesses[*line.first()?].as_ref()?.method);
    Some(Doubt {
        reference: name.to_owned(),
        methods: [method(one)?, method(other)?],
        settings: one.len().min(other.len()),
        between,
        from_reference,
    })
}

#[cfg(test)]
#[path = "doubt_tests.rs"]
mod tests;
