//! Which constraints of a linkage follow from the others.
//!
//! Candidates are left out, as many as the count of degrees of freedom lacks, and what is left is
//! put together and followed over its reach; what was left out must hold there.
//!
//! Candidates are pairs beside another one, a pin of a link between two pairs along its length
//! or across its guide, and the couple of a guide. Those omitted must hold at the start, before
//! anything is walked, and at 400 positions of the range to 1e-9 of the size.
//! `LinkageSpec::redundant` keeps the result.

use super::{other_pair, pairs_of};
use crate::fault::Fault;
use crate::kinematics::linkage::Linkage;
use crate::kinematics::linkage::elements::slides;
use crate::kinematics::linkage::skeleton::Skeleton;
use crate::kinematics::linkage::spec::{
    AssemblyChoice, AssemblySpec, CouplingSpec, LinkageSpec, PairSpec, Redundant, RedundantPart,
};
use crate::kinematics::linkage::structure::mobility;

/// Most equations that are left out together.
const MOST_EQUATIONS: usize = 4;
/// Most choices that are tried.
const MOST_TRIED: usize = 1000;

/// The linkage that moves although the count of its degrees of freedom says no; `None` where it
/// does not move, or the search finds no reason. What is said approximately of its links chooses
/// among the assemblies in which it moves, and is no reason to refuse it. A branch may be: where a
/// single one is why it does not move, that is what is wrong.
pub(in crate::kinematics::linkage) fn find_movable_linkage(
    spec: &LinkageSpec,
    closed_forms: bool,
) -> Option<Result<Linkage, Vec<Fault>>> {
    if let Some(linkage) = moving(spec, closed_forms) {
        return Some(Ok(linkage));
    }
    let of_branch =
        |&index: &usize| matches!(spec.assembly[index].choice, AssemblyChoice::Branch(_));
    let branches: Vec<usize> = (0..spec.assembly.len()).filter(of_branch).collect();
    if branches.is_empty() {
        return None;
    }
    let each = branches.iter().map(|&index| vec![index]);
    let (left_out, linkage) = each.chain([branches.clone()]).find_map(|left_out| {
        let mut bare = spec.clone();
        let mut index = 0..;
        let stays = |_: &AssemblySpec| !left_out.contains(&index.next().unwrap_or_default());
        bare.assembly.retain(stays);
        Some((left_out, moving(&bare, closed_forms)?))
    })?;
    let mut redundant = spec.clone();
    redundant.redundant.clone_from(&linkage.spec().redundant);
    // What choices contradict each other says the assembly itself.
    match Linkage::built(redundant, closed_forms) {
        Err(faults) if !faults.iter().any(|fault| fault.path.starts_with("pairs")) => {
            Some(Err(faults))
        }
        _ => Some(Err(misleading(spec, &left_out))),
    }
}

/// The linkage as it is said, or else in another assembly in which it moves.
fn moving(spec: &LinkageSpec, closed_forms: bool) -> Option<Linkage> {
    let as_said = |trial: &LinkageSpec| Linkage::built(trial.clone(), closed_forms).ok();
    let as_it_moves = |trial: &LinkageSpec| Linkage::assemble_redundant(trial, closed_forms);
    search(spec, &as_said).or_else(|| search(spec, &as_it_moves))
}

/// Entries of `assembly` without which the linkage moves.
fn misleading(spec: &LinkageSpec, entries: &[usize]) -> Vec<Fault> {
    let fault = |choice: &AssemblySpec| {
        let name = &spec.links[choice.link].name;
        Fault::new(
            format!("assembly.{name}"),
            format!(
                "this assembles the linkage so that it cannot move; without the entry of `{name}` \
                 it has one degree of freedom"
            ),
            "leave it out, or give an approximate position",
        )
    };
    let entries = entries.iter().map(|&index| &spec.assembly[index]);
    entries.map(fault).collect()
}

fn search(spec: &LinkageSpec, built: &Built<'_, Linkage>) -> Option<Linkage> {
    let candidates = || possible_removals(&Skeleton::of(spec).spec, &[spec.driver]);
    leave_out(spec, 1, candidates, built)
}

/// What is made of the linkage without some of the candidates, as many as it has too many equations
/// for its inputs.
pub(super) fn leave_out<T>(
    spec: &LinkageSpec,
    inputs: usize,
    candidates: impl Fn() -> Vec<Redundant>,
    built: &Built<'_, T>,
) -> Option<T> {
    let missing = usize::try_from(inputs as i64 - mobility(spec)).ok()?;
    if !spec.redundant.is_empty() || missing == 0 || missing > MOST_EQUATIONS {
        return None;
    }
    let mut search = Search {
        candidates: candidates(),
        trial: spec.clone(),
        left: MOST_TRIED,
        built,
    };
    search.remove_equations(0, missing)
}

/// Makes a linkage of which it is known what is redundant, if it moves.
type Built<'a, T> = dyn Fn(&LinkageSpec) -> Option<T> + 'a;

struct Search<'a, T> {
    candidates: Vec<Redundant>,
    /// The linkage with what is left out at present.
    trial: LinkageSpec,
    /// Choices that may still be tried.
    left: usize,
    built: &'a Built<'a, T>,
}

impl<T> Search<'_, T> {
    /// Leaves out `missing` more equations by candidates from the one given on.
    fn remove_equations(&mut self, from: usize, missing: usize) -> Option<T> {
        if missing == 0 {
            self.left = self.left.checked_sub(1)?;
            return (self.built)(&self.trial);
        }
        for index in from..self.candidates.len() {
            let next = self.candidates[index];
            let fits = next.equations() <= missing;
            let mut chosen = self.trial.redundant.iter();
            if self.left == 0 || !fits || chosen.any(|one| collides(one, &next)) {
                continue;
            }
            self.trial.redundant.push(next);
            let found = self.remove_equations(index + 1, missing - next.equations());
            self.trial.redundant.pop();
            if found.is_some() {
                return found;
            }
        }
        None
    }
}

/// Two parts of one pair or of one link are not left out together.
fn collides(one: &Redundant, other: &Redundant) -> bool {
    let same_link = matches!(
        (one.part, other.part),
        (RedundantPart::Along(a), RedundantPart::Along(b)) if a == b
    );
    one.pair == other.pair || same_link
}

/// What could be left out: whole pairs beside another one of the same links, links that hang between
/// two pairs, guides that turn; the last ones first, so that what was there before stays. Pairs that
/// are `driven` stay.
pub(super) fn possible_removals(spec: &LinkageSpec, driven: &[usize]) -> Vec<Redundant> {
    let mut list = duplicate_pairs(spec, driven);
    for link in (0..spec.links.len()).rev() {
        list.extend(pin_between_links(spec, driven, link));
    }
    for pair in (0..spec.pairs.len()).rev() {
        if !driven.contains(&pair) && slides(&spec.pairs[pair]) {
            let part = RedundantPart::Couple;
            list.push(Redundant { pair, part });
        }
    }
    list
}

/// Pairs whose links are joined by an earlier pair of the same kind.
fn duplicate_pairs(spec: &LinkageSpec, driven: &[usize]) -> Vec<Redundant> {
    let ends = |pair: &PairSpec| {
        let mut ends = [pair.on.link, pair.link.link];
        ends.sort_unstable();
        (ends, pair.slides())
    };
    let doubled = |&index: &usize| {
        let own = ends(&spec.pairs[index]);
        !driven.contains(&index)
            && (0..spec.pairs.len()).any(|other| {
                (other < index || driven.contains(&other)) && ends(&spec.pairs[other]) == own
            })
    };
    let part = RedundantPart::Whole;
    let pairs = (0..spec.pairs.len()).rev().filter(doubled);
    pairs.map(|pair| Redundant { pair, part }).collect()
}

/// A pin of a link that has but two pairs, both to other links and neither driven.
fn pin_between_links(spec: &LinkageSpec, driven: &[usize], link: usize) -> Option<Redundant> {
    let coupled = |coupling: &CouplingSpec| coupling.links().contains(&Some(link));
    if spec.couplings.iter().any(coupled) {
        return None;
    }
    let own: Vec<usize> = pairs_of(spec, link).collect();
    let is_driven = own.iter().any(|pair| driven.contains(pair));
    let pin = own
        .iter()
        .rev()
        .copied()
        .find(|&p| !slides(&spec.pairs[p]))?;
    let redundant = Redundant {
        pair: pin,
        part: RedundantPart::Along(link),
    };
    let hangs = other_pair(spec, link, pin).is_some() && redundant.free_direction(spec).is_some();
    (hangs && !is_driven).then_some(redundant)
}
