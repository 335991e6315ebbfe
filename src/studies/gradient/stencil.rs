//! Derivatives of the numbers of the equations by a number of the scene.
//!
//! A scene is lowered to numbers: inertias of masses, stiffnesses of links, the state at the start.
//! Each is a smooth function of a number of the scene, mostly a product of powers, and its
//! derivative follows from its values at a few places near by to almost all digits. The motion
//! itself is never differentiated so.

/// Side of a number on which a derivative holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Both.
    Both,
    /// Above alone: below it the scene cannot be.
    Above,
    /// Below alone.
    Below,
}

/// Derivatives of a row of numbers.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct RowDerivatives {
    pub(super) values: Vec<f64>,
    pub(super) side: Side,
    /// Distance of the places.
    pub(super) step: f64,
}

/// Places on either side.
const BESIDE: usize = 4;

/// Places on one side, if there is no other.
const AHEAD: usize = 6;

/// Steps that are tried, as shares of the parameter.
const SHARES: [f64; 4] = [5e-3, 5e-4, 5e-5, 5e-6];

/// Steps that are tried of a parameter that is zero.
const LENGTHS: [f64; 5] = [1e-3, 1e-5, 1e-1, 1e1, 1e3];

/// Error with which the first steps are taken.
const GOOD: f64 = 1e-10;

/// Greatest error with which any are.
const BEARABLE: f64 = 1e-7;

/// What rounding may move a number by.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Derivatives of a row of numbers. `centre`: the numbers at the value of the parameter, each with
/// the size by which it is rounded. `at`: those at another value, `None` where there are none of
/// the same form.
pub(super) fn derivatives(
    (value, centre): (f64, &[[f64; 2]]),
    at: &dyn Fn(f64) -> Option<Vec<f64>>,
) -> Option<RowDerivatives> {
    let steps: Vec<f64> = match value == 0.0 {
        true => LENGTHS.to_vec(),
        false => SHARES.iter().map(|share| share * value.abs()).collect(),
    };
    let mut best: Option<(f64, RowDerivatives)> = None;
    for step in steps {
        let Some((error, row)) = with_step((value, centre), step, at) else {
            continue;
        };
        if best.as_ref().is_none_or(|known| error < known.0) {
            best = Some((error, row));
        }
        if error <= GOOD {
            break;
        }
    }
    best.filter(|(error, _)| *error <= BEARABLE)
        .map(|best| best.1)
}

/// With one step, and the error relative to the derivatives.
fn with_step(
    (value, centre): (f64, &[[f64; 2]]),
    step: f64,
    at: &dyn Fn(f64) -> Option<Vec<f64>>,
) -> Option<(f64, RowDerivatives)> {
    let row = |sign: f64, number: usize| {
        at(value + sign * step * number as f64).filter(|row| row.len() == centre.len())
    };
    let rows = |sign: f64, count: usize| -> Option<Vec<Vec<f64>>> {
        (1..=count).map(|number| row(sign, number)).collect()
    };
    let made = |side, finer: Vec<f64>, coarser: Vec<f64>| {
        let error = centre.iter().enumerate().map(|(k, [_, size])| {
            let apart = (finer[k] - coarser[k]).abs() - ROUNDING * size / step;
            let scale = finer[k].abs() + size / value.abs().max(step);
            if apart > 0.0 { apart / scale } else { 0.0 }
        });
        let error = error.fold(0.0, f64::max);
        let made = RowDerivatives {
            values: finer,
            side,
            step,
        };
        (error, made)
    };
    match (rows(1.0, BESIDE), rows(-1.0, BESIDE)) {
        (Some(above), Some(below)) => {
            let of = |count: usize| central(centre.len(), step, &above[..count], &below[..count]);
            Some(made(Side::Both, of(BESIDE), of(BESIDE - 1)))
        }
        (Some(_), None) => {
            let above = rows(1.0, AHEAD)?;
            let of = |count: usize| one_sided(centre, step, &above[..count]);
            Some(made(Side::Above, of(AHEAD), of(AHEAD - 1)))
        }
        (None, Some(_)) => {
            let below = rows(-1.0, AHEAD)?;
            let of = |count: usize| one_sided(centre, -step, &below[..count]);
            Some(made(Side::Below, of(AHEAD), of(AHEAD - 1)))
        }
        (None, None) => None,
    }
}

/// Central differences of order 2m from m places on either side.
pub(in crate::studies) fn central(
    length: usize,
    step: f64,
    above: &[Vec<f64>],
    below: &[Vec<f64>],
) -> Vec<f64> {
    let m = above.len();
    let weight = |k: usize| {
        // (−1)^{k+1}·(m!)²/(k·(m−k)!·(m+k)!)
        let share: f64 = (1..=k)
            .map(|i| (m - k + i) as f64 / (m + i) as f64)
            .product();
        if k % 2 == 1 {
            share / k as f64
        } else {
            -share / k as f64
        }
    };
    let weights: Vec<f64> = (1..=m).map(weight).collect();
    let one = |index: usize| {
        let rows = above.iter().zip(below).zip(&weights);
        let sum: f64 = rows
            .map(|((above, below), weight)| weight * (above[index] - below[index]))
            .sum();
        sum / step
    };
    (0..length).map(one).collect()
}

/// Differences of order n from n places on one side.
fn one_sided(centre: &[[f64; 2]], step: f64, rows: &[Vec<f64>]) -> Vec<f64> {
    let n = rows.len();
    let weight = |k: usize| {
        // (−1)^{k+1}·(n over k)/k
        let binomial: f64 = (1..=k).map(|i| (n - k + i) as f64 / i as f64).product();
        if k % 2 == 1 {
            binomial / k as f64
        } else {
            -binomial / k as f64
        }
    };
    let weights: Vec<f64> = (1..=n).map(weight).collect();
    let one = |index: usize| {
        let rows = rows.iter().zip(&weights);
        let sum: f64 = rows
            .map(|(row, weight)| weight * (row[index] - centre[index][0]))
            .sum();
        sum / step
    };
    (0..centre.len()).map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(p: f64) -> Vec<f64> {
        vec![p.powf(-1.5), p * p, 7.0, (3.0 * p).sin(), 1e7 * p]
    }

    fn slopes(p: f64) -> Vec<f64> {
        let power = -1.5 * p.powf(-2.5);
        vec![power, 2.0 * p, 0.0, 3.0 * (3.0 * p).cos(), 1e7]
    }

    fn agree(found: &[f64], expected: &[f64], digits: f64) {
        for (found, expected) in found.iter().zip(expected) {
            approx::assert_relative_eq!(*found, *expected, max_relative = digits, epsilon = 1e-12);
        }
    }

    #[test]
    fn derivatives_on_both_sides_and_on_one_agree_with_closed_forms() {
        let (p, all) = (0.7, |p: f64| Some(row(p)));
        let sized: Vec<[f64; 2]> = row(p).into_iter().map(|one| [one, one.abs()]).collect();
        let found = derivatives((p, &sized), &all).unwrap();
        assert_eq!(found.side, Side::Both);
        agree(&found.values, &slopes(p), 1e-11);
        let above = |at: f64| (at >= p).then(|| row(at));
        let found = derivatives((p, &sized), &above).unwrap();
        assert_eq!(found.side, Side::Above);
        agree(&found.values, &slopes(p), 1e-8);
        let below = |at: f64| (at <= p).then(|| row(at));
        let found = derivatives((p, &sized), &below).unwrap();
        assert_eq!(found.side, Side::Below);
        agree(&found.values, &slopes(p), 1e-8);
    }

    #[test]
    fn a_kink_and_a_place_alone_have_no_derivative() {
        assert!(derivatives((0.7, &[[0.0; 2]]), &|_| None).is_none());
        let kink = |p: f64| Some(vec![(p - 0.701).abs()]);
        let found = derivatives((0.7, &[[0.001; 2]]), &kink).unwrap();
        // The first step reaches over the kink, a later one does not.
        assert!(found.step < 1e-3);
        approx::assert_relative_eq!(found.values[0], -1.0, max_relative = 1e-9);
        let root = |p: f64| Some(vec![(p - 0.7).abs().sqrt()]);
        assert!(derivatives((0.7 + 1e-7, &[[1e-7f64.sqrt(); 2]]), &root).is_none());
    }
}
