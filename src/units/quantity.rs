//! Quantities: which dimensions and units a property takes.

use super::dimension::Dimension;
use super::parse::Measure;

/// Quantity that a property measures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// Name in messages: `angular speed`.
    pub name: &'static str,
    /// Dimension, angles included.
    pub dimension: Dimension,
    /// Whether units without the angle are taken too: custom writes N·m where
    /// N·m/rad is meant.
    pub angle_may_be_left_out: bool,
    /// Units named in messages; the first is the SI unit.
    pub units: &'static [&'static str],
}

/// Mismatch of a measure and a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mismatch {
    /// No unit was written.
    Bare,
    /// Cycles per second where an angle per second is wanted.
    FrequencyForSpeed,
    /// An angle per second where cycles per second are wanted.
    SpeedForFrequency,
    /// Any other dimension.
    Dimension,
}

impl Quantity {
    /// SI unit; `1` for a pure number.
    pub fn si(&self) -> &'static str {
        self.units.first().copied().unwrap_or("1")
    }

    /// Checks a measure read from a text.
    ///
    /// # Errors
    /// How it does not fit.
    pub fn accept(&self, measure: Measure) -> Result<f64, Mismatch> {
        if *self == quantities::ANYTHING {
            return Ok(measure.value);
        }
        if measure.dimension == self.dimension && !(measure.bare && self.needs_unit()) {
            return Ok(measure.value);
        }
        if measure.bare {
            return Err(Mismatch::Bare);
        }
        let bare_angle = self.angle_may_be_left_out
            && measure.dimension.angle == 0
            && measure.dimension == self.dimension.without_angle();
        let composed = measure.composed && measure.dimension.agrees_but_for_angle(self.dimension);
        if bare_angle || composed {
            return Ok(measure.value);
        }
        let per_second = Dimension::new(0, 0, -1, 0);
        let angular = Dimension::new(0, 0, -1, 1);
        if measure.per_minute && self.dimension == angular {
            // Revolutions per minute by custom (DIN 1301); as a frequency it is plain.
            return Ok(measure.value * std::f64::consts::TAU);
        }
        Err(match (self.dimension, measure.dimension) {
            (wanted, found) if wanted == angular && found == per_second => {
                Mismatch::FrequencyForSpeed
            }
            (wanted, found) if wanted == per_second && found == angular => {
                Mismatch::SpeedForFrequency
            }
            _ => Mismatch::Dimension,
        })
    }

    /// True unless a bare number in a text is right.
    fn needs_unit(&self) -> bool {
        self.dimension != Dimension::NONE
    }
}

/// The quantities of mechanisms.
pub mod quantities {
    use super::{Dimension, Quantity};

    const fn quantity(
        name: &'static str,
        (mass, length, time, angle): (i32, i32, i32, i32),
        units: &'static [&'static str],
    ) -> Quantity {
        Quantity {
            name,
            dimension: Dimension::new(mass, length, time, angle),
            angle_may_be_left_out: false,
            units,
        }
    }

    /// As `quantity`, with or without the radian.
    const fn loose(
        name: &'static str,
        exponents: (i32, i32, i32, i32),
        units: &'static [&'static str],
    ) -> Quantity {
        Quantity {
            angle_may_be_left_out: true,
            ..quantity(name, exponents, units)
        }
    }

    /// Whatever is given: its meaning is not known.
    pub const ANYTHING: Quantity = quantity("quantity", (0, 0, 0, 0), &["the figure's unit"]);
    /// Pure number.
    pub const NUMBER: Quantity = quantity("number", (0, 0, 0, 0), &["1", "%"]);
    /// Angle.
    pub const ANGLE: Quantity = quantity("angle", (0, 0, 0, 1), &["rad", "deg", "mrad", "rev"]);
    /// Length.
    pub const LENGTH: Quantity =
        quantity("length", (0, 1, 0, 0), &["m", "mm", "cm", "µm", "in", "ft"]);
    /// Area.
    pub const AREA: Quantity = quantity("area", (0, 2, 0, 0), &["m^2", "mm^2", "cm^2", "in^2"]);
    /// Time.
    pub const TIME: Quantity = quantity("time", (0, 0, 1, 0), &["s", "ms", "µs", "min", "h"]);
    /// Mass.
    pub const MASS: Quantity = quantity("mass", (1, 0, 0, 0), &["kg", "g", "t", "lb"]);
    /// Moment of inertia.
    pub const INERTIA: Quantity = quantity(
        "moment of inertia",
        (1, 2, 0, 0),
        &["kg m^2", "kg cm^2", "g mm^2", "lb ft^2", "lb in^2"],
    );
    /// Density.
    pub const DENSITY: Quantity =
        quantity("density", (1, -3, 0, 0), &["kg/m^3", "g/cm^3", "lb/in^3"]);
    /// Pressure.
    pub const PRESSURE: Quantity = quantity(
        "pressure",
        (1, -1, -2, 0),
        &["Pa", "kPa", "bar", "MPa", "psi"],
    );
    /// Elastic modulus.
    pub const MODULUS: Quantity = quantity(
        "modulus",
        (1, -1, -2, 0),
        &["Pa", "MPa", "GPa", "N/mm^2", "ksi"],
    );
    /// Force.
    pub const FORCE: Quantity = quantity("force", (1, 1, -2, 0), &["N", "kN", "MN", "lbf", "kgf"]);
    /// Moment.
    pub const MOMENT: Quantity = quantity(
        "moment",
        (1, 2, -2, 0),
        &["N m", "kN m", "N mm", "lbf ft", "lbf in"],
    );
    /// Stiffness of a sliding object.
    pub const IMPULSE: Quantity = quantity("impulse", (1, 1, -1, 0), &["N s", "kN s"]);
    /// Moment times time.
    pub const ANGULAR_IMPULSE: Quantity =
        quantity("angular impulse", (1, 2, -1, 0), &["N m s", "kN m s"]);
    /// Force per length.
    pub const LINEAR_STIFFNESS: Quantity = quantity(
        "stiffness",
        (1, 0, -2, 0),
        &["N/m", "N/mm", "kN/mm", "lbf/in"],
    );
    /// Stiffness of a turning object.
    pub const ROTATIONAL_STIFFNESS: Quantity = loose(
        "rotational stiffness",
        (1, 2, -2, -1),
        &["N m/rad", "N m", "kN m/rad", "N m/deg", "lbf ft/rad"],
    );
    /// Damping of a sliding object.
    pub const LINEAR_DAMPING: Quantity =
        quantity("damping", (1, 0, -1, 0), &["N s/m", "kN s/m", "lbf s/in"]);
    /// Damping of a turning object.
    pub const ROTATIONAL_DAMPING: Quantity = loose(
        "rotational damping",
        (1, 2, -1, -1),
        &["N m s/rad", "N m s"],
    );
    /// Speed of a turning object.
    pub const ANGULAR_SPEED: Quantity = quantity(
        "angular speed",
        (0, 0, -1, 1),
        &["rad/s", "rev/s", "rpm", "1/min", "deg/s"],
    );
    /// Speed of a sliding object.
    pub const LINEAR_SPEED: Quantity = quantity(
        "speed",
        (0, 1, -1, 0),
        &["m/s", "mm/s", "m/min", "in/s", "ft/s"],
    );
    /// Acceleration of a turning object.
    pub const ANGULAR_ACCELERATION: Quantity = quantity(
        "angular acceleration",
        (0, 0, -2, 1),
        &["rad/s^2", "deg/s^2"],
    );
    /// Acceleration of a sliding object.
    pub const LINEAR_ACCELERATION: Quantity = quantity(
        "acceleration",
        (0, 1, -2, 0),
        &["m/s^2", "mm/s^2", "in/s^2", "ft/s^2"],
    );
    /// Frequency.
    pub const FREQUENCY: Quantity = quantity("frequency", (0, 0, -1, 0), &["Hz", "kHz"]);
    /// Power.
    pub const POWER: Quantity = quantity("power", (1, 2, -3, 0), &["W", "kW", "hp"]);
    /// Inverse speed of an angle.
    pub const SECONDS_PER_ANGLE: Quantity = loose("time per angle", (0, 0, 1, -1), &["s/rad", "s"]);
    /// Inverse speed of a length.
    pub const SECONDS_PER_LENGTH: Quantity =
        quantity("time per length", (0, -1, 1, 0), &["s/m", "s/mm"]);
    /// Ratio of a length to an angle.
    pub const LENGTH_PER_ANGLE: Quantity = loose(
        "length per angle",
        (0, 1, 0, -1),
        &["m/rad", "mm/rad", "mm/rev", "mm"],
    );
    /// Ratio of an angle to a length.
    pub const ANGLE_PER_LENGTH: Quantity = loose(
        "angle per length",
        (0, -1, 0, 1),
        &["rad/m", "rad/mm", "deg/mm"],
    );

    /// All of them.
    pub const ALL: &[Quantity] = &[
        NUMBER,
        ANGLE,
        LENGTH,
        AREA,
        TIME,
        MASS,
        INERTIA,
        DENSITY,
        MODULUS,
        FORCE,
        MOMENT,
        LINEAR_STIFFNESS,
        ROTATIONAL_STIFFNESS,
        LINEAR_DAMPING,
        ROTATIONAL_DAMPING,
        ANGULAR_SPEED,
        LINEAR_SPEED,
        ANGULAR_ACCELERATION,
        LINEAR_ACCELERATION,
        FREQUENCY,
        POWER,
        SECONDS_PER_ANGLE,
        SECONDS_PER_LENGTH,
        LENGTH_PER_ANGLE,
        ANGLE_PER_LENGTH,
        PRESSURE,
    ];
}

#[cfg(test)]
mod tests {
    use super::quantities::*;
    use super::*;
    use crate::units::parse;

    #[test]
    fn every_quantity_takes_the_units_it_names() {
        for quantity in ALL {
            for (number, unit) in quantity.units.iter().enumerate() {
                let text = if *unit == "1" {
                    "2".to_owned()
                } else {
                    format!("2 {unit}")
                };
                let measure = parse(&text).unwrap_or_else(|e| panic!("{text}: {e:?}"));
                let value = quantity.accept(measure);
                assert!(value.is_ok(), "{}: {unit}: {value:?}", quantity.name);
                if number == 0 {
                    assert_eq!(value, Ok(2.0), "{}: {unit} is SI", quantity.name);
                }
            }
        }
    }

    #[test]
    fn other_dimensions_are_refused() {
        let refuse = |quantity: Quantity, text| quantity.accept(parse(text).unwrap()).unwrap_err();
        assert_eq!(refuse(ANGULAR_SPEED, "10 Hz"), Mismatch::FrequencyForSpeed);
        assert_eq!(refuse(FREQUENCY, "10 rev/s"), Mismatch::SpeedForFrequency);
        assert_eq!(refuse(ANGULAR_SPEED, "10 1/s"), Mismatch::FrequencyForSpeed);
        assert_eq!(refuse(LENGTH, "10"), Mismatch::Bare);
        assert_eq!(refuse(LENGTH, "10 kg"), Mismatch::Dimension);
        assert_eq!(refuse(MOMENT, "10 N m/rad/rad"), Mismatch::Dimension);
        assert_eq!(refuse(ANGLE, "10 %"), Mismatch::Dimension);
        assert_eq!(NUMBER.accept(parse("10").unwrap()), Ok(10.0));
    }

    #[test]
    fn per_minute_is_a_speed_of_turning_or_a_frequency_as_is_wanted() {
        let of = |quantity: Quantity, text| quantity.accept(parse(text).unwrap());
        let turning = of(ANGULAR_SPEED, "300 1/min").unwrap();
        assert!((turning - of(ANGULAR_SPEED, "300 rpm").unwrap()).abs() < 1e-14);
        assert_eq!(of(FREQUENCY, "300 1/min"), Ok(5.0));
        assert!(of(LINEAR_SPEED, "300 1/min").is_err());
    }
}
