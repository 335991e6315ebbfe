//! The first times at which conditions hold.
//!
//! Over a stretch without switches a condition is excluded by bounds of its signals
//! (`FittedVariables`); what they leave open is halved, the left half first, down to what the clock
//! resolves. No time at which a condition holds is stepped over; a stretch on which that
//! takes too much work is looked at in places, and is reported.
//!
//! All methods alike are watched. A run that `run.until` ends is made once to its `duration`
//! and once more to that instant.

use super::fitted::{FittedVariables, NODES, parts_of_stretch};
use crate::dynamics::audit::fastest_rate;
use crate::dynamics::model::Model;
use crate::dynamics::system::ObjectState;
use crate::math::chebyshev::Nodes;
use crate::math::expression::{Expression, VARIABLES};
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::rc::Rc;

/// Parts in a period of the fastest vibration there.
const IN_PERIOD: f64 = 2.0;
/// A part is halved down to this share of it, or to so many roundings of the time.
const SHORTEST: f64 = 1e-13;
const ROUNDINGS: f64 = 4.0;
/// Below this share of it, what changes less than it is known is not halved.
const NARROW: f64 = 1e-7;
/// Signals are fitted anew down to this share of a part.
const FINEST_FIT: f64 = 1e-9;
/// Most evaluations of bounds and most fits, for a condition on a part.
const MOST: usize = 20_000;
const MOST_FITS: usize = 200;
/// Evaluations on a part that are not counted, and most of the others, for a condition on
/// all parts.
const USUAL: usize = 200;
const MOST_OF_ALL: usize = 4_000_000;
/// Undecided parts after which a condition is only looked at in places.
const MOST_UNDECIDED: usize = 50;
/// Places at which what is undecided is looked at.
const PLACES: u64 = 64;

/// Looks for the first time of each condition of a model.
#[derive(Debug)]
pub(super) struct Watch {
    watched: Vec<WatchedCondition>,
    /// Parts in a second, of stretches that may have many vibrations.
    density: f64,
    nodes: Nodes<NODES>,
}

/// First times of conditions, by their names.
#[derive(Clone, Debug, Default)]
pub(crate) struct FirstTimes {
    /// `None`: it did not hold.
    pub(crate) times: BTreeMap<String, Option<f64>>,
    /// Those that may have held earlier, with the time (s) from which on that is not known.
    pub(crate) undetermined: BTreeMap<String, f64>,
}

#[derive(Debug)]
struct WatchedCondition {
    name: String,
    object: usize,
    expression: Expression,
    /// The variables that count.
    read: [bool; VARIABLES],
    /// When it holds first (s).
    met: Option<f64>,
    /// From when on it may have held without being seen (s), and on how many parts.
    undecided: Option<f64>,
    undecided_parts: usize,
    /// Evaluations of bounds, of parts that took many.
    spent: usize,
}

/// The variables of a condition.
fn variables(time: f64, state: &ObjectState) -> [f64; VARIABLES] {
    [
        time,
        state.displacement,
        state.speed,
        state.acceleration,
        state.delta,
        state.reaction,
        state.contact_force,
        state.lift,
    ]
}

/// What there is of a condition between two instants.
enum Part {
    Excluded,
    /// It holds from here on.
    Met(f64),
    /// From here on it could not be decided.
    Open(f64),
}

impl WatchedCondition {
    fn condition_holds(&self, values: &[f64; VARIABLES]) -> bool {
        let value = self.expression.at(values);
        value != 0.0 && !value.is_nan()
    }

    /// A part of a stretch; `look` gives the variables at an instant.
    fn watch_stretch(
        &mut self,
        [from, to]: [f64; 2],
        nodes: &Nodes<NODES>,
        look: &mut dyn FnMut(f64) -> [f64; VARIABLES],
    ) {
        let goes_on = self.undecided_parts < MOST_UNDECIDED && self.spent < MOST_OF_ALL;
        let (part, evaluations) = match goes_on {
            true => self.search([from, to], nodes, look),
            false => (Part::Open(from), 0),
        };
        self.spent += evaluations.saturating_sub(USUAL);
        match part {
            Part::Excluded => {}
            Part::Met(time) => self.met = Some(time),
            Part::Open(since) => {
                self.met = self.first_time_by_sampling([since, to], look);
                self.undecided_parts += 1;
                self.undecided.get_or_insert(since);
            }
        }
    }

    /// The first time at which it holds, by bounds, and how often these were evaluated.
    fn search(
        &self,
        [from, to]: [f64; 2],
        nodes: &Nodes<NODES>,
        look: &mut dyn FnMut(f64) -> [f64; VARIABLES],
    ) -> (Part, usize) {
        let length = to - from;
        let clock = ROUNDINGS * f64::EPSILON * from.abs().max(to.abs());
        let shortest = clock.max(SHORTEST * length);
        let (mut evaluations, mut fits) = (0, 1);
        let whole = Rc::new(FittedVariables::new([from, to], &self.read, nodes, look));
        let mut waiting = vec![(from, to, whole)];
        while let Some((low, high, fitted)) = waiting.pop() {
            let (bounds, changes) = fitted.bounds(low, high);
            if !self.expression.program().value.may_hold(&bounds) {
                continue;
            }
            evaluations += 1;
            let middle = low + 0.5 * (high - low);
            // (The time is known to its last digit.)
            let narrow = !self.read[0] && !changes && high - low <= NARROW * length;
            if narrow || high - low <= shortest || middle <= low || middle >= high {
                match self.first_time_at_ends([low, high], look) {
                    Some(time) => return (Part::Met(time), evaluations),
                    None => continue,
                }
            }
            if evaluations > MOST {
                return (Part::Open(low), evaluations);
            }
            let coarse = !fitted.is_resolved() && high - low > FINEST_FIT * length;
            let anew = coarse && fits + 2 <= MOST_FITS;
            fits += if anew { 2 } else { 0 };
            let mut half = |from: f64, to: f64| match anew {
                true => Rc::new(FittedVariables::new([from, to], &self.read, nodes, look)),
                false => Rc::clone(&fitted),
            };
            let (left, right) = (half(low, middle), half(middle, high));
            waiting.push((middle, high, right));
            waiting.push((low, middle, left));
        }
        (Part::Excluded, evaluations)
    }

    /// The first time at which it holds, of what is too short to be halved.
    fn first_time_at_ends(
        &self,
        [low, high]: [f64; 2],
        look: &mut dyn FnMut(f64) -> [f64; VARIABLES],
    ) -> Option<f64> {
        let mut holds = |time: f64| self.condition_holds(&look(time));
        if holds(low) {
            return Some(low);
        }
        holds(high).then(|| located([low, high], &mut holds))
    }

    /// The first of some places at which it holds, and from where on.
    fn first_time_by_sampling(
        &self,
        [from, to]: [f64; 2],
        look: &mut dyn FnMut(f64) -> [f64; VARIABLES],
    ) -> Option<f64> {
        let mut holds = |time: f64| self.condition_holds(&look(time));
        let mut before = None;
        for place in 0..=PLACES {
            let time = match place == PLACES {
                true => to,
                false => from + (to - from) * (place as f64 / PLACES as f64),
            };
            if holds(time) {
                return Some(before.map_or(time, |before| located([before, time], &mut holds)));
            }
            before = Some(time);
        }
        None
    }
}

impl Watch {
    pub(super) fn new(model: &Model) -> Self {
        let conditions = model.conditions.iter();
        let watched = conditions.filter_map(|condition| {
            let object = |part: &usize| model.objects[*part].id == condition.object;
            let program = condition.expression.program();
            Some(WatchedCondition {
                name: condition.name.clone(),
                object: (0..model.objects.len()).find(object)?,
                expression: condition.expression.clone(),
                read: std::array::from_fn(|variable| program.value.reads(variable)),
                met: None,
                undecided: None,
                undecided_parts: 0,
                spent: 0,
            })
        });
        let watched: Vec<WatchedCondition> = watched.collect();
        let density = match watched.is_empty() {
            true => 0.0,
            false => IN_PERIOD * fastest_rate(model) / TAU,
        };
        Self {
            watched,
            density,
            nodes: Nodes::new(),
        }
    }

    /// True while there is something to look for.
    pub(super) fn is_looking(&self) -> bool {
        self.watched.iter().any(|own| own.met.is_none())
    }

    /// The states of all objects at the start.
    pub(super) fn start(&mut self, time: f64, states: &[ObjectState]) {
        for own in &mut self.watched {
            let holds = own.condition_holds(&variables(time, &states[own.object]));
            own.met = holds.then_some(time);
        }
    }

    /// A stretch without switches; `look` gives the state of an object at an instant of it.
    /// `whole`: it may be many vibrations long, else it is a step.
    pub(super) fn watch_stretch(
        &mut self,
        [from, to]: [f64; 2],
        whole: bool,
        look: &mut dyn FnMut(f64, usize) -> ObjectState,
    ) {
        if !(to > from) {
            return;
        }
        let density = whole.then_some(self.density);
        for own in &mut self.watched {
            let object = own.object;
            let mut values = |time: f64| variables(time, &look(time, object));
            for part in parts_of_stretch([from, to], density) {
                if own.met.is_some() {
                    break;
                }
                own.watch_stretch(part, &self.nodes, &mut values);
            }
        }
    }

    /// The first time of each condition by its name.
    pub(super) fn finish(self) -> FirstTimes {
        let mut found = FirstTimes::default();
        for own in self.watched {
            let since = own.undecided.map(|since| (own.name.clone(), since));
            found.undetermined.extend(since);
            found.times.insert(own.name, own.met);
        }
        found
    }
}

/// The first number from which on it holds, between two instants of which it holds at the
/// second alone.
fn located([mut low, mut high]: [f64; 2], holds: &mut dyn FnMut(f64) -> bool) -> f64 {
    loop {
        let middle = low + 0.5 * (high - low);
        if middle <= low || middle >= high {
            return high;
        }
        match holds(middle) {
            true => high = middle,
            false => low = middle,
        }
    }
}
