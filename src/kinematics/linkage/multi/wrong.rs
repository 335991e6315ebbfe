//! Checks of the numbers of a linkage of several inputs.

use super::forces;
use super::plan::MultiPlan;
use super::spec::{InputCoordinate, MultiSpec};
use super::welded::WeldedLinkage;
use crate::fault::{Fault, Faults};
use crate::kinematics::linkage::check;
use crate::kinematics::linkage::choice::distance_from_choice;
use crate::kinematics::linkage::spec::{AssemblyChoice, LinkageSpec};
use crate::kinematics::linkage::state::State;

/// Most inputs: what is dense in their number is found at every evaluation.
const MOST_INPUTS: usize = 100;
/// A link that inputs place, this far from its approximate position (rad, or sizes), is
/// elsewhere.
const FAR: f64 = 0.5;

/// Everything wrong with the numbers, each taken for itself.
pub(super) fn check(spec: &MultiSpec) -> Result<(), Vec<Fault>> {
    let mut faults = Faults::default();
    let linkage = &spec.linkage;
    check_numbers(linkage, &mut faults);
    if spec.inputs.is_empty() || spec.inputs.len() > MOST_INPUTS {
        let message = format!("{} inputs", spec.inputs.len());
        let hint = format!("at least one, at most {MOST_INPUTS}");
        faults.add("inputs", message, &hint);
    }
    for (index, input) in spec.inputs.iter().enumerate() {
        let path = format!("inputs.{}", input.name);
        faults.finite(&format!("{path}.start"), input.start);
        let known = match input.coordinate {
            InputCoordinate::Pair(pair) => pair < linkage.pairs.len(),
            InputCoordinate::X(link) | InputCoordinate::Y(link) | InputCoordinate::Angle(link) => {
                link < linkage.links.len()
            }
        };
        if !known {
            faults.add(path, "there is no such pair or link", "");
            continue;
        }
        let mut before = spec.inputs[..index].iter();
        if let Some(other) = before.find(|other| other.coordinate == input.coordinate) {
            let message = format!("`{}` is the same coordinate", other.name);
            faults.add(path, message, "leave one of both out");
        } else if let Some(link) = input.coordinate.floating_link() {
            require_floating_coordinates(spec, link, &path, &mut faults);
        }
    }
    forces::refused(linkage, &mut faults);
    faults.check()?;
    floating_as_one(spec)
}

/// Everything wrong with the numbers of the linkage itself.
pub(super) fn check_numbers(linkage: &LinkageSpec, faults: &mut Faults) {
    let mut linkage = linkage.clone();
    // (There is no driver.)
    (linkage.driver, linkage.start, linkage.travel) = (usize::MAX, 0.0, None);
    if let Err(found) = check::check(&linkage) {
        let found = found.into_iter().filter(|fault| fault.path != "driver");
        faults.absorb("", found.collect());
    }
}

/// Refuses links that float and are welded to the ground, or to another one that floats.
fn floating_as_one(spec: &MultiSpec) -> Result<(), Vec<Fault>> {
    let mut faults = Faults::default();
    let welded = WeldedLinkage::of(spec);
    let name = |link: usize| &spec.linkage.links[link].name;
    for input in &spec.inputs {
        let link = input.coordinate.floating_link();
        let Some(one) = link.and_then(|link| welded.attachment(link)) else {
            continue;
        };
        let path = format!("inputs.{}", input.name);
        let own = name(one.link);
        match one.base {
            None => faults.add(
                path,
                format!("`{own}` is welded to the ground and does not float"),
                "leave this input out, or the weld",
            ),
            Some(base) => faults.add(
                path,
                format!(
                    "`{own}` is welded to `{}`: one body floats once",
                    name(base)
                ),
                "leave the coordinates of one of both out",
            ),
        }
    }
    faults.check()
}

/// Requires all three coordinates of a link that floats.
fn require_floating_coordinates(spec: &MultiSpec, link: usize, path: &str, faults: &mut Faults) {
    let coordinates = [
        (InputCoordinate::X(link), "x"),
        (InputCoordinate::Y(link), "y"),
        (InputCoordinate::Angle(link), "angle"),
    ];
    let lacks = |&&(wanted, _): &&(InputCoordinate, &str)| {
        !spec.inputs.iter().any(|input| input.coordinate == wanted)
    };
    let lacking: Vec<&str> = coordinates.iter().filter(lacks).map(|one| one.1).collect();
    if !lacking.is_empty() {
        let name = &spec.linkage.links[link].name;
        let message = format!("`{name}` floats by part of its coordinates");
        let hint = format!("add its {} as inputs too", lacking.join(" and "));
        faults.add(path, message, &hint);
    }
}

/// Refuses what is said of a link that the inputs alone place, where it is a branch or
/// another position than that of the start.
pub(super) fn refuse_unneeded_guesses(
    spec: &MultiSpec,
    plan: &MultiPlan,
    state: &State,
) -> Result<(), Vec<Fault>> {
    let mut faults = Faults::default();
    for choice in &spec.linkage.assembly {
        let branch = matches!(choice.choice, AssemblyChoice::Branch(_));
        let far = distance_from_choice(choice, state, plan.plan.size) > FAR;
        if plan.placed[choice.link] && (branch || far) {
            let name = &spec.linkage.links[choice.link].name;
            faults.add(
                format!("assembly.{name}"),
                format!("`{name}` is placed by the inputs alone: there is no other assembly mode"),
                "leave it out, or give another `start` to an input",
            );
        }
    }
    faults.check()
}
