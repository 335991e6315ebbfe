//! Loads as a scene states them.

use crate::dynamics::laws::LawInstance;
use crate::math::expression::Expression;

/// Displacement and speed of what a load looks at.
pub(crate) type Motion = (f64, f64);

/// A load in the terms of the scene.
#[derive(Clone, Debug)]
pub(crate) enum StatedLoad {
    /// W.
    Constant(f64),
    /// Straight between points of time, constant outside.
    OverTime(Vec<(f64, f64)>),
    /// The same over the driver's displacement, repeated with a period.
    OverDriver(Vec<(f64, f64)>, Option<f64>),
    /// The same over the own speed.
    OverSpeed(Vec<(f64, f64)>),
    /// A force between two positions of the driver, repeated with a period.
    Window {
        /// From and to.
        between: [f64; 2],
        /// Force.
        force: f64,
        /// Period.
        period: Option<f64>,
    },
    /// A law that the library declares, by its formula over φ, φ̇ and its numbers.
    Declared {
        /// The formula.
        formula: Expression,
        /// The numbers.
        numbers: Vec<f64>,
    },
    /// −m·g·sin(inclination), m the inertia of the node.
    Weight(f64),
    /// An expression over time, the own motion, that of the driver and that of another.
    Written {
        /// The expression.
        expression: Expression,
        /// Factor.
        factor: f64,
    },
}

impl StatedLoad {
    /// What a declared law says; `None`: its formula cannot be read.
    pub(crate) fn declared(declared: &LawInstance) -> Option<Self> {
        Some(Self::Declared {
            formula: declared.formula()?,
            numbers: declared.values.clone(),
        })
    }

    /// The force at an instant, given the motions of the node itself, of its driver and of
    /// the object that it looks at besides, and the inertia of the node.
    pub(crate) fn force(
        &self,
        time: f64,
        [own, driver, over]: [Motion; 3],
        inertia: f64,
        gravity: f64,
    ) -> f64 {
        match self {
            Self::Constant(force) => *force,
            Self::OverTime(points) => interpolate(points, time),
            Self::OverSpeed(points) => interpolate(points, own.1),
            Self::OverDriver(points, None) => interpolate(points, driver.0),
            Self::OverDriver(points, Some(period)) => {
                let first = points[0];
                let x = first.0 + (driver.0 - first.0).rem_euclid(*period);
                let mut closed = points.clone();
                closed.push((first.0 + period, first.1));
                interpolate(&closed, x)
            }
            Self::Window {
                between: [from, to],
                force,
                period,
            } => {
                let x = match period {
                    Some(period) => from + (driver.0 - from).rem_euclid(*period),
                    None => driver.0,
                };
                if *from <= x && x < *to { *force } else { 0.0 }
            }
            Self::Declared { formula, numbers } => {
                let mut values = vec![own.0, own.1];
                values.extend(numbers);
                formula.at(&values)
            }
            Self::Weight(inclination) => -inertia * gravity * inclination.sin(),
            Self::Written { expression, factor } => {
                let values = [time, own.0, own.1, driver.0, driver.1, over.0, over.1];
                factor * expression.at(&values)
            }
        }
    }
}

/// Straight between points, constant outside.
fn interpolate(points: &[(f64, f64)], x: f64) -> f64 {
    let above = points.iter().position(|point| point.0 > x);
    match above {
        Some(0) => points[0].1,
        None => points[points.len() - 1].1,
        Some(k) => {
            let ((x0, y0), (x1, y1)) = (points[k - 1], points[k]);
            y0 + (y1 - y0) * ((x - x0) / (x1 - x0))
        }
    }
}
