//! The motion between two events as a power series of time.
//!
//! Without a change of contact the equations are linear with constant coefficients, and the
//! series about any instant converges everywhere. Its coefficients follow from each other:
//!
//! J·(k+1)(k+2)·q_{k+2} = W_k − springs·(q_k + R_k) − dampers·(k+1)(q_{k+1} + R_{k+1}) − F_k
//!                        + Σ lever·F_k(what it drives) − J·ratio·(k+1)(k+2)·L_{k+2}
//!
//! in the words of [`TreeProblem`](crate::exact::TreeProblem). All of them are numbers that may
//! carry derivatives, the instant of the expansion too.

use super::numbers::{LawNumbers, PartNumbers, TreeNumbers};
use crate::exact::{LAW_DEGREE, PairState};
use crate::math::number::Number;

/// Highest power of time. With steps of [`REACH`] the first term left out is below 10⁻¹⁷ of the
/// motion.
pub(super) const ORDER: usize = 24;

/// Coefficients of one signal.
pub(super) const TERMS: usize = ORDER + 1;

/// Length of a step times the greatest rate of the motion.
pub(super) const REACH: f64 = 2.0;

/// A signal about an instant, in powers of time.
pub(super) type Signal<N> = [N; TERMS];

/// The series of a tree about an instant.
#[derive(Clone, Debug)]
pub(super) struct Expansion<N> {
    /// L.
    pub(super) law: Signal<N>,
    /// q of every mass.
    pub(super) masses: Vec<Signal<N>>,
    /// W of every mass: value and slope.
    loads: Vec<[N; 2]>,
    inverses: Vec<N>,
    /// What links do to every mass, of one order.
    forces: Vec<N>,
}

/// The state of a tree at an instant.
#[derive(Clone, Debug)]
pub(super) struct TreeState<N> {
    pub(super) time: N,
    pub(super) displacement: Vec<N>,
    pub(super) speed: Vec<N>,
    pub(super) pairs: Vec<PairState>,
}

impl<N: Number> Expansion<N> {
    pub(super) fn new(numbers: &TreeNumbers<N>) -> Self {
        let count = numbers.masses.len();
        let zero = N::from(0.0);
        Self {
            law: [zero; TERMS],
            masses: vec![[zero; TERMS]; count],
            loads: vec![[zero; 2]; count],
            inverses: (numbers.masses.iter())
                .map(|mass| N::from(1.0) / mass.inertia)
                .collect(),
            forces: vec![zero; count],
        }
    }

    /// Expands the motion about a state.
    pub(super) fn expand(&mut self, numbers: &TreeNumbers<N>, state: &TreeState<N>) {
        self.expand_law(numbers, state.time);
        self.find_loads(numbers, state.time);
        for (mass, series) in self.masses.iter_mut().enumerate() {
            (series[0], series[1]) = (state.displacement[mass], state.speed[mass]);
        }
        for order in 0..ORDER - 1 {
            self.find_forces(numbers, &state.pairs, order);
            self.extend(numbers, order);
        }
    }

    fn expand_law(&mut self, numbers: &TreeNumbers<N>, time: N) {
        self.law = [N::from(0.0); TERMS];
        let (mean, slope, sines) = match &numbers.law {
            LawNumbers::Harmonic { mean, slope, sines } => (*mean, *slope, sines),
            LawNumbers::Parts(parts) => {
                if let Some(part) = part_at(parts, time.value()) {
                    part.expand(time, &mut self.law);
                }
                return;
            }
        };
        self.law[0] = mean + slope * time;
        self.law[1] = slope;
        for &[amplitude, frequency, phase] in sines {
            let angle = frequency * time + phase;
            let (sine, cosine) = angle.value().sin_cos();
            let mut pair = [
                amplitude * angle.compose(sine, cosine),
                amplitude * angle.compose(cosine, -sine),
            ];
            for k in 0..TERMS {
                self.law[k] += pair[0];
                let next = frequency.scale(1.0 / (k + 1) as f64);
                pair = [pair[1] * next, -pair[0] * next];
            }
        }
    }

    /// Value and slope of the loads just after an instant.
    fn find_loads(&mut self, numbers: &TreeNumbers<N>, time: N) {
        for (load, mass) in self.loads.iter_mut().zip(&numbers.masses) {
            *load = [mass.load, N::from(0.0)];
            for points in &mass.tables {
                let next = points
                    .iter()
                    .position(|point| point[0].value() > time.value());
                match next {
                    Some(0) => load[0] += points[0][1],
                    Some(k) => {
                        let [[t, w], [later, then]] = [points[k - 1], points[k]];
                        let slope = (then - w) / (later - t);
                        load[0] += w + slope * (time - t);
                        load[1] += slope;
                    }
                    None => load[0] += points.last().map_or(N::from(0.0), |point| point[1]),
                }
            }
        }
    }

    fn find_forces(&mut self, numbers: &TreeNumbers<N>, pairs: &[PairState], order: usize) {
        self.forces.fill(N::from(0.0));
        for (mass, own) in numbers.masses.iter().enumerate() {
            let Some(flank) = engaged_flank(own.flanks.len(), pairs[mass]) else {
                continue;
            };
            let rate = self.deformation(numbers, mass, flank, order + 1);
            let force = own.stiffness * self.deformation(numbers, mass, flank, order)
                + own.damping * rate.scale((order + 1) as f64);
            self.forces[mass] -= force;
            if let Some(parent) = own.parent {
                self.forces[parent] += own.lever * force;
            }
        }
    }

    /// A coefficient of the deformation of a link that stands on a flank, as it is pressed.
    fn deformation(
        &self,
        numbers: &TreeNumbers<N>,
        mass: usize,
        flank: Option<usize>,
        order: usize,
    ) -> N {
        let own = &numbers.masses[mass];
        let mut value = self.masses[mass][order];
        if let Some(parent) = own.parent {
            value -= own.lever * self.masses[parent][order];
        }
        if let (0, Some(flank)) = (order, flank) {
            let (sign, offset) = own.flanks[flank];
            value += offset.scale(sign);
        }
        value
    }

    fn extend(&mut self, numbers: &TreeNumbers<N>, order: usize) {
        let (k, next) = (order as f64, order + 1);
        let both = (k + 1.0) * (k + 2.0);
        for (mass, own) in numbers.masses.iter().enumerate() {
            let mut force = self.forces[mass];
            if order < 2 {
                force += self.loads[mass][order];
            }
            let mut place = self.masses[mass][order] + own.ratio * self.law[order];
            if order == 0 {
                place += own.offset;
            }
            let rate = self.masses[mass][next] + own.ratio * self.law[next];
            force -= own.ground_stiffness * place + own.ground_damping * rate.scale(k + 1.0);
            let free = (force * self.inverses[mass]).scale(1.0 / both);
            self.masses[mass][order + 2] = free - own.ratio * self.law[order + 2];
        }
    }

    /// The state a time after the instant of the expansion; the pairs stay as they are.
    pub(super) fn advance(&self, by: N, state: &mut TreeState<N>) {
        for (mass, series) in self.masses.iter().enumerate() {
            let [value, slope] = value_and_slope(series, by);
            (state.displacement[mass], state.speed[mass]) = (value, slope);
        }
        state.time += by;
    }

    /// The clearance from a flank: X = sign·x + offset.
    pub(super) fn clearance(
        &self,
        numbers: &TreeNumbers<N>,
        mass: usize,
        flank: usize,
    ) -> Signal<N> {
        let (sign, _) = numbers.masses[mass].flanks[flank];
        let mut signal = [N::from(0.0); TERMS];
        for (order, term) in signal.iter_mut().enumerate() {
            *term = self
                .deformation(numbers, mass, Some(flank), order)
                .scale(sign);
        }
        signal
    }

    /// The force of a link, c·x + b·ẋ, positive away from the flank it stands on; without a
    /// flank that of the deformation itself.
    pub(super) fn force(
        &self,
        numbers: &TreeNumbers<N>,
        mass: usize,
        flank: Option<usize>,
    ) -> Signal<N> {
        let own = &numbers.masses[mass];
        let sign = flank.map_or(1.0, |flank| own.flanks[flank].0);
        let mut signal = [N::from(0.0); TERMS];
        for order in 0..TERMS {
            let mut force = own.stiffness * self.deformation(numbers, mass, flank, order);
            if order < ORDER {
                let rate = self.deformation(numbers, mass, flank, order + 1);
                force += own.damping * rate.scale((order + 1) as f64);
            }
            signal[order] = force.scale(sign);
        }
        signal
    }

    /// δ of an object.
    pub(super) fn deviation(&self, numbers: &TreeNumbers<N>, object: usize) -> Signal<N> {
        let own = &numbers.objects[object];
        let mut signal = self.output(numbers, object);
        if let Some((driver, ratio)) = own.driver {
            for (term, driven) in signal.iter_mut().zip(&self.masses[driver]) {
                *term -= ratio * *driven;
            }
        }
        signal
    }

    fn output(&self, numbers: &TreeNumbers<N>, object: usize) -> Signal<N> {
        let mut signal = [N::from(0.0); TERMS];
        for &(mass, share) in &numbers.objects[object].output {
            for (term, own) in signal.iter_mut().zip(&self.masses[mass]) {
                *term += share * *own;
            }
        }
        signal
    }

    /// φ of the output of an object.
    pub(super) fn displacement(&self, numbers: &TreeNumbers<N>, object: usize) -> Signal<N> {
        let carried = &numbers.masses[numbers.objects[object].first];
        let mut signal = self.output(numbers, object);
        for (term, law) in signal.iter_mut().zip(&self.law) {
            *term += carried.ratio * *law;
        }
        signal[0] += carried.offset;
        signal
    }
}

/// The part of a law in force just after a time.
fn part_at<N: Number>(parts: &[PartNumbers<N>], time: f64) -> Option<&PartNumbers<N>> {
    let begun = parts.partition_point(|part| part.start.value() <= time);
    parts.get(begun.max(1) - 1)
}

impl<N: Number> PartNumbers<N> {
    /// Adds its law about an instant.
    fn expand(&self, time: N, law: &mut Signal<N>) {
        let after = time - self.start;
        let (share, rate) = (after / self.length, N::from(1.0) / self.length);
        // L̈ about the share: repeated synthetic division.
        let mut bend = self.acceleration;
        for first in 0..LAW_DEGREE {
            for power in (first..LAW_DEGREE).rev() {
                let above = bend[power + 1];
                bend[power] += share * above;
            }
        }
        let mut power = N::from(1.0);
        for (order, bend) in bend.into_iter().enumerate() {
            let both = ((order + 1) * (order + 2)) as f64;
            law[order + 2] = (bend * power).scale(1.0 / both);
            power = power * rate;
        }
        // L̇ and L from the start of the part on.
        let (mut speed, mut value) = (N::from(0.0), N::from(0.0));
        for (order, bend) in self.acceleration.iter().enumerate().rev() {
            speed = (speed + bend.scale(1.0 / (order + 1) as f64)) * share;
            let both = ((order + 1) * (order + 2)) as f64;
            value = (value + bend.scale(1.0 / both)) * share;
        }
        law[1] = self.speed + self.length * speed;
        law[0] = self.value + self.speed * after + self.length * self.length * share * value;
    }
}

/// The flank through which a link transmits a force, if it does; a bilateral link has none.
fn engaged_flank(flanks: usize, pair: PairState) -> Option<Option<usize>> {
    match (flanks, pair) {
        (0, _) => Some(None),
        (_, PairState::Engaged(flank)) => Some(Some(usize::from(flank))),
        (_, PairState::Free | PairState::Pressed(_)) => None,
    }
}

/// Value and slope of a signal.
pub(super) fn value_and_slope<N: Number>(signal: &Signal<N>, at: N) -> [N; 2] {
    let (mut value, mut slope) = (signal[ORDER], N::from(0.0));
    for term in signal[..ORDER].iter().rev() {
        slope = slope * at + value;
        value = value * at + *term;
    }
    [value, slope]
}

/// The derivative of a signal by time.
pub(super) fn derivative<N: Number>(signal: &Signal<N>) -> Signal<N> {
    let mut out = [N::from(0.0); TERMS];
    for order in 0..ORDER {
        out[order] = signal[order + 1].scale((order + 1) as f64);
    }
    out
}

/// The integral of a signal from the instant of its expansion on.
pub(super) fn integral<N: Number>(signal: &Signal<N>, to: N) -> N {
    let mut sum = N::from(0.0);
    for (order, term) in signal.iter().enumerate().rev() {
        sum = (sum + term.scale(1.0 / (order + 1) as f64)) * to;
    }
    sum
}
