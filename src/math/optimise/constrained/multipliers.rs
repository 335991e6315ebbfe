//! What holds an optimum: the multipliers of Karush, Kuhn and Tucker.

use super::nonnegative::nonnegative;
use super::{Problem, Slopes, dot};
use nalgebra::{DMatrix, DVector};

/// Distance from 0 or 1 within which a variable counts as at its bound.
const AT_BOUND: f64 = 1e-7;

/// Size below which the slope of a condition is none.
const FLAT: f64 = 1e-9;

/// Weight of the sum of the shares of the function in the equations.
const WEIGHT: f64 = 1e3;

/// A tangent that holds near a place, of the function or of a condition.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SmoothPiece {
    /// Of which condition; `None`: of the function.
    pub(crate) condition: Option<usize>,
    /// Its slope.
    pub(crate) slope: Vec<f64>,
}

/// What holds an optimum.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Multipliers {
    /// Per condition: by how much the least value falls for one that is looser by one; of an
    /// equality, by how much it falls for a value that is greater by one.
    pub(crate) conditions: Vec<f64>,
    /// Per variable: by how much the least value rises for a bound that is greater by one; zero
    /// where it is not at a bound.
    pub(crate) bounds: Vec<f64>,
    /// What is left of the slope of the function: zero at an optimum.
    pub(crate) residual: f64,
}

impl SmoothPiece {
    /// The function and all conditions at a place at which all are smooth.
    pub(crate) fn all(slopes: &Slopes) -> Vec<Self> {
        let objective = Self {
            condition: None,
            slope: slopes.objective.clone(),
        };
        let conditions = slopes.conditions.iter().enumerate();
        let conditions = conditions.map(|(at, slope)| Self {
            condition: Some(at),
            slope: slope.clone(),
        });
        std::iter::once(objective).chain(conditions).collect()
    }
}

/// The multipliers at a place: of the conditions that are `active` there, by the tangents of the
/// function and of the conditions.
pub(crate) fn multipliers(
    problem: &dyn Problem,
    at: &[f64],
    active: &[bool],
    pieces: &[SmoothPiece],
) -> Multipliers {
    let count = at.len();
    let mut columns: Vec<(Owner, Vec<f64>)> = Vec::new();
    for piece in pieces {
        match piece.condition {
            None => columns.push((Owner::Objective, piece.slope.clone())),
            Some(own) if own < problem.equalities() => {
                columns.push((Owner::Condition(own, 1.0), piece.slope.clone()));
                let other = piece.slope.iter().map(|slope| -slope).collect();
                columns.push((Owner::Condition(own, -1.0), other));
            }
            Some(own) if active[own] => {
                columns.push((Owner::Condition(own, 1.0), piece.slope.clone()));
            }
            Some(_) => {}
        }
    }
    for (variable, x) in at.iter().enumerate() {
        for (is_there, sign) in [(*x <= AT_BOUND, -1.0), (*x >= 1.0 - AT_BOUND, 1.0)] {
            if is_there {
                let mut slope = vec![0.0; count];
                slope[variable] = sign;
                columns.push((Owner::Bound(variable, sign), slope));
            }
        }
    }
    // All columns have one size: units of conditions do not matter.
    let of_function = columns
        .iter()
        .filter(|(owner, _)| matches!(owner, Owner::Objective));
    let scale = of_function
        .map(|(_, slope)| dot(slope, slope).sqrt())
        .fold(0.0, f64::max);
    // A slope that is rounding holds nothing.
    columns.retain(|(owner, slope)| match owner {
        Owner::Objective | Owner::Bound(..) => true,
        Owner::Condition(..) => dot(slope, slope).sqrt() > FLAT,
    });
    let mut found = Multipliers {
        conditions: vec![0.0; active.len()],
        bounds: vec![0.0; count],
        residual: 0.0,
    };
    if scale == 0.0 {
        return found;
    }
    let sizes: Vec<f64> = (columns.iter())
        .map(|(owner, slope)| match owner {
            Owner::Objective => scale,
            Owner::Condition(..) | Owner::Bound(..) => {
                dot(slope, slope).sqrt().max(f64::MIN_POSITIVE)
            }
        })
        .collect();
    let matrix = DMatrix::from_fn(count + 1, columns.len(), |row, column| {
        let (owner, slope) = &columns[column];
        match (row < count, owner) {
            (true, _) => slope[row] / sizes[column],
            (false, Owner::Objective) => WEIGHT,
            (false, Owner::Condition(..) | Owner::Bound(..)) => 0.0,
        }
    });
    let mut right = DVector::zeros(count + 1);
    right[count] = WEIGHT;
    let shares = nonnegative(&matrix, &right);
    let left = &matrix * &shares - right;
    found.residual = (left.rows(0, count).norm() + left[count].abs()) * scale;
    for ((owner, _), (share, size)) in columns.iter().zip(shares.iter().zip(&sizes)) {
        let value = share * scale / size;
        match *owner {
            Owner::Objective => {}
            Owner::Condition(own, sign) => found.conditions[own] += sign * value,
            Owner::Bound(variable, sign) => found.bounds[variable] -= sign * value,
        }
    }
    found
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Owner {
    Objective,
    Condition(usize, f64),
    Bound(usize, f64),
}
