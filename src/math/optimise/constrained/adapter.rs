//! A problem as the crate `basin` asks for it: function and conditions one after the other.

use super::{Problem, Slopes, Values};
use basin::{
    BoxBounds, ConstraintDescription, ConstraintJacobian, ConstraintSet, ConstraintSolveError,
    Constraints, CostFunction, DenseMatrix, Gradient, NoLinearConstraints, NonlinearBlock,
    NonlinearBlocks, NonlinearEqualityValues, NonlinearInequalityValues,
};
use std::cell::RefCell;
use std::convert::Infallible;

type Known<T> = RefCell<Option<(Vec<f64>, Option<T>)>>;

/// The problem, with what it last found.
pub(super) struct Adapter<'p> {
    problem: &'p dyn Problem,
    lower: Vec<f64>,
    upper: Vec<f64>,
    last_values: Known<Values>,
    last_slopes: Known<Slopes>,
}

impl<'p> Adapter<'p> {
    pub(super) fn new(problem: &'p dyn Problem) -> Self {
        Self {
            problem,
            lower: vec![0.0; problem.variables()],
            upper: vec![1.0; problem.variables()],
            last_values: RefCell::default(),
            last_slopes: RefCell::default(),
        }
    }

    pub(super) fn values(&self, at: &[f64]) -> Option<Values> {
        remembered(&self.last_values, at, |at| self.problem.values(at))
    }

    pub(super) fn slopes(&self, at: &[f64]) -> Option<Slopes> {
        remembered(&self.last_slopes, at, |at| self.problem.slopes(at))
    }

    /// Conditions from one number to another; what has no value is not finite.
    fn conditions(&self, at: &[f64], range: std::ops::Range<usize>) -> Vec<f64> {
        match self.values(at) {
            Some(values) => values.conditions[range].to_vec(),
            None => vec![f64::INFINITY; range.len()],
        }
    }
}

fn remembered<T: Clone>(
    known: &Known<T>,
    at: &[f64],
    find: impl FnOnce(&[f64]) -> Option<T>,
) -> Option<T> {
    if let Some((place, found)) = &*known.borrow()
        && place == at
    {
        return found.clone();
    }
    let found = find(at);
    known.replace(Some((at.to_vec(), found.clone())));
    found
}

impl Constraints for Adapter<'_> {
    type Set = ConstraintSet<
        BoxBounds<Vec<f64>>,
        NoLinearConstraints,
        NonlinearBlocks<NonlinearBlock, NonlinearBlock>,
    >;

    fn constraints(&self) -> <Self::Set as ConstraintDescription>::Borrowed<'_> {
        ConstraintSet::new()
            .with_bounds(BoxBounds::new(Some(&self.lower), Some(&self.upper)))
            .with_nonlinear_equalities(self.problem.equalities())
            .with_nonlinear_inequalities(self.problem.inequalities())
    }
}

impl CostFunction for Adapter<'_> {
    type Param = Vec<f64>;
    type Output = f64;
    type Error = Infallible;

    fn cost(&self, at: &Vec<f64>) -> Result<f64, Infallible> {
        let found = self.values(at);
        Ok(found.map_or(f64::INFINITY, |values| values.objective))
    }
}

impl Gradient for Adapter<'_> {
    type Gradient = Vec<f64>;

    fn gradient(&self, at: &Vec<f64>) -> Result<Vec<f64>, Infallible> {
        let found = self.slopes(at);
        Ok(found.map_or_else(|| vec![f64::NAN; at.len()], |slopes| slopes.objective))
    }
}

impl NonlinearEqualityValues for Adapter<'_> {
    type Param = Vec<f64>;
    type Values = Vec<f64>;
    type Error = Infallible;

    fn nonlinear_equalities(
        &self,
        at: &Vec<f64>,
    ) -> Result<Vec<f64>, ConstraintSolveError<Infallible>> {
        Ok(self.conditions(at, 0..self.problem.equalities()))
    }
}

impl NonlinearInequalityValues for Adapter<'_> {
    type Param = Vec<f64>;
    type Values = Vec<f64>;
    type Error = Infallible;

    fn nonlinear_inequalities(
        &self,
        at: &Vec<f64>,
    ) -> Result<Vec<f64>, ConstraintSolveError<Infallible>> {
        let first = self.problem.equalities();
        Ok(self.conditions(at, first..first + self.problem.inequalities()))
    }
}

impl ConstraintJacobian for Adapter<'_> {
    type Param = Vec<f64>;
    type Jacobian = DenseMatrix;
    type Error = Infallible;

    fn constraint_jacobian(
        &self,
        at: &Vec<f64>,
    ) -> Result<DenseMatrix, ConstraintSolveError<Infallible>> {
        let rows = self.problem.equalities() + self.problem.inequalities();
        let found = match self.slopes(at) {
            Some(slopes) => slopes.conditions.concat(),
            None => vec![f64::NAN; rows * at.len()],
        };
        Ok(DenseMatrix::from_row_slice(rows, at.len(), &found))
    }
}
