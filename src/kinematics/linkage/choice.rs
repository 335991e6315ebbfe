//! What a choice of an assembly asks for, and how it is put in words.

use super::elements::{Body, Frame};
use super::spec::{AssemblyChoice, AssemblySpec, LinkageSpec};
use super::state::State;
use super::vector::nearest_turn;
use crate::units::shown;

/// Fault: what is wrong, and what would help.
pub(super) type Wrong = (String, String);

/// The branch that was asked for, if any.
pub(super) fn requested_branch(choices: &[&AssemblySpec]) -> Result<Option<f64>, Wrong> {
    let mut asked = None;
    for choice in choices {
        let AssemblyChoice::Branch(sign) = choice.choice else {
            continue;
        };
        if asked.is_some_and(|other| other != sign) {
            let hint = "give the branch of one of its links only";
            return Err(("both branches are named".to_owned(), hint.to_owned()));
        }
        asked = Some(sign);
    }
    Ok(asked)
}

/// How far a link is from where it was said to be about, dimensionless.
pub(super) fn distance_from_choice(choice: &AssemblySpec, state: &State, size: f64) -> f64 {
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

/// The input at the start with its unit; "given" where it is no number, because there are
/// several.
pub(super) fn start_in_words(spec: &LinkageSpec) -> String {
    if spec.start.is_nan() {
        return "given".to_owned();
    }
    match spec.pairs[spec.driver].slides() {
        true => format!("{} m", number_text(spec.start)),
        false => format!("{} deg", number_text(spec.start.to_degrees())),
    }
}

/// A number of a message, to six digits; an infinite one is called so.
pub(super) fn number_text(number: f64) -> String {
    match number.is_infinite() {
        true => number.to_string(),
        false => shown(number, 6),
    }
}
