//! From the plain numbers of a linkage of several inputs to the plan of its solution, or
//! to what is wrong with its inputs and its structure.

use super::joints::{Joints, bodies_of_groups, floating_driver, joints};
use super::misfit::misfit;
use super::plan::{Group, InnerJoint, Massive, MultiPlan, Screw, Source, driver_of};
use super::spec::{InputCoordinate, MultiSpec};
use super::tied::TiedBodies;
use super::welded::WeldedLinkage;
use crate::fault::{Fault, Faults};
use crate::kinematics::linkage::compile;
use crate::kinematics::linkage::decompose::{Decomposition, decompose};
use crate::kinematics::linkage::dyad::Form;
use crate::kinematics::linkage::elements::Body;
use crate::kinematics::linkage::plan::{Plan, Step, typical_length};
use crate::kinematics::linkage::spec::{ForceLaw, ForceSpec, LinkageSpec, OutputKind, OutputSpec};
use crate::kinematics::linkage::structure::{self, GroupKind};

/// Structure and plan of a linkage whose numbers are right.
pub(super) fn compile(
    welded: &WeldedLinkage,
) -> Result<(MultiPlan, Vec<structure::Group>), Vec<Fault>> {
    let mut faults = Faults::default();
    let joints = joints(welded, &mut faults);
    faults.check()?;
    let spec = &welded.spec;
    let linkage = &spec.linkage;
    let bodies = bodies_of_groups(welded, &joints);
    let driving: Vec<usize> = input_pairs(spec).collect();
    let others = other_pairs(welded);
    let ties = compile::ties(linkage, &bodies, &others);
    let groups = match decompose(bodies.list.len(), &ties) {
        Decomposition::Groups(groups) => groups,
        Decomposition::Unfit { held, free } => {
            return Err(misfit(spec, &bodies, &others, (&held, &free)));
        }
    };
    let mut listed = vec![driving_group(spec, &joints, &driving)];
    let mut steps = Vec::new();
    let mut found = Vec::new();
    let handed = (ties.as_slice(), others.as_slice());
    for (step, group) in
        compile::solved_groups(linkage, &bodies, handed, &groups, true, &mut faults)
    {
        if let Some(step) = step {
            let inner = inner_of(spec, &joints, &group.links, &mut faults);
            let mut ready = group_of(spec, &step, &group.pairs, inner, joints.bodies);
            if !ready.dyad {
                ready.ties = ties_of(linkage, &group, joints.bodies);
            }
            found.push(ready);
            steps.push(step);
        }
        listed.push(welded.skeleton.without_hidden(group));
    }
    faults.check()?;
    let first = driving.first().copied().unwrap_or(0);
    let driver = match linkage.pairs.get(first) {
        Some(_) => driver_of(linkage, first),
        None => floating_driver([1.0, 0.0], true),
    };
    let plan = Plan {
        driver,
        steps,
        attached: welded.skeleton.attached.clone(),
        links: joints.bodies,
        size: typical_length(linkage),
    };
    Ok((finish(spec, plan, joints, found), listed))
}

/// Of every link whether inputs alone place it.
pub(super) fn links_placed_by_inputs(welded: &WeldedLinkage) -> Vec<bool> {
    joints(welded, &mut Faults::default()).placed
}

/// True when inputs, or they and the pairs, place something more than once.
pub(super) fn is_overconstrained(welded: &WeldedLinkage) -> bool {
    let mut faults = Faults::default();
    let joints = joints(welded, &mut faults);
    if faults.check().is_err() {
        return true;
    }
    let spec = &welded.spec;
    let bodies = bodies_of_groups(welded, &joints);
    let ties = compile::ties(&spec.linkage, &bodies, &other_pairs(welded));
    match decompose(bodies.list.len(), &ties) {
        Decomposition::Groups(_) => false,
        Decomposition::Unfit { held, .. } => !held.is_empty(),
    }
}

/// The pairs that are no inputs, without what is left out.
fn other_pairs(welded: &WeldedLinkage) -> Vec<usize> {
    let driving: Vec<usize> = input_pairs(&welded.spec).collect();
    let all = 0..welded.spec.linkage.pairs.len();
    all.filter(|pair| !driving.contains(pair) && welded.skeleton.solves(*pair))
        .collect()
}

/// The pairs that are inputs.
pub(super) fn input_pairs(spec: &MultiSpec) -> impl Iterator<Item = usize> + '_ {
    spec.inputs
        .iter()
        .filter_map(|input| match input.coordinate {
            InputCoordinate::Pair(pair) => Some(pair),
            _ => None,
        })
}

fn driving_group(spec: &MultiSpec, joints: &Joints, driving: &[usize]) -> structure::Group {
    let mut links: Vec<usize> = (0..spec.linkage.links.len())
        .filter(|&link| joints.placed[link])
        .chain(joints.inner.iter().flat_map(|own| [own.base, own.driven]))
        .collect();
    links.sort_unstable();
    structure::Group {
        kind: GroupKind::Driver,
        links,
        pairs: driving.to_vec(),
        couplings: Vec::new(),
        branch: None,
    }
}

/// The input inside a group; two of them are too many.
fn inner_of(
    spec: &MultiSpec,
    joints: &Joints,
    links: &[usize],
    faults: &mut Faults,
) -> Option<InnerJoint> {
    let own = |joint: &&InnerJoint| links.contains(&joint.base);
    let mut inner = joints.inner.iter().filter(own);
    let first = inner.next()?;
    if let Some(second) = inner.next() {
        let [one, other] = [first, second].map(|joint| &spec.inputs[joint.input].name);
        let message =
            format!("`{other}` and `{one}` lie inside one group of links that are found together");
        let hint = "choose another pair of these links as input, one that leads from the ground \
                    outwards";
        faults.add(format!("inputs.{other}"), message, hint);
    }
    Some(first.clone())
}

/// How the velocities of a group follow.
fn group_of(
    spec: &MultiSpec,
    step: &Step,
    pairs: &[usize],
    inner: Option<InnerJoint>,
    ground: usize,
) -> Group {
    let all = &spec.linkage.pairs;
    let bodies = step.bodies();
    let screws = match step {
        Step::Newton(_) => Vec::new(),
        Step::Dyad(_) => {
            let in_body =
                |link: Option<usize>, k: usize| link.is_some_and(|l| bodies[k].has_link(l));
            let touches = |pair: usize, k: usize| {
                in_body(all[pair].on.link, k) || in_body(all[pair].link.link, k)
            };
            // The side of a pair that is not on body k, or that is.
            let side = |pair: usize, k: usize, on_it: bool| match in_body(all[pair].on.link, k) {
                own if own == on_it => all[pair].on.link,
                _ => all[pair].link.link,
            };
            let outer = |k: usize| {
                let own = pairs.iter().find(|&&p| touches(p, k) && !touches(p, 1 - k));
                own.map(|&pair| Screw::new(&all[pair], side(pair, k, false), ground))
            };
            let between = pairs.iter().find(|&&p| touches(p, 0) && touches(p, 1));
            let between = between.map(|&pair| Screw::new(&all[pair], side(pair, 0, true), ground));
            [outer(0), between, outer(1)]
                .into_iter()
                .flatten()
                .collect()
        }
    };
    let driven = inner.as_ref().map(|inner| inner.driven);
    Group {
        bases: bodies.iter().map(|body| body.base).collect(),
        links: bodies.iter().map(|body| body.base).chain(driven).collect(),
        known: Vec::new(),
        inner,
        screws,
        ties: Vec::new(),
        dyad: matches!(step, Step::Dyad(_)),
        parallel: match step {
            Step::Dyad(dyad) => matches!(dyad.form, Form::Prp | Form::Rpp),
            Step::Newton(_) => false,
        },
        active: Vec::new(),
        matrix: 0,
        exchanged: 0,
    }
}

/// Joints of a group made ready, these having been checked.
fn ties_of(linkage: &LinkageSpec, group: &structure::Group, ground: usize) -> Vec<TiedBodies> {
    let all = &linkage.pairs;
    let pairs = group.pairs.iter();
    let pairs = pairs.map(|&pair| TiedBodies::of_pair(&all[pair], ground));
    let couplings = group.couplings.iter();
    let couplings =
        couplings.filter_map(|&own| TiedBodies::of_coupling(&linkage.couplings[own], all, ground));
    pairs.chain(couplings).collect()
}

/// Whether a force or an output asks for continuous angles.
fn turning(spec: &LinkageSpec) -> bool {
    let torsion = |force: &ForceSpec| matches!(force.law, ForceLaw::Torsion { .. });
    let angle = |output: &OutputSpec| !matches!(output.kind, OutputKind::Point { .. });
    spec.forces.iter().any(torsion) || spec.outputs.iter().any(angle)
}

/// Which input moves what, and where the numbers of larger groups lie.
fn finish(spec: &MultiSpec, plan: Plan, joints: Joints, mut groups: Vec<Group>) -> MultiPlan {
    let (inputs, bodies) = (spec.inputs.len(), joints.bodies);
    let mut moves = vec![false; (bodies + 1) * inputs];
    let mut placed = vec![false; bodies];
    let mut joint_of = vec![usize::MAX; bodies];
    for (place, joint) in joints.tree.iter().enumerate() {
        for input in 0..inputs {
            moves[joint.body * inputs + input] =
                input == joint.input || moves[joint.parent * inputs + input];
        }
        placed[joint.body] = true;
        joint_of[joint.body] = place;
    }
    let mut matrices = [0, 0];
    for (group, step) in groups.iter_mut().zip(&plan.steps) {
        let links: Vec<usize> = step.bodies().iter().flat_map(Body::links).collect();
        let sides = group.screws.iter().flat_map(|screw| screw.sides);
        let tied = group.ties.iter().flat_map(|tie| tie.bodies());
        let sides = sides.chain(tied.copied());
        let outside: Vec<usize> = sides.filter(|side| !links.contains(side)).collect();
        let own = group.inner.as_ref().map(|inner| inner.input);
        let active = |&input: &usize| {
            Some(input) == own || outside.iter().any(|&side| moves[side * inputs + input])
        };
        group.active = (0..inputs).filter(active).collect();
        for &link in &links {
            for &input in &group.active {
                moves[link * inputs + input] = true;
            }
        }
        let n = 3 * group.bases.len();
        (group.matrix, group.exchanged) = (matrices[0], matrices[1]);
        if !group.dyad {
            matrices = [matrices[0] + n * n, matrices[1] + n];
        }
    }
    for one in &plan.attached {
        let base = one.base.unwrap_or(bodies);
        for input in 0..inputs {
            moves[one.link * inputs + input] = moves[base * inputs + input];
        }
        placed[one.link] = one.base.is_none_or(|base| placed[base]);
    }
    let weighs = |body: usize| {
        let link = spec.linkage.links.get(body);
        link.is_some_and(|link| link.mass > 0.0 || link.moment > 0.0)
    };
    let mut heavy: Vec<bool> = (0..bodies).map(weighs).collect();
    for one in &plan.attached {
        if let Some(base) = one.base {
            heavy[base] |= heavy[one.link];
        }
    }
    for joint in joints.tree.iter().rev() {
        if joint.parent < bodies && heavy[joint.body] {
            heavy[joint.parent] = true;
        }
    }
    let mut ready = MultiPlan {
        plan,
        inputs,
        bodies,
        tree: joints.tree,
        groups,
        moves,
        placed,
        massive: Vec::new(),
        heavy,
        joint_of,
        turning: turning(&spec.linkage) || !spec.linkage.couplings.is_empty(),
        geared: !spec.linkage.couplings.is_empty(),
        matrices,
    };
    ready.massive = massive(spec, &ready);
    for at in 0..ready.groups.len() {
        ready.groups[at].known = known_velocities(&ready, &ready.groups[at]);
    }
    ready
}

/// The links that have inertia.
fn massive(spec: &MultiSpec, plan: &MultiPlan) -> Vec<Massive> {
    let links = spec.linkage.links.iter().enumerate();
    let heavy = links.filter(|(_, link)| link.mass != 0.0 || link.moment != 0.0);
    let ready = heavy.map(|(body, link)| Massive {
        body,
        mass: link.mass,
        centre: link.centre,
        moment: link.moment,
        placed: plan.placed[body],
        moved: (0..plan.inputs)
            .filter(|&input| plan.is_moved(body, input))
            .collect(),
    });
    ready.collect()
}

/// Where the velocities of what a dyad hangs on stand.
fn known_velocities(plan: &MultiPlan, group: &Group) -> Vec<[Source; 2]> {
    if !group.dyad {
        return Vec::new();
    }
    let sides = [0, 2].map(|screw| group.screws[screw].sides[0]);
    let of = |&input: &usize| sides.map(|side| plan.source(side, input));
    group.active.iter().map(of).collect()
}
