//! The steady motion of a scene.
//!
//! Rigid objects behind a motor or a prescribed drive: the energy-mass method
//! where forces depend on the position alone, the cycle map where a moment
//! depends on the speed. Elastic objects: the periodic motion, by shooting, over time
//! behind prescribed drives, over the drive's angle behind a motor.

mod answer;
pub mod csv;
mod cycle;
mod expectations;
mod flywheel;
mod machine;
mod map;
mod mean_speed;
mod motor;
mod multipliers;
mod over_period;
mod periodic;
mod phase;
mod portrait;
mod rigid;
mod shooting;
mod simulate;
mod sink;

pub use answer::DriveFigures;
pub use answer::DriveRow;
pub use answer::Forces;
pub use answer::Simulation;
pub use answer::StartOf;
pub use answer::{Agreement, RigidAnswer, rigid_checks, rigid_judgement};
pub use expectations::{check, figure};
pub use machine::{Machine, constant_speed, drive_of, is_elastic};
pub use multipliers::{Multiplier, Stability};
pub use over_period::{DriveWork, Event, Extremes, OverPeriod, Works};
pub use periodic::{LongRun, Orbit, PartMotion, PeriodicAnswer};
pub use rigid::{ROWS, by_energy};

use crate::dynamics::model::{Model, Node, NodeMotion};
use crate::dynamics::system::System;
use crate::fault::Fault;
use crate::frontend::scene::SteadySpec;
use crate::studies::check::Check;
use crate::studies::document::can_open;
use crate::studies::rigid::Rigid as RigidLabel;
use crate::studies::{Control, RunSettings};
use serde::Serialize;

/// The steady motion of a scene.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Answer {
    /// Of a machine with rigid objects.
    #[serde(rename = "rigid_motion")]
    Rigid(Box<RigidAnswer>),
    /// Of elastic objects.
    Periodic(Box<PeriodicAnswer>),
}

impl Answer {
    /// True when all its checks are passed.
    pub fn is_trusted(&self) -> bool {
        match self {
            Self::Rigid(answer) => answer.is_trusted(),
            Self::Periodic(answer) => answer.is_trusted(),
        }
    }

    /// The label of a motion of rigid objects where some of the model are elastic.
    pub fn label(&self, model: &Model) -> Option<RigidLabel> {
        match self {
            Self::Rigid(_) => RigidLabel::label(model, &["dam run"]),
            Self::Periodic(_) => None,
        }
    }

    /// What a motion of rigid objects does not say of a model: whether their pairs would open.
    pub fn unjudged(&self, model: &Model) -> Option<String> {
        let parts = model.objects.iter();
        let pairs = parts.filter(|part| can_open(model, part));
        let ids: Vec<&str> = pairs.map(|part| part.id.as_str()).collect();
        match self {
            Self::Rigid(_) if !ids.is_empty() => {
                let of = ids.join(", ");
                let words = format!(
                    "whether the contact of {of} separates is judged by `dam run` \
                                     alone"
                );
                Some(words)
            }
            Self::Rigid(_) | Self::Periodic(_) => None,
        }
    }

    /// The checks of the answer, with their bounds.
    pub fn checks(&self) -> Vec<Check> {
        match self {
            Self::Rigid(answer) => answer.checks(),
            Self::Periodic(answer) => answer.checks(),
        }
    }
}

/// Finds the steady motion that a scene asks for.
///
/// # Errors
/// Every fault of the question, or why there is no steady motion, in words and
/// numbers.
pub fn steady_motion(
    system: &System,
    settings: &RunSettings,
    spec: &SteadySpec,
) -> Result<Answer, Vec<Fault>> {
    steady_motion_within(system, settings, spec, &Control::default())
}

/// Steady motion, ended from outside: by a flag, or after a time.
///
/// # Errors
/// As [`steady_motion`]; ended before there was an answer.
pub fn steady_motion_within(
    system: &System,
    settings: &RunSettings,
    spec: &SteadySpec,
    control: &Control<'_>,
) -> Result<Answer, Vec<Fault>> {
    solve(system, settings, spec, control).map_err(|faults| match control.spent() {
        // What it came to by then is no word on the machine.
        Some(spent) => {
            let message = format!("ended before a steady motion was found: {spent}");
            vec![Fault::new("steady", message, "")]
        }
        None => faults,
    })
}

/// Whether a model is one of those whose steady motion is found at all: of one degree of freedom,
/// without joint friction, behind a drive that is named where there are several.
///
/// # Errors
/// Why it is not.
pub fn suits(model: &Model, spec: &SteadySpec) -> Result<(), Vec<Fault>> {
    let rubs = friction_faults(model);
    if !rubs.is_empty() {
        return Err(rubs);
    }
    if let Some(body) = model.multi_linkages.first() {
        let id = &model.objects[body.object].id;
        return Err(vec![Fault::new(
            id.clone(),
            "it has several inputs: a steady motion is found of machines with one degree of freedom",
            "`dam run` runs it from its start on",
        )]);
    }
    match moves_with_drives(model, spec) {
        true => Ok(()),
        false => drive_of(model, spec.drive.as_deref()).map(|_| ()),
    }
}

/// The time (s) after which a model behind prescribed drives repeats.
///
/// # Errors
/// Why it does not.
pub(super) fn whole_cycle(model: &Model) -> Result<f64, Vec<Fault>> {
    periodic::whole_cycle(model, SteadySpec::default().cycle).map(|(_, time)| time)
}

/// A state y = [u, u̇] of an elastic system at t = 0 that comes back after the cycle of its
/// prescribed drives, and the time of that cycle (s).
///
/// # Errors
/// Why there is none that is found.
pub(super) fn recurring_state(
    system: &System,
    settings: &RunSettings,
    control: &Control<'_>,
) -> Result<(Vec<f64>, f64), Vec<Fault>> {
    let (model, spec) = (system.model(), SteadySpec::default());
    suits(model, &spec)?;
    if !moves_with_drives(model, &spec) {
        let message = "not all of its drives are prescribed";
        return Err(vec![Fault::new("steady", message, "")]);
    }
    periodic::recurring_state(system, settings, control)
}

/// Where every drive is prescribed, all that is elastic moves with them.
fn moves_with_drives(model: &Model, spec: &SteadySpec) -> bool {
    let is_free = |node: &Node| matches!(node.motion, NodeMotion::Rotor { .. });
    let is_mass = |node: &Node| matches!(node.motion, NodeMotion::Mass { .. });
    let elastic = model.nodes.iter().any(is_mass) && !model.nodes.iter().any(is_free);
    spec.drive.is_none() && elastic
}

fn solve(
    system: &System,
    settings: &RunSettings,
    spec: &SteadySpec,
    control: &Control<'_>,
) -> Result<Answer, Vec<Fault>> {
    let model = system.model();
    suits(model, spec)?;
    if moves_with_drives(model, spec) {
        let answer = periodic::answer(system, settings, spec, control)?;
        return Ok(Answer::Periodic(Box::new(answer)));
    }
    let drive = drive_of(model, spec.drive.as_deref())?;
    let speed = constant_speed(model, drive);
    if is_elastic(model, drive) && system.last_coordinate(drive).is_none() {
        let answer = periodic::answer(system, settings, spec, control)?;
        return Ok(Answer::Periodic(Box::new(answer)));
    }
    if let (true, Some(rotor)) = (is_elastic(model, drive), system.last_coordinate(drive)) {
        let answer = motor::answer(system, drive, rotor, settings, spec, control)?;
        return Ok(Answer::Periodic(Box::new(answer)));
    }
    let answer = rigid::answer(model, drive, spec, speed, control)?;
    Ok(Answer::Rigid(Box::new(answer)))
}

/// Friction that sticks: a state of its own, which a steady motion would have to repeat.
fn dry_friction_faults(model: &Model) -> impl Iterator<Item = Fault> + '_ {
    let rubs = (model.loads.iter()).filter(|load| load.law.dry_friction().is_some());
    rubs.map(|load| {
        let message = format!(
            "`{}` is friction that sticks: a steady motion is found of machines without",
            load.name
        );
        let hint = "`dam run` runs it until it is steady; or give `force` and `width` in place of \
                    `sliding`: regularised friction";
        Fault::new(format!("{}.friction", load.name), message, hint)
    })
}

/// The linkages whose friction would act on the motion.
fn friction_faults(model: &Model) -> Vec<Fault> {
    let bodies = model.linkages.iter();
    let rubs = bodies.filter(|body| body.friction.as_ref().is_some_and(|k| k.has_friction()));
    let joints = rubs.map(|body| {
        let id = &model.objects[body.object].id;
        let message = format!(
            "the joints of `{id}` have friction, which depends on the reactions: a steady \
             motion is found of machines without"
        );
        let hint = format!(
            "`--set {id}.joint_friction=false`; `dam run` runs it with its friction, `dam forces` \
             shows what friction costs over a turn"
        );
        Fault::new(format!("{id}.joint_friction"), message, hint)
    });
    joints.chain(dry_friction_faults(model)).collect()
}
