//! Greatest values that closed forms tell, seen a second time: each at its instant, in the
//! state of the system there.

use super::tally::{CLAIMS, Tally, read};
use super::{EquationCheck, Log, ObjectFigures, RunRecord, Stretch};
use crate::dynamics::model::{Link, LinkBase, Model, NodeMotion};
use crate::dynamics::segment::Signal;
use crate::dynamics::system::ObjectState;

/// Share of the greatest value of its kind in the whole run that any figure is known to.
const RESOLVED: f64 = 1e-5;

/// Roundings of a time at the ends of a stretch.
const EDGE: f64 = 64.0 * f64::EPSILON;

/// Roundings by which an acceleration that is left over from great forces may be off.
const LEFT_OVER: f64 = 32.0 * f64::EPSILON;

/// A greatest value that was seen again.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ConfirmedPeak {
    object: usize,
    signal: Signal,
    time: f64,
    told: f64,
    /// What the state shows.
    seen: f64,
}

impl Log<'_> {
    /// Looks again at the greatest values of an object that were met in a stretch.
    pub(crate) fn confirm(&mut self, object: usize, tally: &Tally, stretch: &mut Stretch<'_>) {
        if !self.confirms || self.failure().is_some() {
            return;
        }
        // (At the ends a law may be on either side of its break.)
        let [from, until] = stretch.span;
        let (from, until) = (from + EDGE * from.abs(), until - EDGE * until.abs());
        let mut looked: Option<(f64, ObjectState)> = None;
        for (place, claim) in tally.claims().into_iter().enumerate() {
            let Some(claim) = claim.filter(|claim| from < claim.time && claim.time < until) else {
                continue;
            };
            let place = object * CLAIMS + place;
            if self.confirmed[place].is_some_and(|own| own.time == claim.time) {
                continue;
            }
            let state = match looked {
                Some((time, state)) if time == claim.time => state,
                _ => {
                    stretch
                        .view_at(claim.time, &mut self.observer, &mut [])
                        .states[object]
                }
            };
            looked = Some((claim.time, state));
            self.confirmed[place] = Some(ConfirmedPeak {
                object,
                signal: claim.signal,
                time: claim.time,
                told: claim.value,
                seen: claim.of(read(claim.signal, &state)),
            });
        }
    }

    /// What was seen again of the greatest values that have stayed.
    pub(super) fn confirmed(&self, tallies: &[Tally]) -> Vec<ConfirmedPeak> {
        let mut found = Vec::new();
        for (tally, own) in tallies.iter().zip(self.confirmed.chunks(CLAIMS)) {
            for (claim, confirmed) in tally.claims().into_iter().zip(own) {
                if let (Some(claim), Some(confirmed)) = (claim, confirmed)
                    && claim.time == confirmed.time
                    && claim.value == confirmed.told
                {
                    found.push(*confirmed);
                }
            }
        }
        found
    }
}

#[cfg(test)]
impl ConfirmedPeak {
    /// The same where the state shows something else, by a share.
    pub(crate) fn with_share_of_error(mut self, share: f64) -> Self {
        self.seen *= 1.0 + share;
        self
    }
}

/// Puts greatest values to the test; `bound` is what is allowed as a share of them.
pub(crate) fn check_confirmed_peaks(
    check: &mut EquationCheck,
    recorded: &RunRecord,
    model: &Model,
    bound: f64,
) {
    for own in &recorded.confirmed {
        let figures = recorded.figures.iter();
        let kind = figures.map(|figures| greatest_value_of_kind(own.signal, figures));
        let size = own.told.abs().max(RESOLVED * kind.fold(0.0, f64::max));
        if size > 0.0 {
            let rounding = match own.signal {
                Signal::Acceleration => {
                    acceleration_rounding(model, own.object, &recorded.figures[own.object])
                }
                _ => 0.0,
            };
            let bound = bound + rounding / size;
            let (defect, id) = ((own.seen - own.told).abs(), &*model.objects[own.object].id);
            check.include(defect / size, bound, (own.time, id), name(own.signal));
        }
    }
}

/// What rounding alone may change the acceleration of the last mass of an object by: it is what
/// the forces on it leave over, and those of its links are stiffnesses times displacements that
/// are rounded.
pub(crate) fn acceleration_rounding(model: &Model, object: usize, figures: &ObjectFigures) -> f64 {
    let Some(&node) = model.objects[object].nodes.last() else {
        return 0.0;
    };
    let own = &model.nodes[node];
    if !matches!(own.motion, NodeMotion::Mass { .. }) || own.inertia <= 0.0 {
        return 0.0;
    }
    let holds = |link: &&Link| match link.base {
        LinkBase::Mass(base) => link.mass == node || base == node,
        LinkBase::Law { .. } => link.mass == node,
    };
    let stiffness: f64 = model
        .links
        .iter()
        .filter(holds)
        .map(|one| one.stiffness)
        .sum();
    LEFT_OVER * (stiffness * figures.delta_abs + figures.peak_reaction) / own.inertia
}

/// The greatest value of the kind of a signal that figures of an object tell.
fn greatest_value_of_kind(signal: Signal, figures: &ObjectFigures) -> f64 {
    match signal {
        Signal::Deviation | Signal::Clearance | Signal::Indentation => {
            figures.end.displacement.abs().max(figures.delta_abs)
        }
        Signal::Speed => figures.peak_speed,
        Signal::Acceleration => figures.peak_acceleration,
        Signal::Reaction | Signal::ContactForce => figures.peak_reaction,
        Signal::Pressure => 0.0,
    }
}

fn name(signal: Signal) -> &'static str {
    match signal {
        Signal::Deviation => "greatest deviation",
        Signal::Speed => "greatest speed",
        Signal::Acceleration => "greatest acceleration",
        Signal::Reaction => "greatest reaction",
        Signal::ContactForce => "greatest contact force",
        Signal::Clearance => "greatest clearance",
        Signal::Indentation => "greatest indentation",
        Signal::Pressure => "greatest pressure",
    }
}
