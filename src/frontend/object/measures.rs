//! Which quantities the properties of an object have.

use crate::dynamics::model::Coordinate::{self, Sliding, Turning};
use crate::frontend::read::{Bounds, Fields, QuantityChoice, Slot};
use crate::units::quantities as q;
use crate::units::{Dimension, Quantity};

/// Quantities of an object that turns, slides, or of which that is not known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Measures(pub Option<Coordinate>);

impl Measures {
    fn pick(self, turning: Quantity, sliding: Quantity) -> QuantityChoice {
        match self.0 {
            Some(Turning) => turning.into(),
            Some(Sliding) => sliding.into(),
            None => QuantityChoice::either(turning, sliding),
        }
    }

    /// Angle or length.
    pub fn displacement(self) -> QuantityChoice {
        self.pick(q::ANGLE, q::LENGTH)
    }

    /// Angular speed or speed.
    pub fn speed(self) -> QuantityChoice {
        self.pick(q::ANGULAR_SPEED, q::LINEAR_SPEED)
    }

    /// Angular acceleration or acceleration.
    pub fn acceleration(self) -> QuantityChoice {
        self.pick(q::ANGULAR_ACCELERATION, q::LINEAR_ACCELERATION)
    }

    /// Moment or force.
    pub fn force(self) -> QuantityChoice {
        self.pick(q::MOMENT, q::FORCE)
    }

    /// Moment or force, times time.
    pub fn impulse(self) -> QuantityChoice {
        self.pick(q::ANGULAR_IMPULSE, q::IMPULSE)
    }

    /// Moment of inertia or mass.
    pub fn inertia(self) -> QuantityChoice {
        self.pick(q::INERTIA, q::MASS)
    }

    /// Lets `inertia` be written as `mass` of what slides, as `moment_of_inertia` of what
    /// turns.
    pub(super) fn name_inertia(self, fields: &mut Fields<'_>) {
        for (coordinate, name) in [(Sliding, "mass"), (Turning, "moment_of_inertia")] {
            if self.0.is_none_or(|own| own == coordinate) {
                fields.synonym("inertia", name);
            }
        }
    }

    /// Rotational or linear stiffness.
    pub fn stiffness(self) -> QuantityChoice {
        self.pick(q::ROTATIONAL_STIFFNESS, q::LINEAR_STIFFNESS)
    }

    /// Rotational or linear damping.
    pub fn damping(self) -> QuantityChoice {
        self.pick(q::ROTATIONAL_DAMPING, q::LINEAR_DAMPING)
    }

    /// κ of Hunt–Crossley: time per unit of penetration.
    pub fn time_per_displacement(self) -> QuantityChoice {
        self.pick(q::SECONDS_PER_ANGLE, q::SECONDS_PER_LENGTH)
    }

    /// U′: this object's displacement per displacement of its driver.
    pub fn per(self, driver: Self) -> QuantityChoice {
        let one = |own: Coordinate, driver: Coordinate| match (own, driver) {
            (Sliding, Turning) => q::LENGTH_PER_ANGLE,
            (Turning, Sliding) => q::ANGLE_PER_LENGTH,
            _ => q::NUMBER,
        };
        match (self.0, driver.0) {
            (Some(own), Some(driver)) => one(own, driver).into(),
            (Some(own), None) => QuantityChoice::either(one(own, Turning), one(own, Sliding)),
            (None, Some(driver)) => {
                QuantityChoice::either(one(Turning, driver), one(Sliding, driver))
            }
            (None, None) => QuantityChoice::either(q::NUMBER, q::LENGTH_PER_ANGLE),
        }
    }

    /// Coefficient of φ to a power in U(φ).
    pub fn coefficient(self, driver: Self, power: usize) -> QuantityChoice {
        match power {
            0 => self.displacement(),
            1 => self.per(driver),
            _ => {
                let both = [Turning, Sliding];
                let own = self.0.map_or(both.to_vec(), |one| vec![one]);
                let driver = driver.0.map_or(both.to_vec(), |one| vec![one]);
                let one = |own, driver| coefficient_quantity(own, driver, power);
                QuantityChoice::either(
                    one(own[0], driver[0]),
                    one(own[own.len() - 1], driver[driver.len() - 1]),
                )
            }
        }
    }
}

fn coefficient_quantity(own: Coordinate, driver: Coordinate, power: usize) -> Quantity {
    let dimension = |coordinate| match coordinate {
        Turning => Dimension::ANGLE,
        Sliding => Dimension::LENGTH,
    };
    // Powers are bounded by the length of the list of coefficients.
    let below = i32::try_from(power)
        .ok()
        .and_then(|power| dimension(driver).power(power))
        .unwrap_or_default();
    Quantity {
        name: "coefficient",
        dimension: dimension(own) / below,
        angle_may_be_left_out: true,
        units: &["SI units"],
    }
}

/// Quantities of the input and the output of a position function.
#[derive(Clone, Copy, Debug)]
pub(super) struct PositionMeasures {
    /// Quantities of the output U.
    pub(super) output: Measures,
    /// Quantities of the driver φ.
    pub(super) driver: Measures,
}

pub(super) fn read_quantity(wanted: impl Into<QuantityChoice>) -> impl Fn(Slot<'_>) -> Option<f64> {
    let wanted = wanted.into();
    move |slot| slot.quantity(wanted, Bounds::ANY)
}
