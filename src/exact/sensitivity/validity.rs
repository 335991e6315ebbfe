//! How near the sequence of events is to another one.
//!
//! Every pair function that is watched, a clearance or a contact force, stays on its side of zero
//! between two events. Its least value there is the gap by which an event is missed; its greatest
//! value is what a phase would have to lose to vanish. Either becomes zero, to first order, at
//! the change −value/derivative of a parameter.

use super::expansion::{Expansion, Signal, value_and_slope};
use super::extremes::{ExtremeSearch, Greatest, Stretch};
use super::numbers::TreeNumbers;
use crate::exact::PairState;
use crate::math::number::Number;

/// A clearance that becomes zero without being negative, as far as rounding can tell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Touch {
    /// Time (s).
    pub(crate) time: f64,
    /// Mass whose link holds the pair.
    pub(crate) mass: usize,
    /// Flank that is touched.
    pub(crate) flank: usize,
}

/// What is found of the sequence of events.
#[derive(Clone, Debug)]
pub(super) struct Found<N> {
    /// Pair functions, positive, that change the sequence where they become zero.
    pub(super) near: Vec<N>,
    /// Where it changes right here, with the clearances.
    pub(super) touches: Vec<(Touch, N)>,
}

impl<N: Number> Default for Found<N> {
    fn default() -> Self {
        Self {
            near: Vec::new(),
            touches: Vec::new(),
        }
    }
}

/// Share of the range of a clearance below which it counts as zero.
const TOUCH: f64 = 1e-12;

/// The pair functions of one mass since its last event.
#[derive(Clone, Debug)]
pub(super) struct PairPhase<N> {
    height: Greatest<N>,
    begun: bool,
}

impl<N: Number> Default for PairPhase<N> {
    fn default() -> Self {
        Self {
            height: Greatest::default(),
            begun: false,
        }
    }
}

/// The functions that end a phase of a pair where they vanish, positive before; the first is
/// what the phase has gained.
fn guards<N: Number>(
    (numbers, mass): (&TreeNumbers<N>, usize),
    motion: &Expansion<N>,
    pair: PairState,
) -> Vec<Signal<N>> {
    let negative = |mut signal: Signal<N>| {
        for term in &mut signal {
            *term = -*term;
        }
        signal
    };
    let own = &numbers.masses[mass];
    match pair {
        PairState::Engaged(_) if own.restitution.is_some() => Vec::new(),
        PairState::Engaged(f) => vec![negative(motion.force(numbers, mass, Some(usize::from(f))))],
        PairState::Pressed(f) => {
            let flank = usize::from(f);
            vec![
                motion.force(numbers, mass, Some(flank)),
                negative(motion.clearance(numbers, mass, flank)),
            ]
        }
        PairState::Free => (0..own.flanks.len())
            .map(|flank| motion.clearance(numbers, mass, flank))
            .collect(),
    }
}

impl<N: Number> PairPhase<N> {
    /// Takes a stretch in; adds the events that it misses.
    pub(super) fn take(
        &mut self,
        tree: (&TreeNumbers<N>, usize),
        (motion, pair): (&Expansion<N>, PairState),
        stretch: Stretch<N>,
        (places, found): (&mut ExtremeSearch, &mut Found<N>),
    ) {
        for (number, guard) in guards(tree, motion, pair).iter().enumerate() {
            if number == 0 {
                places.offer((1.0, guard), stretch, &mut self.height);
            }
            let length = stretch.length.value();
            for at in places.extremes(guard, length).to_vec() {
                let [value, _] = value_and_slope(guard, N::from(at));
                if bend(guard, at) <= 0.0 {
                    continue;
                }
                let is_clearance = pair == PairState::Free;
                if is_clearance && value.value().abs() <= TOUCH * size(guard, length) {
                    let touch = Touch {
                        time: stretch.from + at,
                        mass: tree.1,
                        flank: number,
                    };
                    found.touches.push((touch, value));
                } else if value.value() > 0.0 {
                    found.near.push(value);
                }
            }
        }
        self.begun = true;
    }

    /// What is left at the end of the run of what would end the phase.
    pub(super) fn left(
        tree: (&TreeNumbers<N>, usize),
        (motion, pair): (&Expansion<N>, PairState),
        length: N,
        near: &mut Vec<N>,
    ) {
        let guards = guards(tree, motion, pair);
        let values = guards.iter().map(|guard| value_and_slope(guard, length)[0]);
        near.extend(values.filter(|value| value.value() > 0.0));
    }

    /// Its end: by an event, or with the run.
    pub(super) fn end(&mut self, near: &mut Vec<N>) {
        let own = std::mem::take(self);
        if !own.begun {
            return;
        }
        let greatest = own.height.value();
        let place = own.height.places.into_iter().find(|place| {
            greatest.is_some_and(|greatest| place.1.value() == greatest && greatest > 0.0)
        });
        near.extend(place.map(|(_, value)| value));
    }
}

/// A bound of the size of a signal.
fn size<N: Number>(signal: &Signal<N>, length: f64) -> f64 {
    let terms = signal.iter().rev();
    terms.fold(0.0, |sum, term| sum * length + term.value().abs())
}

/// Second derivative at a place.
fn bend<N: Number>(signal: &Signal<N>, at: f64) -> f64 {
    let mut sum = 0.0;
    for (order, term) in signal.iter().enumerate().skip(2).rev() {
        sum = sum * at + (order * (order - 1)) as f64 * term.value();
    }
    sum
}
