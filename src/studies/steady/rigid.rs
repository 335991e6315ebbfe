//! The steady motion of a machine with rigid objects.

use super::answer::Agreement;
use super::answer::Forces;
use super::answer::RigidAnswer;
use super::cycle::Rhythms;
use super::machine::Machine;
use super::machine::nodes_moved_by;
use super::simulate::simulate;
use crate::dynamics::model::Model;
use crate::dynamics::steady::cycle_map::{self, Load, Regime};
use crate::dynamics::steady::flywheel::{self};
use crate::dynamics::steady::{Profile, Question, Refusal, Row, SteadyMotion, find_steady_motion};
use crate::fault::Fault;
use crate::frontend::scene::SteadySpec;
use crate::studies::Control;

/// Rows compared between the ways, and shown.
pub const ROWS: usize = 360;

/// The question that a block asks, for a mean speed.
fn question(spec: &SteadySpec, mean_speed: f64) -> Question {
    Question {
        mean: spec.mean,
        tolerance: spec.tolerance,
        balance: spec.balance,
        ..Question::new(mean_speed)
    }
}

/// The steady motion of the rigid machine behind a drive.
///
/// # Errors
/// Every fault of the scene, or the refusal with its numbers.
pub(super) fn answer(
    model: &Model,
    drive: usize,
    spec: &SteadySpec,
    speed_of_drive: Option<f64>,
    control: &Control<'_>,
) -> Result<RigidAnswer, Vec<Fault>> {
    let node = model.objects[drive].nodes[0];
    let rhythms = Rhythms::rhythms_behind_drive(model, node, &nodes_moved_by(model, node));
    let cycle = rhythms.whole_cycle(spec.cycle)?;
    let machine = Machine::new(model, drive, cycle)?;
    let refuse = |refusal: Refusal| refusal.faults("steady");
    let mut answer = if machine.depends_on_speed() {
        by_cycle_map(&machine, spec, control)?
    } else {
        let Some(mean_speed) = spec.mean_speed.or(speed_of_drive) else {
            let message = "all forces depend on the position alone: every mean speed has its \
                           steady motion, and none is given";
            let hint = "\"steady\": { \"mean_speed\": \"300 rpm\" }, or --mean-speed \"300 rpm\"";
            return Err(vec![Fault::new("steady.mean_speed", message, hint)]);
        };
        let profile = machine.profile().map_err(refuse)?;
        by_energy(&profile, &question(spec, mean_speed), spec.fluctuation).map_err(refuse)?
    };
    let added = answer.flywheel.as_ref().map_or(0.0, |wheel| wheel.inertia);
    let moment = answer.figures.balance.unwrap_or(0.0);
    match simulate(model, drive, &answer, [moment, added], control) {
        Ok(simulation) => answer.agreement.simulation = Some(simulation),
        Err(missing) => {
            answer.agreement.simulation_missing = Some(missing.why);
            answer.agreement.simulation_failed = missing.failed;
        }
    }
    Ok(answer.with_check_warnings())
}

/// The energy-mass method, with a flywheel where one is asked for.
///
/// # Errors
/// See [`Refusal`].
pub fn by_energy(
    profile: &Profile,
    question: &Question,
    fluctuation: Option<f64>,
) -> Result<RigidAnswer, Refusal> {
    let (flywheel, motion) = match fluctuation {
        Some(wanted) => {
            let (wheel, motion) = flywheel::size_flywheel(profile, question, wanted)?;
            (Some(wheel), motion)
        }
        None => (None, find_steady_motion(profile, question)?),
    };
    Ok(RigidAnswer {
        forces: Forces::Position,
        cycle: profile.cycle(),
        figures: motion.figures.clone(),
        regime: None,
        flywheel,
        agreement: Agreement {
            equation: motion.check(),
            ..Agreement::default()
        },
        motion,
    })
}

/// The cycle map, and the energy-mass method on the moments it found.
fn by_cycle_map(
    machine: &Machine,
    spec: &SteadySpec,
    control: &Control<'_>,
) -> Result<RigidAnswer, Vec<Fault>> {
    let mut faults = Vec::new();
    let mut contradict = |given: bool, name: &str, hint: &str| {
        if given {
            let message = format!("`{name}` has no place where a moment depends on the speed");
            faults.push(Fault::new(format!("steady.{name}"), message, hint));
        }
    };
    let hint = "leave it out: the motor's characteristic decides";
    contradict(spec.mean_speed.is_some(), "mean_speed", hint);
    contradict(
        spec.balance,
        "balance",
        "leave it out: the motor balances the cycle",
    );
    if !faults.is_empty() {
        return Err(faults);
    }
    with_flywheel(machine, spec, control).map_err(|refusal| refusal.faults("steady"))
}

/// The regime of a machine with inertia added, and its motion.
fn regime_with(machine: &Machine, added: f64) -> Result<(Regime, SteadyMotion, f64), Refusal> {
    let at = |piece: usize, position: f64, speed: f64| {
        let load = machine.at(piece, position, speed);
        Load {
            inertia: load.inertia + added,
            ..load
        }
    };
    let map = cycle_map::Machine {
        cycle: machine.cycle(),
        breaks: machine.breaks().to_vec(),
        kinks: machine.kinks().to_vec(),
        at: &at,
    };
    let regime = map.regime()?;
    let motion = map.motion(&regime)?;
    let rows = motion.rows(ROWS);
    let speeds = map.speeds(&regime, ROWS)?;
    let apart = rows.iter().zip(&speeds);
    let apart = apart.map(|(row, speed): (&Row, &f64)| (row.speed / speed - 1.0).abs());
    let apart = apart.fold(0.0, f64::max);
    Ok((regime, motion, apart))
}

/// The regime, with the flywheel where one is asked for.
fn with_flywheel(
    machine: &Machine,
    spec: &SteadySpec,
    control: &Control<'_>,
) -> Result<RigidAnswer, Refusal> {
    let flywheel = match spec.fluctuation {
        None => None,
        Some(wanted) => {
            let go_on = || match control.spent() {
                Some(spent) => Err(Refusal::NoCycle {
                    why: spent.to_string(),
                }),
                None => Ok(()),
            };
            let with = |inertia: f64| match go_on().and_then(|()| regime_with(machine, inertia)) {
                Ok((_, motion, _)) => Ok(Some(motion)),
                Err(Refusal::Stalls { .. }) => Ok(None),
                Err(refusal) => Err(refusal),
            };
            let first = machine.at(0, 0.0, 0.0).inertia.max(1e-9);
            Some(flywheel::size_of(&with, wanted, first)?.0)
        }
    };
    let added = flywheel.as_ref().map_or(0.0, |wheel| wheel.inertia);
    let (regime, motion, apart) = regime_with(machine, added)?;
    let agreement = Agreement {
        equation: motion.check(),
        cycle_map: Some(apart),
        ..Agreement::default()
    };
    Ok(RigidAnswer {
        forces: Forces::Speed,
        cycle: machine.cycle(),
        figures: motion.figures.clone(),
        regime: Some(regime),
        flywheel,
        agreement,
        motion,
    })
}
