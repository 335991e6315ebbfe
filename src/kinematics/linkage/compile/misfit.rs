//! Why a linkage does not have the degrees of freedom that it is driven by.

use super::Bodies;
use crate::fault::Faults;
use crate::kinematics::linkage::decompose::Held;
use crate::kinematics::linkage::elements::Body;
use crate::kinematics::linkage::spec::LinkageSpec;
use crate::kinematics::linkage::structure::{explanation, mobility};

/// What is said of parts that are held more than once, or free.
pub(in crate::kinematics::linkage) struct MisfitWords {
    /// Before what is held more than once.
    pub(in crate::kinematics::linkage) held: &'static str,
    /// Of links that are placed already.
    pub(in crate::kinematics::linkage) placed_again: &'static str,
    /// What to do about either.
    pub(in crate::kinematics::linkage) held_hint: &'static str,
    /// What stands still.
    pub(in crate::kinematics::linkage) still: &'static str,
    /// What to do about a free part.
    pub(in crate::kinematics::linkage) free_hint: &'static str,
}

/// Words about one driver.
const ONE_DRIVER: MisfitWords = MisfitWords {
    held: "statically indeterminate: ",
    placed_again: "the ground and the driven link are joined twice",
    held_hint: "leave out one of these pairs, or put a link in between",
    still: "the driver stands still",
    free_hint: "join them with further pairs, or leave them out",
};

/// Says what holds a part more than once and what is free, of a linkage with one driver.
pub(super) fn misfit(
    spec: &LinkageSpec,
    bodies: &Bodies,
    others: &[usize],
    (held, free): (&[Held], &[usize]),
    faults: &mut Faults,
) {
    let count = mobility(spec);
    if count != 1 {
        let hint = match count {
            ..=0 if spec.assembly.is_empty() => {
                "leave out pairs or add links until one degree of freedom is left. Parallel links that \
                 move together in one assembly mode alone need the approximate position of one of them \
                 in `assembly`"
            }
            ..=0 => "leave out pairs or add links until one degree of freedom is left",
            2 => {
                "name both coordinates as `inputs` in place of `driver`; or tie a second input to the first \
                 by further links and pairs, or leave the loose links out"
            }
            _ => {
                "name all coordinates as `inputs` in place of `driver`; or join the loose links with \
                 further pairs, or leave them out"
            }
        };
        let message = format!("not one degree of freedom: {}", explanation(spec));
        faults.add("pairs", message, hint);
    }
    held_and_free(spec, bodies, others, (held, free), &ONE_DRIVER, faults);
}

/// Says which parts are held more than once and which are free.
pub(in crate::kinematics::linkage) fn held_and_free(
    spec: &LinkageSpec,
    bodies: &Bodies,
    others: &[usize],
    (held, free): (&[Held], &[usize]),
    words: &MisfitWords,
    faults: &mut Faults,
) {
    let links = |list: &[usize]| -> String {
        let bodies = list.iter().map(|&body| &bodies.list[body]);
        let mut links: Vec<usize> = bodies.flat_map(Body::links).collect();
        links.sort_unstable();
        let names = links
            .iter()
            .map(|&link| format!("`{}`", spec.links[link].name));
        names.collect::<Vec<_>>().join(", ")
    };
    for (list, ties) in held {
        let named: Vec<[&str; 2]> = (ties.iter())
            .map(|&tie| tie_named(spec, others, tie))
            .collect();
        let names: Vec<&str> = named.iter().map(|[_, name]| *name).collect();
        let what = match list.as_slice() {
            [] => words.placed_again.to_owned(),
            list => format!("{} held more than once", is_or_are(&links(list))),
        };
        let path = named.last().map_or("inputs".to_owned(), |[place, last]| {
            format!("{place}.{last}")
        });
        let message = format!("{}{what}, by the pairs {}", words.held, names.join(", "));
        faults.add(path, message, words.held_hint);
    }
    if let Some(&first) = free.first() {
        let name = &spec.links[bodies.list[first].base].name;
        let message = format!(
            "{} free to move while {}",
            is_or_are(&links(free)),
            words.still
        );
        faults.add(format!("links.{name}"), message, words.free_hint);
    }
}

/// Where a tie stands in the description, and its name: the pairs in `others`, then the couplings.
fn tie_named<'a>(spec: &'a LinkageSpec, others: &[usize], tie: usize) -> [&'a str; 2] {
    match others.get(tie) {
        Some(&pair) => ["pairs", &spec.pairs[pair].name],
        None => ["couplings", &spec.couplings[tie - others.len()].name],
    }
}

/// Names as the subject of a sentence.
fn is_or_are(names: &str) -> String {
    let word = if names.contains(',') { "are" } else { "is" };
    format!("{names} {word}")
}
