//! Strokes and transmission angles.

use super::extremes::{greatest_row, located};
use super::request::KinematicsRequest;
use super::{Stroke, Transmission};
use crate::dynamics::model::Coordinate;
use crate::kinematics::linkage::spec::{LinkageSpec, PairKind, PairSpec, PointOf};
use crate::kinematics::linkage::{Group, GroupKind, Structure};
use crate::math::roots::{bisect, middle};
use std::f64::consts::FRAC_PI_2;

/// Positions in a period at which the sense of an output is looked at.
const LOOKS: usize = 1440;

/// Strokes of outputs and sliding pairs that go to and fro once in a period.
pub(super) fn strokes(asked: &KinematicsRequest<'_>) -> Vec<Stroke> {
    let Some(period) = asked.linkage.range().period else {
        return Vec::new();
    };
    let spec = asked.linkage.spec();
    let outputs = (0..spec.outputs.len()).map(|index| {
        let unit = asked.outputs[index].unit();
        (
            MovingQuantity::Output(index),
            spec.outputs[index].name.clone(),
            unit,
        )
    });
    let slides = spec.pairs.iter().enumerate().filter_map(|(index, pair)| {
        let slides = matches!(pair.kind, PairKind::Sliding { .. });
        slides.then(|| {
            (
                MovingQuantity::Pair(index),
                format!("pairs.{}", pair.name),
                Coordinate::Sliding.unit(),
            )
        })
    });
    let mut work = asked.linkage.workspace();
    let all = outputs.chain(slides);
    all.filter_map(|(moving, owner, unit)| {
        let mut look = |q: f64, value: bool| {
            if asked.linkage.solve(q, 1, &mut work).is_err() {
                return f64::NAN;
            }
            let jet = match moving {
                MovingQuantity::Output(index) => asked.linkage.output(index, &work),
                MovingQuantity::Pair(index) => work.pair(index),
            };
            if value { jet.value } else { jet.first }
        };
        stroke_of(&mut look, asked.first_input(), period.length, (owner, unit))
    })
    .collect()
}

/// The stroke of something with a name and a unit that goes to and fro once in a period;
/// `look`: its displacement, or its derivative, at a place.
pub(super) fn stroke_of(
    look: &mut dyn FnMut(f64, bool) -> f64,
    from: f64,
    period: f64,
    (owner, unit): (String, &'static str),
) -> Option<Stroke> {
    let (ends, rise_and_return) = stroke(look, from, period)?;
    let [rise, fall] = rise_and_return;
    Some(Stroke {
        owner,
        unit,
        ends,
        rise_and_return,
        time_ratio: rise.max(fall) / rise.min(fall),
    })
}

#[derive(Clone, Copy)]
enum MovingQuantity {
    Output(usize),
    Pair(usize),
}

type Ends = ([(f64, f64); 2], [f64; 2]);

/// The two turning points of something that has just two in a period.
fn stroke(look: &mut dyn FnMut(f64, bool) -> f64, from: f64, period: f64) -> Option<Ends> {
    let place = |index: usize| from + period * index as f64 / LOOKS as f64;
    let senses: Vec<f64> = (0..LOOKS).map(|index| look(place(index), false)).collect();
    let largest = senses
        .iter()
        .fold(0.0, |best: f64, value| best.max(value.abs()));
    if !largest.is_finite() || largest == 0.0 {
        return None;
    }
    let mut turns = Vec::new();
    for index in 0..LOOKS {
        // The last place is the first one again: where the sense is zero but for
        // rounding there, it must not count differently at both ends.
        let (one, other) = (senses[index], senses[(index + 1) % LOOKS]);
        if (one > 0.0) != (other > 0.0) {
            turns.push((
                root(look, place(index), place(index + 1), one > 0.0),
                one > 0.0,
            ));
        }
    }
    let &[(first, first_is_top), (second, second_is_top)] = turns.as_slice() else {
        return None;
    };
    if first_is_top == second_is_top {
        return None;
    }
    let (top, foot) = if first_is_top {
        (first, second)
    } else {
        (second, first)
    };
    let rise = (top - foot).rem_euclid(period);
    let ends = [(foot, look(foot, true)), (top, look(top, true))];
    Some((ends, [rise, period - rise]))
}

/// Where the derivative changes sign between two places.
fn root(look: &mut dyn FnMut(f64, bool) -> f64, low: f64, high: f64, rises: bool) -> f64 {
    middle(bisect([low, high], 80, |place| {
        (look(place, false) > 0.0) == rises
    }))
}

/// Transmission angles of the dyads that have one, over the places.
pub(super) fn transmission(asked: &KinematicsRequest<'_>, places: &[f64]) -> Vec<Transmission> {
    let mut work = asked.linkage.workspace();
    let linkage = &asked.linkage;
    transmission_of(
        linkage.spec(),
        linkage.structure(),
        places,
        &mut |place, dyad| {
            let q = asked.input_at(place);
            match asked.linkage.solve(q.value, 0, &mut work) {
                Ok(()) => dyad.angle(&|point| work.point(point).map(|jet| jet.value), &|link| {
                    work.angle(link)
                }),
                Err(_) => f64::NAN,
            }
        },
    )
}

/// Transmission angles of dyads; `angle`: that of one at a place.
pub(super) fn transmission_of(
    spec: &LinkageSpec,
    structure: &Structure,
    places: &[f64],
    angle: &mut dyn FnMut(f64, &Dyad) -> f64,
) -> Vec<Transmission> {
    let mut found = Vec::new();
    for group in &structure.groups {
        let Some(dyad) = Dyad::of(spec, group) else {
            continue;
        };
        let mut angle = |place: f64| angle(place, &dyad);
        let values: Vec<f64> = places.iter().map(|&place| angle(place)).collect();
        let mut end = |sign: f64| {
            let row = greatest_row(&values, sign)?;
            Some(located(places, &values, row, sign, &mut angle))
        };
        let (Some(least), Some(greatest)) = (end(-1.0), end(1.0)) else {
            continue;
        };
        let owner = |link: usize| spec.links[link].name.clone();
        let names: Vec<String> = group.links.iter().map(|&link| owner(link)).collect();
        found.push(Transmission {
            owner: names.join(" and "),
            least,
            greatest,
        });
    }
    found
}

/// A dyad of which a transmission angle can be told.
pub(super) enum Dyad {
    /// Inner pin and the two outer ones.
    Pins([PointOf; 3]),
    /// Inner pin, outer pin, guide.
    Slider([PointOf; 2], PairSpec),
}

impl Dyad {
    fn of(spec: &LinkageSpec, group: &Group) -> Option<Self> {
        let within = |point: &PointOf| point.link.is_some_and(|link| group.links.contains(&link));
        let mut inner = None;
        let mut outer = Vec::new();
        let mut guide = None;
        for &pair in &group.pairs {
            let pair = &spec.pairs[pair];
            let both = within(&pair.on) && within(&pair.link);
            match (pair.slides(), both) {
                (false, true) => inner = Some(pair.link),
                (false, false) => outer.push(pair.link),
                (true, false) => guide = Some(pair.clone()),
                (true, true) => return None,
            }
        }
        match (group.kind, inner, outer.as_slice(), guide) {
            (GroupKind::Rrr, Some(inner), &[one, other], None) => {
                Some(Self::Pins([inner, one, other]))
            }
            (GroupKind::Rrp, Some(inner), &[one], Some(guide)) => {
                Some(Self::Slider([inner, one], guide))
            }
            _ => None,
        }
    }

    /// The angle (rad), between 0 and 90°, from places of points and angles of links.
    pub(super) fn angle(
        &self,
        at: &dyn Fn(PointOf) -> [f64; 2],
        turned: &dyn Fn(usize) -> f64,
    ) -> f64 {
        match self {
            Self::Pins([inner, one, other]) => {
                let (inner, one, other) = (at(*inner), at(*one), at(*other));
                acute(minus(one, inner), minus(other, inner))
            }
            Self::Slider([inner, one], guide) => {
                let PairKind::Sliding { direction, .. } = guide.kind else {
                    return f64::NAN;
                };
                let direction = direction + guide.on.link.map_or(0.0, turned);
                let rod = minus(at(*one), at(*inner));
                FRAC_PI_2 - acute(rod, [direction.cos(), direction.sin()])
            }
        }
    }
}

fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

/// Angle between two lines, 0 … 90°.
fn acute(a: [f64; 2], b: [f64; 2]) -> f64 {
    let cross = a[0] * b[1] - a[1] * b[0];
    let dot = a[0] * b[0] + a[1] * b[1];
    cross.abs().atan2(dot.abs())
}
