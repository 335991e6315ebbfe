//! Which contacts stick, and which slide to which side, where one stops or breaks loose.

use super::at_rest::{AtRest, EXCESS, SINGULAR, UNFELT};
use super::hold::{find_rates, mobility, root_mass};
use super::{DryContact, engagement};
use crate::dynamics::integrate::PhysicalStop;
use crate::dynamics::system::friction::StickSlip;
use crate::dynamics::system::frozen::Frozen;
use crate::dynamics::system::passes::{Extent, Work};
use crate::dynamics::system::{Scratch, System};
use crate::units::shown;
use nalgebra::{DMatrix, DVector};

/// Speeds at t = 0 below this share of what they are the sum of are rest.
const AT_REST: f64 = 1e-13;
/// Most that the speed of a contact that has just stopped may be off, as a share of the scale of
/// the speeds that it is made of.
const LEFT: f64 = 1e-6;
/// A moment later: the time in which a speed changes by this share of its scale.
const LATER: f64 = 1e-4;
/// Share of the ratio a moment later below which it vanishes: a dead centre.
const DEAD: f64 = 1e-3;
/// The same, of what is nothing but rounding.
const NOTHING: f64 = 4.0 * f64::EPSILON;
/// Share of the accelerations that forces at rest may leave before a contact is torn off, and the
/// same of the acceleration that its limit gives: rounding, where nothing pulls at it.
const TORN: f64 = 1e-6;
const UNPULLED: f64 = 1e-12;
/// Rounds in which the rounding of speeds is taken away.
const ROUNDS: usize = 8;
/// Speeds below this share of what they are the sum of are rest, where another contact stops.
const ROUNDING: f64 = 1e-12;

/// How far a contact at rest is beyond its limit, as a share of it: positive where it breaks
/// loose.
pub(in crate::dynamics::system) fn excess(
    frozen: &Frozen,
    index: usize,
    (time, state): (f64, &[f64]),
    modes: &[i64],
    work: &mut Work<f64>,
) -> f64 {
    let mut out = std::mem::take(&mut work.parting);
    frozen.evaluate(time, state, modes, Extent::Needed, work, &mut out);
    work.parting = out;
    let place = work.dry.held.iter().position(|&held| held == index);
    let share = place.map_or(0.0, |place| work.dry.share[place]);
    if share.is_nan() {
        // Nothing moves it that its force could hold.
        return unheld(frozen, index, work);
    }
    // (Two contacts hold a body on different bodies, one of which moves off.)
    let left = &work.dry.left[..work.dry.held.len()];
    let size = left
        .iter()
        .fold(0.0, |size: f64, left| size.max(left.abs()));
    let contact = &frozen.dry[index];
    let strength = contact.friction.static_limit * mobility(frozen, [index, index], work);
    match work.acceleration[contact.node].abs() > TORN * size + UNPULLED * strength {
        true => 1.0,
        false => {
            let engaged = engagement(frozen, index, (time, modes), work);
            share.abs() - engaged * (1.0 + EXCESS) - UNFELT
        }
    }
}

/// Positive where a contact without any grip is accelerated.
fn unheld(frozen: &Frozen, index: usize, work: &Work<f64>) -> f64 {
    match work.acceleration[frozen.dry[index].node] {
        0.0 => -1.0,
        _ => 1.0,
    }
}

/// Contacts with what their forces do, none of them having any; takes the speeds of their
/// nodes out of the state.
fn bring_to_rest(
    system: &System,
    contacts: Vec<usize>,
    (time, y): (f64, &mut [f64]),
    modes: &mut [i64],
) -> AtRest {
    let frozen = &system.frozen;
    let mut work = Work::new(frozen);
    let mut out = vec![0.0; frozen.coordinates];
    for &contact in &contacts {
        if let Some(component) = frozen.dry[contact].component {
            modes[component] = StickSlip::Unset.mode();
        }
    }
    frozen.evaluate(time, y, modes, Extent::Full, &mut work, &mut out);
    for &contact in &contacts {
        find_rates(frozen, contact, &mut work);
    }
    let limits: Vec<f64> = (contacts.iter())
        .map(|&contact| frozen.dry[contact].friction.static_limit)
        .collect();
    let count = contacts.len();
    let mobility = DMatrix::from_fn(count, count, |row, column| {
        limits[column] * mobility(frozen, [contacts[row], contacts[column]], &work)
    });
    let speeds = DVector::from_fn(count, |k, _| work.speed[frozen.dry[contacts[k]].node]);
    let singular = mobility.clone().svd(true, true);
    let least = SINGULAR * singular.singular_values.max();
    if let Ok(shares) = singular.solve(&speeds, least)
        && speeds.amax() > 0.0
        && shares.iter().all(|share| share.is_finite())
    {
        let mut stopped = y.to_vec();
        for (k, &contact) in contacts.iter().enumerate() {
            let impulse = -limits[k] * shares[k];
            change_speeds(frozen, contact, impulse, &mut stopped, &work);
        }
        // (More than that is no rest: the ratio vanishes in a dead centre, and the shaft goes on.)
        let small = is_within(system, y, &stopped, LEFT);
        if small && !is_within(system, y, &stopped, NOTHING) {
            y.copy_from_slice(&stopped);
            frozen.evaluate(time, y, modes, Extent::Full, &mut work, &mut out);
        }
    }
    let begins = contacts.iter().map(|&contact| {
        let friction = &frozen.dry[contact].friction;
        friction.at_speed(0.0)[0] / friction.static_limit
    });
    let engaged = contacts
        .iter()
        .map(|&contact| engagement(frozen, contact, (time, modes), &work));
    let engaged: Vec<f64> = engaged.collect();
    AtRest {
        free: DVector::from_fn(count, |k, _| {
            work.acceleration[frozen.dry[contacts[k]].node]
        }),
        begins: begins
            .zip(&engaged)
            .map(|(begins, by)| begins * by)
            .collect(),
        engaged,
        leads: leads(system, &contacts, (time, y, &out), modes, &mut work),
        contacts,
        mobility,
        limits,
    }
}

/// Of every contact whose force moves nothing where it stands, in a dead centre, the side to which
/// its node goes next: by the motion a moment later.
fn leads(
    system: &System,
    contacts: &[usize],
    (time, y, accelerations): (f64, &[f64], &[f64]),
    modes: &[i64],
    work: &mut Work<f64>,
) -> Vec<Option<i8>> {
    let frozen = &system.frozen;
    let grip = |contact: usize, work: &mut Work<f64>| {
        find_rates(frozen, contact, work);
        let rates = &work.dry.rates[contact];
        let free = frozen.dry[contact].free_roots();
        free.map(|place| rates[place].abs()).fold(0.0, f64::max)
    };
    let now: Vec<f64> = contacts.iter().map(|&own| grip(own, work)).collect();
    let count = frozen.coordinates;
    let (u, v) = y.split_at(count);
    let scales = &system.scales_of_state()[count..];
    let moment = (scales.iter().zip(v).zip(accelerations))
        .map(|((scale, v), a)| LATER * scale / (v.abs() + a.abs()))
        .fold(f64::INFINITY, f64::min);
    let moment = if moment.is_finite() { moment } else { 0.0 };
    let places = u.iter().zip(v).zip(accelerations);
    let places = places.map(|((u, v), a)| u + moment * (v + 0.5 * moment * a));
    let speeds = v.iter().zip(accelerations).map(|(v, a)| v + moment * a);
    let later: Vec<f64> = places.chain(speeds).collect();
    frozen.motion(time, &later, modes, Extent::Full, work);
    (contacts.iter().zip(now))
        .map(|(&contact, now)| {
            let then = grip(contact, work);
            let speed = work.speed[frozen.dry[contact].node];
            let lead = if speed < 0.0 { -1 } else { 1 };
            (now <= DEAD * then || then == 0.0).then_some(lead)
        })
        .collect()
}

/// True where two states differ by no more than a share of their scales.
fn is_within(system: &System, one: &[f64], other: &[f64], share: f64) -> bool {
    let mut pairs = one.iter().zip(other).zip(system.scales_of_state());
    pairs.all(|((one, other), scale)| (one - other).abs() <= share * scale)
}

/// What an impulse on the node of a contact does to the speeds of the state.
fn change_speeds(frozen: &Frozen, contact: usize, impulse: f64, y: &mut [f64], work: &Work<f64>) {
    let contact_rates = &work.dry.rates[contact];
    for place in frozen.dry[contact].free_roots() {
        let root = frozen.dry[contact].ancestors[place].node;
        if let Some(coordinate) = frozen.coordinate[root] {
            let change = contact_rates[place] * impulse / root_mass(frozen, root, work);
            y[frozen.coordinates + coordinate] += change;
        }
    }
}

/// Decides what the contacts do that are at rest together with the one of a component, which
/// stops or breaks loose.
///
/// # Errors
/// No combination agrees, or two do.
pub(in crate::dynamics::system) fn decide_on(
    system: &System,
    component: usize,
    (time, y): (f64, &mut [f64]),
    modes: &mut [i64],
) -> Result<(), PhysicalStop> {
    let dry = &system.frozen.dry;
    let own = |contact: &DryContact| contact.component == Some(component);
    let Some(set) = dry.iter().find(|contact| own(contact)).map(|own| own.set) else {
        return Ok(());
    };
    let resting = |contact: &DryContact| {
        contact.set == set
            && contact.component.is_some()
            && (own(contact) || contact.is_stuck(modes))
    };
    let mut contacts: Vec<usize> = (0..dry.len())
        .filter(|&index| resting(&dry[index]))
        .collect();
    loop {
        let at_rest = bring_to_rest(system, contacts.clone(), (time, y), modes);
        let more = also_at_rest(&system.frozen, (set, &contacts), (time, y), modes);
        if more.is_empty() {
            return go_on(system, &at_rest, (time, y), modes);
        }
        contacts.extend(more);
    }
}

/// Contacts of a set that slide, and come to rest with others: on the same mass, say.
fn also_at_rest(
    frozen: &Frozen,
    (set, known): (usize, &[usize]),
    (time, y): (f64, &[f64]),
    modes: &[i64],
) -> Vec<usize> {
    let mut work = Work::new(frozen);
    frozen.motion(time, y, modes, Extent::Full, &mut work);
    let sliding = (0..frozen.dry.len()).filter(|index| {
        let contact = &frozen.dry[*index];
        contact.set == set && contact.component.is_some() && !known.contains(index)
    });
    sliding
        .filter(|&index| {
            let size = speed_size(frozen, index, &mut work);
            work.speed[frozen.dry[index].node].abs() <= ROUNDING * size
        })
        .collect()
}

/// Size of what the speed of a contact is the sum of.
fn speed_size(frozen: &Frozen, index: usize, work: &mut Work<f64>) -> f64 {
    find_rates(frozen, index, work);
    let contact = &frozen.dry[index];
    let parts = contact.ancestors.iter().zip(&work.dry.rates[index]);
    let roots = parts.filter(|(own, _)| matches!(own.source, super::Source::Root { .. }));
    let size = |(own, rate): (&super::Ancestor, &f64)| {
        rate.abs() * (work.speed[own.node].abs() + law_speed(frozen, own.node, work))
    };
    roots.map(size).sum()
}

/// Puts contacts at rest into the states that they go on with.
fn go_on(
    system: &System,
    at_rest: &AtRest,
    (time, y): (f64, &mut [f64]),
    modes: &mut [i64],
) -> Result<(), PhysicalStop> {
    let decided = at_rest.decide();
    for (k, &contact) in at_rest.contacts.iter().enumerate() {
        if let Some(component) = system.frozen.dry[contact].component {
            // (What is not determined is left at rest: the run ends there.)
            let sense = decided.as_ref().map_or(0, |senses| senses[k]);
            modes[component] = match sense {
                1 => StickSlip::Forward,
                -1 => StickSlip::Backward,
                _ => StickSlip::Stuck,
            }
            .mode();
        }
    }
    match decided {
        Ok(senses) => {
            set_out(system, (at_rest, &senses), (time, y), modes);
            Ok(())
        }
        Err(alike) => Err(undecided(system, at_rest.contacts[0], time, alike)),
    }
}

/// What sets out to one side does not move to the other, by rounding.
fn set_out(
    system: &System,
    (at_rest, senses): (&AtRest, &[i8]),
    (time, y): (f64, &mut [f64]),
    modes: &[i64],
) {
    let frozen = &system.frozen;
    let mut work = Work::new(frozen);
    let mut out = vec![0.0; frozen.coordinates];
    for round in 0..ROUNDS {
        let mut back = false;
        for (k, &contact) in at_rest.contacts.iter().enumerate() {
            // (Evaluated, not moved only: the inertias of the roots are needed.)
            frozen.evaluate(time, y, modes, Extent::Full, &mut work, &mut out);
            find_rates(frozen, contact, &mut work);
            let speed = work.speed[frozen.dry[contact].node];
            let mobility = at_rest.mobility[(k, k)] / at_rest.limits[k];
            if speed * f64::from(senses[k]) < 0.0 && mobility > 0.0 {
                let change = -speed * f64::from(1 << round);
                let mut turned = y.to_vec();
                change_speeds(frozen, contact, change / mobility, &mut turned, &work);
                if is_within(system, y, &turned, LEFT) {
                    y.copy_from_slice(&turned);
                    back = true;
                }
            }
        }
        if !back {
            return;
        }
    }
}

fn undecided(system: &System, contact: usize, time: f64, alike: usize) -> PhysicalStop {
    let object = system.model.objects[system.frozen.dry[contact].object]
        .id
        .clone();
    let at = shown(time, 9);
    let (name, message) = match alike {
        0 => (
            "no_motion",
            format!(
                "no motion of {object} at t = {at} s agrees with its dry friction: it can \
                 neither rest nor slide"
            ),
        ),
        _ => (
            "several_solutions",
            format!(
                "{object} is at rest at t = {at} s, and its dry friction allows {alike} \
                 motions: which one comes is not determined"
            ),
        ),
    };
    PhysicalStop {
        name,
        object,
        message,
    }
}

/// States of all dry contacts at t = 0: by their speeds, and where they rest by what they do
/// next.
pub(in crate::dynamics::system) fn settle(system: &System, y: &mut [f64], modes: &mut [i64]) {
    let frozen = &system.frozen;
    if frozen.dry.iter().all(|contact| contact.component.is_none()) {
        return;
    }
    let mut work = Work::new(frozen);
    frozen.motion(0.0, y, modes, Extent::Full, &mut work);
    let mut sets: Vec<usize> = Vec::new();
    let mut resting: Vec<usize> = Vec::new();
    for (index, contact) in frozen.dry.iter().enumerate() {
        let Some(component) = contact.component else {
            continue;
        };
        let size = speed_size(frozen, index, &mut work);
        let speed = work.speed[contact.node];
        if speed.abs() > AT_REST * size {
            modes[component] = speed.signum() as i64;
        } else {
            resting.push(index);
            sets.push(contact.set);
        }
    }
    sets.sort_unstable();
    sets.dedup();
    for set in sets {
        let own = |index: &usize| frozen.dry[*index].set == set;
        let contacts = resting.iter().copied().filter(own).collect();
        // An undetermined start ends the run at once, with its reason.
        let at_rest = bring_to_rest(system, contacts, (0.0, y), modes);
        let _ = go_on(system, &at_rest, (0.0, y), modes);
    }
}

/// Speed of the law of a mass: what its own speed is a sum of.
fn law_speed(frozen: &Frozen, node: usize, work: &Work<f64>) -> f64 {
    let chain = frozen
        .chains
        .iter()
        .find(|chain| chain.nodes().contains(&node));
    chain.map_or(0.0, |chain| work.laws[chain.law].speed.abs())
}

/// The components of the modes of all dry contacts, in the order of their loads.
pub(crate) fn components(system: &System) -> impl Iterator<Item = Option<usize>> + '_ {
    system.frozen.dry.iter().map(|contact| contact.component)
}

/// The forces of dry contacts at rest, each at the index of its load in the model; not a
/// number for those that slide. Allocates nothing.
pub(crate) fn forces_at_rest(
    system: &System,
    (time, y): (f64, &[f64]),
    modes: &[i64],
    scratch: &mut Scratch,
    out: &mut [f64],
) {
    let work = &mut scratch.work;
    if system
        .frozen
        .dry
        .iter()
        .any(|contact| contact.is_stuck(modes))
    {
        let mut accelerations = std::mem::take(&mut work.parting);
        system
            .frozen
            .evaluate(time, y, modes, Extent::Needed, work, &mut accelerations);
        work.parting = accelerations;
    }
    let mut contacts = system.frozen.dry.iter();
    for (out, load) in out.iter_mut().zip(&system.model.loads) {
        if load.law.dry_friction().is_none() {
            continue;
        }
        *out = match contacts.next() {
            Some(contact) if contact.is_stuck(modes) => work.loads[contact.load],
            _ => f64::NAN,
        };
    }
}
