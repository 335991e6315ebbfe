//! Smooth functions of one number that an expression knows.

use std::f64::consts::{LN_2, LN_10};

/// A smooth function of one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Function {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Asinh,
    Acosh,
    Atanh,
    Exp,
    Ln,
    Log10,
    Log2,
    Sqrt,
    Cbrt,
}

/// The functions by their names.
pub(super) const SMOOTH: [(&str, Function); 19] = [
    ("sin", Function::Sin),
    ("cos", Function::Cos),
    ("tan", Function::Tan),
    ("asin", Function::Asin),
    ("acos", Function::Acos),
    ("atan", Function::Atan),
    ("sinh", Function::Sinh),
    ("cosh", Function::Cosh),
    ("tanh", Function::Tanh),
    ("asinh", Function::Asinh),
    ("acosh", Function::Acosh),
    ("atanh", Function::Atanh),
    ("exp", Function::Exp),
    ("ln", Function::Ln),
    ("log", Function::Ln),
    ("log10", Function::Log10),
    ("log2", Function::Log2),
    ("sqrt", Function::Sqrt),
    ("cbrt", Function::Cbrt),
];

impl Function {
    /// The value.
    #[inline(always)]
    pub(super) fn value(self, x: f64) -> f64 {
        match self {
            Self::Sin => x.sin(),
            Self::Cos => x.cos(),
            Self::Tan => x.tan(),
            Self::Asin => x.asin(),
            Self::Acos => x.acos(),
            Self::Atan => x.atan(),
            Self::Sinh => x.sinh(),
            Self::Cosh => x.cosh(),
            Self::Tanh => x.tanh(),
            Self::Asinh => x.asinh(),
            Self::Acosh => x.acosh(),
            Self::Atanh => x.atanh(),
            Self::Exp => x.exp(),
            Self::Ln => x.ln(),
            Self::Log10 => x.log10(),
            Self::Log2 => x.log2(),
            Self::Sqrt => x.sqrt(),
            Self::Cbrt => x.cbrt(),
        }
    }

    /// The value and the derivative.
    #[inline(always)]
    pub(super) fn with_slope(self, x: f64) -> (f64, f64) {
        let value = match self {
            Self::Sin | Self::Cos => {
                let (sin, cos) = x.sin_cos();
                return match self {
                    Self::Sin => (sin, cos),
                    _ => (cos, -sin),
                };
            }
            _ => self.value(x),
        };
        let slope = match self {
            Self::Sin | Self::Cos => 0.0, // (told above)
            Self::Tan => 1.0 + value * value,
            Self::Asin => 1.0 / (1.0 - x * x).sqrt(),
            Self::Acos => -1.0 / (1.0 - x * x).sqrt(),
            Self::Atan => 1.0 / (1.0 + x * x),
            Self::Sinh => x.cosh(),
            Self::Cosh => x.sinh(),
            // (1 − tanh² has no digits far out.)
            Self::Tanh => x.cosh().recip().powi(2),
            Self::Asinh => 1.0 / (x * x + 1.0).sqrt(),
            Self::Acosh => 1.0 / (x * x - 1.0).sqrt(),
            Self::Atanh => 1.0 / (1.0 - x * x),
            Self::Exp => value,
            Self::Ln => 1.0 / x,
            Self::Log10 => 1.0 / (x * LN_10),
            Self::Log2 => 1.0 / (x * LN_2),
            Self::Sqrt => 0.5 / value,
            Self::Cbrt => 1.0 / (3.0 * value * value),
        };
        (value, slope)
    }
}
