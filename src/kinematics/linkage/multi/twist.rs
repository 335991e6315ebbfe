//! Velocities, accelerations and screws in the plane, and frames.

use crate::math::number::Number;

/// A velocity, an acceleration or a screw in the plane: (rotation, x, y).
pub(super) type Twist<N> = [N; 3];
/// What a velocity (ω, v over the size) of each of the bodies of a joint contributes to an equation.
pub(super) type Parts<N> = [Twist<N>; 3];
/// Velocity of a body, and its acceleration.
pub(super) type Motion<'a> = &'a dyn Fn(usize) -> (Twist<f64>, Twist<f64>);

/// A frame: origin, cos θ and sin θ.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose<N> {
    pub(super) x: N,
    pub(super) y: N,
    pub(super) cos: N,
    pub(super) sin: N,
}

impl<N: Number> Pose<N> {
    /// A point given in this frame.
    #[inline(always)]
    pub(super) fn point_to_ground(&self, [x, y]: [f64; 2]) -> [N; 2] {
        [
            self.x + self.cos.scale(x) - self.sin.scale(y),
            self.y + self.sin.scale(x) + self.cos.scale(y),
        ]
    }

    /// A direction given in this frame.
    #[inline(always)]
    pub(super) fn direction_to_ground(&self, [x, y]: [f64; 2]) -> [N; 2] {
        [
            self.cos.scale(x) - self.sin.scale(y),
            self.sin.scale(x) + self.cos.scale(y),
        ]
    }
}

/// Velocity of the point of a body that lies at `place`.
#[inline(always)]
pub(super) fn at<N: Number>(twist: &Twist<N>, place: [N; 2]) -> [N; 2] {
    [
        twist[1] - twist[0] * place[1],
        twist[2] + twist[0] * place[0],
    ]
}

#[inline(always)]
pub(super) fn plus<N: Number>(a: Twist<N>, b: Twist<N>) -> Twist<N> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
pub(super) fn minus<N: Number>(a: Twist<N>, b: Twist<N>) -> Twist<N> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
pub(super) fn times<N: Number>(a: Twist<N>, factor: N) -> Twist<N> {
    [a[0] * factor, a[1] * factor, a[2] * factor]
}

/// Σ aᵢ·bᵢ: the power of a wrench (moment, force) along a velocity.
#[inline(always)]
pub(super) fn dot<N: Number>(a: &Twist<N>, b: &Twist<N>) -> N {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// t × S: the change of a screw that a body of velocity t carries.
#[inline(always)]
pub(super) fn cross_product<N: Number>(t: &Twist<N>, s: &Twist<N>) -> Twist<N> {
    [
        N::from(0.0),
        s[0] * t[2] - t[0] * s[2],
        t[0] * s[1] - s[0] * t[1],
    ]
}
