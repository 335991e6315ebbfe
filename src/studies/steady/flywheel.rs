//! The flywheel, and the moment that holds a mean speed, of a machine with a motor and
//! elastic objects.

use super::map::Map;
use super::mean_speed::{
    AddedDrive, MeanSpeedTarget, PeriodicState, steady_at_mean_speed, with_added,
};
use super::periodic::no_periodic_motion;
use super::phase::PhaseMap;
use super::shooting::{fixed_point_near, shoot};
use crate::budget::Budget;
use crate::dynamics::integrate::Method;
use crate::dynamics::model::Model;
use crate::dynamics::steady::Refusal;
use crate::dynamics::steady::flywheel::{Flywheel, inertia_for};
use crate::fault::Fault;
use crate::frontend::scene::SteadySpec;
use std::cell::RefCell;

/// How near δ comes to the one asked for, of it: about what the motions are known to.
const NEAR: f64 = 1e-9;

/// A machine whose drive something is to be added to.
#[derive(Clone, Copy, Debug)]
pub(super) struct WheelRequest<'a> {
    pub(super) model: &'a Model,
    pub(super) drive: usize,
    /// The drive's coordinate.
    pub(super) rotor: usize,
    pub(super) spec: &'a SteadySpec,
    pub(super) method: Method,
    pub(super) budget: Budget<'a>,
    /// A state at φ = 0.
    pub(super) start: &'a [f64],
    /// Φ (rad).
    pub(super) cycle: f64,
}

/// What is added to a drive, and the state that then comes back.
#[derive(Clone, Debug, Default)]
pub(super) struct WheelResult {
    pub(super) added: AddedDrive,
    pub(super) state: Option<Vec<f64>>,
    pub(super) flywheel: Option<Flywheel>,
}

impl WheelRequest<'_> {
    /// What is asked for, found.
    ///
    /// # Errors
    /// No moment holds the mean speed, no inertia lowers the fluctuation as far.
    pub(super) fn solve(&self) -> Result<WheelResult, Vec<Fault>> {
        let last = RefCell::new(None);
        let (inertia, without) = match self.spec.fluctuation {
            None => (0.0, None),
            Some(wanted) => {
                let delta = |inertia: f64| self.fluctuation(inertia, &last);
                let first = self.model.nodes[self.model.objects[self.drive].nodes[0]].inertia;
                inertia_for(&delta, wanted, first, NEAR)
                    .map_err(|refusal| refusal.faults("steady"))?
            }
        };
        let held = self
            .state_with_inertia(inertia, &last)
            .map_err(|why| no_periodic_motion(&why))?;
        let flywheel = match self.spec.fluctuation {
            None => None,
            Some(fluctuation) => Some(Flywheel {
                fluctuation,
                fluctuation_without: without,
                inertia,
                fluctuation_with: self
                    .delta(inertia, &held)
                    .map_err(|why| no_periodic_motion(&why))?,
                // Textbooks speak of rigid machines.
                approximations: Vec::new(),
            }),
        };
        Ok(WheelResult {
            added: AddedDrive {
                moment: held.moment,
                inertia,
            },
            state: Some(held.state),
            flywheel,
        })
    }

    /// The fluctuation with inertia added; `None` where no motion was found.
    fn fluctuation(
        &self,
        inertia: f64,
        last: &RefCell<Option<PeriodicState>>,
    ) -> Result<Option<f64>, Refusal> {
        let found = self.state_with_inertia(inertia, last);
        let delta = found.and_then(|held| self.delta(inertia, &held));
        match self.budget.spent() {
            Some(spent) => Err(Refusal::NoCycle {
                why: spent.to_string(),
            }),
            None => Ok(delta.ok()),
        }
    }

    /// The state that comes back with inertia added, from the one that was found last.
    fn state_with_inertia(
        &self,
        inertia: f64,
        last: &RefCell<Option<PeriodicState>>,
    ) -> Result<PeriodicState, String> {
        let before = last.borrow().clone();
        let found = match (self.spec.balance, self.spec.mean_speed) {
            (true, Some(speed)) => {
                let wanted = MeanSpeedTarget {
                    model: self.model,
                    drive: self.drive,
                    rotor: self.rotor,
                    inertia,
                    mean: self.spec.mean,
                    speed,
                    method: self.method,
                    budget: self.budget,
                };
                let (start, moment) = match &before {
                    Some(before) => (&before.state[..], before.moment),
                    None => (self.start, 0.0),
                };
                steady_at_mean_speed(wanted, start, moment, self.cycle)?
            }
            _ => PeriodicState {
                state: self.free_motion(inertia, before.as_ref())?,
                moment: 0.0,
            },
        };
        *last.borrow_mut() = Some(found.clone());
        Ok(found)
    }

    /// The same without a moment: the speed is as motor and load decide.
    fn free_motion(
        &self,
        inertia: f64,
        before: Option<&PeriodicState>,
    ) -> Result<Vec<f64>, String> {
        self.with_phase_map(0.0, inertia, |map| {
            let found =
                before.and_then(|before| fixed_point_near(map, &before.state, self.cycle).ok()?);
            match found {
                Some(state) => Ok(state),
                None => Ok(shoot(map, self.start, self.cycle, 1)?.state),
            }
        })
    }

    fn delta(&self, inertia: f64, held: &PeriodicState) -> Result<f64, String> {
        self.with_phase_map(held.moment, inertia, |map| {
            let portrait = map.portrait(&held.state, self.cycle, 1)?;
            let mean = self.cycle / map.duration(&held.state, self.cycle)?;
            Ok((portrait.greatest.value - portrait.least.value) / mean)
        })
    }

    fn with_phase_map<T>(
        &self,
        moment: f64,
        inertia: f64,
        f: impl FnOnce(&PhaseMap<'_>) -> Result<T, String>,
    ) -> Result<T, String> {
        let system = with_added(self.model, self.drive, AddedDrive { moment, inertia });
        let system = system.map_err(|faults| {
            let first = faults.first();
            first.map_or_else(String::new, |fault| fault.message.clone())
        })?;
        f(&PhaseMap::new(
            &system,
            self.rotor,
            self.method,
            self.budget,
        ))
    }
}
