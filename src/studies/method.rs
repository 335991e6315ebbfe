//! Which method a run takes, and why.

use super::choice::Choice;
use super::choice::single_method;
use super::demand::Demand;
use super::document::can_open;
use super::exact::{Mixed, mixed, parts_with_tried_modes};
use super::settings::RunSettings;
use super::warning::Warning;
use crate::dynamics::energy::EnergyAudit;
use crate::dynamics::integrate::{
    Dynamics, Method, MethodChoice, Reserve, Situation, Vibration, choose,
};
use crate::dynamics::model::{Model, NodeMotion, Start};
use crate::dynamics::system::{MANY_COORDINATES, System};
use crate::exact::Parts;
use crate::fault::Fault;

/// Instants at which the speed of a prescribed drive is looked at.
const LOOKS: usize = 64;

/// A mode belongs to a base frequency within this factor.
const SAME_BASE: f64 = 3.0;

/// The method asked for, or the one that suits the system.
///
/// # Errors
/// `exact` is asked for and cannot be used, with every reason.
pub(super) fn choose_method(
    system: &System,
    settings: &RunSettings,
    demand: &Demand<'_>,
) -> Result<Choice, Vec<Fault>> {
    if system.coordinates() == 0 {
        let why = "nothing is elastic: the motion follows from the drives";
        return Ok(Choice {
            name: "kinematic".to_owned(),
            ..Choice::single_method(Method::Dop853, settings, why)
        });
    }
    if demand.figures.is_some()
        && matches!(settings.method, None | Some(Method::Exact))
        && let Ok(parts) = demand.exact_parts(system)
    {
        return Ok(Choice::exact(parts, settings, "it is the quickest"));
    }
    match settings.method {
        Some(Method::Taylor) => match ids_with_friction(system) {
            Some(ids) => Err(vec![Fault::new(
                "run.method",
                format!("`taylor` cannot be used: the friction of {ids} has no power series"),
                "auto, dop853, dopri5, rodas5p or radau",
            )]),
            None => match system.without_series() {
                Some(what) => Err(vec![Fault::new(
                    "run.method",
                    format!("`taylor` cannot be used: {what} has no power series"),
                    "auto, dop853, dopri5, rodas5p or radau",
                )]),
                None => Ok(Choice::single_method(Method::Taylor, settings, "asked for")),
            },
        },
        Some(Method::Exact) => Ok(Choice::exact(
            parts_with_tried_modes(system)?,
            settings,
            "asked for",
        )),
        Some(method) => Ok(Choice::single_method(method, settings, "asked for")),
        None => Ok(match parts_with_tried_modes(system) {
            Ok(parts) => {
                let why = why_exact(&parts);
                Choice::exact(parts, settings, &why)
            }
            Err(_) => match mixed(system) {
                Some(mixed) => choose_for_remainder(system, settings, mixed),
                None => Choice::one_method(choose(&situation(system, settings))),
            },
        }),
    }
}

/// The linkages whose joints have friction, in words; `None` without any.
fn ids_with_friction(system: &System) -> Option<String> {
    let objects = system.objects_with_friction();
    let ids: Vec<&str> = objects
        .map(|(object, _)| system.model().objects[object].id.as_str())
        .collect();
    (!ids.is_empty()).then(|| ids.join(", "))
}

/// Exact propagation of some branches, and the method for the rest.
fn choose_for_remainder(system: &System, settings: &RunSettings, mixed: Mixed) -> Choice {
    let Mixed { parts, rest } = mixed;
    let own = &rest.system;
    let chosen = match own.coordinates() {
        0 => {
            let why = "its motion follows from the drives";
            single_method(Method::Dop853, settings, why)
        }
        _ => choose(&situation(own, settings)),
    };
    let ids = |objects: &mut dyn Iterator<Item = &String>| {
        let all: Vec<&str> = objects.map(String::as_str).collect();
        all.join(", ")
    };
    let held = parts.trees.iter().flat_map(|part| &part.objects);
    let mut held: Vec<&String> = held
        .map(|&object| &system.model().objects[object].id)
        .collect();
    held.sort();
    let others = own.model().objects.iter().enumerate();
    let moves = |object: usize| own.last_coordinate(object).is_some();
    let others = others.filter(|(object, part)| !part.is_drive() || moves(*object));
    let because: Vec<String> = parts
        .refusals
        .iter()
        .map(|refusal| format!("{}: {}", refusal.object, refusal.reason))
        .collect();
    let why = format!(
        "exact propagation of {}, known in closed form between events; {} for {} ({}): {}",
        ids(&mut held.into_iter()),
        chosen.method,
        ids(&mut others.map(|(_, part)| &part.id)),
        because.join("; "),
        chosen.why,
    );
    Choice {
        name: format!("{} + {}", Method::Exact, chosen.method),
        parts: Some(parts),
        rest: Some(rest),
        ..Choice::one_method(MethodChoice { why, ..chosen })
    }
}

/// A general method, where exact propagation would have been the choice.
pub(super) fn choose_general(system: &System, settings: &RunSettings, because: &str) -> Choice {
    let chosen = choose(&situation(system, settings));
    let why = format!("{because}; {}", chosen.why);
    Choice::one_method(MethodChoice { why, ..chosen })
}

/// The next general method, where the results of those that were tried are in doubt; `None`
/// when all have been tried.
pub(super) fn choose_next(
    system: &System,
    settings: &RunSettings,
    because: &str,
    tried: &[Method],
) -> Option<Choice> {
    if system.coordinates() == 0 {
        return None;
    }
    let chosen = choose(&situation(system, settings));
    let first = Reserve {
        method: chosen.method,
        tolerance: chosen.tolerance,
    };
    let mut left = std::iter::once(first)
        .chain(chosen.reserve.iter().copied())
        .filter(|own| !tried.contains(&own.method));
    let next = left.next()?;
    let why = match next == first {
        true => format!("{because}; {}", chosen.why),
        false => format!("{because}; {} instead", next.method),
    };
    Some(Choice::one_method(MethodChoice {
        method: next.method,
        tolerance: next.tolerance,
        reserve: left.collect(),
        why,
    }))
}

/// Why a system is propagated exactly.
fn why_exact(parts: &Parts) -> String {
    let trees = match parts.trees.len() {
        1 => String::new(),
        count => format!(" in each of {count} branches"),
    };
    format!(
        "between events the motion{trees} is linear and its drive is prescribed: it is known in \
         closed form, and only the events are searched for"
    )
}

/// Fastest rate of a system (1/s), and all eigenvalues where they are not too many.
fn rates(system: &System) -> (f64, Option<Vec<[f64; 2]>>) {
    let few = system.coordinates() <= MANY_COORDINATES;
    let eigenvalues = few.then(|| system.eigenvalues()).flatten();
    let size = |[re, im]: &[f64; 2]| re.hypot(*im);
    let fastest = match &eigenvalues {
        Some(values) => values.iter().map(size).fold(0.0, f64::max),
        None => system.fastest_rate(),
    };
    (fastest, eigenvalues)
}

/// What a step of `rk4` (s) leaves of a vibration's phase: (ω·h)⁵/120 in a step, from
/// e^{iωh} and its series to the fourth power.
///
/// Nothing where it is within what the balance of the energies allows at the tolerance.
pub(super) fn fixed_step(system: &System, settings: &RunSettings, step: f64) -> Option<Warning> {
    let (fastest, _) = rates(system);
    let phase = fastest * settings.duration * (fastest * step).powi(4) / 120.0;
    let allowed = EnergyAudit::bound(settings.tolerance);
    (phase > allowed).then(|| Warning::FixedStep {
        fastest,
        phase,
        step: step * (allowed / phase).powf(0.25),
    })
}

/// Situation on which the choice depends.
fn situation(system: &System, settings: &RunSettings) -> Situation {
    let (fastest, eigenvalues) = rates(system);
    let modes = eigenvalues.unwrap_or_default();
    let duration = settings.duration;
    let vibrations = vibration_frequencies(system).map(|frequency| nearest_mode(frequency, &modes));
    let turning = driving_speeds(system, duration).fold(0.0, f64::max);
    Situation {
        fastest,
        vibrations: vibrations.collect(),
        turning,
        has_variable_ratio: system.has_variable_ratio(),
        way: system.series_range_of_laws(turning * duration),
        breaks: system.breaks_passed(duration),
        expands: system.expands(),
        corners: system.has_corners(),
        joint_friction: system.has_multi_input_friction(),
        tolerance: settings.tolerance,
        coordinates: system.coordinates(),
        duration,
    }
}

/// The mode that a base frequency (rad/s) has become in the whole mechanism; an
/// undamped vibration where there is none near it.
fn nearest_mode(frequency: f64, eigenvalues: &[[f64; 2]]) -> Vibration {
    let modes = eigenvalues.iter().filter(|[_, im]| *im > 0.0);
    let modes = modes.map(|[re, im]| Vibration {
        frequency: re.hypot(*im),
        decay: (-re).max(0.0),
    });
    let distance = |mode: &Vibration| (mode.frequency / frequency).ln().abs();
    let nearest = modes.min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let fit = nearest.filter(|mode| distance(mode) <= SAME_BASE.ln());
    fit.unwrap_or(Vibration {
        frequency,
        decay: 0.0,
    })
}

/// Greatest speeds of turning drives (rad/s): the lowest harmonic of their laws.
fn driving_speeds(system: &System, duration: f64) -> impl Iterator<Item = f64> {
    let model = system.model();
    let drives = model.objects.iter().enumerate();
    drives
        .filter(|(_, part)| part.is_drive())
        .map(
            move |(object, part)| match &model.nodes[part.nodes[0]].motion {
                NodeMotion::Prescribed { motion, .. } => {
                    let breaks = motion.breaks();
                    (0..=LOOKS)
                        .map(|look| duration * look as f64 / LOOKS as f64)
                        .map(|time| motion.jet(breaks.segment_at(time, 1.0), time).first.abs())
                        .fold(0.0, f64::max)
                }
                // The scale of a rotor's speed is its nominal speed.
                _ => system
                    .last_coordinate(object)
                    .map_or(0.0, |rotor| system.scales()[system.coordinates() + rotor]),
            },
        )
        // A drive that is held has none.
        .filter(|speed| *speed > 0.0)
}

/// Base frequencies √(c/J) (rad/s) of the objects whose vibration is part of
/// the motion: those whose contact comes and goes, and all when the start is
/// not the quiet one. (The scale of an object's speed is that of its deviation
/// times its base frequency.)
fn vibration_frequencies(system: &System) -> impl Iterator<Item = f64> {
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
