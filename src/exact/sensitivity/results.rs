//! What is found about the objects of a tree, each number with its derivatives.

use super::expansion::{Expansion, Signal, TERMS, derivative, integral, value_and_slope};
use super::extremes::{ExtremeSearch, Greatest, Stretch};
use super::numbers::TreeNumbers;
use crate::exact::PairState;
use crate::math::number::Number;

/// Results of an object.
#[derive(Clone, Debug)]
pub(crate) struct ObjectResults<N> {
    /// δ.
    pub(crate) delta_max: Greatest<N>,
    /// −δ.
    pub(crate) delta_min: Greatest<N>,
    /// ∫|δ|dt over the run.
    pub(crate) area: N,
    /// |φ̇|.
    pub(crate) peak_speed: Greatest<N>,
    /// |φ̈|.
    pub(crate) peak_acceleration: Greatest<N>,
    /// |F| of link 1.
    pub(crate) peak_reaction: Greatest<N>,
    /// φ at the end.
    pub(crate) displacement: N,
    /// φ̇ at the end.
    pub(crate) speed: N,
    /// δ at the end.
    pub(crate) deviation: N,
    /// Of the driving pair, if it can open.
    pub(crate) pair: Option<PairResults<N>>,
}

/// Results of a pair that can open.
#[derive(Clone, Debug)]
pub(crate) struct PairResults<N> {
    /// Time of every event.
    pub(crate) switch_times: Vec<N>,
    pub(crate) separated_time: N,
    pub(crate) longest_separation: Greatest<N>,
    pub(crate) max_lift: Greatest<N>,
    pub(crate) max_approach_speed: Greatest<N>,
    pub(crate) max_contact_force: Greatest<N>,
    /// −(contact force), while it is closed.
    pub(crate) least_contact_force: Greatest<N>,
    /// Number of separations.
    pub(crate) separations: u64,
    /// Since when it has been open.
    open_since: Option<N>,
}

impl<N: Number> Default for PairResults<N> {
    fn default() -> Self {
        Self {
            switch_times: Vec::new(),
            separated_time: N::from(0.0),
            longest_separation: Greatest::default(),
            max_lift: Greatest::default(),
            max_approach_speed: Greatest::default(),
            max_contact_force: Greatest::default(),
            least_contact_force: Greatest::default(),
            separations: 0,
            open_since: None,
        }
    }
}

impl<N: Number> PairResults<N> {
    /// The pair begins open, or not.
    pub(super) fn begin(&mut self, engaged: bool, time: N) {
        self.open_since = (!engaged).then_some(time);
    }

    /// The pair opens or closes.
    pub(super) fn switch(&mut self, (before, after): (PairState, PairState), time: N) {
        self.switch_times.push(time);
        if before.engaged() {
            self.separations += 1;
            self.open_since = Some(time);
        }
        if after.engaged() {
            self.close(time);
        }
    }

    /// It is struck and stays open.
    pub(super) fn strike(&mut self, time: N) {
        self.close(time);
        self.open_since = Some(time);
    }

    /// It closes, or the run ends.
    pub(super) fn close(&mut self, time: N) {
        if let Some(from) = self.open_since.take() {
            let open = time - from;
            self.separated_time += open;
            self.longest_separation.offer(time.value(), open);
        }
    }
}

impl<N: Number> ObjectResults<N> {
    pub(super) fn new(can_open: bool) -> Self {
        let zero = N::from(0.0);
        Self {
            delta_max: Greatest::default(),
            delta_min: Greatest::default(),
            area: zero,
            peak_speed: Greatest::default(),
            peak_acceleration: Greatest::default(),
            peak_reaction: Greatest::default(),
            displacement: zero,
            speed: zero,
            deviation: zero,
            pair: can_open.then(PairResults::default),
        }
    }

    /// Takes a stretch of the motion in.
    pub(super) fn take(
        &mut self,
        (numbers, object): (&TreeNumbers<N>, usize),
        (motion, pair): (&Expansion<N>, PairState),
        stretch: Stretch<N>,
        places: &mut ExtremeSearch,
    ) {
        let deviation = motion.deviation(numbers, object);
        places.offer((1.0, &deviation), stretch, &mut self.delta_max);
        places.offer((-1.0, &deviation), stretch, &mut self.delta_min);
        self.area += area(&deviation, stretch.length, places);
        let displacement = motion.displacement(numbers, object);
        let speed = derivative(&displacement);
        let acceleration = derivative(&speed);
        for sign in [1.0, -1.0] {
            places.offer((sign, &speed), stretch, &mut self.peak_speed);
            places.offer((sign, &acceleration), stretch, &mut self.peak_acceleration);
        }
        self.deviation = value_and_slope(&deviation, stretch.length)[0];
        [self.displacement, self.speed] = value_and_slope(&displacement, stretch.length);
        let mass = numbers.objects[object].first;
        let Some(own) = &mut self.pair else {
            let force = motion.force(numbers, mass, None);
            for sign in [1.0, -1.0] {
                places.offer((sign, &force), stretch, &mut self.peak_reaction);
            }
            return;
        };
        if numbers.masses[mass].restitution.is_some() && pair.engaged() {
            return;
        }
        match pair {
            PairState::Engaged(flank) => {
                let force = motion.force(numbers, mass, Some(usize::from(flank)));
                places.offer((-1.0, &force), stretch, &mut own.max_contact_force);
                places.offer((1.0, &force), stretch, &mut own.least_contact_force);
            }
            PairState::Free | PairState::Pressed(_) => {
                own.take_lift((numbers, mass), motion, stretch, places);
            }
        }
    }
}

impl<N: Number> PairResults<N> {
    /// The clearance from the nearer flank.
    fn take_lift(
        &mut self,
        (numbers, mass): (&TreeNumbers<N>, usize),
        motion: &Expansion<N>,
        stretch: Stretch<N>,
        places: &mut ExtremeSearch,
    ) {
        let flanks = numbers.masses[mass].flanks.len();
        let clearances: Vec<Signal<N>> = (0..flanks)
            .map(|flank| motion.clearance(numbers, mass, flank))
            .collect();
        let [one, other] = match clearances.as_slice() {
            [only] => return places.offer((1.0, only), stretch, &mut self.max_lift),
            [one, other] => [one, other],
            _ => return,
        };
        // The nearer flank changes where both are as far: in the middle of the gap.
        let mut between = [N::from(0.0); TERMS];
        for (order, term) in between.iter_mut().enumerate() {
            *term = one[order] - other[order];
        }
        let length = stretch.length.value();
        let mut ends = vec![0.0];
        ends.extend_from_slice(places.sign_changes(&between, length));
        for &at in &ends[1..] {
            let [value, _] = value_and_slope(one, N::from(at));
            self.max_lift.offer(stretch.from + at, value);
        }
        for signal in [one, other] {
            let mut offered = Greatest::default();
            places.offer((1.0, signal), stretch, &mut offered);
            for (time, value) in offered.places {
                let at = N::from(time - stretch.from);
                let both = [one, other].map(|signal| value_and_slope(signal, at)[0].value());
                if value.value() <= both[0].min(both[1]) {
                    self.max_lift.offer(time, value);
                }
            }
        }
    }
}

/// ∫|signal|dt: a place where the signal is zero may move, which adds nothing.
fn area<N: Number>(signal: &Signal<N>, length: N, places: &mut ExtremeSearch) -> N {
    let changes = places.sign_changes(signal, length.value()).to_vec();
    let mut sum = N::from(0.0);
    let mut from = N::from(0.0);
    let mut start = 0.0;
    for to in changes.into_iter().map(N::from).chain([length]) {
        let integral = integral(signal, to);
        let middle = value_and_slope(signal, N::from(0.5 * (start + to.value())))[0].value();
        sum += (integral - from).scale(if middle < 0.0 { -1.0 } else { 1.0 });
        (from, start) = (integral, to.value());
    }
    sum
}
