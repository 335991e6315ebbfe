//! The least value of a function of several variables under conditions.
//!
//! All variables run from 0 to 1. Functions and conditions are scaled to about 1 by who asks.
//!
//! - [`sqp()`]: sequential quadratic programming for what is smooth (Kraft 1988).
//! - [`bundle()`]: where a greatest value is reached at several places, its slope jumps. The model is
//!   then the greatest of the tangents at the places known (Kelley 1960), within a trust region.
//! - [`multipliers()`]: which conditions hold an optimum, and what each is worth. They are a second
//!   opinion on the optimum: nothing of them comes from the methods that found it.
//! - [`flat_directions`]: directions in which nothing changes to second order.
//!
//! A place at which a function has no value is one that no method accepts.

#[cfg(not(target_family = "wasm"))]
mod adapter;
mod bundle;
mod flat;
mod multipliers;
mod nonnegative;
mod sqp;
mod starts;
#[cfg(test)]
mod tests;

pub(crate) use bundle::bundle;
pub(crate) use flat::{FlatDirection, flat_directions};
pub(crate) use multipliers::{Multipliers, SmoothPiece, multipliers};
pub(crate) use sqp::{SqpEnd, sqp};
pub(crate) use starts::starts;

/// Values of the function and of the conditions at a place.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Values {
    /// The function, to be least.
    pub(crate) objective: f64,
    /// The conditions, equalities first: zero, then at most zero.
    pub(crate) conditions: Vec<f64>,
}

/// Their derivatives by the variables.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Slopes {
    /// Of the function.
    pub(crate) objective: Vec<f64>,
    /// Of each condition.
    pub(crate) conditions: Vec<Vec<f64>>,
}

/// What is to be least, and under which conditions.
pub(crate) trait Problem {
    /// Number of variables, each from 0 to 1.
    fn variables(&self) -> usize;

    /// Number of conditions that are to be zero.
    fn equalities(&self) -> usize;

    /// Number of conditions that are to be at most zero.
    fn inequalities(&self) -> usize;

    /// Values at a place, all finite; `None`: there are none.
    fn values(&self, at: &[f64]) -> Option<Values>;

    /// Slopes at a place, all finite; `None`: there are none.
    fn slopes(&self, at: &[f64]) -> Option<Slopes>;
}

impl Values {
    /// How far each condition is violated; zero of one that holds.
    pub(crate) fn violations(&self, equalities: usize) -> impl Iterator<Item = f64> {
        let each = self.conditions.iter().enumerate();
        each.map(move |(at, value)| match at < equalities {
            true => value.abs(),
            false => value.max(0.0),
        })
    }

    /// The greatest violation.
    pub(crate) fn violation(&self, equalities: usize) -> f64 {
        self.violations(equalities).fold(0.0, f64::max)
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
