//! Why a linkage has not one degree of freedom.

use super::Bodies;
use crate::fault::Faults;
use crate::kinematics::linkage::elements::Body;
use crate::kinematics::linkage::spec::LinkageSpec;
use crate::kinematics::linkage::structure::{explanation, mobility};

/// Says what holds a part more than once and what is free.
pub(super) fn misfit(
    spec: &LinkageSpec,
    bodies: &Bodies,
    others: &[usize],
    held: &[(Vec<usize>, Vec<usize>)],
    free: &[usize],
    faults: &mut Faults,
) {
    let links = |list: &[usize]| -> String {
        let bodies = list.iter().map(|&body| &bodies.list[body]);
        let mut links: Vec<usize> = bodies.flat_map(Body::links).collect();
        links.sort_unstable();
        let names: Vec<String> = links
            .iter()
            .map(|&link| format!("`{}`", spec.links[link].name))
            .collect();
        names.join(", ")
    };
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
    for (list, ties) in held {
        let named: Vec<[&str; 2]> = ties
            .iter()
            .map(|&tie| tie_named(spec, others, tie))
            .collect();
        let names: Vec<&str> = named.iter().map(|[_, name]| *name).collect();
        let [place, last] = named.last().copied().unwrap_or_default();
        let what = match list.as_slice() {
            [] => "the ground and the driven link are joined twice".to_owned(),
            list => format!("{} held more than once", is_or_are(&links(list))),
        };
        faults.add(
            format!("{place}.{last}"),
            format!(
                "statically indeterminate: {what}, by the pairs {}",
                names.join(", ")
            ),
            "leave out one of these pairs, or put a link in between",
        );
    }
    if let Some(&first) = free.first() {
        let name = &spec.links[bodies.list[first].base].name;
        let message = format!(
            "{} free to move while the driver stands still",
            is_or_are(&links(free))
        );
        let hint = "join them with further pairs, or leave them out";
        faults.add(format!("links.{name}"), message, hint);
    }
}

/// Where a tie stands in the description, and its name: the pairs in `others`, then the couplings.
pub(in crate::kinematics::linkage) fn tie_named<'a>(
    spec: &'a LinkageSpec,
    others: &[usize],
    tie: usize,
) -> [&'a str; 2] {
    match others.get(tie) {
        Some(&pair) => ["pairs", &spec.pairs[pair].name],
        None => ["couplings", &spec.couplings[tie - others.len()].name],
    }
}

/// Names as the subject of a sentence.
pub(in crate::kinematics::linkage) fn is_or_are(names: &str) -> String {
    let word = if names.contains(',') { "are" } else { "is" };
    format!("{names} {word}")
}
