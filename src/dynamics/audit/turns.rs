//! Both sides of a switch.
//!
//! An impact follows its coefficient of restitution; its impulse and its energy are balanced.

use super::contact::ContactState;
use super::judge::Judge;
use super::sampler::{LATE, StretchEnd, Turn};
use crate::dynamics::integrate::Impact;

/// Roundings of the displacements through which a stretch knows its speeds.
const ROUNDED: f64 = 16.0 * f64::EPSILON;

/// Puts a switch to the test.
pub(super) fn judge(judge: &mut Judge<'_>, turn: &Turn) {
    continuity(judge, turn);
    match &turn.impact {
        Some(impact) => struck(judge, turn, impact),
        None => changed(judge, turn),
    }
}

/// Nothing jumps: displacements nowhere, speeds but in an impact.
fn continuity(judge: &mut Judge<'_>, turn: &Turn) {
    let count = turn.before.len() / 2;
    let bound = judge.bound();
    let mut pairs: Vec<(&[f64], &[f64], Option<&StretchEnd>)> =
        vec![(&turn.before, &turn.after, None)];
    pairs.extend(
        turn.last
            .iter()
            .map(|end| (&*end.state, &*turn.before, Some(end))),
    );
    pairs.extend(
        turn.next
            .iter()
            .map(|end| (&*end.state, &*turn.after, Some(end))),
    );
    for node in 0..judge.names.len() {
        let Some(own) = judge.mechanics.coordinate[node] else {
            continue;
        };
        // (A massless point has no speed of its own: it follows from the balance.)
        let massless = judge.system.model().nodes[node].inertia == 0.0;
        for &(one, other, end) in &pairs {
            let orders = if massless || end.is_none() {
                0..1
            } else {
                0..2
            };
            for order in orders {
                let entry = own + order * count;
                let what = ["displacement at an event", "speed at an event"][order];
                let scale = judge.scales.entries[entry];
                if scale > 0.0 {
                    let defect = (one[entry] - other[entry]).abs() / scale;
                    let unsure = end.map_or(0.0, |end| unsure(judge, end, node, order, entry));
                    let bound = bound + unsure / scale;
                    judge
                        .found
                        .include(defect, bound, (turn.time, &judge.names[node]), what);
                }
            }
        }
    }
}

/// How far rounding leaves an entry of the state at the end of a stretch open: of the
/// instant, about which what is stiff moves, and of the displacements.
fn unsure(judge: &Judge<'_>, end: &StretchEnd, node: usize, order: usize, entry: usize) -> f64 {
    let moved = (end.state[entry] - end.beside[entry]).abs();
    match order == 0 || end.length == 0.0 {
        true => moved,
        // (A displacement may be counted from that of a law, which is rounded as well.)
        false => moved + ROUNDED * judge.scales.motion[node][0] / end.length,
    }
}

/// The contact of a component at one side of a switch.
fn pressed_at(
    judge: &mut Judge<'_>,
    turn: &Turn,
    side: usize,
    component: usize,
) -> Option<ContactState> {
    let y = [&turn.before, &turn.after][side];
    judge.take_state(turn.time, y, &turn.modes[side].0);
    let mut all = judge.mechanics.pressed.iter();
    all.find(|pressed| pressed.component == Some(component))
        .copied()
}

/// A contact opens or closes where it has no force or touches its flank.
fn changed(judge: &mut Judge<'_>, turn: &Turn) {
    let pairs = judge.system.model().objects.len();
    for object in 0..pairs {
        let Some(component) = judge.system.pair_component(object) else {
            continue;
        };
        let modes = [0, 1].map(|side| turn.modes[side].0[component]);
        if modes[0] == modes[1] {
            continue;
        }
        // From one flank to the other both touch: each is looked at.
        for side in [0, 1].into_iter().filter(|&side| modes[side] != 0) {
            let Some(pressed) = pressed_at(judge, turn, side, component) else {
                continue;
            };
            // (A massless point between them is set anew by the event: the contact opens or
            // closes where the balance there says so.)
            let contact = judge.system.model().objects[object].contact;
            let point = contact.is_some_and(|contact| contact.point.is_some());
            if pressed.restitution.is_some() || point {
                continue;
            }
            let [depth, force] = judge.scales.contact[pressed.object];
            let share = |value: f64, of: f64| if of > 0.0 { value.abs() / of } else { 0.0 };
            let defect = share(pressed.depth, depth).min(share(pressed.normal, force));
            // The instant is rounded.
            let late = LATE * turn.time * pressed.speed.abs();
            let bound = judge.bound() + share(late, depth);
            let id = &judge.system.model().objects[pressed.object].id;
            let what = "contact force or depth at an event";
            judge.found.include(defect, bound, (turn.time, id), what);
        }
    }
}

/// An impact: speeds part by the coefficient of restitution, momenta change by its impulse
/// alone, and energy is lost as was said, never gained.
fn struck(judge: &mut Judge<'_>, turn: &Turn, impact: &Impact) {
    let Some(before) = pressed_at(judge, turn, 0, impact.component) else {
        return;
    };
    let sides = |judge: &Judge<'_>| {
        let momenta: Vec<f64> = judge.mechanics.nodes.iter().map(|at| at.momentum).collect();
        (momenta, judge.mechanics.kinetic)
    };
    let (momenta, kinetic) = sides(judge);
    let Some(after) = pressed_at(judge, turn, 1, impact.component) else {
        return;
    };
    let (moved, left) = sides(judge);
    let bound = judge.bound();
    let id = judge.system.model().objects[before.object].id.clone();
    let place = (turn.time, &*id);
    let side = impact.side as f64;
    let (towards, apart) = (side * before.speed, -side * after.speed);
    let restitution = match impact.rests {
        Some(_) => 0.0,
        None => before.restitution.unwrap_or(0.0),
    };
    let found = &mut judge.found;
    let share = |value: f64, of: f64| if of > 0.0 { value.abs() / of } else { 0.0 };
    let speeds = share(apart - restitution * towards, towards.abs());
    found.include(speeds, bound, place, "restitution in an impact");
    found.include(
        share(impact.approach - towards, towards.abs()),
        bound,
        place,
        "approach of an impact",
    );
    let depth = judge.scales.contact[before.object][0];
    found.include(
        share(before.depth.max(before.held_off[0]), depth),
        bound,
        place,
        "depth at an impact",
    );
    let model = judge.system.model();
    if !model.multi_linkages.is_empty() {
        return;
    }
    let lost = kinetic - left + impact.drives;
    let turned = kinetic.abs().max(left.abs()).max(impact.lost.abs());
    found.include(
        share(lost - impact.lost, turned),
        bound,
        place,
        "energy lost in an impact",
    );
    found.include(
        share(lost.min(0.0), turned),
        bound,
        place,
        "energy gained in an impact",
    );
    // Where others are held they bear their part.
    let others = judge
        .mechanics
        .pressed
        .iter()
        .any(|other| other.holds && other.component != Some(impact.component));
    let owner = model.stops.iter().find(|stop| stop.part == before.object);
    if others || owner.is_some() {
        return;
    }
    let Some(&own) = model.objects[before.object].nodes.first() else {
        return;
    };
    for node in 0..judge.names.len() {
        if judge.mechanics.coordinate[node].is_none() || judge.mechanics.no_force[node].is_some() {
            continue;
        }
        let wanted = if node == own {
            -side * impact.impulse
        } else {
            0.0
        };
        let scale = momenta[node]
            .abs()
            .max(moved[node].abs())
            .max(impact.impulse.abs());
        let defect = share(moved[node] - momenta[node] - wanted, scale);
        let place = (turn.time, &*judge.names[node]);
        judge
            .found
            .include(defect, bound, place, "momentum in an impact");
    }
}
