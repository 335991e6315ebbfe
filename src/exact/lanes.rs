//! Vector arithmetic of the propagation: four numbers side by side, with
//! branch-free exponential, sine and cosine.
//!
//! Everything is written for an [`Arith`]: [`FusedMultiplyAdd`] where the processor
//! multiplies and adds in one instruction (the caller then runs inside a
//! function compiled for that processor), [`Plain`] elsewhere, so that no
//! build ever calls a library routine for a multiply-add. Both agree to
//! rounding.

mod elementary;

pub(crate) use elementary::{
    ROUND, SIN_COS_LIMIT, cosine_and_sine_remainders, exp, reduced_one, sin_cos, sin_cos_one,
};

use std::ops::{Add, Div, Mul, Neg, Sub};

/// Arithmetic: how a product is added to a number.
pub(crate) trait Arith: Copy {
    /// a·b + c.
    fn fma(a: f64, b: f64, c: f64) -> f64;

    /// a·b as a sum of two numbers.
    fn product(a: f64, b: f64) -> (f64, f64);

    /// Does a task out of line, compiled for the same processor as the caller:
    /// what is rarely needed, or needed in several places, does not swell the
    /// loops that are always run.
    fn run_out_of_line<T: Task>(task: T) -> T::Output;
}

/// Something to be done in the arithmetic of the caller.
pub(crate) trait Task {
    type Output;

    /// Does it; to be marked `inline(always)`.
    fn run<A: Arith>(self) -> Self::Output;
}

/// Two roundings; for every processor.
#[derive(Clone, Copy)]
pub(crate) struct Plain;

/// Fused multiply-add, of one rounding; for processors that have it.
#[cfg_attr(
    target_family = "wasm",
    expect(dead_code, reason = "WebAssembly has none")
)]
#[derive(Clone, Copy)]
pub(crate) struct FusedMultiplyAdd;

impl Arith for Plain {
    #[inline(always)]
    fn fma(a: f64, b: f64, c: f64) -> f64 {
        a * b + c
    }

    /// After Dekker, as nothing is fused.
    #[inline(always)]
    fn product(a: f64, b: f64) -> (f64, f64) {
        let split = |x: f64| {
            let big = 134_217_729.0 * x;
            let high = big - (big - x);
            (high, x - high)
        };
        let p = a * b;
        let ((ah, al), (bh, bl)) = (split(a), split(b));
        (p, ((ah * bh - p) + ah * bl + al * bh) + al * bl)
    }

    #[inline(never)]
    fn run_out_of_line<T: Task>(task: T) -> T::Output {
        task.run::<Self>()
    }
}

impl Arith for FusedMultiplyAdd {
    #[inline(always)]
    fn fma(a: f64, b: f64, c: f64) -> f64 {
        a.mul_add(b, c)
    }

    #[inline(always)]
    fn product(a: f64, b: f64) -> (f64, f64) {
        let p = a * b;
        (p, a.mul_add(b, -p))
    }

    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    fn run_out_of_line<T: Task>(task: T) -> T::Output {
        #[target_feature(enable = "avx2,fma")]
        #[inline(never)]
        fn fused<T: Task>(task: T) -> T::Output {
            task.run::<FusedMultiplyAdd>()
        }
        // SAFETY: only functions that the processor has the features for run
        // in this arithmetic.
        #[allow(unsafe_code)]
        unsafe {
            fused(task)
        }
    }

    #[cfg(not(target_arch = "x86_64"))]
    #[inline(never)]
    fn run_out_of_line<T: Task>(task: T) -> T::Output {
        task.run::<Self>()
    }
}

/// True when this processor can be computed on in [`FusedMultiplyAdd`] arithmetic.
#[cfg(target_arch = "x86_64")]
pub(crate) fn fuses() -> bool {
    std::is_x86_feature_detected!("avx2") && std::is_x86_feature_detected!("fma")
}

/// Does a task out of line in the best arithmetic of this processor; with `plain` in that of
/// every processor.
#[inline]
pub(crate) fn run_out_of_line<T: Task>(plain: bool, task: T) -> T::Output {
    #[cfg(target_arch = "x86_64")]
    if !plain && fuses() {
        return FusedMultiplyAdd::run_out_of_line(task);
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = plain;
    Plain::run_out_of_line(task)
}

/// Numbers in a vector.
pub(crate) const WIDTH: usize = 4;

/// Four numbers side by side.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C, align(16))]
pub(crate) struct V(pub(crate) [f64; WIDTH]);

impl V {
    pub(crate) const ZERO: Self = Self([0.0; WIDTH]);

    #[inline(always)]
    pub(crate) fn splat(x: f64) -> Self {
        Self([x; WIDTH])
    }

    #[inline(always)]
    pub(crate) fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self([f(self.0[0]), f(self.0[1]), f(self.0[2]), f(self.0[3])])
    }

    #[inline(always)]
    pub(crate) fn zip(self, o: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self([
            f(self.0[0], o.0[0]),
            f(self.0[1], o.0[1]),
            f(self.0[2], o.0[2]),
            f(self.0[3], o.0[3]),
        ])
    }

    /// self·b + c.
    #[inline(always)]
    pub(crate) fn fma<A: Arith>(self, b: Self, c: Self) -> Self {
        Self([
            A::fma(self.0[0], b.0[0], c.0[0]),
            A::fma(self.0[1], b.0[1], c.0[1]),
            A::fma(self.0[2], b.0[2], c.0[2]),
            A::fma(self.0[3], b.0[3], c.0[3]),
        ])
    }

    /// Sum of the four.
    #[inline(always)]
    pub(crate) fn sum(self) -> f64 {
        (self.0[0] + self.0[2]) + (self.0[1] + self.0[3])
    }

    /// Greatest of the four.
    #[inline(always)]
    pub(crate) fn greatest(self) -> f64 {
        let larger = |a: f64, b: f64| if a > b { a } else { b };
        let [a, b, c, d] = self.0;
        larger(larger(a, c), larger(b, d))
    }

    #[inline(always)]
    pub(crate) fn min(self, o: Self) -> Self {
        self.zip(o, |a, b| if a < b { a } else { b })
    }

    #[inline(always)]
    pub(crate) fn max(self, o: Self) -> Self {
        self.zip(o, |a, b| if a > b { a } else { b })
    }
}

impl Add for V {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        self.zip(o, |a, b| a + b)
    }
}

impl Sub for V {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        self.zip(o, |a, b| a - b)
    }
}

impl Mul for V {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        self.zip(o, |a, b| a * b)
    }
}

impl Div for V {
    type Output = Self;
    #[inline(always)]
    fn div(self, o: Self) -> Self {
        self.zip(o, |a, b| a / b)
    }
}

impl Neg for V {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|a| -a)
    }
}
