//! Putting the linkage together at the start: the branch of every dyad, the
//! first position of every larger group.

use super::choice::{
    Wrong, distance_from_choice, names, number_text, requested_branch, start_in_words,
};
use super::course::{Branch, Course, Table};
use super::dyad::{Dyad, Form, Margin};
use super::examine::tolerance;
use super::guesses;
use super::plan::{Plan, Step};
use super::solve::{place_driven_link, surroundings_of_dyad};
use super::spec::{AssemblyChoice, AssemblySpec, LinkageSpec};
use super::state::State;
use super::structure::Group;
use super::vector::nearest_turn;
use crate::fault::{Fault, Faults};

/// An approximate position is clearly nearer to one assembly when it is at most this
/// part as far from it as from the other.
const CLEARLY: f64 = 0.5;
/// A link that the driver places, this far from its approximate position (rad, or sizes), is
/// elsewhere.
const FAR: f64 = 0.5;
/// A point this far from its approximate place, in sizes of the linkage, was meant elsewhere …
const FARTHEST_PLACE: f64 = 0.25;
/// … unless it is still clearly nearer than in the other assembly: at most this part as far.
const STILL_CLEARLY: f64 = 0.75;

/// A linkage put together at its start.
#[derive(Clone, Debug)]
pub(super) struct Assembly {
    pub(super) state: State,
    pub(super) branches: Vec<Branch>,
}

/// Puts the linkage together at the start, as it is said.
///
/// # Errors
/// A group cannot be assembled at the start, or it is not said how.
pub(super) fn assemble(
    spec: &LinkageSpec,
    plan: &Plan,
    groups: &[Group],
) -> Result<Assembly, Vec<Fault>> {
    let mut state = at_start(plan, spec.start);
    placed_by_the_driver(spec, plan, &state)?;
    let branches = self::choose_branches(spec, plan, groups, &mut state, &mut |_, _| {})?;
    plan.attach::<1>(&mut state);
    Ok(Assembly { state, branches })
}

/// What the driver places, at the start.
pub(super) fn at_start(plan: &Plan, start: f64) -> State {
    let mut state = plan.state();
    place_driven_link::<1>(plan, &mut state, start);
    state.reduced = start;
    driven_angle(plan, &mut state);
    state
}

/// Chooses the branches of all groups, what the inputs place being in its place; `before`
/// is told of each group (its index) before it is put together.
///
/// # Errors
/// A group cannot be assembled at the start, or it is not said how.
pub(super) fn choose_branches(
    spec: &LinkageSpec,
    plan: &Plan,
    groups: &[Group],
    state: &mut State,
    before: &mut dyn FnMut(usize, &mut State),
) -> Result<Vec<Branch>, Vec<Fault>> {
    let mut branches = Vec::new();
    // Of each choice how far the link would be in the other assembly of its group.
    let mut in_other = vec![0.0; spec.assembly.len()];
    for (index, step) in plan.steps.iter().enumerate() {
        before(index, state);
        let (places, choices): (Vec<usize>, Vec<&AssemblySpec>) = spec
            .assembly
            .iter()
            .enumerate()
            .filter(|(_, choice)| step.bodies().iter().any(|body| body.has_link(choice.link)))
            .unzip();
        let sign = match step {
            Step::Dyad(dyad) => {
                dyad_at_start(spec, plan, dyad, &choices, state, index).map(|(sign, other)| {
                    for (place, other) in places.into_iter().zip(other) {
                        in_other[place] = other;
                    }
                    sign
                })
            }
            Step::Newton(group) => {
                guesses::assemble(spec, plan, group, &choices, state).map(|margin| {
                    state.margins[index] = margin;
                    1.0
                })
            }
        };
        match sign {
            Ok(sign) => {
                angles_of(step, state);
                branches.push(Branch {
                    sign,
                    changes: Vec::new(),
                });
            }
            Err((message, hint)) => {
                let path = path(spec, &groups[index + 1], &choices);
                return Err(vec![Fault::new(path, message, hint)]);
            }
        }
    }
    far_places(spec, plan, state, &in_other)?;
    Ok(branches)
}

/// The angle of the link that the driver places, over whole turns: that of its pair is the input.
fn driven_angle(plan: &Plan, state: &mut State) {
    let driver = &plan.driver;
    let (link, input) = match (driver.on.link, driver.link.link) {
        (None, Some(link)) => (link, state.reduced),
        (Some(link), None) => (link, -state.reduced),
        _ => return,
    };
    let angle = state.links[link].angle();
    state.near[link] = match driver.sliding {
        None => nearest_turn(angle, input),
        Some(_) => angle,
    };
}

/// The angles of the bodies of a group, over whole turns.
pub(super) fn angles_of(step: &Step, state: &mut State) {
    for body in step.bodies() {
        let angle = state.links[body.base].angle();
        state.near[body.base] = nearest_turn(angle, state.near[body.base]);
        if let Some(driven) = body.driven {
            let turned = state.near[body.base] + state.relative_angle::<1>().value();
            state.near[driven] = nearest_turn(state.links[driven].angle(), turned);
        }
    }
}

/// Refuses approximate places that no assembly comes near. Of a linkage with redundant
/// constraints they are remarks, since only its nearest assembly may move at all.
fn far_places(
    spec: &LinkageSpec,
    plan: &Plan,
    state: &State,
    in_other: &[f64],
) -> Result<(), Vec<Fault>> {
    let mut faults = Faults::default();
    if !spec.redundant.is_empty() {
        return Ok(());
    }
    for (choice, other) in spec.assembly.iter().zip(in_other) {
        let AssemblyChoice::Near { .. } = choice.choice else {
            continue;
        };
        let off = distance_from_choice(choice, state, plan.size);
        if off > FARTHEST_PLACE && off > STILL_CLEARLY * other {
            let name = &spec.links[choice.link].name;
            faults.add(
                format!("assembly.{name}"),
                format!(
                    "the nearest assembly has `{name}` {} m away from this approximate place, of a \
                     linkage {} m in size",
                    number_text(off * plan.size),
                    number_text(plan.size)
                ),
                "give a place nearer to the one wanted, or another `start`",
            );
        }
    }
    faults.check()
}

/// Refuses what is said of a link that the driver alone places, where it is a branch
/// or another position than that of the start.
fn placed_by_the_driver(spec: &LinkageSpec, plan: &Plan, state: &State) -> Result<(), Vec<Fault>> {
    let bodies = plan.steps.iter().flat_map(Step::bodies);
    let mut faults = Faults::default();
    for choice in &spec.assembly {
        let branch = matches!(choice.choice, AssemblyChoice::Branch(_));
        let remark =
            !spec.redundant.is_empty() && matches!(choice.choice, AssemblyChoice::Near { .. });
        let far = !remark && distance_from_choice(choice, state, plan.size) > FAR;
        if (branch || far) && !bodies.clone().any(|body| body.has_link(choice.link)) {
            let name = &spec.links[choice.link].name;
            faults.add(
                format!("assembly.{name}"),
                format!(
                    "`{name}` is placed by the driver, at the start {}: there is no other \
                     assembly mode",
                    start_in_words(spec)
                ),
                "leave it out, or give another `start`",
            );
        }
    }
    faults.check()
}

/// The choice that concerns a group, or its first link.
fn path(spec: &LinkageSpec, group: &Group, choices: &[&AssemblySpec]) -> String {
    let link = choices.first().map_or(group.links[0], |choice| choice.link);
    format!("links.{}", spec.links[link].name)
}

/// The branch of a dyad, and how far each choice would be from its other assembly.
fn dyad_at_start(
    spec: &LinkageSpec,
    plan: &Plan,
    dyad: &Dyad,
    choices: &[&AssemblySpec],
    state: &mut State,
    index: usize,
) -> Result<(f64, Vec<f64>), Wrong> {
    let around = surroundings_of_dyad::<1>(dyad, state);
    let side = dyad.side_of_second_rail(&around);
    let margin = dyad.directions(&around, side, plan.size).margin;
    let names = names(spec, &dyad.bodies);
    if !(margin.value > tolerance(&margin)) {
        return Err(not_assemblable(spec, dyad, state, &names, &margin));
    }
    state.margins[index] = margin;
    let mut place = |sign: f64| -> Vec<f64> {
        let of = dyad.directions(&around, sign, plan.size).of;
        for (body, frame) in dyad.bodies.iter().zip(dyad.frames_of_bodies(&around, of)) {
            state.place_body::<1>(body, &frame);
        }
        choices
            .iter()
            .map(|choice| distance_from_choice(choice, state, plan.size))
            .collect()
    };
    let asked = requested_branch(choices)?;
    if matches!(dyad.form, Form::Prp | Form::Rpp) {
        place(side);
        return match asked {
            Some(_) => Err((
                format!("{names} have one assembly only"),
                "leave out the branch".to_owned(),
            )),
            // What has one assembly is put together so wherever it was said to be about.
            None => Ok((side, vec![f64::INFINITY; choices.len()])),
        };
    }
    let (plus, minus) = (place(1.0), place(-1.0));
    agree(spec, choices, [&plus, &minus])?;
    let sign = match asked {
        Some(sign) => sign,
        None if choices.is_empty() => 1.0,
        None => {
            let [plus, minus]: [f64; 2] = [&plus, &minus].map(|parts| parts.iter().sum());
            if (plus - minus).abs() <= 1e-6 * (plus + minus) {
                return Err((
                    format!("both assemblies of {names} are as near to the approximate position"),
                    "give a position nearer to the one wanted, or the branch + or -".to_owned(),
                ));
            }
            if plus < minus { 1.0 } else { -1.0 }
        }
    };
    place(sign);
    Ok((sign, if sign > 0.0 { minus } else { plus }))
}

/// Refuses choices of which one asks for a branch, or is clearly nearer to it, and
/// another is clearly nearer to the other branch.
fn agree(
    spec: &LinkageSpec,
    choices: &[&AssemblySpec],
    [plus, minus]: [&[f64]; 2],
) -> Result<(), Wrong> {
    let wanted = |index: usize| match choices[index].choice {
        AssemblyChoice::Branch(sign) => Some(sign),
        _ if plus[index] < CLEARLY * minus[index] => Some(1.0),
        _ if minus[index] < CLEARLY * plus[index] => Some(-1.0),
        _ => None,
    };
    let first = |sign: f64| (0..choices.len()).find(|&index| wanted(index) == Some(sign));
    let (Some(one), Some(other)) = (first(1.0), first(-1.0)) else {
        return Ok(());
    };
    let name = |index: usize| &spec.links[choices[index].link].name;
    Err((
        format!(
            "the entry of `{}` names the branch +, that of `{}` the branch -",
            name(one),
            name(other)
        ),
        "give the approximate position or the branch of one of these links only".to_owned(),
    ))
}

/// Why a dyad cannot be assembled at the start.
fn not_assemblable(
    spec: &LinkageSpec,
    dyad: &Dyad,
    state: &State,
    names: &str,
    margin: &Margin,
) -> Wrong {
    let around = surroundings_of_dyad::<1>(dyad, state);
    let [one, other] = [0, 1].map(|k| dyad.arm(&around, k).length().value());
    let apart = dyad.separation(&around).square().value().sqrt();
    let start = start_in_words(spec);
    if matches!(dyad.form, Form::Prp | Form::Rpp) {
        return (
            format!("the guides of {names} are parallel at the start {start}, they hold nothing"),
            "turn one of the guides, or give the approximate positions for another input"
                .to_owned(),
        );
    }
    if margin.value >= -tolerance(margin) {
        return (
            format!("{names} are in line at the start {start}: both assemblies meet there"),
            "give approximate positions for another input".to_owned(),
        );
    }
    let message = match dyad.form {
        Form::Rrr if apart > one + other => format!(
            "{names} cannot be joined at the start {start}: their outer pins are {} m apart, \
             they reach {} m, {} m are missing",
            number_text(apart),
            number_text(one + other),
            number_text(apart - one - other)
        ),
        Form::Rrr => format!(
            "{names} cannot be joined at the start {start}: their outer pins are {} m apart, \
             folded they reach no nearer than {} m, {} m too far",
            number_text(apart),
            number_text((one - other).abs()),
            number_text((one - other).abs() - apart)
        ),
        _ => format!(
            "{names} cannot be joined at the start {start}: the link does not reach the guide, \
             {} m are missing",
            number_text(dyad.overreach(&around))
        ),
    };
    let hint = "change these lengths, or give the approximate positions for another input";
    (message, hint.to_owned())
}

/// The course before anything is known of it but its start.
pub(super) fn start_of_course(spec: &LinkageSpec, branches: Vec<Branch>) -> Course {
    Course {
        start: spec.start,
        ends: [f64::NEG_INFINITY, f64::INFINITY],
        period: None,
        branches,
        table: Table::default(),
        below: Table::default(),
    }
}
