//! Dry friction that sticks, on any node: a mass, a rotor, what follows them, or the difference
//! of two of them.
//!
//! While a contact slides its force is F(|w|) against the speed w of its node, and the direction
//! is a mode. At rest the force is whatever keeps w = 0: it solves the equations of motion
//! together with the forces of all other contacts at rest, A·T = −a₀ with
//! Aᵢⱼ = Σᵣ ∂wᵢ/∂φ̇ᵣ·∂wⱼ/∂φ̇ᵣ/Mᵣ over the free roots r (`hold`). The mass matrix is diagonal there:
//! scenes in which it is not are refused.
//!
//! A contact that stops sticks if the force that this needs is at most F_s. A contact at rest
//! breaks loose, to the side to which it is pulled, where it needs more. Contacts on common roots
//! are decided together (`decide`): all combinations are looked at. Of those that agree with
//! their own forces the one with most contacts at rest is taken, since what can rest rests; two
//! such combinations end the run.
//!
//! Behind a prescribed drive nothing can stick: the drive moves it, and friction is only a force,
//! against the direction of the speed.
//!
//! Sources: C. Glocker, *Set-Valued Force Laws* (2001), chapter 5; the closed forms of the tests.

mod at_rest;
mod decide;
mod hold;
mod place;

pub(crate) use decide::{components, forces_at_rest};
pub(super) use decide::{decide_on, excess, settle};
pub(super) use hold::{DryWork, hold_all, stand_still};
pub(super) use place::{faults, number, place};

use super::friction::StickSlip;
use super::frozen::Frozen;
use super::passes::Work;
use crate::dynamics::integrate::{EventFunction, Guard, Probe};
use crate::dynamics::model::DryFriction;
use crate::math::quantity::Quantity;

/// Most contacts that are decided together.
pub(super) const MOST_TOGETHER: usize = 8;

/// A dry friction in the layout.
#[derive(Clone, Debug)]
pub(super) struct DryContact {
    /// Index into [`Frozen::loads`].
    pub(super) load: usize,
    /// Internal index of its node.
    pub(super) node: usize,
    /// Its numbers.
    pub(super) friction: DryFriction,
    /// Component of the modes; `None`: its motion is given.
    pub(super) component: Option<usize>,
    /// Signal that is the displacement of its node.
    signal: usize,
    /// Index of the object in the model.
    pub(super) object: usize,
    /// Its node first, then all that moves it, the driven before its drivers.
    ancestors: Vec<Ancestor>,
    /// Number of the set of contacts that are decided together.
    set: usize,
}

/// A node that moves the node of a contact.
#[derive(Clone, Debug)]
struct Ancestor {
    node: usize,
    source: Source,
}

/// What moves an ancestor: places among the ancestors.
#[derive(Clone, Debug)]
enum Source {
    /// A coordinate of its own, or a given motion.
    Root { free: bool },
    /// A law over the displacement of another.
    Law { law: usize, driver: usize },
    /// A constraint with several drivers.
    Constraint { index: usize, drivers: Vec<usize> },
}

impl DryContact {
    /// The free nodes that move it, by their places among the ancestors.
    fn free_roots(&self) -> impl Iterator<Item = usize> + '_ {
        let all = self.ancestors.iter().enumerate();
        all.filter(|(_, own)| matches!(own.source, Source::Root { free: true }))
            .map(|(place, _)| place)
    }

    /// True where one of these nodes moves it.
    pub(super) fn is_moved_by(&self, nodes: &[usize]) -> bool {
        self.ancestors.iter().any(|own| nodes.contains(&own.node))
    }

    /// State of a contact in the modes; `None` of one whose motion is given.
    pub(super) fn state(&self, modes: &[i64]) -> Option<StickSlip> {
        // (Motions are sampled without modes: nothing is known of a direction then.)
        let mode = |component: usize| modes.get(component).copied().unwrap_or_default();
        self.component
            .map(|component| StickSlip::of(mode(component)))
    }

    /// True where it holds its node at rest.
    pub(super) fn is_stuck(&self, modes: &[i64]) -> bool {
        self.state(modes) == Some(StickSlip::Stuck)
    }

    /// The force on its node while it slides; 0 at rest.
    pub(super) fn sliding_force<N: Quantity>(&self, speed: N, modes: &[i64]) -> N {
        let sense = match self.state(modes) {
            Some(state) => state.sense(),
            None if speed.value() == 0.0 => 0.0,
            None => speed.value().signum(),
        };
        if sense == 0.0 {
            return N::from(0.0);
        }
        // (A speed on the other side by rounding, or within an iteration, goes on smoothly.)
        speed.apply(|speed| {
            let [force, slope] = self.friction.at_speed(sense * speed);
            (-sense * force, -slope)
        })
    }
}

/// How far a contact is engaged: u ≥ 0.
pub(super) fn engagement<N: Quantity>(
    frozen: &Frozen,
    index: usize,
    (time, modes): (N, &[i64]),
    work: &Work<N>,
) -> N {
    let Some(written) = &frozen.loads[frozen.dry[index].load].written else {
        return N::from(1.0);
    };
    let engaged = written.force(time, modes, work);
    match engaged.value() <= 0.0 {
        true => N::from(0.0),
        false => engaged,
    }
}

/// Signals whose rates end a sliding.
pub(super) fn watch(frozen: &Frozen, modes: &[i64], out: &mut Vec<EventFunction>) {
    for contact in &frozen.dry {
        let Some(component) = contact.component else {
            continue;
        };
        let state = StickSlip::of(modes[component]);
        if state.slides() {
            let guard = Guard {
                signal: contact.signal,
                offset: 0.0,
                displacement: 0.0,
                speed: state.sense(),
            };
            out.push(EventFunction {
                guards: [guard, guard],
                rising: false,
                component,
                target: StickSlip::Stuck.mode(),
            });
        }
    }
}

/// Of every set of contacts the free nodes that move them.
pub(super) fn roots_of_sets(frozen: &Frozen) -> Vec<Vec<usize>> {
    let sets = 0..frozen.dry.len();
    let roots = sets.map(|set| {
        let own = frozen.dry.iter().filter(|contact| contact.set == set);
        let roots = own.flat_map(|contact| {
            let free = contact.free_roots();
            free.map(|place| contact.ancestors[place].node)
        });
        let mut roots: Vec<usize> = roots.collect();
        roots.sort_unstable();
        roots.dedup();
        roots
    });
    roots.filter(|roots| !roots.is_empty()).collect()
}

/// Number of the first probe of a dry contact: after those of joints and rigid contacts.
pub(super) fn first_probe(frozen: &Frozen) -> usize {
    frozen.friction_group_count() + frozen.contacts()
}

/// Probes of the contacts at rest: whether one breaks loose.
pub(super) fn probes(frozen: &Frozen, modes: &[i64], out: &mut Vec<Probe>) {
    for (index, contact) in frozen.dry.iter().enumerate() {
        if let Some(component) = contact.component.filter(|_| contact.is_stuck(modes)) {
            out.push(Probe {
                index: first_probe(frozen) + index,
                component,
                target: StickSlip::Unset.mode(),
                looks: LOOKS,
                refined: true,
            });
        }
    }
}

/// True of a component of the modes that is the state of a dry contact.
pub(super) fn has_component(frozen: &Frozen, component: usize) -> bool {
    (frozen.dry.iter()).any(|contact| contact.component == Some(component))
}

/// Power lost to every dry contact: object and loss (W), as of the last evaluation.
pub(super) fn losses<'a>(
    frozen: &'a Frozen,
    modes: &'a [i64],
    work: &'a Work<f64>,
) -> impl Iterator<Item = (usize, f64)> + 'a {
    frozen.dry.iter().map(move |contact| {
        let loss = match contact.is_stuck(modes) {
            true => 0.0,
            false => 0.0 - work.loads[contact.load] * work.speed[contact.node],
        };
        (contact.object, loss)
    })
}

/// Parts of a step in which a contact at rest is looked at, each of them again in parts where the
/// force bends: where it breaks loose is located by bisection.
const LOOKS: usize = 16;
