//! Dimensions: exponents of mass, length, time and angle.

use std::fmt;
use std::ops::{Div, Mul};

/// Exponents of the base quantities a mechanism needs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Dimension {
    /// Exponent of mass (kg).
    pub mass: i32,
    /// Exponent of length (m).
    pub length: i32,
    /// Exponent of time (s).
    pub time: i32,
    /// Exponent of angle (rad).
    pub angle: i32,
}

impl Dimension {
    /// A pure number.
    pub const NONE: Self = Self::new(0, 0, 0, 0);
    /// Angle.
    pub const ANGLE: Self = Self::new(0, 0, 0, 1);
    /// Length.
    pub const LENGTH: Self = Self::new(0, 1, 0, 0);
    /// Time.
    pub const TIME: Self = Self::new(0, 0, 1, 0);
    /// Mass.
    pub const MASS: Self = Self::new(1, 0, 0, 0);
    /// Force.
    pub const FORCE: Self = Self::new(1, 1, -2, 0);

    /// From the exponents of mass, length, time and angle.
    pub const fn new(mass: i32, length: i32, time: i32, angle: i32) -> Self {
        Self {
            mass,
            length,
            time,
            angle,
        }
    }

    /// The dimension of a power; `None` beyond any sensible exponent.
    pub fn power(self, exponent: i32) -> Option<Self> {
        let raise = |part: i32| part.checked_mul(exponent).filter(|e| e.abs() <= 1000);
        Some(Self {
            mass: raise(self.mass)?,
            length: raise(self.length)?,
            time: raise(self.time)?,
            angle: raise(self.angle)?,
        })
    }

    /// The dimension with angles left out.
    pub fn without_angle(self) -> Self {
        Self { angle: 0, ..self }
    }

    /// True of dimensions with a mass or a length that differ by the angle alone. (Without
    /// these a speed of turning would be a frequency.)
    pub(crate) fn agrees_but_for_angle(self, other: Self) -> bool {
        let mechanical = self.mass != 0 || self.length != 0;
        mechanical && self.without_angle() == other.without_angle()
    }
}

impl Mul for Dimension {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self {
            mass: self.mass.saturating_add(other.mass),
            length: self.length.saturating_add(other.length),
            time: self.time.saturating_add(other.time),
            angle: self.angle.saturating_add(other.angle),
        }
    }
}

impl Div for Dimension {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        Self {
            mass: self.mass.saturating_sub(other.mass),
            length: self.length.saturating_sub(other.length),
            time: self.time.saturating_sub(other.time),
            angle: self.angle.saturating_sub(other.angle),
        }
    }
}

/// Base units with their exponents: `kg m/s^2`; `1` for a pure number.
impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts = [
            ("kg", self.mass),
            ("m", self.length),
            ("rad", self.angle),
            ("s", self.time),
        ];
        let write = |(unit, exponent): (&str, i32)| match exponent.abs() {
            1 => unit.to_owned(),
            size => format!("{unit}^{size}"),
        };
        let above: Vec<String> = parts
            .into_iter()
            .filter(|part| part.1 > 0)
            .map(write)
            .collect();
        f.write_str(&if above.is_empty() {
            "1".to_owned()
        } else {
            above.join(" ")
        })?;
        for part in parts.into_iter().filter(|part| part.1 < 0) {
            write!(f, "/{}", write(part))?;
        }
        Ok(())
    }
}
