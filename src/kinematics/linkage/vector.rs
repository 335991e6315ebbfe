//! Plane vectors whose coordinates are power series of the input coordinate.
//!
//! A vector (x, y) is also the number x + iy: multiplying by the unit vector
//! (cos θ, sin θ) turns by θ, so that no angle and no trigonometric function is
//! needed to place a link.

use crate::math::number::Number;
use crate::math::series::Series;
use std::ops::{Add, Neg, Sub};

/// A plane vector.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Vector<const N: usize, T = f64> {
    /// To the right.
    pub(crate) x: Series<N, T>,
    /// Up.
    pub(crate) y: Series<N, T>,
}

impl<const N: usize> Vector<N> {
    /// A constant.
    #[inline(always)]
    pub(crate) fn constant(at: [f64; 2]) -> Self {
        Self::fixed(at)
    }

    /// The unit vector at the angle `rate`·x = `angle`.
    #[inline(always)]
    pub(crate) fn unit(angle: f64, rate: f64) -> Self {
        let (sin, cos) = Series::sin_cos(angle, rate);
        Self::new(cos, sin)
    }

    /// The unit vector at an angle.
    #[inline(always)]
    pub(crate) fn of_angle(angle: Series<N>) -> Self {
        let (sin, cos) = angle.value().sin_cos();
        let (mut c, mut s) = (Series::constant(cos), Series::constant(sin));
        for k in 1..N {
            let (mut dc, mut ds) = (0.0, 0.0);
            for i in 1..=k {
                dc -= i as f64 * angle.0[i] * s.0[k - i];
                ds += i as f64 * angle.0[i] * c.0[k - i];
            }
            (c.0[k], s.0[k]) = (dc / k as f64, ds / k as f64);
        }
        Self::new(c, s)
    }

    #[inline(always)]
    pub(crate) fn load(stored: &[[f64; 4]; 2]) -> Self {
        Self::new(Series::load(&stored[0]), Series::load(&stored[1]))
    }

    #[inline(always)]
    pub(crate) fn store(self, stored: &mut [[f64; 4]; 2]) {
        self.x.store(&mut stored[0]);
        self.y.store(&mut stored[1]);
    }

    /// The unit vector next to a vector of length 1 but for rounding.
    #[inline(always)]
    pub(crate) fn nearly_unit(self) -> Self {
        self.times(self.square().scale(-0.5).shift(1.5))
    }

    /// The values.
    #[inline(always)]
    pub(crate) fn value(&self) -> [f64; 2] {
        [self.x.value(), self.y.value()]
    }
}

impl<const N: usize, T: Number> Vector<N, T> {
    #[inline(always)]
    pub(crate) fn new(x: Series<N, T>, y: Series<N, T>) -> Self {
        Self { x, y }
    }

    /// A constant, of any kind of number.
    #[inline(always)]
    pub(crate) fn fixed([x, y]: [f64; 2]) -> Self {
        Self::new(Series::fixed(x), Series::fixed(y))
    }

    #[inline(always)]
    pub(crate) fn dot(self, other: Self) -> Series<N, T> {
        self.x * other.x + self.y * other.y
    }

    /// x·y′ − y·x′: positive where `other` lies to the left.
    #[inline(always)]
    pub(crate) fn cross(self, other: Self) -> Series<N, T> {
        self.x * other.y - self.y * other.x
    }

    /// |v|².
    #[inline(always)]
    pub(crate) fn square(self) -> Series<N, T> {
        self.x.square() + self.y.square()
    }

    /// Turned by a quarter turn to the left.
    #[inline(always)]
    pub(crate) fn turned_left(self) -> Self {
        Self::new(-self.y, self.x)
    }

    #[inline(always)]
    pub(crate) fn times(self, factor: Series<N, T>) -> Self {
        Self::new(self.x * factor, self.y * factor)
    }

    /// The product as complex numbers: `other` turned and stretched by `self`.
    #[inline(always)]
    pub(crate) fn complex_product(self, other: Self) -> Self {
        Self::new(
            self.x * other.x - self.y * other.y,
            self.x * other.y + self.y * other.x,
        )
    }

    /// [`Self::complex_product`] of a constant vector.
    #[inline(always)]
    pub(crate) fn turn_constant(self, [x, y]: [f64; 2]) -> Self {
        Self::new(
            self.x.scale(x) - self.y.scale(y),
            self.x.scale(y) + self.y.scale(x),
        )
    }

    /// Mirror image in the x axis: the inverse of a unit vector.
    #[inline(always)]
    pub(crate) fn mirrored(self) -> Self {
        Self::new(self.x, -self.y)
    }

    /// Direction of the vector, in (−π, π] as a value.
    #[inline(always)]
    pub(crate) fn angle(self) -> Series<N, T> {
        Series::atan2(self.y, self.x)
    }
}

impl<const N: usize, T: Number> Add for Vector<N, T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y)
    }
}

impl<const N: usize, T: Number> Sub for Vector<N, T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y)
    }
}

impl<const N: usize, T: Number> Neg for Vector<N, T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y)
    }
}

/// A constant vector with what dyads need of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Arm {
    at: [f64; 2],
    length: f64,
    /// Inverse of the vector as a complex number.
    inverse: [f64; 2],
}

impl Arm {
    pub(crate) fn new([x, y]: [f64; 2]) -> Self {
        let square = x * x + y * y;
        Self {
            at: [x, y],
            length: x.hypot(y),
            inverse: [x / square, -y / square],
        }
    }
}

/// A vector in the frame of a link: constant, or a function of the input where
/// the link is a driven assembly that changes its shape.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Local<const N: usize> {
    /// A vector of a rigid link.
    Fixed([f64; 2]),
    /// A vector of a rigid link that is often measured.
    Arm(Arm),
    /// A vector of a driven assembly.
    Moving(Vector<N>),
}

impl<const N: usize> Local<N> {
    #[inline(always)]
    pub(crate) fn vector(self) -> Vector<N> {
        match self {
            Self::Fixed(at) | Self::Arm(Arm { at, .. }) => Vector::constant(at),
            Self::Moving(vector) => vector,
        }
    }

    /// From `other` to `self`.
    #[inline(always)]
    pub(crate) fn minus(self, other: Self) -> Self {
        match (self, other) {
            (Self::Fixed(to), Self::Fixed(from)) => Self::Fixed([to[0] - from[0], to[1] - from[1]]),
            _ => Self::Moving(self.vector() - other.vector()),
        }
    }

    /// Length of the vector.
    #[inline(always)]
    pub(crate) fn length(self) -> Series<N> {
        match self {
            Self::Fixed([x, y]) => Series::constant(x.hypot(y)),
            Self::Arm(arm) => Series::constant(arm.length),
            Self::Moving(vector) => vector.square().sqrt(),
        }
    }

    /// A constant length to measure by: its own, or a typical one where it changes.
    #[inline(always)]
    pub(crate) fn unit(self, typical: f64) -> f64 {
        match self {
            Self::Fixed([x, y]) => x.hypot(y),
            Self::Arm(arm) => arm.length,
            Self::Moving(_) => typical,
        }
    }

    /// The vector as seen from the ground, `direction` being that of the frame.
    #[inline(always)]
    pub(crate) fn turned_to_ground(self, direction: Vector<N>) -> Vector<N> {
        match self {
            Self::Fixed(at) | Self::Arm(Arm { at, .. }) => direction.turn_constant(at),
            Self::Moving(vector) => direction.complex_product(vector),
        }
    }

    /// The direction of the frame in which this vector is seen as `world`,
    /// which has the same length.
    #[inline(always)]
    pub(crate) fn frame(self, world: Vector<N>) -> Vector<N> {
        match self {
            Self::Fixed([x, y]) => {
                let square = x * x + y * y;
                world.turn_constant([x / square, -y / square])
            }
            Self::Arm(arm) => world.turn_constant(arm.inverse),
            Self::Moving(vector) => world
                .complex_product(vector.mirrored())
                .times(vector.square().reciprocal()),
        }
    }

    /// Component across the unit vector `along` of the same frame, to the left.
    #[inline(always)]
    pub(crate) fn across(self, along: Self) -> Series<N> {
        match (self, along) {
            (
                Self::Fixed([x, y]) | Self::Arm(Arm { at: [x, y], .. }),
                Self::Fixed([u, v]) | Self::Arm(Arm { at: [u, v], .. }),
            ) => Series::constant(u * y - v * x),
            _ => along.vector().cross(self.vector()),
        }
    }
}

/// The angle plus the whole turns that put it nearest to `near`.
#[inline]
pub(super) fn nearest_turn(angle: f64, near: f64) -> f64 {
    use std::f64::consts::TAU;
    angle + TAU * ((near - angle) / TAU).round()
}
