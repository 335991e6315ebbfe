//! What an expression is evaluated with: real numbers, and nothing but names.

use super::{OF_ONE, OF_TWO, constant};
use nanoexpr::{Context, ErrorKind, Number};
use std::cmp::Ordering;

/// A real number, calculated with as the processor does: what has no value is
/// infinite or NaN.
#[derive(Clone, Copy, Default)]
pub(super) struct Real(pub(super) f64);

impl Number for Real {
    fn parse(literal: &str) -> Option<Self> {
        let value: f64 = literal.parse().ok()?;
        value.is_finite().then_some(Self(value))
    }
    fn add(self, other: Self) -> Result<Self, ErrorKind> {
        Ok(Self(self.0 + other.0))
    }
    fn subtract(self, other: Self) -> Result<Self, ErrorKind> {
        Ok(Self(self.0 - other.0))
    }
    fn multiply(self, other: Self) -> Result<Self, ErrorKind> {
        Ok(Self(self.0 * other.0))
    }
    fn divide(self, other: Self) -> Result<Self, ErrorKind> {
        Ok(Self(self.0 / other.0))
    }
    fn remainder(self, other: Self) -> Result<Self, ErrorKind> {
        Ok(Self(self.0 % other.0))
    }
    fn power(self, other: Self) -> Result<Self, ErrorKind> {
        Ok(Self(self.0.powf(other.0)))
    }
    fn negate(self) -> Result<Self, ErrorKind> {
        Ok(Self(-self.0))
    }
    fn compare(self, other: Self) -> Result<Ordering, ErrorKind> {
        self.0.partial_cmp(&other.0).ok_or(ErrorKind::Domain)
    }
}

/// The variables with their values.
pub(super) struct Known<'a> {
    pub(super) variables: &'a [String],
    pub(super) values: &'a [f64],
}

impl Context<Real> for Known<'_> {
    fn variable(&self, name: &str) -> Option<Real> {
        let mut pairs = self.variables.iter().zip(self.values);
        let value = pairs.find_map(|(known, value)| (known == name).then_some(*value));
        value.or_else(|| constant(name)).map(Real)
    }

    fn call(&self, name: &str, arguments: &[Real]) -> Option<Result<Real, ErrorKind>> {
        let value = match *arguments {
            [Real(x)] => OF_ONE.iter().find(|(known, _)| *known == name)?.1(x),
            [Real(x), Real(y)] => OF_TWO.iter().find(|(known, _)| *known == name)?.1(x, y),
            _ => return None,
        };
        Some(Ok(Real(value)))
    }
}

/// A number without a value, to try names and numbers of arguments with: no
/// operation on it fails.
#[derive(Clone, Copy, Default)]
pub(super) struct Nothing;

impl Number for Nothing {
    fn parse(literal: &str) -> Option<Self> {
        Real::parse(literal).map(|_| Self)
    }
    fn add(self, _: Self) -> Result<Self, ErrorKind> {
        Ok(Self)
    }
    fn subtract(self, _: Self) -> Result<Self, ErrorKind> {
        Ok(Self)
    }
    fn multiply(self, _: Self) -> Result<Self, ErrorKind> {
        Ok(Self)
    }
    fn divide(self, _: Self) -> Result<Self, ErrorKind> {
        Ok(Self)
    }
    fn remainder(self, _: Self) -> Result<Self, ErrorKind> {
        Ok(Self)
    }
    fn power(self, _: Self) -> Result<Self, ErrorKind> {
        Ok(Self)
    }
    fn negate(self) -> Result<Self, ErrorKind> {
        Ok(Self)
    }
    fn compare(self, _: Self) -> Result<Ordering, ErrorKind> {
        Ok(Ordering::Equal)
    }
    fn from_bool(_: bool) -> Result<Self, ErrorKind> {
        Ok(Self)
    }
    fn factorial(self) -> Result<Self, ErrorKind> {
        Ok(Self)
    }
}

/// The names alone.
pub(super) struct Names<'a>(pub(super) &'a [String]);

impl Context<Nothing> for Names<'_> {
    fn variable(&self, name: &str) -> Option<Nothing> {
        let known = self.0.iter().any(|known| known == name) || constant(name).is_some();
        known.then_some(Nothing)
    }

    fn call(&self, name: &str, arguments: &[Nothing]) -> Option<Result<Nothing, ErrorKind>> {
        let wanted = match name {
            _ if OF_ONE.iter().any(|(known, _)| *known == name) => 1,
            _ if OF_TWO.iter().any(|(known, _)| *known == name) => 2,
            _ => return None,
        };
        Some(match arguments.len() == wanted {
            true => Ok(Nothing),
            false => Err(ErrorKind::ArgumentCount),
        })
    }
}
