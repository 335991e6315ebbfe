//! Values with their first two derivatives by one variable.

use std::ops::{Add, Mul, Neg, Sub};

/// A value with its first two derivatives by one variable.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Local {
    /// Value.
    pub(crate) value: f64,
    /// First derivative.
    pub(crate) first: f64,
    /// Second derivative.
    pub(crate) second: f64,
}

impl Local {
    pub(super) fn new(value: f64, first: f64, second: f64) -> Self {
        Self {
            value,
            first,
            second,
        }
    }

    /// The variable itself.
    pub(super) fn variable(value: f64) -> Self {
        Self::new(value, 1.0, 0.0)
    }

    pub(super) fn shift(self, by: f64) -> Self {
        Self {
            value: self.value + by,
            ..self
        }
    }

    pub(super) fn scale(self, by: f64) -> Self {
        Self::new(by * self.value, by * self.first, by * self.second)
    }

    /// The same function of x where x = rate·(variable): derivatives by the variable.
    pub(super) fn faster(self, rate: f64) -> Self {
        Self::new(self.value, rate * self.first, rate * rate * self.second)
    }

    /// f of it, for a function given by its derivatives at the value.
    fn composed_with(self, [value, first, second]: [f64; 3]) -> Self {
        Self::new(
            value,
            first * self.first,
            first * self.second + second * self.first * self.first,
        )
    }

    pub(super) fn sin(self) -> Self {
        let (sin, cos) = self.value.sin_cos();
        self.composed_with([sin, cos, -sin])
    }

    pub(super) fn cos(self) -> Self {
        let (sin, cos) = self.value.sin_cos();
        self.composed_with([cos, -sin, -cos])
    }

    pub(super) fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.composed_with([root, 0.5 / root, -0.25 / (root * root * root)])
    }

    pub(super) fn inverse(self) -> Self {
        let x = self.value;
        self.composed_with([1.0 / x, -1.0 / (x * x), 2.0 / (x * x * x)])
    }

    pub(super) fn acos(self) -> Self {
        let x = self.value;
        let rest = (1.0 - x * x).sqrt();
        self.composed_with([x.acos(), -1.0 / rest, -x / (rest * rest * rest)])
    }

    /// Angle of the vector (x, y).
    pub(super) fn angle(x: Self, y: Self) -> Self {
        let square = x.value * x.value + y.value * y.value;
        let turn = x.value * y.first - y.value * x.first;
        let bend = x.value * y.second - y.value * x.second;
        let growth = 2.0 * (x.value * x.first + y.value * y.first);
        Self::new(
            y.value.atan2(x.value),
            turn / square,
            (bend - turn * growth / square) / square,
        )
    }
}

impl Add for Local {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::new(
            self.value + other.value,
            self.first + other.first,
            self.second + other.second,
        )
    }
}

impl Neg for Local {
    type Output = Self;

    fn neg(self) -> Self {
        self.scale(-1.0)
    }
}

impl Sub for Local {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Local {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self::new(
            self.value * other.value,
            self.first * other.value + self.value * other.first,
            self.second * other.value + 2.0 * self.first * other.first + self.value * other.second,
        )
    }
}

/// Halvings of a stencil that leaves the range.
const CLOSER: usize = 40;

/// Halvings of the stencil.
const HALVINGS: usize = 8;

/// A function given by its values alone, with its first two derivatives: central
/// differences over stencils that are halved from `reach` on, extrapolated to none
/// (Ridders), each by the stencil at which two extrapolations agree best; and by how much
/// these differ.
pub(crate) fn differentiate(f: impl Fn(f64) -> f64, at: f64, reach: f64) -> (Local, [f64; 2]) {
    let value = f(at);
    let mut kept = [(f64::INFINITY, f64::NAN); 2];
    let mut before = [[f64::NAN; HALVINGS]; 2];
    let mut step = reach;
    // (Near an end of its range the function has no values on both sides but close by.)
    for _ in 0..CLOSER {
        if (f(at - step) + f(at + step)).is_finite() {
            break;
        }
        step *= 0.5;
    }
    for level in 0..HALVINGS {
        let (left, right) = (f(at - step), f(at + step));
        let raw = [
            (right - left) / (2.0 * step),
            ((right - value) - (value - left)) / (step * step),
        ];
        for (order, raw) in raw.into_iter().enumerate() {
            let mut row = [f64::NAN; HALVINGS];
            row[0] = raw;
            let mut power = 1.0;
            for k in 1..=level {
                power *= 4.0;
                row[k] = row[k - 1] + (row[k - 1] - before[order][k - 1]) / (power - 1.0);
                let error = (row[k] - row[k - 1]).abs();
                if error < kept[order].0 {
                    kept[order] = (error, row[k]);
                }
            }
            before[order] = row;
        }
        step *= 0.5;
    }
    let found = Local::new(value, kept[0].1, kept[1].1);
    (found, kept.map(|kept| kept.0))
}

#[cfg(test)]
mod tests {
    use super::{Local, differentiate};

    #[test]
    fn differences_and_rules_agree() {
        let f = |x: Local| {
            let angle = Local::angle(x.cos().shift(2.0), x.sin() * x);
            angle + (x * x).shift(1.0).sqrt() * x.scale(0.1).acos() - x.shift(3.0).inverse()
        };
        for x in [-1.2, 0.3, 2.0] {
            let (ruled, (found, _)) = (
                f(Local::variable(x)),
                differentiate(|x| f(Local::variable(x)).value, x, 0.1),
            );
            approx::assert_relative_eq!(ruled.first, found.first, max_relative = 1e-11);
            approx::assert_relative_eq!(ruled.second, found.second, max_relative = 1e-8);
        }
    }
}
