//! Lift-off with the follower's elasticity, by runs of the dynamic model.

use crate::dynamics::integrate::Stop;
use crate::dynamics::record::drive_cycle;
use crate::dynamics::system::System;
use crate::exact::RequestedFigures;
use crate::fault::Fault;
use crate::studies::demand::Demand;
use crate::studies::document::stop_in_words;
use crate::studies::judgement::Judgement;
use crate::studies::run::motion;
use crate::studies::{Control, RunSettings};

/// Fewest cycles of a run, so that the last one can be taken for steady.
const CYCLES: f64 = 4.0;
/// Most cycles.
const MOST_CYCLES: f64 = 1000.0;

/// State of a pair in the steady part of a run at one speed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Steady {
    /// The pair stays closed in the last cycle.
    Closed,
    /// The pair opens there, or the run gave up on too many switches.
    Opens,
    /// The run was ended from outside.
    Interrupted,
}

/// Whether the pair of an object (index in the model) opens in the last whole
/// cycle of a run as long as the scene's, at least four cycles: by exact
/// propagation where the system qualifies, else by the scene's method.
///
/// # Errors
/// The run has no start, no cycle, or stops (a dead-centre position).
pub fn steady_contact(
    system: &System,
    object: usize,
    settings: &RunSettings,
    control: &Control<'_>,
) -> Result<Steady, Vec<Fault>> {
    let id = &system.model().objects[object].id;
    let cycle = drive_cycle(system.model()).map_err(|why| {
        vec![Fault::new(
            id.clone(),
            why,
            "give the drive a constant speed",
        )]
    })?;
    let cycles = (settings.duration / cycle * (1.0 - 1e-12)).ceil();
    let settings = RunSettings {
        duration: cycle * cycles.clamp(CYCLES, MOST_CYCLES),
        samples: 100,
        window: None,
        ..settings.clone()
    };
    let demand = Demand {
        figures: Some(&|_| RequestedFigures::DEVIATION),
        laws: None,
        checked: true,
    };
    let found = motion(system, &settings, demand, control, &mut [])?;
    match &found.outcome.stop {
        Stop::Interrupted | Stop::WallClock { .. } => return Ok(Steady::Interrupted),
        Stop::Complete | Stop::TooManySwitches { .. } => {}
        stop => {
            let (_, why) = stop_in_words(stop);
            return Err(vec![Fault::new(id.clone(), why, "")]);
        }
    }
    let pair = found.recorded.figures[object].pair.as_ref();
    let judged = pair.map(Judgement::of_pair);
    Ok(if judged == Some(Judgement::InWorkingOrder) {
        Steady::Closed
    } else {
        Steady::Opens
    })
}
