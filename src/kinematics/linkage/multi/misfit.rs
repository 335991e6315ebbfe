//! Why the inputs of a linkage do not fit its mobility.

use super::spec::MultiSpec;
use crate::fault::{Fault, Faults};
use crate::kinematics::linkage::compile::{Bodies, MisfitWords, held_and_free};
use crate::kinematics::linkage::decompose::Held;
use crate::kinematics::linkage::structure::{explanation, mobility};

const WORDS: MisfitWords = MisfitWords {
    held: "",
    placed_again: "links that the inputs place are joined again",
    held_hint: "choose the coordinate of one of these pairs as input in place of another, or leave \
                one out",
    still: "all inputs stand still",
    free_hint: "name a coordinate of theirs as input",
};

/// Says what holds a part more than once and what is free.
pub(super) fn misfit(
    spec: &MultiSpec,
    bodies: &Bodies,
    others: &[usize],
    found: (&[Held], &[usize]),
) -> Vec<Fault> {
    let mut faults = Faults::default();
    let linkage = &spec.linkage;
    let (count, given) = (mobility(linkage), spec.inputs.len() as i64);
    if count != given {
        let message = format!("{given} inputs, and {}", explanation(linkage));
        let hint = match given < count {
            true => format!(
                "name {} more: coordinates of pairs, or x, y and angle of a link that floats",
                count - given
            ),
            false => format!("leave {} of them out", given - count),
        };
        faults.add("inputs", message, &hint);
    }
    held_and_free(linkage, bodies, others, found, &WORDS, &mut faults);
    faults.check().err().unwrap_or_default()
}
