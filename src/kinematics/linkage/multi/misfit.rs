//! Why the inputs of a linkage do not fit its mobility.

use super::spec::MultiSpec;
use crate::fault::{Fault, Faults};
use crate::kinematics::linkage::compile::{Bodies, is_or_are, tie_named};
use crate::kinematics::linkage::elements::Body;
use crate::kinematics::linkage::structure::{explanation, mobility};

/// Says what holds a part more than once and what is free.
pub(super) fn misfit(
    spec: &MultiSpec,
    bodies: &Bodies,
    others: &[usize],
    held: &[(Vec<usize>, Vec<usize>)],
    free: &[usize],
) -> Vec<Fault> {
    let mut faults = Faults::default();
    let linkage = &spec.linkage;
    let names = |list: &[usize]| -> String {
        let bodies = list.iter().map(|&body| &bodies.list[body]);
        let mut links: Vec<usize> = bodies.flat_map(Body::links).collect();
        links.sort_unstable();
        let names = links
            .iter()
            .map(|&link| format!("`{}`", linkage.links[link].name));
        names.collect::<Vec<_>>().join(", ")
    };
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
    for (list, ties) in held {
        let named: Vec<[&str; 2]> = (ties.iter())
            .map(|&tie| tie_named(linkage, others, tie))
            .collect();
        let pairs: Vec<&str> = named.iter().map(|[_, name]| *name).collect();
        let what = match list.as_slice() {
            [] => "links that the inputs place are joined again".to_owned(),
            list => format!("{} held more than once", is_or_are(&names(list))),
        };
        let path = named.last().map_or("inputs".to_owned(), |[place, last]| {
            format!("{place}.{last}")
        });
        let message = format!("{what}, by the pairs {}", pairs.join(", "));
        let hint = "choose the coordinate of one of these pairs as input in place of another, or \
                    leave one out";
        faults.add(path, message, hint);
    }
    if let Some(&first) = free.first() {
        let name = &linkage.links[bodies.list[first].base].name;
        let message = format!(
            "{} free to move while all inputs stand still",
            is_or_are(&names(free))
        );
        let hint = "name a coordinate of theirs as input";
        faults.add(format!("links.{name}"), message, hint);
    }
    match faults.check() {
        Err(found) => found,
        Ok(()) => Vec::new(),
    }
}
