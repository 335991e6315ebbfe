//! A simulation in time of what was found: does the machine keep it?

use super::answer::RigidAnswer;
use super::answer::Simulation;
use super::machine::freed;
use super::sink::Last;
use crate::dynamics::integrate::{Dynamics, Limits, Method, Settings, Stop, integrate};
use crate::dynamics::model::Model;
use crate::dynamics::system::System;
use crate::studies::Control;

/// Cycles at least, and at most.
const CYCLES: [u32; 2] = [5, 400];
/// Disturbance of ω(0) where the motion attracts.
const DISTURBED: f64 = 0.02;
/// What is left of it at the end.
const LEFT: f64 = 1e-9;
const TOLERANCE: f64 = 1e-12;

/// Why there is no simulation.
pub(super) struct NoSimulation {
    /// In words.
    pub(super) why: String,
    /// True when it was begun and failed.
    pub(super) failed: bool,
}

impl NoSimulation {
    fn not_made(why: impl Into<String>) -> Self {
        let (why, failed) = (why.into(), false);
        Self { why, failed }
    }

    fn of_failure(why: String) -> Self {
        Self { why, failed: true }
    }
}

/// Simulates the scene with the drive freed, a moment and inertia added, for as
/// many cycles as a disturbance needs to die away.
///
/// # Errors
/// Why there is none, in words.
pub(super) fn simulate(
    model: &Model,
    drive: usize,
    answer: &RigidAnswer,
    added: [f64; 2],
    control: &Control<'_>,
) -> Result<Simulation, NoSimulation> {
    let drives = model.objects.iter().filter(|part| part.is_drive());
    if drives.count() > 1 {
        return Err(NoSimulation::not_made("the scene has other drives"));
    }
    if answer.figures.almost_stops() {
        let why = "the machine almost stops, where the errors of a simulation grow beyond bounds";
        return Err(NoSimulation::not_made(why));
    }
    let (cycles, disturbed) = match &answer.regime {
        Some(regime) if regime.attracts => {
            let needed = (LEFT.ln() / regime.multiplier.ln()).ceil();
            if needed > f64::from(CYCLES[1]) {
                let why = format!("a disturbance takes {needed} cycles to die away");
                return Err(NoSimulation::not_made(why));
            }
            ((needed as u32).max(CYCLES[0]), DISTURBED)
        }
        _ => (CYCLES[0], 0.0),
    };
    let start = answer.motion.speed(0.0);
    let model = freed(model, drive, 0.0, start * (1.0 + disturbed), added);
    let failed = |faults: Vec<crate::fault::Fault>| {
        let first = faults.first();
        NoSimulation::of_failure(first.map_or_else(String::new, |fault| fault.message.clone()))
    };
    let system = System::new(model).map_err(failed)?;
    let initial = system.initial_state().map_err(failed)?;
    let mut last = Last::default();
    let settings = Settings {
        method: Method::Dop853,
        tolerance: TOLERANCE,
        step: Some(answer.figures.period / 32.0),
    };
    let limits = Limits {
        switches: 1_000_000,
        steps: 1_000_000,
        budget: *control,
    };
    // Not at the end of a cycle, where tables like to have their points.
    let end = (f64::from(cycles) - 0.382) * answer.figures.period;
    let outcome = integrate(
        &system,
        0.0,
        end,
        &initial.y,
        &initial.modes,
        &settings,
        &limits,
        &mut last,
    );
    if let (true, Some(spent)) = (outcome.stop.is_from_outside(), control.spent()) {
        return Err(NoSimulation::not_made(spent.to_string()));
    }
    if outcome.stop != Stop::Complete {
        return Err(NoSimulation::of_failure(format!(
            "it stopped at t = {} s",
            outcome.time
        )));
    }
    let coordinate = system.last_coordinate(drive).unwrap_or(0);
    let position = last.y[coordinate].rem_euclid(answer.cycle);
    let speed = last.y[system.coordinates() + coordinate];
    Ok(Simulation {
        cycles,
        disturbed,
        speed: speed / answer.motion.speed(position) - 1.0,
    })
}
