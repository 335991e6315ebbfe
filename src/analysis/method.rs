//! Which method a run takes, and why.

use super::document::can_open;
use super::settings::RunSettings;
use crate::exact::Parts;
use crate::fault::Fault;
use crate::integrate::{Dynamics, Method, Situation, choose};
use crate::model::{Model, NodeMotion, Start};
use crate::system::System;

/// Instants at which the speed of a prescribed drive is looked at.
const LOOKS: usize = 64;

/// The method of a run.
pub(super) struct Choice {
    /// The method.
    pub(super) method: Method,
    /// Its name in the figures.
    pub(super) name: &'static str,
    /// Why this one.
    pub(super) why: String,
    /// What is propagated exactly, when the method is `exact`.
    pub(super) parts: Option<Parts>,
}

/// The method asked for, or the one that suits the system.
///
/// # Errors
/// `exact` is asked for and cannot be used, with every reason.
pub(super) fn choose_method(system: &System, settings: &RunSettings) -> Result<Choice, Vec<Fault>> {
    if system.coordinates() == 0 {
        return Ok(Choice {
            method: Method::Dop853,
            name: "kinematic",
            why: "nothing is elastic: the motion follows from the drives".to_owned(),
            parts: None,
        });
    }
    let (method, why, parts) = match settings.method {
        Some(Method::Exact) => (
            Method::Exact,
            "asked for".to_owned(),
            Some(super::exact::tried(system)?),
        ),
        Some(method) => (method, "asked for".to_owned(), None),
        None => match super::exact::tried(system) {
            Ok(parts) => (Method::Exact, why_exact(&parts), Some(parts)),
            Err(_) => {
                let (method, why) = choose(&situation(system, settings));
                (method, why, None)
            }
        },
    };
    Ok(Choice {
        method,
        name: method.name(),
        why,
        parts,
    })
}

/// A general method, where exact propagation would have been the choice.
pub(super) fn choose_general(system: &System, settings: &RunSettings, because: &str) -> Choice {
    let (method, why) = choose(&situation(system, settings));
    Choice {
        method,
        name: method.name(),
        why: format!("{because}; {why}"),
        parts: None,
    }
}

/// Why a system is propagated exactly.
fn why_exact(parts: &Parts) -> String {
    let trees = match parts.trees.len() {
        1 => String::new(),
        count => format!(" in each of {count} branches"),
    };
    format!(
        "between switches the motion{trees} is linear and its drive is prescribed: \
         it is known in closed form, and only the switches are searched for"
    )
}

/// What the choice depends on.
fn situation(system: &System, settings: &RunSettings) -> Situation {
    // A run shorter than a turn shows at least its own duration.
    let slowest = 1.0 / settings.duration;
    Situation {
        fastest: system.fastest_rate(),
        resolved: driving_speeds(system, settings.duration)
            .chain(shown_frequencies(system))
            .fold(slowest, f64::max),
        expands: system.expands(),
        tolerance: settings.tolerance,
        coordinates: system.coordinates(),
        duration: settings.duration,
    }
}

/// Greatest speeds of turning drives (rad/s): the lowest harmonic of their laws.
fn driving_speeds(system: &System, duration: f64) -> impl Iterator<Item = f64> {
    let model = system.model();
    let drives = model.objects.iter().enumerate();
    drives
        .filter(|(_, part)| part.driver.is_none())
        .map(
            move |(object, part)| match &model.nodes[part.nodes[0]].motion {
                NodeMotion::Prescribed { motion, .. } => {
                    let breaks = motion.breaks();
                    (0..=LOOKS)
                        .map(|look| duration * look as f64 / LOOKS as f64)
                        .map(|time| motion.jet(breaks.locate(time, 1.0), time).first.abs())
                        .fold(0.0, f64::max)
                }
                // The scale of a rotor's speed is its nominal speed.
                _ => system
                    .last_coordinate(object)
                    .map_or(0.0, |rotor| system.scales()[system.coordinates() + rotor]),
            },
        )
}

/// Base frequencies √(c/J) (rad/s) of the objects whose vibration is part of
/// the motion: those whose contact comes and goes, and all when the start is
/// not the quiet one. (The scale of an object's speed is that of its deviation
/// times its base frequency.)
fn shown_frequencies(system: &System) -> impl Iterator<Item = f64> {
    let model: &Model = system.model();
    let quiet = model.start == Start::Kinetostatic;
    let objects = model.objects.iter().enumerate();
    objects
        .filter(move |(_, part)| !quiet || can_open(model, part))
        .filter_map(|(object, _)| {
            let first = system.first_coordinate(object)?;
            let scales = system.scales();
            Some(scales[system.coordinates() + first] / scales[first])
        })
}
