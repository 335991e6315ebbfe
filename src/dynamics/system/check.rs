//! Checks of a model's numbers and structure before it is frozen.

use crate::dynamics::model::{LinkBase, Model, NodeMotion, TrackSource};
use crate::fault::Fault;

/// All faults of a model.
pub(super) fn faults(model: &Model) -> Vec<Fault> {
    let mut faults = Vec::new();
    check_indices(model, &mut faults);
    if faults.is_empty() {
        check_nodes(model, &mut faults);
        check_links(model, &mut faults);
        check_loads(model, &mut faults);
        check_chains(model, &mut faults);
    }
    faults
}

/// Id of the object that a node belongs to; `node k` when to none.
pub(super) fn object_of(model: &Model, node: usize) -> String {
    let holds = |part: &&crate::dynamics::model::ObjectPart| {
        let point = part.contact.and_then(|contact| contact.point);
        part.nodes.contains(&node) || part.combination == Some(node) || point == Some(node)
    };
    match model.objects.iter().find(holds) {
        Some(part) => part.id.clone(),
        None => format!("node {node}"),
    }
}

/// Indices that point nowhere: a fault of the program that lowered the model,
/// told as a fault so that nothing panics.
fn check_indices(model: &Model, faults: &mut Vec<Fault>) {
    let (nodes, tracks) = (model.nodes.len(), model.tracks.len());
    let mut refuse = |path: String, message: &str| {
        faults.push(Fault::new(
            path,
            format!("inconsistent model: {message}"),
            "",
        ));
    };
    for (index, node) in model.nodes.iter().enumerate() {
        let path = || object_of(model, index);
        let (law, track) = match &node.motion {
            NodeMotion::Prescribed { track, .. } => (None, *track),
            other => (other.law(), other.law().and_then(|law| law.track)),
        };
        if law.is_some_and(|law| law.driver >= index) {
            refuse(path(), "its driver does not come before it");
        }
        if let NodeMotion::Constrained {
            drivers,
            constraint,
        } = &node.motion
        {
            if drivers.iter().any(|&driver| driver >= index) {
                refuse(path(), "a driver does not come before it");
            }
            if drivers.len() != constraint.drivers() {
                refuse(path(), "a constraint of another number of drivers");
            }
        }
        if track.is_some_and(|track| track >= tracks) {
            refuse(path(), "a track that does not exist");
        }
    }
    for link in &model.links {
        let base = match link.base {
            LinkBase::Mass(node) => node,
            LinkBase::Law { .. } => 0,
        };
        if link.mass >= nodes || base >= nodes {
            refuse("model".into(), "a link on a node that does not exist");
        }
    }
    for load in &model.loads {
        let track = load.law.pieces().is_none_or(|(track, _)| track < tracks);
        let read = load.law.read_nodes().iter().all(|&node| node < nodes);
        if load.node >= nodes || !track || !read {
            refuse(load.name.clone(), "a node or a track that does not exist");
        }
    }
    for track in &model.tracks {
        let source = matches!(track.source, TrackSource::Node(node) if node >= nodes);
        if source || track.object >= model.objects.len() {
            refuse(
                "model".into(),
                "a track of a node or an object that does not exist",
            );
        }
    }
    for part in &model.objects {
        let driver = (part.inputs.iter()).any(|input| input.driver >= model.objects.len());
        let node = part.nodes.iter().any(|&node| node >= nodes);
        let contact = part.contact;
        let node = node
            || contact
                .and_then(|own| own.point)
                .is_some_and(|point| point >= nodes);
        let mut links = part
            .links
            .iter()
            .copied()
            .chain(contact.map(|own| own.link));
        let link = links.any(|link| link >= model.links.len());
        if driver || node || link || part.nodes.is_empty() {
            refuse(
                part.id.clone(),
                "a node, a link or an object that does not exist",
            );
        }
    }
}

fn check_nodes(model: &Model, faults: &mut Vec<Fault>) {
    for (index, node) in model.nodes.iter().enumerate() {
        let free = matches!(
            node.motion,
            NodeMotion::Mass { .. } | NodeMotion::Rotor { .. }
        );
        let rotor = matches!(node.motion, NodeMotion::Rotor { .. });
        // A rotor may leave all inertia to what follows it rigidly.
        let carried = rotor && node.inertia == 0.0 && carries_inertia(model, index);
        // The point between a contact element and link 1 is massless.
        let point = node.inertia == 0.0
            && (model.objects.iter().flat_map(|part| part.contact))
                .any(|contact| contact.point == Some(index) && has_next(model, index));
        let carried = carried || point;
        let enough = if free && !carried {
            node.inertia > 0.0
        } else {
            node.inertia >= 0.0
        };
        // An inertia so small that 1/J overflows is no inertia either.
        let free = free && !carried;
        let usable =
            enough && node.inertia.is_finite() && (!free || (1.0 / node.inertia).is_finite());
        if !usable {
            faults.push(Fault::new(
                format!("{}.inertia", object_of(model, index)),
                format!("an inertia of {} is not possible", node.inertia),
                if rotor {
                    "a finite inertia > 0, or 0 with inertia in what follows it rigidly at a constant ratio"
                } else if free {
                    "a finite inertia > 0"
                } else {
                    "a finite inertia ≥ 0"
                },
            ));
        }
        if node.motion.law().is_some_and(|law| !law.lever.is_finite()) {
            faults.push(Fault::new(
                format!("{}.lever", object_of(model, index)),
                "the lever is not a finite number",
                "",
            ));
        }
        if let NodeMotion::Rotor { angle, speed } = node.motion
            && !(angle.is_finite() && speed.is_finite())
        {
            faults.push(Fault::new(
                format!("{}.motion", object_of(model, index)),
                "the angle or the speed at the start is not a finite number",
                "",
            ));
        }
    }
}

/// True when a link leads on from a mass.
fn has_next(model: &Model, node: usize) -> bool {
    let on = |link: &crate::dynamics::model::Link| matches!(link.base, LinkBase::Mass(base) if base == node);
    model.links.iter().any(on)
}

/// True when something with inertia follows a node rigidly at a constant ratio:
/// at any other its inertia would vanish where U′ does.
fn carries_inertia(model: &Model, node: usize) -> bool {
    let follows = |&other: &usize| match &model.nodes[other].motion {
        NodeMotion::Rigid { law } => law.driver == node && law.position.constant_ratio().is_some(),
        _ => false,
    };
    let input = |node: usize| {
        let mut bodies = model.multi_linkages.iter();
        bodies.any(|body| body.inputs.contains(&node))
    };
    // (Whether every input of a linkage of several moves inertia, its mass matrix tells.)
    if input(node) {
        return true;
    }
    let heavy = |other: usize| {
        let linkage = model.linkages.iter().find(|body| body.node == other);
        let links = linkage.map_or(&[][..], |body| &body.linkage.spec().links);
        let own = links
            .iter()
            .any(|link| link.mass > 0.0 || link.moment > 0.0);
        own || model.nodes[other].inertia > 0.0 || carries_inertia(model, other)
    };
    // Drivers come before what they drive: this comes to an end.
    (node + 1..model.nodes.len()).filter(follows).any(heavy)
}

fn check_links(model: &Model, faults: &mut Vec<Fault>) {
    for link in &model.links {
        let object = object_of(model, link.mass);
        let rigid = matches!(
            &link.base,
            LinkBase::Law { pair } if pair.form.restitution().is_some()
        );
        if !(rigid || link.stiffness > 0.0 && link.stiffness.is_finite()) {
            faults.push(Fault::new(
                format!("{object}.stiffness"),
                format!("a stiffness of {} is not possible", link.stiffness),
                "a finite stiffness > 0",
            ));
        }
        if !(link.damping >= 0.0 && link.damping.is_finite()) {
            faults.push(Fault::new(
                format!("{object}.damping"),
                format!("a damping of {} is not possible", link.damping),
                "a finite damping ≥ 0",
            ));
        }
    }
}

fn check_loads(model: &Model, faults: &mut Vec<Fault>) {
    for load in &model.loads {
        if !load.law.is_possible() {
            faults.push(Fault::new(
                load.name.clone(),
                "a number of this load is out of its range",
                "finite numbers; a friction width, a slip and a synchronous speed that are not 0; tables in ascending order",
            ));
        }
    }
}

/// Every mass on exactly one chain, behind the driver of its first mass.
fn check_chains(model: &Model, faults: &mut Vec<Fault>) {
    let mut links_on = vec![0usize; model.nodes.len()];
    for links in chains_of(model) {
        let followed = model.nodes[model.links[links[0]].mass].motion.law();
        let driver = followed.map(|law| law.driver);
        for &link in &links {
            let mass = model.links[link].mass;
            links_on[mass] += 1;
            let same = match &model.nodes[mass].motion {
                NodeMotion::Mass { law } => Some(law.driver) == driver,
                _ => false,
            };
            if !same {
                faults.push(Fault::new(
                    object_of(model, mass),
                    "inconsistent model: a link on a node that is not a mass of its chain",
                    "",
                ));
            }
        }
    }
    for (index, node) in model.nodes.iter().enumerate() {
        let expected = usize::from(matches!(node.motion, NodeMotion::Mass { .. }));
        if links_on[index] != expected {
            faults.push(Fault::new(
                object_of(model, index),
                format!(
                    "inconsistent model: {} links pull at this mass, not one",
                    links_on[index]
                ),
                "",
            ));
        }
    }
    if links_on.iter().sum::<usize>() != model.links.len() {
        faults.push(Fault::new(
            "model",
            "inconsistent model: links that belong to no chain",
            "",
        ));
    }
}

/// Links of each chain, link 1 first; chains in the order of their first links.
pub(super) fn chains_of(model: &Model) -> Vec<Vec<usize>> {
    let mut above: Vec<Option<usize>> = vec![None; model.nodes.len()];
    for (index, link) in model.links.iter().enumerate() {
        if let LinkBase::Mass(node) = link.base {
            above[node] = Some(index);
        }
    }
    let first = (0..model.links.len())
        .filter(|&link| matches!(model.links[link].base, LinkBase::Law { .. }));
    first
        .map(|link| {
            let next = |&link: &usize| above[model.links[link].mass];
            // A chain has no more links than the model: a loop ends here and
            // is refused by the checks.
            std::iter::successors(Some(link), next)
                .take(model.links.len())
                .collect()
        })
        .collect()
}
