//! Laws of motion compared by what an elastic mechanism makes of them.

mod figure;

use super::run::RunResult;
use crate::dynamics::model::{Law, Model};
use crate::dynamics::record::Quantity;
use crate::kinematics::motion::law::LawConstants;
use crate::math::jet::Jet;
use crate::math::roots::{middle, try_bisect};
pub use figure::Figure;
use serde::Serialize;

/// A law in a comparison.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ComparedLaw {
    /// Name of the law.
    pub name: String,
    /// Constants of the law.
    pub constants: LawConstants,
    /// The mechanism's response.
    pub response: LawResponse,
}

/// Response of a mechanism to a law, in the window of steady figures.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct LawResponse {
    /// Residual vibration: half the range of δ over a dwell, the greatest over
    /// the dwells of the window; null without a dwell.
    pub residual: Option<f64>,
    /// Greatest |δ| of the whole run.
    pub deviation: f64,
    /// Greatest contact force of the whole run (reaction of link 1, without a pair).
    pub contact_force: f64,
    /// Greatest |U′·F|: torque (force) that the object asks of its driver,
    /// from the samples of the window.
    pub driver_torque: f64,
    /// Separations of the pair in the whole run; null without a pair.
    pub separations: Option<u64>,
    /// Lowest speed of the drive at which the pair opens in the window; null
    /// when it was not asked for.
    pub lift_off: Option<LiftOff>,
    /// Units of these numbers.
    #[serde(skip)]
    pub units: ResponseUnits,
}

/// Units of a response.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ResponseUnits {
    /// Of residual vibration and deviation.
    pub displacement: &'static str,
    /// Of the contact force.
    pub force: &'static str,
    /// Of the torque or force asked of the driver.
    pub driver_force: &'static str,
}

/// Speed at which a pair begins to open as the drive turns faster.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum LiftOff {
    /// At this speed (rad/s), to one part in 100 000.
    At(f64),
    /// Not up to this speed.
    Above(f64),
    /// Even at this speed, the lowest tried.
    Below(f64),
}

impl LiftOff {
    /// The same at another speed, a function of this one.
    pub(crate) fn map(self, speed: impl FnOnce(f64) -> f64) -> Self {
        match self {
            Self::At(found) => Self::At(speed(found)),
            Self::Above(tried) => Self::Above(speed(tried)),
            Self::Below(tried) => Self::Below(speed(tried)),
        }
    }
}

/// Share of the greatest U′ and U″ below which a law stands still.
const STILL: f64 = 1e-12;

/// The law that an object follows, and the index of its driver.
fn followed_law(model: &Model, object: usize) -> Option<(&Law, usize)> {
    let part = &model.objects[object];
    let driver = part.driver()?;
    let law = model.nodes[*part.nodes.first()?].motion.law()?;
    Some((law, driver))
}

/// The response of an object from a finished run. The record is to be dense:
/// residual vibration and torque are taken from its samples.
///
/// # Errors
/// The object is a drive, or the run has no window of steady figures, in words.
pub fn response(model: &Model, object: usize, result: &RunResult) -> Result<LawResponse, String> {
    let part = &model.objects[object];
    let (law, driver) =
        followed_law(model, object).ok_or_else(|| format!("`{}` follows no law", part.id))?;
    let run = &result.figures.run;
    let window = run.window.ok_or_else(|| {
        let reason = run.window_missing.as_deref().unwrap_or("no reason given");
        format!("there is no window of steady results: {reason}")
    })?;
    let column = |object: &str, quantity: Quantity| {
        let found = result.record.column(object, quantity);
        found.map(|column| column.values.as_slice()).unwrap_or(&[])
    };
    let angles = column(&model.objects[driver].id, Quantity::Displacement);
    let (deltas, reactions) = (
        column(&part.id, Quantity::Delta),
        column(&part.id, Quantity::Reaction),
    );
    let breaks = law.position.breaks();
    let rows = result.record.times.iter().enumerate();
    let samples: Vec<Sample> = rows
        .filter(|(_, time)| (window[0]..=window[1]).contains(*time))
        .filter_map(|(row, _)| {
            let phi = *angles.get(row)?;
            let segment = breaks.segment_at(phi, 1.0);
            Some(Sample {
                jet: law.position.jet(segment, phi).scaled(law.lever),
                delta: *deltas.get(row)?,
                reaction: *reactions.get(row)?,
            })
        })
        .collect();
    let figures = result.figures.objects.get(&part.id);
    let figures = figures.ok_or_else(|| format!("`{}` has no figures", part.id))?;
    let torques = samples.iter().map(|s| (s.jet.first * s.reaction).abs());
    Ok(LawResponse {
        residual: residual(&samples),
        deviation: figures.delta_abs,
        contact_force: match &figures.pair {
            Some(pair) => pair.max_contact_force,
            None => figures.peak_reaction,
        },
        driver_torque: torques.fold(0.0, f64::max),
        separations: figures.pair.as_ref().map(|pair| pair.separations),
        lift_off: None,
        units: ResponseUnits {
            displacement: Quantity::Delta.unit(part.coordinate),
            force: Quantity::Reaction.unit(part.coordinate),
            driver_force: Quantity::Reaction.unit(model.objects[driver].coordinate),
        },
    })
}

/// A row of the record with the law there.
struct Sample {
    jet: Jet,
    delta: f64,
    reaction: f64,
}

/// Half the range of δ over each stretch in which the law stands still; the greatest.
fn residual(samples: &[Sample]) -> Option<f64> {
    let greatest = |f: fn(&Jet) -> f64| {
        let values = samples.iter().map(|sample| f(&sample.jet).abs());
        STILL * values.fold(0.0, f64::max)
    };
    let (speed, acceleration) = (greatest(|j| j.first), greatest(|j| j.second));
    let still = |s: &Sample| s.jet.first.abs() <= speed && s.jet.second.abs() <= acceleration;
    let mut found: Option<f64> = None;
    for stretch in samples.chunk_by(|a, b| still(a) == still(b)) {
        if stretch.len() > 2 && still(&stretch[0]) {
            let start = (f64::INFINITY, f64::NEG_INFINITY);
            let (low, high) = stretch.iter().fold(start, |(low, high), sample| {
                (low.min(sample.delta), high.max(sample.delta))
            });
            let half = 0.5 * (high - low);
            found = Some(found.map_or(half, |other| other.max(half)));
        }
    }
    found
}

/// Ratio of neighbouring speeds tried in the search for lift-off.
const STEP: f64 = 1.2;
/// Most speeds tried upwards and downwards.
const MOST_STEPS: usize = 16;
/// Relative width to which lift-off is found.
const WIDTH: f64 = 1e-5;
/// More halvings than that width ever takes.
const HALVINGS: u32 = 100;

/// The speed at which a pair begins to open, near `start` > 0: from there in
/// steps of 20 % down to the first speed at which it stays closed, or up to
/// the first at which it opens, then bisection. `opens` is asked for single speeds.
///
/// Elastic mechanisms may close again beyond; what is found is one edge, the
/// nearest to `start`.
///
/// # Errors
/// The first error of `opens`.
pub fn lift_off<E>(
    start: f64,
    mut opens: impl FnMut(f64) -> Result<bool, E>,
) -> Result<LiftOff, E> {
    let begin = opens(start)?;
    let factor = if begin { 1.0 / STEP } else { STEP };
    let (mut near, mut far) = (start, start);
    let mut found = false;
    for _ in 0..MOST_STEPS {
        far = near * factor;
        if opens(far)? != begin {
            found = true;
            break;
        }
        near = far;
    }
    if !found {
        return Ok(match begin {
            true => LiftOff::Below(far),
            false => LiftOff::Above(far),
        });
    }
    let ends = if begin { [far, near] } else { [near, far] };
    edge_between(ends, opens).map(LiftOff::At)
}

/// The speed between a lower one at which a pair stays closed and a higher one at which it opens.
///
/// # Errors
/// The first error of `opens`.
pub(super) fn edge_between<E>(
    ends: [f64; 2],
    mut opens: impl FnMut(f64) -> Result<bool, E>,
) -> Result<f64, E> {
    let mut error = None;
    let found = try_bisect(ends, HALVINGS, WIDTH, |speed| match opens(speed) {
        Ok(opens) => Some(!opens),
        Err(first) => {
            error = Some(first);
            None
        }
    });
    match (found, error) {
        (_, Some(error)) => Err(error),
        (Ok(ends) | Err(ends), None) => Ok(middle(ends)),
    }
}

#[cfg(test)]
mod tests {
    use super::{ComparedLaw, Figure, LawResponse, LiftOff, Sample, lift_off, residual};
    use crate::kinematics::motion::{Law, LawName};
    use crate::math::jet::Jet;

    #[test]
    fn lift_off_is_found_above_and_below_and_its_limits_are_said() {
        let edge = 52.3;
        for start in [10.0, 52.0, 300.0] {
            let found = lift_off(start, |speed| Ok::<bool, ()>(speed > edge)).unwrap();
            let LiftOff::At(speed) = found else {
                panic!("{found:?}");
            };
            assert!((speed / edge - 1.0).abs() < 1e-5, "{speed}");
        }
        let never = lift_off(1.0, |_| Ok::<bool, ()>(false)).unwrap();
        assert!(matches!(never, LiftOff::Above(speed) if speed > 15.0));
        let always = lift_off(1.0, |_| Ok::<bool, ()>(true)).unwrap();
        assert!(matches!(always, LiftOff::Below(speed) if speed < 0.1));
        assert_eq!(lift_off(1.0, |_| Err("stopped")), Err("stopped"));
    }

    #[test]
    fn residual_vibration_is_half_the_range_in_the_worst_dwell() {
        let sample = |first: f64, delta: f64| Sample {
            jet: Jet {
                first,
                ..Jet::default()
            },
            delta,
            reaction: 0.0,
        };
        let mut samples = vec![sample(1.0, 9.0)];
        samples.extend([1.0, 3.0, 2.0].map(|delta| sample(0.0, delta)));
        samples.push(sample(1.0, -9.0));
        samples.extend([-1.0, 4.0, 2.0].map(|delta| sample(0.0, delta)));
        assert_eq!(residual(&samples), Some(2.5));
        assert_eq!(residual(&samples[..1]), None);
    }

    #[test]
    fn ranks_share_places_and_lift_off_is_better_the_higher() {
        let law = |name: LawName, force: f64, speed: f64| ComparedLaw {
            name: name.name().to_owned(),
            constants: Law::of_stroke(&name.into()).unwrap().constants(),
            response: LawResponse {
                contact_force: force,
                lift_off: Some(LiftOff::At(speed)),
                ..LawResponse::default()
            },
        };
        let laws = [
            law(LawName::Parabolic, 3.0, 10.0),
            law(LawName::Cycloidal, 2.0, 20.0),
            law(LawName::ModifiedTrapezoid, 2.0, 15.0),
        ];
        let places =
            |figure: Figure| -> Vec<usize> { figure.ranks(&laws).into_iter().flatten().collect() };
        assert_eq!(places(Figure::Acceleration), [1, 3, 2]);
        assert_eq!(places(Figure::Speed), [1, 1, 1]);
        assert_eq!(places(Figure::ContactForce), [3, 1, 1]);
        assert_eq!(places(Figure::LiftOff), [3, 1, 2]);
        assert!(places(Figure::Residual).is_empty());
    }
}
