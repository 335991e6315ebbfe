//! A line of the answer: a method and what became of it.

use super::limit::StabilityLimit;
use super::point::Point;
use crate::dynamics::integrate::Method;
use serde::Serialize;

/// Line: one method at all its settings.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MethodLine {
    /// The method.
    pub method: Method,
    /// True: the points are steps; false: tolerances.
    pub fixed_step: bool,
    /// The limit of its stability.
    pub stability: StabilityLimit,
    /// Points, the coarsest first.
    pub points: Vec<Point>,
}
