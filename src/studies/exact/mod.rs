//! Exact propagation of whole scenes, or of branches beside what is integrated.

mod carried;
mod co_simulation;
mod combined_record;
mod coupled;
mod forces;
mod lever;
#[cfg(test)]
mod many_tests;
#[cfg(test)]
mod mixed_tests;
mod remainder;
mod smooth;
#[cfg(test)]
mod tests;
mod turn;

use crate::dynamics::integrate::{
    Dynamics, Limits, Modes, Outcome, Sink, Statistics, Stop, SwitchEvent,
};
use crate::dynamics::record::{RecorderSettings, RunRecord};
use crate::dynamics::system::{InitialState, System};
use crate::exact::event_loop::{Branch, Clock, EventLoop, Listener, Motion, Schedule};
use crate::exact::{ExactTree, KeptLaws, Part, Parts, Request, RequestedFigures, Rest};
use crate::fault::Fault;
use co_simulation::CoSimulation;
use combined_record::CombinedRecord;

/// The parts of a system, if all of it can be propagated exactly.
///
/// # Errors
/// A fault for every object that stands against it, naming the reason.
pub fn exact_parts(system: &System) -> Result<Parts, Vec<Fault>> {
    whole_with(system, &mut KeptLaws::default())
}

/// The parts of a system, with the laws of a system before that moves by the same ones.
///
/// # Errors
/// As [`exact_parts`].
pub fn whole_with(system: &System, laws: &mut KeptLaws) -> Result<Parts, Vec<Fault>> {
    let parts = Parts::with_laws(system, laws);
    if parts.is_whole() {
        // The extremes of such a load are searched for by what is integrated alone.
        if let Some(object) = parts.expression_outside(system.model()) {
            let id = &system.model().objects[object].id;
            return Err(vec![fault(id, "a load by an expression on a rigid object")]);
        }
        return match parts.are_independent(system) {
            true => Ok(parts),
            false => Err(vec![fault(
                "drives",
                "a load on something prescribed depends on what moves elastically",
            )]),
        };
    }
    let faults: Vec<Fault> = parts
        .refusals
        .iter()
        .map(|refusal| fault(&refusal.object, &refusal.reason))
        .collect();
    if faults.is_empty() {
        return Err(vec![Fault::new(
            "run.method",
            "`exact` cannot be used: nothing is elastic",
            "\"auto\": the motion follows from the drives",
        )]);
    }
    Err(faults)
}

/// The parts of a system, with the modes tried that a run may meet.
///
/// # Errors
/// As [`exact_parts`]; or the modes of a tree cannot be separated.
pub(super) fn parts_with_tried_modes(system: &System) -> Result<Parts, Vec<Fault>> {
    let mut parts = exact_parts(system)?;
    let still = vec![0.0; 2 * system.coordinates()];
    for part in &mut parts.trees {
        if let Err(refusal) = part.try_modes(&still) {
            let id = &system.model().objects[part.objects[0]].id;
            return Err(vec![fault(id, &refusal.reason)]);
        }
    }
    Ok(parts)
}

fn fault(object: &str, reason: &str) -> Fault {
    Fault::new(
        "run.method",
        format!("`exact` cannot be used: {object}: {reason}"),
        "\"auto\", or another method",
    )
}

/// A system of which some branches are propagated exactly, and the rest is not.
#[derive(Debug)]
pub struct Mixed {
    /// The branches, and why the rest is not among them.
    pub parts: Parts,
    /// The rest.
    pub rest: Rest,
}

/// Takes a system apart into branches that can be propagated exactly and a
/// rest; `None` where there is no such branch, or nothing but branches.
pub fn mixed(system: &System) -> Option<Mixed> {
    let parts = Parts::of(system).with_sound_trees(system);
    let rest = Rest::of(system, &parts)?;
    Some(Mixed { parts, rest })
}

/// Findings about a motion.
#[derive(Clone, Debug)]
pub(super) struct MotionFindings {
    /// Samples, figures, audit.
    pub(super) recorded: RunRecord,
    /// Outcome: how it ended.
    pub(super) outcome: Outcome,
    /// Steps of the search over which a pair could not be told from its flank: there the
    /// count of switches is not guaranteed.
    pub(super) grazing: u64,
}

/// Demand on a run: `None`: the figures of all objects and the energy audit; otherwise
/// the figures that are named for each elastic object of the model, and nothing of
/// others.
pub(super) type Wanted<'w> = Option<&'w dyn Fn(usize) -> RequestedFigures>;

fn request(part: &Part, limits: &Limits<'_>, end: f64, wanted: Wanted<'_>) -> Request {
    let asked = wanted.and_then(|wanted| {
        let each = part.objects.iter().map(|&object| wanted(object));
        each.reduce(RequestedFigures::union)
    });
    Request {
        switches: limits.switches,
        all_steps: limits.steps,
        figures: true,
        asked: asked.unwrap_or(RequestedFigures::ALL),
        audit: wanted.is_none(),
        ..Request::new(end, 0)
    }
}

/// The trees at their start.
fn trees(parts: &Parts, initial: &InitialState) -> Vec<ExactTree> {
    let trees = parts.trees.iter();
    trees.map(|part| part.tree(&initial.y)).collect()
}

/// Follows a whole system to the end that `settings` name.
pub(super) fn run_whole_system(
    system: &System,
    parts: &Parts,
    initial: &InitialState,
    settings: RecorderSettings,
    limits: &Limits<'_>,
    wanted: Wanted<'_>,
    sink: &mut dyn Sink,
) -> MotionFindings {
    let rest = match wanted {
        None => Rest::outside_trees(system, parts),
        Some(_) => None,
    };
    let trees = trees(parts, initial);
    let end = settings.duration;
    let way = Schedule {
        system,
        parts,
        trees: &trees,
        initial,
        end,
        whole: wanted.is_none() || settings.samples > 0,
    };
    let clock = Clock::new(limits);
    let goes_on = || clock.is_running();
    let request = |number: usize| request(&parts.trees[number], limits, end, wanted);
    let mut joint = CombinedRecord::new(
        (way, &goes_on),
        settings,
        rest.as_ref().map(|rest| (rest, false)),
        sink,
    );
    let mut walk = match EventLoop::new(way, &request, &clock, &goes_on) {
        Ok(walk) => walk,
        Err(stop) => return never_begun(joint, initial, stop),
    };
    walk.begin_phases(&mut joint);
    while walk.is_running(end) {
        walk.advance_to_next_event(end, None, &mut joint);
        joint.passes(walk.time(), walk.switches());
    }
    finish(walk, joint)
}

fn finish(mut walk: EventLoop<'_>, mut joint: CombinedRecord<'_>) -> MotionFindings {
    let outcome = walk.outcome();
    walk.report_cut_phases(&mut joint);
    let (y, modes) = walk.current_state(None);
    let (y, modes) = (y.to_vec(), modes.clone());
    let grazing = walk.grazing();
    let recorded = joint.finish(walk.time(), (&y, &modes), walk.branches());
    MotionFindings {
        recorded,
        outcome,
        grazing,
    }
}

/// Deviations of the elastic objects of a system, and its switches.
#[derive(Clone, Debug)]
pub(super) struct Deviations {
    /// Object (index in the model) and δ at the ends of equal intervals (t = 0 is not
    /// among them), as far as the run went.
    pub(super) samples: Vec<(usize, Vec<f64>)>,
    /// Times of all events (s).
    pub(super) switches: Vec<f64>,
    /// Outcome: how it ended.
    pub(super) outcome: Outcome,
}

/// Follows a whole system to `end` (s) for nothing but the deviations at the ends of
/// `count` equal intervals.
pub(super) fn deviations(
    system: &System,
    parts: &Parts,
    initial: &InitialState,
    (end, count): (f64, usize),
    limits: &Limits<'_>,
) -> Deviations {
    let trees = trees(parts, initial);
    let way = Schedule {
        system,
        parts,
        trees: &trees,
        initial,
        end,
        whole: false,
    };
    let clock = Clock::new(limits);
    let goes_on = || clock.is_running();
    let request = |number: usize| Request {
        switches: limits.switches,
        all_steps: limits.steps,
        all_masses: !samples_last_mass_only(&parts.trees[number]),
        ..Request::new(end, count)
    };
    let mut heard = EventTimes(Vec::new());
    let mut walk = match EventLoop::new(way, &request, &clock, &goes_on) {
        Ok(walk) => walk,
        Err(stop) => {
            return Deviations {
                samples: Vec::new(),
                switches: Vec::new(),
                outcome: ended_at_start(stop),
            };
        }
    };
    walk.begin_phases(&mut heard);
    walk.advance_to(end, None, &mut heard);
    let outcome = walk.outcome();
    walk.report_cut_phases(&mut heard);
    let branches = walk.branches().iter();
    Deviations {
        samples: branches.flat_map(sampled_deviations).collect(),
        switches: heard.0,
        outcome,
    }
}

/// True when the tree's last mass is all that is sampled.
fn samples_last_mass_only(part: &Part) -> bool {
    let objects = &part.problem().objects;
    let last = part.problem().masses.len() - 1;
    matches!(&objects[..], [only] if only.output == [(last, 1.0)] && only.driver.is_none())
}

/// δ of the objects of a tree, from its samples.
fn sampled_deviations<'b>(branch: &'b Branch<'_>) -> impl Iterator<Item = (usize, Vec<f64>)> + 'b {
    let part = branch.part;
    let samples = branch.cursor.samples();
    let columns = 2 * part.problem().masses.len();
    let objects = part.objects.iter().zip(&part.problem().objects);
    objects.map(move |(&object, place)| {
        if samples_last_mass_only(part) {
            return (object, samples.to_vec());
        }
        let delta = |row: &[f64]| {
            let base = place.driver.map_or(0.0, |(mass, ratio)| ratio * row[mass]);
            let output = place.output.iter();
            output.map(|&(mass, share)| share * row[mass]).sum::<f64>() - base
        };
        (object, samples.chunks_exact(columns).map(delta).collect())
    })
}

/// Hears of the switches of pairs alone.
struct EventTimes(Vec<f64>);

impl Listener for EventTimes {
    fn start(&mut self, _y: &[f64], _modes: &Modes) {}

    fn reset_tree(&mut self, _number: usize) {}

    fn phase(&mut self, _number: usize, _branch: &mut Branch<'_>) {}

    fn stretch(&mut self, _motion: &mut Motion<'_, '_>, _span: [f64; 2], _modes: &Modes) {}

    fn switch(&mut self, event: &SwitchEvent<'_>) {
        self.0.push(event.time);
    }
}

fn ended_at_start(stop: Stop) -> Outcome {
    Outcome {
        time: 0.0,
        stop,
        statistics: Statistics::default(),
    }
}

/// A run whose trees have no start.
fn never_begun(
    mut joint: CombinedRecord<'_>,
    initial: &InitialState,
    stop: Stop,
) -> MotionFindings {
    joint.start(&initial.y, &initial.modes);
    MotionFindings {
        recorded: joint.finish(0.0, (&initial.y, &initial.modes), &mut []),
        outcome: ended_at_start(stop),
        grazing: 0,
    }
}

/// Follows the branches of a system beside its rest, which `integrate` integrates from
/// the state that it is given into the sink that it is given.
///
/// Ends where either does. Trees that give up are not waited for: their reason is that
/// of the whole.
pub(super) fn propagate_with_remainder(
    system: &System,
    (parts, rest): (&Parts, &Rest),
    initial: &InitialState,
    settings: RecorderSettings,
    limits: &Limits<'_>,
    sink: &mut dyn Sink,
    integrate: impl FnOnce(&InitialState, &mut dyn Sink) -> Outcome,
) -> MotionFindings {
    let trees = trees(parts, initial);
    let end = settings.duration;
    let way = Schedule {
        system,
        parts,
        trees: &trees,
        initial,
        end,
        whole: true,
    };
    let clock = Clock::new(limits);
    let goes_on = || clock.is_running();
    let request = |number: usize| request(&parts.trees[number], limits, end, None);
    let joint = CombinedRecord::new((way, &goes_on), settings, Some((rest, true)), sink);
    let walk = match EventLoop::new(way, &request, &clock, &goes_on) {
        Ok(walk) => walk,
        Err(stop) => return never_begun(joint, initial, stop),
    };
    let mut duet = CoSimulation::new(rest, walk, joint);
    let own = integrate(&rest.initial(initial), &mut duet);
    duet.finish(own)
}
