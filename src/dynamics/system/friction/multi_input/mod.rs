//! Joint friction of a linkage of several inputs.
//!
//! Its inputs go with any roots, so that it is found where the inertia forces of such linkages
//! are (`multi/couple`). The accelerations of the inputs without it and their mobility are known
//! there, `passes` finds friction and accelerations that agree, and the forces go on to the roots.
//!
//! Every pair with friction has a mode: in which direction it slides, or that friction holds it.
//! The rates of pairs are signals; where one passes zero, `decide` looks at all the ways in which
//! the pairs at rest may go on, and takes the one whose accelerations and forces agree with
//! Coulomb's law. What is held is looked at within every step (`probes`) until it breaks loose.
//!
//! With the rates A of the pairs by the inputs, T = Aᵀτ and q̈ = a₀ + G·Aᵀτ, G = ∂q̈/∂T. So the
//! equations are those of `dam forces`, τ = f(F₀ − K·τ), solved by the same iteration. A pair
//! at rest has a multiplier instead.
//!
//! Redundant multipliers have no numbers of their own. Whether pairs hold together follows from
//! the motions in which as many as possible of them stay at rest, as in the theory of plastic
//! hinges. Two combinations of directions that differ by rounding alone, at the limit of a
//! start, are one. A pair that passes a position in which it does not move (a guide in a
//! dead-centre position) is distinguished from one that stops by the rates of what moves with
//! it.
//!
//! Limits: no combination, or several, end the run. Sides of blocks are no modes here: the
//! error control of the steps handles a kink. A scene has one linkage with such friction, and
//! nothing that is solved together with it may be driven by its outputs rigidly; both are
//! refused.

mod continuations;
mod decide;
mod derivatives;
mod passes;
mod probes;
mod stops;

use super::{Obstacle, StickSlip};
use crate::dynamics::integrate::{EventFunction, Guard};
use crate::dynamics::model::MultiLinkageBody;
use crate::dynamics::system::frozen::Frozen;
use crate::dynamics::system::multi::{MultiPlace, MultiValue};
use crate::kinematics::linkage::kinetostatics::{ForceWorkspace, Kinetostatics, Sliding};
use crate::kinematics::linkage::multi::MultiMotion;
use crate::math::jet::Jet;
use crate::math::quantity::Quantity;
use std::sync::Arc;

/// Rate against its direction at which a pair counts as having come to rest (rad/s, or lengths of
/// the linkage a second): what starts from rest is not to turn back by rounding of its signal.
const TURNED_BACK: f64 = 1e-11;
/// The mode of a pair that has started from rest, times its direction: it slides as with ±1. Every
/// one more is ten times the rate against its direction that is passed over.
const JUST_STARTED: i64 = 3;
/// How far what rounding leaves of a rate must be from that.
const CLEAR: f64 = 4.0;

/// The linkage of several inputs whose joints have friction.
#[derive(Clone, Debug)]
pub(in crate::dynamics::system) struct Several {
    /// Index into [`Frozen::multi`].
    pub(in crate::dynamics::system) linkage: usize,
    /// Its first input among the carriers of inertia.
    pub(in crate::dynamics::system) first: usize,
    /// Index of the object in the model.
    pub(in crate::dynamics::system) object: usize,
    /// Component of the modes that says whether friction holds all of it.
    pub(in crate::dynamics::system) component: usize,
    kinetostatics: Arc<Kinetostatics>,
    /// The nodes of its outputs.
    pub(in crate::dynamics::system) outputs: Vec<usize>,
    pairs: Vec<RubbingPair>,
}

/// A pair with friction.
#[derive(Clone, Copy, Debug)]
struct RubbingPair {
    /// Its number in the linkage.
    pair: usize,
    /// Signal that is its coordinate.
    signal: usize,
    /// Component of the modes: its direction.
    component: usize,
    /// Rate that is rounding (rad/s or m/s).
    rounding: f64,
}

impl RubbingPair {
    /// The rate against its direction that is passed over in a mode.
    fn margin(&self, mode: i64) -> f64 {
        match mode.abs() - JUST_STARTED {
            tens @ 0.. => self.rounding * 10f64.powi(tens as i32),
            _ => 0.0,
        }
    }

    /// The mode in which it starts forwards, where rounding has left a rate.
    fn started(&self, rate: f64) -> i64 {
        let mut modes = JUST_STARTED..JUST_STARTED + 20;
        let enough = |mode: &i64| self.margin(*mode) >= CLEAR * rate.abs();
        modes.find(enough).unwrap_or(JUST_STARTED)
    }
}

impl Several {
    /// Modes of the pairs.
    fn states<'a>(&'a self, modes: &'a [i64]) -> impl Iterator<Item = StickSlip> + 'a {
        let pairs = self.pairs.iter();
        pairs.map(|pair| StickSlip::of(modes[pair.component]))
    }

    /// Number of components of the modes.
    pub(super) fn components(&self) -> usize {
        1 + self.pairs.len()
    }

    /// True of one of its components.
    pub(super) fn has_component(&self, component: usize) -> bool {
        (self.component..self.component + self.components()).contains(&component)
    }
}

/// Memory of its friction. m inputs, r roots.
#[derive(Clone, Debug)]
pub(in crate::dynamics::system) struct SeveralWork<N> {
    /// The motion of the inputs, and room for motions beside it.
    motion: MultiMotion,
    beside: MultiMotion,
    inputs: Vec<Jet>,
    forces: ForceWorkspace,
    /// What every pair does.
    sliding: Vec<Sliding>,
    loads: Vec<f64>,
    inertias: Vec<f64>,
    /// Accelerations of the inputs without friction (m).
    free: Vec<N>,
    /// ∂q̈/∂T (m × m), and its values.
    mobility: Vec<N>,
    mobility_values: Vec<f64>,
    /// What a unit of force on every input accelerates every root by (m × r).
    pub(in crate::dynamics::system) response: Vec<N>,
    /// T: the force of friction on every input (m).
    pub(in crate::dynamics::system) force: Vec<N>,
    /// Why there is none.
    failure: Option<Obstacle>,
}

impl Frozen {
    /// Memory for the friction of a linkage of several inputs; `None` without any.
    pub(in crate::dynamics::system) fn multi_input_friction_memory<N: Quantity>(
        &self,
    ) -> Option<Box<SeveralWork<N>>> {
        let several = self.several.as_ref()?;
        let multi = &self.multi[several.linkage];
        let motion = MultiMotion::new(&multi.linkage);
        let (inputs, outputs) = (multi.nodes.len(), several.outputs.len());
        let zero = N::from(0.0);
        Some(Box::new(SeveralWork {
            beside: motion.clone(),
            motion,
            inputs: Vec::with_capacity(inputs),
            forces: several.kinetostatics.workspace(),
            sliding: vec![Sliding::Idle; several.kinetostatics.spec().pairs.len()],
            loads: vec![0.0; outputs],
            inertias: vec![0.0; outputs],
            free: vec![zero; inputs],
            mobility: vec![zero; inputs * inputs],
            mobility_values: vec![0.0; inputs * inputs],
            response: vec![zero; inputs * self.roots.len()],
            force: vec![zero; inputs],
            failure: None,
        }))
    }

    /// Puts the friction of a linkage of several inputs into the layout; false where another
    /// one has friction already. Components are numbered afterwards.
    pub(in crate::dynamics::system) fn add_multi_input_friction(
        &mut self,
        linkage: usize,
        body: &MultiLinkageBody,
    ) -> bool {
        let friction = body.friction.as_ref().filter(|k| k.has_friction());
        let Some(kinetostatics) = friction else {
            return true;
        };
        if self.several.is_some() {
            return false;
        }
        let place = |pair| MultiPlace {
            linkage,
            value: MultiValue::Pair(pair),
        };
        let pairs = kinetostatics.pairs_with_friction().map(|pair| RubbingPair {
            pair,
            signal: self.add_signal_of(place(pair)),
            component: usize::MAX,
            rounding: TURNED_BACK * kinetostatics.length_scale() / kinetostatics.pair_unit(pair),
        });
        let pairs = pairs.collect();
        let before = self.multi[..linkage].iter();
        self.several = Some(Several {
            linkage,
            first: before.map(|multi| multi.nodes.len()).sum(),
            object: body.object,
            component: usize::MAX,
            kinetostatics: Arc::clone(kinetostatics),
            outputs: body.outputs.iter().map(|&o| self.internal[o]).collect(),
            pairs,
        });
        true
    }

    /// Numbers the components of its modes, from `first` on.
    pub(super) fn number_pairs(&mut self, first: usize) {
        if let Some(several) = &mut self.several {
            several.component = first;
            for (number, pair) in several.pairs.iter_mut().enumerate() {
                pair.component = first + 1 + number;
            }
        }
    }

    /// The reversals of its pairs to look for.
    pub(super) fn watch_pairs(&self, modes: &[i64], out: &mut Vec<EventFunction>) {
        let pairs = self.several.iter().flat_map(|several| &several.pairs);
        for pair in pairs {
            let state = StickSlip::of(modes[pair.component]);
            if !state.slides() {
                continue;
            }
            let guard = Guard {
                signal: pair.signal,
                offset: pair.margin(modes[pair.component]),
                displacement: 0.0,
                speed: state.sense(),
            };
            out.push(EventFunction {
                guards: [guard, guard],
                rising: false,
                component: pair.component,
                target: StickSlip::Stuck.mode(),
            });
        }
    }

    /// True where something that has inertia for several inputs hangs rigidly on an output of a
    /// linkage of several with friction: its forces are not among those of the outputs.
    pub(in crate::dynamics::system) fn passes_inertia_on(&self) -> bool {
        let Some(several) = &self.several else {
            return false;
        };
        let others = self.constraints.iter().filter(|one| match one.multi {
            Some(place) => place.linkage != several.linkage,
            None => one.heavy,
        });
        let mut drivers = others.flat_map(|one| &one.drivers);
        drivers.any(|&driver| several.outputs.contains(&self.path_to(driver).0))
    }
}
