//! The steady motion of a machine whose motor gives way and whose objects yield.
//!
//! The drive's angle takes the place of time: a state that comes back after a cycle of
//! it is a steady motion, and the time for the cycle a result. Nothing in such a machine
//! may depend on time itself.

use super::answer::DriveFigures;
use super::answer::DriveRow;
use super::answer::StartOf;
use super::cycle::{AFTER_A_CYCLE, Rhythms};
use super::flywheel::{WheelRequest, WheelResult};
use super::machine::{multi_input_objects, nodes_moved_by, over_time};
use super::map::Map;
use super::mean_speed::{AddedDrive, with_added};
use super::periodic::{About, ORBIT, PeriodicAnswer, no_periodic_motion, part_near, state_names};
use super::phase::PhaseMap;
use super::portrait::{Portrait, Row};
use crate::dynamics::integrate::Dynamics;
use crate::dynamics::model::Model;
use crate::dynamics::steady::Means;
use crate::dynamics::system::System;
use crate::fault::Fault;
use crate::frontend::scene::SteadySpec;
use crate::studies::method::choose_general;
use crate::studies::{Control, RunSettings};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Share of a coordinate's usual accelerations that counts where it moves evenly.
const SHARE_OF_SCALE: f64 = 1e-3;
/// Places of a cycle at which accelerations are compared with those a cycle later.
const LOOKS: usize = 97;

/// Faults of a question that a motor and elastic objects leave half open.
fn contradictions(model: &Model, drive: usize, spec: &SteadySpec) -> Vec<Fault> {
    let id = &model.objects[drive].id;
    let fault = |name: &str, message: String, hint: &str| {
        vec![Fault::new(format!("steady.{name}"), message, hint)]
    };
    match (spec.mean_speed, spec.balance) {
        (Some(_), false) => fault(
            "mean_speed",
            format!(
                "the mean speed of `{id}` is a result of its motor and of what it carries, losses \
                 in elastic objects included: none can be prescribed as they are"
            ),
            "`balance` adds the constant moment beside the motor that holds this mean speed; or \
             leave `mean_speed` out",
        ),
        (None, true) => fault(
            "balance",
            format!(
                "a constant moment beside the motor of `{id}` is found for a mean speed, and none \
                 is given"
            ),
            "\"steady\": { \"mean_speed\": \"300 rpm\" }, or --mean-speed \"300 rpm\"; without \
             `balance` motor and load balance the cycle by themselves",
        ),
        _ => Vec::new(),
    }
}

/// Faults that stand against a steady motion of everything behind a motor.
fn obstacles(model: &Model, drive: usize, moved: &[bool]) -> Vec<Fault> {
    let others = model.objects.iter().enumerate();
    let others = others.filter(|(index, part)| part.is_drive() && *index != drive);
    let id = &model.objects[drive].id;
    let mut faults: Vec<Fault> = others
        .map(|(_, other)| {
            let message = format!(
                "`{}` turns beside `{id}`: a motor keeps no pace with another drive, so nothing \
                 repeats that depends on both",
                other.id
            );
            let hint = format!("a scene of `{id}` and of what it drives alone");
            Fault::new(&other.id, message, hint)
        })
        .collect();
    faults.extend(multi_input_objects(model, moved));
    faults.extend(over_time(model, moved));
    faults
}

/// The angle after which the machine repeats (rad).
fn cycle(model: &Model, drive: usize, moved: &[bool], least: f64) -> Result<f64, Vec<Fault>> {
    let rhythms = Rhythms::rhythms_behind_drive(model, model.objects[drive].nodes[0], moved);
    if !rhythms.growing.is_empty() {
        return Err(rhythms.growing);
    }
    rhythms.cycle_of_motor(least).ok_or_else(|| {
        let message = "its ratios bring the machine back to where it was after no angle of the \
                       drive up to 100 turns";
        let hint = "ratios of whole numbers of teeth, \"ratio\": 0.4878048780487805 for 20/41, \
                    and a `cycle` of whole turns";
        vec![Fault::new("steady.cycle", message, hint)]
    })
}

/// Everything must be the same a cycle later: looked at with the deviations of a state.
fn check_cycle(
    system: &System,
    map: &PhaseMap<'_>,
    state: &[f64],
    cycle: f64,
) -> Result<(), Vec<Fault>> {
    let count = system.coordinates();
    let mut scratch = system.scratch();
    let mut at = |angle: f64| {
        let y = map.full_state(state, angle);
        let modes = system.modes_at_start(&y);
        let mut dy = vec![0.0; y.len()];
        system.derivatives(0.0, &y, &modes, &mut scratch, &mut dy);
        dy.split_off(count)
    };
    let mut sizes = vec![0.0f64; count];
    let mut worst = vec![0.0f64; count];
    for look in 0..LOOKS {
        // (Not at round places, where formulas like to change.)
        let angle = cycle * (look as f64 + 0.381_966) / LOOKS as f64;
        let (now, then) = (at(angle), at(angle + cycle));
        for index in 0..count {
            sizes[index] = sizes[index].max(now[index].abs());
            worst[index] = worst[index].max((now[index] - then[index]).abs());
        }
    }
    // What moves evenly has accelerations of nothing but rounding.
    let turn = map.nominal_speed();
    let usual = |index: usize| SHARE_OF_SCALE * system.scales()[count + index] * turn;
    let astray =
        (0..count).find(|&index| !(worst[index] <= AFTER_A_CYCLE * (sizes[index] + usual(index))));
    astray.map_or(Ok(()), |index| {
        let name = system.state_name(index).replace(": displacement", "");
        let message = format!(
            "after {} turns of the drive `{name}` is not accelerated as before: the machine does \
             not repeat",
            cycle / TAU
        );
        let hint = "the angle of the drive after which the machine repeats: \"720 deg\", say";
        Err(vec![Fault::new("steady.cycle", message, hint)])
    })
}

/// The state at φ = 0 in absolute displacements and speeds.
fn start_of(system: &System, y: &[f64]) -> BTreeMap<String, StartOf> {
    let model = system.model();
    let modes = system.modes_at_start(y);
    let mut scratch = system.scratch();
    let mut objects = vec![crate::dynamics::system::ObjectState::default(); model.objects.len()];
    system.observe(0.0, y, &modes, &mut scratch, &mut objects);
    let count = (0..model.objects.len()).map(|object| system.masses(object));
    let mut masses = vec![crate::dynamics::system::MassState::default(); count.sum()];
    system.observe_masses(y, &modes, &scratch, &mut masses);
    let mut masses = masses.into_iter();
    let mut found = BTreeMap::new();
    for (object, part) in model.objects.iter().enumerate() {
        let own: Vec<[f64; 2]> = match system.masses(object) {
            0 if system.last_coordinate(object).is_none() => continue,
            0 => vec![[objects[object].displacement, objects[object].speed]],
            count => {
                let own = masses.by_ref().take(count);
                own.map(|mass| [mass.displacement, mass.speed]).collect()
            }
        };
        let start = StartOf {
            displacement: own.iter().map(|one| one[0]).collect(),
            speed: own.iter().map(|one| one[1]).collect(),
        };
        found.insert(part.id.clone(), start);
    }
    found
}

/// The figures of the drive.
fn figures(
    system: &System,
    drive: usize,
    y: &[f64],
    portrait: &Portrait<'_>,
    angle: f64,
) -> DriveFigures {
    let rotor = system.last_coordinate(drive);
    let row = |row: &Row| DriveRow {
        position: row.position,
        time: row.time,
        speed: row.speed,
        acceleration: row.acceleration,
        deviations: (0..system.coordinates())
            .filter(|&one| Some(one) != rotor)
            .map(|one| row.y[one])
            .collect(),
    };
    let rows: Vec<DriveRow> = portrait.rows.iter().map(row).collect();
    let period = rows.last().map_or(f64::NAN, |row| row.time);
    let (least, greatest) = (portrait.least, portrait.greatest);
    let means = Means {
        time: angle / period,
        angle: portrait.speed_by_angle / angle,
        midrange: 0.5 * (least.value + greatest.value),
    };
    DriveFigures {
        id: system.model().objects[drive].id.clone(),
        means,
        least_speed: least,
        greatest_speed: greatest,
        speed_at_start: rows.first().map_or(f64::NAN, |row| row.speed),
        fluctuation: (greatest.value - least.value) / means.time,
        balance: None,
        flywheel: None,
        start: start_of(system, y),
        rows,
    }
}

/// The steady motion behind a motor with the coordinate `rotor`.
///
/// # Errors
/// What stands against it, there is no start, or no periodic motion was found.
pub(super) fn answer(
    system: &System,
    drive: usize,
    rotor: usize,
    settings: &RunSettings,
    spec: &SteadySpec,
    control: &Control<'_>,
) -> Result<PeriodicAnswer, Vec<Fault>> {
    let model = system.model();
    let moved = nodes_moved_by(model, model.objects[drive].nodes[0]);
    let mut faults = contradictions(model, drive, spec);
    faults.extend(obstacles(model, drive, &moved));
    if !faults.is_empty() {
        return Err(faults);
    }
    let cycle = cycle(model, drive, &moved, spec.cycle)?;
    let initial = system.initial_state()?;
    let none = |why: String| no_periodic_motion(&why);
    let method = choose_general(system, settings, "").method;
    let map = PhaseMap::new(system, rotor, method, *control);
    let start = map.to_section(&initial.y, cycle).map_err(|why| {
        let message = format!("the machine does not get through its first cycle: {why}");
        let hint = "a stronger motor, a lighter load, another speed at the start";
        vec![Fault::new("steady", message, hint)]
    })?;
    check_cycle(system, &map, &start, cycle)?;
    let machine = WheelRequest {
        model,
        drive,
        rotor,
        spec,
        method,
        budget: *control,
        start: &start,
        cycle,
    };
    let found = match (spec.balance, spec.fluctuation) {
        (false, None) => WheelResult::default(),
        _ => machine.solve()?,
    };
    let own;
    let system = match found.added == AddedDrive::default() {
        true => system,
        false => {
            own = with_added(model, drive, found.added)?;
            &own
        }
    };
    let map = PhaseMap::new(system, rotor, method, *control);
    let about = About::of_all(system, Some(rotor));
    let known = found.state.as_deref();
    let (motion, state) =
        part_near(&map, &start, known, cycle, spec.periods, &about).map_err(none)?;
    let angle = cycle * motion.periods as f64;
    let portrait = map.portrait(&state, angle, ORBIT).map_err(none)?;
    let y = map.full_state(&state, 0.0);
    let turn = map.duration(&state, cycle).map_err(none)?;
    let period = motion.period;
    let answer = PeriodicAnswer {
        cycle,
        turn,
        drive: Some(DriveFigures {
            balance: spec.balance.then_some(found.added.moment),
            flywheel: found.flywheel,
            ..figures(system, drive, &y, &portrait, angle)
        }),
        parts: vec![motion],
        state_names: state_names(system),
        state: y,
        over_period: None,
        over_period_missing: None,
    };
    Ok(answer.with_period_results(system, method, control, period))
}
