//! Putting the linkage together at the start: the branch of every dyad, the
//! first position of every larger group.

use super::course::{Branch, Course, Table, nearest_turn};
use super::dyad::{Dyad, Form, Margin};
use super::examine::tolerance;
use super::guesses;
use super::plan::{Body, Frame, Plan, Step};
use super::solve::{around, drive};
use super::spec::{AssemblyChoice, AssemblySpec, LinkageSpec};
use super::state::State;
use super::structure::Group;
use crate::fault::Fault;

/// Chooses the branches and leaves the position at the start in `state`.
///
/// # Errors
/// A group cannot be assembled at the start, or it is not said how.
pub(super) fn assemble(
    spec: &LinkageSpec,
    plan: &Plan,
    groups: &[Group],
    state: &mut State,
) -> Result<Vec<Branch>, Vec<Fault>> {
    drive::<1>(plan, state, spec.start);
    let mut branches = Vec::new();
    for (index, step) in plan.steps.iter().enumerate() {
        let choices: Vec<&AssemblySpec> = spec
            .assembly
            .iter()
            .filter(|choice| step.bodies().iter().any(|body| body.has(choice.link)))
            .collect();
        let sign = match step {
            Step::Dyad(dyad) => dyad_at_start(spec, plan, dyad, &choices, state, index),
            Step::Newton(group) => {
                guesses::assemble(spec, plan, group, &choices, state).map(|margin| {
                    state.margins[index] = margin;
                    1.0
                })
            }
        };
        match sign {
            Ok(sign) => branches.push(Branch {
                sign,
                changes: Vec::new(),
            }),
            Err((message, hint)) => {
                let path = path(spec, &groups[index + 1], &choices);
                return Err(vec![Fault::new(path, message, hint)]);
            }
        }
    }
    Ok(branches)
}

/// The choice that concerns a group, or its first link.
fn path(spec: &LinkageSpec, group: &Group, choices: &[&AssemblySpec]) -> String {
    let link = choices.first().map_or(group.links[0], |choice| choice.link);
    format!("links.{}", spec.links[link].name)
}

/// What is wrong, and what would help.
pub(super) type Wrong = (String, String);

fn dyad_at_start(
    spec: &LinkageSpec,
    plan: &Plan,
    dyad: &Dyad,
    choices: &[&AssemblySpec],
    state: &mut State,
    index: usize,
) -> Result<f64, Wrong> {
    let around = around::<1>(dyad, state);
    let side = dyad.side(&around);
    let margin = dyad.directions(&around, side, plan.size).margin;
    let names = names(spec, &dyad.bodies);
    if !(margin.value > tolerance(&margin)) {
        return Err(not_assemblable(spec, dyad, state, &names, &margin));
    }
    state.margins[index] = margin;
    let mut place = |sign: f64| -> f64 {
        let of = dyad.directions(&around, sign, plan.size).of;
        for (body, frame) in dyad.bodies.iter().zip(dyad.place(&around, of)) {
            state.put::<1>(body, &frame);
        }
        choices
            .iter()
            .map(|choice| mismatch(choice, state, plan.size))
            .sum()
    };
    let asked = asked_branch(choices);
    if matches!(dyad.form, Form::Prp | Form::Rpp) {
        place(side);
        return match asked? {
            Some(_) => Err((
                format!("{names} have one assembly only"),
                "leave out the branch".to_owned(),
            )),
            None => Ok(side),
        };
    }
    let sign = match asked? {
        Some(sign) => sign,
        None if choices.is_empty() => 1.0,
        None => {
            let (plus, minus) = (place(1.0), place(-1.0));
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
    Ok(sign)
}

/// The branch that was asked for, if any.
pub(super) fn asked_branch(choices: &[&AssemblySpec]) -> Result<Option<f64>, Wrong> {
    let mut asked = None;
    for choice in choices {
        let AssemblyChoice::Branch(sign) = choice.choice else {
            continue;
        };
        if asked.is_some_and(|other| other != sign) {
            let hint = "give the branch of one of its links only";
            return Err(("both branches are asked for".to_owned(), hint.to_owned()));
        }
        asked = Some(sign);
    }
    Ok(asked)
}

/// How far a link is from where it was said to be about, dimensionless.
pub(super) fn mismatch(choice: &AssemblySpec, state: &State, size: f64) -> f64 {
    let motion = &state.links[choice.link];
    match choice.choice {
        AssemblyChoice::Branch(_) => 0.0,
        AssemblyChoice::Angle(angle) => (nearest_turn(motion.angle(), angle) - angle).abs(),
        AssemblyChoice::Near { point, place } => {
            let frame: Frame<1> = motion.frame();
            let [x, y] = frame.place(point).value();
            (x - place[0]).hypot(y - place[1]) / size
        }
    }
}

/// Names of the links of some bodies.
pub(super) fn names(spec: &LinkageSpec, bodies: &[Body]) -> String {
    let names: Vec<String> = bodies
        .iter()
        .flat_map(Body::links)
        .map(|link| format!("`{}`", spec.links[link].name))
        .collect();
    names.join(" and ")
}

/// Why a dyad cannot be assembled at the start.
fn not_assemblable(
    spec: &LinkageSpec,
    dyad: &Dyad,
    state: &State,
    names: &str,
    margin: &Margin,
) -> Wrong {
    let around = around::<1>(dyad, state);
    let [one, other] = [0, 1].map(|k| dyad.arm(&around, k).length().value());
    let apart = dyad.apart(&around).square().value().sqrt();
    let start = short(spec.start);
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
            short(apart),
            short(one + other),
            short(apart - one - other)
        ),
        Form::Rrr => format!(
            "{names} cannot be joined at the start {start}: their outer pins are {} m apart, \
             folded they reach no nearer than {} m, {} m too far",
            short(apart),
            short((one - other).abs()),
            short((one - other).abs() - apart)
        ),
        _ => format!(
            "{names} cannot be joined at the start {start}: the link does not reach the guide, \
             {} m are missing",
            short(dyad.overreach(&around))
        ),
    };
    let hint = "change these lengths, or give the approximate positions for another input";
    (message, hint.to_owned())
}

/// A number with six digits, without zeros at the end; with an exponent where it
/// is very large or small.
pub(super) fn short(number: f64) -> String {
    let rounded: f64 = format!("{number:.5e}").parse().unwrap_or(number);
    match rounded.abs() {
        0.0 | 1e-6..1e10 => rounded.to_string(),
        _ => format!("{rounded:e}"),
    }
}

/// The course before anything is known of it but its start.
pub(super) fn course(spec: &LinkageSpec, branches: Vec<Branch>) -> Course {
    Course {
        start: spec.start,
        ends: [f64::NEG_INFINITY, f64::INFINITY],
        period: None,
        branches,
        table: Table::default(),
        below: Table::default(),
    }
}
