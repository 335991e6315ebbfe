//! Dry contacts in the layout, and the scenes in which they are refused.

use super::{Ancestor, DryContact, MOST_TOGETHER, Source};
use crate::dynamics::model::{DryFriction, Model};
use crate::dynamics::system::frozen::Frozen;
use crate::fault::Fault;

/// Puts a dry friction into the layout; its component is numbered afterwards, and its load
/// placed.
pub(in crate::dynamics::system) fn place(
    frozen: &mut Frozen,
    friction: DryFriction,
    node: usize,
    object: usize,
) {
    let signal = frozen.signal(node);
    let ancestors = ancestors(frozen, node);
    frozen.dry.push(DryContact {
        load: usize::MAX,
        node,
        friction,
        component: None,
        signal,
        object,
        ancestors,
        set: 0,
    });
}

/// A node with all that moves it, the driven before its drivers: drivers have lower indices.
fn ancestors(frozen: &Frozen, node: usize) -> Vec<Ancestor> {
    let mut nodes = vec![node];
    let mut next = 0;
    while let Some(&node) = nodes.get(next) {
        for driver in drivers_of(frozen, node) {
            if !nodes.contains(&driver) {
                nodes.push(driver);
            }
        }
        nodes[next + 1..].sort_unstable_by(|one, other| other.cmp(one));
        next += 1;
    }
    let place = |driver: usize| nodes.iter().position(|&node| node == driver).unwrap_or(0);
    let source = |node: usize| {
        if let Some(rigid) = frozen.rigids.iter().find(|rigid| rigid.node == node) {
            let driver = place(frozen.laws[rigid.law].driver);
            let law = rigid.law;
            return Source::Law { law, driver };
        }
        let constraints = frozen.constraints.iter();
        if let Some(index) = constraints.clone().position(|one| one.node == node) {
            let drivers = &frozen.constraints[index].drivers;
            let drivers = drivers.iter().map(|&driver| place(driver)).collect();
            return Source::Constraint { index, drivers };
        }
        let free = frozen.coordinate[node].is_some();
        Source::Root { free }
    };
    let ancestor = |&node: &usize| Ancestor {
        node,
        source: source(node),
    };
    nodes.iter().map(ancestor).collect()
}

/// The nodes that a node follows rigidly.
fn drivers_of(frozen: &Frozen, node: usize) -> Vec<usize> {
    let rigid = frozen.rigids.iter().find(|rigid| rigid.node == node);
    let several = frozen.constraints.iter().find(|one| one.node == node);
    match (rigid, several) {
        (Some(rigid), _) => vec![frozen.laws[rigid.law].driver],
        (None, Some(constrained)) => constrained.drivers.clone(),
        (None, None) => Vec::new(),
    }
}

/// Numbers the components of dry contacts from `next` on, and puts those on common roots into
/// sets; the next free number.
pub(in crate::dynamics::system) fn number(frozen: &mut Frozen, mut next: usize) -> usize {
    for contact in &mut frozen.dry {
        if contact.free_roots().next().is_some() {
            contact.component = Some(next);
            next += 1;
        }
    }
    for index in 0..frozen.dry.len() {
        frozen.dry[index].set = index;
    }
    let roots: Vec<Vec<usize>> = (frozen.dry.iter())
        .map(|contact| {
            let free = contact.free_roots();
            free.map(|place| contact.ancestors[place].node).collect()
        })
        .collect();
    for one in 0..roots.len() {
        for other in 0..one {
            if roots[one].iter().any(|root| roots[other].contains(root)) {
                let [from, to] = [frozen.dry[one].set, frozen.dry[other].set];
                let joined = frozen.dry.iter_mut().filter(|contact| contact.set == from);
                joined.for_each(|contact| contact.set = to);
            }
        }
    }
    next
}

/// Faults of dry contacts whose force at rest is not found.
pub(in crate::dynamics::system) fn faults(frozen: &Frozen, model: &Model) -> Vec<Fault> {
    let mut faults = Vec::new();
    let name = |contact: &DryContact| load_name(model, frozen, contact);
    for contact in frozen.dry.iter().filter(|own| own.component.is_some()) {
        let rubs = |node: usize| frozen.groups.iter().any(|group| group.root == node);
        let coupled = |node: usize| frozen.is_coupled(node);
        let roots = || {
            let free = contact.free_roots();
            free.map(|place| contact.ancestors[place].node)
        };
        let reason = if frozen.impacts {
            "beside rigid contacts, whose speeds jump"
        } else if roots().any(coupled) {
            "on what moves a differential with inertia or a linkage of several inputs"
        } else if roots().any(rubs) {
            "on what moves a linkage with `joint_friction`"
        } else {
            if is_loop(frozen, contact.set) {
                faults.push(loop_fault(&name(contact)));
                continue;
            }
            let together = frozen.dry.iter().filter(|other| other.set == contact.set);
            if together.count() <= MOST_TOGETHER {
                continue;
            }
            "together with more than seven others on the same shafts"
        };
        let message = format!("friction that sticks {reason} is not computed");
        let hint = "give `force` and `width` in place of `sliding`: regularised friction, which \
                    creeps";
        faults.push(Fault::new(
            format!("{}.friction", name(contact)),
            message,
            hint,
        ));
    }
    faults
}

/// True where contacts of a set close a loop: two bodies that rub on the ground and on each other,
/// say. Which of them holds how much at rest is not determined then. Contacts between the same two
/// nodes, or of one free body on the ground, hold the same motion and share the force.
fn is_loop(frozen: &Frozen, set: usize) -> bool {
    let own = frozen.dry.iter().filter(|contact| contact.set == set);
    let mut edges: Vec<(Vec<usize>, Vec<usize>)> = own
        .map(|contact| {
            let free = contact.free_roots();
            let roots: Vec<usize> = free.map(|place| contact.ancestors[place].node).collect();
            let of_one = roots.len() == 1;
            let drivers = drivers_of(frozen, contact.node);
            let nodes = if of_one { Vec::new() } else { drivers };
            (roots, sorted(nodes))
        })
        .collect();
    edges.sort();
    edges.dedup();
    // As a graph of bodies and the ground.
    let mut parts: Vec<Vec<usize>> = Vec::new();
    const GROUND: usize = usize::MAX;
    for (roots, _) in &edges {
        let mut ends = roots.clone();
        if ends.len() == 1 {
            ends.push(GROUND);
        }
        let (touched, apart): (Vec<_>, Vec<_>) =
            (parts.into_iter()).partition(|part| part.iter().any(|end| ends.contains(end)));
        if touched
            .iter()
            .any(|part| part.iter().filter(|end| ends.contains(end)).count() > 1)
        {
            return true;
        }
        parts = apart;
        let mut joined: Vec<usize> = touched.into_iter().flatten().chain(ends).collect();
        joined.sort_unstable();
        joined.dedup();
        parts.push(joined);
    }
    false
}

fn sorted(mut nodes: Vec<usize>) -> Vec<usize> {
    nodes.sort_unstable();
    nodes
}

fn loop_fault(name: &str) -> Fault {
    let message = "frictions that stick close a loop: which of them holds how much at rest is not \
                   determined";
    let hint = "leave out one of them; or give `force` and `width` in place of `sliding`: \
                regularised friction, which creeps";
    Fault::new(format!("{name}.friction"), message, hint)
}

/// The address of the load that a contact is.
fn load_name(model: &Model, frozen: &Frozen, contact: &DryContact) -> String {
    let mut loads = model.loads.iter();
    let own = loads.find(|load| {
        load.law.dry_friction() == Some(&contact.friction)
            && frozen.internal[load.node] == contact.node
    });
    own.map_or_else(String::new, |load| load.name.clone())
}
