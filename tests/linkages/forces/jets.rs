//! Numbers with two derivatives, to write a mechanism's kinematics down by hand.

use std::ops::{Add, Mul, Neg, Sub};

/// Value, first and second derivative.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct D2(pub(super) f64, pub(super) f64, pub(super) f64);

impl D2 {
    /// The variable.
    pub(super) fn variable(x: f64) -> Self {
        Self(x, 1.0, 0.0)
    }

    /// A constant.
    pub(super) fn constant(x: f64) -> Self {
        Self(x, 0.0, 0.0)
    }

    fn compose(self, f: f64, first: f64, second: f64) -> Self {
        Self(f, first * self.1, second * self.1 * self.1 + first * self.2)
    }

    pub(super) fn sin(self) -> Self {
        let (s, c) = self.0.sin_cos();
        self.compose(s, c, -s)
    }

    pub(super) fn cos(self) -> Self {
        let (s, c) = self.0.sin_cos();
        self.compose(c, -s, -c)
    }

    pub(super) fn sqrt(self) -> Self {
        let r = self.0.sqrt();
        self.compose(r, 0.5 / r, -0.25 / (r * self.0))
    }

    pub(super) fn recip(self) -> Self {
        let r = 1.0 / self.0;
        self.compose(r, -r * r, 2.0 * r * r * r)
    }

    /// Angle of a vector.
    pub(super) fn atan2(self, x: Self) -> Self {
        // θ′ = (x·y′ − y·x′)/r², once more by the same arithmetic.
        let value = self.0.atan2(x.0);
        let r2 = x.0 * x.0 + self.0 * self.0;
        let cross = x.0 * self.1 - self.0 * x.1;
        let cross_first = x.0 * self.2 - self.0 * x.2;
        let r2_first = 2.0 * (x.0 * x.1 + self.0 * self.1);
        Self(
            value,
            cross / r2,
            cross_first / r2 - cross * r2_first / (r2 * r2),
        )
    }
}

impl Add for D2 {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self(self.0 + o.0, self.1 + o.1, self.2 + o.2)
    }
}

impl Sub for D2 {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self(self.0 - o.0, self.1 - o.1, self.2 - o.2)
    }
}

impl Mul for D2 {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Self(
            self.0 * o.0,
            self.1 * o.0 + self.0 * o.1,
            self.2 * o.0 + 2.0 * self.1 * o.1 + self.0 * o.2,
        )
    }
}

impl Mul<f64> for D2 {
    type Output = Self;
    fn mul(self, o: f64) -> Self {
        Self(self.0 * o, self.1 * o, self.2 * o)
    }
}

impl Neg for D2 {
    type Output = Self;
    fn neg(self) -> Self {
        self * -1.0
    }
}
