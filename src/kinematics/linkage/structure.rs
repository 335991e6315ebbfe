//! The structure of a linkage: mobility and Assur groups in order of solution.

use super::spec::{AssemblyChoice, AssemblySpec, LinkageSpec, Redundant, WeldSpec};
use std::fmt;

/// The kind of a group of links.
///
/// R: a pin, P: a sliding pair; outer, inner, outer pair of a dyad.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GroupKind {
    /// The driver: its pair, and the one or two links it moves.
    Driver,
    /// Two links, three pins.
    Rrr,
    /// Two links; a pin to the rest, a pin between them, a guide to the rest.
    Rrp,
    /// Two links; pins to the rest, a guide between them.
    Rpr,
    /// Two links; guides to the rest, a pin between them.
    Prp,
    /// Two links; a pin to the rest, a guide between them, a guide to the rest.
    Rpp,
    /// A link with a redundant constraint: what it is joined to holds it more often than it needs.
    Overheld,
    /// A larger group, solved by Newton's method.
    Newton {
        /// Number of links that have to be found together.
        links: usize,
    },
}

impl fmt::Display for GroupKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Driver => f.write_str("driver"),
            Self::Rrr => f.write_str("dyad RRR"),
            Self::Rrp => f.write_str("dyad RRP"),
            Self::Rpr => f.write_str("dyad RPR"),
            Self::Prp => f.write_str("dyad PRP"),
            Self::Rpp => f.write_str("dyad RPP"),
            Self::Overheld => f.write_str("redundantly held link"),
            Self::Newton { links: 1 } => f.write_str("geared link"),
            Self::Newton { links } => write!(f, "group of {links} links"),
        }
    }
}

/// One group, found once everything before it has its place.
///
/// **Branch.** The *first* link of a dyad is the one that stands first in the
/// list of links (of RRP and RPP: the one with the outer pin). The branch is
///
/// * RRR: + when the inner pin lies to the left of the line from the outer pin
///   of the first link to that of the second,
/// * RRP: + when the inner pin lies ahead of the outer pin in the direction of
///   the guide,
/// * RPR: + when the outer pin of the block's link lies ahead of the outer pin
///   of the guide's link in the direction of the guide.
///
/// The other dyads have one assembly only.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// Kind of the group.
    pub kind: GroupKind,
    /// Its links, indices into [`LinkageSpec::links`]. Two links that the driver
    /// moves against each other stand in the driver's group and, as one body,
    /// in the group that places them.
    pub links: Vec<usize>,
    /// Pairs of the group, indices into [`LinkageSpec::pairs`].
    pub pairs: Vec<usize>,
    /// Its couplings, indices into [`LinkageSpec::couplings`].
    pub couplings: Vec<usize>,
    /// +1 or −1 at the start, for dyads with two assemblies.
    pub branch: Option<f64>,
}

/// Structure of a linkage: its degree of freedom and its groups.
#[derive(Clone, Debug, PartialEq)]
pub struct Structure {
    /// Degrees of freedom: 1.
    pub mobility: i64,
    /// Count of the degrees of freedom, in words.
    pub explanation: String,
    /// The groups in the order of solution, the driver first.
    pub groups: Vec<Group>,
    /// Welds, each in a sentence.
    pub welded: Vec<String>,
    /// Constraints that hold what is held already, each in a sentence.
    pub redundant: Vec<String>,
    /// Names of links, pairs and couplings, for display.
    names: [Vec<String>; 3],
    /// What a single link is called that a coupling holds, for each of these.
    held_links: Vec<&'static str>,
}

impl Structure {
    pub(super) fn new(spec: &LinkageSpec, groups: Vec<Group>) -> Self {
        Self {
            mobility: mobility(spec),
            explanation: explanation(spec),
            groups,
            welded: welded(spec),
            redundant: redundant(spec),
            held_links: (spec.couplings.iter())
                .map(|coupling| coupling.kind.words().held_link)
                .collect(),
            names: [
                spec.links.iter().map(|link| link.name.clone()).collect(),
                spec.pairs.iter().map(|pair| pair.name.clone()).collect(),
                spec.couplings
                    .iter()
                    .map(|coupling| coupling.name.clone())
                    .collect(),
            ],
        }
    }

    /// What a group is called.
    fn kind(&self, group: &Group) -> String {
        match (group.kind, group.couplings.as_slice()) {
            (GroupKind::Newton { links: 1 }, [first, ..]) => self.held_links[*first].to_owned(),
            (kind, _) => kind.to_string(),
        }
    }

    /// The assembly mode of every dyad, each in a sentence; where `assembles` finds that the other
    /// can be put together, with how to choose it: by the link that `choices` name, of several by
    /// the first.
    pub fn assembly_modes(
        &self,
        choices: &[AssemblySpec],
        assembles: &dyn Fn(Vec<AssemblySpec>) -> bool,
    ) -> Vec<String> {
        let dyads = self.groups.iter().enumerate();
        let dyads = dyads.filter_map(|(at, group)| {
            let branch = group.branch?;
            let sign = |branch: f64| if branch < 0.0 { '-' } else { '+' };
            let links = names(&self.names[0], &group.links, " and ");
            let own = format!("{links} are assembled on branch {}", sign(branch));
            let mut named = choices.iter().map(|choice| choice.link);
            let named = named.find(|link| group.links.contains(link));
            let link = named.or(group.links.first().copied())?;
            let other = AssemblySpec {
                link,
                choice: AssemblyChoice::Branch(-branch),
            };
            // The choices of other links; or those alone that do not depend on this one.
            let behind = |link: usize| {
                self.groups[at..]
                    .iter()
                    .any(|own| own.links.contains(&link))
            };
            let with = |dropped: &dyn Fn(usize) -> bool| {
                let kept = choices.iter().filter(|choice| !dropped(choice.link));
                assembles(kept.cloned().chain([other.clone()]).collect())
            };
            let instead = format!(
                "the other: \"assembly\": {{ \"{}\": {{ \"branch\": \"{}\" }} }}",
                self.names[0][link],
                sign(-branch)
            );
            Some(if with(&|link| group.links.contains(&link)) {
                format!("{own}; {instead}")
            } else if with(&behind) {
                format!("{own}; {instead}, without the entries of the links behind them")
            } else {
                own
            })
        });
        dyads.collect()
    }

    /// A group in words: `dyad RRR: coupler, rocker (pairs B, C, D), branch +`.
    pub fn describe(&self, group: usize) -> String {
        let group = &self.groups[group];
        let names = |which: usize, indices: &[usize]| names(&self.names[which], indices, ", ");
        let word = if group.pairs.len() == 1 {
            "pair"
        } else {
            "pairs"
        };
        let coupled = match group.couplings.as_slice() {
            [] => String::new(),
            [one] => format!(", coupling {}", names(2, &[*one])),
            several => format!(", couplings {}", names(2, several)),
        };
        let branch = match group.branch {
            Some(branch) if branch < 0.0 => ", branch -",
            Some(_) => ", branch +",
            None => "",
        };
        let kind = self.kind(group);
        format!(
            "{kind}: {} ({word} {}{coupled}){branch}",
            names(0, &group.links),
            names(1, &group.pairs)
        )
    }
}

impl fmt::Display for Structure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.explanation)?;
        for sentence in self.welded.iter().chain(&self.redundant) {
            writeln!(f, "{sentence}")?;
        }
        for group in 0..self.groups.len() {
            writeln!(f, "{}. {}", group + 1, self.describe(group))?;
        }
        Ok(())
    }
}

/// Names by their numbers.
fn names(all: &[String], indices: &[usize], between: &str) -> String {
    let names: Vec<&str> = indices.iter().map(|&index| all[index].as_str()).collect();
    names.join(between)
}

/// 3n − 2p − c − 3w, and what redundant constraints take away without holding anything.
pub(super) fn mobility(spec: &LinkageSpec) -> i64 {
    counted(spec) + redundancies(spec)
}

/// 3n − 2p − c − 3w.
fn counted(spec: &LinkageSpec) -> i64 {
    let ties = 2 * spec.pairs.len() + spec.couplings.len() + 3 * spec.welds.len();
    3 * spec.links.len() as i64 - ties as i64
}

/// Number of equations that are redundant.
fn redundancies(spec: &LinkageSpec) -> i64 {
    let equations = spec.redundant.iter().map(Redundant::equations);
    equations.sum::<usize>() as i64
}

/// Which links are welded together, in sentences.
fn welded(spec: &LinkageSpec) -> Vec<String> {
    let name = |link: Option<usize>| match link {
        Some(link) => format!("`{}`", spec.links[link].name),
        None => "the ground".to_owned(),
    };
    let sentence = |weld: &WeldSpec| {
        let [on, link] = [weld.on.link, weld.link.link].map(name);
        format!("welded: {link} to {on} by `{}`", weld.name)
    };
    spec.welds.iter().map(sentence).collect()
}

/// What is redundant, in sentences.
fn redundant(spec: &LinkageSpec) -> Vec<String> {
    let sentence = |one: &Redundant| {
        format!(
            "redundant: {} holds what is held already; the linkage moves as it would without it",
            one.describe(spec)
        )
    };
    spec.redundant.iter().map(sentence).collect()
}

/// The count in words: `3 links, 4 pairs: 3·3 − 2·4 = 1 degree of freedom`.
pub(super) fn explanation(spec: &LinkageSpec) -> String {
    let (n, p, f) = (spec.links.len(), spec.pairs.len(), mobility(spec));
    let many =
        |count: usize, word: &str| format!("{count} {word}{}", if count == 1 { "" } else { "s" });
    let word = if f == 1 { "degree" } else { "degrees" };
    let (coupled, less) = match spec.couplings.len() {
        0 => (String::new(), String::new()),
        c => (format!(", {}", many(c, "coupling")), format!(" − {c}")),
    };
    let (welded, lesser) = match spec.welds.len() {
        0 => (String::new(), String::new()),
        w => (format!(", {}", many(w, "weld")), format!(" − 3·{w}")),
    };
    let (counted, redundancies) = (counted(spec), redundancies(spec));
    let redundant = match redundancies {
        0 => String::new(),
        1 => format!("{counted}, 1 redundant constraint: {counted} + 1 = "),
        r => format!("{counted}, {r} redundant constraints: {counted} + {r} = "),
    };
    format!(
        "{}, {}{coupled}{welded}: 3·{n} − 2·{p}{less}{lesser} = {redundant}{f} {word} of freedom",
        many(n, "moving link"),
        many(p, "pair")
    )
}
