//! Derivatives against differences of runs.
//!
//! The runs are those of `dam run`, of scenes read and lowered anew. They are made at four places
//! along a random direction of the parameters. A parameter that hardly matters for a result there
//! is moved by itself.

use super::derive::{Change, Subject, nearest, values_at};
use super::stencil::{RowDerivatives, Side};
use super::{CheckSummary, DerivativeVerdict, Gradient};

/// Most parameters with which runs are repeated unasked.
const MOST_PARAMETERS: usize = 5;

/// Most events with which they are.
const MOST_EVENTS: usize = 1000;

/// Difference that is always allowed.
const TOLERANCE: f64 = 1e-6;

/// Least share of a parameter in the change of a result along a direction that it is judged by.
const SHARE: f64 = 0.02;

/// Greatest relative change of the parameters along a direction.
const ALONG: f64 = 2e-4;

/// Greatest relative change of a parameter by itself.
const ALONE: f64 = 3e-3;

/// Share of the way to another sequence of events that is gone.
const WAY: f64 = 0.1;

/// Rounding of a result of a run, relative.
const ROUNDING: f64 = 4e-13;

/// The same of a mean: runs take it by quadrature.
const QUADRATURE: f64 = 1e-9;

/// Steps of different lengths of which each result takes the one that resolves it best.
const LEVELS: u32 = 3;

/// Ratio of one step to the one before.
const SHORTER: f64 = 0.15;

/// Most steps that are tried, those by which the sequence of events changes included.
const SHORTENED: u32 = 7;

/// A difference with a greater error confirms nothing.
const USELESS: f64 = 1e-3;

/// Whether runs are repeated unasked.
pub(super) fn is_cheap(found: &Gradient) -> bool {
    found.parameters.len() <= MOST_PARAMETERS && found.events <= MOST_EVENTS
}

/// A derivative along a direction and its error; `None`: the result has no value there.
type Slope = Option<(f64, f64)>;

/// A direction of the parameters with the differences of all results along it.
struct Differences {
    direction: Vec<f64>,
    /// Per result, where they are resolved best.
    slopes: Vec<Slope>,
}

/// Compares the derivatives with differences; those that differ are no longer answers.
pub(super) fn check(
    subject: &Subject<'_>,
    found: &mut Gradient,
    rows: &[Option<RowDerivatives>],
    near: &[Change],
) {
    let mut checker = Checker {
        subject,
        near,
        runs: 0,
    };
    let both = |k: usize| rows[k].as_ref().is_some_and(|row| row.side == Side::Both);
    let scale = |k: usize| match subject.parameters[k].value.abs() {
        // By itself it goes as far as its own derivatives were taken.
        0.0 => rows[k].as_ref().map_or(0.0, |row| row.step / ALONE),
        value => value,
    };
    let count = subject.parameters.len();
    let direction: Vec<f64> = (0..count)
        .map(|k| if both(k) { random(k) * scale(k) } else { 0.0 })
        .collect();
    let along = checker.differences(direction, ALONG, Side::Both);
    let mut alone: Vec<Option<Option<Differences>>> = (0..count).map(|_| None).collect();
    let mut summary = CheckSummary {
        runs: 0,
        compared: 0,
        worst: 0.0,
        failed: 0,
        why_not: String::new(),
    };
    for index in 0..found.figures.len() {
        let slopes: Vec<Option<f64>> = found.figures[index]
            .by
            .iter()
            .map(|one| one.derivative)
            .collect();
        if slopes.iter().all(Option::is_none) {
            continue;
        }
        let outcome = along
            .as_ref()
            .and_then(|along| along.compare(index, &slopes));
        for k in 0..count {
            let Some(slope) = slopes[k] else { continue };
            let shares = |along: &Differences| {
                let terms = slopes.iter().zip(&along.direction);
                let sum: f64 = terms
                    .map(|(slope, d)| slope.map_or(0.0, |s| (s * d).abs()))
                    .sum();
                (slope * along.direction[k]).abs() >= SHARE * sum
            };
            let counts = along.as_ref().is_some_and(shares) && outcome.is_some();
            let own = match counts {
                true => outcome,
                false => {
                    let differences = alone[k].get_or_insert_with(|| {
                        let side = rows[k].as_ref().map_or(Side::Both, |row| row.side);
                        let mut direction = vec![0.0; count];
                        direction[k] = scale(k);
                        checker.differences(direction, ALONE, side)
                    });
                    let only: Vec<Option<f64>> = (0..count)
                        .map(|other| if other == k { Some(slope) } else { Some(0.0) })
                        .collect();
                    differences
                        .as_ref()
                        .and_then(|one| one.compare(index, &only))
                }
            };
            let useful = own.filter(|(_, allowed)| *allowed <= USELESS);
            let Some((difference, allowed)) = useful else {
                continue;
            };
            let place = &mut found.figures[index].by[k];
            summary.compared += 1;
            summary.worst = summary.worst.max(difference);
            place.agrees_to = Some(difference);
            if difference > allowed {
                summary.failed += 1;
                let why = format!("differences of runs disagree by {difference:.1e} of it");
                place.verdict = DerivativeVerdict::NotDetermined { why };
                (place.derivative, place.elasticity) = (None, None);
            }
        }
    }
    summary.runs = checker.runs;
    if summary.compared == 0 {
        summary.why_not = "no step leaves the sequence of events as it is".to_owned();
    }
    found.check = Some(summary);
}

/// A share between ½ and 1 with a sign, the same whenever it is asked for.
fn random(k: usize) -> f64 {
    let mut state = (k as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    state = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    state = (state ^ (state >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    state ^= state >> 31;
    let share = 0.5 + 0.5 * (state >> 11) as f64 / (1u64 << 53) as f64;
    if state & 1 == 0 { share } else { -share }
}

struct Checker<'c> {
    subject: &'c Subject<'c>,
    near: &'c [Change],
    runs: usize,
}

impl Checker<'_> {
    /// Differences of all results along a direction, of order 4; `None`: there are none without
    /// another sequence of events.
    fn differences(&mut self, direction: Vec<f64>, most: f64, side: Side) -> Option<Differences> {
        if direction.iter().all(|d| *d == 0.0) {
            return None;
        }
        let slope = |slopes: &[f64]| slopes.iter().zip(&direction).map(|(s, d)| s * d).sum();
        let free = nearest(self.near, slope).map_or(f64::INFINITY, f64::abs);
        let mut step = most.min(WAY * free);
        let mut best: Option<Vec<Slope>> = None;
        let mut levels = 0;
        for _ in 0..SHORTENED {
            if let Some(slopes) = self.with_step(&direction, step, side) {
                levels += 1;
                best = Some(match best {
                    None => slopes,
                    Some(best) => best.into_iter().zip(slopes).map(better).collect(),
                });
            }
            if levels == LEVELS {
                break;
            }
            step *= SHORTER;
        }
        best.map(|slopes| Differences { direction, slopes })
    }

    fn with_step(&mut self, direction: &[f64], step: f64, side: Side) -> Option<Vec<Slope>> {
        let places = match side {
            Side::Both => [-2.0, -1.0, 0.0, 1.0, 2.0],
            Side::Above => [0.0, 1.0, 2.0, 3.0, 4.0],
            Side::Below => [0.0, -1.0, -2.0, -3.0, -4.0],
        };
        let mut all = Vec::with_capacity(places.len());
        for place in places {
            let moved = self.subject.parameters.iter().zip(direction);
            let values: Vec<f64> = moved.map(|(p, d)| p.value + place * step * d).collect();
            self.runs += 1;
            all.push(values_at(self.subject, &values)?);
        }
        if all.iter().any(|one| one.1 != all[0].1) {
            return None;
        }
        let slope = |index: usize| {
            let rounding = match self.subject.figures[index].0.ends_with(".sigma") {
                true => QUADRATURE,
                false => ROUNDING,
            };
            let values: Vec<f64> = all.iter().map(|one| one.0[index]).collect::<Option<_>>()?;
            let [a, b, c, d, e] = values[..] else {
                return None;
            };
            let (fine, coarse) = match side {
                Side::Both => ((8.0 * (d - b) - (e - a)) / 12.0, (d - b) / 2.0),
                Side::Above | Side::Below => {
                    let fine = -25.0 / 12.0 * a + 4.0 * b - 3.0 * c + 4.0 / 3.0 * d - 0.25 * e;
                    let coarse = -11.0 / 6.0 * a + 3.0 * b - 1.5 * c + d / 3.0;
                    match side {
                        Side::Below => (-fine, -coarse),
                        Side::Both | Side::Above => (fine, coarse),
                    }
                }
            };
            let size = values
                .iter()
                .fold(0.0, |most: f64, value| most.max(value.abs()));
            let (fine, apart) = (fine / step, (fine - coarse).abs() / step);
            let higher = apart * (30.0 * apart / fine.abs().max(apart)).min(1.0);
            Some((fine, higher + rounding * size / step))
        };
        Some((0..self.subject.figures.len()).map(slope).collect())
    }
}

/// Of two differences the one that is known better.
fn better((one, other): (Slope, Slope)) -> Slope {
    match (one, other) {
        (Some(a), Some(b)) if a.1 <= b.1 => Some(a),
        (_, Some(b)) => Some(b),
        (one, None) => one,
    }
}

impl Differences {
    /// The relative difference from derivatives, and how much is allowed.
    fn compare(&self, index: usize, slopes: &[Option<f64>]) -> Option<(f64, f64)> {
        let (slope, error) = self.slopes[index]?;
        let (mut sum, mut size) = (0.0, 0.0);
        for (own, d) in slopes.iter().zip(&self.direction) {
            if *d != 0.0 {
                let term = (*own)? * d;
                sum += term;
                size += f64::abs(term);
            }
        }
        let scale = size.max(slope.abs());
        match scale == 0.0 {
            true => Some((0.0, TOLERANCE)),
            false => Some(((slope - sum).abs() / scale, TOLERANCE.max(error / scale))),
        }
    }
}
