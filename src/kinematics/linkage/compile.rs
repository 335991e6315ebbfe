//! From the plain numbers of a linkage to its structure and the plan of its
//! solution, or to what is wrong with its structure.

mod misfit;

use super::decompose::{Decomposition, Tie, decompose};
use super::dyad::{Dyad, Form};
use super::elements::{Body, Element, PairElement, elements, slides};
use super::newton::{NewtonGroup, PreparedJoint, Side};
use super::plan::{Driver, Plan, Step, typical_length};
use super::skeleton::Skeleton;
use super::spec::LinkageSpec;
use super::structure::{Group, GroupKind};
use super::vector::Arm;
use crate::fault::{Fault, Faults};
use misfit::misfit;
pub(super) use misfit::{MisfitWords, held_and_free};

/// The bodies that the driver does not place, and the body of every link.
pub(super) struct Bodies {
    pub(super) list: Vec<Body>,
    pub(super) of_link: Vec<Option<usize>>,
}

/// Structure and plan of a linkage whose numbers are right; dyads by iteration
/// like larger groups when `closed_forms` is false. The groups are told without what is hidden.
pub(super) fn compile(
    skeleton: &Skeleton,
    closed_forms: bool,
) -> Result<(Plan, Vec<Group>), Vec<Fault>> {
    let spec = &skeleton.spec;
    let mut faults = Faults::default();
    let driver = Driver::new(&spec.pairs[spec.driver]);
    let bodies = compile_bodies(skeleton, &driver);
    let others: Vec<usize> = (0..spec.pairs.len())
        .filter(|&p| p != spec.driver && skeleton.solves(p))
        .collect();
    let ties = ties(spec, &bodies, &others);
    sliding_loops(skeleton, &mut faults);
    let found = decompose(bodies.list.len(), &ties);
    let groups = match found {
        Decomposition::Groups(groups) => groups,
        Decomposition::Unfit { held, free } => {
            misfit(spec, &bodies, &others, (&held, &free), &mut faults);
            Vec::new()
        }
    };
    faults.check()?;
    let mut steps = Vec::new();
    let mut listed = vec![driver_group(spec)];
    let made = solved_groups(
        spec,
        &bodies,
        (&ties, &others),
        &groups,
        closed_forms,
        &mut faults,
    );
    for (step, group) in made {
        steps.extend(step);
        listed.push(skeleton.without_hidden(group));
    }
    faults.check()?;
    let plan = Plan {
        driver,
        steps,
        attached: skeleton.attached.clone(),
        links: spec.links.len(),
        size: typical_length(spec),
    };
    Ok((plan, listed))
}

fn driver_group(spec: &LinkageSpec) -> Group {
    let pair = &spec.pairs[spec.driver];
    Group {
        kind: GroupKind::Driver,
        links: pair.on.link.into_iter().chain(pair.link.link).collect(),
        pairs: vec![spec.driver],
        couplings: Vec::new(),
        branch: None,
    }
}

/// The pairs in `others`, then all couplings, as ties between the bodies.
pub(super) fn ties(spec: &LinkageSpec, bodies: &Bodies, others: &[usize]) -> Vec<Tie> {
    let body = |link: Option<usize>| link.and_then(|link| bodies.of_link[link]);
    let pairs = others.iter().map(|&pair| &spec.pairs[pair]);
    let pairs = pairs.map(|pair| Tie::pair([pair.on.link, pair.link.link].map(body)));
    let couplings = spec.couplings.iter();
    let couplings = couplings.map(|coupling| Tie::coupling(coupling.links().map(body)));
    pairs.chain(couplings).collect()
}

/// How each of the groups is solved, and what it is; dyads by iteration like larger groups when
/// `closed_forms` is false. The ties are those of the pairs in `others`, then all couplings.
pub(super) fn solved_groups(
    spec: &LinkageSpec,
    bodies: &Bodies,
    (ties, others): (&[Tie], &[usize]),
    groups: &[Vec<usize>],
    closed_forms: bool,
    faults: &mut Faults,
) -> Vec<(Option<Step>, Group)> {
    let solved = groups.iter().map(|group| {
        let own = |tie: &Tie| tie.belongs_to(group, groups);
        let (pairs, couplings) = pairs_and_couplings(ties, others, own);
        let (step, kind) = match (group.as_slice(), pairs.as_slice()) {
            ([one, other], [_, _, _]) if closed_forms => {
                dyad(spec, bodies, [*one, *other], &pairs, faults)
            }
            _ => larger_group(spec, bodies, group, &pairs, &couplings),
        };
        let mut links: Vec<usize> = group
            .iter()
            .flat_map(|&body| bodies.list[body].links())
            .collect();
        links.sort_unstable();
        let group = Group {
            kind,
            links,
            pairs,
            couplings,
            branch: None,
        };
        (step, group)
    });
    solved.collect()
}

/// The pairs of a group, and its couplings, the ties being those of the pairs in `others` and
/// then those of all couplings.
fn pairs_and_couplings(
    ties: &[Tie],
    others: &[usize],
    own: impl Fn(&Tie) -> bool,
) -> (Vec<usize>, Vec<usize>) {
    let (pairs, couplings) = ties.split_at(others.len());
    let pairs = others.iter().zip(pairs).filter(|(_, tie)| own(tie));
    let couplings = couplings.iter().enumerate().filter(|(_, tie)| own(tie));
    (
        pairs.map(|(&pair, _)| pair).collect(),
        couplings.map(|(coupling, _)| coupling).collect(),
    )
}

fn compile_bodies(skeleton: &Skeleton, driver: &Driver) -> Bodies {
    let spec = &skeleton.spec;
    let attached = |link: usize| skeleton.attached.iter().any(|one| one.link == link);
    let assembly = driver.assembly();
    let on_ground = |link: usize| {
        assembly.is_none() && (driver.on.link == Some(link) || driver.link.link == Some(link))
    };
    let mut list = Vec::new();
    let mut of_link = vec![None; spec.links.len()];
    for link in 0..spec.links.len() {
        match assembly {
            _ if on_ground(link) || attached(link) => {}
            Some(body) if body.has_link(link) => {
                let index = list.iter().position(|known| *known == body);
                of_link[link] = Some(index.unwrap_or(list.len()));
                if index.is_none() {
                    list.push(body);
                }
            }
            _ => {
                of_link[link] = Some(list.len());
                list.push(Body {
                    base: link,
                    driven: None,
                });
            }
        }
    }
    Bodies { list, of_link }
}

/// Sliding pairs (and the driver) that form a loop tie the same angle twice.
fn sliding_loops(skeleton: &Skeleton, faults: &mut Faults) {
    let spec = &skeleton.spec;
    let ground = spec.links.len();
    let mut tied: Vec<usize> = (0..=ground).collect();
    for (index, pair) in spec.pairs.iter().enumerate() {
        if !skeleton.solves(index) || (!slides(pair) && index != spec.driver) {
            continue;
        }
        let [a, b] = [pair.on.link, pair.link.link].map(|link| tied[link.unwrap_or(ground)]);
        if a == b {
            faults.add(
                format!("pairs.{}", pair.name),
                format!(
                    "`{}` closes a loop of sliding pairs, in which the angles are fixed twice",
                    pair.name
                ),
                "make one pair of the loop a pin: a loop needs at least two pins",
            );
        }
        for class in &mut tied {
            if *class == a {
                *class = b;
            }
        }
    }
}

/// A group that is solved by iteration.
fn larger_group(
    spec: &LinkageSpec,
    bodies: &Bodies,
    group: &[usize],
    pairs: &[usize],
    couplings: &[usize],
) -> (Option<Step>, GroupKind) {
    let own = |element: &Element| -> Side {
        let body = element.link.and_then(|link| bodies.of_link[link]);
        match body.and_then(|body| group.iter().position(|&other| other == body)) {
            Some(index) => Side::Own {
                body: index,
                part: PairElement::new(element, &bodies.list[group[index]]),
            },
            None => Side::Known(*element),
        }
    };
    let joints = pairs
        .iter()
        .map(|&pair| PreparedJoint::of_pair(&spec.pairs[pair], own));
    // What does not meet, or has no pitch curve, was refused before.
    let tied = couplings.iter().filter_map(|&coupling| {
        PreparedJoint::of_coupling(&spec.couplings[coupling], &spec.pairs, own)
    });
    let newton = NewtonGroup {
        bodies: group.iter().map(|&body| bodies.list[body]).collect(),
        ties: joints.chain(tied).collect(),
    };
    let links = newton.bodies.iter().flat_map(Body::links).count();
    (Some(Step::Newton(newton)), GroupKind::Newton { links })
}

fn dyad(
    spec: &LinkageSpec,
    bodies: &Bodies,
    group: [usize; 2],
    pairs: &[usize],
    faults: &mut Faults,
) -> (Option<Step>, GroupKind) {
    let of = |element: &Element| element.link.and_then(|link| bodies.of_link[link]);
    let sides = |pair: usize| elements(&spec.pairs[pair]);
    let touches = |pair: usize, body: usize| sides(pair).iter().any(|e| of(e) == Some(body));
    let is_inner = |pair: usize| group.iter().all(|&body| touches(pair, body));
    let outer = |body: usize| {
        pairs
            .iter()
            .copied()
            .find(|&p| touches(p, body) && !is_inner(p))
    };
    let inner = pairs.iter().copied().find(|&p| is_inner(p));
    let (Some(inner), [Some(one), Some(other)]) = (inner, group.map(outer)) else {
        let names = group.map(|body| format!("`{}`", spec.links[bodies.list[body].base].name));
        faults.add(
            "pairs",
            format!("{} are joined so that nothing is held", names.join(" and ")),
            "join each to the rest by one pair, and both to each other by one",
        );
        return (None, GroupKind::Rrr);
    };
    let slide = |pair: usize| slides(&spec.pairs[pair]);
    let (form, kind, swapped) = match (slide(one), slide(inner), slide(other)) {
        (false, false, false) => (Form::Rrr, GroupKind::Rrr, false),
        (false, true, false) => (Form::Rpr, GroupKind::Rpr, false),
        (true, false, true) => (Form::Prp, GroupKind::Prp, false),
        (false, false, true) => (Form::Rrp, GroupKind::Rrp, false),
        (true, false, false) => (Form::Rrp, GroupKind::Rrp, true),
        (false, true, true) => (Form::Rpp, GroupKind::Rpp, false),
        // Three guides are a loop of sliding pairs, refused before.
        (true, true, _) => (Form::Rpp, GroupKind::Rpp, true),
    };
    let (group, outer) = if swapped {
        ([group[1], group[0]], [other, one])
    } else {
        (group, [one, other])
    };
    let element = |pair: usize, body: Option<usize>| {
        let [i, j] = sides(pair);
        if of(&i) == body { i } else { j }
    };
    let part =
        |pair: usize, body: usize| PairElement::new(&element(pair, Some(body)), &bodies.list[body]);
    let known = |k: usize| {
        let [i, j] = sides(outer[k]);
        if of(&i) == Some(group[k]) { j } else { i }
    };
    let guide_on_first = of(&sides(inner)[0]) == Some(group[0]);
    let outer_parts = [part(outer[0], group[0]), part(outer[1], group[1])];
    let inner_parts = [part(inner, group[0]), part(inner, group[1])];
    let arm = |k: usize| -> Option<Arm> {
        let (from, to): (PairElement, PairElement) = (outer_parts[k], inner_parts[k]);
        let rigid = !from.driven && !to.driven;
        rigid.then(|| Arm::new([to.point[0] - from.point[0], to.point[1] - from.point[1]]))
    };
    let dyad = Dyad {
        form,
        bodies: group.map(|body| bodies.list[body]),
        known: [known(0), known(1)],
        outer: outer_parts,
        inner: inner_parts,
        arms: [arm(0), arm(1)],
        // With the guide on the first link its pin is the one behind.
        sense: if form == Form::Rpr && !guide_on_first {
            -1.0
        } else {
            1.0
        },
    };
    refuse_coinciding_pins(spec, &dyad, inner, outer, faults);
    (Some(Step::Dyad(dyad)), kind)
}

/// Pins of one link that lie in the same place do not fix its direction.
fn refuse_coinciding_pins(
    spec: &LinkageSpec,
    dyad: &Dyad,
    inner: usize,
    outer: [usize; 2],
    faults: &mut Faults,
) {
    let size = typical_length(spec);
    let arms: &[usize] = match dyad.form {
        Form::Rrr => &[0, 1],
        Form::Rrp => &[0],
        _ => &[],
    };
    for &k in arms {
        let (from, to) = (dyad.outer[k], dyad.inner[k]);
        let apart = (to.point[0] - from.point[0]).hypot(to.point[1] - from.point[1]);
        if from.driven == to.driven && apart <= 1e-9 * size {
            let body = dyad.bodies[k];
            let link = if from.driven { body.driven } else { None }.unwrap_or(body.base);
            let [one, other] = [outer[k], inner].map(|pair| &spec.pairs[pair].name);
            faults.add(
                format!("links.{}", spec.links[link].name),
                format!(
                    "the pins {one} and {other} of `{0}` lie in the same place, `{0}` is free to turn",
                    spec.links[link].name
                ),
                "move one of the points, or join the other two links directly",
            );
        }
    }
    if dyad.form == Form::Rpp {
        let [u, v] = [dyad.outer[1].along, dyad.inner[1].along];
        if dyad.outer[1].driven == dyad.inner[1].driven && (u[0] * v[1] - u[1] * v[0]).abs() < 1e-9
        {
            let name = &spec.links[dyad.bodies[1].base].name;
            let message = format!("its two guides are parallel, `{name}` is free to slide");
            faults.add(format!("links.{name}"), message, "turn one of the guides");
        }
    }
}
