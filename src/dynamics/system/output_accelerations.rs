//! Accelerations of chains as the continuous output of a step tells them.
//!
//! The equations of motion find ü of a chain from its links' forces: an error of u is
//! magnified by the square of the chain's fastest rate ω. Where a method steps far over
//! vibrations that have died away, ω·h ≫ 1, its u between the stages is right to its
//! tolerance, and the forces that ü follows from are not. The second derivative of the
//! continuous output is: at the stages of collocation (`radau`) it is what the equations
//! give there, and that of `rodas5p` bends as its rates do.

use super::frozen::{Frozen, Step};
use super::passes::{Extent, Work};
use super::{ObjectState, Scratch, System};
use crate::dynamics::integrate::Modes;
use crate::math::polynomial;

/// From so many reciprocals of a chain's fastest rate on a step is long for it: below,
/// differentiating the output, of degree 5 to 9, loses more.
const LONG: f64 = 50.0;

/// Chains whose accelerations are read off the steps, and what those tell.
#[derive(Clone, Debug)]
pub(crate) struct OutputAccelerations {
    /// Fastest rate of each chain (1/s).
    rates: Vec<f64>,
    /// Whether the present step is long for it.
    long: Vec<bool>,
    /// ü of every coordinate.
    second: Vec<f64>,
}

impl OutputAccelerations {
    /// Of a system; no step yet.
    pub(crate) fn new(system: &System) -> Self {
        let frozen = &system.frozen;
        let rates: Vec<f64> = (0..frozen.chains.len())
            .map(|chain| frozen.fastest_of_chain(chain))
            .collect();
        Self {
            long: vec![false; rates.len()],
            second: vec![0.0; frozen.coordinates],
            rates,
        }
    }

    /// A step of a length (s) begins.
    pub(crate) fn begin_step(&mut self, length: f64) {
        for (long, rate) in self.long.iter_mut().zip(&self.rates) {
            *long = rate * length > LONG;
        }
    }

    /// True where the present step is long for some chain.
    pub(crate) fn is_wanted(&self) -> bool {
        self.long.contains(&true)
    }

    /// Reads a step at s.
    pub(crate) fn read(&mut self, step: &polynomial::Step<'_>, s: f64) {
        step.accelerations(s, &mut self.second);
    }

    /// Takes what was read of a step.
    pub(crate) fn set(&mut self, second: &[f64]) {
        self.second.copy_from_slice(second);
    }
}

impl Frozen {
    /// What the fastest vibration or decay of a chain's masses on its links may come
    /// to (1/s), by Gershgorin's bound.
    fn fastest_of_chain(&self, chain: usize) -> f64 {
        let chain = &self.chains[chain];
        let coordinates = chain.coordinates().skip(chain.points());
        let rate = |k: usize| {
            let weight = self.inverse_inertia[k];
            let (c, b) = (
                4.0 * self.stiffness[k] * weight,
                4.0 * self.damping[k] * weight,
            );
            c.sqrt().max(b)
        };
        let rates = coordinates.map(rate).filter(|rate| rate.is_finite());
        rates.fold(0.0, f64::max)
    }

    /// Puts ü of the chains that a step is long for in place of what their links'
    /// forces gave, and what follows them after them.
    fn amend(&self, bends: &OutputAccelerations, work: &mut Work<f64>) {
        for step in self.steps_of(Extent::Full) {
            match step {
                Step::Prescribed(_) | Step::Rotor(_) => {}
                Step::Rigid(index) => {
                    let rigid = self.rigids[*index];
                    work.acceleration[rigid.node] = self.law_acceleration(rigid.law, work);
                }
                Step::Chain(index) if bends.long[*index] => {
                    let chain = &self.chains[*index];
                    let base = self.law_acceleration(chain.law, work);
                    for (node, coordinate) in chain.nodes().zip(chain.coordinates()) {
                        work.acceleration[node] = bends.second[coordinate] + base;
                    }
                }
                Step::Chain(index) if self.is_held(*index, work) => {
                    let chain = &self.chains[*index];
                    work.acceleration[chain.first_node] = self.law_acceleration(chain.law, work);
                }
                Step::Chain(_) => {}
                Step::Constrained(index) => {
                    let node = self.constraints[*index].node;
                    work.acceleration[node] = self.constrained_acceleration(*index, work);
                }
            }
        }
    }
}

impl System {
    /// As [`System::observe`], with the accelerations that a step tells.
    pub(crate) fn observe_with_accelerations(
        &self,
        time: f64,
        y: &[f64],
        modes: &Modes,
        bends: &OutputAccelerations,
        scratch: &mut Scratch,
        out: &mut [ObjectState],
    ) {
        self.evaluate_fully(time, y, modes, scratch);
        self.frozen.amend(bends, &mut scratch.work);
        self.read_states(time, y, modes, &scratch.work, out);
    }
}
