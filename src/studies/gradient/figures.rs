//! The results that have derivatives, by their names.

use crate::exact::sensitivity::{Greatest, ObjectResults, PairResults};
use crate::math::number::{Duals, Number};

/// Results that are shown if none is named, as far as an object has them.
pub const DEFAULT_FIGURES: [&str; 6] = [
    "delta_max",
    "delta_min",
    "sigma",
    "peak_reaction",
    "pair.max_contact_force",
    "pair.separated_time",
];

/// Results of an object that have derivatives.
const NAMES: [&str; 16] = [
    "delta_abs",
    "delta_max",
    "delta_min",
    "sigma",
    "peak_speed",
    "peak_acceleration",
    "peak_reaction",
    "final.displacement",
    "final.speed",
    "pair.separated_time",
    "pair.longest_separation",
    "pair.max_lift",
    "pair.max_approach_speed",
    "pair.max_contact_force",
    "pair.margin",
    "pair.switch_times",
];

/// Names of the results of an object that have derivatives.
pub fn names() -> &'static [&'static str] {
    &NAMES
}

/// Results that count or answer.
const COUNTS: [(&str, &str); 4] = [
    ("pair.separations", "it counts: it changes by whole numbers"),
    ("pair.closures", "it counts: it changes by whole numbers"),
    (
        "pair.impacts.count",
        "it counts: it changes by whole numbers",
    ),
    (
        "pair.in_working_order",
        "it answers yes or no: see `pair.margin`",
    ),
];

/// A result with its derivatives.
#[derive(Clone, Debug)]
pub(super) enum Found<const K: usize> {
    /// A number.
    Number(Duals<K>),
    /// sign·(the greatest value), at all times at which it is reached.
    Greatest(f64, Vec<(f64, Duals<K>)>),
    /// It has no value, or no derivative.
    Nothing(&'static str),
}

/// A result of an object by its name; `None`: there is none of that name here. `end`: that of the
/// run.
pub(super) fn figure<const K: usize>(
    name: &str,
    own: &ObjectResults<Duals<K>>,
    end: Duals<K>,
) -> Option<Found<K>> {
    if let Some((_, why)) = COUNTS.iter().find(|(count, _)| *count == name) {
        return Some(Found::Nothing(why));
    }
    Some(match name {
        "delta_abs" => both(&own.delta_max, &own.delta_min),
        "delta_max" => greatest(1.0, &own.delta_max),
        "delta_min" => greatest(-1.0, &own.delta_min),
        "sigma" => Found::Number(own.area / end),
        "peak_speed" => greatest(1.0, &own.peak_speed),
        "peak_acceleration" => greatest(1.0, &own.peak_acceleration),
        "peak_reaction" => match &own.pair {
            Some(pair) => greatest(1.0, &pair.max_contact_force),
            None => greatest(1.0, &own.peak_reaction),
        },
        "final.displacement" => Found::Number(own.displacement),
        "final.speed" => Found::Number(own.speed),
        name => of_pair(name.strip_prefix("pair.")?, own.pair.as_ref())?,
    })
}

fn of_pair<const K: usize>(name: &str, pair: Option<&PairResults<Duals<K>>>) -> Option<Found<K>> {
    let Some(pair) = pair else {
        return Some(Found::Nothing("its driving pair cannot open"));
    };
    Some(match name {
        "separated_time" => Found::Number(pair.separated_time),
        "longest_separation" => greatest(1.0, &pair.longest_separation),
        "max_lift" => greatest(1.0, &pair.max_lift),
        "max_approach_speed" => greatest(1.0, &pair.max_approach_speed),
        "max_contact_force" => greatest(1.0, &pair.max_contact_force),
        "margin" => match pair.separations == 0 && pair.separated_time.value == 0.0 {
            true => greatest(-1.0, &pair.least_contact_force),
            false => Found::Nothing("the contact separates: nothing is left of its force"),
        },
        name => {
            let number = name.strip_prefix("switch_times.")?;
            let index: usize = number.parse().ok()?;
            match pair.switch_times.get(index) {
                Some(time) => Found::Number(*time),
                None => Found::Nothing("there are fewer events"),
            }
        }
    })
}

fn greatest<const K: usize>(sign: f64, found: &Greatest<Duals<K>>) -> Found<K> {
    match found.value() {
        Some(_) => Found::Greatest(sign, found.places.clone()),
        // What never happens stays so.
        None => Found::Number(Duals::from(0.0)),
    }
}

/// The greater of two greatest values.
fn both<const K: usize>(one: &Greatest<Duals<K>>, other: &Greatest<Duals<K>>) -> Found<K> {
    let value = |found: &Greatest<Duals<K>>| found.value().unwrap_or(f64::NEG_INFINITY);
    let best = value(one).max(value(other));
    let near = |place: &&(f64, Duals<K>)| place.1.value() >= best - 1e-9 * best.abs();
    let places = one.places.iter().chain(&other.places).filter(near);
    Found::Greatest(1.0, places.copied().collect())
}
