//! Directions in which an optimum is none: nothing changes along them to second order.

use super::multipliers::Multipliers;
use super::{Problem, Slopes, Values, dot};
use nalgebra::DMatrix;

/// Step of second differences, as a share of the ranges.
const STEP: f64 = 1e-3;

/// Second derivative below which a direction is looked at.
const CURVATURE: f64 = 1e-5;

/// Slope, of a unit, that counts.
const SLOPE: f64 = 1e-6;

/// Change of the function and violation of a condition that count as none.
const NOTHING: f64 = 1e-9;

/// Shortest stretch that is one.
const SHORT: f64 = 1e-4;

/// Halvings by which the ends of a stretch are located.
const HALVINGS: usize = 40;

/// A stretch along which the least value is reached.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FlatDirection {
    /// Its ends.
    pub(crate) ends: [Vec<f64>; 2],
}

/// The stretches through an optimum along which nothing changes.
pub(crate) fn flat_directions(
    problem: &dyn Problem,
    at: &[f64],
    (values, slopes): (&Values, &Slopes),
    held: &Multipliers,
) -> Vec<FlatDirection> {
    let normals = normals(slopes, held, problem.equalities());
    let directions = free_directions(at.len(), &normals);
    let flat: Vec<Vec<f64>> = match directions.len() {
        0 => Vec::new(),
        1 => directions,
        _ => along_axes(directions),
    };
    let stretch = |direction: Vec<f64>| {
        let holds = |length: f64| {
            let place: Vec<f64> = at
                .iter()
                .zip(&direction)
                .map(|(x, d)| x + length * d)
                .collect();
            let inside = place.iter().all(|x| (-1e-12..=1.0 + 1e-12).contains(x));
            inside
                && problem.values(&place).is_some_and(|found| {
                    found.objective <= values.objective + NOTHING
                        && found.violation(problem.equalities())
                            <= values.violation(problem.equalities()) + NOTHING
                })
        };
        if !bends_not(problem, at, values, &direction) {
            return None;
        }
        let lengths = [-1.0, 1.0].map(|sign| sign * reach(|length| holds(sign * length)));
        let long = lengths[1] - lengths[0] >= SHORT;
        let end = |length: f64| -> Vec<f64> {
            let each = at.iter().zip(&direction);
            each.map(|(x, d)| (x + length * d).clamp(0.0, 1.0))
                .collect()
        };
        long.then(|| FlatDirection {
            ends: lengths.map(end),
        })
    };
    flat.into_iter().filter_map(stretch).collect()
}

/// Slopes of what holds the optimum, and that of the function.
fn normals(slopes: &Slopes, held: &Multipliers, equalities: usize) -> Vec<Vec<f64>> {
    let mut all = vec![slopes.objective.clone()];
    for (own, slope) in slopes.conditions.iter().enumerate() {
        if own < equalities || held.conditions[own] != 0.0 {
            all.push(slope.clone());
        }
    }
    for (variable, value) in held.bounds.iter().enumerate() {
        if *value != 0.0 {
            let mut slope = vec![0.0; held.bounds.len()];
            slope[variable] = 1.0;
            all.push(slope);
        }
    }
    all
}

/// Unit directions across all normals that count.
fn free_directions(count: usize, normals: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let sized = normals.iter().filter_map(|normal| {
        let size = dot(normal, normal).sqrt();
        (size > SLOPE).then(|| normal.iter().map(|x| x / size).collect::<Vec<f64>>())
    });
    let rows: Vec<Vec<f64>> = sized.collect();
    // (The product has as many eigenvectors as there are variables.)
    let product = DMatrix::from_fn(count, count, |a, b| {
        rows.iter().map(|row| row[a] * row[b]).sum::<f64>()
    });
    let found = product.symmetric_eigen();
    let free = (0..count).filter(|&k| found.eigenvalues[k].abs() <= 1e-9);
    free.map(|k| found.eigenvectors.column(k).iter().copied().collect())
        .collect()
}

/// A basis of several free directions, each with as few variables as may be: a variable that is
/// free by itself has a direction of its own.
fn along_axes(directions: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let count = directions[0].len();
    let mut rows = directions;
    let mut first = 0;
    for column in 0..count {
        let size = |row: &Vec<f64>| row[column].abs();
        let Some(pivot) =
            (first..rows.len()).max_by(|&a, &b| size(&rows[a]).total_cmp(&size(&rows[b])))
        else {
            break;
        };
        if size(&rows[pivot]) <= 1e-9 {
            continue;
        }
        rows.swap(first, pivot);
        let own: Vec<f64> = rows[first]
            .iter()
            .map(|x| x / rows[first][column])
            .collect();
        for (at, row) in rows.iter_mut().enumerate() {
            let share = row[column];
            if at == first {
                row.clone_from(&own);
            } else {
                row.iter_mut()
                    .zip(&own)
                    .for_each(|(x, own)| *x -= share * own);
            }
        }
        first += 1;
    }
    let unit = |row: Vec<f64>| -> Vec<f64> {
        let size = dot(&row, &row).sqrt();
        row.iter()
            .map(|x| {
                if x.abs() <= 1e-9 * size {
                    0.0
                } else {
                    x / size
                }
            })
            .collect()
    };
    rows.into_iter().map(unit).collect()
}

/// Whether the second difference of the function is none on one side at least.
fn bends_not(problem: &dyn Problem, at: &[f64], values: &Values, direction: &[f64]) -> bool {
    [-1.0, 1.0].into_iter().any(|sign| {
        let place = |steps: f64| -> Vec<f64> {
            let each = at.iter().zip(direction);
            each.map(|(x, d)| x + sign * steps * STEP * d).collect()
        };
        let inside = place(1.0).iter().all(|x| (0.0..=1.0).contains(x));
        inside
            && problem.values(&place(1.0)).is_some_and(|found| {
                (found.objective - values.objective).abs() <= CURVATURE * STEP * STEP
            })
    })
}

/// How far something holds, at most 2.
fn reach(holds: impl Fn(f64) -> bool) -> f64 {
    let mut good = 0.0;
    let mut next = SHORT;
    while next <= 2.0 && holds(next) {
        good = next;
        next *= 2.0;
    }
    let mut bad = next;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (good + bad);
        match holds(middle) {
            true => good = middle,
            false => bad = middle,
        }
    }
    good
}
