//! A mean speed that a constant moment on a motor's drive holds.
//!
//! Behind a motor the mean speed is a result. With a constant moment beside the motor
//! it is a function of that moment: the state at φ = 0 and the moment are found together,
//! as a state that comes back after a cycle with the mean speed asked for.

use super::map::{
    AGAIN, Map, Orbit, derivative_by_differences, derivative_by_greater_differences,
    rough_differences,
};
use super::phase::PhaseMap;
use super::shooting::fixed_point_near;
use crate::budget::Budget;
use crate::dynamics::integrate::Method;
use crate::dynamics::model::{Load, LoadLaw, Model};
use crate::dynamics::steady::Mean;
use crate::dynamics::system::System;
use crate::fault::Fault;
use crate::units::shown;
use nalgebra::DMatrix;
use std::cell::RefCell;
use std::rc::Rc;

/// What is added to a drive: a constant moment (N·m) and an inertia (kg·m²).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct AddedDrive {
    pub(super) moment: f64,
    pub(super) inertia: f64,
}

/// The system of a model with something added to a drive.
///
/// # Errors
/// Those of [`System::new`].
pub(super) fn with_added(
    model: &Model,
    drive: usize,
    added: AddedDrive,
) -> Result<System, Vec<Fault>> {
    let mut model = model.clone();
    let node = model.objects[drive].nodes[0];
    model.nodes[node].inertia += added.inertia;
    if added.moment != 0.0 {
        model.loads.push(Load {
            node,
            name: "balance".to_owned(),
            law: LoadLaw::constant(added.moment),
        });
    }
    System::new(model)
}

/// A machine whose mean speed is asked for.
#[derive(Clone, Copy, Debug)]
pub(super) struct MeanSpeedTarget<'a> {
    pub(super) model: &'a Model,
    pub(super) drive: usize,
    /// The drive's coordinate.
    pub(super) rotor: usize,
    /// Inertia added to it (kg·m²).
    pub(super) inertia: f64,
    /// Meaning of the mean.
    pub(super) mean: Mean,
    /// The mean speed (rad/s).
    pub(super) speed: f64,
    pub(super) method: Method,
    pub(super) budget: Budget<'a>,
}

/// Part of the moment that a drive's own inertia takes to come to its speed within a
/// cycle: so much is added to see what a moment does.
const TRIAL: f64 = 1e-2;
/// Doublings of a moment that does not yet carry the machine through a cycle.
const DOUBLINGS: u32 = 40;
/// Cycles in which the moment is adjusted before both are found together.
const ADJUSTING: u32 = 16;
/// Share of what it would take at once that is corrected in such a cycle.
const CORRECTED: f64 = 0.8;

/// A state at φ = 0 with the moment under which it comes back.
#[derive(Clone, Debug)]
pub(super) struct PeriodicState {
    /// The state without the drive's angle.
    pub(super) state: Vec<f64>,
    /// The moment (N·m), along the drive's motion.
    pub(super) moment: f64,
}

/// Behind a drive with the moment as one more entry of the state: [u, u̇, M].
struct HeldMap<'a> {
    wanted: MeanSpeedTarget<'a>,
    scales: Vec<f64>,
    /// Moment that corrects a mean speed (N·m·s/rad).
    gain: f64,
    /// The system with the moment that was asked for last.
    last: RefCell<Option<(u64, Rc<System>)>>,
}

impl HeldMap<'_> {
    fn system(&self, moment: f64) -> Result<Rc<System>, String> {
        let mut last = self.last.borrow_mut();
        if let Some((bits, system)) = &*last
            && *bits == moment.to_bits()
        {
            return Ok(Rc::clone(system));
        }
        let added = AddedDrive {
            moment,
            inertia: self.wanted.inertia,
        };
        let made = with_added(self.wanted.model, self.wanted.drive, added);
        let made = Rc::new(made.map_err(|faults| {
            let first = faults.first();
            first.map_or_else(String::new, |fault| fault.message.clone())
        })?);
        *last = Some((moment.to_bits(), Rc::clone(&made)));
        Ok(made)
    }

    fn with_phase_map<T>(
        &self,
        moment: f64,
        f: impl FnOnce(&PhaseMap<'_>) -> Result<T, String>,
    ) -> Result<T, String> {
        let system = self.system(moment)?;
        let MeanSpeedTarget {
            rotor,
            method,
            budget,
            ..
        } = self.wanted;
        f(&PhaseMap::new(&system, rotor, method, budget))
    }

    /// The state after a cycle and the mean speed on the way.
    fn measure(&self, state: &[f64], moment: f64, cycle: f64) -> Result<(Vec<f64>, f64), String> {
        self.with_phase_map(moment, |map| map.pass(state, cycle, self.wanted.mean))
    }
}

impl Map for HeldMap<'_> {
    fn apply(&self, state: &[f64], cycle: f64) -> Result<Vec<f64>, String> {
        let (moment, state) = split_state(state);
        let (mut end, mean) = self.measure(state, moment, cycle)?;
        end.push(moment + self.gain * (self.wanted.speed - mean));
        Ok(end)
    }

    fn monodromy(&self, state: &[f64], cycle: f64) -> Result<DMatrix<f64>, String> {
        derivative_by_differences(self, state, cycle)
    }

    fn slopes(&self, state: &[f64], end: &[f64], cycle: f64) -> Result<DMatrix<f64>, String> {
        rough_differences(self, state, end, cycle)
    }

    fn orbit(&self, state: &[f64], cycle: f64, count: usize) -> Result<Orbit, String> {
        let (moment, state) = split_state(state);
        self.with_phase_map(moment, |map| map.orbit(state, cycle, count))
    }

    fn scales(&self) -> &[f64] {
        &self.scales
    }

    fn derivative_method(&self) -> &'static str {
        "differences"
    }

    fn check(&self, state: &[f64], cycle: f64) -> Result<DMatrix<f64>, String> {
        derivative_by_greater_differences(self, state, cycle)
    }

    fn derivative_check(&self) -> &'static str {
        AGAIN
    }
}

fn split_state(state: &[f64]) -> (f64, &[f64]) {
    let (moment, state) = state.split_last().unwrap_or((&0.0, &[]));
    (*moment, state)
}

/// The steady motion with the mean speed asked for, from a state of the machine at
/// φ = 0 and a moment near its own.
///
/// # Errors
/// Why there is none, in words.
pub(super) fn steady_at_mean_speed(
    wanted: MeanSpeedTarget<'_>,
    start: &[f64],
    moment: f64,
    cycle: f64,
) -> Result<PeriodicState, String> {
    let mut map = HeldMap {
        wanted,
        scales: Vec::new(),
        gain: 0.0,
        last: RefCell::new(None),
    };
    let (speed, mut scales) =
        map.with_phase_map(moment, |map| Ok((map.speed(), map.scales().to_vec())))?;
    let mut state = start.to_vec();
    state[speed] = wanted.speed;
    let inertia = wanted.model.nodes[wanted.model.objects[wanted.drive].nodes[0]].inertia;
    let unit = (inertia + wanted.inertia) * wanted.speed * wanted.speed / cycle;
    let (mut moment, per_moment) = initial_moment(&map, &state, [moment, unit], cycle)?;
    // The vibrations settle while the moment is adjusted and the speed put back.
    for _ in 0..ADJUSTING {
        let (end, mean) = map.measure(&state, moment, cycle)?;
        let gained = end[speed] - state[speed];
        moment -= CORRECTED * gained / per_moment;
        let own = end[speed] - gained;
        state = end;
        state[speed] = own + (wanted.speed - mean);
    }
    let size = scales[speed] / per_moment;
    scales.push(size);
    (map.scales, map.gain) = (scales, 1.0 / per_moment);
    state.push(moment);
    let found = fixed_point_near(&map, &state, cycle)?.ok_or_else(|| {
        format!(
            "no moment was found that holds a mean speed of {} rad/s (nearest: {} N·m)",
            wanted.speed,
            shown(moment, 7)
        )
    })?;
    let (moment, state) = split_state(&found);
    Ok(PeriodicState {
        state: state.to_vec(),
        moment,
    })
}

/// A moment that about keeps the speed over a cycle, and the speed gained in a cycle for
/// each unit of it, > 0.
fn initial_moment(
    map: &HeldMap<'_>,
    state: &[f64],
    [mut moment, unit]: [f64; 2],
    cycle: f64,
) -> Result<(f64, f64), String> {
    let speed = map.with_phase_map(moment, |map| Ok(map.speed()))?;
    let gained = |moment: f64| {
        let (end, _) = map.measure(state, moment, cycle)?;
        Ok::<f64, String>(end[speed] - state[speed])
    };
    let mut first = gained(moment);
    // What stalls on the way needs more.
    let mut more = unit;
    for _ in 0..DOUBLINGS {
        if first.is_ok() || map.wanted.budget.is_spent() {
            break;
        }
        moment += more;
        more *= 2.0;
        first = gained(moment);
    }
    let first = first?;
    let trial = TRIAL * unit;
    let per_moment = (gained(moment + trial)? - first) / trial;
    if !(per_moment.is_finite() && per_moment > 0.0) {
        return Err("a moment on the drive does not make it gain speed".to_owned());
    }
    Ok((moment - first / per_moment, per_moment))
}
