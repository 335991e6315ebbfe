//! The least value of a function with kinks: the greatest of its tangents within a trust region.

use super::sqp::sqp;
use super::{Problem, Slopes, SmoothPiece, Values, dot};

/// Half the first trust region, as a share of the ranges.
const FIRST: f64 = 0.02;

/// Half the trust region at which nothing more is gained.
const LEAST: f64 = 1e-10;

/// Places that are tried at most.
const PLACES: usize = 100;

/// Tangents are kept within so many trust regions.
const REACH: f64 = 20.0;

/// Share of the promised fall that counts as kept.
const KEPT: f64 = 0.1;

/// Price of a violation, over that of the function.
const PRICE: f64 = 100.0;

/// Distance of a tangent below what it touches, within which it holds there.
const TOUCHES: f64 = 1e-8;

/// What a tangent may lie above the function elsewhere, relative.
const ABOVE: f64 = 1e-8;

/// Tangents at places nearer than this count as one, if their slopes do.
const ONE: f64 = 1e-9;

/// Where the method came to.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Bundle {
    /// The place.
    pub(crate) at: Vec<f64>,
    /// Its values.
    pub(crate) values: Values,
    /// The tangents that hold there.
    pub(crate) pieces: Vec<SmoothPiece>,
    /// True: no tangent promises anything any more.
    pub(crate) converged: bool,
}

/// What is known at a place: values and tangents.
struct Tangent {
    at: Vec<f64>,
    values: Values,
    slopes: Slopes,
}

/// Goes on from a place along the tangents at all places known; `None`: it has no values.
/// `digits`: the least fall that counts.
pub(crate) fn bundle(problem: &dyn Problem, start: &[f64], digits: f64) -> Option<Bundle> {
    let first = tangent(problem, start)?;
    let equalities = problem.equalities();
    let merit =
        |values: &Values| values.objective + PRICE * values.violations(equalities).sum::<f64>();
    let (mut at, mut values) = (first.at.clone(), first.values.clone());
    let mut seen = vec![(at.clone(), values.objective)];
    let mut known = vec![first];
    let (mut half, mut converged) = (FIRST, false);
    for _ in 0..PLACES {
        let model = Model {
            known: &known,
            at: &at,
            half,
            value: values.objective,
            equalities,
        };
        let step = model.step();
        let promised = merit(&values) - merit(&model.values_at(&step));
        if promised <= digits {
            if half <= LEAST {
                converged = true;
                break;
            }
            half *= 0.1;
            continue;
        }
        let Some(found) = tangent(problem, &step) else {
            half *= 0.25;
            continue;
        };
        let fall = merit(&values) - merit(&found.values);
        match fall >= KEPT * promised {
            true => {
                if fall >= 0.7 * promised {
                    half = (2.0 * half).min(0.25);
                }
                (at, values) = (found.at.clone(), found.values.clone());
            }
            // The new tangent may be what was missing.
            false => half *= 0.8,
        }
        seen.push((found.at.clone(), found.values.objective));
        known.push(found);
        known.retain(|one| distance(&one.at, &at) <= REACH * half.max(1e-7));
        known.retain(|one| !one.is_wrong(&seen, 4.0 * half));
        let here = [(at.clone(), values.objective)];
        known.retain(|one| !one.is_wrong(&here, f64::INFINITY));
        if known.is_empty() {
            known.extend(tangent(problem, &at));
        }
        if half < LEAST {
            converged = true;
            break;
        }
    }
    let pieces = pieces(&known, &at, &values);
    Some(Bundle {
        at,
        values,
        pieces,
        converged,
    })
}

fn tangent(problem: &dyn Problem, at: &[f64]) -> Option<Tangent> {
    Some(Tangent {
        at: at.to_vec(),
        values: problem.values(at)?,
        slopes: problem.slopes(at)?,
    })
}

fn distance(one: &[f64], other: &[f64]) -> f64 {
    let each = one.iter().zip(other).map(|(a, b)| (a - b).abs());
    each.fold(0.0, f64::max)
}

fn difference(one: &[f64], other: &[f64]) -> Vec<f64> {
    one.iter().zip(other).map(|(a, b)| a - b).collect()
}

impl Tangent {
    /// Whether it lies above the function at another place known nearby: differences across a
    /// kink give slopes that belong to no tangent.
    fn is_wrong(&self, seen: &[(Vec<f64>, f64)], nearby: f64) -> bool {
        seen.iter().any(|(place, value)| {
            distance(place, &self.at) <= nearby
                && self.at(place).objective > *value + ABOVE * (1.0 + value.abs())
        })
    }

    /// The tangents at another place.
    fn at(&self, place: &[f64]) -> Values {
        let step = difference(place, &self.at);
        let conditions = self.values.conditions.iter().zip(&self.slopes.conditions);
        Values {
            objective: self.values.objective + dot(&self.slopes.objective, &step),
            conditions: conditions
                .map(|(value, slope)| value + dot(slope, &step))
                .collect(),
        }
    }
}

/// The tangents that hold at a place, of the function and of every condition.
fn pieces(known: &[Tangent], at: &[f64], values: &Values) -> Vec<SmoothPiece> {
    let mut found: Vec<SmoothPiece> = Vec::new();
    let mut add = |condition: Option<usize>, slope: &[f64]| {
        let same = |one: &SmoothPiece| {
            one.condition == condition && distance(&one.slope, slope) <= ONE * (1.0 + norm(slope))
        };
        if !found.iter().any(same) {
            found.push(SmoothPiece {
                condition,
                slope: slope.to_vec(),
            });
        }
    };
    for one in known {
        let here = one.at(at);
        if (values.objective - here.objective).abs() <= TOUCHES {
            add(None, &one.slopes.objective);
        }
        let conditions = here.conditions.iter().zip(&values.conditions);
        for (own, (tangent, value)) in conditions.enumerate() {
            if (value - tangent).abs() <= TOUCHES {
                add(Some(own), &one.slopes.conditions[own]);
            }
        }
    }
    found
}

fn norm(slope: &[f64]) -> f64 {
    dot(slope, slope).sqrt()
}

/// The greatest of the tangents within a trust region: a linear programme in the steps and in a
/// bound on the function.
struct Model<'m> {
    known: &'m [Tangent],
    at: &'m [f64],
    half: f64,
    /// The function where the step begins.
    value: f64,
    equalities: usize,
}

impl Model<'_> {
    /// The place of the least value of the model.
    fn step(&self) -> Vec<f64> {
        let count = self.at.len();
        let mut start = vec![0.5; count + 1];
        let here: Vec<f64> = (0..count).map(|k| self.share_of(k, self.at[k])).collect();
        start[..count].copy_from_slice(&here);
        let (found, _) = sqp(self, &start, 1e-15, 100);
        (0..count).map(|k| self.place_of(k, found[k])).collect()
    }

    /// The greatest of the tangents.
    fn values_at(&self, place: &[f64]) -> Values {
        let all = self.known.iter().map(|one| one.at(place));
        let greater = |one: Values, other: Values| Values {
            objective: one.objective.max(other.objective),
            conditions: (one.conditions.iter().zip(&other.conditions))
                .map(|(a, b)| a.max(*b))
                .collect(),
        };
        let nothing = || Values {
            objective: f64::NEG_INFINITY,
            conditions: Vec::new(),
        };
        all.reduce(greater).unwrap_or_else(nothing)
    }

    fn ends(&self, k: usize) -> [f64; 2] {
        [
            (self.at[k] - self.half).max(0.0),
            (self.at[k] + self.half).min(1.0),
        ]
    }

    fn share_of(&self, k: usize, x: f64) -> f64 {
        let [low, high] = self.ends(k);
        ((x - low) / (high - low).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0)
    }

    fn place_of(&self, k: usize, share: f64) -> f64 {
        let [low, high] = self.ends(k);
        low + (high - low) * share
    }

    /// What the bound on the function may differ from its value, both ways.
    fn room(&self) -> f64 {
        let slopes = self.known.iter().map(|one| {
            let of_conditions = one.slopes.conditions.iter().map(|slope| norm(slope));
            of_conditions.fold(norm(&one.slopes.objective), f64::max)
        });
        2.0 * self.half * slopes.fold(1e-12, f64::max) * (self.at.len() as f64).sqrt()
    }

    fn place(&self, x: &[f64]) -> Vec<f64> {
        (0..self.at.len()).map(|k| self.place_of(k, x[k])).collect()
    }
}

impl Problem for Model<'_> {
    fn variables(&self) -> usize {
        self.at.len() + 1
    }

    fn equalities(&self) -> usize {
        0
    }

    fn inequalities(&self) -> usize {
        let own = self.known[0].values.conditions.len();
        // (An equality is held from both sides.)
        self.known.len() * (1 + own) + self.equalities
    }

    fn values(&self, x: &[f64]) -> Option<Values> {
        let (place, room) = (self.place(x), self.room());
        let bound = 2.0 * x[self.at.len()] - 1.0;
        let mut conditions = Vec::with_capacity(self.inequalities());
        for one in self.known {
            let here = one.at(&place);
            conditions.push((here.objective - self.value) / room - bound);
            conditions.extend(here.conditions.iter().map(|value| value / room));
        }
        let newest = self.known.last()?.at(&place);
        let equal = newest.conditions[..self.equalities].iter();
        conditions.extend(equal.map(|value| -value / room));
        Some(Values {
            objective: bound,
            conditions,
        })
    }

    fn slopes(&self, _: &[f64]) -> Option<Slopes> {
        let (count, room) = (self.at.len(), self.room());
        let scaled = |slope: &[f64], bound: f64, sign: f64| -> Vec<f64> {
            let each = (0..count).map(|k| {
                let [low, high] = self.ends(k);
                sign * slope[k] * (high - low) / room
            });
            each.chain([bound]).collect()
        };
        let mut conditions = Vec::with_capacity(self.inequalities());
        for one in self.known {
            conditions.push(scaled(&one.slopes.objective, -2.0, 1.0));
            let own = one.slopes.conditions.iter();
            conditions.extend(own.map(|slope| scaled(slope, 0.0, 1.0)));
        }
        let newest = &self.known.last()?.slopes.conditions[..self.equalities];
        conditions.extend(newest.iter().map(|slope| scaled(slope, 0.0, -1.0)));
        let mut objective = vec![0.0; count];
        objective.push(2.0);
        Some(Slopes {
            objective,
            conditions,
        })
    }
}
