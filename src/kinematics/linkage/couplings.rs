//! The couplings of a linkage: gears, belts, racks, cams.
//!
//! A coupling is one equation between links, handed out like those of pairs; [`mod@super::joints`]
//! holds what is said of each kind. What it ties is solved by iteration (`newton::tied`). Angles are
//! continued along the walk, and a table over the whole period, in which the wheels come back to
//! where they were, gives the turn. Behind several inputs a coupling is one more row of a larger
//! group's matrix (`multi::tied`, `multi::larger`). A position is then found on the way from the
//! last one, in parts in which nothing turns by half a turn.

pub(crate) use super::joints::Outline;
use super::spec::LinkageSpec;
use crate::fault::Faults;

/// Everything wrong with the couplings, the pairs being right.
pub(super) fn check(spec: &LinkageSpec, found: &mut Faults) {
    for (index, coupling) in spec.couplings.iter().enumerate() {
        let path = format!("couplings.{}", coupling.name);
        let mut pairs = spec.pairs.iter().map(|pair| &pair.name);
        let mut before = spec.couplings[..index]
            .iter()
            .map(|coupling| &coupling.name);
        if pairs.any(|name| *name == coupling.name) || before.any(|name| *name == coupling.name) {
            let message = "a pair or another coupling has this name".to_owned();
            found.add(path.as_str(), message, "give it a name of its own");
        }
        found.finite(&format!("{path}.offset"), coupling.offset);
        let kind = coupling.kind.as_kind();
        kind.check(&path, found);
        let mut links = coupling.links().into_iter().flatten();
        if let Some(link) = links.find(|link| *link >= spec.links.len()) {
            found.add(path, format!("there is no link number {link}"), "");
        } else if let Err(wrong) = kind.check_links(coupling, &spec.pairs) {
            let [message, hint] = wrong.in_words(coupling, |link| link_name(spec, link));
            found.add(path, message, &hint);
        }
    }
}

/// Name of a link or of the ground.
fn link_name(spec: &LinkageSpec, link: Option<usize>) -> String {
    match link {
        Some(link) => format!("`{}`", spec.links[link].name),
        None => "the ground".to_owned(),
    }
}

/// The outlines of all couplings, these having been checked.
pub(crate) fn outlines(spec: &LinkageSpec) -> Vec<Outline> {
    let all = spec.couplings.iter();
    all.flat_map(|one| one.kind.as_kind().outlines(one, &spec.pairs))
        .collect()
}

/// Sentences about couplings that are hardly meant so.
pub(super) fn remarks_on_couplings(spec: &LinkageSpec) -> Vec<String> {
    let all = spec.couplings.iter();
    all.filter_map(|one| one.kind.as_kind().remark(&one.name))
        .collect()
}
