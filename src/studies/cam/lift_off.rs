//! The least speed of the cam at which a follower cannot stay on it: from there on its steady
//! motion with closed contact would have to pull.
//!
//! The closed motion is found as the state that comes back after a cycle of the drives, the
//! contact being held as if it could pull. It depends neither on the start nor on the duration of a
//! run. Where its least force is zero it ceases.
//!
//! A lightly damped follower lifts off in narrow bands of speed, each about a resonance: the cam
//! turns so that a harmonic of its motion meets a natural frequency. So every resonance below the
//! first speed of lift-off that is met is tried too.

use super::elastic::{ElasticContact, Missing};
use super::force::{LiftOff, edge_between, lift_off};
use super::speed_search::SpeedSearch;
use crate::dynamics::model::{Closure, LinkBase, Model, Pair, Start};
use crate::dynamics::system::{Regime, System};
use crate::studies::steady::{recurring_state, whole_cycle};
use std::f64::consts::TAU;

/// Resonances of growing order that must leave the contact closed, one after another, before the
/// weaker ones of a mode are not tried any more.
const QUIET: u32 = 24;
/// Greatest order of a resonance that is tried.
const MOST_ORDER: f64 = 300.0;
/// Share of the speed of lift-off below it at which a run is made from the scene's start.
const BELOW: f64 = 0.02;

impl ElasticContact<'_> {
    /// The least speed of the cam (rad/s) at which its closed steady motion ceases; `report` has
    /// each speed before it is tried.
    ///
    /// # Errors
    /// The contact is not closed by force; there is no constant speed to begin with; the runs.
    pub fn lift_off(
        &self,
        search: &SpeedSearch,
        report: &mut dyn FnMut(f64),
    ) -> Result<LiftOff, Missing> {
        let mut tried: Vec<(f64, bool)> = Vec::new();
        let mut opens = |speed: f64| {
            report(speed);
            let system = self.system_of(search.model_at(self.model(), speed))?;
            let opens = !(self.of(&system).closed_margin()? > 0.0);
            Ok(opens)
        };
        let found = lift_off(search.start, &mut opens)?;
        let (LiftOff::At(highest) | LiftOff::Above(highest)) = found else {
            return Ok(found);
        };
        for resonances in self.resonances(search, highest)? {
            let mut quiet = 0;
            for speed in resonances {
                let opens = opens(speed)?;
                tried.push((speed, opens));
                quiet = if opens { 0 } else { quiet + 1 };
                if quiet == QUIET {
                    break;
                }
            }
        }
        tried.sort_by(|one, other| one.0.total_cmp(&other.0));
        match tried.iter().position(|(_, opens)| *opens) {
            None => Ok(found),
            Some(0) => Ok(LiftOff::Below(tried[0].0)),
            Some(first) => {
                edge_between([tried[first - 1].0, tried[first].0], opens).map(LiftOff::At)
            }
        }
    }

    /// Whether a run from the scene's own start bounces a little below a speed of the cam (rad/s) up
    /// to which closed contact is a steady motion: that speed; `None`: it stays closed, or is not known.
    pub fn bounces_below(&self, search: &SpeedSearch, lift_off: f64) -> Option<f64> {
        let speed = (1.0 - BELOW) * lift_off;
        let system = self.system_of(search.model_at(self.model(), speed)).ok()?;
        let force = self.of(&system).force().ok()?;
        (force.least.value <= 0.0).then_some(speed)
    }

    /// Speeds of the cam (rad/s) below one at which a harmonic of its motion meets a natural
    /// frequency, the highest first, by natural frequencies.
    fn resonances(
        &self,
        search: &SpeedSearch,
        highest: f64,
    ) -> Result<Vec<impl Iterator<Item = f64> + use<>>, Missing> {
        let turns = search.start * whole_cycle(self.model()).map_err(Missing::Refused)? / TAU;
        let system = self.held_closed();
        let system = system.as_ref().unwrap_or(self.system);
        let of_frequency = |frequency: f64| {
            // The speed of the first order; (turns of the cam in a cycle).
            let first = frequency * turns;
            let orders = (1u32..).map(f64::from);
            let below = orders.skip_while(move |order| first / order >= highest);
            let speeds = below.take_while(|order| *order <= MOST_ORDER);
            speeds.map(move |order| first / order)
        };
        let frequencies = system.natural_frequencies(Regime::Engaged).into_iter();
        let met = frequencies.filter(|frequency| *frequency > 0.0);
        Ok(met.map(of_frequency).collect())
    }

    /// Least contact force over a cycle of the steady motion in which the contact stays closed; not
    /// positive: there is no such motion.
    ///
    /// # Errors
    /// The run.
    fn closed_margin(&self) -> Result<f64, Missing> {
        let held = self.held_closed();
        let found = held.map(|held| recurring_state(&held, self.settings, self.control));
        let Some(Ok((state, cycle))) = found else {
            if self.control.spent().is_some() {
                return Err(Missing::Interrupted);
            }
            return Ok(self.force()?.least.value);
        };
        let mut model = self.model().clone();
        model.start = Start::State(state);
        let system = self.system_of(model)?;
        let contact = self.of(&system);
        let mut settings = self.run_of(cycle, 1.0);
        let span = contact.span("pair.margin", [0.0, cycle]);
        settings.spans = vec![span.clone()];
        let found = contact.motion(&settings)?;
        let known = found.recorded.spans.get(&span.address).copied().flatten();
        let known = known.ok_or_else(|| self.refused("its contact force is not known"))?;
        Ok(known.value)
    }

    /// The system with the contact of the object held closed; `None`: its contact force is not
    /// linear, so that it cannot pull.
    fn held_closed(&self) -> Option<System> {
        let part = &self.model().objects[self.object];
        let linear = |element: &crate::dynamics::model::ContactElement| {
            element.law.declaration().is_linear()
        };
        let is_linear =
            self.model().pair(part)?.form.is_linear() && part.contact.as_ref().is_none_or(linear);
        let held = is_linear.then(|| with_held_pair(self.model(), self.object))?;
        System::new(held).ok()
    }
}

fn with_held_pair(model: &Model, object: usize) -> Model {
    let mut held = model.clone();
    let hold = |pair: &mut Pair| pair.closure = Closure::Bilateral;
    let link = model.pair_link(&model.objects[object]);
    if let Some(LinkBase::Law { pair }) = link.map(|link| &mut held.links[link].base) {
        hold(pair);
    }
    held.objects[object].rigid_pair.iter_mut().for_each(hold);
    held
}
